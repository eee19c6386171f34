//! At which points is an integral taken?

use std::sync::LazyLock;

use crate::Rgb;

/// A place in 0..1 and what it counts for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) at: f64,
    pub(super) weight: f64,
}

/// The rule of Gauss and Legendre with `n` points over 0..1, by Newton's method on the recurrence of Legendre's polynomials.
pub(super) fn gauss_legendre(n: u32) -> Vec<Node> {
    let root = |k: u32| {
        let mut x = (std::f64::consts::PI * (f64::from(k) + 0.75) / (f64::from(n) + 0.5)).cos();
        let mut slope = 1.0;
        // Convergence is quadratic from a start that is good to some thousandths.
        for _ in 0..6 {
            let [value, before] = legendre(n, x);
            slope = f64::from(n) * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        Node { at: f64::midpoint(1.0, x), weight: 1.0 / ((1.0 - x * x) * slope * slope) }
    };
    (0..n).map(root).collect()
}

/// The mean of two colours over cosines from 0 to 1, weighted by twice the cosine.
pub(super) fn mean_over_cosines(value: impl Fn(f64) -> [Rgb; 2]) -> [Rgb; 2] {
    static NODES: LazyLock<Vec<Node>> = LazyLock::new(|| gauss_legendre(24));
    // By the root of the cosine, as what is reflected changes most at grazing angles.
    NODES.iter().fold([Rgb::BLACK; 2], |[a, b], node| {
        let [more_a, more_b] = value(node.at * node.at);
        let weight = 4.0 * node.at.powi(3) * node.weight;
        [a + more_a * weight, b + more_b * weight]
    })
}

/// The polynomials of degree n and n − 1.
fn legendre(n: u32, x: f64) -> [f64; 2] {
    (0..n)
        .map(f64::from)
        .fold([1.0, 0.0], |[p, before], k| [((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0), p])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        for n in [1, 2, 5, 16, 32] {
            let nodes = gauss_legendre(n);
            for power in 0..(2 * n as i32) {
                let sum: f64 = nodes.iter().map(|node| node.at.powi(power) * node.weight).sum();
                assert!((sum * f64::from(power + 1) - 1.0).abs() < 1e-12, "{n} {power}: {sum}");
            }
        }
    }
}
