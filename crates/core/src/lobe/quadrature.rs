//! At which points is an integral taken?

use std::ops::{Add, Mul};
use std::sync::LazyLock;

/// A place in 0..1 and what it counts for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) at: f64,
    pub(super) weight: f64,
}

/// The rule of Gauss and Legendre with `n` points over 0..1, by Newton's method on the recurrence of Legendre's polynomials.
pub(super) fn gauss_legendre<const N: usize>() -> [Node; N] {
    let n = N as u32;
    std::array::from_fn(|k| {
        let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (f64::from(n) + 0.5)).cos();
        let mut slope = 1.0;
        // Convergence is quadratic from a start that is good to some thousandths.
        for _ in 0..6 {
            let [value, before] = legendre(n, x);
            slope = f64::from(n) * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        Node { at: f64::midpoint(1.0, x), weight: 1.0 / ((1.0 - x * x) * slope * slope) }
    })
}

/// ∫ 2µ `value`(µ) dµ over cosines µ from 0 to 1: by the cube root of µ, as what surfaces do changes most at grazing angles.
pub(super) fn mean_over_cosines<T: Add<Output = T> + Mul<f64, Output = T>>(value: impl Fn(f64) -> T) -> T {
    static NODES: LazyLock<[Node; 32]> = LazyLock::new(gauss_legendre);
    let [first, rest @ ..] = NODES.each_ref().map(|n| value(n.at.powi(3)) * (6.0 * n.at.powi(5) * n.weight));
    rest.into_iter().fold(first, Add::add)
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
        exact(&gauss_legendre::<1>());
        exact(&gauss_legendre::<5>());
        exact(&gauss_legendre::<32>());
    }

    fn exact(nodes: &[Node]) {
        for power in 0..(2 * nodes.len() as i32) {
            let sum: f64 = nodes.iter().map(|node| node.at.powi(power) * node.weight).sum();
            assert!((sum * f64::from(power + 1) - 1.0).abs() < 1e-12, "{} {power}: {sum}", nodes.len());
        }
    }

    #[test]
    fn means_over_cosines_are_weighted_by_twice_the_cosine() {
        assert!((mean_over_cosines(|_| 1.0) - 1.0).abs() < 1e-14);
        assert!((mean_over_cosines(|cosine| (1.0 - cosine).powi(5)) - 1.0 / 21.0).abs() < 1e-14);
    }
}
