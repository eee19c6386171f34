//! How coarse must a frame be to keep up with the hand, and by which steps does it become fine? Pure arithmetic:
//! the seconds that recent pixels took decide the first divisor, and each later step halves it down to 1. A full picture
//! that is at rest is then given more samples, batch by batch.

use std::ops::Range;
use std::time::Duration;

/// What one frame may take while something moves, in milliseconds, unless a person says otherwise: one of 60 a second.
pub(crate) const USUAL_FRAME: f64 = 16.0;

/// The share of a frame's time that is for tracing; the rest is for showing it.
const TRACED_SHARE: f64 = 0.72;

/// The divisors that a first frame may have: each pixel of the film stands for a square of that many pixels.
const DIVISORS: [u32; 9] = [1, 2, 3, 4, 6, 8, 12, 16, 24];

/// The divisor of the very first frame, when nothing has been measured.
const UNMEASURED: u32 = 8;

/// Below this number of pixels a measurement says more about starting threads than about tracing.
const TELLING_PIXELS: u64 = 1000;

/// The share of the budget that a finer first frame than the last one must keep to, so that the first frames of a
/// drag do not flicker between two divisors.
const FINER: f64 = 0.75;

/// The weight of a new measurement against all before it.
const NEWEST: f64 = 0.3;

/// How fast pixels have lately been traced.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Pace {
    seconds_per_pixel: Option<f64>,
    last_first: u32,
}

impl Pace {
    /// Takes in a finished frame of that many pixels.
    pub(crate) fn record(&mut self, pixels: u64, took: Duration) {
        if pixels < TELLING_PIXELS || took.is_zero() {
            return;
        }
        let new = took.as_secs_f64() / pixels as f64;
        self.seconds_per_pixel = Some(self.seconds_per_pixel.map_or(new, |old| old + NEWEST * (new - old)));
    }

    /// Notes that a first frame did not end in time: pixels are dearer than was thought.
    pub(crate) fn overran(&mut self) {
        self.seconds_per_pixel = self.seconds_per_pixel.map(|s| 2.0 * s);
    }

    /// The divisors for a picture of `width` x `height` of which the first is to take `frame` milliseconds, coarsest first,
    /// always ending in 1.
    pub(crate) fn steps(&mut self, (width, height): (u32, u32), frame: f64) -> Vec<u32> {
        let mut divisor = self.first(width, height, 1e-3 * TRACED_SHARE * frame);
        self.last_first = divisor;
        let mut steps = vec![divisor];
        while divisor > 1 {
            divisor /= 2;
            steps.push(divisor);
        }
        steps
    }

    fn first(&self, width: u32, height: u32, budget: f64) -> u32 {
        let Some(cost) = self.seconds_per_pixel else { return UNMEASURED };
        let fits = |d: &&u32| {
            let budget = if **d < self.last_first { FINER * budget } else { budget };
            pixels(reduced(width, height, **d)) as f64 * cost <= budget
        };
        DIVISORS.iter().find(fits).copied().unwrap_or(DIVISORS[DIVISORS.len() - 1])
    }
}

/// The size of a film whose pixels each stand for `divisor` x `divisor` pixels; never empty unless the picture is.
pub(crate) fn reduced(width: u32, height: u32, divisor: u32) -> (u32, u32) {
    (width.div_ceil(divisor), height.div_ceil(divisor))
}

/// Some more of the samples of a full picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Batch {
    /// Samples that each pixel has before.
    pub(crate) from: u32,
    /// Samples that each pixel has after it.
    pub(crate) to: u32,
    /// Samples that each pixel is to have.
    pub(crate) of: u32,
}

impl Batch {
    /// The batches to `of` samples a pixel, with `stride` samples each.
    pub(crate) fn all(of: u32, stride: u32) -> Vec<Self> {
        let starts = (0..of).step_by(stride.max(1) as usize);
        starts.map(|from| Self { from, to: (from + stride.max(1)).min(of), of }).collect()
    }

    /// The numbers of its samples.
    pub(crate) fn range(self) -> Range<u32> {
        self.from..self.to
    }

    /// Whether none comes after it.
    pub(crate) fn is_last(self) -> bool {
        self.to == self.of
    }
}

fn pixels((width, height): (u32, u32)) -> u64 {
    u64::from(width) * u64::from(height)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fast_scene_is_traced_in_full_at_once() {
        let mut pace = Pace::default();
        pace.record(1_000_000, Duration::from_secs_f64(0.005));
        assert_eq!(pace.steps((1280, 720), USUAL_FRAME), [1]);
    }

    #[test]
    fn a_slow_scene_starts_coarse_and_ends_in_full() {
        let mut pace = Pace::default();
        pace.record(1280 * 720, Duration::from_secs_f64(0.4));
        assert_eq!(pace.steps((1280, 720), USUAL_FRAME), [6, 3, 1]);
    }

    #[test]
    fn the_first_frame_is_coarse_until_something_is_measured() {
        assert_eq!(Pace::default().steps((1280, 720), USUAL_FRAME), [8, 4, 2, 1]);
    }

    #[test]
    fn the_coarsest_step_is_taken_when_nothing_fits() {
        let mut pace = Pace::default();
        pace.record(10_000, Duration::from_secs_f64(100.0));
        assert_eq!(pace.steps((1280, 720), USUAL_FRAME)[0], 24);
    }

    #[test]
    fn an_overrun_makes_the_next_frame_coarser() {
        let mut pace = Pace::default();
        pace.record(1_000_000, Duration::from_secs_f64(0.012));
        let before = pace.steps((1000, 1000), USUAL_FRAME)[0];
        for _ in 0..3 {
            pace.overran();
        }
        assert!(pace.steps((1000, 1000), USUAL_FRAME)[0] > before);
    }

    #[test]
    fn a_first_frame_becomes_finer_only_with_time_to_spare() {
        let mut pace = Pace::default();
        pace.record(1_000_000, Duration::from_secs_f64(0.013));
        assert_eq!(pace.steps((1000, 1000), USUAL_FRAME)[0], 2);
        pace.seconds_per_pixel = Some(0.011e-6);
        assert_eq!(pace.steps((1000, 1000), USUAL_FRAME)[0], 2);
        pace.seconds_per_pixel = Some(0.008e-6);
        assert_eq!(pace.steps((1000, 1000), USUAL_FRAME)[0], 1);
    }

    #[test]
    fn a_longer_frame_is_finer() {
        let mut pace = Pace::default();
        pace.record(1280 * 720, Duration::from_secs_f64(0.4));
        let firsts = [100.0, 33.0, 16.0, 5.0].map(|frame| pace.steps((1280, 720), frame)[0]);
        assert_eq!(firsts, [3, 6, 6, 12]);
    }

    #[test]
    fn passes_follow_each_other_up_to_the_last_sample() {
        for (of, stride) in [(16, 4), (10, 4), (3, 8), (5, 0), (0, 4)] {
            let batches = Batch::all(of, stride);
            let ranges: Vec<u32> = batches.iter().flat_map(|batch| batch.range()).collect();
            assert_eq!(ranges, (0..of).collect::<Vec<u32>>());
            let last = batches.iter().filter(|batch| batch.is_last()).count();
            assert_eq!(last, usize::from(of > 0));
        }
    }

    #[test]
    fn a_handful_of_pixels_tells_nothing() {
        let mut pace = Pace::default();
        pace.record(10, Duration::from_secs_f64(1.0));
        assert_eq!(pace.steps((100, 100), USUAL_FRAME)[0], UNMEASURED);
    }

    #[test]
    fn a_reduced_film_covers_the_whole_picture() {
        assert_eq!(reduced(1281, 719, 8), (161, 90));
        assert_eq!(reduced(1, 1, 24), (1, 1));
    }
}
