//! What do independent sets of rays say together, and how sure are they?
//!
//! Rays of one set are spread evenly and so depend on each other; sets do not. How far their answers lie apart is the error of
//! their mean, whatever is gained by spreading.

use catoptra_core::Rgb;

/// How many sets there are: a standard error from 32 is off by an eighth of itself, and ±1.96 of it covers 94 % of normal errors.
pub(super) const SETS: u32 = 32;

/// What rays to a lamp have found.
#[derive(Debug, Clone)]
pub(super) struct Tally {
    /// What the lamp would give if nothing blocked it.
    open: f64,
    /// What the open rays of each set bring, and what all do.
    sums: [[f64; 2]; SETS as usize],
    /// How many there were.
    rays: u64,
}

impl Tally {
    pub(super) fn new(open: f64) -> Self {
        Self { open, sums: [[0.0; 2]; SETS as usize], rays: 0 }
    }

    /// Adds a ray of a set.
    pub(super) fn add(&mut self, set: usize, share: f64, is_open: bool) {
        self.sums[set][0] += if is_open { share } else { 0.0 };
        self.sums[set][1] += share;
        self.rays += 1;
    }

    /// How much is seen, and the standard error of that.
    ///
    /// Seen is the open rays' part of what all bring, of the unblocked lamp: exact where all are open. The error is that of
    /// a ratio of means. Rays tell nothing of what lies between them, and where almost all agree the few others are there by
    /// luck: so one ray's share is added, as another independent error.
    pub(super) fn seen(&self) -> (f64, f64) {
        let sets = f64::from(SETS);
        let all: f64 = self.sums.iter().map(|[_, all]| all).sum();
        if !(all > 0.0) {
            return (0.0, self.open);
        }
        let share = self.sums.iter().map(|[open, _]| open).sum::<f64>() / all;
        let squares: f64 = self.sums.iter().map(|[open, all]| (open - share * all).powi(2)).sum();
        let variance = squares * sets / (sets - 1.0) / (all * all);
        (self.open * share, self.open * (variance + (self.rays as f64).powi(-2)).sqrt())
    }
}

/// What rays to lamps that were picked have found.
#[derive(Debug, Clone, Default)]
pub(super) struct Picks {
    sums: [Rgb; SETS as usize],
}

impl Picks {
    /// Adds what a ray of a set would bring if it were the only one.
    pub(super) fn add(&mut self, set: usize, irradiance: Rgb) {
        self.sums[set] += irradiance;
    }

    /// The mean over so many rays of each set, and its standard error.
    pub(super) fn found(&self, rays: u32) -> (Rgb, Rgb) {
        let sets = f64::from(SETS);
        let sum = self.sums.iter().fold(Rgb::BLACK, |sum, set| sum + *set);
        let mean = sum / sets;
        let spread = self.sums.iter().fold(Rgb::BLACK, |squares, set| {
            let off = *set + mean * -1.0;
            squares + off * off
        });
        let error = spread.map(|squares| (squares / (sets * (sets - 1.0))).sqrt());
        (mean / f64::from(rays), error / f64::from(rays))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn the_error_is_what_means_are_off_by() {
        let (mut random, trials) = (Random(4), 400);
        let (mut covered, mut claimed, mut squares) = (0, 0.0, 0.0);
        for _ in 0..trials {
            let mut tally = Tally::new(2.0);
            for set in 0..SETS as usize {
                (0..8).for_each(|_| tally.add(set, 1.0 + 0.1 * random.number(), random.number() < -0.4));
            }
            let (seen, error) = tally.seen();
            // Numbers lie in −1..=1: three tenths of them are below.
            covered += u32::from((seen - 0.6).abs() < 1.96 * error);
            claimed += error * error;
            squares += (seen - 0.6).powi(2);
        }
        assert!((covered as f64 / f64::from(trials) - 0.95).abs() < 0.03, "{covered}");
        assert!((claimed / squares - 1.0).abs() < 0.2, "{claimed} {squares}");
    }

    #[test]
    fn rays_that_agree_are_not_certain() {
        let mut tally = Tally::new(3.0);
        assert_eq!(tally.seen(), (0.0, 3.0));
        (0..SETS as usize).for_each(|set| tally.add(set, 1.0, true));
        assert_eq!(tally.seen(), (3.0, 3.0 / 32.0));
    }
}
