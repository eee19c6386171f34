//! The camera's rays through a tile, made block by block.

use catoptra_core::glam::DVec3;
use catoptra_core::material::Footprint;
use catoptra_core::{Raster, Ray, Span};
use fearless_simd::Simd;

use crate::film::{BLOCK, BLOCK_PIXELS};
use crate::frame::Frame;
use crate::kernel::{Leaving, Rays};
use crate::lanes::{Column, D, D3, F, F3, M, U, Word, load3, magnitude, narrow3, splat_wide, store3};
use crate::search::{Packet, PreciseRays, drift, kernel_rays};
use crate::{Region, Size, Tile};

/// The camera's rays through a tile, column by column, in the order of the tile's pixels.
#[derive(Default)]
pub(crate) struct CameraRays {
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

/// Columns of a block's pixels.
static COLUMNS: [u32; BLOCK_PIXELS] = [0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3];

/// Rows of a block's pixels.
static ROWS: [u32; BLOCK_PIXELS] = [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3];

/// What the camera's packets of one tile have in common.
pub(crate) struct CameraPackets<'a, S: Simd> {
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
    /// The sample's position within a pixel.
    share: [f64; 2],
    x: u32,
    y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// What the sides of the square that a sample stands for add to its direction, where looks are averaged over it.
    pub(crate) sides: Option<[DVec3; 2]>,
    /// Whether pixels hold nothing yet.
    pub(crate) fresh: bool,
    /// Whether the hits of this sample are kept as the pixels' surfaces and depths.
    pub(crate) kept: bool,
}

impl<'a, S: Simd> CameraPackets<'a, S> {
    /// For the sample at a column and row of the grid within each pixel.
    #[inline(always)]
    pub(crate) fn new(
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
            x: tile.x,
            y: tile.y,
            width: tile.width,
            height: tile.height,
            sides: frame
                .edges
                .map(|_| [raster.across, raster.down].map(|side| side / f64::from(frame.view.grid))),
            fresh: (column, row) == (0, 0),
            kept: (column, row) == (frame.view.grid / 2, frame.view.grid / 2),
        }
    }

    /// Makes the rays of a part of the tile.
    #[inline(always)]
    pub(crate) fn make_rays(&mut self, s: S, region: &Region) {
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

    /// Where the block and the part of it are that an index of the tile's columns belongs to.
    #[inline(always)]
    fn corner_of(&self, at: usize) -> (u32, u32, usize) {
        let (block, part) = (at as u32 / BLOCK_PIXELS as u32, at % BLOCK_PIXELS / F::<S>::LANES);
        let blocks_across = self.width.div_ceil(BLOCK);
        (block % blocks_across * BLOCK, block / blocks_across * BLOCK, part)
    }

    /// Columns and rows of the whole picture that the packet at an index of the tile's columns has its pixels in.
    #[inline(always)]
    pub(crate) fn pixels_of_picture(&self, s: S, at: usize) -> [U<S>; 2] {
        let (x, y, part) = self.corner_of(at);
        let lanes = |of: &[u32; BLOCK_PIXELS]| U::load(s, &of[part * F::<S>::LANES..]);
        let [columns, rows] = [lanes(&COLUMNS), lanes(&ROWS)];
        [columns.plus_number(self.x + x), rows.plus_number(self.y + y)]
    }

    /// Directions of the packet at an index of the tile's columns: those of [`Raster::ray`], bit for bit.
    #[inline(always)]
    pub(crate) fn directions(&self, s: S, at: usize) -> D3<S> {
        let (x, y, part) = self.corner_of(at);
        let (columns, rows) = self.within[part];
        self.across_row(s, columns, x, self.through_row(s, rows, y))
    }

    /// Directions through the left edge of the picture, `rows` below a row of the tile.
    #[inline(always)]
    fn through_row(&self, s: S, rows: D<S>, y: u32) -> D3<S> {
        self.down.scale_add(rows + D::splat(s, f64::from(self.y + y)), self.corner)
    }

    /// Directions in a row, `columns` right of a column of the tile.
    #[inline(always)]
    fn across_row(&self, s: S, columns: D<S>, x: u32, row: D3<S>) -> D3<S> {
        self.across.scale_add(columns + D::splat(s, f64::from(self.x + x)), row)
    }

    /// Which lanes at an index of the tile's columns lie within the picture.
    #[inline(always)]
    pub(crate) fn live_lanes(&self, s: S, at: usize) -> M<S> {
        M::from_bits(s, self.rays.live[at])
    }

    /// The packet at an index of the tile's columns.
    #[inline(always)]
    pub(crate) fn packet_at(&self, s: S, at: usize) -> Packet<'_, S, Self> {
        let direction = load3(s, &self.rays.direction, at);
        Packet {
            precise: self,
            at,
            rays: Rays { origin: self.eye32, direction, reach: self.reach },
            inverse_length: F::load(s, &self.rays.inverse_length[at..]),
            leaving: Leaving::nothing(s),
            live: self.live_lanes(s, at),
        }
    }
}

impl<S: Simd> CameraPackets<'_, S> {
    /// The squares that the rays of a packet stand for.
    #[inline(always)]
    pub(crate) fn footprint(&self, s: S, at: usize) -> Footprint<F<S>> {
        let [across, down] = self.sides.unwrap_or_default();
        let (across, down) = (narrow3(splat_wide(s, across)), narrow3(splat_wide(s, down)));
        let length = F::load(s, &self.rays.inverse_length[at..]);
        let direction = load3(s, &self.rays.direction, at);
        Footprint { direction, sides: [across.scale(length), down.scale(length)] }
    }
}

impl<S: Simd> PreciseRays<S> for CameraPackets<'_, S> {
    const UNIT: bool = false;
    const FROM_ORIGIN: bool = true;

    /// The ray of the pixel at an index of the tile's columns.
    fn ray(&self, at: usize) -> Ray {
        let (x, y, _) = self.corner_of(at);
        let within = at as u32 % BLOCK_PIXELS as u32;
        let along = |first: u32, pixel: u32, share: f64| f64::from(first) + (f64::from(pixel) + share);
        self.raster.ray(
            along(self.x + x, within % BLOCK, self.share[0]),
            along(self.y + y, within / BLOCK, self.share[1]),
        )
    }

    fn span(&self, _at: usize) -> Span {
        Span::AHEAD
    }

    #[inline(always)]
    fn precise(&self, s: S, at: usize) -> (D3<S>, D3<S>) {
        (self.eye, self.directions(s, at))
    }

    #[inline(always)]
    fn ends(&self, s: S, at: usize) -> [D3<S>; 2] {
        let (origin, direction) = self.precise(s, at);
        [origin, direction.scale_add(D::splat(s, f64::INFINITY), origin)]
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
