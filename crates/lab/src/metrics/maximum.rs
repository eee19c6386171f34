//! Maximum difference: the largest difference of any channel of any pixel, in the unit of the values.

use super::{Metric, Viewing};
use crate::Pair;

/// Largest difference.
pub(super) const METRIC: Metric =
    Metric { name: "max-difference", doc: "largest difference of any channel of any pixel", measure };

fn measure(pair: Pair<'_>, _: &Viewing) -> f64 {
    pair.values().map(|(reference, test)| (test - reference).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::tests::between;
    use super::*;

    #[test]
    fn the_widest_channel_counts_whatever_its_sign() {
        assert_eq!(between(METRIC, [0.5, 0.5, 1.0], [0.75, 0.5, 0.0]), 1.0);
    }
}
