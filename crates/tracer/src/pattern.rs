//! Sample patterns: positions of samples within a pixel.

use crate::numeric::SAMPLE_STEP;
use crate::sampler::{share, sobol};

/// A pattern of samples within a pixel; one sample lies in the middle by any of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pattern {
    /// Sobol's first two dimensions, scrambled by Owen's method, in each pixel by itself: as even as the grid in squares,
    /// no two samples in one row or column, and what error is left is noise, not steps.
    #[default]
    Owen,
    /// The same, but alike in all pixels: what error is left is a pattern.
    Sobol,
    /// A square grid, alike in all pixels. Steps along edges that run along the grid. Numbers of samples are to be squares;
    /// of others the last row is not full.
    Grid,
}

impl Pattern {
    /// Every pattern there is, the default first.
    pub const ALL: &'static [Self] = &[Self::Owen, Self::Sobol, Self::Grid];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Owen => "owen",
            Self::Sobol => "sobol",
            Self::Grid => "grid",
        }
    }

    /// The pattern of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|pattern| pattern.name() == name)
    }

    /// Which of so many samples stands for the pixel where one does, for depth and surface: the one in the middle of a
    /// grid, else the first.
    pub(crate) fn first_among(self, samples: u32) -> u32 {
        let side = side(samples);
        match self {
            Self::Grid => ((side / 2) * side + side / 2).min(samples.saturating_sub(1)),
            Self::Owen | Self::Sobol => 0,
        }
    }

    /// Where sample number `sample` of so many lies, as shares of the pixel from its left and upper edge: multiples of
    /// [`SAMPLE_STEP`] from 0 to below 1. `None` where every pixel has places of its own.
    pub(crate) fn shared_place(self, samples: u32, sample: u32) -> Option<[f64; 2]> {
        let side = side(samples);
        let middle = |k: u32| (((f64::from(k) + 0.5) / f64::from(side)) / SAMPLE_STEP).round() * SAMPLE_STEP;
        match self {
            _ if samples <= 1 => Some([0.5; 2]),
            Self::Owen => None,
            Self::Sobol => Some(sobol(sample, SEEDS).map(in_whole_steps)),
            Self::Grid => Some([middle(sample % side), middle(sample / side)]),
        }
    }
}

/// Samples in a row of a grid.
fn side(samples: u32) -> u32 {
    let below = samples.isqrt();
    if below * below == samples { below } else { below + 1 }
}

/// A share of 1, cut off to a multiple of [`SAMPLE_STEP`].
pub(crate) fn in_whole_steps(bits: u32) -> f64 {
    (share(bits) / SAMPLE_STEP).floor() * SAMPLE_STEP
}

/// What the two dimensions of [`Pattern::Sobol`] are scrambled with.
const SEEDS: [u32; 2] = [0x5bd1_e995, 0x9e37_79b9];

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    const SHARED: [Pattern; 2] = [Pattern::Sobol, Pattern::Grid];

    fn places(pattern: Pattern, samples: u32) -> Vec<[f64; 2]> {
        (0..samples).map(|k| pattern.shared_place(samples, k).unwrap()).collect()
    }

    #[test]
    fn one_sample_lies_in_the_middle() {
        for pattern in Pattern::ALL {
            assert_eq!(places(*pattern, 1), [[0.5, 0.5]]);
        }
    }

    #[test]
    fn sixteen_scrambled_samples_lie_one_in_each_cell_of_every_shape() {
        for (columns, rows) in [(1, 16), (2, 8), (4, 4), (8, 2), (16, 1)] {
            let cell = |[x, y]: [f64; 2]| ((x * f64::from(columns)) as u32, (y * f64::from(rows)) as u32);
            let cells: HashSet<_> = places(Pattern::Sobol, 16).into_iter().map(cell).collect();
            assert_eq!(cells.len(), 16, "{columns} x {rows}");
        }
    }

    #[test]
    fn samples_lie_within_their_pixel_on_whole_steps() {
        for (pattern, samples) in SHARED.iter().flat_map(|p| [1, 2, 4, 9, 49, 50, 4096].map(|n| (*p, n))) {
            for share in places(pattern, samples).into_iter().flatten() {
                assert!(
                    (0.0..1.0).contains(&share) && (share / SAMPLE_STEP).fract() == 0.0,
                    "{pattern:?} {share}"
                );
            }
        }
    }

    #[test]
    fn the_first_of_a_grid_lies_nearest_to_its_middle() {
        for samples in [1, 4, 9, 16, 25] {
            let [x, y] = places(Pattern::Grid, samples)[Pattern::Grid.first_among(samples) as usize];
            assert!((0.5..=0.75).contains(&x) && x == y, "{samples}: {x}");
        }
        assert!((1..40).all(|samples| Pattern::Grid.first_among(samples) < samples));
    }
}
