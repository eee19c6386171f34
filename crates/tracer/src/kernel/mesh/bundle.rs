//! Which rays of a group go through one point: those of a camera, and backwards those to a lamp.

use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::fan::{Aim, Fan, FanRays};
use crate::lanes::{D, D3, F, M, U, splat_wide, vector_of};
use crate::numeric::{FAN_SLOPE, FAN_SPREAD, FAN_WIDTH};

/// Rays of a packet as lines from a point each.
#[derive(Clone, Copy)]
pub(crate) struct Lines<S: Simd> {
    pub(crate) origin: D3<S>,
    pub(crate) direction: D3<S>,
    pub(crate) live: M<S>,
}

/// Packets of lines through one point, up to so many.
pub(crate) struct Bundle<S: Simd, const MOST: usize> {
    pub(crate) fan: Fan,
    slopes: [Slopes<S>; MOST],
    /// How far the lines pass the point by.
    pub(crate) slack: f32,
}

/// Slopes of a packet of lines; lanes that are none repeat one that is.
#[derive(Clone, Copy)]
pub(crate) struct Slopes<S: Simd> {
    u: F<S>,
    v: F<S>,
    /// Depth per length of a direction.
    pub(crate) scale: F<S>,
    live: M<S>,
    /// Box round the slopes.
    around: [[f32; 2]; 2],
}

impl<S: Simd, const MOST: usize> Bundle<S, MOST> {
    /// Of so many packets, if their lines go through one point and lie close enough together; for a mesh of that reach.
    /// Origins may be `off` by so much, beyond the roundings of `f64`. Compiled apart.
    #[inline(always)]
    pub(crate) fn of(
        s: S,
        packets: usize,
        lines: impl Fn(usize) -> Lines<S>,
        reach: (f32, f32),
    ) -> Option<Self> {
        s.vectorize(
            #[inline(always)]
            || Self::of_here(s, packets, lines, reach),
        )
    }

    #[inline(always)]
    fn of_here(
        s: S,
        packets: usize,
        lines: impl Fn(usize) -> Lines<S>,
        (off, reach): (f32, f32),
    ) -> Option<Self> {
        let (first, (apex, along)) =
            (0..packets).find_map(|packet| Some((packet, lines(packet).first()?)))?;
        let aim = Aim::of(along);
        // Where nothing goes together, the first packet mostly tells, before all that is to be kept of others.
        if lines(first).astray(s, &aim, apex).1.any() {
            return None;
        }
        let mut slopes = [Slopes::along(s, &aim, along); MOST];
        let (mut apart, mut least) = (F::splat(s, 0.0), slopes[0].scale);
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for (packet, slopes) in slopes.iter_mut().enumerate().take(packets) {
            let lines = lines(packet);
            slopes.become_those_of(s, &aim, &lines);
            let (from, astray) = lines.astray(s, &aim, apex);
            apart = F::pick(lines.live, apart.max(from), apart);
            // Written so that NaN counts.
            if (astray | (lines.live & !slopes.are_small(s))).any() {
                return None;
            }
            least = least.min(slopes.scale);
            for axis in 0..2 {
                low[axis] = low[axis].min(slopes.around[0][axis]);
                high[axis] = high[axis].max(slopes.around[1][axis]);
            }
        }
        let least = least.0.reduce_min();
        let slack = (apart.0.reduce_max() + off) * (1.0 + FAN_SLOPE);
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        let through_one = slack <= FAN_SPREAD * least && least > 0.0;
        if !(through_one && width <= FAN_WIDTH && height <= FAN_WIDTH) {
            return None;
        }
        let fan = Fan::new(&aim, apex, slack, [low, high], reach).with_slope_error(2.0 * slack / least);
        Some(Self { fan, slopes, slack })
    }

    /// The slopes of a packet.
    #[inline(always)]
    pub(crate) fn slopes(&self, packet: usize) -> &Slopes<S> {
        &self.slopes[packet % MOST]
    }
}

impl<S: Simd> Lines<S> {
    /// Origin and direction of the first of them.
    #[inline(always)]
    fn first(&self) -> Option<(DVec3, DVec3)> {
        let lane = self.live.lanes().next()?;
        Some((vector_of(&self.origin, lane), vector_of(&self.direction, lane)))
    }

    /// Depth per length of each direction.
    #[inline(always)]
    fn depths(&self, s: S, aim: &Aim) -> F<S> {
        (component(&self.direction, aim.axes[2]) * D::splat(s, f64::from(aim.sign))).narrow()
    }

    /// How far from a point they begin, and which of them too far from it to go together; those of NaN as well.
    #[inline(always)]
    fn astray(&self, s: S, aim: &Aim, apex: DVec3) -> (F<S>, M<S>) {
        let from = self.origin - splat_wide(s, apex);
        let from = from.x.abs().max(from.y.abs()).max(from.z.abs()).narrow();
        let spread = self.depths(s, aim) * F::splat(s, 2.0 * FAN_SPREAD);
        (from, self.live & !from.less(spread))
    }
}

impl<S: Simd> Slopes<S> {
    /// Of one line in every lane.
    #[inline(always)]
    fn along(s: S, aim: &Aim, direction: DVec3) -> Self {
        let [u, v, z] = aim.axes;
        let (du, dv, dz) = (direction[u], direction[v], direction[z]);
        let slope = [(du / dz) as f32, (dv / dz) as f32];
        Self {
            u: F::splat(s, slope[0]),
            v: F::splat(s, slope[1]),
            scale: F::splat(s, (dz * f64::from(aim.sign)) as f32),
            live: M::splat(s, false),
            around: [slope, slope],
        }
    }

    /// Takes over the lines that are any.
    #[inline(always)]
    fn become_those_of(&mut self, s: S, aim: &Aim, lines: &Lines<S>) {
        let [u, v, z] = aim.axes;
        let (du, dv) = (component(&lines.direction, u), component(&lines.direction, v));
        let dz = component(&lines.direction, z);
        let (live, inverse) = (lines.live, D::splat(s, 1.0) / dz);
        self.u = F::pick(live, (du * inverse).narrow(), self.u);
        self.v = F::pick(live, (dv * inverse).narrow(), self.v);
        self.scale = F::pick(live, lines.depths(s, aim), self.scale);
        self.live = live;
        let (u, v) = (self.u.0, self.v.0);
        self.around = [[u.reduce_min(), v.reduce_min()], [u.reduce_max(), v.reduce_max()]];
    }

    /// Whether a line runs more along the main axis than across it, or nearly so.
    #[inline(always)]
    fn are_small(&self, s: S) -> M<S> {
        let most = F::splat(s, 1.5);
        self.u.abs().less(most) & self.v.abs().less(most)
    }

    /// Error of the slopes where a point of each line is off by so much.
    #[inline(always)]
    pub(crate) fn error_where_off(&self, s: S, off: F<S>) -> f32 {
        // Both coordinates across and the depth, times a slope below 2, count; a quotient and a sum are rounded.
        let most = off * F::splat(s, 3.5) / self.scale;
        F::pick(self.live, most, F::splat(s, 0.0)).0.reduce_max()
    }

    /// The rays along the lines between two depths, each of which is known within a bound.
    #[inline(always)]
    pub(crate) fn rays(&self, s: S, begin: [F<S>; 2], end: [F<S>; 2]) -> FanRays<S> {
        FanRays {
            u: self.u,
            v: self.v,
            slopes: self.around,
            begin,
            z: end[0],
            error: end[1],
            slot: U::splat(s, u32::MAX),
            left: U::splat(s, u32::MAX),
            scale: self.scale,
            live: self.live,
            settled: 0,
        }
    }
}

#[inline(always)]
fn component<S: Simd>(v: &D3<S>, axis: usize) -> D<S> {
    match axis {
        0 => v.x,
        1 => v.y,
        _ => v.z,
    }
}
