//! How far apart are the samples of pixels whose light is added up in parts, wherever it comes from?
//!
//! A sample is all light of one camera ray, with that of the streams of rays it has led to: what the sum has become greater
//! by between two calls. Its error is a rounding of the sum, so of samples that are alike a standard error remains of up
//! to 10⁻⁷ of their mean, or 0 where their sums need no rounding.

use super::Tile;
use super::sums::Sum;
use crate::lanes::Column;

/// The sums of a tile's pixels before the sample under way.
#[derive(Default)]
pub(crate) struct EarlierSums {
    light: [Column<f32>; 3],
}

impl EarlierSums {
    /// Takes in that the pixels of a tile hold one sample more than the `count` of the last call, if the tile is asked for
    /// standard errors.
    pub(crate) fn add_sample(&mut self, tile: &mut Tile, count: u32) {
        let Some(deviations) = &mut tile.deviations else { return };
        if count > 0 {
            for (i, deviation) in deviations.iter_mut().enumerate() {
                let [before, after] =
                    [&self.light, &tile.sums].map(|sums| [0, 1, 2].map(|c| f64::from(sums[c][i])));
                let sample = [0, 1, 2].map(|c| after[c] - before[c]);
                *deviation += Sum { light: before, count }.spread_to(Sum { light: sample, count: 1 });
            }
        }
        for (earlier, sums) in self.light.iter_mut().zip(&tile.sums) {
            earlier.resize(sums.len(), 0.0);
            earlier.copy_from_slice(sums);
        }
    }
}
