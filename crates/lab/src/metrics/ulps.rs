//! Maximum distance in ulps: how many `f32` lie between two values at the most; 1 is a difference in the last bit.

use super::{Metric, Viewing};
use crate::{Pair, ulps_f32};

/// Largest distance in representable numbers.
pub(super) const METRIC: Metric =
    Metric { name: "max-ulps", doc: "largest distance in f32 steps (1: the last bit differs)", measure };

fn measure(pair: Pair<'_>, _: &Viewing) -> f64 {
    let steps =
        pair.pixels().flat_map(|(a, b)| (0..3).filter_map(|channel| ulps_f32(a[channel], b[channel])));
    f64::from(steps.max().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::super::tests::between;
    use super::*;

    #[test]
    fn a_difference_in_the_last_bit_is_one_step() {
        assert_eq!(between(METRIC, [1.0, 8.0, 0.0], [1.0, 8.0f32.next_up(), 0.0]), 1.0);
    }
}
