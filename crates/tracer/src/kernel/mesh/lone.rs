//! One ray through a mesh's tree: against eight boxes, then against eight triangles, at a time.
//!
//! Boxes after Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013; triangles after Woop, Benthin and Wald, "Watertight
//! Ray/Triangle Intersection", JCGT 2(1), 2013, with bounds.

use catoptra_core::Ray;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use super::{Umpire, Verdict, Visit, Visits, Waiting, meet};
use crate::accel::{Block8, Node8, WIDTH, WideTree};
use crate::lanes::Bits;
use crate::numeric::{BOX_STRETCH, LONE_FLOOR, LONE_PAD, LONE_SHARE, LONE_SPREAD};

/// A ray in a mesh's own space.
pub(crate) struct Lone {
    ray: Ray,
    lane: usize,
    /// The triangle that the ray leaves from.
    left: u32,
    /// Where it begins and how the slabs' `t` grow, per axis; for the lower and the upper rows of a node, whichever is
    /// met first.
    rows: [[usize; 3]; 2],
    origins: [[f32; 3]; 2],
    inverses: [[f32; 3]; 2],
    /// Axes with the largest direction last.
    axes: [usize; 3],
    origin: [f32; 3],
    /// Directions along the first two axes over the last.
    shear: [f32; 2],
    /// Error of an edge value per unit of the sheared corners, and where there are none.
    slack: f32,
    floor: f32,
}

/// The nearest crossing of a ray so far.
#[derive(Clone, Copy)]
pub(crate) struct LoneBest {
    /// Where it is, in lengths of the ray's direction, and within which bound.
    pub(crate) t: f64,
    pub(crate) error: f64,
    /// Which triangle of the tree's blocks, if it is one of this mesh.
    pub(crate) slot: Option<u32>,
    /// Whether any crossing will do.
    pub(crate) any: bool,
    /// Where the stretch begins.
    pub(crate) min: f64,
}

impl LoneBest {
    /// At least how far it is still worth looking, as the near sides of boxes are rounded.
    #[inline(always)]
    fn far(&self) -> f32 {
        ((self.t + self.error) as f32) * BOX_STRETCH
    }
}

impl Lone {
    /// For a mesh whose corners' coordinates stay within `reach`.
    #[inline(always)]
    pub(crate) fn new(ray: Ray, lane: usize, left: u32, reach: f32) -> Self {
        let (direction, size) = (ray.direction, ray.direction.abs());
        let last = if size.x > size.y.max(size.z) {
            0
        } else if size.y > size.z {
            1
        } else {
            2
        };
        let axes = [(last + 1) % 3, (last + 2) % 3, last];
        let origin = ray.origin.as_vec3();
        let largest = origin.abs().max_element();
        let pad = largest * LONE_PAD + f32::MIN_POSITIVE;
        let reach = reach + largest;
        let shear = [direction[axes[0]] / direction[last], direction[axes[1]] / direction[last]];
        let mut lone = Self {
            ray,
            lane,
            left,
            rows: [[0; 3]; 2],
            origins: [[0.0; 3]; 2],
            inverses: [[0.0; 3]; 2],
            axes,
            origin: origin.to_array(),
            shear: [shear[0] as f32, shear[1] as f32],
            slack: LONE_SHARE * reach,
            floor: (LONE_FLOOR * reach) * (LONE_FLOOR * reach) + f32::MIN_POSITIVE,
        };
        for axis in 0..3 {
            let inverse = 1.0 / direction[axis] as f32;
            // A lower row is padded downwards, an upper one upwards.
            let (lower, upper) = (origin[axis] + pad, origin[axis] - pad);
            let backwards = inverse.is_sign_negative();
            let (near, away) = if backwards { (axis + 3, axis) } else { (axis, axis + 3) };
            let (first, second) = if backwards { (upper, lower) } else { (lower, upper) };
            (lone.rows[0][axis], lone.rows[1][axis]) = (near, away);
            (lone.origins[0][axis], lone.origins[1][axis]) = (first, second);
            (lone.inverses[0][axis], lone.inverses[1][axis]) = (inverse, inverse * BOX_STRETCH);
        }
        lone
    }

    /// Finds the nearest triangle, or any. Compiled apart.
    pub(crate) fn search<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visits: &mut Visits,
        best: &mut LoneBest,
        umpire: &mut dyn Umpire,
    ) {
        s.vectorize(
            #[inline(always)]
            || self.walk(s, tree, visits, best, umpire),
        );
    }

    #[inline(always)]
    fn walk<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visits: &mut Visits,
        best: &mut LoneBest,
        umpire: &mut dyn Umpire,
    ) {
        let Some(mut waiting) = visits.start() else { return };
        let mut far = best.far();
        let mut visit = Visit { near: 0.0, link: 0, count: 0, packets: 1 };
        loop {
            if visit.count == 0 {
                *waiting.nodes += 1;
                let node = &tree.nodes[visit.link as usize];
                let (met, near) = self.enter(s, node, far);
                if met != 0 {
                    visit = waiting.nearest_of(node, met, &near);
                    continue;
                }
            } else if self.visit_leaf(s, (tree, visit), &mut waiting, best, umpire) {
                far = best.far();
                if best.any && best.slot.is_some() {
                    return;
                }
            }
            let Some(next) = waiting.pop(far) else { return };
            visit = next;
        }
    }

    /// Tests the triangles of a leaf; whether there were any that the ray is not certain to miss.
    #[inline(always)]
    fn visit_leaf<S: Simd>(
        &self,
        s: S,
        (tree, leaf): (&WideTree, Visit),
        waiting: &mut Waiting<'_>,
        best: &mut LoneBest,
        umpire: &mut dyn Umpire,
    ) -> bool {
        let mut met = false;
        for (block, own) in leaf.blocks() {
            *waiting.blocks += 1;
            let maybe = self.pass(s, &tree.blocks[block]) & own;
            for at in Bits(maybe) {
                self.weigh(tree, (block * WIDTH + at) as u32, best, umpire);
            }
            met |= maybe != 0;
        }
        met
    }

    /// Where the ray crosses the nearer (side 0) or farther sides of the boxes along an axis.
    #[inline(always)]
    fn plane<S: Simd>(&self, s: S, node: &Node8, side: usize, axis: usize) -> f32x8<S> {
        let row = f32x8::load_array_ref(s, &node.bounds[self.rows[side][axis]]);
        (row - f32x8::splat(s, self.origins[side][axis])) * f32x8::splat(s, self.inverses[side][axis])
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

    /// Corners across the ray, sheared so that it becomes an axis; `most` grows to their largest coordinate.
    #[inline(always)]
    fn corner<S: Simd>(&self, s: S, rows: &[[f32; WIDTH]; 3], most: &mut f32x8<S>) -> (f32x8<S>, f32x8<S>) {
        let [x, y, z] = self.axes;
        let z = self.seen_from_origin(s, rows, z);
        let (x, y) = (self.seen_from_origin(s, rows, x), self.seen_from_origin(s, rows, y));
        let x = z.mul_add_precise(f32x8::splat(s, -self.shear[0]), x);
        let y = z.mul_add_precise(f32x8::splat(s, -self.shear[1]), y);
        *most = most.max(x.abs()).max(y.abs());
        (x, y)
    }

    #[inline(always)]
    fn seen_from_origin<S: Simd>(&self, s: S, rows: &[[f32; WIDTH]; 3], axis: usize) -> f32x8<S> {
        f32x8::load_array_ref(s, &rows[axis]) - f32x8::splat(s, self.origin[axis])
    }

    /// Triangles of a block that the ray is not certain to miss.
    #[inline(always)]
    fn pass<S: Simd>(&self, s: S, block: &Block8) -> u64 {
        let mut most = f32x8::splat(s, 0.0);
        let a = self.corner(s, &block.corners[0], &mut most);
        let b = self.corner(s, &block.corners[1], &mut most);
        let c = self.corner(s, &block.corners[2], &mut most);
        let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
        let spread = most.mul_add_precise(f32x8::splat(s, LONE_SPREAD), f32x8::splat(s, self.slack));
        let error = most.mul_add_precise(spread, f32x8::splat(s, self.floor));
        let (low, high) = (u.min(v).min(w), u.max(v).max(w));
        !(low.simd_lt(-error) & high.simd_gt(error)).to_bitmask() & 0xff
    }

    /// Takes over a triangle where it is nearer.
    #[inline(always)]
    fn weigh(&self, tree: &WideTree, slot: u32, best: &mut LoneBest, umpire: &mut dyn Umpire) {
        let facet = tree.facet(slot);
        if facet == self.left {
            return;
        }
        match meet(&tree.triangle(slot), &self.ray) {
            Verdict::Miss => return,
            Verdict::Hit(t, error) => {
                if t + error < best.min || t - error > best.t + best.error {
                    return;
                }
                if t - error > best.min && t + error < best.t - best.error {
                    (best.t, best.error, best.slot) = (t, error, Some(slot));
                    return;
                }
            }
            Verdict::Open => {}
        }
        let held = best.slot.map(|slot| tree.facet(slot));
        if held != Some(facet)
            && let Some(t) = umpire.decide(self.lane, facet, held)
        {
            (best.t, best.error, best.slot) = (t, t.abs() * f64::EPSILON, Some(slot));
        }
    }
}

/// Which side of the line through two points of a plane its origin lies on.
#[inline(always)]
fn edge<S: Simd>(v: (f32x8<S>, f32x8<S>), w: (f32x8<S>, f32x8<S>)) -> f32x8<S> {
    v.0.mul_sub_precise(w.1, v.1 * w.0)
}

impl Waiting<'_> {
    /// The nearest of some children of a node; the others wait, the nearer ones first.
    #[inline(always)]
    fn nearest_of(&mut self, node: &Node8, children: u64, near: &[f32; WIDTH]) -> Visit {
        let child = |bits: u64| {
            let child = bits.trailing_zeros() as usize % WIDTH;
            Visit::child(node, child, near[child])
        };
        let first = child(children);
        let others = children & (children - 1);
        if others == 0 {
            return first;
        }
        let second = child(others);
        let rest = others & (others - 1);
        let (mut nearest, other) = if second.near < first.near { (second, first) } else { (first, second) };
        let from = self.depth;
        self.push(other);
        for at in Bits(rest) {
            let next = Visit::child(node, at, near[at % WIDTH]);
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
