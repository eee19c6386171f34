//! Relative mean squared error: squared differences over the squared reference, so that dark regions count as bright ones do.
//!
//! d² / (reference² + 0.01) as in Rousselle, Knaus, Zwicker, "Adaptive Sampling and Reconstruction using Greedy Error
//! Minimization", ACM Trans. Graph. 30(6), 2011, whose small term keeps black pixels from dividing by nothing.

use super::{Metric, Viewing};
use crate::Pair;

/// The small term below the fraction: standard, from the paper.
const FLOOR: f64 = 0.01;

/// Relative mean squared error.
pub(super) const METRIC: Metric =
    Metric { name: "relmse", doc: "mean of squared difference over squared reference + 0.01", measure };

fn measure(pair: Pair<'_>, _: &Viewing) -> f64 {
    pair.mean(|reference, test| (test - reference).powi(2) / (reference * reference + FLOOR))
}

#[cfg(test)]
mod tests {
    use super::super::tests::between;
    use super::*;

    #[test]
    fn the_same_difference_weighs_less_on_a_bright_reference() {
        assert_eq!(between(METRIC, [0.0; 3], [0.5; 3]), 25.0);
        assert!((between(METRIC, [1.0; 3], [1.5; 3]) - 0.25 / 1.01).abs() < 1e-15);
    }
}
