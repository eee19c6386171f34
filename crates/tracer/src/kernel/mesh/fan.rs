//! Rays through one point, through a mesh's tree: against eight boxes at a time all of them together, and against
//! triangles whose edges are planes through that point.
//!
//! A ray is its slopes (u, v) over the axis that all rays run along, and its depth z is the parameter. An edge e seen from
//! the point p away spans the plane n = e × p, so a ray's edge value is n·(u, v, 1): two fused products. What n is, and
//! whether all rays together pass an edge on the outside, is worked out for eight triangles at a time.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use super::edges::Prepared;
use super::{Settled, Umpire, Visits, settle};
use crate::accel::{Node8, WIDTH, WideTree};
use crate::lanes::{Bits, F, M, U};
use crate::numeric::{FAN_PAD, FAN_SLOPE};

/// What rays through one point have in common.
pub(crate) struct Fan {
    /// Axes of the slopes, then the one that all rays run along.
    pub(super) axes: [usize; 3],
    /// 1 or −1: which way they do so. All space is mirrored through the origin for those that run backwards.
    pub(super) sign: f32,
    /// The point, mirrored as the rays are, axis by axis as in `axes`.
    pub(super) apex: [f32; 3],
    /// How far a ray may pass the point by.
    pub(super) slack: f32,
    /// Error of the slopes.
    pub(super) slope_error: f32,
    /// Box round the slopes of all rays.
    pub(super) low: [f32; 2],
    pub(super) high: [f32; 2],
    /// How far boxes are widened.
    pad: f32,
    /// Whether any crossing will do.
    any: bool,
}

/// The rays themselves.
#[derive(Clone, Copy)]
pub(crate) struct FanRays<S: Simd> {
    pub(crate) u: F<S>,
    pub(crate) v: F<S>,
    /// Depths between which the stretch begins.
    pub(crate) begin: [F<S>; 2],
    /// Depth of the nearest crossing so far, or of the end of the stretch, within `error`.
    pub(crate) z: F<S>,
    pub(crate) error: F<S>,
    /// Place of the nearest triangle in the tree's blocks; [`u32::MAX`] for none.
    pub(crate) slot: U<S>,
    /// Triangle that each ray leaves from.
    pub(crate) left: U<S>,
    /// Depth per `t`.
    pub(crate) scale: F<S>,
    pub(crate) live: M<S>,
}

impl<S: Simd> FanRays<S> {
    /// Scalar products of a vector and the directions.
    #[inline(always)]
    fn value(&self, s: S, n: &[[f32; WIDTH]; 3], at: usize) -> F<S> {
        let (x, y, z) = (F::splat(s, n[0][at]), F::splat(s, n[1][at]), F::splat(s, n[2][at]));
        self.u.mul_add(x, self.v.mul_add(y, z))
    }
}

/// Where rays go: slopes and the sign along the main axis.
pub(crate) struct Aim {
    pub(crate) axes: [usize; 3],
    pub(crate) sign: f32,
}

impl Aim {
    /// The axis along which a direction is longest, and which way it goes.
    pub(crate) fn of(direction: DVec3) -> Self {
        let size = direction.abs();
        let last = if size.x > size.y.max(size.z) {
            0
        } else if size.y > size.z {
            1
        } else {
            2
        };
        Self {
            axes: [(last + 1) % 3, (last + 2) % 3, last],
            sign: if direction[last] < 0.0 { -1.0 } else { 1.0 },
        }
    }
}

/// How far the box round slopes below 2 is widened: by their error, and for the rounding of its own ends.
const WIDER: f32 = 3.0 * FAN_SLOPE;

impl Fan {
    /// Rays within a box of slopes, each at most 2 in magnitude, that pass a point by at most `slack`; through a mesh
    /// whose corners' coordinates stay within `reach`.
    pub(crate) fn new(aim: &Aim, apex: DVec3, slack: f32, slopes: [[f32; 2]; 2], reach: f32) -> Self {
        let ([u, v, z], sign) = (aim.axes, f64::from(aim.sign));
        let own = DVec3::new(apex[u % 3] * sign, apex[v % 3] * sign, apex[z % 3] * sign);
        let rounded = own.as_vec3();
        let off = (own - rounded.as_dvec3()).abs().max_element() as f32;
        let slack = (slack + off).next_up();
        let size = reach + rounded.abs().max_element();
        let [low, high] = slopes;
        Self {
            axes: aim.axes,
            sign: aim.sign,
            apex: rounded.to_array(),
            slack,
            slope_error: FAN_SLOPE,
            low: [low[0] - WIDER, low[1] - WIDER],
            high: [high[0] + WIDER, high[1] + WIDER],
            pad: FAN_PAD * size + 4.0 * slack + f32::MIN_POSITIVE,
            any: false,
        }
    }

    /// Asks for any crossing rather than the nearest.
    pub(crate) fn for_any(self) -> Self {
        Self { any: true, ..self }
    }

    /// Whose slopes are off by so much more.
    pub(crate) fn with_slope_error(self, more: f32) -> Self {
        Self {
            slope_error: self.slope_error + more,
            low: [self.low[0] - more, self.low[1] - more],
            high: [self.high[0] + more, self.high[1] + more],
            ..self
        }
    }

    /// Finds the nearest triangle for every ray, or any. Compiled apart.
    pub(crate) fn search<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visits: &mut Visits,
        rays: &mut FanRays<S>,
        umpire: &mut dyn Umpire,
    ) {
        s.vectorize(
            #[inline(always)]
            || self.walk(s, tree, visits, rays, umpire),
        );
    }

    #[inline(always)]
    fn walk<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        visits: &mut Visits,
        rays: &mut FanRays<S>,
        umpire: &mut dyn Umpire,
    ) {
        let mut far = self.far(s, rays);
        visits.start();
        while let Some(visit) = visits.next() {
            if visit.near > far {
                continue;
            }
            if visit.count == 0 {
                visits.nodes += 1;
                self.enter(s, &tree.nodes[visit.link as usize], far, visits);
                continue;
            }
            let (first, count) = (visit.link as usize, visit.count as usize);
            for block in first / WIDTH..=(first + count - 1) / WIDTH {
                visits.blocks += 1;
                if self.pass(s, tree, block, rays, umpire) {
                    far = self.far(s, rays);
                }
            }
        }
    }

    /// At least the depth up to which it is still worth looking.
    #[inline(always)]
    fn far<S: Simd>(&self, s: S, rays: &FanRays<S>) -> f32 {
        let none = F::splat(s, f32::NEG_INFINITY);
        F::pick(rays.live, rays.z + rays.error, none).0.reduce_max()
    }

    /// A row of a node as seen from the point; `side` 0 for the lower sides, 1 for the upper.
    #[inline(always)]
    fn row<S: Simd>(&self, s: S, node: &Node8, which: usize, side: usize) -> f32x8<S> {
        let upper = (self.sign > 0.0) == (side == 1);
        let row = &node.bounds[(self.axes[which] + if upper { 3 } else { 0 }) % 6];
        let start = if side == 0 { self.apex[which] + self.pad } else { self.apex[which] - self.pad };
        f32x8::load_array_ref(s, row).mul_sub_precise(f32x8::splat(s, self.sign), f32x8::splat(s, start))
    }

    /// Adds the children that a ray may enter up to a depth, the nearest last.
    #[inline(always)]
    fn enter<S: Simd>(&self, s: S, node: &Node8, far: f32, visits: &mut Visits) {
        let zero = f32x8::splat(s, 0.0);
        let (near, away) = (self.row(s, node, 2, 0).max(zero), self.row(s, node, 2, 1));
        let mut met = near.simd_le(f32x8::splat(s, far)) & near.simd_le(away);
        for which in 0..2 {
            let (low, high) = (self.low[which], self.high[which]);
            let most = if high >= 0.0 { away } else { near };
            let least = if low >= 0.0 { near } else { away };
            met = met
                & self.row(s, node, which, 0).simd_le(most * f32x8::splat(s, high))
                & (least * f32x8::splat(s, low)).simd_le(self.row(s, node, which, 1));
        }
        let there = (1_u64 << node.children) - 1;
        visits.add_children(node, met.to_bitmask() & there, near.to_array());
    }

    /// Tests all rays against a block; whether any has changed.
    #[inline(always)]
    fn pass<S: Simd>(
        &self,
        s: S,
        tree: &WideTree,
        block: usize,
        rays: &mut FanRays<S>,
        umpire: &mut dyn Umpire,
    ) -> bool {
        let (prepared, maybe) = self.prepare(s, &tree.blocks[block]);
        let mut changed = false;
        for at in Bits(maybe) {
            let at = at % WIDTH;
            let facet = tree.blocks[block].facet[at];
            changed |= self.weigh(s, (tree, &prepared), ((block * WIDTH + at) as u32, facet), rays, umpire);
        }
        changed
    }

    /// Takes over a triangle where it is nearer; whether it is for any ray.
    #[inline(always)]
    fn weigh<S: Simd>(
        &self,
        s: S,
        (tree, prepared): (&WideTree, &Prepared),
        (slot, facet): (u32, u32),
        rays: &mut FanRays<S>,
        umpire: &mut dyn Umpire,
    ) -> bool {
        let at = slot as usize % WIDTH;
        let [a, b, c] = &prepared.edges;
        let (a, b, c) = (rays.value(s, a, at), rays.value(s, b, at), rays.value(s, c, at));
        let error = F::splat(s, prepared.edge_error[at]);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let candidate = rays.live & !(low.less(-error) & error.less(high)) & !rays.left.is(facet);
        if !candidate.any() {
            return false;
        }
        let inside = error.less(low) | high.less(-error);
        let slope = rays.value(s, &prepared.normal, at);
        let slope_error = F::splat(s, prepared.slope_error[at]);
        let inverse = F::splat(s, 1.0) / slope;
        let z = F::splat(s, prepared.top[at]) * inverse;
        let doubt = z.abs().mul_add(slope_error, F::splat(s, prepared.top_error[at])) * inverse.abs();
        // Three quarters of a slope that is certain are certain; and a few roundings of z.
        let z_error = z.abs().mul_add(F::splat(s, FAN_SLOPE + FAN_SLOPE), doubt * F::splat(s, 1.5));
        let steep = (slope_error * F::splat(s, 4.0)).less(slope.abs());
        let behind = (rays.z + rays.error).less(z - z_error) | (z + z_error).less(rays.begin[0]);
        let nearer = (z + z_error).less(rays.z - rays.error) & rays.begin[1].less(z - z_error);
        let take = candidate & inside & steep & nearer;
        let open = candidate & !take & !(steep & behind);
        if take.any() {
            rays.z = F::pick(take, z, rays.z);
            rays.error = F::pick(take, z_error, rays.error);
            rays.slot = U::pick(take, U::splat(s, slot), rays.slot);
            if self.any {
                rays.live = rays.live & !take;
            }
        }
        if open.any() {
            self.settle(tree, open.bits(), (slot, facet), rays, umpire);
        }
        (take | open).any()
    }

    /// Decides lane by lane what `f32` leaves open.
    #[cold]
    #[inline(never)]
    fn settle<S: Simd>(
        &self,
        tree: &WideTree,
        lanes: u64,
        (slot, facet): (u32, u32),
        rays: &mut FanRays<S>,
        umpire: &mut dyn Umpire,
    ) {
        for lane in Bits(lanes) {
            let other = rays.slot.lane(lane);
            let held = (other != u32::MAX).then(|| tree.facet(other));
            if held == Some(facet) {
                continue;
            }
            let Some(t) = self.nearer(tree, lane, (slot, facet), rays, umpire) else { continue };
            let z = t as f32 * rays.scale.lane(lane);
            rays.z.set(lane, z);
            rays.error.set(lane, z.abs() * (FAN_SLOPE + FAN_SLOPE));
            rays.slot.set(lane, slot);
            if self.any {
                let s = rays.slot.0.token();
                rays.live = rays.live & !M::from_bits(s, 1 << lane);
            }
        }
    }
}

impl Fan {
    /// At which `t` the ray of a lane meets a triangle in front of all that it has met, if it does.
    fn nearer<S: Simd>(
        &self,
        tree: &WideTree,
        lane: usize,
        (slot, facet): (u32, u32),
        rays: &FanRays<S>,
        umpire: &mut dyn Umpire,
    ) -> Option<f64> {
        let (ray, span) = umpire.ray(lane)?;
        let other = Some(rays.slot.lane(lane)).filter(|&slot| slot != u32::MAX);
        // Two roundings of a sum and a quotient, towards smaller numbers.
        let least = (rays.z.lane(lane) - rays.error.lane(lane)) * (1.0 - 4.0 * FAN_SLOPE);
        let before = if self.any { f64::INFINITY } else { f64::from(least / rays.scale.lane(lane)) };
        match settle(&tree.triangle(slot), other.map(|slot| tree.triangle(slot)), before, (&ray, span)) {
            Settled::Not => None,
            Settled::Nearer(t) => Some(t),
            Settled::Open => umpire.decide(lane, facet, other.map(|slot| tree.facet(slot))),
        }
    }
}
