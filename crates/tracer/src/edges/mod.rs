//! Pictures without jagged edges from one sample a pixel: which outlines cross a pixel, and into which pieces they part it.
//!
//! An outline in the picture is a line or a conic: the edge of a flat surface, the silhouette of a ball, the line along which
//! two surfaces meet (`outlines.rs`). What a pixel shows is the sum, over the pieces that its outlines part it into, of the
//! piece's share of the pixel's area and of what a ray through its centroid shows (`find.rs`): its mean to the second order of the
//! pixel's size. All of it is `f64`, computed pixel by pixel from the frame alone, and shared by all backends.

mod body;
mod checker;
mod cut;
mod doubt;
mod find;
mod form;
mod outlines;
mod shadows;
mod show;
mod sight;
mod split;
mod stage;

use catoptra_core::{Integrator, Raster};

use crate::numeric::{LEAST_MIRRORED, MIRRORS_DEEP, MOST_OUTLINES};
use crate::sampler::{self, Sampler};
use crate::{EdgePixels, Edges, Filter, Region, Snapshot, View};
use body::Body;
use checker::Lines;
use doubt::Doubt;
use find::{Search, SearchRoom};
use form::Square;
pub(crate) use show::EdgeRoom;
use sight::{EVERYWHERE, Outline, Sight, common};
use split::Piece;
use stage::Stage;

/// The outlines of a frame.
#[derive(Debug, Default)]
pub(crate) struct EdgeList {
    outlines: Vec<Outline>,
    /// Their bounds: left, top, right, bottom.
    bounds: Vec<[f64; 4]>,
    /// Lines between checkered squares.
    lines: Vec<Lines>,
    /// Parts of the picture in which round surfaces have patterns.
    patterned: Vec<[f64; 4]>,
    /// Parts of the picture in which not all outlines are known.
    doubts: Vec<Doubt>,
    /// What samples go by.
    seed: u32,
}

impl EdgeList {
    /// Those that a view asks for, of what its rays see in the snapshot's frame.
    pub(crate) fn for_view(snapshot: &Snapshot, view: &View, raster: &Raster) -> Option<Self> {
        // Areas are those of a box filter, seen from one eye, and shown once all samples are there.
        let from_eye = view.camera.lens_radius() == 0.0 && !view.camera.is_orthographic();
        let plain = view.filter == Filter::Box && from_eye && view.range.is_none();
        let asked = view.edges == Edges::Exact && view.integrator == Integrator::Whitted && plain;
        asked.then(|| Self { seed: view.seed, ..Self::new(snapshot, raster) })
    }

    /// Of what is seen by the rays of a raster in the snapshot's frame.
    pub(crate) fn new(snapshot: &Snapshot, raster: &Raster) -> Self {
        let (stage, mut edges) = (Stage::new(snapshot), Self::default());
        edges.add_seen(&Sight::new(raster), &stage, EVERYWHERE, &[]);
        edges.bounds = edges.outlines.iter().map(|outline| outline.bounds).collect();
        edges
    }

    /// Adds what an eye sees in a part of the picture, after mirrors, given by
    /// their numbers and the shares of light that they leave.
    fn add_seen(&mut self, sight: &Sight, stage: &Stage, within: [f64; 4], mirrors: &[(usize, f64)]) {
        let first = self.outlines.len();
        outlines::add_outlines(sight, stage, &mut self.outlines);
        for outline in &mut self.outlines[first..] {
            outline.bounds = common(outline.bounds, within);
        }
        for (number, subject) in stage.subjects.iter().enumerate() {
            // A flat mirror does not see itself.
            if mirrors.last().is_some_and(|last| last.0 == number) && subject.body.is_flat() {
                continue;
            }
            if let Some(doubt) = doubt::doubtful_part(sight, stage, subject, mirrors.len()) {
                self.doubts.push(Doubt { bounds: common(doubt.bounds, within), ..doubt });
            }
            if let (Body::Ball { center, radius }, Some(_)) = (&subject.body, &subject.grid) {
                self.patterned.extend(sight.bounds_of_ball(*center, *radius));
            }
            let sheets = subject.sheets(sight);
            for (level, bounds) in sheets.into_iter().map(|(level, bounds)| (level, common(bounds, within))) {
                if let Some(grid) = &subject.grid {
                    self.lines.extend(Lines::on(sight, grid, (level, bounds), !mirrors.is_empty()));
                }
                let Some(share) = subject.mirror else { continue };
                let left: Vec<(usize, f64)> = mirrors.iter().copied().chain([(number, share)]).collect();
                let told = left.len() <= MIRRORS_DEEP
                    && left.iter().map(|(_, share)| share).product::<f64>() > LEAST_MIRRORED;
                let seen = bounds[0] < bounds[2] && bounds[1] < bounds[3];
                if told && seen && self.outlines.len() < MOST_OUTLINES {
                    let mirrored = sight.mirrored(level.normal, level.normal * level.offset);
                    self.add_seen(&mirrored, stage, bounds, &left);
                }
            }
        }
    }

    /// Finds the pieces of all pixels of a part of the picture that outlines cross.
    fn find(&self, region: Region, room: &mut SearchRoom, found: &mut PixelPieces) {
        found.clear();
        Search::new(self, region, room, found).run();
    }
}

/// Samples of a pixel that is not told by pieces.
const SAMPLES: u32 = 16;

/// Places in the picture that camera rays go through.
#[derive(Debug, Default)]
pub(crate) struct Places {
    count: usize,
    /// In pixels from the picture's corner.
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<f64>,
    /// The side of the square that each stands for, in pixels; 0 for what looks the same all over it.
    pub(crate) side: Vec<f64>,
}

impl Places {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    fn clear(&mut self) {
        self.truncate(0);
    }

    fn truncate(&mut self, count: usize) {
        self.count = count;
        self.x.truncate(count);
        self.y.truncate(count);
        self.side.truncate(count);
    }

    #[inline]
    fn push(&mut self, x: f64, y: f64, side: f64) {
        self.x.push(x);
        self.y.push(y);
        self.side.push(side);
        self.count += 1;
    }

    /// Fills up the columns to whole packets.
    pub(crate) fn fill_up(&mut self, lanes: usize) {
        let room = self.count.next_multiple_of(lanes);
        self.x.resize(room, 0.0);
        self.y.resize(room, 0.0);
        self.side.resize(room, 0.0);
    }
}

/// The pieces of pixels, pixel after pixel.
#[derive(Debug, Default)]
pub(crate) struct PixelPieces {
    /// Column and row from the region's corner, and the pixel's first piece.
    pixels: Vec<([u32; 2], u32)>,
    /// Centroids.
    pub(crate) places: Places,
    /// Shares of their pixel.
    share: Vec<f64>,
    counts: EdgePixels,
    /// Whether the pixel under way is quartered.
    quartered: bool,
}

impl PixelPieces {
    fn clear(&mut self) {
        self.pixels.clear();
        self.truncate(0);
        self.counts = EdgePixels::default();
    }

    fn truncate(&mut self, length: usize) {
        self.places.truncate(length);
        self.share.truncate(length);
        self.quartered = false;
    }

    /// Adds a piece of a square; `mixed` where its look may change within it.
    #[inline]
    fn add(&mut self, piece: Piece, square: Square, mixed: bool) {
        let [x, y] = piece.center;
        let area = piece.area * square.half * square.half;
        let side = if mixed { area.sqrt() } else { 0.0 };
        self.places.push(x * square.half + square.x, y * square.half + square.y, side);
        self.share.push(area);
    }

    /// Adds samples of a pixel, given by its column and row in the region and that region.
    fn add_samples(&mut self, [x, y]: [u32; 2], region: Region, seed: u32) {
        self.pixels.push(([x, y], self.len() as u32));
        self.counts.sampled += 1;
        let (column, row) = (region.x + x, region.y + y);
        let sampler = Sampler::new(seed, column, row);
        for sample in 0..SAMPLES {
            let [right, down] = sampler.pair(sample, 0).map(sampler::share);
            let share = 1.0 / f64::from(SAMPLES);
            self.places.push(f64::from(column) + right, f64::from(row) + down, share.sqrt());
            self.share.push(share);
        }
    }

    /// How many pieces there are.
    pub(crate) fn len(&self) -> usize {
        self.share.len()
    }

    /// What was found, in counts.
    fn counts(&self) -> EdgePixels {
        EdgePixels { pieces: self.len() as u64, ..self.counts }
    }

    /// Every pixel: column and row, its pieces, and their shares.
    fn pixels(&self) -> impl Iterator<Item = ([u32; 2], std::ops::Range<usize>, &[f64])> {
        self.pixels.iter().enumerate().map(|(i, &(at, first))| {
            let last = self.pixels.get(i + 1).map_or(self.len(), |(_, next)| *next as usize);
            let pieces = first as usize..last;
            (at, pieces.clone(), &self.share[pieces])
        })
    }
}
