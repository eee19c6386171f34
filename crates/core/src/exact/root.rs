//! Where on a ray something is met: a root of an equation of first or second degree, kept as what it is made of.

use std::cmp::Ordering;

use super::{Number, Verdict};

/// The number `(p ± √s) / q` with q > 0, or p / q.
#[derive(Debug, Clone)]
pub struct Root<N> {
    /// p.
    pub rational: N,
    /// ± √s; `None` for none.
    pub radical: Option<Radical<N>>,
    /// q, greater than 0.
    pub divisor: N,
}

/// The part `± √s` of a [`Root`].
#[derive(Debug, Clone)]
pub struct Radical<N> {
    /// Whether it is added.
    pub positive: bool,
    /// s, at least 0.
    pub square: N,
    /// `(p² − s) / q`, the constant term of the equation: the root is also this over `p ∓ √s`.
    pub norm: N,
}

/// A root in `f64`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Located {
    /// In units of the ray's direction.
    pub t: f64,
    /// Bound on how far `t` may be off.
    pub error: f64,
}

impl<N: Number> Root<N> {
    /// `p / q`; `None` where q is 0.
    ///
    /// # Errors
    /// When q may or may not be 0.
    pub fn ratio(p: &N, q: &N) -> Verdict<Option<Self>> {
        let (rational, divisor) = match q.sign()? {
            Ordering::Equal => return Ok(None),
            Ordering::Greater => (p.clone(), q.clone()),
            Ordering::Less => (p.negative(), q.negative()),
        };
        Ok(Some(Self { rational, radical: None, divisor }))
    }

    /// How it compares with another root.
    ///
    /// # Errors
    /// When the two lie too close together for such numbers.
    pub fn compare(&self, other: &Self) -> Verdict<Ordering> {
        let difference = self.rational.times(&other.divisor).minus(&other.rational.times(&self.divisor));
        if self.radical.is_none() && other.radical.is_none() {
            return difference.sign();
        }
        let zero = N::of(0.0);
        let part = |root: &Self, factor: &N, added: bool| match &root.radical {
            None => (zero.clone(), zero.clone()),
            Some(r) if r.positive == added => (factor.clone(), r.square.clone()),
            Some(r) => (factor.negative(), r.square.clone()),
        };
        let (b, s) = part(self, &other.divisor, true);
        let (c, r) = part(other, &self.divisor, false);
        N::sign_with_roots([&difference, &b, &c], [&s, &r])
    }
}
