//! Which part of the picture does a pixel show, and how much does each place in it count? Reconstruction filters, by
//! importance: samples lie as densely as the filter is high, so that all of them count alike.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::numeric::SAMPLE_STEP;

/// Declares the enum and its tables: a variant, its name, its reach in pixels from the middle, where the share `u` of it
/// ends (in pixels from the middle), and a sentence.
macro_rules! filters {
    ($($variant:ident = $name:literal, $reach:literal, $place:expr, $doc:literal;)+) => {
        /// A filter, the same along both axes. One sample lies in a pixel's centre by any of them.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Filter { $(#[doc = $doc] $variant),+ }

        impl Filter {
            /// Every filter there is, the default first.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// Its name on the command line.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),+ }
            }

            /// How far it reaches from the middle of a pixel to either side, in pixels.
            #[must_use]
            pub const fn reach(self) -> f64 {
                match self { $(Self::$variant => $reach),+ }
            }

            /// From the middle of a pixel, in pixels, so far that the share `u` of the filter lies before it.
            fn end_of_share(self, u: f64) -> f64 {
                match self { $(Self::$variant => { let place: fn(f64) -> f64 = $place; place(u) })+ }
            }
        }
    };
}

filters! {
    Box = "box", 0.5, |u| u - 0.5, "The pixel itself, all of it alike.";
    Tent = "tent", 1.0, tent, "Falls off evenly to 0 at the middles of the neighbours: radius 1.";
    BlackmanHarris = "blackman-harris", 1.5, blackman_harris,
        "The window of Blackman and Harris, radius 1.5: soft, and free of ringing.";
}

impl Default for Filter {
    fn default() -> Self {
        Self::ALL[0]
    }
}

impl Filter {
    /// The filter of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|filter| filter.name() == name)
    }

    /// How far from a pixel's left or upper edge a sample lies, in pixels, for a number in 0..1: a multiple of
    /// [`SAMPLE_STEP`], as the number is by the box.
    pub(crate) fn place(self, number: f64) -> f64 {
        match self {
            Self::Box => number,
            _ => 0.5 + (self.end_of_share(number) / SAMPLE_STEP).round() * SAMPLE_STEP,
        }
    }

    /// How far beyond a pixel's own edges it reaches, in pixels.
    pub(crate) const fn margin(self) -> f64 {
        self.reach() - 0.5
    }
}

fn tent(u: f64) -> f64 {
    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 * (1.0 - u)).sqrt() }
}

/// The window's terms: Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform", 1978.
const WINDOW: [f64; 4] = [0.35875, 0.48829, 0.14128, 0.01168];

/// Half its width, pixels.
const RADIUS: f64 = 1.5;

/// What share of the window lies before `x`.
fn share_before(x: f64) -> f64 {
    let wave = |k: usize| {
        let turns = k as f64 * PI / RADIUS;
        WINDOW[k] * (turns * x).sin() / turns
    };
    0.5 + (wave(1) + wave(2) + wave(3)) / (2.0 * RADIUS * WINDOW[0]) + x / (2.0 * RADIUS)
}

/// Steps of the table of where shares end.
const STEPS: usize = 4096;

/// Where each share of the window ends, by halving: 60 times, to the last bit.
static ENDS: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let end = |step: usize| {
        let share = step as f64 / STEPS as f64;
        let (mut low, mut high) = (-RADIUS, RADIUS);
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if share_before(middle) < share { low = middle } else { high = middle }
        }
        high
    };
    // Of one half, so that both are alike.
    let half: Vec<f64> =
        (0..=STEPS / 2).map(|step| if step == STEPS / 2 { 0.0 } else { end(step) }).collect();
    let other = half.iter().rev().skip(1).map(|end| -end);
    half.iter().copied().chain(other).collect()
});

fn blackman_harris(u: f64) -> f64 {
    let at = u * STEPS as f64;
    let step = (at as usize).min(STEPS - 1);
    let [from, to] = [ENDS[step], ENDS[step + 1]];
    (to - from).mul_add(at - step as f64, from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_filter_is_found_by_its_name() {
        for filter in Filter::ALL {
            assert_eq!(Filter::named(filter.name()), Some(*filter));
        }
        assert_eq!((Filter::named("gauss"), Filter::default()), (None, Filter::Box));
    }

    #[test]
    fn one_sample_lies_in_the_middle_and_all_lie_within_reach_on_whole_steps() {
        for filter in Filter::ALL {
            assert_eq!(filter.place(0.5), 0.5, "{filter:?}");
            let (mut last, margin) = (f64::NEG_INFINITY, filter.margin());
            for step in 0..1 << 12 {
                let place = filter.place(f64::from(step) / f64::from(1 << 12));
                assert!(place >= last && (-margin..=1.0 + margin).contains(&place), "{filter:?} {place}");
                assert_eq!((place / SAMPLE_STEP).fract(), 0.0);
                // What columns of `f32` keep.
                assert_eq!(f64::from(place as f32), place);
                last = place;
            }
        }
    }

    /// Moments of samples, against those of the filters' formulas.
    #[test]
    fn samples_are_as_dense_as_the_filter_is_high() {
        let spread = |filter: Filter, weight: &dyn Fn(f64) -> f64| {
            let count = 1 << 16;
            let sampled = (0..count).map(|i| filter.place((f64::from(i) + 0.5) / f64::from(count)) - 0.5);
            let sampled = sampled.map(|x| x * x).sum::<f64>() / f64::from(count);
            let steps = 100_000;
            let places =
                (0..steps).map(|i| ((f64::from(i) + 0.5) / f64::from(steps) * 2.0 - 1.0) * filter.reach());
            let (mut square, mut whole) = (0.0, 0.0);
            for x in places {
                square += weight(x) * x * x;
                whole += weight(x);
            }
            (sampled, square / whole)
        };
        let window = |x: f64| (0..4).map(|k| WINDOW[k] * (k as f64 * PI * x / RADIUS).cos()).sum::<f64>();
        let weights: [&dyn Fn(f64) -> f64; 3] = [&|_| 1.0, &|x| 1.0 - x.abs(), &window];
        for (filter, weight) in Filter::ALL.iter().zip(weights) {
            let (sampled, exact) = spread(*filter, weight);
            assert!((sampled / exact - 1.0).abs() < 1e-3, "{filter:?}: {sampled} against {exact}");
        }
    }
}
