//! A packet of rays, and how the camera's packets are made.

use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, Raster, Ray, Span};
use fearless_simd::Simd;

use super::ask::Asked;
use super::queue::Queue;
use crate::backend::Frame;
use crate::column::Column;
use crate::film::{BLOCK, BLOCK_PIXELS, NOTHING};
use crate::kernel::{Rays, magnitude};
use crate::lanes::{D, D3, F, F3, M, U, load3, narrow3, splat_wide, store3};
use crate::numeric::WORLD_DRIFT;
use crate::{Place, Region, Size, Tile};

/// One ray in every lane.
#[derive(Clone, Copy)]
pub(super) struct Packet<'a, S: Simd> {
    /// The rays in `f64`.
    pub(super) precise: Precise<'a, S>,
    /// The same rays as kernels see them.
    pub(super) rays: Rays<S>,
    /// 1 over the length of each direction.
    pub(super) inverse_length: F<S>,
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

    /// All of these of a lane.
    pub(super) fn way(&self, lane: usize) -> (Ray, Span, Option<Place>) {
        (self.ray(lane), self.span(lane), self.leaving(lane))
    }

    /// Points so many metres along the rays.
    #[inline(always)]
    pub(super) fn point(&self, t: F<S>) -> F3<S> {
        self.rays.direction.scale_add(t, self.rays.origin)
    }

    /// Origins, relative to the snapshot's, and directions of unit length, up to rounding in `f32`.
    #[inline(always)]
    pub(super) fn precise_unit(&self, s: S) -> (D3<S>, D3<S>) {
        let (origin, direction) = self.precise(s);
        match self.precise {
            Precise::Stream(..) => (origin, direction),
            Precise::Camera(..) | Precise::Asked(..) => {
                (origin, direction.scale(self.inverse_length.widen()))
            }
        }
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
    Camera(&'a Primary<'a, S>, usize),
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

/// Rays as kernels see them, and 1 over the length of each direction.
#[inline(always)]
pub(super) fn kernel_rays<S: Simd>(s: S, origin: F3<S>, direction: F3<S>) -> (Rays<S>, F<S>) {
    let inverse_length = F::splat(s, 1.0) / direction.dot(direction).sqrt();
    let rays = Rays { origin, direction: direction.scale(inverse_length), reach: magnitude(origin) };
    (rays, inverse_length)
}

/// As [`kernel_rays`] of directions whose lengths differ from 1 by no more than 2⁻¹³: a Newton step from 1 brings 1 over
/// their roots there.
#[inline(always)]
pub(super) fn nearly_unit_rays<S: Simd>(s: S, origin: F3<S>, direction: F3<S>) -> (Rays<S>, F<S>) {
    let half = F::splat(s, -0.5) * direction.dot(direction);
    let inverse_length = half + F::splat(s, 1.5);
    let rays = Rays { origin, direction: direction.scale(inverse_length), reach: magnitude(origin) };
    (rays, inverse_length)
}

/// What to add to a reach where coordinates are relative to an origin other than the frame's: there they are rounded more
/// coarsely.
pub(super) fn drift(origin: DVec3) -> f32 {
    origin.abs().element_sum() as f32 * WORLD_DRIFT
}

/// The camera's rays through a tile, column by column, in the order of the tile's pixels.
#[derive(Default)]
pub(super) struct CameraRays {
    /// Unit directions.
    direction: [Column<f32>; 3],
    /// 1 over the lengths of the directions that they were made from.
    inverse_length: Column<f32>,
    /// Which lanes of each packet lie within the picture.
    live: Vec<u64>,
}

impl CameraRays {
    fn make_room(&mut self, pixels: usize) {
        if self.live.len() < pixels {
            self.direction.iter_mut().for_each(|column| column.resize(pixels, 0.0));
            self.inverse_length.resize(pixels, 0.0);
            self.live.resize(pixels, 0);
        }
    }
}

/// What the camera's packets of one tile have in common.
pub(super) struct Primary<'a, S: Simd> {
    rays: &'a mut CameraRays,
    eye32: F3<S>,
    reach: F<S>,
    eye: D3<S>,
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
    /// Whether pixels hold nothing yet.
    pub(super) fresh: bool,
    /// Whether what is met here stands for the pixel.
    pub(super) kept: bool,
}

impl<'a, S: Simd> Primary<'a, S> {
    /// For the sample at a column and row of the grid within each pixel.
    #[inline(always)]
    pub(super) fn new(
        s: S,
        frame: &Frame<'_>,
        tile: &Tile,
        (column, row): (u32, u32),
        rays: &'a mut CameraRays,
    ) -> Self {
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
        rays.make_room(tile.depth.len());
        let eye = splat_wide(s, frame.eye);
        Self {
            rays,
            eye32: narrow3(eye),
            reach: magnitude(narrow3(eye)) + F::splat(s, drift(frame.snapshot.origin_in_frame())),
            eye,
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
            fresh: (column, row) == (0, 0),
            kept: (column, row) == (frame.view.grid / 2, frame.view.grid / 2),
        }
    }

    /// Makes the rays of a part of the tile.
    #[inline(always)]
    pub(super) fn make_rays(&mut self, s: S, region: &Region) {
        let blocks_across = self.width.div_ceil(BLOCK);
        let Size { width, height } = region.size;
        for part in 0..BLOCK_PIXELS / F::<S>::LANES {
            let (columns, rows) = self.within[part];
            for y in (region.y..region.y + height).step_by(BLOCK as usize) {
                let row = self.through_row(s, rows, y);
                for x in (region.x..region.x + width).step_by(BLOCK as usize) {
                    let direction = narrow3(self.across_row(s, columns, x, row));
                    let (rays, inverse_length) = kernel_rays(s, self.eye32, direction);
                    let block = (y / BLOCK * blocks_across + x / BLOCK) as usize;
                    let at = block * BLOCK_PIXELS + part * F::<S>::LANES;
                    store3(rays.direction, &mut self.rays.direction, at);
                    inverse_length.store(&mut self.rays.inverse_length[at..]);
                    self.rays.live[at] = inside::<S>(self.width - x, self.height - y, part as u32);
                }
            }
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
        self.across_row(s, columns, x, self.through_row(s, rows, y))
    }

    /// Directions through the left edge of the picture, `rows` below a row of the tile.
    #[inline(always)]
    fn through_row(&self, s: S, rows: D<S>, y: u32) -> D3<S> {
        self.down.scale_add(rows + D::splat(s, f64::from(self.top + y)), self.corner)
    }

    /// Directions in a row, `columns` right of a column of the tile.
    #[inline(always)]
    fn across_row(&self, s: S, columns: D<S>, x: u32, row: D3<S>) -> D3<S> {
        self.across.scale_add(columns + D::splat(s, f64::from(self.left + x)), row)
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

    /// Which lanes at a place in the tile's columns lie within the picture.
    #[inline(always)]
    pub(super) fn live_lanes(&self, s: S, at: usize) -> M<S> {
        M::from_bits(s, self.rays.live[at])
    }

    /// The packet at a place in the tile's columns.
    #[inline(always)]
    pub(super) fn packet_at(&self, s: S, at: usize) -> Packet<'_, S> {
        let direction = load3(s, &self.rays.direction, at);
        Packet {
            precise: Precise::Camera(self, at),
            rays: Rays { origin: self.eye32, direction, reach: self.reach },
            inverse_length: F::load(s, &self.rays.inverse_length[at..]),
            left: Left::nothing(s),
            live: self.live_lanes(s, at),
        }
    }
}

/// Which lanes of a part of a block lie within the columns and rows that the picture has left.
#[inline(always)]
fn inside<S: Simd>(columns: u32, rows: u32, part: u32) -> u64 {
    let lanes = F::<S>::LANES as u32;
    if columns >= BLOCK && rows >= BLOCK {
        return u64::MAX >> (64 - lanes);
    }
    let mut bits = 0;
    for lane in 0..lanes {
        let pixel = part * lanes + lane;
        bits |= u64::from(pixel % BLOCK < columns && pixel / BLOCK < rows) << lane;
    }
    bits
}
