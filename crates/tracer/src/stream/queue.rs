//! The rays of a stream, gathered lane by lane and handed out in full packets.

use catoptra_core::glam::DVec3;
use catoptra_core::material::Footprint;
use catoptra_core::{Lane, Ray, Span};
use fearless_simd::Simd;

use crate::SurfaceId;
use crate::edges::Places;
use crate::film::NOTHING;
use crate::frame::Frame;
use crate::kernel::{Leaving, Rays, Target};
use crate::lanes::{
    Column, D, D3, F, F3, M, U, Word, compress_wide3, compress3, load_wide3, load3, narrow3, splat_wide,
    store_wide3, store3,
};
use crate::numeric::{END_ERROR, POINT_ERROR};
use crate::search::{Packet, PreciseRays, ShadowRays, drift, nearly_unit_rays};

/// Columns of rays; each has room for one more packet than there are rays.
#[derive(Default)]
pub(crate) struct Queue {
    length: usize,
    /// Where in the snapshot's frame coordinates are zero.
    zero: DVec3,
    /// How far every ray is followed, in lengths of its direction.
    far: f64,
    origin: [Column<f64>; 3],
    /// Of unit length, up to rounding in `f32`.
    direction: [Column<f64>; 3],
    weight: [Column<f32>; 3],
    pixel: Column<u32>,
    prim: Column<u32>,
    facet: Column<u32>,
    /// 1 where the direction was the only one there was, 0 where it was chosen among many.
    alone: Column<u32>,
    /// Of camera rays: what a pixel to the right and down adds to the directions that theirs were made from, and the sides of
    /// the squares that they stand for, in such pixels over the lengths of those directions.
    axes: Option<[DVec3; 2]>,
    side: Column<f32>,
}

/// Rays that are to be queued.
pub(crate) struct QueuedRays<S: Simd> {
    pub(crate) origin: D3<S>,
    /// Of unit length, up to rounding in `f32`.
    pub(crate) direction: D3<S>,
    pub(crate) weight: F3<S>,
    pub(crate) pixel: U<S>,
    pub(crate) prim: U<S>,
    pub(crate) facet: U<S>,
}

impl Queue {
    /// How many rays there are.
    pub(crate) fn len(&self) -> usize {
        self.length
    }

    /// Removes all rays; those to come are relative to `zero`, a point of the snapshot's frame, and followed up to `far`.
    pub(crate) fn start(&mut self, zero: DVec3, far: f64) {
        (self.length, self.zero, self.far, self.axes) = (0, zero, far, None);
    }

    /// Removes all rays and keeps the room.
    pub(crate) fn clear(&mut self) {
        self.length = 0;
    }

    /// Appends camera rays through places of the picture. They leave no surface, and the pixel of each is its number.
    #[inline(always)]
    pub(crate) fn push_camera_rays<S: Simd>(&mut self, s: S, frame: &Frame<'_>, places: &Places) {
        let raster = &frame.raster;
        let (origin, corner) = (splat_wide(s, frame.eye), splat_wide(s, raster.corner));
        let (across, down) = (splat_wide(s, raster.across), splat_wide(s, raster.down));
        self.axes = Some([raster.across, raster.down]);
        let count = places.len();
        self.side.resize(count.next_multiple_of(F::<S>::LANES), 0.0);
        for at in (0..count).step_by(F::<S>::LANES) {
            let (x, y) = (D::load(s, &places.x[at..]), D::load(s, &places.y[at..]));
            let direction = across.scale_add(x, down.scale_add(y, corner));
            let length = narrow3(direction);
            let inverse = F::splat(s, 1.0) / length.dot(length).sqrt();
            (D::load(s, &places.side[at..]).narrow() * inverse).store(&mut self.side[at..]);
            let rays = QueuedRays {
                origin,
                direction: direction.scale(inverse.widen()),
                weight: F3::splat(F::splat(s, 1.0)),
                pixel: U::counted(s, at as u32),
                prim: U::splat(s, NOTHING),
                facet: U::splat(s, 0),
            };
            let left = (count - at).min(F::<S>::LANES);
            self.push(M::from_bits(s, u64::MAX >> (64 - left)), &rays);
        }
    }

    /// Whether the rays are the camera's.
    #[inline(always)]
    pub(crate) fn has_footprints(&self) -> bool {
        self.axes.is_some()
    }

    /// The squares that camera rays stand for.
    #[inline(always)]
    pub(crate) fn footprint<S: Simd>(&self, s: S, at: usize) -> Footprint<F<S>> {
        let [across, down] = self.axes.unwrap_or_default();
        let (across, down) = (narrow3(splat_wide(s, across)), narrow3(splat_wide(s, down)));
        let side = F::load(s, &self.side[at..]);
        let (_, direction) = self.precise(s, at);
        Footprint { direction: narrow3(direction), sides: [across.scale(side), down.scale(side)] }
    }

    /// Appends the lanes where the mask holds.
    #[inline(always)]
    pub(crate) fn push<S: Simd>(&mut self, mask: M<S>, rays: &QueuedRays<S>) {
        self.make_room(F::<S>::LANES);
        let (at, count) = (self.length, mask.count() as usize);
        self.length += count;
        if count == F::<S>::LANES {
            store_wide3(rays.origin, &mut self.origin, at);
            store_wide3(rays.direction, &mut self.direction, at);
            store3(rays.weight, &mut self.weight, at);
            rays.pixel.store(&mut self.pixel[at..]);
            rays.prim.store(&mut self.prim[at..]);
            rays.facet.store(&mut self.facet[at..]);
        } else {
            compress_wide3(rays.origin, mask, &mut self.origin, at);
            compress_wide3(rays.direction, mask, &mut self.direction, at);
            store3(compress3(rays.weight, mask), &mut self.weight, at);
            rays.pixel.compressed(mask).store(&mut self.pixel[at..]);
            rays.prim.compressed(mask).store(&mut self.prim[at..]);
            rays.facet.compressed(mask).store(&mut self.facet[at..]);
        }
    }

    /// The same, and says which lanes have the only direction there was: asked of [paths](crate::shade::Gathers::paths) alone.
    #[inline(always)]
    pub(crate) fn push_chosen<S: Simd>(&mut self, mask: M<S>, rays: &QueuedRays<S>, alone: M<S>) {
        let at = self.length;
        self.push(mask, rays);
        let (one, none) = (rays.pixel.of(1), rays.pixel.of(0));
        U::pick(alone, one, none).compressed(mask).store(&mut self.alone[at..]);
    }

    /// Appends a ray of the snapshot's frame, whose direction has unit length.
    pub(crate) fn push_one<S: Simd>(&mut self, ray: &Ray, leaving: Option<SurfaceId>, pixel: u32) {
        self.make_room(F::<S>::LANES);
        let at = self.length;
        self.length += 1;
        let start = (ray.origin - self.zero).to_array();
        for (axis, (start, along)) in start.into_iter().zip(ray.direction.to_array()).enumerate() {
            (self.origin[axis][at], self.direction[axis][at]) = (start, along);
            self.weight[axis][at] = 1.0;
        }
        (self.pixel[at], self.alone[at]) = (pixel, 1);
        (self.prim[at], self.facet[at]) =
            leaving.map_or((NOTHING, 0), |surface| (surface.prim, surface.facet));
    }

    /// The packet that starts with ray `at`.
    #[inline(always)]
    pub(crate) fn packet_at<S: Simd>(&self, s: S, at: usize) -> Packet<'_, S, Self> {
        let (origin, direction) = self.precise(s, at);
        let (rays, inverse_length) = nearly_unit_rays(s, narrow3(origin), narrow3(direction));
        let reach = rays.reach + F::splat(s, drift(self.zero));
        Packet {
            precise: self,
            at,
            rays: Rays { reach, ..rays },
            inverse_length,
            leaving: Leaving {
                prim: U::load(s, &self.prim[at..]),
                facet: U::load(s, &self.facet[at..]),
                any: true,
            },
            live: self.live_lanes(s, at),
        }
    }

    /// The rays of a packet as segments for occlusion tests.
    #[inline(always)]
    pub(crate) fn shadow_rays<S: Simd>(&self, s: S, packet: &Packet<'_, S, Self>) -> ShadowRays<'static, S> {
        // Lengths are off by a share of themselves, as are those of directions.
        let off = if self.far.is_finite() { self.far as f32 * (END_ERROR / POINT_ERROR) } else { 0.0 };
        ShadowRays {
            rays: packet.rays.drifting(F::splat(s, off)),
            leaving: packet.leaving,
            live: packet.live,
            target: Target { distance: F::splat(s, self.far as f32), end: None },
            behind: &[],
        }
    }

    /// Which lanes from ray `at` on are rays.
    #[inline(always)]
    pub(crate) fn live_lanes<S: Simd>(&self, s: S, at: usize) -> M<S> {
        let (lanes, remaining) = (F::<S>::LANES, self.length - at);
        M::from_bits(s, if remaining >= lanes { u64::MAX >> (64 - lanes) } else { (1 << remaining) - 1 })
    }

    /// How much of the light along the rays from `at` on counts.
    #[inline(always)]
    pub(crate) fn weights<S: Simd>(&self, s: S, at: usize) -> F3<S> {
        load3(s, &self.weight, at)
    }

    /// Which of the rays from `at` on have the only direction there was.
    #[inline(always)]
    pub(crate) fn alone<S: Simd>(&self, s: S, at: usize) -> M<S> {
        U::load(s, &self.alone[at..]).is(1)
    }

    /// The pixels of the rays from `at` on.
    #[inline(always)]
    pub(crate) fn pixels<S: Simd>(&self, s: S, at: usize) -> U<S> {
        U::load(s, &self.pixel[at..])
    }

    /// Room for another packet beyond the rays there are and the one that is stored whole.
    #[inline(always)]
    fn make_room(&mut self, lanes: usize) {
        let needed = self.length + 2 * lanes;
        if self.pixel.len() >= needed {
            return;
        }
        let room = needed.next_power_of_two();
        self.origin.iter_mut().chain(&mut self.direction).for_each(|c| c.resize(room, 0.0));
        self.weight.iter_mut().for_each(|c| c.resize(room, 0.0));
        let whole = [&mut self.pixel, &mut self.prim, &mut self.facet, &mut self.alone];
        whole.into_iter().for_each(|c| c.resize(room, 0));
    }
}

impl<S: Simd> PreciseRays<S> for Queue {
    const UNIT: bool = true;
    const FROM_ORIGIN: bool = true;

    fn ray(&self, at: usize) -> Ray {
        let vector = |[x, y, z]: &[Column<f64>; 3]| DVec3::new(x[at], y[at], z[at]);
        Ray::new(vector(&self.origin) + self.zero, vector(&self.direction))
    }

    fn span(&self, _at: usize) -> Span {
        Span::until(self.far)
    }

    #[inline(always)]
    fn precise(&self, s: S, at: usize) -> (D3<S>, D3<S>) {
        (load_wide3(s, &self.origin, at), load_wide3(s, &self.direction, at))
    }

    #[inline(always)]
    fn ends(&self, s: S, at: usize) -> [D3<S>; 2] {
        let (origin, direction) = self.precise(s, at);
        [origin, direction.scale_add(D::splat(s, self.far), origin)]
    }
}
