//! Pictures without jagged edges from one sample a pixel: which outlines cross a pixel, and into which pieces they part it.
//!
//! An outline in the picture is a line or a conic: the edge of a flat surface, the silhouette of a ball, the line along which
//! two surfaces meet (`outlines.rs`). What a pixel shows is the sum, over the pieces that its outlines part it into, of the
//! piece's share of the pixel's area and of what a ray through its centroid shows (`find.rs`): its mean to the second order of the
//! pixel's size. All of it is `f64`, computed pixel by pixel from the frame alone, and shared by all backends.

mod body;
mod checker;
mod cut;
mod find;
mod form;
mod outlines;
mod shadows;
mod sight;
mod split;
mod stage;

use catoptra_core::{Integrator, Raster};

use crate::numeric::{MIRRORS_DEEP, MOST_OUTLINES};
use crate::{EdgePixels, Edges, Region, Snapshot, View};
use checker::Lines;
use find::Search;
use form::Square;
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
}

impl EdgeList {
    /// Those that a view asks for, of what its rays see in the snapshot's frame.
    pub(crate) fn for_view(snapshot: &Snapshot, view: &View, raster: &Raster) -> Option<Self> {
        let asked = view.edges == Edges::Exact && view.integrator == Integrator::Whitted;
        asked.then(|| Self::new(snapshot, raster))
    }

    /// Of what is seen by the rays of a raster in the snapshot's frame.
    pub(crate) fn new(snapshot: &Snapshot, raster: &Raster) -> Self {
        let (stage, mut edges) = (Stage::new(snapshot), Self::default());
        edges.add_seen(&Sight::new(raster), &stage, EVERYWHERE, 0);
        edges.bounds = edges.outlines.iter().map(|outline| outline.bounds).collect();
        edges
    }

    /// Adds what an eye sees in a part of the picture, after some mirrors.
    fn add_seen(&mut self, sight: &Sight, stage: &Stage, within: [f64; 4], mirrors: u32) {
        let first = self.outlines.len();
        outlines::add_outlines(sight, stage, &mut self.outlines);
        for outline in &mut self.outlines[first..] {
            outline.bounds = common(outline.bounds, within);
        }
        for subject in &stage.subjects {
            let sheets = subject.sheets(sight);
            for (level, bounds) in sheets.into_iter().map(|(level, bounds)| (level, common(bounds, within))) {
                if let Some(grid) = &subject.grid {
                    self.lines.extend(Lines::on(sight, grid, (level, bounds), mirrors > 0));
                }
                let further = mirrors < MIRRORS_DEEP && self.outlines.len() < MOST_OUTLINES;
                if subject.mirror && further && bounds[0] < bounds[2] && bounds[1] < bounds[3] {
                    let mirrored = sight.mirrored(level.normal, level.normal * level.offset);
                    self.add_seen(&mirrored, stage, bounds, mirrors + 1);
                }
            }
        }
    }

    /// Finds the pieces of all pixels of a part of the picture that outlines cross.
    pub(crate) fn find(&self, region: Region, found: &mut PixelPieces) {
        found.clear();
        Search::new(self, region, found).run();
    }
}

/// The pieces of pixels, pixel after pixel.
#[derive(Debug, Default)]
pub(crate) struct PixelPieces {
    /// Column and row from the region's corner, and the pixel's first piece.
    pixels: Vec<([u32; 2], u32)>,
    /// Centroids, in pixels from the picture's corner.
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<f64>,
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
        self.x.truncate(length);
        self.y.truncate(length);
        self.share.truncate(length);
        self.quartered = false;
    }

    /// Adds a piece of a square.
    #[inline]
    fn add(&mut self, piece: Piece, square: Square) {
        let [x, y] = piece.center;
        self.x.push(x * square.half + square.x);
        self.y.push(y * square.half + square.y);
        self.share.push(piece.area * square.half * square.half);
    }

    /// How many pieces there are.
    pub(crate) fn len(&self) -> usize {
        self.share.len()
    }

    /// Fills up the columns of centroids to whole packets.
    pub(crate) fn fill_up(&mut self, lanes: usize) {
        let room = self.len().next_multiple_of(lanes);
        self.x.resize(room, 0.0);
        self.y.resize(room, 0.0);
    }

    /// Adds what was found to counts.
    pub(crate) fn count(&self, counts: &mut EdgePixels) {
        *counts += EdgePixels { pieces: self.len() as u64, ..self.counts };
    }

    /// Every pixel: column and row, its pieces, and their shares.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = ([u32; 2], std::ops::Range<usize>, &[f64])> {
        self.pixels.iter().enumerate().map(|(i, &(at, first))| {
            let last = self.pixels.get(i + 1).map_or(self.len(), |(_, next)| *next as usize);
            let pieces = first as usize..last;
            (at, pieces.clone(), &self.share[pieces])
        })
    }
}
