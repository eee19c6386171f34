//! What is kept of a pixel's samples: the sum of their light, how many they are, and how far apart they lie.
//!
//! How far apart is kept as the sum of the squared deviations of their luminances (and, where asked for, of each
//! channel) from their mean, in `f64`. A plain sum of squares would lose a small spread to rounding, and squares of
//! `f32` light can pass every `f32`. Sums of two sets of samples make that of both: Chan, Golub and LeVeque, "Updating
//! formulae and a pairwise algorithm for computing sample variances", 1979.

use catoptra_core::Rgb;

use crate::lanes::Column;

/// Stores a sum of light so that it is finite: past every number it becomes the largest, no number becomes black. 1 where
/// it was not finite, else 0.
#[inline(always)]
pub(crate) fn store_finite(pixel: &mut f32, sum: f32) -> u64 {
    *pixel = finite(sum);
    u64::from(!sum.is_finite())
}

/// See [`store_finite`].
#[inline(always)]
pub(super) fn finite(sum: f32) -> f32 {
    let nearest = if sum > 0.0 { f32::MAX } else { 0.0 };
    if sum.is_finite() { sum } else { nearest }
}

/// How many samples the pixels of a tile hold.
#[derive(Debug, Clone)]
pub(super) enum Counts {
    /// All the same number.
    Uniform(u32),
    /// Each pixel a number of its own.
    Varying(Column<u32>),
}

impl Counts {
    /// As many as each pixel is to have, up to a number.
    pub(super) fn up_to(goals: &Column<u32>, most: u32) -> Self {
        let mut counts = goals.clone();
        counts.iter_mut().for_each(|count| *count = (*count).min(most));
        Self::Varying(counts)
    }

    /// How many a pixel holds.
    pub(super) fn of(&self, i: usize) -> u32 {
        match self {
            Self::Uniform(count) => *count,
            Self::Varying(counts) => counts[i],
        }
    }

    /// Counts more samples for one of `pixels` pixels.
    pub(super) fn add(&mut self, i: usize, more: u32, pixels: usize) {
        if let Self::Uniform(count) = *self {
            let mut counts = Column::default();
            counts.resize(pixels, count);
            *self = Self::Varying(counts);
        }
        if let Self::Varying(counts) = self {
            counts[i] = counts[i].saturating_add(more);
        }
    }
}

/// The light of some samples of a pixel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sum {
    pub(crate) light: [f64; 3],
    pub(crate) count: u32,
}

impl Sum {
    /// What the squared deviations of the luminances of these samples and others from their common mean are more than
    /// those of each from their own. Where the means are equal it is 0.
    #[inline(always)]
    pub(crate) fn spread_to(self, others: Self) -> f64 {
        self.spread_by(others, |[red, green, blue]| Rgb::new(red, green, blue).luminance())
    }

    /// The same of one channel.
    #[inline(always)]
    pub(crate) fn spread_of(self, channel: usize, others: Self) -> f64 {
        self.spread_by(others, |light| light[channel])
    }

    #[inline(always)]
    fn spread_by(self, others: Self, number: impl Fn([f64; 3]) -> f64) -> f64 {
        if self.count == 0 || others.count == 0 {
            return 0.0;
        }
        let [n, m] = [self.count, others.count].map(f64::from);
        let apart = number(std::array::from_fn(|c| others.light[c] / m - self.light[c] / n));
        apart * apart * (n * m / (n + m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn stored_sums_are_finite_and_those_that_were_not_are_counted() {
        let stored = [2.5, -1.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN].map(|sum| {
            let mut pixel = 7.0;
            (store_finite(&mut pixel, sum), pixel)
        });
        assert_eq!(stored, [(0, 2.5), (0, -1.0), (1, f32::MAX), (1, 0.0), (1, 0.0)]);
    }

    #[test]
    fn pixels_of_one_tile_can_hold_different_numbers_of_samples() {
        let mut counts = Counts::Uniform(4);
        assert_eq!(counts.of(2), 4);
        counts.add(1, 12, 3);
        assert_eq!([0, 1, 2].map(|i| counts.of(i)), [4, 16, 4]);
        let Counts::Varying(goals) = counts else { panic!("a column") };
        let counts = Counts::up_to(&goals, 6);
        assert_eq!([0, 1, 2].map(|i| counts.of(i)), [4, 6, 4]);
    }

    fn sum(samples: &[[f64; 3]]) -> Sum {
        let light = std::array::from_fn(|c| samples.iter().map(|light| light[c]).sum());
        Sum { light, count: samples.len() as u32 }
    }

    /// The squared deviations by their definition.
    fn deviations(samples: &[[f64; 3]]) -> f64 {
        let luminances: Vec<f64> = samples.iter().map(|[r, g, b]| Rgb::new(*r, *g, *b).luminance()).collect();
        let mean = luminances.iter().sum::<f64>() / luminances.len() as f64;
        luminances.iter().map(|luminance| (luminance - mean).powi(2)).sum()
    }

    #[test]
    fn spreads_add_up_to_the_squared_deviations_however_samples_are_parted() {
        let mut random = Random(5);
        let samples: Vec<[f64; 3]> = (0..40).map(|_| [(); 3].map(|()| random.number().abs())).collect();
        let one_by_one: f64 = (1..40).map(|n| sum(&samples[..n]).spread_to(sum(&samples[n..=n]))).sum();
        let (some, others) = samples.split_at(11);
        let parted = deviations(some) + deviations(others) + sum(some).spread_to(sum(others));
        for found in [one_by_one, parted] {
            assert!((found / deviations(&samples) - 1.0).abs() < 1e-12, "{found}");
        }
        assert_eq!(sum(&[]).spread_to(sum(some)).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn samples_that_are_alike_have_no_spread_and_the_largest_no_infinite_one() {
        let alike = |count: u32| Sum { light: [0.3_f64, 0.7, 0.1].map(|v| v * f64::from(count)), count };
        assert!(alike(4).spread_to(alike(1)) < 1e-30);
        let largest = Sum { light: [f64::from(f32::MAX); 3], count: 3 };
        assert!(largest.spread_to(Sum { light: [0.0; 3], count: 1 }).is_finite());
    }
}
