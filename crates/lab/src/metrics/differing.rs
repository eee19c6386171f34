//! Differing pixels: how many pixels have a channel that differs by more than a threshold?

use super::{Metric, Viewing};
use crate::Pair;

/// Number of differing pixels.
pub(super) const METRIC: Metric = Metric {
    name: "differing",
    doc: "pixels with a channel that differs by more than the threshold",
    measure,
};

fn measure(pair: Pair<'_>, viewing: &Viewing) -> f64 {
    let past =
        |(a, b): &(&[f32; 3], &[f32; 3])| a.iter().zip(*b).any(|(a, b)| (a - b).abs() > viewing.threshold);
    pair.pixels().filter(past).count() as f64
}

#[cfg(test)]
mod tests {
    use super::super::tests::between;
    use super::*;
    use crate::Picture;

    #[test]
    fn a_pixel_counts_once_however_many_channels_differ() {
        assert_eq!(between(METRIC, [0.0; 3], [1.0; 3]), 15.0);
    }

    #[test]
    fn a_difference_of_just_the_threshold_does_not_count() {
        let reference = Picture::filled(3, 1, [0.0; 3]).unwrap();
        let test = Picture::new(3, 1, vec![[0.25; 3], [0.5; 3], [0.0; 3]]).unwrap();
        let viewing = Viewing { threshold: 0.25, ..Viewing::default() };
        assert_eq!(measure(Pair::new(&reference, &test).unwrap(), &viewing), 1.0);
    }
}
