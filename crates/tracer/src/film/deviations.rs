//! How far apart do the samples of a pixel lie? Squared deviations from their mean, of luminances and, where they are
//! asked for, of each channel.

use super::sums::Sum;
use crate::Moments;
use crate::lanes::Column;

/// Those of the pixels of a tile.
#[derive(Debug, Clone, Default)]
pub(super) struct Deviations {
    luminance: Column<f64>,
    channels: Option<[Column<f64>; 3]>,
}

impl Deviations {
    /// What a view asks for, of a tile of so many pixels, without samples; earlier ones leave their memory.
    pub(super) fn empty(earlier: Option<Self>, moments: Moments, pixels: usize) -> Option<Self> {
        if moments == Moments::None {
            return None;
        }
        let Self { luminance, channels } = earlier.unwrap_or_default();
        let channels = (moments == Moments::Channels)
            .then(|| channels.unwrap_or_default().map(|column| zeros(column, pixels)));
        Some(Self { luminance: zeros(luminance, pixels), channels })
    }

    /// That of the luminances of a pixel's samples.
    #[inline(always)]
    pub(super) fn of_luminance(&self, i: usize) -> f64 {
        self.luminance[i]
    }

    /// That of a channel, where it is known.
    pub(super) fn of_channel(&self, i: usize, channel: usize) -> Option<f64> {
        Some(self.channels.as_ref()?[channel][i])
    }

    /// The samples of a pixel are alike.
    pub(super) fn clear(&mut self, i: usize) {
        self.luminance[i] = 0.0;
        self.channels.iter_mut().flatten().for_each(|column| column[i] = 0.0);
    }

    /// One more sample joins those of a pixel.
    #[inline(always)]
    pub(super) fn take(&mut self, i: usize, samples: Sum, sample: [f64; 3]) {
        let sample = Sum { light: sample, count: 1 };
        self.luminance[i] += samples.spread_to(sample);
        if let Some(channels) = &mut self.channels {
            (0..3).for_each(|c| channels[c][i] += samples.spread_of(c, sample));
        }
    }

    /// The samples of a pixel of another tile join those of a pixel of this: theirs are in `other`, with sums of both.
    pub(super) fn join(&mut self, i: usize, (other, j): (&Self, usize), [mine, theirs]: [Sum; 2]) {
        self.luminance[i] += other.luminance[j] + mine.spread_to(theirs);
        match (&mut self.channels, &other.channels) {
            (Some(channels), Some(others)) => {
                (0..3).for_each(|c| channels[c][i] += others[c][j] + mine.spread_of(c, theirs));
            }
            _ => self.channels = None,
        }
    }
}

/// A column of so many zeros.
pub(super) fn zeros(mut column: Column<f64>, pixels: usize) -> Column<f64> {
    column.resize(pixels, 0.0);
    column.fill(0.0);
    column
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLES: [[f64; 3]; 4] = [[1.0, 0.0, 0.5], [3.0, 0.0, 0.0], [1.0, 8.0, 0.5], [3.0, 0.0, 1.0]];

    fn sum(samples: &[[f64; 3]]) -> Sum {
        let light = [0, 1, 2].map(|c| samples.iter().map(|light| light[c]).sum());
        Sum { light, count: samples.len() as u32 }
    }

    /// Of one pixel, from these samples one after the other.
    fn taken(samples: &[[f64; 3]], moments: Moments) -> Deviations {
        let mut taken = Deviations::empty(None, moments, 1).unwrap();
        (0..samples.len()).for_each(|n| taken.take(0, sum(&samples[..n]), samples[n]));
        taken
    }

    #[test]
    fn each_channel_has_its_own_however_samples_come_together() {
        let all = taken(&SAMPLES, Moments::Channels);
        let (some, others) = SAMPLES.split_at(1);
        let mut joined = taken(some, Moments::Channels);
        joined.join(0, (&taken(others, Moments::Channels), 0), [sum(some), sum(others)]);
        for found in [&all, &joined] {
            assert_eq!([0, 1, 2].map(|c| found.of_channel(0, c)), [Some(4.0), Some(48.0), Some(0.5)]);
            assert!((found.of_luminance(0) / all.of_luminance(0) - 1.0).abs() < 1e-12);
        }
        joined.clear(0);
        assert_eq!((joined.of_luminance(0), joined.of_channel(0, 1)), (0.0, Some(0.0)));
    }

    #[test]
    fn channels_are_known_where_both_parts_know_them() {
        let (with, without) = (taken(&SAMPLES, Moments::Channels), taken(&SAMPLES, Moments::Luminance));
        for (mut one, other) in [(with.clone(), &without), (without.clone(), &with)] {
            one.join(0, (other, 0), [sum(&SAMPLES); 2]);
            assert_eq!((one.of_luminance(0), one.of_channel(0, 0)), (2.0 * with.of_luminance(0), None));
        }
        assert!(Deviations::empty(Some(with), Moments::None, 1).is_none());
    }
}
