//! How coarse must a frame be to keep up with the hand, and by which steps does it become fine? Pure arithmetic:
//! the seconds that recent pixels took decide the first divisor, and each later step halves it down to 1. Where drafts are
//! cheaper than what stays, all steps are drafts, and tiles take the place of the last one as they are refined.

use std::time::Duration;

use crate::draft::Quality;

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

/// The share of a full pixel's cost that a draft's must stay below to be worth its looks.
const CHEAP: f64 = 0.8;

/// One frame on the way to a full picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Step {
    /// How many pixels each way one of it stands for.
    pub(crate) divisor: u32,
    /// How well each is traced.
    pub(crate) quality: Quality,
}

impl Step {
    /// Every pixel in full.
    pub(crate) const FULL: Self = Self { divisor: 1, quality: Quality::Full };
}

/// How fast pixels have lately been traced.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Pace {
    /// Seconds that a pixel of a draft took.
    draft: Option<f64>,
    /// The same of one in full.
    full: Option<f64>,
    last_first: u32,
}

impl Pace {
    /// Takes in a finished frame of that many pixels.
    pub(crate) fn record(&mut self, quality: Quality, pixels: u64, took: Duration) {
        if pixels < TELLING_PIXELS || took.is_zero() {
            return;
        }
        let new = took.as_secs_f64() / pixels as f64;
        let cost = self.cost_mut(quality);
        *cost = Some(cost.map_or(new, |old| old + NEWEST * (new - old)));
    }

    /// Notes that a first frame did not end in time: pixels are dearer than was thought.
    pub(crate) fn overran(&mut self, quality: Quality) {
        let cost = self.cost_mut(quality);
        *cost = cost.map(|seconds| 2.0 * seconds);
    }

    /// The steps to a picture of `width` x `height` of which the first is to take `frame` milliseconds, coarsest first, always
    /// ending with every pixel: `drafts` if there are any and they are cheaper, as far as is known.
    pub(crate) fn steps(&mut self, (width, height): (u32, u32), frame: f64, drafts: bool) -> Vec<Step> {
        let quality = if drafts && self.drafts_pay() { Quality::Draft } else { Quality::Full };
        let mut divisor = self.first(quality, (width, height), 1e-3 * TRACED_SHARE * frame);
        self.last_first = divisor;
        let mut steps = vec![Step { divisor, quality }];
        while divisor > 1 {
            divisor /= 2;
            steps.push(Step { divisor, quality });
        }
        steps
    }

    fn drafts_pay(&self) -> bool {
        self.draft.zip(self.full).is_none_or(|(draft, full)| draft < CHEAP * full)
    }

    fn cost_mut(&mut self, quality: Quality) -> &mut Option<f64> {
        match quality {
            Quality::Draft => &mut self.draft,
            Quality::Full => &mut self.full,
        }
    }

    fn first(&self, quality: Quality, (width, height): (u32, u32), budget: f64) -> u32 {
        let cost = match quality {
            // None is dearer than what it is the draft of.
            Quality::Draft => self.draft.or(self.full),
            Quality::Full => self.full,
        };
        let Some(cost) = cost else { return UNMEASURED };
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

fn pixels((width, height): (u32, u32)) -> u64 {
    u64::from(width) * u64::from(height)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pace that has seen a full picture.
    fn paced(pixels: u64, seconds: f64) -> Pace {
        let mut pace = Pace::default();
        pace.record(Quality::Full, pixels, Duration::from_secs_f64(seconds));
        pace
    }

    fn divisors(pace: &mut Pace, size: (u32, u32), frame: f64) -> Vec<u32> {
        pace.steps(size, frame, false).into_iter().map(|step| step.divisor).collect()
    }

    #[test]
    fn a_fast_scene_is_traced_in_full_at_once() {
        assert_eq!(divisors(&mut paced(1_000_000, 0.005), (1280, 720), USUAL_FRAME), [1]);
    }

    #[test]
    fn a_slow_scene_starts_coarse_and_ends_in_full() {
        assert_eq!(divisors(&mut paced(1280 * 720, 0.4), (1280, 720), USUAL_FRAME), [6, 3, 1]);
    }

    #[test]
    fn the_first_frame_is_coarse_until_something_is_measured() {
        assert_eq!(divisors(&mut Pace::default(), (1280, 720), USUAL_FRAME), [8, 4, 2, 1]);
    }

    #[test]
    fn the_coarsest_step_is_taken_when_nothing_fits() {
        assert_eq!(divisors(&mut paced(10_000, 100.0), (1280, 720), USUAL_FRAME)[0], 24);
    }

    #[test]
    fn an_overrun_makes_the_next_frame_coarser() {
        let mut pace = paced(1_000_000, 0.012);
        let before = divisors(&mut pace, (1000, 1000), USUAL_FRAME)[0];
        for _ in 0..3 {
            pace.overran(Quality::Full);
        }
        assert!(divisors(&mut pace, (1000, 1000), USUAL_FRAME)[0] > before);
    }

    #[test]
    fn a_first_frame_becomes_finer_only_with_time_to_spare() {
        let mut pace = paced(1_000_000, 0.013);
        let mut first = |full: f64| {
            pace.full = Some(full);
            divisors(&mut pace, (1000, 1000), USUAL_FRAME)[0]
        };
        assert_eq!([0.013e-6, 0.011e-6, 0.008e-6].map(&mut first), [2, 2, 1]);
    }

    #[test]
    fn a_longer_frame_is_finer() {
        let mut pace = paced(1280 * 720, 0.4);
        let firsts = [100.0, 33.0, 16.0, 5.0].map(|frame| divisors(&mut pace, (1280, 720), frame)[0]);
        assert_eq!(firsts, [3, 6, 6, 12]);
    }

    #[test]
    fn steps_are_drafts_while_these_are_cheap() {
        let mut pace = paced(1280 * 720, 0.4);
        let mut steps = |draft: Option<f64>| {
            pace.draft = draft.map(|seconds| seconds / (1280.0 * 720.0));
            let steps = pace.steps((1280, 720), USUAL_FRAME, true);
            steps.into_iter().map(|step| (step.divisor, step.quality)).collect::<Vec<_>>()
        };
        let (draft, full) = (Quality::Draft, Quality::Full);
        assert_eq!(steps(None), [(6, draft), (3, draft), (1, draft)], "it may be cheaper");
        assert_eq!(steps(Some(0.03)), [(2, draft), (1, draft)]);
        assert_eq!(steps(Some(0.004)), [(1, draft)]);
        assert_eq!(steps(Some(0.38)), [(6, full), (3, full), (1, full)], "it is not cheaper");
    }

    #[test]
    fn a_handful_of_pixels_tells_nothing() {
        assert_eq!(divisors(&mut paced(10, 1.0), (100, 100), USUAL_FRAME)[0], UNMEASURED);
    }

    #[test]
    fn a_reduced_film_covers_the_whole_picture() {
        assert_eq!(reduced(1281, 719, 8), (161, 90));
        assert_eq!(reduced(1, 1, 24), (1, 1));
    }
}
