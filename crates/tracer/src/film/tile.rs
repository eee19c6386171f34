//! What is known of the pixels of one rectangle of a picture, which is written by one thread.

use std::sync::Arc;

use catoptra_core::EntityId;

use super::sums::{Samples, Sum, finite, store_finite};
use super::{BLOCK, BLOCK_PIXELS, NOTHING};
use crate::View;
use crate::lanes::Column;

/// A rectangle of a film, written by one thread. Its place is counted from the corner of the whole picture.
///
/// Columns hold whole blocks of 4 x 4 pixels, row by row of blocks and row by row within a block; blocks at the right
/// and lower edge of the picture reach beyond it.
#[derive(Debug, Clone)]
pub struct Tile {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// The light of all samples of a pixel.
    pub(crate) sums: [Column<f32>; 3],
    pub(crate) depth: Column<f32>,
    pub(crate) surface: Column<u32>,
    samples: Samples,
    /// Squared deviations of the samples' luminances from their mean, where they are asked for: see `sums.rs`.
    pub(super) deviations: Option<Column<f64>>,
    /// What the surfaces are called.
    entities: Arc<[EntityId]>,
    /// The one light that all pixels show, where it is known that none shows a surface.
    blank: Option<Light>,
    /// The same before the trace under way.
    before: Option<Light>,
}

/// Bits of red, green and blue.
type Light = [u32; 3];

impl Tile {
    /// One without pixels, to hold the light of single rays.
    pub(crate) fn without_pixels() -> Self {
        Self {
            x: 0,
            y: 0,
            width: 0,
            height: 0,
            sums: Default::default(),
            depth: Column::default(),
            surface: Column::default(),
            samples: Samples::uniform(1),
            deviations: None,
            entities: Arc::default(),
            blank: None,
            before: None,
        }
    }

    /// A black one without samples, where there is memory for it.
    pub(super) fn new(x: u32, y: u32, width: u32, height: u32) -> Option<Self> {
        let pixels = (width.div_ceil(BLOCK) * height.div_ceil(BLOCK)) as usize * BLOCK_PIXELS;
        let light = || Column::try_filled(pixels, 0.0);
        Some(Self {
            x,
            y,
            width,
            height,
            sums: [light()?, light()?, light()?],
            depth: Column::try_filled(pixels, f32::INFINITY)?,
            surface: Column::try_filled(pixels, NOTHING)?,
            samples: Samples::uniform(0),
            deviations: None,
            entities: Arc::default(),
            blank: Some([0; 3]),
            before: None,
        })
    }

    /// Makes room for the light of so many single rays, and clears it: each has the pixel of its number.
    pub(crate) fn hold_rays(&mut self, count: usize) {
        for light in &mut self.sums {
            if light.len() < count {
                light.resize(count, 0.0);
            }
            light[..count].fill(0.0);
        }
    }

    /// Says what a pixel shows in all, where that is known without an error.
    pub(crate) fn set_radiance(&mut self, i: usize, light: [f64; 3]) -> u64 {
        let samples = f64::from(self.samples.count(i));
        if let Some(deviations) = &mut self.deviations {
            deviations[i] = 0.0;
        }
        let stored = self.sums.iter_mut().zip(light);
        stored.map(|(sum, light)| store_finite(&mut sum[i], (light * samples) as f32)).sum()
    }

    /// Says that the tile is traced anew, and what its surfaces are called from now on.
    pub(crate) fn begin(&mut self, entities: &Arc<[EntityId]>, view: &View) {
        self.before = self.blank.take();
        self.entities = Arc::clone(entities);
        self.samples = Samples::uniform(view.samples());
        let deviations = self.deviations.take().unwrap_or_default();
        self.deviations = view.moments.then(|| {
            let mut deviations = deviations;
            deviations.resize(self.depth.len(), 0.0);
            deviations.fill(0.0);
            deviations
        });
    }

    /// Says that all pixels show a light and no surface; answers whether they did so before.
    pub(crate) fn goes_blank(&mut self, light: [f32; 3]) -> bool {
        self.blank = Some(light.map(f32::to_bits));
        self.blank == self.before
    }

    /// Whether it is known that no pixel shows a surface.
    pub(crate) fn is_blank(&self) -> bool {
        self.blank.is_some()
    }

    /// Blocks across.
    pub(crate) fn blocks_across(&self) -> u32 {
        self.width.div_ceil(BLOCK)
    }

    /// Where a pixel of the tile lies in its columns.
    #[inline]
    pub(crate) fn index(&self, x: u32, y: u32) -> usize {
        let block = (y / BLOCK) * self.blocks_across() + x / BLOCK;
        block as usize * BLOCK_PIXELS + ((y % BLOCK) * BLOCK + x % BLOCK) as usize
    }

    /// The mean of a pixel's samples.
    #[inline]
    pub(crate) fn radiance(&self, i: usize) -> [f32; 3] {
        let share = self.samples.share(i);
        [self.sums[0][i] * share, self.sums[1][i] * share, self.sums[2][i] * share]
    }

    /// What a pixel shows.
    pub(super) fn entity(&self, i: usize) -> Option<EntityId> {
        self.entities.get(self.surface[i] as usize).copied()
    }

    /// How many samples a pixel holds.
    pub(super) fn samples(&self, i: usize) -> u32 {
        self.samples.count(i)
    }

    /// The standard error of the luminance of a pixel, where it can be told.
    pub(super) fn standard_error(&self, i: usize) -> Option<f32> {
        let (deviations, count) = (self.deviations.as_ref()?, f64::from(self.samples(i)));
        (count >= 2.0).then(|| finite((deviations[i] / (count * (count - 1.0))).sqrt() as f32))
    }

    /// Adds light to the squared deviations of a pixel's samples, where they are asked for.
    #[inline]
    pub(crate) fn add_deviation(&mut self, i: usize, deviation: f64) {
        if let Some(deviations) = &mut self.deviations {
            deviations[i] += deviation;
        }
    }

    /// Adds the samples of a pixel of another tile to those of one of this.
    pub(super) fn add(&mut self, i: usize, other: &Self, j: usize) {
        match &other.deviations {
            Some(theirs) => self.add_deviation(i, theirs[j] + self.sum(i).spread_to(other.sum(j))),
            None => self.deviations = None,
        }
        for (mine, theirs) in self.sums.iter_mut().zip(&other.sums) {
            let sum = mine[i] + theirs[j];
            store_finite(&mut mine[i], sum);
        }
        self.samples.add(i, other.samples(j), self.depth.len());
        self.blank = None;
    }

    fn sum(&self, i: usize) -> Sum {
        Sum { light: [0, 1, 2].map(|c| f64::from(self.sums[c][i])), count: self.samples(i) }
    }
}
