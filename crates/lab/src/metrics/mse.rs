//! Mean squared error: the mean of the squared differences over all values of all channels.

use super::{Metric, Viewing};
use crate::Pair;

/// Mean squared error.
pub(super) const METRIC: Metric =
    Metric { name: "mse", doc: "mean of the squared differences over all channels", measure };

pub(super) fn measure(pair: Pair<'_>, _: &Viewing) -> f64 {
    pair.mean(|reference, test| (test - reference).powi(2))
}

#[cfg(test)]
mod tests {
    use super::super::tests::between;
    use super::*;

    #[test]
    fn squares_are_averaged_over_the_channels() {
        assert_eq!(between(METRIC, [0.0, 0.0, 0.0], [0.5, 0.0, 1.0]), (0.25 + 1.0) / 3.0);
    }
}
