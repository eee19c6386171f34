//! The camera's rays through a tile, made block by block.
//!
//! Where a sample lies in the same place of every pixel, and rays start at the eye, directions are computed wherever they are
//! asked for. Else the places of the tile's pixels, and those on the lens, are kept in columns: as `f32`, which holds both
//! without rounding.

use catoptra_core::glam::DVec3;
use catoptra_core::lobe::point_of_disk;
use catoptra_core::material::Footprint;
use catoptra_core::{Raster, Ray, RayStart, Span};
use fearless_simd::Simd;

use crate::film::{BLOCK, BLOCK_PIXELS};
use crate::filter::Filter;
use crate::frame::Frame;
use crate::kernel::{Leaving, Rays};
use crate::lanes::{
    Column, D, D3, F, F3, M, U, Word, load3, magnitude, narrow3, share_of_one, splat_wide, steps_of_one,
    store3,
};
use crate::sample::Sample;
use crate::sampler::pairs;
use crate::search::{Packet, PreciseRays, drift, kernel_rays};
use crate::{Region, Size, Tile};

/// The camera's rays through a tile, column by column, in the order of the tile's pixels.
#[derive(Default)]
pub(crate) struct CameraRays {
    /// Unit directions.
    direction: [Column<f32>; 3],
    /// 1 over the lengths of the directions that they were made from.
    inverse_length: Column<f32>,
    /// Which lanes of each packet lie within the picture, and are traced.
    live: Vec<u64>,
    /// How far from a pixel's left and upper edge its sample lies, in pixels, where every pixel has a place of its own.
    place: [Column<f32>; 2],
    /// Where on the lens rays start, in its radii to the right and upwards.
    on_lens: [Column<f32>; 2],
    /// Which lanes of each packet are traced, where not all are.
    active: Vec<u64>,
}

impl CameraRays {
    fn make_room(&mut self, pixels: usize) {
        if self.live.len() < pixels {
            self.direction.iter_mut().for_each(|column| column.resize(pixels, 0.0));
            self.inverse_length.resize(pixels, 0.0);
            self.live.resize(pixels, 0);
        }
    }

    /// The same for places of each pixel's own.
    fn make_own_room(&mut self, pixels: usize) {
        if self.place[0].len() < pixels {
            self.place.iter_mut().chain(&mut self.on_lens).for_each(|column| column.resize(pixels, 0.0));
        }
    }

    /// Takes over which pixels of a tile are traced.
    fn mark_active<S: Simd>(&mut self, tile: &Tile, sample: u32) {
        self.active.clear();
        self.active.resize(tile.depth.len(), 0);
        for at in (0..tile.depth.len()).step_by(F::<S>::LANES) {
            let lanes = (0..F::<S>::LANES).filter(|lane| tile.is_active(at + lane, sample));
            self.active[at] = lanes.fold(0, |bits, lane| bits | 1 << lane);
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
    drift: f32,
    eye: D3<S>,
    corner: D3<S>,
    across: D3<S>,
    down: D3<S>,
    /// Columns and rows of the lanes of each part of a block, in pixels from the block's corner.
    within: [(D<S>, D<S>); BLOCK_PIXELS / 4],
    raster: Raster,
    /// `None` for the eye.
    start: Option<StartLanes<S>>,
    sample: Sample,
    /// Whether places are kept in columns.
    own: bool,
    /// Whether only some pixels are traced.
    masked: bool,
    x: u32,
    y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// What the sides of the square that a sample stands for add to its direction, where looks are averaged over it.
    pub(crate) sides: Option<[DVec3; 2]>,
}

/// Where rays start that do not start at the eye, in registers: from there `base`, and so far along `right` and `up`.
struct StartLanes<S: Simd> {
    base: D3<S>,
    right: D3<S>,
    up: D3<S>,
    /// Minus 1 over the distance at which rays through one pixel meet; 0 where they are parallel.
    inverse_focus: D<S>,
    /// Whether how far is kept in columns, as on a lens; else it is the place in the picture.
    on_lens: bool,
}

impl<S: Simd> StartLanes<S> {
    #[inline(always)]
    fn new(s: S, start: &RayStart) -> Option<Self> {
        let splat = |v| splat_wide(s, v);
        match start {
            RayStart::Eye => None,
            RayStart::Lens(lens) => Some(Self {
                base: splat(DVec3::ZERO),
                right: splat(lens.right),
                up: splat(lens.up),
                inverse_focus: D::splat(s, -lens.inverse_focus),
                on_lens: true,
            }),
            RayStart::Window(window) => Some(Self {
                base: splat(window.corner),
                right: splat(window.across),
                up: splat(window.down),
                inverse_focus: D::splat(s, 0.0),
                on_lens: false,
            }),
        }
    }
}

impl<'a, S: Simd> CameraPackets<'a, S> {
    /// For one of each pixel's samples.
    #[inline(always)]
    pub(crate) fn new(
        s: S,
        frame: &Frame<'_>,
        tile: &Tile,
        sample: &Sample,
        rays: &'a mut CameraRays,
    ) -> Self {
        let own = sample.shared.is_none() || !frame.is_pinhole();
        let share = match sample.shared {
            Some(place) if !own => place,
            _ => [0.0; 2],
        };
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
        if own {
            rays.make_own_room(tile.depth.len());
        }
        let masked = tile.is_masked();
        if masked {
            rays.mark_active::<S>(tile, sample.number);
        }
        let eye = splat_wide(s, frame.eye);
        let drift = drift(frame.snapshot.origin_in_frame());
        Self {
            rays,
            eye32: narrow3(eye),
            reach: magnitude(narrow3(eye)) + F::splat(s, drift),
            drift,
            eye,
            corner: splat_wide(s, raster.corner),
            across: splat_wide(s, raster.across),
            down: splat_wide(s, raster.down),
            within,
            raster: *raster,
            start: StartLanes::new(s, &raster.start),
            sample: *sample,
            own,
            masked,
            x: tile.x,
            y: tile.y,
            width: tile.width,
            height: tile.height,
            sides: frame
                .edges
                .map(|_| [raster.across, raster.down].map(|side| side * frame.view.side_of_sample())),
        }
    }

    /// Whether all rays start at the eye.
    pub(crate) fn start_at_the_eye(&self) -> bool {
        self.start.is_none()
    }

    /// Whether the hits of this sample are kept as the pixels' surfaces and depths.
    pub(crate) fn is_kept(&self) -> bool {
        self.sample.kept
    }

    /// Makes the rays of a part of the tile.
    #[inline(always)]
    pub(crate) fn make_rays(&mut self, s: S, region: &Region) {
        if self.own {
            self.make_own_rays(s, region);
            return;
        }
        let Size { width, height } = region.size;
        for part in 0..BLOCK_PIXELS / F::<S>::LANES {
            let (columns, rows) = self.within[part];
            for y in (region.y..region.y + height).step_by(BLOCK as usize) {
                let row = self.through_row(s, rows, y);
                for x in (region.x..region.x + width).step_by(BLOCK as usize) {
                    let direction = narrow3(self.across_row(s, columns, x, row));
                    self.store(s, direction, (x, y, part));
                }
            }
        }
    }

    /// The same where every pixel has a place of its own.
    #[inline(always)]
    fn make_own_rays(&mut self, s: S, region: &Region) {
        let Size { width, height } = region.size;
        for part in 0..BLOCK_PIXELS / F::<S>::LANES {
            for y in (region.y..region.y + height).step_by(BLOCK as usize) {
                for x in (region.x..region.x + width).step_by(BLOCK as usize) {
                    let at = self.at(x, y, part);
                    self.place_samples(s, at);
                    let (_, direction) = self.precise_rays(s, at);
                    self.store(s, narrow3(direction), (x, y, part));
                }
            }
        }
    }

    /// Keeps the rays of a part of a block that begins in a column and row of the tile.
    #[inline(always)]
    fn store(&mut self, s: S, direction: F3<S>, (x, y, part): (u32, u32, usize)) {
        let at = self.at(x, y, part);
        let (rays, inverse_length) = kernel_rays(s, self.eye32, direction);
        store3(rays.direction, &mut self.rays.direction, at);
        inverse_length.store(&mut self.rays.inverse_length[at..]);
        let inside = inside::<S>(self.width - x, self.height - y, part as u32);
        self.rays.live[at] = if self.masked { inside & self.rays.active[at] } else { inside };
    }

    /// Where in the tile's columns a part of a block begins.
    #[inline(always)]
    fn at(&self, x: u32, y: u32, part: usize) -> usize {
        let block = (y / BLOCK * self.width.div_ceil(BLOCK) + x / BLOCK) as usize;
        block * BLOCK_PIXELS + part * F::<S>::LANES
    }

    /// Finds where the samples of the packet at an index of the tile's columns lie in their pixels and on the lens.
    #[inline(always)]
    fn place_samples(&mut self, s: S, at: usize) {
        let [x, y] = self.pixels_of_picture(s, at);
        let (sampler, index) = (self.sample.sampler(x, y), U::splat(s, self.sample.index));
        let [right, down] = match self.sample.shared {
            Some([right, down]) => [F::splat(s, right as f32), F::splat(s, down as f32)],
            None => {
                let [right, down] = sampler.pair(index, pairs::PLACE);
                [filtered(self.sample.filter, right), filtered(self.sample.filter, down)]
            }
        };
        let [right_column, down_column] = &mut self.rays.place;
        right.store(&mut right_column[at..]);
        down.store(&mut down_column[at..]);
        if self.start.as_ref().is_some_and(|start| start.on_lens) {
            let [first, second] = sampler.pair(index, pairs::LENS);
            let [right, up] = point_of_disk([share_of_one(first), share_of_one(second)]);
            let [right_column, up_column] = &mut self.rays.on_lens;
            right.store(&mut right_column[at..]);
            up.store(&mut up_column[at..]);
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
        let (x, y, _) = self.corner_of(at);
        let (columns, rows) = self.within_block(s, at);
        self.across_row(s, columns, x, self.through_row(s, rows, y))
    }

    /// Columns and rows of the samples of the packet at an index of the tile's columns, in pixels from its block's corner.
    #[inline(always)]
    fn within_block(&self, s: S, at: usize) -> (D<S>, D<S>) {
        let (_, _, part) = self.corner_of(at);
        let (columns, rows) = self.within[part];
        if !self.own {
            return (columns, rows);
        }
        let [right, down] = &self.rays.place;
        (columns + F::load(s, &right[at..]).widen(), rows + F::load(s, &down[at..]).widen())
    }

    /// From the eye to where the rays of the packet at an index of the tile's columns start.
    #[inline(always)]
    fn aside(&self, s: S, at: usize, start: &StartLanes<S>) -> D3<S> {
        let (right, up) = if start.on_lens {
            let [right, up] = &self.rays.on_lens;
            (F::load(s, &right[at..]).widen(), F::load(s, &up[at..]).widen())
        } else {
            let ((x, y, _), (columns, rows)) = (self.corner_of(at), self.within_block(s, at));
            let along = |first: u32, within: D<S>| within + D::splat(s, f64::from(first));
            (along(self.x + x, columns), along(self.y + y, rows))
        };
        start.right.scale_add(right, start.up.scale_add(up, start.base))
    }

    /// Origins, relative to the snapshot's, and directions of the packet at an index of the tile's columns: those of
    /// [`Raster::ray_from`], bit for bit.
    #[inline(always)]
    fn precise_rays(&self, s: S, at: usize) -> (D3<S>, D3<S>) {
        let direction = self.directions(s, at);
        match &self.start {
            None => (self.eye, direction),
            Some(start) => {
                let aside = self.aside(s, at, start);
                (self.eye + aside, aside.scale_add(start.inverse_focus, direction))
            }
        }
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

    /// Whether only some pixels are traced.
    #[inline(always)]
    pub(crate) fn is_masked(&self) -> bool {
        self.masked
    }

    /// How many pixels of the packet at an index of the tile's columns are traced, where only some are.
    #[inline(always)]
    pub(crate) fn active(&self, at: usize) -> u32 {
        self.rays.active[at].count_ones()
    }

    /// Which lanes at an index of the tile's columns lie within the picture, and are traced.
    #[inline(always)]
    pub(crate) fn live_lanes(&self, s: S, at: usize) -> M<S> {
        M::from_bits(s, self.rays.live[at])
    }

    /// The packet at an index of the tile's columns.
    #[inline(always)]
    pub(crate) fn packet_at(&self, s: S, at: usize) -> Packet<'_, S, Self> {
        let direction = load3(s, &self.rays.direction, at);
        let (origin, reach) = match &self.start {
            None => (self.eye32, self.reach),
            Some(start) => {
                let origin = narrow3(self.eye + self.aside(s, at, start));
                (origin, magnitude(origin) + F::splat(s, self.drift))
            }
        };
        Packet {
            precise: self,
            at,
            rays: Rays { origin, direction, reach },
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
        let of = |columns: &[Column<f32>; 2]| [f64::from(columns[0][at]), f64::from(columns[1][at])];
        let share = match self.sample.shared {
            Some(place) => place,
            None => of(&self.rays.place),
        };
        let (right, down) =
            (along(self.x + x, within % BLOCK, share[0]), along(self.y + y, within / BLOCK, share[1]));
        match &self.start {
            Some(start) if start.on_lens => self.raster.ray_from(right, down, of(&self.rays.on_lens)),
            _ => self.raster.ray(right, down),
        }
    }

    fn span(&self, _at: usize) -> Span {
        Span::AHEAD
    }

    #[inline(always)]
    fn precise(&self, s: S, at: usize) -> (D3<S>, D3<S>) {
        self.precise_rays(s, at)
    }

    #[inline(always)]
    fn ends(&self, s: S, at: usize) -> [D3<S>; 2] {
        let (origin, direction) = self.precise(s, at);
        [origin, direction.scale_add(D::splat(s, f64::INFINITY), origin)]
    }
}

/// Where samples lie along one axis, in pixels from the pixel's edge, for numbers as shares of 2³².
#[inline(always)]
fn filtered<S: Simd>(filter: Filter, numbers: U<S>) -> F<S> {
    let mut place = steps_of_one(numbers);
    if filter != Filter::Box {
        for lane in 0..F::<S>::LANES {
            place.set(lane, filter.place(f64::from(place.lane(lane))) as f32);
        }
    }
    place
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
