//! How sure is the mean of samples that are spread evenly? Several sequences of them that know nothing of each other say so.

use crate::lanes::Column;
use crate::numeric::SUM_ERROR;

/// The light of each of several sequences of a tile's samples, which are counted off in turn.
#[derive(Debug, Clone, Default)]
pub(super) struct Replicates {
    sums: Vec<[Column<f32>; 3]>,
}

impl Replicates {
    /// So many of a tile of so many pixels, without samples.
    pub(super) fn empty(mut self, sequences: u32, pixels: usize) -> Self {
        self.sums.resize_with(sequences as usize, Default::default);
        for column in self.sums.iter_mut().flatten() {
            column.resize(pixels, 0.0);
            column.fill(0.0);
        }
        self
    }

    /// Adds the light of a sample to the pixels whose goals are beyond its number.
    #[inline(always)]
    pub(super) fn take_sample(&mut self, light: &[Column<f32>; 3], goals: Option<&Column<u32>>, number: u32) {
        let sequence = number as usize % self.sums.len();
        for (sum, light) in self.sums[sequence].iter_mut().zip(light) {
            if let Some(goals) = goals {
                for ((sum, light), goal) in sum.iter_mut().zip(light.iter()).zip(goals.iter()) {
                    *sum += if *goal > number { *light } else { 0.0 };
                }
            } else {
                sum.iter_mut().zip(light.iter()).for_each(|(sum, light)| *sum += *light);
            }
        }
    }

    /// Adds the light of a sample to a pixel.
    pub(super) fn add_sample(&mut self, i: usize, light: [f64; 3], number: u32) {
        let sequence = number as usize % self.sums.len();
        for (sum, light) in self.sums[sequence].iter_mut().zip(light) {
            sum[i] += light as f32;
        }
    }

    /// The standard error of a pixel's mean, of a number that is made from its light; `None` where not every sequence has as
    /// many samples as the others, and some.
    ///
    /// It is so large that 1.96 of it hold what Student's distribution says for so few means: 95 % of errors. 0 where all
    /// means agree, up to their rounding.
    pub(super) fn error(&self, i: usize, samples: u32, of: impl Fn([f64; 3]) -> f64) -> Option<f64> {
        if samples == 0 || !samples.is_multiple_of(SEQUENCES) || self.sums.len() != SEQUENCES as usize {
            return None;
        }
        let each = f64::from(samples / SEQUENCES);
        let mean_of = |sum: &[Column<f32>; 3]| of([0, 1, 2].map(|c| f64::from(sum[c][i]) / each));
        let count = f64::from(SEQUENCES);
        let mean = self.sums.iter().map(mean_of).sum::<f64>() / count;
        let squares: f64 = self.sums.iter().map(|sum| (mean_of(sum) - mean).powi(2)).sum();
        let error = (squares / (count * (count - 1.0))).sqrt();
        Some(if error <= each * SUM_ERROR * mean.abs() { 0.0 } else { error * STUDENT })
    }
}

/// How many sequences there are where errors are judged by them.
///
/// Few make Student's quantile large and the error unsure of itself; many leave each sequence fewer samples to be even in.
pub(crate) const SEQUENCES: u32 = 16;

/// How much further the middle 95 % of Student's distribution of 15 degrees of freedom reach than those of the normal one.
const STUDENT: f64 = 2.131_449_546 / 1.959_963_985;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn as_many_means_as_said_lie_within_the_error() {
        let mut random = Random(7);
        let (trials, mut within) = (20_000, 0);
        for _ in 0..trials {
            let mut replicates = Replicates::default().empty(SEQUENCES, 1);
            // Sums of numbers in 0..1 are nearly normal.
            let mut sum = 0.0;
            for number in 0..SEQUENCES * 8 {
                let light = random.number().abs().fract();
                sum += light;
                replicates.add_sample(0, [light; 3], number);
            }
            let error = replicates.error(0, SEQUENCES * 8, |light| light[0]).unwrap();
            let mean = sum / f64::from(SEQUENCES * 8);
            within += u32::from((mean - 0.5).abs() <= 1.96 * error);
        }
        let share = f64::from(within) / f64::from(trials);
        assert!((0.945..0.955).contains(&share), "{share}");
    }

    #[test]
    fn sequences_that_agree_leave_no_error_and_uneven_ones_tell_none() {
        let mut replicates = Replicates::default().empty(SEQUENCES, 1);
        for number in 0..2 * SEQUENCES {
            replicates.add_sample(0, [f64::from(number / SEQUENCES) + 0.1; 3], number);
        }
        let error = |samples| replicates.error(0, samples, |light| light[1]);
        assert_eq!([error(0), error(SEQUENCES + 1), error(2 * SEQUENCES)], [None, None, Some(0.0)]);
    }
}
