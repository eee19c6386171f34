//! Shares of 1, drawn closer where a bilinear function of them is larger.

use crate::numeric::LEAST_DENSITY;

/// A bilinear density over the unit square, by its values at (0, 0), (1, 0), (0, 1) and (1, 1), with a mean of 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Warp([f64; 4]);

impl Warp {
    /// With values at the corners that need not be positive.
    pub(super) fn new(values: [f64; 4]) -> Self {
        let largest = values.iter().fold(0.0_f64, |most, value| most.max(*value));
        if !(largest > 0.0 && largest.is_finite()) {
            return Self([1.0; 4]);
        }
        let values = values.map(|value| value.max(largest * LEAST_DENSITY));
        let mean = values.iter().sum::<f64>() / 4.0;
        Self(values.map(|value| value / mean))
    }

    /// Where two even shares go, and how dense shares are there.
    pub(super) fn place(&self, [u, v]: [f64; 2]) -> ([f64; 2], f64) {
        let [a, b, c, d] = self.0;
        let second = linear(v, (a + b) / 2.0, (c + d) / 2.0);
        let (low, high) = (between(second, a, c), between(second, b, d));
        let first = linear(u, low, high);
        ([first, second], between(first, low, high))
    }
}

/// Where an even share goes under a density that is linear from `a` at 0 to `b` at 1.
fn linear(share: f64, a: f64, b: f64) -> f64 {
    share * (a + b) / (a + between(share, a * a, b * b).sqrt())
}

fn between(share: f64, a: f64, b: f64) -> f64 {
    share.mul_add(b - a, a)
}
