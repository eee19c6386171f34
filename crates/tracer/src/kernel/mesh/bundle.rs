//! Which rays of a packet go through one point: those of a camera, and backwards those to a lamp.

use catoptra_core::glam::DVec3;
use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::fan::{Aim, Fan, FanRays};
use crate::lanes::{D, D3, F, M, U, splat_wide};
use crate::numeric::{FAN_SLOPE, FAN_SPREAD, FAN_WIDTH};

/// Rays as lines from a point each.
pub(crate) struct Lines<S: Simd> {
    pub(crate) origin: D3<S>,
    pub(crate) direction: D3<S>,
    pub(crate) live: M<S>,
    /// How far their origins may be off, beyond the roundings of `f64`.
    pub(crate) off: f32,
}

/// Slopes of lines through one point.
pub(crate) struct Slopes<S: Simd> {
    pub(crate) fan: Fan,
    u: F<S>,
    v: F<S>,
    /// Depth per length of a direction.
    pub(crate) scale: F<S>,
    /// How far the lines pass the point by.
    pub(crate) slack: f32,
}

impl<S: Simd> Lines<S> {
    /// Their slopes, if they go through one point and lie close enough together; for a mesh of that reach. Compiled
    /// apart.
    pub(crate) fn slopes(&self, s: S, reach: f32) -> Option<Slopes<S>> {
        s.vectorize(
            #[inline(always)]
            || self.slopes_here(s, reach),
        )
    }

    #[inline(always)]
    fn slopes_here(&self, s: S, reach: f32) -> Option<Slopes<S>> {
        let first = self.live.bits().trailing_zeros() as usize % F::<S>::LANES;
        let (apex, along) = (one(&self.origin, first), one(&self.direction, first));
        let aim = Aim::of(along);
        let [u, v, z] = aim.axes;
        let (du, dv) = (component(&self.direction, u), component(&self.direction, v));
        let dz = component(&self.direction, z);
        let depth = dz * D::splat(s, f64::from(aim.sign));
        let scale = depth.narrow();
        let (u, v) = ((du / dz).narrow(), (dv / dz).narrow());
        let apart = self.origin - splat_wide(s, apex);
        let apart = apart.x.abs().max(apart.y.abs()).max(apart.z.abs()).narrow();
        let off = F::pick(self.live, apart, F::splat(s, 0.0));
        let (u, v) = (held(s, self.live, u, first), held(s, self.live, v, first));
        let least = held(s, self.live, scale, first).0.reduce_min();
        let low = [u.0.reduce_min(), v.0.reduce_min()];
        let high = [u.0.reduce_max(), v.0.reduce_max()];
        let steepest = low[0].abs().max(low[1].abs()).max(high[0].abs()).max(high[1].abs());
        let slack = (off.0.reduce_max() + self.off) * (1.0 + FAN_SLOPE);
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        // Written so that NaN ends here.
        let through_one = slack <= FAN_SPREAD * least && least > 0.0;
        if !(through_one && steepest <= 1.5 && width <= FAN_WIDTH && height <= FAN_WIDTH) {
            return None;
        }
        let fan = Fan::new(&aim, apex, slack, [low, high], reach).with_slope_error(2.0 * slack / least);
        Some(Slopes { fan, u, v, scale, slack })
    }
}

impl<S: Simd> Slopes<S> {
    /// Error of the slopes where a point of each line is off by so much.
    #[inline(always)]
    pub(crate) fn slope_error(&self, s: S, off: F<S>, live: M<S>) -> f32 {
        // Both coordinates across and the depth, times a slope below 2, count; a quotient and a sum are rounded.
        let most = off * F::splat(s, 3.5) / self.scale;
        F::pick(live, most, F::splat(s, 0.0)).0.reduce_max()
    }

    /// The rays along the lines between two depths, each of which is known within a bound.
    #[inline(always)]
    pub(crate) fn rays(&self, s: S, begin: [F<S>; 2], end: [F<S>; 2], live: M<S>) -> FanRays<S> {
        FanRays {
            u: self.u,
            v: self.v,
            begin,
            z: end[0],
            error: end[1],
            slot: U::splat(s, u32::MAX),
            left: U::splat(s, u32::MAX),
            scale: self.scale,
            live,
        }
    }
}

/// The vector of one lane.
#[inline(always)]
fn one<S: Simd>(v: &D3<S>, lane: usize) -> DVec3 {
    DVec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane))
}

/// The lanes of a mask, the others as one of them.
#[inline(always)]
fn held<S: Simd>(s: S, mask: M<S>, v: F<S>, lane: usize) -> F<S> {
    F::pick(mask, v, F::splat(s, v.lane(lane)))
}

#[inline(always)]
fn component<S: Simd>(v: &D3<S>, axis: usize) -> D<S> {
    match axis {
        0 => v.x,
        1 => v.y,
        _ => v.z,
    }
}
