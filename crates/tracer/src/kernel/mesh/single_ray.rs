//! One ray through a mesh's tree: against eight boxes, then against eight triangles, at a time.
//!
//! Boxes after Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013; triangles after Woop, Benthin and Wald, "Watertight
//! Ray/Triangle Intersection", JCGT 2(1), 2013, with bounds.

use catoptra_core::Span;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, u32x8};

use super::{
    Decision, Edges, ExactResolver, LeafBlock, RayTriangle, Visit, Visits, Waiting, bound_eight, decide,
};
use crate::accel::{Node8, Planes, WIDTH, WideTree};
use crate::lanes::{Bits, MulAdd8, outlined};
use crate::numeric::{BOX_STRETCH, SINGLE_RAY_DEPTH, SINGLE_RAY_SPREAD, SINGLE_RAY_STEEP};

/// A ray in a mesh's own space.
pub(super) struct SingleRay {
    pub(super) lane: usize,
    /// The triangle that the ray leaves from; where planes are numbered, the first in its plane.
    pub(super) leaving: u32,
    /// 1 along axes that it runs backwards, where upper ends of boxes are met first; else 0.
    pub(super) backwards: [usize; 3],
    /// Where slabs begin and how their `t` grow, per axis; for the ends that are met first, then for the others.
    pub(super) starts: [[f32; 3]; 2],
    pub(super) inverses: [[f32; 3]; 2],
    /// Axes with the largest direction last.
    pub(super) axes: [usize; 3],
    pub(super) origin: [f32; 3],
    /// Directions along the first two axes over the last.
    pub(super) shear: [f32; 2],
    /// Lengths of the direction per length along the last axis.
    pub(super) along: f32,
    /// Error of an edge value per unit of the sheared corners, and where there are none.
    pub(super) slack: f32,
    pub(super) floor: f32,
}

/// The nearest crossing of a ray so far.
#[derive(Clone, Copy)]
pub(crate) struct ClosestHit {
    /// Where it is, in lengths of the ray's direction, and within which bound.
    pub(super) t: f32,
    pub(super) error: f32,
    /// Which triangle of the tree's blocks, if it is one of this mesh.
    pub(crate) slot: Option<u32>,
    /// Whether any crossing will do (occlusion).
    any: bool,
    /// The span that is searched, and bounds in `f32` on where it begins.
    span: Span,
    begin: [f32; 2],
}

impl ClosestHit {
    /// Nothing on a stretch.
    #[inline(always)]
    pub(crate) fn nothing_on(span: Span) -> Self {
        let (min, t) = (span.min as f32, span.max as f32);
        let finite = t < f32::MAX;
        let error = if finite { t.abs() * SINGLE_RAY_DEPTH } else { 0.0 };
        let begin = [min - min * SINGLE_RAY_DEPTH, min + min * SINGLE_RAY_DEPTH];
        Self { t: if finite { t } else { f32::MAX }, error, slot: None, any: false, span, begin }
    }

    /// Where something else has been met, at a `t` that is known within a bound.
    #[inline(always)]
    pub(crate) fn before(self, t: f32, error: f32) -> Self {
        Self { t, error, ..self }
    }

    /// Searches for any crossing (occlusion) rather than the nearest.
    #[inline(always)]
    pub(crate) fn for_any(self, any: bool) -> Self {
        Self { any, ..self }
    }

    /// At least the `t` up to which boxes are still searched, with room for the rounding of their near sides.
    #[inline(always)]
    fn far(&self) -> f32 {
        (self.t + self.error) * BOX_STRETCH
    }
}

impl SingleRay {
    /// Finds the nearest triangle, or any. See [`outlined`].
    pub(super) fn search<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visits: &mut Visits,
        best: &mut ClosestHit,
        exact: &mut dyn ExactResolver,
    ) {
        outlined(
            s,
            #[inline(always)]
            || self.walk(s, tree, visits, best, exact),
        );
    }

    #[inline(always)]
    fn walk<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visits: &mut Visits,
        best: &mut ClosestHit,
        exact: &mut dyn ExactResolver,
    ) {
        let planes = visits.planes_of(tree);
        let Some(mut waiting) = visits.start() else { return };
        let mut far = best.far();
        let mut visit = Visit { near: 0.0, link: 0, count: 0, packets: 1 };
        loop {
            if visit.count == 0 {
                *waiting.nodes += 1;
                let node = &tree.nodes[visit.link as usize];
                let (met, near) = self.enter(s, node, far);
                if met != 0 {
                    visit = waiting.nearest_of(tree, node, met, &near);
                    continue;
                }
            } else {
                let mut met = false;
                for leaf in visit.blocks(tree) {
                    *waiting.blocks += 1;
                    met |= self.pass(s, &leaf, planes, best, exact);
                }
                if met {
                    far = best.far();
                    if best.any && best.slot.is_some() {
                        return;
                    }
                }
            }
            let Some(next) = waiting.pop(far) else { return };
            visit = next;
        }
    }

    /// Where the ray crosses the nearer (side 0) or farther sides of the boxes along an axis.
    #[inline(always)]
    fn plane<S: Simd>(&self, s: S, node: &Node8, side: usize, axis: usize) -> f32x8<S> {
        let row = f32x8::load_array_ref(s, &node.bounds[axis][(self.backwards[axis] ^ side) & 1]);
        (row - f32x8::splat(s, self.starts[side][axis])) * f32x8::splat(s, self.inverses[side][axis])
    }

    /// The children that the ray may enter up to `far`, and where it enters them.
    #[inline(always)]
    fn enter<S: Simd>(&self, s: S, node: &Node8, far: f32) -> (u64, [f32; WIDTH]) {
        let mut enter = f32x8::splat(s, 0.0);
        let mut leave = f32x8::splat(s, far);
        for axis in 0..3 {
            enter = self.plane(s, node, 0, axis).max(enter);
            leave = self.plane(s, node, 1, axis).min(leave);
        }
        // NaN, from a ray within a face, counts as inside, whether it has come through the sums or not.
        let missed = enter.simd_gt(leave).to_bitmask();
        (!missed & ((1 << node.children) - 1), enter.to_array())
    }

    /// A corner of every triangle, sheared so that the ray becomes an axis.
    #[inline(always)]
    fn corner<S: Simd>(&self, s: S, rows: &[[f32; WIDTH]; 3]) -> Corner<S> {
        let [x, y, z] = self.axes;
        let z = self.seen_from_origin(s, rows, z);
        let (x, y) = (self.seen_from_origin(s, rows, x), self.seen_from_origin(s, rows, y));
        Corner {
            x: z.fused(-f32x8::splat(s, self.shear[0]), x),
            y: z.fused(-f32x8::splat(s, self.shear[1]), y),
            z,
        }
    }

    #[inline(always)]
    fn seen_from_origin<S: Simd>(&self, s: S, rows: &[[f32; WIDTH]; 3], axis: usize) -> f32x8<S> {
        f32x8::load_array_ref(s, &rows[axis]) - f32x8::splat(s, self.origin[axis])
    }

    /// Tests the ray against a leaf's triangles in a block; whether there are any that it is not certain to miss.
    #[inline(always)]
    fn pass<S: Simd>(
        &self,
        s: S,
        leaf: &LeafBlock<'_>,
        planes: Option<&Planes>,
        best: &mut ClosestHit,
        exact: &mut dyn ExactResolver,
    ) -> bool {
        let corners = &leaf.tree.blocks[leaf.block].corners;
        let (a, b, c) =
            (self.corner(s, &corners[0]), self.corner(s, &corners[1]), self.corner(s, &corners[2]));
        let most = a.across().max(b.across()).max(c.across());
        let (u, v, w) = (edge(&c, &b), edge(&a, &c), edge(&b, &a));
        let (slack, floor) = (f32x8::splat(s, self.slack), f32x8::splat(s, self.floor));
        let spread = most.fused(f32x8::splat(s, SINGLE_RAY_SPREAD), slack);
        let error = bound_eight(s, most.fused(spread, floor));
        let (low, high) = (u.min(v).min(w), u.max(v).max(w));
        let mut maybe = !(low.simd_lt(-error) & high.simd_gt(error)).to_bitmask() & leaf.own;
        if maybe == 0 {
            return false;
        }
        if let Some(planes) = planes {
            let inside = (low.simd_gt(error) | high.simd_lt(-error)).to_bitmask();
            maybe = self.take_in_plane(s, leaf, planes, [maybe, inside], best);
            if maybe == 0 {
                return false;
            }
        }
        let area = u + v + w;
        let inverse = f32x8::splat(s, 1.0) / area;
        let (e, f) = (b.z - a.z, c.z - a.z);
        let z = e.fused(v, f * w).fused(inverse, a.z);
        let steep = error * f32x8::splat(s, SINGLE_RAY_STEEP);
        // Products of corners of tiny scenes may underflow, and so may depths.
        let least = f32x8::splat(s, f32::MIN_POSITIVE);
        let z_error = steep.fused(e.abs().max(f.abs()), least).fused(inverse.abs(), slack);
        let along = f32x8::splat(s, self.along);
        let t = z * along;
        let t_error = t.abs().fused(f32x8::splat(s, SINGLE_RAY_DEPTH), z_error.fused(along.abs(), least));
        let t_error = bound_eight(s, t_error);
        let known = (low.simd_gt(error) | high.simd_lt(-error)) & area.abs().simd_gt(steep + steep);
        let past = (t - t_error).simd_gt(best.t + best.error) | (t + t_error).simd_lt(best.begin[0]);
        let open = maybe & !(known & past).to_bitmask();
        let (known, t, t_error) = (known.to_bitmask(), t.to_array(), t_error.to_array());
        for at in Bits(open) {
            let at = at % WIDTH;
            let crossing = (known >> at & 1 == 1).then_some((t[at], t_error[at]));
            self.accept(leaf.tree, leaf.slot(at), crossing, best, exact);
        }
        true
    }

    /// Takes over the first triangle in the plane of the nearest one so far, of those that the ray passes within the edges of;
    /// returns those of `maybe` that lie in another plane than that and the one that the ray leaves, or may yet be taken over.
    #[inline(always)]
    fn take_in_plane<S: Simd>(
        &self,
        s: S,
        leaf: &LeafBlock<'_>,
        planes: &Planes,
        [maybe, inside]: [u64; 2],
        best: &mut ClosestHit,
    ) -> u64 {
        let LeafBlock { tree, block, .. } = *leaf;
        let own = u32x8::load_array_ref(s, planes.of_block(block));
        let rest = maybe & !own.simd_eq(u32x8::splat(s, self.leaving)).to_bitmask();
        let Some(held) = best.slot else { return rest };
        let same = rest & own.simd_eq(u32x8::splat(s, planes.of_slot(held))).to_bitmask();
        let mut first = tree.facet(held);
        for at in Bits(same & inside) {
            let facet = tree.facet(leaf.slot(at));
            if facet < first {
                (first, best.slot) = (facet, Some(leaf.slot(at)));
            }
        }
        let facets = u32x8::load_array_ref(s, &tree.blocks[block].facet);
        rest & !(same & facets.simd_ge(u32x8::splat(s, first)).to_bitmask())
    }

    /// Takes over a triangle where it is nearer; `crossing` is its `t` and the bound on that, if known.
    #[inline(always)]
    fn accept(
        &self,
        tree: &WideTree,
        slot: u32,
        crossing: Option<(f32, f32)>,
        best: &mut ClosestHit,
        exact: &mut dyn ExactResolver,
    ) {
        if tree.facet(slot) == self.leaving {
            return;
        }
        if let Some((t, error)) = crossing {
            if t - error > best.t + best.error {
                return;
            }
            if t - error > best.begin[1] && t + error < best.t - best.error {
                (best.t, best.error, best.slot) = (t, error, Some(slot));
                return;
            }
        }
        self.decide(tree, slot, best, exact);
    }

    /// Decides what `f32` leaves open.
    #[cold]
    #[inline(never)]
    fn decide(&self, tree: &WideTree, slot: u32, best: &mut ClosestHit, exact: &mut dyn ExactResolver) {
        let (facet, held) = (tree.facet(slot), best.slot);
        // A triangle may be in several leaves.
        if held.is_some_and(|held| tree.facet(held) == facet) {
            return;
        }
        if exact.leaves(self.leaving, facet) {
            tree.planes.count(1);
            return;
        }
        // A rounding of the difference, towards smaller numbers.
        let least = f64::from((best.t - best.error) * (1.0 - SINGLE_RAY_DEPTH));
        let before = if best.any { f64::INFINITY } else { least };
        let held_triangle = held.map(|slot| tree.triangle(slot));
        let Some((ray, _)) = exact.ray(self.lane) else { return };
        let corners = &tree.triangle(slot);
        let test = RayTriangle { ray: &ray, span: best.span, corners, edges: Edges::Open };
        let t = match decide(&test, held_triangle, before) {
            Decision::NotNearer => None,
            Decision::Nearer(t) => Some(t),
            Decision::Open => {
                tree.planes.count(1);
                exact.decide(self.lane, facet, held.map(|slot| tree.facet(slot)))
            }
        };
        if let Some(t) = t {
            let t = t as f32;
            (best.t, best.error, best.slot) = (t, t.abs() * SINGLE_RAY_DEPTH, Some(slot));
        }
    }
}

/// Corners of eight triangles: across the ray and along it.
struct Corner<S: Simd> {
    x: f32x8<S>,
    y: f32x8<S>,
    z: f32x8<S>,
}

impl<S: Simd> Corner<S> {
    /// The larger coordinate across.
    #[inline(always)]
    fn across(&self) -> f32x8<S> {
        self.x.abs().max(self.y.abs())
    }
}

/// Which side of the line through two points of a plane its origin lies on.
#[inline(always)]
fn edge<S: Simd>(v: &Corner<S>, w: &Corner<S>) -> f32x8<S> {
    v.x.mul_sub_precise(w.y, v.y * w.x)
}

impl Waiting<'_> {
    /// The nearest of some children of a node; the others wait, the nearer ones first.
    #[inline(always)]
    fn nearest_of(&mut self, tree: &WideTree, node: &Node8, children: u64, near: &[f32; WIDTH]) -> Visit {
        let first = Visit::ahead(tree, node, children.trailing_zeros() as usize, near);
        let others = children & (children - 1);
        if others == 0 {
            return first;
        }
        let second = Visit::ahead(tree, node, others.trailing_zeros() as usize, near);
        let rest = others & (others - 1);
        let (mut nearest, other) = if second.near < first.near { (second, first) } else { (first, second) };
        let from = self.depth;
        self.push(other);
        for at in Bits(rest) {
            let next = Visit::ahead(tree, node, at, near);
            if next.near < nearest.near {
                self.push(nearest);
                nearest = next;
            } else {
                self.insert(from, next);
            }
        }
        nearest
    }
}
