//! Where packets come from: the camera, pixel block by pixel block, or the stream of rays that surfaces sent on.

use std::ops::Range;

use catoptra_core::material::Footprint;
use catoptra_core::{Constant3, Lane, LaneMask};
use fearless_simd::Simd;

use super::{CameraPackets, Queue};
use crate::film::{BLOCK, BLOCK_PIXELS, NOTHING, store_finite};
use crate::lanes::{Column, F, F3, M, U, load3, magnitude, store3};
use crate::search::{Hits, Packet, PreciseRays};
use crate::{Region, Tile};

/// Packets that are traced together.
pub(crate) trait Batch<S: Simd> {
    /// The rays in `f64`.
    type Precise: PreciseRays<S>;

    /// How many stretches of rays there are.
    fn stretches(&self) -> u32;

    /// Places of the rays of a stretch, in whole packets.
    fn stretch(&self, stretch: u32) -> Range<usize>;

    /// How many rays there are.
    fn live(&self) -> u64;

    /// Whether the packet that starts with ray `at` is known to hold no ray.
    #[inline(always)]
    fn is_idle(&self, _at: usize) -> bool {
        false
    }

    /// Whether all rays start at one point.
    #[inline(always)]
    fn has_common_origin(&self) -> bool {
        false
    }

    /// The packet that starts with ray `at`.
    fn packet(&self, s: S, at: usize) -> Packet<'_, S, Self::Precise>;

    /// Which lanes of the packet that starts with ray `at` are rays at all.
    fn live_lanes(&self, s: S, at: usize) -> M<S>;

    /// How much of the light that arrives along the packet that starts with ray `at` counts, per channel.
    fn weights(&self, s: S, at: usize) -> F3<S>;

    /// Which rays of the packet that starts with ray `at` have the only direction there was, as those of the camera and
    /// mirrored ones; others were chosen among many.
    fn alone(&self, s: S, at: usize) -> M<S>;

    /// Whether the rays stand for squares of the picture; else they are lines of sight and no more.
    fn has_footprints(&self) -> bool;

    /// The squares that the rays of the packet that starts with ray `at` stand for; points where they stand for none.
    fn footprint(&self, s: S, at: usize) -> Footprint<F<S>>;

    /// Pixels of the packet that starts with ray `at`, by their places in the tile's columns.
    fn pixels(&self, s: S, at: usize) -> U<S>;

    /// Adds the light that arrives along the packet that starts with ray `at` to its pixels, and keeps what camera
    /// rays have met. Returns how many sums were not finite (stored as 0 or [`f32::MAX`]).
    fn add(&self, s: S, at: usize, best: &Hits<S>, light: F3<S>, tile: &mut Tile) -> u64;
}

/// The camera rays of a part of a tile.
pub(crate) struct Part<'a, S: Simd> {
    pub(crate) camera: &'a CameraPackets<'a, S>,
    /// Which part, from the tile's corner, in whole blocks.
    pub(crate) region: Region,
}

impl<S: Simd> Part<'_, S> {
    /// Fills the part with what rays show that meet nothing.
    #[inline(always)]
    pub(crate) fn fill(&self, s: S, background: &Constant3, tile: &mut Tile) {
        let (far, nothing) = (F::splat(s, f32::INFINITY), U::splat(s, NOTHING));
        let light = F3::of(far, background);
        for stretch in 0..self.stretches() {
            for at in self.stretch(stretch).step_by(F::<S>::LANES) {
                self.store(s, at, light, (far, nothing), tile);
            }
        }
    }

    #[inline(always)]
    fn store(&self, s: S, at: usize, light: F3<S>, (depth, prim): (F<S>, U<S>), tile: &mut Tile) -> u64 {
        let not_finite = store_sums(s, light, &mut tile.sums, at);
        if self.camera.is_kept() {
            depth.store(&mut tile.depth[at..]);
            prim.store(&mut tile.surface[at..]);
        }
        not_finite
    }
}

/// Stores sums of light, each by the rule of [`store_finite`]. Returns how many were not finite.
#[inline(always)]
fn store_sums<S: Simd>(s: S, light: F3<S>, sums: &mut [Column<f32>; 3], at: usize) -> u64 {
    store3(light, sums, at);
    // Where a number is not finite, their sum is not; the other way round it may be only their sum.
    let all_finite = magnitude(light).less(F::splat(s, f32::INFINITY));
    if (!all_finite).any() { store_one_by_one(light, sums, at) } else { 0 }
}

#[cold]
#[inline(never)]
fn store_one_by_one<S: Simd>(light: F3<S>, sums: &mut [Column<f32>; 3], at: usize) -> u64 {
    let mut not_finite = 0;
    for (pixels, light) in sums.iter_mut().zip([light.x, light.y, light.z]) {
        for (lane, pixel) in pixels[at..at + F::<S>::LANES].iter_mut().enumerate() {
            not_finite += store_finite(pixel, light.lane(lane));
        }
    }
    not_finite
}

impl<'a, S: Simd> Batch<S> for Part<'a, S> {
    type Precise = CameraPackets<'a, S>;

    #[inline(always)]
    fn stretches(&self) -> u32 {
        self.region.size.height.div_ceil(BLOCK)
    }

    #[inline(always)]
    fn stretch(&self, stretch: u32) -> Range<usize> {
        let first =
            (self.region.y / BLOCK + stretch) * self.camera.width.div_ceil(BLOCK) + self.region.x / BLOCK;
        let blocks = first as usize..(first + self.region.size.width.div_ceil(BLOCK)) as usize;
        blocks.start * BLOCK_PIXELS..blocks.end * BLOCK_PIXELS
    }

    #[inline(always)]
    fn live(&self) -> u64 {
        if !self.camera.is_masked() {
            return u64::from(self.region.size.width) * u64::from(self.region.size.height);
        }
        let packets = (0..self.stretches()).flat_map(|stretch| self.stretch(stretch).step_by(F::<S>::LANES));
        packets.map(|at| u64::from(self.camera.active(at))).sum()
    }

    #[inline(always)]
    fn is_idle(&self, at: usize) -> bool {
        self.camera.is_masked() && self.camera.active(at) == 0
    }

    #[inline(always)]
    fn has_common_origin(&self) -> bool {
        self.camera.start_at_the_eye()
    }

    #[inline(always)]
    fn packet(&self, s: S, at: usize) -> Packet<'_, S, Self::Precise> {
        self.camera.packet_at(s, at)
    }

    #[inline(always)]
    fn live_lanes(&self, s: S, at: usize) -> M<S> {
        self.camera.live_lanes(s, at)
    }

    #[inline(always)]
    fn weights(&self, s: S, _: usize) -> F3<S> {
        F3::splat(F::splat(s, 1.0))
    }

    #[inline(always)]
    fn alone(&self, s: S, _: usize) -> M<S> {
        M::splat(s, true)
    }

    #[inline(always)]
    fn has_footprints(&self) -> bool {
        self.camera.sides.is_some()
    }

    #[inline(always)]
    fn footprint(&self, s: S, at: usize) -> Footprint<F<S>> {
        self.camera.footprint(s, at)
    }

    #[inline(always)]
    fn pixels(&self, s: S, at: usize) -> U<S> {
        U::counted(s, at as u32)
    }

    #[inline(always)]
    fn add(&self, s: S, at: usize, best: &Hits<S>, light: F3<S>, tile: &mut Tile) -> u64 {
        let (most, infinite) = (F::splat(s, f32::MAX), F::splat(s, f32::INFINITY));
        self.store(s, at, light, (F::pick(best.t.less(most), best.t, infinite), best.prim), tile)
    }
}

impl<S: Simd> Batch<S> for Queue {
    type Precise = Self;

    #[inline(always)]
    fn stretches(&self) -> u32 {
        1
    }

    #[inline(always)]
    fn stretch(&self, _: u32) -> Range<usize> {
        0..self.len().next_multiple_of(F::<S>::LANES)
    }

    #[inline(always)]
    fn live(&self) -> u64 {
        self.len() as u64
    }

    #[inline(always)]
    fn packet(&self, s: S, at: usize) -> Packet<'_, S, Self> {
        self.packet_at(s, at)
    }

    #[inline(always)]
    fn live_lanes(&self, s: S, at: usize) -> M<S> {
        Queue::live_lanes(self, s, at)
    }

    #[inline(always)]
    fn weights(&self, s: S, at: usize) -> F3<S> {
        Queue::weights(self, s, at)
    }

    #[inline(always)]
    fn alone(&self, s: S, at: usize) -> M<S> {
        Queue::alone(self, s, at)
    }

    #[inline(always)]
    fn has_footprints(&self) -> bool {
        Queue::has_footprints(self)
    }

    #[inline(always)]
    fn footprint(&self, s: S, at: usize) -> Footprint<F<S>> {
        Queue::footprint(self, s, at)
    }

    #[inline(always)]
    fn pixels(&self, s: S, at: usize) -> U<S> {
        Queue::pixels(self, s, at)
    }

    /// No pixel has two rays in a stream.
    #[inline(always)]
    fn add(&self, s: S, at: usize, _: &Hits<S>, light: F3<S>, tile: &mut Tile) -> u64 {
        let (pixel, live, light) =
            (self.pixels(s, at), self.live_lanes(s, at), light.times(self.weights(s, at)));
        let first = pixel.lane(0);
        if (pixel.counts_from(s, first) & live).count() as usize == F::<S>::LANES {
            let sum = load3(s, &tile.sums, first as usize) + light;
            return store_sums(s, sum, &mut tile.sums, first as usize);
        }
        let mut not_finite = 0;
        for lane in live.lanes() {
            let pixel = pixel.lane(lane) as usize;
            for (pixels, light) in tile.sums.iter_mut().zip([light.x, light.y, light.z]) {
                let pixel = &mut pixels[pixel];
                not_finite += store_finite(pixel, *pixel + light.lane(lane));
            }
        }
        not_finite
    }
}
