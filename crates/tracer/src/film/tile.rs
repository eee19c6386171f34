//! What is known of the pixels of one rectangle of a picture, which is written by one thread.

use std::sync::Arc;

use catoptra_core::{EntityId, Rgb};

use super::deviations::{Deviations, zeros};
use super::replicates::Replicates;
use super::sums::{Counts, Sum, finite};
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
    /// The light of a pixel's one sample, or of the sample under way.
    pub(crate) sums: [Column<f32>; 3],
    pub(crate) depth: Column<f32>,
    pub(crate) surface: Column<u32>,
    /// The light of all samples of a pixel, where there may be more than one.
    pub(super) totals: Option<[Column<f64>; 3]>,
    pub(super) counts: Counts,
    /// Up to which number the samples of a pixel are traced, where each has a number of its own.
    goals: Option<Column<u32>>,
    /// The light of each of several sequences of samples, where it is kept apart.
    replicates: Option<Replicates>,
    /// How far apart the samples of pixels lie, where that is asked for.
    pub(super) deviations: Option<Deviations>,
    /// What the surfaces are called.
    entities: Arc<[EntityId]>,
    /// The one light that all pixels show, where it is known that none shows a surface.
    pub(super) blank: Option<Light>,
    /// The same before the trace under way.
    before: Option<Light>,
    /// Pixels of the picture that single rays go through, where it holds those.
    ray_places: Vec<[u32; 2]>,
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
            totals: None,
            counts: Counts::Uniform(1),
            goals: None,
            replicates: None,
            deviations: None,
            entities: Arc::default(),
            blank: None,
            before: None,
            ray_places: Vec::new(),
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
            totals: None,
            counts: Counts::Uniform(0),
            goals: None,
            replicates: None,
            deviations: None,
            entities: Arc::default(),
            blank: Some([0; 3]),
            before: None,
            ray_places: Vec::new(),
        })
    }

    /// Makes room for the light of single rays through such pixels of the picture, and clears it: each has the place of its
    /// number in the columns.
    pub(crate) fn hold_rays(&mut self, places: impl ExactSizeIterator<Item = [u32; 2]>) {
        let count = places.len();
        self.ray_places.clear();
        self.ray_places.extend(places);
        for light in &mut self.sums {
            if light.len() < count {
                light.resize(count, 0.0);
            }
            light[..count].fill(0.0);
        }
    }

    /// Says what a pixel shows in all, where that is known without an error.
    pub(crate) fn set_radiance(&mut self, i: usize, light: [f64; 3]) -> u64 {
        let samples = f64::from(self.counts.of(i));
        if let Some(deviations) = &mut self.deviations {
            deviations.clear(i);
        }
        let mut not_finite = 0;
        let light = light.map(|light| {
            not_finite += u64::from(!(light as f32).is_finite());
            if (light as f32).is_finite() { light } else { f64::from(finite(light as f32)) }
        });
        match &mut self.totals {
            Some(totals) => {
                totals.iter_mut().zip(light).for_each(|(total, light)| total[i] = light * samples);
            }
            None => self.sums.iter_mut().zip(light).for_each(|(sum, light)| sum[i] = light as f32),
        }
        not_finite
    }

    /// Says that some samples of a view are about to be traced, and what surfaces are called from now on.
    pub(crate) fn begin(&mut self, entities: &Arc<[EntityId]>, view: &View) {
        self.before = self.blank.take();
        self.entities = Arc::clone(entities);
        let range = view.traced_samples();
        if range.start == 0 {
            self.empty(view);
        }
        self.counts = match &self.goals {
            Some(goals) => Counts::up_to(goals, range.end),
            None => Counts::Uniform(range.end),
        };
    }

    /// Makes room for the samples of a view, and forgets those that there were.
    fn empty(&mut self, view: &View) {
        let pixels = self.depth.len();
        let totals = self.totals.take().unwrap_or_default();
        self.totals = (view.samples > 1).then(|| totals.map(|column| zeros(column, pixels)));
        self.deviations = Deviations::empty(self.deviations.take(), view.moments, pixels);
        let replicates = self.replicates.take().unwrap_or_default();
        self.replicates = (view.sequences > 1).then(|| replicates.empty(view.sequences, pixels));
    }

    /// Whether every pixel holds so many samples, or as many as its own goal says.
    pub(crate) fn holds(&self, samples: u32) -> bool {
        self.goals.is_some() || matches!(self.counts, Counts::Uniform(count) if count == samples)
    }

    /// Whether every pixel holds so many samples, and none has a goal of its own.
    pub(crate) fn holds_evenly(&self, samples: u32) -> bool {
        self.goals.is_none() && self.holds(samples)
    }

    /// Whether samples are traced for some pixels only.
    #[inline(always)]
    pub(crate) fn is_masked(&self) -> bool {
        self.goals.is_some()
    }

    /// Whether a sample is traced for a pixel.
    #[inline(always)]
    pub(crate) fn is_active(&self, i: usize, sample: u32) -> bool {
        match &self.goals {
            Some(goals) => goals[i] > sample,
            None => true,
        }
    }

    /// From now on the samples of each pixel are traced up to a number of its own, which is to be this one at first.
    pub(crate) fn set_goals_to(&mut self, goal: u32) {
        let mut goals = self.goals.take().unwrap_or_default();
        goals.resize(self.depth.len(), 0);
        goals.fill(0);
        for (x, y) in (0..self.height).flat_map(|y| (0..self.width).map(move |x| (x, y))) {
            goals[self.index(x, y)] = goal;
        }
        self.goals = Some(goals);
    }

    /// From now on samples of all pixels are traced alike.
    pub(crate) fn forget_goals(&mut self) {
        self.goals = None;
    }

    /// Up to which number the samples of a pixel are traced; 0 where there is none of its own.
    pub(crate) fn goal(&self, i: usize) -> u32 {
        self.goals.as_ref().map_or(0, |goals| goals[i])
    }

    /// Changes that number, where pixels have numbers of their own.
    pub(crate) fn set_goal(&mut self, i: usize, goal: u32) {
        if let Some(goals) = &mut self.goals {
            goals[i] = goal;
        }
    }

    /// Whether some pixel is to have more than so many samples.
    pub(crate) fn has_goals_beyond(&self, samples: u32) -> bool {
        self.goals.as_ref().is_some_and(|goals| goals.iter().any(|goal| *goal > samples))
    }

    /// Whether all samples of a pixel have the same luminance, where deviations are kept.
    pub(crate) fn is_alike(&self, i: usize) -> bool {
        self.deviations.as_ref().is_some_and(|deviations| deviations.of_luminance(i) == 0.0)
    }

    /// Takes in that all pixels that are traced hold the light of another sample.
    #[inline(always)]
    pub(crate) fn take_sample(&mut self, number: u32, view: &View) {
        if view.clamp < f32::INFINITY {
            for light in self.sums.iter_mut().flat_map(|column| column.iter_mut()) {
                *light = light.min(view.clamp);
            }
        }
        if self.deviations.is_some() {
            for i in 0..self.depth.len() {
                if self.is_active(i, number) {
                    self.take_deviation(i, [0, 1, 2].map(|c| f64::from(self.sums[c][i])), number);
                }
            }
        }
        if let Some(replicates) = &mut self.replicates {
            replicates.take_sample(&self.sums, self.goals.as_ref(), number);
        }
        let Some(totals) = &mut self.totals else { return };
        for (total, sample) in totals.iter_mut().zip(&self.sums) {
            if let Some(goals) = &self.goals {
                for ((total, sample), goal) in total.iter_mut().zip(sample.iter()).zip(goals.iter()) {
                    *total += if *goal > number { f64::from(*sample) } else { 0.0 };
                }
            } else {
                for (total, sample) in total.iter_mut().zip(sample.iter()) {
                    *total += f64::from(*sample);
                }
            }
        }
    }

    /// Adds one sample of a pixel. Returns how many of its channels were not finite.
    pub(crate) fn add_sample(&mut self, i: usize, light: Rgb, number: u32, view: &View) -> u64 {
        let mut not_finite = 0;
        let light = light.to_array().map(|light| {
            not_finite += u64::from(!(light as f32).is_finite());
            let light = if (light as f32).is_finite() { light } else { f64::from(finite(light as f32)) };
            light.min(f64::from(view.clamp))
        });
        self.take_deviation(i, light, number);
        if let Some(replicates) = &mut self.replicates {
            replicates.add_sample(i, light, number);
        }
        match &mut self.totals {
            Some(totals) => totals.iter_mut().zip(light).for_each(|(total, light)| total[i] += light),
            None => self.sums.iter_mut().zip(light).for_each(|(sum, light)| sum[i] = light as f32),
        }
        not_finite
    }

    /// Takes in how far a sample lies from those before it, where that is asked for.
    fn take_deviation(&mut self, i: usize, light: [f64; 3], before: u32) {
        if let (Some(deviations), Some(totals)) = (&mut self.deviations, &self.totals) {
            let earlier = Sum { light: [0, 1, 2].map(|c| totals[c][i]), count: before };
            deviations.take(i, earlier, light);
        }
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
        Self::index_in(self.blocks_across(), x, y)
    }

    /// The same in a tile of so many blocks across.
    #[inline]
    pub(super) fn index_in(blocks_across: u32, x: u32, y: u32) -> usize {
        let block = (y / BLOCK) * blocks_across + x / BLOCK;
        block as usize * BLOCK_PIXELS + ((y % BLOCK) * BLOCK + x % BLOCK) as usize
    }

    /// Column and row in the whole picture of the pixel at an index of the columns.
    pub(crate) fn place_of(&self, i: usize) -> [u32; 2] {
        if let Some(&place) = self.ray_places.get(i) {
            return place;
        }
        let (block, within) = ((i / BLOCK_PIXELS) as u32, (i % BLOCK_PIXELS) as u32);
        let (across, down) = (block % self.blocks_across(), block / self.blocks_across());
        [self.x + across * BLOCK + within % BLOCK, self.y + down * BLOCK + within / BLOCK]
    }

    /// The mean of a pixel's samples.
    #[inline]
    pub(crate) fn radiance(&self, i: usize) -> [f32; 3] {
        match &self.totals {
            None => [self.sums[0][i], self.sums[1][i], self.sums[2][i]],
            Some(totals) => {
                let count = f64::from(self.counts.of(i).max(1));
                [0, 1, 2].map(|c| (totals[c][i] / count) as f32)
            }
        }
    }

    /// What a pixel shows.
    pub(super) fn entity(&self, i: usize) -> Option<EntityId> {
        self.entities.get(self.surface[i] as usize).copied()
    }

    /// How many samples a pixel holds.
    pub(crate) fn samples(&self, i: usize) -> u32 {
        self.counts.of(i)
    }

    /// The standard error of the luminance of a pixel, where it can be told.
    pub(super) fn standard_error(&self, i: usize) -> Option<f32> {
        let luminance = |[red, green, blue]: [f64; 3]| Rgb::new(red, green, blue).luminance();
        match self.replicates {
            Some(_) => self.error_by_sequences(i, luminance),
            None => self.error_by_samples(i, self.deviations.as_ref()?.of_luminance(i)),
        }
        .map(|error| finite(error as f32))
    }

    /// The standard errors of the channels of a pixel, where they can be told.
    pub(crate) fn channel_errors(&self, i: usize) -> Option<[f64; 3]> {
        let of = |channel: usize| match self.replicates {
            Some(_) => self.error_by_sequences(i, |light| light[channel]),
            None => self.error_by_samples(i, self.deviations.as_ref()?.of_channel(i, channel)?),
        };
        Some([of(0)?, of(1)?, of(2)?])
    }

    /// As the means of sequences that know nothing of each other tell it, of a number that is made from the light.
    fn error_by_sequences(&self, i: usize, of: impl Fn([f64; 3]) -> f64) -> Option<f64> {
        let samples = self.samples(i);
        let error = self.replicates.as_ref()?.error(i, samples, of)?;
        let deviation = (self.deviations.as_ref()?.of_luminance(i) / f64::from(samples)).sqrt();
        // Where all means agree and samples do not, it is what one sample can bring about: two kinds of them lie at least
        // two of their deviations apart.
        Some(if error > 0.0 { error } else { 2.0 * deviation / f64::from(samples) })
    }

    /// As the squared deviations of samples tell it, were they independent.
    fn error_by_samples(&self, i: usize, deviations: f64) -> Option<f64> {
        let count = f64::from(self.samples(i));
        (count >= 2.0).then(|| (deviations / (count * (count - 1.0))).sqrt())
    }

    /// Adds the samples of a pixel of another tile to those of one of this.
    pub(super) fn add(&mut self, i: usize, other: &Self, j: usize) {
        let sums = [self.sum(i), other.sum(j)];
        match (&mut self.deviations, &other.deviations) {
            (Some(mine), Some(theirs)) => mine.join(i, (theirs, j), sums),
            _ => self.deviations = None,
        }
        self.replicates = None;
        let [mine, theirs] = sums.map(|sum| sum.light);
        let pixels = self.depth.len();
        if self.totals.is_none() {
            let sums = &self.sums;
            let held = |c: usize| {
                let mut column = zeros(Column::default(), pixels);
                column.iter_mut().zip(sums[c].iter()).for_each(|(total, sum)| *total = f64::from(*sum));
                column
            };
            self.totals = Some([held(0), held(1), held(2)]);
        }
        if let Some(totals) = &mut self.totals {
            (0..3).for_each(|c| totals[c][i] = mine[c] + theirs[c]);
        }
        self.counts.add(i, other.samples(j), pixels);
        self.blank = None;
    }

    pub(super) fn sum(&self, i: usize) -> Sum {
        let light = match &self.totals {
            Some(totals) => [0, 1, 2].map(|c| totals[c][i]),
            None => [0, 1, 2].map(|c| f64::from(self.sums[c][i])),
        };
        Sum { light, count: self.samples(i) }
    }
}
