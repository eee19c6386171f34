//! A packet of rays, and how the camera's packets are made.

use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, Ray};
use fearless_simd::Simd;

use crate::backend::Frame;
use crate::film::{BLOCK, BLOCK_PIXELS, NOTHING};
use crate::kernel::{Rays, magnitude};
use crate::lanes::{D, D3, F, F3, M, U, lane3, narrow3, splat_wide};
use crate::{Place, Tile};

/// One ray in every lane.
pub(super) struct Packet<S: Simd> {
    /// Origins, relative to the snapshot's.
    pub(super) origin: D3<S>,
    /// Directions of any length.
    pub(super) direction: D3<S>,
    /// The same rays as kernels see them.
    pub(super) rays: Rays<S>,
    /// 1 over the length of each direction.
    pub(super) inverse_length: F<S>,
    /// How much of the light that arrives counts, per channel.
    pub(super) weight: F3<S>,
    /// Pixel of each lane, by its place in the tile's columns.
    pub(super) pixel: U<S>,
    /// Shape that each ray leaves from, [`NOTHING`] for the camera.
    pub(super) left_prim: U<S>,
    /// Facet that each ray leaves from.
    pub(super) left_facet: U<S>,
    /// Whether any ray leaves a surface.
    pub(super) leaves: bool,
    /// Lanes that are rays at all.
    pub(super) live: M<S>,
}

impl<S: Simd> Packet<S> {
    /// The ray of a lane.
    #[inline(always)]
    pub(super) fn ray(&self, lane: usize) -> Ray {
        Ray::new(lane3(self.origin, lane), lane3(self.direction, lane))
    }

    /// Where the ray of a lane leaves from.
    #[inline(always)]
    pub(super) fn leaving(&self, lane: usize) -> Option<Place> {
        let prim = self.left_prim.lane(lane);
        (prim != NOTHING).then(|| Place { prim, facet: self.left_facet.lane(lane) })
    }

    /// Lanes whose rays leave from a facet of a shape.
    #[inline(always)]
    pub(super) fn leaving_from(&self, s: S, prim: u32, facet: u32) -> M<S> {
        if self.leaves { self.left_prim.is(prim) & self.left_facet.is(facet) } else { M::splat(s, false) }
    }
}

/// Rays as kernels see them, and 1 over the length of each direction.
#[inline(always)]
pub(super) fn kernel_rays<S: Simd>(s: S, origin: D3<S>, direction: D3<S>) -> (Rays<S>, F<S>) {
    let (origin, direction) = (narrow3(origin), narrow3(direction));
    let inverse_length = F::splat(s, 1.0) / direction.dot(direction).sqrt();
    let rays = Rays { origin, direction: direction.scale(inverse_length), reach: magnitude(origin) };
    (rays, inverse_length)
}

/// What the camera's packets of one tile have in common.
pub(super) struct Primary<S: Simd> {
    eye: D3<S>,
    /// Directions of the lanes of each part of a block, relative to the block's first pixel.
    within: [D3<S>; BLOCK_PIXELS / 4],
    /// Direction at the block at the tile's top left corner.
    corner: DVec3,
    across: DVec3,
    down: DVec3,
    blocks_across: u32,
    weight: F3<S>,
    /// 0, 1, 2 …
    counted: U<S>,
}

impl<S: Simd> Primary<S> {
    /// For the sample at a column and row of the grid within each pixel.
    #[inline(always)]
    pub(super) fn new(s: S, frame: &Frame<'_>, tile: &Tile, column: u32, row: u32) -> Self {
        let raster = &frame.raster;
        let share = |k: u32| (f64::from(k) + 0.5) / f64::from(frame.view.grid);
        let within = std::array::from_fn(|part| {
            let along = |axis: usize| {
                let mut lanes = [0.0; BLOCK_PIXELS];
                for (lane, v) in lanes.iter_mut().enumerate().take(F::<S>::LANES) {
                    let pixel = (part * F::<S>::LANES + lane) as u32 % BLOCK_PIXELS as u32;
                    let x = f64::from(pixel % BLOCK) + share(column);
                    let y = f64::from(pixel / BLOCK) + share(row);
                    *v = raster.across[axis] * x + raster.down[axis] * y;
                }
                D::load(s, &lanes)
            };
            D3::new(along(0), along(1), along(2))
        });
        Self {
            eye: splat_wide(s, raster.eye),
            within,
            corner: raster.corner + raster.across * f64::from(tile.x) + raster.down * f64::from(tile.y),
            across: raster.across * f64::from(BLOCK),
            down: raster.down * f64::from(BLOCK),
            blocks_across: tile.blocks_across(),
            weight: F3::splat(F::splat(s, 1.0)),
            counted: U::load(s, &std::array::from_fn::<u32, BLOCK_PIXELS, _>(|lane| lane as u32)),
        }
    }

    /// The packet at a place in the tile's columns, counted in packets.
    #[inline(always)]
    pub(super) fn packet(&self, s: S, tile: &Tile, at: u32) -> Packet<S> {
        let parts = (BLOCK_PIXELS / F::<S>::LANES) as u32;
        let (block, part) = (at / parts, at % parts);
        let (bx, by) = (block % self.blocks_across, block / self.blocks_across);
        let start = self.corner + self.across * f64::from(bx) + self.down * f64::from(by);
        let direction = splat_wide(s, start) + self.within[part as usize];
        let (rays, inverse_length) = kernel_rays(s, self.eye, direction);
        Packet {
            origin: self.eye,
            direction,
            rays,
            inverse_length,
            weight: self.weight,
            pixel: self.counted.plus(at * F::<S>::LANES as u32),
            left_prim: U::splat(s, NOTHING),
            left_facet: U::splat(s, 0),
            leaves: false,
            live: inside(s, tile, bx, by, part),
        }
    }
}

/// Which lanes lie within the picture.
#[inline(always)]
fn inside<S: Simd>(s: S, tile: &Tile, bx: u32, by: u32, part: u32) -> M<S> {
    let lanes = F::<S>::LANES;
    let (columns, rows) = (tile.width - bx * BLOCK, tile.height - by * BLOCK);
    if columns >= BLOCK && rows >= BLOCK {
        return M::splat(s, true);
    }
    let bits = (0..lanes)
        .map(|lane| (lane, part * lanes as u32 + lane as u32))
        .filter(|(_, pixel)| pixel % BLOCK < columns && pixel / BLOCK < rows)
        .fold(0_u64, |bits, (lane, _)| bits | 1 << lane);
    M::from_bits(s, bits)
}
