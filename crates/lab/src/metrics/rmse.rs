//! Root mean squared error: the square root of the mean squared error, in the unit of the values.

use super::{Metric, Viewing, mse};
use crate::Pair;

/// Root mean squared error.
pub(super) const METRIC: Metric = Metric {
    name: "rmse",
    doc: "square root of the mean squared difference, in the unit of the values",
    measure,
};

fn measure(pair: Pair<'_>, viewing: &Viewing) -> f64 {
    mse::measure(pair, viewing).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::tests::between;
    use super::*;

    #[test]
    fn an_even_difference_is_its_own_root_mean_square() {
        assert_eq!(between(METRIC, [0.25; 3], [0.75; 3]), 0.5);
    }
}
