//! Where packets come from: the camera, pixel block by pixel block, or the stream of rays that surfaces sent on.

use catoptra_core::Lane;
use fearless_simd::Simd;

use super::packet::{Packet, Primary};
use super::queue::Queue;
use crate::Tile;
use crate::lanes::{F, F3, U};

/// Packets that are traced together.
pub(super) trait Batch<S: Simd> {
    /// How many rays there are, in whole packets.
    fn rays(&self) -> usize;

    /// How many of them are rays at all.
    fn live(&self) -> u64;

    /// The packet that starts with ray `at`; its inverse lengths, if they are known from before.
    fn packet(&self, s: S, at: usize, inverse_length: Option<F<S>>) -> Packet<'_, S>;

    /// Adds the light of the packet that starts with ray `at` to its pixels.
    fn add(&self, s: S, at: usize, packet: &Packet<'_, S>, light: F3<S>, radiance: &mut [Vec<f32>; 3]);
}

impl<S: Simd> Batch<S> for Primary<S> {
    #[inline(always)]
    fn rays(&self) -> usize {
        self.pixels
    }

    #[inline(always)]
    fn live(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    #[inline(always)]
    fn packet(&self, s: S, at: usize, inverse_length: Option<F<S>>) -> Packet<'_, S> {
        self.packet_at(s, at, inverse_length)
    }

    #[inline(always)]
    fn add(&self, s: S, at: usize, _: &Packet<'_, S>, light: F3<S>, radiance: &mut [Vec<f32>; 3]) {
        for (pixels, light) in radiance.iter_mut().zip([light.x, light.y, light.z]) {
            let pixels = &mut pixels[at..];
            let light = if self.fresh { light } else { F::load(s, pixels) + light };
            light.store(pixels);
        }
    }
}

impl<S: Simd> Batch<S> for Queue {
    #[inline(always)]
    fn rays(&self) -> usize {
        self.len().next_multiple_of(F::<S>::LANES)
    }

    #[inline(always)]
    fn live(&self) -> u64 {
        self.len() as u64
    }

    #[inline(always)]
    fn packet(&self, s: S, at: usize, inverse_length: Option<F<S>>) -> Packet<'_, S> {
        self.packet_at(s, at, inverse_length)
    }

    /// No pixel has two rays in a stream.
    #[inline(always)]
    fn add(&self, s: S, _: usize, packet: &Packet<'_, S>, light: F3<S>, radiance: &mut [Vec<f32>; 3]) {
        let first = packet.pixel.lane(0);
        if (packet.pixel.counts_from(s, first) & packet.live).count() as usize == F::<S>::LANES {
            for (pixels, light) in radiance.iter_mut().zip([light.x, light.y, light.z]) {
                let pixels = &mut pixels[first as usize..];
                (F::load(s, pixels) + light).store(pixels);
            }
            return;
        }
        for lane in packet.live.lanes() {
            let pixel = packet.pixel.lane(lane) as usize;
            for (pixels, light) in radiance.iter_mut().zip([light.x, light.y, light.z]) {
                pixels[pixel] += light.lane(lane);
            }
        }
    }
}

/// What the rays of a batch have met, column by column.
#[derive(Default)]
pub(super) struct Found {
    pub(super) t: Vec<f32>,
    /// Bound on the error of `t`.
    pub(super) error: Vec<f32>,
    /// 1 over the length of each ray's direction.
    pub(super) inverse_length: Vec<f32>,
    pub(super) prim: Vec<u32>,
    pub(super) facet: Vec<u32>,
}

impl Found {
    /// Room for so many rays.
    pub(super) fn make_room(&mut self, rays: usize) {
        if self.t.len() < rays {
            self.t.resize(rays, 0.0);
            self.error.resize(rays, 0.0);
            self.inverse_length.resize(rays, 0.0);
            self.prim.resize(rays, 0);
            self.facet.resize(rays, 0);
        }
    }
}

/// Copies what the camera's rays have met into a tile.
#[inline(always)]
pub(super) fn keep<S: Simd>(s: S, tile: &mut Tile, found: &Found) {
    let (most, infinite) = (F::splat(s, f32::MAX), F::splat(s, f32::INFINITY));
    for at in (0..tile.depth.len()).step_by(F::<S>::LANES) {
        let t = F::load(s, &found.t[at..]);
        F::pick(t.less(most), t, infinite).store(&mut tile.depth[at..]);
        U::<S>::load(s, &found.prim[at..]).store(&mut tile.surface[at..]);
    }
}
