//! Sample patterns: positions of samples within a pixel.

use crate::numeric::SAMPLE_STEP;
use crate::sampler::{share, sobol};

/// A pattern of samples within a pixel, the same in every pixel; one sample lies in the middle by any of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pattern {
    /// A square grid. Best where nothing is known of what is seen; steps along edges that run along the grid.
    #[default]
    Grid,
    /// Sobol's first two dimensions, scrambled by Owen's method: as even as the grid in squares, and no two samples in
    /// one row or column, so that an edge of any direction is seen in as many shades as there are samples.
    Sobol,
}

impl Pattern {
    /// Every pattern there is.
    pub const ALL: &'static [Self] = &[Self::Grid, Self::Sobol];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Sobol => "sobol",
        }
    }

    /// The pattern of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|pattern| pattern.name() == name)
    }

    /// How far from a pixel's left and upper edge its sample number `row * grid + column` lies, in pixels: multiples of
    /// [`SAMPLE_STEP`] from 0 to below 1.
    pub(crate) fn place(self, grid: u32, column: u32, row: u32) -> [f64; 2] {
        let in_steps = |share: f64| (share / SAMPLE_STEP).round() * SAMPLE_STEP;
        let middle = |k: u32| in_steps((f64::from(k) + 0.5) / f64::from(grid));
        match self {
            Self::Sobol if grid > 1 => {
                sobol(row.wrapping_mul(grid).wrapping_add(column), SEEDS).map(in_whole_steps)
            }
            _ => [middle(column), middle(row)],
        }
    }
}

/// A share of 1, cut off to a multiple of [`SAMPLE_STEP`].
fn in_whole_steps(bits: u32) -> f64 {
    (share(bits) / SAMPLE_STEP).floor() * SAMPLE_STEP
}

/// What the two dimensions are scrambled with.
const SEEDS: [u32; 2] = [0x5bd1_e995, 0x9e37_79b9];

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    fn places(pattern: Pattern, grid: u32) -> Vec<[f64; 2]> {
        (0..grid * grid).map(|k| pattern.place(grid, k % grid, k / grid)).collect()
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
            let cells: HashSet<_> = places(Pattern::Sobol, 4).into_iter().map(cell).collect();
            assert_eq!(cells.len(), 16, "{columns} x {rows}");
        }
    }

    #[test]
    fn samples_lie_within_their_pixel_on_whole_steps() {
        for (pattern, grid) in Pattern::ALL.iter().flat_map(|p| [1, 2, 3, 7, 64].map(|grid| (*p, grid))) {
            for share in places(pattern, grid).into_iter().flatten() {
                assert!(
                    (0.0..1.0).contains(&share) && (share / SAMPLE_STEP).fract() == 0.0,
                    "{pattern:?} {share}"
                );
            }
        }
    }
}
