//! What do all pixels have in common of one of their samples?

use crate::View;
use crate::filter::Filter;
use crate::lanes::Word;
use crate::pattern::in_whole_steps;
use crate::sampler::{Sampler, pairs, seed_of_sequence};

/// One of the samples that every pixel has.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    /// Counted from 0.
    pub(crate) number: u32,
    /// Whether its hit is kept as the pixel's depth and surface.
    pub(crate) kept: bool,
    /// Its number within its sequence.
    pub(crate) index: u32,
    /// How far from a pixel's left and upper edge it lies, in pixels; `None` where every pixel has a place of its own.
    pub(crate) shared: Option<[f64; 2]>,
    pub(crate) filter: Filter,
    seed: u32,
}

impl Sample {
    /// Of a view, by its number.
    pub(crate) fn new(view: &View, number: u32) -> Self {
        let sequences = view.sequences.max(1);
        Self {
            number,
            kept: number == view.pattern.first_among(view.samples),
            index: number / sequences,
            shared: view
                .pattern
                .shared_place(view.samples, number)
                .map(|place| place.map(|u| view.filter.place(u))),
            filter: view.filter,
            seed: seed_of_sequence(view.seed, number % sequences),
        }
    }

    /// The numbers of a pixel of the whole picture, or of a register of them, that its choices go by.
    #[inline(always)]
    pub(crate) fn sampler<W: Word>(&self, x: W, y: W) -> Sampler<W> {
        Sampler::new(self.seed, x, y)
    }

    /// How far from a pixel's left and upper edge the sample lies, in pixels.
    pub(crate) fn place(&self, sampler: Sampler<u32>) -> [f64; 2] {
        self.shared.unwrap_or_else(|| {
            sampler.pair(self.index, pairs::PLACE).map(|bits| self.filter.place(in_whole_steps(bits)))
        })
    }
}
