//! How many samples does each pixel need? Passes over a picture, until every pixel is as sure as it is asked to be, or time
//! is over.
//!
//! A pixel's samples are counted off in turn to [`SEQUENCES`] sequences that know nothing of each other. Their means lie as
//! far apart as even samples err, which the samples themselves would not tell; Student's quantile makes up for how few they
//! are. Each pixel is judged by itself, from what it has found and nothing else, so bits depend on neither tiles nor crops.
//!
//! It stops at numbers of samples that are set beforehand: [`FIRST`], and then what its error asks for, at least twice as
//! many each time. So most of what a last error is judged by is new, and that it was looked at before biases it little
//! (Stein's two-stage procedure, "A two-sample test for a linear hypothesis whose power is independent of the variance",
//! Annals of Mathematical Statistics 16(3), 1945, with a power of two of samples in each sequence). Every
//! pixel has so many that a single one that differs by 1 leaves half the target E as error: 2 / E of them. If they are all
//! alike they leave none. What is seen in a share p of a pixel is missed by all with a probability of (1 − p)^(2 / E) at most,
//! 13 % for p = E and 2 % for 2 E.

use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::film::SEQUENCES;
use crate::numeric::{AT_ONCE, MOST_GROWTH};
use crate::{
    Backend, Cancelled, Control, Film, Frame, Moments, Pattern, Pool, Progress, Snapshot, Stats, Tile, Tone,
    View,
};

/// Samples of a pixel before its error is first judged: four in each sequence, so that it is even in itself.
const FIRST: u32 = 4 * SEQUENCES;

/// Samples that are traced between two looks at the clock.
const STRIDE: u32 = FIRST;

/// Samples that no target asks of a pixel that is sure without them.
const LEAST_AT_MOST: u32 = 1024;

/// Of what a pixel's error is the standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Of its radiance.
    Radiance,
    /// Of what is displayed of it, 0..=1.
    Displayed(Tone),
}

/// When a pixel, and when the picture has samples enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// The standard error of each pixel's largest channel that samples are to bring it under.
    pub max_error: Option<f64>,
    /// Of what that is the error.
    pub scale: Scale,
    /// For how long passes are begun. The first of them ends whatever it takes.
    pub time: Option<Duration>,
    /// The most samples a pixel; counted as [`Target::LEAST`] at least.
    pub most: u32,
}

impl Target {
    /// Samples that a pixel has at least, to judge its error by.
    pub const LEAST: u32 = FIRST;

    /// The numbers of samples that pixels may end with.
    fn most(&self) -> u32 {
        // A power of two in each sequence, as only those are even.
        let steps = (self.most / FIRST).max(1);
        FIRST << steps.ilog2()
    }

    /// Samples that every pixel has.
    fn least(&self) -> u32 {
        let needed = self.max_error.map_or(f64::INFINITY, |most| 2.0 / most);
        let needed = needed.min(f64::from(LEAST_AT_MOST)).ceil() as u32;
        (FIRST * needed.div_ceil(FIRST).next_power_of_two()).min(self.most())
    }

    /// The standard error of a pixel's largest channel.
    fn error(&self, tile: &Tile, i: usize) -> f64 {
        let Some(errors) = tile.channel_errors(i) else { return f64::INFINITY };
        let channels = tile.radiance(i).into_iter().zip(errors);
        let of_channel = |(light, error): (f32, f64)| match self.scale {
            Scale::Radiance => error,
            // Half of what lies between the ends, which also holds where the curve bends.
            Scale::Displayed(tone) => {
                let at = |light: f64| tone.value(light as f32);
                let light = f64::from(light);
                0.5 * (at(light + error) - at(light - error))
            }
        };
        channels.map(of_channel).fold(0.0, f64::max)
    }

    /// Up to how many samples a pixel that has reached its goal goes on; that goal itself where it ends.
    fn next_goal(&self, alike: bool, error: f64, samples: u32) -> u32 {
        if samples >= self.most() {
            return samples;
        }
        let least = self.least();
        if alike {
            return samples.max(least);
        }
        let Some(most) = self.max_error else { return 2 * samples };
        let enough = if samples == FIRST { AT_ONCE * most } else { most };
        if error <= enough {
            return samples.max(least);
        }
        // The error falls with the root of the number of samples at least.
        let times = (error / most).powi(2).clamp(2.0, f64::from(MOST_GROWTH)).ceil() as u32;
        samples.saturating_mul(times.next_power_of_two()).max(least).min(self.most())
    }
}

/// What a render with a target has come to.
#[derive(Debug, Clone, Copy)]
pub struct Reached {
    /// What was done.
    pub stats: Stats,
    /// The fewest samples of a pixel.
    pub fewest: u32,
    /// Their mean number.
    pub mean: f64,
    /// The most samples of a pixel.
    pub most: u32,
    /// The largest standard error of a pixel; 0 for an empty picture.
    pub error: f64,
    /// Pixels that end above the target: as the time was over, or with the most samples that they may have.
    pub unfinished: u64,
}

/// Traces a picture into `film`, tile by tile and pass by pass, on the threads of `pool`, with as many samples a pixel as a
/// target asks for, by [`Pattern::Owen`]; the view's samples, its range and its pattern do not count. The film then
/// tells for each pixel how many samples it has ([`Film::samples`]) and its [standard error](Film::standard_error).
///
/// Without a limit of time the result depends on neither the number of threads nor the size of the tiles.
///
/// # Errors
/// [`Cancelled`] when `control` said so.
///
/// # Panics
/// A film of another part of the picture than the view's.
pub fn render_until(
    backend: &dyn Backend,
    snapshot: &Snapshot,
    (view, target): (&View, &Target),
    film: &mut Film,
    pool: &Pool,
    control: &Control,
) -> Result<Reached, Cancelled> {
    assert_eq!(film.region(), view.region(), "the film holds what the view shows");
    let started = Instant::now();
    let view = View {
        samples: target.most(),
        sequences: SEQUENCES,
        pattern: Pattern::Owen,
        moments: Moments::Luminance,
        range: None,
        ..view.clone()
    };
    let passes = Passes { backend, snapshot, view: &view, target, control, pool, started };
    passes.run(film)
}

/// Passes over a picture.
struct Passes<'a> {
    backend: &'a dyn Backend,
    snapshot: &'a Snapshot,
    view: &'a View,
    target: &'a Target,
    control: &'a Control,
    pool: &'a Pool,
    started: Instant,
}

impl Passes<'_> {
    fn run(&self, film: &mut Film) -> Result<Reached, Cancelled> {
        film.tiles_mut().iter_mut().for_each(|tile| tile.set_goals_to(FIRST));
        let (mut stats, mut samples) = (Stats::default(), 0);
        loop {
            let end = samples + if samples == 0 { SEQUENCES } else { STRIDE - samples % STRIDE };
            stats += self.trace(film, samples..end)?;
            samples = end;
            // Errors are judged where sequences are even.
            let level = samples >= FIRST && (samples / FIRST).is_power_of_two();
            let found = self.judge(film, level.then_some(samples));
            self.control.report(found.progress(self.started));
            if found.active == 0 || self.is_late() {
                film.tiles_mut().iter_mut().for_each(Tile::forget_goals);
                return Ok(found.reached(stats));
            }
        }
    }

    fn is_late(&self) -> bool {
        self.target.time.is_some_and(|time| self.started.elapsed() >= time)
    }

    /// Traces some samples of the pixels that need them, tile by tile until the time is over.
    fn trace(&self, film: &mut Film, samples: std::ops::Range<u32>) -> Result<Stats, Cancelled> {
        let view = View { range: Some(samples.clone()), ..self.view.clone() };
        let frame = Frame::new(self.snapshot, &view);
        let trace = |tile: &mut Tile| {
            if self.control.is_cancelled() {
                return Err(Cancelled);
            }
            let late = samples.start > 0 && self.is_late();
            let (stats, needed) = (Stats::default(), tile.has_goals_beyond(samples.start));
            let stats = if needed && !late {
                tile.begin(self.snapshot.entities(), &view);
                Stats::with_exact(|| self.backend.trace(&frame, tile))
            } else {
                stats
            };
            self.control.advance(1);
            Ok(stats)
        };
        let tiles = film.tiles_mut();
        self.control.start(tiles.len());
        let add = |mut a: Stats, b: Stats| {
            a += b;
            Ok(a)
        };
        self.pool.run(|| tiles.par_iter_mut().with_max_len(1).map(trace).try_reduce(Stats::default, add))
    }

    /// Looks at every pixel, and sets new goals for those that have reached theirs with so many samples.
    fn judge(&self, film: &mut Film, level: Option<u32>) -> Found {
        let judge = |tile: &mut Tile| {
            let (mut found, width, height) = (Found::NOTHING, tile.width, tile.height);
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let i = tile.index(x, y);
                let (samples, alike) = (tile.samples(i), tile.is_alike(i));
                let error = if alike { 0.0 } else { self.target.error(tile, i) };
                if level == Some(samples) && tile.goal(i) == samples {
                    tile.set_goal(i, self.target.next_goal(alike, error, samples));
                }
                let unfinished = self.target.max_error.is_some_and(|most| error > most);
                found = found.and(&Found::of(samples, error, tile.goal(i) > samples, unfinished));
            }
            found
        };
        let tiles = film.tiles_mut();
        self.pool.run(|| tiles.par_iter_mut().map(judge).reduce(|| Found::NOTHING, |a, b| a.and(&b)))
    }
}

/// What is known of some pixels.
#[derive(Debug, Clone, Copy)]
struct Found {
    pixels: u64,
    samples: u64,
    fewest: u32,
    most: u32,
    error: f64,
    /// Pixels that go on.
    active: u64,
    unfinished: u64,
}

impl Found {
    const NOTHING: Self =
        Self { pixels: 0, samples: 0, fewest: u32::MAX, most: 0, error: 0.0, active: 0, unfinished: 0 };

    fn of(samples: u32, error: f64, active: bool, unfinished: bool) -> Self {
        Self {
            pixels: 1,
            samples: u64::from(samples),
            fewest: samples,
            most: samples,
            error,
            active: u64::from(active),
            unfinished: u64::from(unfinished),
        }
    }

    fn and(&self, other: &Self) -> Self {
        Self {
            pixels: self.pixels + other.pixels,
            samples: self.samples + other.samples,
            fewest: self.fewest.min(other.fewest),
            most: self.most.max(other.most),
            error: self.error.max(other.error),
            active: self.active + other.active,
            unfinished: self.unfinished + other.unfinished,
        }
    }

    fn mean(&self) -> f64 {
        self.samples as f64 / self.pixels.max(1) as f64
    }

    fn progress(&self, started: Instant) -> Progress {
        Progress { samples: self.mean(), error: self.error, seconds: started.elapsed().as_secs_f64() }
    }

    fn reached(&self, stats: Stats) -> Reached {
        Reached {
            stats,
            fewest: self.fewest.min(self.most),
            mean: self.mean(),
            most: self.most,
            error: self.error,
            unfinished: self.unfinished,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn target(max_error: Option<f64>, most: u32) -> Target {
        Target { max_error, scale: Scale::Radiance, time: None, most }
    }

    #[test]
    fn the_most_samples_are_a_power_of_two_of_each_sequence() {
        let most = |most| target(None, most).most();
        assert_eq!([1, 64, 100, 128, 1000, 65_536].map(most), [64, 64, 64, 128, 512, 65_536]);
    }

    #[test]
    fn every_pixel_has_so_many_samples_that_a_single_other_one_would_not_matter() {
        let least = |error| target(Some(error), 65_536).least();
        assert_eq!([0.5, 2.0 / 64.0, 0.02, 1e-9].map(least), [64, 64, 128, 1024]);
        assert_eq!((target(None, 65_536).least(), target(Some(1e-9), 100).least()), (1024, 64));
        let next = |alike, error, samples| target(Some(0.02), 4096).next_goal(alike, error, samples);
        assert_eq!([next(true, 0.0, 64), next(true, 0.0, 128)], [128, 128]);
        assert_eq!([next(false, 0.001, 64), next(false, 0.001, 128)], [128, 128]);
    }

    #[test]
    fn a_pixel_goes_on_for_as_long_as_its_error_asks() {
        let next = |error, samples| target(Some(0.1), 4096).next_goal(false, error, samples);
        assert_eq!(next(0.03, 64), 64, "far below at once");
        assert_eq!(next(0.09, 64), 128, "below, but judged by its first samples");
        assert_eq!([next(0.09, 128), next(0.11, 128)], [128, 256]);
        assert_eq!([next(0.3, 128), next(9.0, 128)], [2048, 2048]);
        assert_eq!([next(9.0, 1024), next(9.0, 4096)], [4096, 4096], "never beyond the most");
        assert_eq!(
            target(None, 4096).next_goal(false, 0.0, 128),
            256,
            "without a target for as long as it can"
        );
    }
}
