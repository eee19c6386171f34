//! Walks the tree over shapes with a packet: one box at a time against all lanes.

use std::ops::Range;

use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::Simd;

use super::Searcher;
use super::hits::Hits;
use super::occluded::{Segments, ShadowRays};
use super::packet::{Packet, PreciseRays};
use crate::accel::{Box32, MAX_DEPTH, Node, Tree};
use crate::kernel::Rays;
use crate::lanes::{F, F3, M, outlined, splat3};
use crate::numeric::{BOX_PAD, BOX_STRETCH};

/// Rays set up for slab tests.
struct Slabs<S: Simd> {
    origin: F3<S>,
    inverse: F3<S>,
    /// How far boxes are widened for the rounding of the origins.
    pad: F<S>,
    /// Whether most lanes run backwards along each axis: this decides the order of children.
    backwards: [bool; 3],
}

impl<S: Simd> Slabs<S> {
    #[inline(always)]
    fn new(s: S, rays: &Rays<S>, live: M<S>) -> Self {
        let one = F::splat(s, 1.0);
        let d = rays.direction;
        let zero = F::splat(s, 0.0);
        Self {
            origin: rays.origin,
            inverse: F3::new(one / d.x, one / d.y, one / d.z),
            pad: rays.reach.mul_add(F::splat(s, BOX_PAD), F::splat(s, f32::MIN_POSITIVE)),
            backwards: [
                mostly(live & d.x.less(zero), live),
                mostly(live & d.y.less(zero), live),
                mostly(live & d.z.less(zero), live),
            ],
        }
    }

    /// Lanes that may meet a box up to `far`; never a false no (Ize 2013). NaN, from a ray within a face, counts as
    /// inside.
    #[inline(always)]
    fn overlaps(&self, s: S, b: &Box32, far: F<S>) -> M<S> {
        let (mut enter, mut leave) = (F::splat(s, 0.0), far);
        let (low, high) = (splat3(s, b.min), splat3(s, b.max));
        let mut outside = enter.less(enter);
        for (low, high, origin, inverse) in [
            (low.x, high.x, self.origin.x, self.inverse.x),
            (low.y, high.y, self.origin.y, self.inverse.y),
            (low.z, high.z, self.origin.z, self.inverse.z),
        ] {
            let t0 = (low - self.pad - origin) * inverse;
            let t1 = (high + self.pad - origin) * inverse;
            let (near, away) = (t0.min(t1), t0.max(t1));
            let away = F::pick(enter.less(away), away * F::splat(s, BOX_STRETCH), away);
            outside = outside | leave.less(near) | away.less(enter);
            enter = F::pick(enter.less(near), near, enter);
            leave = F::pick(away.less(leave), away, leave);
        }
        !outside & !leave.less(enter)
    }
}

impl<S: Simd> Searcher<'_, S> {
    /// Finds the nearest of the scene's bounded shapes. See [`outlined`].
    #[inline(always)]
    pub(crate) fn walk_scene<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: Hits<S>,
    ) -> Hits<S> {
        let (packet, mut best) = (*packet, best);
        outlined(
            self.s,
            #[inline(always)]
            || self.walk_shapes(&packet, &mut best),
        );
        best
    }

    #[inline(always)]
    fn walk_shapes<P: PreciseRays<S>>(&mut self, packet: &Packet<'_, S, P>, best: &mut Hits<S>) {
        let snapshot = self.snapshot;
        let slabs = Slabs::new(self.s, &packet.rays, packet.live);
        let mut walk = Walk::default();
        while let Some(node) = walk.visit(snapshot.tree()) {
            self.stats.tests.boxes += F::<S>::LANES as u64;
            let far = best.t + best.error;
            if (slabs.overlaps(self.s, &node.bounds, far) & packet.live).any() {
                for &item in &snapshot.tree().order[walk.enter(node, slabs.backwards)] {
                    self.try_prim(packet, best, snapshot.columns().bounded[item as usize]);
                }
            }
        }
    }

    /// The segments that no bounded shape of the scene blocks. See [`outlined`].
    #[inline(always)]
    pub(crate) fn occlude_by_tree(
        &mut self,
        segments: &impl Segments<S>,
        rays: &ShadowRays<'_, S>,
        open: M<S>,
    ) -> M<S> {
        let rays = *rays;
        outlined(
            self.s,
            #[inline(always)]
            || self.occlude_by_nodes(segments, &rays, open),
        )
    }

    #[inline(always)]
    fn occlude_by_nodes(
        &mut self,
        segments: &impl Segments<S>,
        rays: &ShadowRays<'_, S>,
        mut open: M<S>,
    ) -> M<S> {
        let snapshot = self.snapshot;
        let slabs = Slabs::new(self.s, &rays.rays, rays.live);
        let mut walk = Walk::default();
        while let Some(node) = walk.visit(snapshot.tree()) {
            self.stats.tests.boxes += F::<S>::LANES as u64;
            if (slabs.overlaps(self.s, &node.bounds, rays.target.distance) & open).any() {
                for &item in &snapshot.tree().order[walk.enter(node, slabs.backwards)] {
                    open = self.occlude_by(segments, rays, open, snapshot.columns().bounded[item as usize]);
                }
            }
        }
        open
    }
}

/// Whether a mask holds for more than half the lanes of another.
#[inline(always)]
fn mostly<S: Simd>(mask: M<S>, of: M<S>) -> bool {
    2 * mask.count() > of.count()
}

/// State of a walk: the stack of nodes still to visit.
struct Walk {
    stack: [u32; MAX_DEPTH],
    depth: usize,
    at: u32,
}

impl Default for Walk {
    #[inline(always)]
    fn default() -> Self {
        Self { stack: [0; MAX_DEPTH], depth: 1, at: 0 }
    }
}

impl Walk {
    /// The next node to look at.
    #[inline(always)]
    fn visit<'a>(&mut self, tree: &'a Tree) -> Option<&'a Node> {
        if self.depth == 0 {
            return None;
        }
        self.depth -= 1;
        self.at = self.stack[self.depth];
        tree.nodes.get(self.at as usize)
    }

    /// Goes on with the children of the node just visited, or gives the index range of a leaf's items.
    #[inline(always)]
    fn enter(&mut self, node: &Node, backwards: [bool; 3]) -> Range<usize> {
        if node.count == 0 {
            let [near, away] = node.children(self.at, backwards);
            self.stack[self.depth] = away;
            self.stack[self.depth + 1] = near;
            self.depth += 2;
            return 0..0;
        }
        let first = node.link as usize;
        first..first + node.count as usize
    }
}
