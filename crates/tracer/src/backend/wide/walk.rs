//! How a packet walks the trees: one box at a time against all lanes.

use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::Simd;

use super::Tracer;
use super::packet::Packet;
use super::search::Best;
use crate::accel::{Box32, MAX_DEPTH, Tree};
use crate::kernel::{Edges, Rays, Target, magnitude};
use crate::lanes::{F, F3, M, narrow3, splat_wide, splat3};
use crate::numeric::{BOX_PAD, BOX_STRETCH};
use crate::snapshot::Instance;

/// Rays as boxes see them.
struct Slabs<S: Simd> {
    origin: F3<S>,
    inverse: F3<S>,
    /// How far boxes are widened for the rounding of the origins.
    pad: F<S>,
    /// Which way most lanes go along each axis: what decides the order of children.
    backwards: [bool; 3],
}

impl<S: Simd> Slabs<S> {
    #[inline(always)]
    fn new(s: S, rays: &Rays<S>, live: M<S>) -> Self {
        let one = F::splat(s, 1.0);
        let d = rays.direction;
        let zero = F::splat(s, 0.0);
        let mostly = |c: F<S>| 2 * (live & c.less(zero)).count() > live.count();
        Self {
            origin: rays.origin,
            inverse: F3::new(one / d.x, one / d.y, one / d.z),
            pad: rays.reach.mul_add(F::splat(s, BOX_PAD), F::splat(s, f32::MIN_POSITIVE)),
            backwards: [mostly(d.x), mostly(d.y), mostly(d.z)],
        }
    }

    /// Lanes that may meet a box up to `far`; never a false no (Ize 2013). NaN, from a ray within a face, counts as
    /// inside.
    #[inline(always)]
    fn meet(&self, s: S, b: &Box32, far: F<S>) -> M<S> {
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

impl<S: Simd> Tracer<'_, S> {
    /// Finds the nearest of the scene's bounded shapes.
    #[inline(always)]
    pub(super) fn walk_scene(&mut self, packet: &Packet<S>, best: &mut Best<S>) {
        let snapshot = self.frame.snapshot;
        let slabs = Slabs::new(self.s, &packet.rays, packet.live);
        let mut walk = Walk::default();
        while let Some(items) = walk.next(snapshot.tree(), slabs.backwards, |bounds| {
            self.stats.tests.boxes += F::<S>::LANES as u64;
            (slabs.meet(self.s, bounds, best.t + best.error) & packet.live).any()
        }) {
            for &item in &snapshot.tree().order[items] {
                self.try_prim(packet, best, snapshot.columns().bounded[item as usize]);
            }
        }
    }

    /// Closes the ways that the scene's bounded shapes block.
    #[inline(always)]
    pub(super) fn walk_scene_to_light(&mut self, packet: &Packet<S>, target: &Target<S>, open: &mut M<S>) {
        let snapshot = self.frame.snapshot;
        let slabs = Slabs::new(self.s, &packet.rays, packet.live);
        let mut walk = Walk::default();
        while let Some(items) = walk.next(snapshot.tree(), slabs.backwards, |bounds| {
            self.stats.tests.boxes += F::<S>::LANES as u64;
            (slabs.meet(self.s, bounds, target.distance) & *open).any()
        }) {
            for &item in &snapshot.tree().order[items] {
                self.block_prim(packet, target, open, snapshot.columns().bounded[item as usize]);
            }
        }
    }

    /// Finds the nearest triangle of a mesh.
    #[inline(always)]
    pub(super) fn walk_mesh(&mut self, packet: &Packet<S>, best: &mut Best<S>, instance: &Instance) {
        let rays = instance.own_rays(self.s, packet);
        let slabs = Slabs::new(self.s, &rays, packet.live);
        let mesh = &instance.tree;
        let mut walk = Walk::default();
        while let Some(items) = walk.next(&mesh.tree, slabs.backwards, |bounds| {
            self.stats.tests.boxes += F::<S>::LANES as u64;
            (slabs.meet(self.s, bounds, best.t + best.error) & packet.live).any()
        }) {
            for at in items {
                let proposal = Edges::new(&mesh.corners[at], mesh.reach).propose(self.s, &rays);
                let place = (instance.prim, mesh.tree.order[at]);
                self.consider(packet, best, packet.live, place, proposal);
            }
        }
    }

    /// Closes the ways that a mesh blocks.
    #[inline(always)]
    pub(super) fn walk_mesh_to_light(
        &mut self,
        packet: &Packet<S>,
        target: &Target<S>,
        open: &mut M<S>,
        instance: &Instance,
    ) {
        let rays = instance.own_rays(self.s, packet);
        let slabs = Slabs::new(self.s, &rays, packet.live);
        let mesh = &instance.tree;
        let mut walk = Walk::default();
        while let Some(items) = walk.next(&mesh.tree, slabs.backwards, |bounds| {
            self.stats.tests.boxes += F::<S>::LANES as u64;
            (slabs.meet(self.s, bounds, target.distance) & *open).any()
        }) {
            for at in items {
                let facet = mesh.tree.order[at];
                let blocking =
                    Edges::new(&mesh.corners[at], mesh.reach).propose(self.s, &rays).blocking(target);
                let allowed = *open & !packet.leaving_from(self.s, instance.prim, facet);
                self.block(packet, target, open, allowed, (instance.prim, Some(facet)), blocking);
            }
        }
    }
}

impl Instance {
    /// A packet's rays in the mesh's own space. `t` stays metres of the world, so directions are as long as one metre
    /// of the world is there.
    #[inline(always)]
    fn own_rays<S: Simd>(&self, s: S, packet: &Packet<S>) -> Rays<S> {
        let Some(rows) = &self.to_object else { return packet.rays };
        let turn = |v: crate::lanes::D3<S>, row: usize| splat_wide(s, rows.matrix[row]).dot(v);
        let shift = splat_wide(s, rows.shift);
        let o = packet.origin;
        let origin = F3::new(
            (turn(o, 0) + shift.x).narrow(),
            (turn(o, 1) + shift.y).narrow(),
            (turn(o, 2) + shift.z).narrow(),
        );
        let d = packet.direction;
        let direction = narrow3(crate::lanes::D3::new(turn(d, 0), turn(d, 1), turn(d, 2)));
        Rays { origin, direction: direction.scale(packet.inverse_length), reach: magnitude(origin) }
    }
}

/// A walk under way.
struct Walk {
    stack: [u32; MAX_DEPTH],
    depth: usize,
}

impl Default for Walk {
    #[inline(always)]
    fn default() -> Self {
        Self { stack: [0; MAX_DEPTH], depth: 1 }
    }
}

impl Walk {
    /// The items of the next leaf whose box, and those round it, `meets`.
    #[inline(always)]
    fn next(
        &mut self,
        tree: &Tree,
        backwards: [bool; 3],
        mut meets: impl FnMut(&Box32) -> bool,
    ) -> Option<std::ops::Range<usize>> {
        while self.depth > 0 {
            self.depth -= 1;
            let at = self.stack[self.depth];
            let Some(node) = tree.nodes.get(at as usize) else { continue };
            if !meets(&node.bounds) {
                continue;
            }
            if node.count > 0 {
                let first = node.link as usize;
                return Some(first..first + node.count as usize);
            }
            let [near, away] = node.children(at, backwards);
            self.stack[self.depth] = away;
            self.stack[self.depth + 1] = near;
            self.depth += 2;
        }
        None
    }
}
