//! Which rays of a packet through one point meet a triangle in front of all that they have met.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::edges::Prepared;
use super::{Edges, Fan, FanRays, Settled, Umpire, settle};
use crate::accel::{WIDTH, WideTree};
use crate::kernel::bound;
use crate::lanes::{Bits, F, M, U};
use crate::numeric::{FAN_PLANE, FAN_SLOPE, MEET_SLOPE_ERROR, MEET_TOP_ERROR};

/// The plane of a triangle, for rays through one point.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    normal: [f32; 3],
    slope_error: f32,
    /// The point's distance from it along the normal.
    top: f32,
    top_error: f32,
}

/// What is certain of where rays meet a plane.
pub(super) struct Crossing<S: Simd> {
    pub(super) z: F<S>,
    pub(super) error: F<S>,
    /// In front of all that they have met, and within their stretch.
    pub(super) nearer: M<S>,
    /// Behind that, or before their stretch.
    beside: M<S>,
}

impl<S: Simd> FanRays<S> {
    /// Scalar products of a vector and the directions.
    #[inline(always)]
    fn value(&self, s: S, [x, y, z]: [f32; 3]) -> F<S> {
        let (x, y, z) = (F::splat(s, x), F::splat(s, y), F::splat(s, z));
        self.u.mul_add(x, self.v.mul_add(y, z))
    }

    /// Where the rays meet a plane.
    #[inline(always)]
    pub(super) fn cross(&self, s: S, plane: &Plane) -> Crossing<S> {
        let slope = self.value(s, plane.normal);
        let slope_error = bound(s, F::splat(s, plane.slope_error));
        let inverse = F::splat(s, 1.0) / slope;
        let z = F::splat(s, plane.top) * inverse;
        let doubt = z.abs().mul_add(slope_error, F::splat(s, plane.top_error)) * inverse.abs();
        // Three quarters of a slope that is certain are certain; and a few roundings of z.
        let error = bound(s, z.abs().mul_add(F::splat(s, FAN_SLOPE + FAN_SLOPE), doubt * F::splat(s, 1.5)));
        let steep = (slope_error * F::splat(s, 4.0)).less(slope.abs());
        let behind = (self.z + self.error).less(z - error) | (z + error).less(self.begin[0]);
        let nearer = (z + error).less(self.z - self.error) & self.begin[1].less(z - error);
        Crossing { z, error, nearer: steep & nearer, beside: steep & behind }
    }

    /// Takes over a triangle in some lanes.
    #[inline(always)]
    fn take(&mut self, s: S, lanes: M<S>, slot: u32, crossing: &Crossing<S>, any: bool) {
        self.z = F::pick(lanes, crossing.z, self.z);
        self.error = F::pick(lanes, crossing.error, self.error);
        self.slot = U::pick(lanes, U::splat(s, slot), self.slot);
        if any {
            self.live = self.live & !lanes;
        }
    }
}

impl Prepared {
    #[inline(always)]
    fn plane(&self, at: usize) -> Plane {
        let [x, y, z] = &self.normal;
        Plane {
            normal: [x[at], y[at], z[at]],
            slope_error: self.slope_error[at],
            top: self.top[at],
            top_error: self.top_error[at],
        }
    }
}

impl Fan {
    /// Takes over a triangle where it is nearer; whether it is for any ray.
    #[inline(always)]
    pub(super) fn weigh<S: Simd>(
        &self,
        s: S,
        (tree, prepared): (&WideTree, &Prepared),
        (slot, facet): (u32, u32),
        (rays, packet): (&mut FanRays<S>, usize),
        umpire: &mut dyn Umpire,
    ) -> bool {
        let at = slot as usize % WIDTH;
        let edge = |[x, y, z]: &[[f32; WIDTH]; 3]| rays.value(s, [x[at], y[at], z[at]]);
        let [a, b, c] = &prepared.edges;
        let (a, b, c) = (edge(a), edge(b), edge(c));
        let error = bound(s, F::splat(s, prepared.edge_error[at]));
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let candidate = rays.live & !(low.less(-error) & error.less(high)) & !rays.left.is(facet);
        if !candidate.any() {
            return false;
        }
        let inside = error.less(low) | high.less(-error);
        let crossing = rays.cross(s, &prepared.plane(at));
        let take = candidate & inside & crossing.nearer;
        let open = candidate & !take & !crossing.beside;
        if take.any() {
            rays.take(s, take, slot, &crossing, self.any);
        }
        if open.any() {
            self.settle(tree, [open.bits(), inside.bits()], (slot, facet), (rays, packet), umpire);
        }
        (take | open).any()
    }

    /// Decides what `f32` leaves open; some pass within all edges for certain.
    #[cold]
    #[inline(never)]
    fn settle<S: Simd>(
        &self,
        tree: &WideTree,
        [open, inside]: [u64; 2],
        (slot, facet): (u32, u32),
        (rays, packet): (&mut FanRays<S>, usize),
        umpire: &mut dyn Umpire,
    ) {
        let s = rays.slot.0.token();
        let corners = tree.triangle(slot);
        let plane = self.plane_of(&corners);
        let open = s.vectorize(
            #[inline(always)]
            || {
                let (open, inside) = (M::from_bits(s, open), M::from_bits(s, inside));
                let crossing = rays.cross(s, &plane);
                let take = open & inside & crossing.nearer;
                rays.take(s, take, slot, &crossing, self.any);
                (open & !take & !crossing.beside).bits()
            },
        );
        for lane in Bits(open) {
            let other = rays.slot.lane(lane);
            let held = (other != u32::MAX).then(|| tree.facet(other));
            if held == Some(facet) {
                continue;
            }
            rays.settled += 1;
            let edges = if inside >> lane & 1 == 1 { Edges::Inside } else { Edges::Open };
            let Some(t) = self.nearer(tree, (lane, edges), (slot, facet), (rays, packet), umpire) else {
                continue;
            };
            let z = t as f32 * rays.scale.lane(lane);
            rays.z.set(lane, z);
            rays.error.set(lane, z.abs() * (FAN_SLOPE + FAN_SLOPE));
            rays.slot.set(lane, slot);
            if self.any {
                rays.live = rays.live & !M::from_bits(s, 1 << lane);
            }
        }
    }

    /// The plane of a triangle from `f64`: bounds are relative to its normal, so thin triangles have no larger ones.
    pub(super) fn plane_of(&self, corners: &[[f32; 3]; 3]) -> Plane {
        let [u, v, z] = self.axes;
        let own = |p: &[f32; 3]| DVec3::new(p[u].into(), p[v].into(), p[z].into()) * f64::from(self.sign);
        let [a, b, c] = [own(&corners[0]), own(&corners[1]), own(&corners[2])];
        let (e, f, from) = (b - a, c - a, a - self.precise_apex);
        let normal = e.cross(f);
        let top = normal.dot(from);
        let length = e.abs().max(f.abs()).max_element();
        let [low, high] = self.widened([self.low, self.high]);
        let most = |axis: usize| f64::from(low[axis].abs().max(high[axis].abs()));
        let (size, spread) = (normal.abs(), DVec3::new(most(0), most(1), 1.0));
        let slope_error = f64::from(FAN_PLANE) * size.dot(spread)
            + f64::from(self.slope_error) * (size.x + size.y)
            + MEET_SLOPE_ERROR * spread.element_sum() * length * length;
        let top_error = f64::from(FAN_SLOPE) * top.abs()
            + f64::from(self.precise_slack) * size.element_sum()
            + MEET_TOP_ERROR * length * length * from.abs().max_element();
        let above = |error: f64| (error as f32).next_up() + f32::MIN_POSITIVE;
        Plane {
            normal: normal.as_vec3().to_array(),
            slope_error: above(slope_error),
            top: top as f32,
            top_error: above(top_error),
        }
    }
}

impl Fan {
    /// At which `t` the ray of a lane meets a triangle in front of all that it has met, if it does.
    fn nearer<S: Simd>(
        &self,
        tree: &WideTree,
        (lane, edges): (usize, Edges),
        (slot, facet): (u32, u32),
        (rays, packet): (&FanRays<S>, usize),
        umpire: &mut dyn Umpire,
    ) -> Option<f64> {
        let of_all = packet * F::<S>::LANES + lane;
        let (ray, span) = umpire.ray(of_all)?;
        let other = Some(rays.slot.lane(lane)).filter(|&slot| slot != u32::MAX);
        // Two roundings of a sum and a quotient, towards smaller numbers.
        let least = (rays.z.lane(lane) - rays.error.lane(lane)) * (1.0 - 4.0 * FAN_SLOPE);
        let before = if self.any { f64::INFINITY } else { f64::from(least / rays.scale.lane(lane)) };
        let (next, held) = (tree.triangle(slot), other.map(|slot| tree.triangle(slot)));
        match settle((&next, edges), held, before, (&ray, span)) {
            Settled::Not => None,
            Settled::Nearer(t) => Some(t),
            Settled::Open => umpire.decide(of_all, facet, other.map(|slot| tree.facet(slot))),
        }
    }
}
