//! Ray bundles: finds out whether the rays of a group have a common origin, as those of a camera have, and backwards
//! those to a point light.

use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, LaneMask, Ray};
use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::bundle::Bundle;
use super::bundled_rays::BundledRays;
use super::common_origin::CommonOrigin;
use crate::lanes::{D, D3, F, LaneVectors, M, outlined, splat_wide, vector_of};
use crate::numeric::{BUNDLE_SLOPE, BUNDLE_SPREAD};

/// Rays of a packet as lines from a point each.
#[derive(Clone, Copy)]
pub(crate) struct Lines<S: Simd> {
    pub(crate) origin: D3<S>,
    pub(crate) direction: D3<S>,
    pub(crate) live: M<S>,
}

/// What the bounds of rays against a mesh grow with.
#[derive(Clone, Copy)]
pub(crate) struct Reach {
    /// How far origins may be off in the mesh's own space, beyond the roundings of `f64`.
    pub(crate) off: f32,
    /// The largest coordinate of the mesh.
    pub(crate) mesh: f32,
}

/// A bundle of rays with a common origin.
pub(crate) struct RayBundle {
    pub(crate) common_origin: Bundle<CommonOrigin>,
    /// How far the lines pass the common origin by.
    pub(crate) slack: f32,
}

impl RayBundle {
    /// Of the lines of some packets, if they have a common origin and run mostly along the same axis. Stores the lines'
    /// slopes in `rays`. See [`outlined`].
    #[inline(always)]
    pub(crate) fn of<S: Simd>(
        s: S,
        rays: &mut [BundledRays<S>],
        lines: impl Fn(usize) -> Lines<S>,
        reach: Reach,
    ) -> Option<Self> {
        outlined(
            s,
            #[inline(always)]
            || Self::of_here(s, rays, lines, reach),
        )
    }

    #[inline(always)]
    fn of_here<S: Simd>(
        s: S,
        rays: &mut [BundledRays<S>],
        lines: impl Fn(usize) -> Lines<S>,
        reach: Reach,
    ) -> Option<Self> {
        let (first, (origin, along)) =
            (0..rays.len()).find_map(|packet| Some((packet, lines(packet).first()?)))?;
        let aim = Aim::of(along);
        // Where there is no common origin, the first packet mostly shows it, before the others are set up.
        if lines(first).astray(s, &aim, origin).1.any() {
            return None;
        }
        let model = aim.slopes_of(s, along);
        let (mut apart, mut least) = (F::splat(s, 0.0), model[2]);
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for (packet, rays) in rays.iter_mut().enumerate() {
            let lines = lines(packet);
            rays.follow(s, &aim, &lines, model);
            let (from, astray) = lines.astray(s, &aim, origin);
            apart = F::pick(lines.live, apart.max(from), apart);
            // Written so that NaN counts.
            if (astray | (lines.live & !rays.are_small(s))).any() {
                return None;
            }
            least = least.min(rays.scale);
            for axis in 0..2 {
                low[axis] = low[axis].min(rays.around[0][axis]);
                high[axis] = high[axis].max(rays.around[1][axis]);
            }
        }
        let least = least.0.reduce_min();
        let slack = (apart.0.reduce_max() + reach.off) * (1.0 + BUNDLE_SLOPE);
        let through_one = slack <= BUNDLE_SPREAD * least && least > 0.0;
        if !through_one {
            return None;
        }
        let common_origin = Bundle::through(&aim, origin, slack, [low, high], reach.mesh)
            .with_slopes_off(2.0 * slack / least);
        Some(Self { common_origin, slack })
    }
}

/// The main axis of rays: the one that they mostly run along, and their sign there.
pub(crate) struct Aim {
    pub(crate) axes: [usize; 3],
    pub(crate) sign: f32,
}

impl Aim {
    /// The axis along which a direction is longest, and its sign there.
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

    /// Slopes and depth per length of one direction, in every lane.
    #[inline(always)]
    fn slopes_of<S: Simd>(&self, s: S, direction: DVec3) -> [F<S>; 3] {
        let [u, v, z] = self.axes;
        let (du, dv, dz) = (direction[u], direction[v], direction[z]);
        let depth = dz * f64::from(self.sign);
        [F::splat(s, (du / dz) as f32), F::splat(s, (dv / dz) as f32), F::splat(s, depth as f32)]
    }
}

impl<S: Simd> Lines<S> {
    /// Gathered one by one for some lanes; lanes without a ray are not live.
    #[inline(always)]
    pub(crate) fn gathered(s: S, lanes: M<S>, mut ray: impl FnMut(usize) -> Option<Ray>) -> Self {
        let (mut origins, mut directions, mut live) = (LaneVectors::default(), LaneVectors::default(), 0);
        for lane in lanes.lanes() {
            let Some(ray) = ray(lane) else { continue };
            origins.set(lane, ray.origin);
            directions.set(lane, ray.direction);
            live |= 1 << lane;
        }
        Self { origin: origins.load(s), direction: directions.load(s), live: M::from_bits(s, live) }
    }

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

    /// How far from a point they begin, and which of them begin too far from it for a bundle; those of NaN as well.
    #[inline(always)]
    fn astray(&self, s: S, aim: &Aim, origin: DVec3) -> (F<S>, M<S>) {
        let from = self.origin - splat_wide(s, origin);
        let from = from.x.abs().max(from.y.abs()).max(from.z.abs()).narrow();
        let spread = self.depths(s, aim) * F::splat(s, 2.0 * BUNDLE_SPREAD);
        (from, self.live & !from.less(spread))
    }
}

impl<S: Simd> BundledRays<S> {
    /// Takes over the live lines; other lanes get the slopes of a model.
    #[inline(always)]
    fn follow(&mut self, s: S, aim: &Aim, lines: &Lines<S>, model: [F<S>; 3]) {
        let [u, v, z] = aim.axes;
        let (du, dv) = (component(&lines.direction, u), component(&lines.direction, v));
        let dz = component(&lines.direction, z);
        let (live, inverse) = (lines.live, D::splat(s, 1.0) / dz);
        self.u = F::pick(live, (du * inverse).narrow(), model[0]);
        self.v = F::pick(live, (dv * inverse).narrow(), model[1]);
        self.scale = F::pick(live, lines.depths(s, aim), model[2]);
        self.live = live;
        let (u, v) = (self.u.0, self.v.0);
        self.around = [[u.reduce_min(), v.reduce_min()], [u.reduce_max(), v.reduce_max()]];
    }
}

/// A vector's component along an axis.
#[inline(always)]
pub(super) fn component<S: Simd>(v: &D3<S>, axis: usize) -> D<S> {
    match axis {
        0 => v.x,
        1 => v.y,
        _ => v.z,
    }
}
