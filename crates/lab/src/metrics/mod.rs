//! Which error metrics are there? The contract of a metric and the list of them; each stands in a file of its own.

mod differing;
mod flip;
mod maximum;
mod mse;
mod relative;
mod rmse;
mod ulps;

use crate::Pair;

pub use flip::flip_map;

/// One way to say how far a picture is from its reference: 0 for equal pictures, larger for worse ones.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    /// The word for it on command lines and in JSON.
    pub name: &'static str,
    /// What it measures, in one line.
    pub doc: &'static str,
    /// Measures a pair; never NaN, since pictures are finite.
    pub measure: fn(Pair<'_>, &Viewing) -> f64,
}

/// Under which conditions two pictures are judged; metrics read what concerns them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewing {
    /// A pixel counts as differing where a channel differs by more than this; default 0, any difference.
    pub threshold: f32,
    /// Pixels in one degree of the viewer's sight, greater than 0. Default 67.02, the value FLIP is published with: a screen
    /// 3840 pixels and 0.7 m wide, seen from 0.7 m.
    pub pixels_per_degree: f64,
}

impl Default for Viewing {
    fn default() -> Self {
        Self { threshold: 0.0, pixels_per_degree: 3840.0 * std::f64::consts::PI / 180.0 }
    }
}

/// Every metric:
///
/// ```
/// let names: Vec<&str> = catoptra_lab::METRICS.iter().map(|metric| metric.name).collect();
/// assert_eq!(names, ["mse", "rmse", "relmse", "max-difference", "max-ulps", "differing", "flip"]);
/// ```
pub static METRICS: &[Metric] = &[
    mse::METRIC,
    rmse::METRIC,
    relative::METRIC,
    maximum::METRIC,
    ulps::METRIC,
    differing::METRIC,
    flip::METRIC,
];

/// The metric of that name.
pub fn metric_named(name: &str) -> Option<&'static Metric> {
    METRICS.iter().find(|metric| metric.name == name)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::Picture;

    /// Measures two pictures of one colour each.
    pub(crate) fn between(metric: Metric, reference: [f32; 3], test: [f32; 3]) -> f64 {
        let (a, b) = (Picture::filled(5, 3, reference).unwrap(), Picture::filled(5, 3, test).unwrap());
        (metric.measure)(Pair::new(&a, &b).unwrap(), &Viewing::default())
    }

    #[test]
    fn every_metric_is_zero_for_equal_pictures() {
        for metric in METRICS {
            assert_eq!(between(*metric, [0.1, 0.6, 3.0], [0.1, 0.6, 3.0]), 0.0, "{}", metric.name);
        }
    }

    #[test]
    fn every_metric_sees_a_difference() {
        for metric in METRICS {
            assert!(between(*metric, [0.1, 0.6, 0.3], [0.2, 0.5, 0.3]) > 0.0, "{}", metric.name);
        }
    }

    #[test]
    fn every_metric_is_a_number_for_the_largest_values() {
        for metric in METRICS {
            assert!(!between(*metric, [f32::MAX; 3], [-f32::MAX; 3]).is_nan(), "{}", metric.name);
        }
    }

    #[test]
    fn names_are_found_and_unique() {
        for metric in METRICS {
            assert!(std::ptr::eq(metric_named(metric.name).unwrap(), metric));
        }
        assert!(metric_named("psnr").is_none());
    }
}
