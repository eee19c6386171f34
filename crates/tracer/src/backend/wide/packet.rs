//! A packet of rays, and how the camera's packets are made.

use catoptra_core::{Lane, Ray};
use fearless_simd::Simd;

use crate::backend::Frame;
use crate::film::{BLOCK, BLOCK_PIXELS, NOTHING};
use crate::kernel::{Rays, magnitude};
use crate::lanes::{D, D3, F, F3, M, U, lane3, narrow3, splat_wide};
use crate::{Place, Tile};

/// One ray in every lane.
#[derive(Clone, Copy)]
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
    /// Where the rays leave from.
    pub(super) left: Left<S>,
    /// Lanes that are rays at all.
    pub(super) live: M<S>,
}

impl<S: Simd> Packet<S> {
    /// The ray of a lane.
    pub(super) fn ray(&self, lane: usize) -> Ray {
        Ray::new(lane3(self.origin, lane), lane3(self.direction, lane))
    }

    /// The place that the ray of a lane leaves from.
    pub(super) fn leaving(&self, lane: usize) -> Option<Place> {
        self.left.lane(lane)
    }
}

/// The places that the rays of a packet leave from.
#[derive(Clone, Copy)]
pub(super) struct Left<S: Simd> {
    /// Shape that each ray leaves from, [`NOTHING`] for the camera.
    pub(super) prim: U<S>,
    /// Facet that each ray leaves from.
    pub(super) facet: U<S>,
    /// Whether any ray leaves a surface.
    pub(super) any: bool,
}

impl<S: Simd> Left<S> {
    /// Rays that leave no surface.
    #[inline(always)]
    pub(super) fn nothing(s: S) -> Self {
        Self { prim: U::splat(s, NOTHING), facet: U::splat(s, 0), any: false }
    }

    /// Where the ray of a lane leaves from.
    pub(super) fn lane(&self, lane: usize) -> Option<Place> {
        let prim = self.prim.lane(lane);
        (prim != NOTHING).then(|| Place { prim, facet: self.facet.lane(lane) })
    }

    /// Lanes whose rays leave from a facet of a shape.
    #[inline(always)]
    pub(super) fn from(&self, s: S, prim: u32, facet: u32) -> M<S> {
        if self.any { self.prim.is(prim) & self.facet.is(facet) } else { M::splat(s, false) }
    }
}

/// Rays as kernels see them, and 1 over the length of each direction, unless that is known.
#[inline(always)]
pub(super) fn kernel_rays<S: Simd>(
    s: S,
    origin: D3<S>,
    direction: D3<S>,
    inverse_length: Option<F<S>>,
) -> (Rays<S>, F<S>) {
    let (origin, direction) = (narrow3(origin), narrow3(direction));
    let inverse_length = match inverse_length {
        Some(known) => known,
        None => F::splat(s, 1.0) / direction.dot(direction).sqrt(),
    };
    let rays = Rays { origin, direction: direction.scale(inverse_length), reach: magnitude(origin) };
    (rays, inverse_length)
}

/// What the camera's packets of one tile have in common.
pub(super) struct Primary<S: Simd> {
    eye: D3<S>,
    corner: D3<S>,
    across: D3<S>,
    down: D3<S>,
    /// Columns and rows of the lanes of each part of a block, in pixels from the block's corner.
    within: [(D<S>, D<S>); BLOCK_PIXELS / 4],
    left: u32,
    top: u32,
    width: u32,
    height: u32,
    pub(super) pixels: usize,
    /// Whether pixels hold nothing yet.
    pub(super) fresh: bool,
    weight: F3<S>,
}

/// The lanes' numbers.
static COUNTED: [u32; BLOCK_PIXELS] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

impl<S: Simd> Primary<S> {
    /// For the sample at a column and row of the grid within each pixel.
    #[inline(always)]
    pub(super) fn new(s: S, frame: &Frame<'_>, tile: &Tile, column: u32, row: u32) -> Self {
        let share = |k: u32| (f64::from(k) + 0.5) / f64::from(frame.view.grid);
        // A block and a bit, so that the last part can be loaded whole.
        let (mut columns, mut rows) = ([0.0; 2 * BLOCK_PIXELS], [0.0; 2 * BLOCK_PIXELS]);
        for pixel in 0..BLOCK_PIXELS {
            columns[pixel] = (pixel as u32 % BLOCK) as f64 + share(column);
            rows[pixel] = (pixel as u32 / BLOCK) as f64 + share(row);
        }
        let mut within = [(D::splat(s, 0.0), D::splat(s, 0.0)); BLOCK_PIXELS / 4];
        for (part, lanes) in within.iter_mut().enumerate().take(BLOCK_PIXELS / F::<S>::LANES) {
            let at = part * F::<S>::LANES;
            *lanes = (D::load(s, &columns[at..]), D::load(s, &rows[at..]));
        }
        let raster = &frame.raster;
        Self {
            eye: splat_wide(s, raster.eye),
            corner: splat_wide(s, raster.corner),
            across: splat_wide(s, raster.across),
            down: splat_wide(s, raster.down),
            within,
            left: tile.x,
            top: tile.y,
            width: tile.width,
            height: tile.height,
            pixels: tile.depth.len(),
            fresh: (column, row) == (0, 0),
            weight: F3::splat(F::splat(s, 1.0)),
        }
    }

    /// The packet at a place in the tile's columns. Its rays are those of [`Raster::ray`](catoptra_core::Raster::ray),
    /// bit for bit.
    #[inline(always)]
    pub(super) fn packet_at(&self, s: S, at: u32, inverse_length: Option<F<S>>) -> Packet<S> {
        let (block, part) = (at / BLOCK_PIXELS as u32, at % BLOCK_PIXELS as u32 / F::<S>::LANES as u32);
        let blocks_across = self.width.div_ceil(BLOCK);
        let (x, y) = (block % blocks_across * BLOCK, block / blocks_across * BLOCK);
        let (columns, rows) = self.within[part as usize];
        let columns = columns + D::splat(s, f64::from(self.left + x));
        let rows = rows + D::splat(s, f64::from(self.top + y));
        let direction = self.across.scale_add(columns, self.down.scale_add(rows, self.corner));
        let (rays, inverse_length) = kernel_rays(s, self.eye, direction, inverse_length);
        Packet {
            origin: self.eye,
            direction,
            rays,
            inverse_length,
            weight: self.weight,
            pixel: U::load(s, &COUNTED).plus(at),
            left: Left::nothing(s),
            live: inside(s, self.width - x, self.height - y, part),
        }
    }
}

/// Which lanes of a part of a block lie within the columns and rows that the picture has left.
#[inline(always)]
fn inside<S: Simd>(s: S, columns: u32, rows: u32, part: u32) -> M<S> {
    if columns >= BLOCK && rows >= BLOCK {
        return M::splat(s, true);
    }
    let lanes = F::<S>::LANES as u32;
    let mut bits = 0;
    for lane in 0..lanes {
        let pixel = part * lanes + lane;
        bits |= u64::from(pixel % BLOCK < columns && pixel / BLOCK < rows) << lane;
    }
    M::from_bits(s, bits)
}
