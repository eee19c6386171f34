//! Rays from the points of a packet to a lamp, one point of the lamp after another.
//!
//! The pixels of a block of the film send their rays to the same points, so that they walk meshes together as those to a point
//! light do: an eighth of the time of rays to points of each pixel's own, and the same error in each pixel. Points lie evenly
//! over the lamp's area; what the lamp would give if nothing blocked it is the control variate.

use catoptra_core::lobe::point_of_disk;
use catoptra_core::numeric::LAMP_POINT_ROUNDING;
use catoptra_core::{Arithmetic, Arrival, Lane, LaneMask};
use fearless_simd::Simd;

use super::Shader;
use super::direct_light::Facing;
use super::lamps::LitPacket;
use crate::cull::own_shape;
use crate::film::BLOCK;
use crate::kernel::Leaving;
use crate::lamps::{Half, half_of_ray, pair_of_lamp, share_seen};
use crate::lanes::{D, D3, F, F3, M, U, magnitude, narrow3, outlined, share_of_one, splat_wide, widen3};
use crate::numeric::DIRECTION_ERROR;
use crate::sampler::Sampler;
use crate::search::ToPoints;
use crate::snapshot::LampRow;
use crate::{LampLight, Tile};

/// Points of a lamp, one in every lane, relative to the snapshot's origin.
struct LampPoints<S: Simd> {
    at: D3<S>,
    /// Unit normals of the lamp there.
    normal: F3<S>,
}

impl LampRow {
    /// The points for two shares of 1, evenly over the area.
    #[inline(always)]
    fn points<S: Simd>(&self, s: S, [u, v]: [F<S>; 2]) -> LampPoints<S> {
        let one = F::splat(s, 1.0);
        if let Some(flat) = &self.flat {
            let corners = flat.corners();
            let last = corners[corners.len() - 1];
            let [along, up] = [corners[1] - corners[0], last - corners[0]].map(|edge| splat_wide(s, edge));
            let [first, second] = if corners.len() == 4 {
                [u, v]
            } else {
                let root = u.sqrt();
                [one - root, root * v]
            };
            let at = along.scale_add(first.widen(), up.scale_add(second.widen(), splat_wide(s, corners[0])));
            return LampPoints { at, normal: narrow3(splat_wide(s, flat.normal)) };
        }
        let (center, radius) = (splat_wide(s, self.ball.center), D::splat(s, self.ball.radius));
        let [x, y] = point_of_disk([u, v]);
        if let Some(normal) = self.normal {
            let (right, up) = normal.any_orthonormal_pair();
            let aside = splat_wide(s, right).scale(x.widen()) + splat_wide(s, up).scale(y.widen());
            return LampPoints {
                at: aside.scale_add(radius, center),
                normal: narrow3(splat_wide(s, normal)),
            };
        }
        // A disk is laid over the sphere: what is as far from its middle as 2 sin of half the angle from the pole.
        let square = x.mul_add(x, y * y).min(one);
        let wide = (one - square).sqrt() * F::splat(s, 2.0);
        let out = F3::new(x * wide, y * wide, F::splat(s, -2.0).mul_add(square, one));
        LampPoints { at: widen3(out).scale_add(radius, center), normal: out }
    }
}

impl LampRow {
    /// How far its points may be off, seen from there.
    #[inline(always)]
    fn rounding_seen_from<S: Simd>(&self, s: S, point: D3<S>) -> D<S> {
        let size = self.ball.center.abs().element_sum() + 3.0 * self.ball.radius;
        let size = magnitude(narrow3(point)).widen() + D::splat(s, size);
        // Points on a sphere are known as directions in `f32` are.
        let round = if self.normal.is_none() { self.ball.radius * f64::from(DIRECTION_ERROR) } else { 0.0 };
        size * D::splat(s, LAMP_POINT_ROUNDING) + D::splat(s, round)
    }
}

impl<S: Simd> Shader<'_, S> {
    /// Sends rays from some lanes to a lamp that would give them so much if nothing blocked it. Adds what glossy lobes show of
    /// it, and returns which share of that is seen.
    #[inline(always)]
    pub(super) fn cast(
        &mut self,
        at: &LitPacket<S>,
        lamp: &LampRow,
        number: usize,
        (lanes, unblocked): (M<S>, F<S>),
        tile: &Tile,
    ) -> F<S> {
        let s = self.s;
        let (zero, one) = (F::splat(s, 0.0), F::splat(s, 1.0));
        let smooth = self.search.snapshot.columns().smooth;
        let ground = self.chunk.normal[at.slot];
        let normal = if smooth { self.chunk.smooth[at.slot] } else { ground };
        let (sampler, count) = (self.block_sampler(at, tile), self.lamp_rays());
        let (first, pair) = (self.sample.index.wrapping_mul(count), pair_of_lamp(number, at.depth));
        let may_be_blocked = lamp.shadow && !self.plan.lamps[number].blockers.is_empty();
        let glossy = self.chunk.glossy[at.slot];
        let area = F::splat(s, (lamp.area / f64::from(count)) as f32);
        let off = lamp.rounding_seen_from(s, at.refined.point);
        let best = self.chunk.best[at.slot];
        let mut halves = [Half { open: zero, all: zero, brought: zero, total: zero }; 2];
        for k in 0..count {
            let (number_in_half, pair) = half_of_ray(first.wrapping_add(k), pair);
            let shares = sampler.pair(U::splat(s, number_in_half), pair).map(share_of_one);
            let points = lamp.points(s, shares);
            let way = narrow3(points.at - at.refined.point);
            let inverse = one / way.dot(way).sqrt();
            let (cosine, slope) = (way.dot(normal) * inverse, -(way.dot(points.normal) * inverse));
            let facing = if lamp.two_sided { slope.abs() } else { slope.max(zero) };
            let weight = cosine.max(zero) * facing * (inverse * inverse);
            let live = lanes & zero.less(weight);
            let above = live & zero.less(way.dot(ground));
            let mut reached = above;
            if may_be_blocked && above.any() {
                self.search.stats.rays.lamp += above.count();
                let share = off / way.dot(points.normal).abs().widen();
                let segments = ToPoints {
                    from: at.refined.point,
                    to: points.at,
                    end: (D::splat(s, 1.0_f64.next_down()) - share).max(D::splat(s, 0.0)),
                    leaving: Leaving { prim: best.prim, facet: best.facet, any: true },
                    arriving: own_shape(self.search.snapshot, lamp),
                };
                reached = above & !self.trace(&segments, above, number);
            }
            let half = &mut halves[(k % 2) as usize];
            half.all = half.all + F::pick(live, one, zero);
            half.open = half.open + F::pick(reached, one, zero);
            half.brought = half.brought + F::pick(reached, weight, zero);
            half.total = half.total + F::pick(live, weight, zero);
            if glossy {
                let arrival = Arrival {
                    direction: way.scale(inverse),
                    to_light: way,
                    inverse_distance: inverse,
                    distance: one / inverse,
                    strength: facing * (inverse * inverse) * area,
                    lit: live,
                };
                let facing = Facing { arrival, cosine, lanes: live };
                self.add_specular(at.slot, &facing, reached, F3::of(zero, &lamp.radiance));
            }
        }
        let of_lamp = area / unblocked;
        if self.gathers.paths || self.view.lamp_light == LampLight::PlainRays {
            return F::pick(lanes, (halves[0].brought + halves[1].brought) * of_lamp, zero);
        }
        share_seen(halves, of_lamp + of_lamp)
    }

    /// The lanes whose segments the blockers of a lamp block.
    #[inline(always)]
    fn trace(&mut self, segments: &ToPoints<S>, live: M<S>, number: usize) -> M<S> {
        let (search, among) = (&mut self.search, &self.plan.lamps[number].among);
        outlined(
            self.s,
            #[inline(always)]
            || search.blocked(segments, live, among),
        )
    }

    /// How many rays go to each lamp from a point.
    fn lamp_rays(&self) -> u32 {
        if self.gathers.paths { 1 } else { self.view.lamp_rays_of_sample() }
    }

    /// The random numbers of the blocks of the film that the lanes' pixels lie in; those of the pixels for paths, which do not
    /// run side by side.
    #[inline(always)]
    fn block_sampler(&self, at: &LitPacket<S>, tile: &Tile) -> Sampler<U<S>> {
        let side = if self.gathers.paths { 1 } else { BLOCK };
        self.sampler_of(at.pixels, self.chunk.lit[at.slot], side, tile)
    }
}
