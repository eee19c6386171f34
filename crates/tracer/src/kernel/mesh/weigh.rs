//! Which rays of a packet through one point meet a triangle in front of all that they have met.

use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::edges::Prepared;
use super::{Edges, Fan, FanRays, Settled, Umpire, settle};
use crate::accel::{WIDTH, WideTree};
use crate::kernel::bound;
use crate::lanes::{Bits, F, M, U};
use crate::numeric::FAN_SLOPE;

impl<S: Simd> FanRays<S> {
    /// Scalar products of a vector and the directions.
    #[inline(always)]
    fn value(&self, s: S, n: &[[f32; WIDTH]; 3], at: usize) -> F<S> {
        let (x, y, z) = (F::splat(s, n[0][at]), F::splat(s, n[1][at]), F::splat(s, n[2][at]));
        self.u.mul_add(x, self.v.mul_add(y, z))
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
        let [a, b, c] = &prepared.edges;
        let (a, b, c) = (rays.value(s, a, at), rays.value(s, b, at), rays.value(s, c, at));
        let error = bound(s, F::splat(s, prepared.edge_error[at]));
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let candidate = rays.live & !(low.less(-error) & error.less(high)) & !rays.left.is(facet);
        if !candidate.any() {
            return false;
        }
        let inside = error.less(low) | high.less(-error);
        let slope = rays.value(s, &prepared.normal, at);
        let slope_error = bound(s, F::splat(s, prepared.slope_error[at]));
        let inverse = F::splat(s, 1.0) / slope;
        let z = F::splat(s, prepared.top[at]) * inverse;
        let doubt = z.abs().mul_add(slope_error, F::splat(s, prepared.top_error[at])) * inverse.abs();
        // Three quarters of a slope that is certain are certain; and a few roundings of z.
        let z_error = bound(s, z.abs().mul_add(F::splat(s, FAN_SLOPE + FAN_SLOPE), doubt * F::splat(s, 1.5)));
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
            self.settle(tree, [open.bits(), inside.bits()], (slot, facet), (rays, packet), umpire);
        }
        (take | open).any()
    }

    /// Decides lane by lane what `f32` leaves open; some pass within all edges for certain.
    #[cold]
    #[inline(never)]
    fn settle<S: Simd>(
        &self,
        tree: &WideTree,
        [lanes, inside]: [u64; 2],
        (slot, facet): (u32, u32),
        (rays, packet): (&mut FanRays<S>, usize),
        umpire: &mut dyn Umpire,
    ) {
        for lane in Bits(lanes) {
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
