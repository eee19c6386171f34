//! A packet of rays, and how the camera's packets are made.

use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, Raster, Ray, Span};
use fearless_simd::Simd;

use super::ask::Asked;
use super::queue::Queue;
use crate::backend::Frame;
use crate::film::{BLOCK, BLOCK_PIXELS, NOTHING};
use crate::kernel::{Rays, magnitude};
use crate::lanes::{D, D3, F, F3, M, U, narrow3, splat_wide};
use crate::numeric::WORLD_DRIFT;
use crate::{Place, Tile};

/// One ray in every lane.
#[derive(Clone, Copy)]
pub(super) struct Packet<'a, S: Simd> {
    /// The rays in `f64`.
    pub(super) precise: Precise<'a, S>,
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

impl<S: Simd> Packet<'_, S> {
    /// The ray of a lane, in the snapshot's frame.
    pub(super) fn ray(&self, lane: usize) -> Ray {
        match self.precise {
            Precise::Camera(primary, at) => primary.ray(at + lane),
            Precise::Stream(queue, at) => queue.ray(at + lane),
            Precise::Asked(asked, at) => asked.ray(at + lane),
        }
    }

    /// The stretch that the ray of a lane is followed on.
    pub(super) fn span(&self, lane: usize) -> Span {
        match self.precise {
            Precise::Camera(..) | Precise::Stream(..) => Span::AHEAD,
            Precise::Asked(asked, at) => asked.span(at + lane),
        }
    }

    /// The place that the ray of a lane leaves from.
    pub(super) fn leaving(&self, lane: usize) -> Option<Place> {
        self.left.lane(lane)
    }

    /// Origins, relative to the snapshot's, and directions of any length.
    #[inline(always)]
    pub(super) fn precise(&self, s: S) -> (D3<S>, D3<S>) {
        match self.precise {
            Precise::Camera(primary, at) => (primary.eye, primary.directions(s, at)),
            Precise::Stream(queue, at) => queue.precise(s, at),
            Precise::Asked(asked, at) => asked.precise(s, at),
        }
    }
}

/// Where the rays of a packet stand in `f64`. They are read anew where they are needed, so that they take no registers
/// where they are not.
#[derive(Clone, Copy)]
pub(super) enum Precise<'a, S: Simd> {
    /// Those of a tile's pixels from a place in its columns on.
    Camera(&'a Primary<S>, usize),
    /// Those of a stream from a place on.
    Stream(&'a Queue, usize),
    /// Those of a question from a place on.
    Asked(&'a Asked<'a>, usize),
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

    /// The facet of a shape that each ray leaves from; [`NOTHING`] where it leaves from none of them.
    #[inline(always)]
    pub(super) fn facets_of(&self, s: S, prim: u32) -> U<S> {
        U::pick(self.prim.is(prim), self.facet, U::splat(s, NOTHING))
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

/// What to add to a reach where coordinates are relative to an origin other than the frame's: there they are rounded more
/// coarsely.
pub(super) fn drift(origin: DVec3) -> f32 {
    origin.abs().element_sum() as f32 * WORLD_DRIFT
}

/// What the camera's packets of one tile have in common.
pub(super) struct Primary<S: Simd> {
    eye: D3<S>,
    drift: F<S>,
    corner: D3<S>,
    across: D3<S>,
    down: D3<S>,
    /// Columns and rows of the lanes of each part of a block, in pixels from the block's corner.
    within: [(D<S>, D<S>); BLOCK_PIXELS / 4],
    raster: Raster,
    /// The sample's place within a pixel.
    share: [f64; 2],
    left: u32,
    top: u32,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) pixels: usize,
    /// Whether pixels hold nothing yet.
    pub(super) fresh: bool,
    weight: F3<S>,
}

impl<S: Simd> Primary<S> {
    /// For the sample at a column and row of the grid within each pixel.
    #[inline(always)]
    pub(super) fn new(s: S, frame: &Frame<'_>, tile: &Tile, column: u32, row: u32) -> Self {
        let share = frame.view.place(column, row);
        // A block and a bit, so that the last part can be loaded whole.
        let (mut columns, mut rows) = ([0.0; 2 * BLOCK_PIXELS], [0.0; 2 * BLOCK_PIXELS]);
        for pixel in 0..BLOCK_PIXELS {
            columns[pixel] = (pixel as u32 % BLOCK) as f64 + share[0];
            rows[pixel] = (pixel as u32 / BLOCK) as f64 + share[1];
        }
        let mut within = [(D::splat(s, 0.0), D::splat(s, 0.0)); BLOCK_PIXELS / 4];
        for (part, lanes) in within.iter_mut().enumerate().take(BLOCK_PIXELS / F::<S>::LANES) {
            let at = part * F::<S>::LANES;
            *lanes = (D::load(s, &columns[at..]), D::load(s, &rows[at..]));
        }
        let raster = &frame.raster;
        Self {
            eye: splat_wide(s, frame.eye),
            drift: F::splat(s, drift(frame.snapshot.origin_in_frame())),
            corner: splat_wide(s, raster.corner),
            across: splat_wide(s, raster.across),
            down: splat_wide(s, raster.down),
            within,
            raster: *raster,
            share,
            left: tile.x,
            top: tile.y,
            width: tile.width,
            height: tile.height,
            pixels: tile.depth.len(),
            fresh: (column, row) == (0, 0),
            weight: F3::splat(F::splat(s, 1.0)),
        }
    }

    /// Where the block and the part of it stand that a place in the tile's columns lies in.
    #[inline(always)]
    fn corner_of(&self, at: usize) -> (u32, u32, usize) {
        let (block, part) = (at as u32 / BLOCK_PIXELS as u32, at % BLOCK_PIXELS / F::<S>::LANES);
        let blocks_across = self.width.div_ceil(BLOCK);
        (block % blocks_across * BLOCK, block / blocks_across * BLOCK, part)
    }

    /// Directions of the packet at a place in the tile's columns: those of [`Raster::ray`], bit for bit.
    #[inline(always)]
    pub(super) fn directions(&self, s: S, at: usize) -> D3<S> {
        let (x, y, part) = self.corner_of(at);
        let (columns, rows) = self.within[part];
        let columns = columns + D::splat(s, f64::from(self.left + x));
        let rows = rows + D::splat(s, f64::from(self.top + y));
        self.across.scale_add(columns, self.down.scale_add(rows, self.corner))
    }

    /// The ray of the pixel at a place in the tile's columns.
    fn ray(&self, at: usize) -> Ray {
        let (x, y, _) = self.corner_of(at);
        let within = at as u32 % BLOCK_PIXELS as u32;
        let along = |first: u32, pixel: u32, share: f64| f64::from(first) + (f64::from(pixel) + share);
        self.raster.ray(
            along(self.left + x, within % BLOCK, self.share[0]),
            along(self.top + y, within / BLOCK, self.share[1]),
        )
    }

    /// The packet at a place in the tile's columns.
    #[inline(always)]
    pub(super) fn packet_at(&self, s: S, at: usize, inverse_length: Option<F<S>>) -> Packet<'_, S> {
        let (x, y, part) = self.corner_of(at);
        let (rays, inverse_length) = kernel_rays(s, self.eye, self.directions(s, at), inverse_length);
        let rays = rays.drifting(self.drift);
        Packet {
            precise: Precise::Camera(self, at),
            rays,
            inverse_length,
            weight: self.weight,
            pixel: U::counted(s, at as u32),
            left: Left::nothing(s),
            live: inside(s, self.width - x, self.height - y, part as u32),
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
