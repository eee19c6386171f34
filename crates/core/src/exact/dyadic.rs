//! The exact number: a whole number times a power of two.

use std::cmp::Ordering;

use dashu_int::ops::{BitTest, SquareRoot};
use dashu_int::{IBig, Sign, UBig, Word};
use smallvec::SmallVec;

use super::isolated::Surd;
use super::{Isolated, Located, Number, Root, Verdict};
use crate::Span;
use crate::numeric::UNIT_ROUNDOFF_F64;

/// `mantissa × 2^exponent`, of any size.
#[derive(Debug, Clone)]
pub struct Dyadic {
    mantissa: IBig,
    exponent: i64,
}

/// Bits that roots are computed to before they are rounded to `f64`.
const WORKING_BITS: i64 = 96;

impl Dyadic {
    /// The mantissa at a lower exponent.
    fn at(&self, exponent: i64) -> IBig {
        let up = usize::try_from(self.exponent - exponent).unwrap_or(0);
        if up == 0 { self.mantissa.clone() } else { &self.mantissa << up }
    }

    /// Both at their lower exponent.
    fn aligned(&self, other: &Self) -> (IBig, IBig, i64) {
        let exponent = self.exponent.min(other.exponent);
        (self.at(exponent), other.at(exponent), exponent)
    }

    fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    /// How it compares with zero.
    #[must_use]
    pub fn signum(&self) -> Ordering {
        match self.mantissa.sign() {
            _ if self.is_zero() => Ordering::Equal,
            Sign::Positive => Ordering::Greater,
            Sign::Negative => Ordering::Less,
        }
    }

    fn magnitude(&self) -> UBig {
        self.mantissa.clone().into_parts().1
    }

    /// Its square root, rounded down to [`WORKING_BITS`] and more; 0 for negative numbers.
    fn root(&self) -> Self {
        if self.signum() != Ordering::Greater {
            return Self::of(0.0);
        }
        let missing = (2 * WORKING_BITS - self.mantissa.bit_len() as i64).max(0);
        // The exponent must be even.
        let up = missing + (self.exponent - missing).rem_euclid(2);
        let mantissa = (self.magnitude() << usize::try_from(up).unwrap_or(0)).sqrt();
        Self { mantissa: mantissa.into(), exponent: (self.exponent - up) / 2 }
    }

    /// The quotient `self / other`, within 4u of itself or two subnormal steps; infinite beyond the largest, and for
    /// `other` = 0.
    #[must_use]
    pub fn over(&self, other: &Self) -> f64 {
        if other.is_zero() {
            return f64::INFINITY;
        }
        let (above, below) = (Leading::of(self), Leading::of(other));
        // Each is rounded to f64 once after at most 2⁻⁶⁴ was cut off, then their quotient.
        scaled(above.digits / below.digits, above.exponent - below.exponent)
    }

    /// The nearest `f64`, or one beside it; infinite beyond the largest.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        let Leading { digits, exponent } = Leading::of(self);
        scaled(digits, exponent)
    }

    /// Times 2^`up`.
    #[must_use]
    pub fn doubled(mut self, up: i64) -> Self {
        self.exponent += up;
        self
    }

    /// The least `n` with `|self| < 2^n`; 0 for zero.
    #[must_use]
    pub fn magnitude_bits(&self) -> i64 {
        if self.is_zero() { 0 } else { self.mantissa.bit_len() as i64 + self.exponent }
    }

    /// How `a + b √s` compares with zero.
    pub(super) fn sign_with_root(a: &Self, b: &Self, s: &Self) -> Ordering {
        let of_root = if s.is_zero() { Ordering::Equal } else { b.signum() };
        let of_rest = a.signum();
        if of_root == Ordering::Equal || of_rest == of_root {
            return of_rest;
        }
        if of_rest == Ordering::Equal {
            return of_root;
        }
        // Opposite signs: the larger square wins.
        let excess = a.squared().minus(&b.squared().times(s)).signum();
        if of_rest == Ordering::Greater { excess } else { excess.reverse() }
    }
}

/// The first words of a number, 65 bits and more, rounded to `f64`, and the power of two that they are to be taken times.
struct Leading {
    digits: f64,
    exponent: i64,
}

impl Leading {
    fn of(number: &Dyadic) -> Self {
        let (sign, words) = number.mantissa.as_sign_words();
        let taken = words.len().min((u128::BITS / Word::BITS) as usize);
        let top = words.iter().rev().take(taken);
        let digits = top.fold(0_u128, |sum, &word| sum << Word::BITS | u128::from(word)) as f64;
        Self {
            digits: if sign == Sign::Negative { -digits } else { digits },
            exponent: number.exponent + (words.len() - taken) as i64 * i64::from(Word::BITS),
        }
    }
}

/// `value × 2^exponent`. Powers of two beyond those of `f64` are reached in steps; all but a step into the subnormals
/// are exact.
fn scaled(mut value: f64, exponent: i64) -> f64 {
    let mut left = exponent;
    while left != 0 && value != 0.0 && value.is_finite() {
        let step = left.clamp(-512, 512);
        value *= 2.0_f64.powi(step as i32);
        left -= step;
    }
    value
}

/// How a number of higher degree compares with any.
fn compare_isolated(a: &Isolated, b: &Root<Dyadic>) -> Ordering {
    if let Some(b) = &b.isolated {
        return a.compare(b);
    }
    let zero = Dyadic::of(0.0);
    let (c, s) = match &b.radical {
        None => (0.0, &zero),
        Some(radical) => (if radical.positive { 1.0 } else { -1.0 }, &radical.square),
    };
    a.compare_surd(&Surd { p: &b.rational, c, s, q: &b.divisor })
}

impl Number for Dyadic {
    const EXACT: bool = true;

    /// Numbers that are not finite, which no shape or ray past its door holds, count as 0.
    fn of(value: f64) -> Self {
        if value == 0.0 || !value.is_finite() {
            return Self { mantissa: IBig::ZERO, exponent: 0 };
        }
        let bits = value.to_bits();
        let field = (bits >> 52 & 0x7ff) as i64;
        let fraction = bits & ((1 << 52) - 1);
        let (mantissa, exponent) =
            if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
        let zeros = mantissa.trailing_zeros();
        let mantissa = IBig::from(mantissa >> zeros);
        let exponent = exponent + i64::from(zeros);
        Self { mantissa: if value < 0.0 { -mantissa } else { mantissa }, exponent }
    }

    fn plus(&self, other: &Self) -> Self {
        if self.is_zero() {
            return other.clone();
        }
        if other.is_zero() {
            return self.clone();
        }
        let (a, b, exponent) = self.aligned(other);
        Self { mantissa: a + b, exponent }
    }

    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negative())
    }

    fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::of(0.0);
        }
        Self { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }

    fn negative(&self) -> Self {
        Self { mantissa: -&self.mantissa, exponent: self.exponent }
    }

    fn sign(&self) -> Verdict<Ordering> {
        Ok(self.signum())
    }

    /// By squaring: with X = a + b √s and Y = c √r of opposite signs, X² − Y² has one root less.
    fn sign_with_roots([a, b, c]: [&Self; 3], [s, r]: [&Self; 2]) -> Verdict<Ordering> {
        let x = Self::sign_with_root(a, b, s);
        let y = if r.is_zero() { Ordering::Equal } else { c.signum() };
        if y == Ordering::Equal || x == y {
            return Ok(x);
        }
        if x == Ordering::Equal {
            return Ok(y);
        }
        let rest = a.squared().plus(&b.squared().times(s)).minus(&c.squared().times(r));
        let twice = a.times(b).doubled(1);
        let excess = Self::sign_with_root(&rest, &twice, s);
        Ok(if x == Ordering::Greater { excess } else { excess.reverse() })
    }

    fn find_root<T>(
        coefficients: &[Self; 5],
        _: f64,
        mut take: impl FnMut(Root<Self>) -> Verdict<Option<T>>,
    ) -> Verdict<Option<T>> {
        for root in Isolated::all_of(coefficients) {
            if let Some(taken) = take(Root::isolated(root))? {
                return Ok(Some(taken));
            }
        }
        Ok(None)
    }

    fn sign_changes(coefficients: &[Self; 5], _: f64) -> Verdict<SmallVec<[Root<Self>; 4]>> {
        Ok(Isolated::sign_changes_of(coefficients).into_iter().map(Root::isolated).collect())
    }

    fn compare_isolated(a: &Root<Self>, b: &Root<Self>) -> Verdict<Ordering> {
        Ok(match (&a.isolated, &b.isolated) {
            (Some(isolated), _) => compare_isolated(isolated, b),
            (None, Some(isolated)) => compare_isolated(isolated, a).reverse(),
            (None, None) => return a.compare(b),
        })
    }

    /// A root beyond the largest `f64` is not found.
    fn locate(root: &Root<Self>, span: Span) -> Verdict<Option<Located>> {
        let side = |limit: f64| {
            if limit.is_infinite() {
                return if limit > 0.0 { Ordering::Less } else { Ordering::Greater };
            }
            if let Some(isolated) = &root.isolated {
                return isolated.compare_number(&Self::of(limit));
            }
            let rest = root.rational.minus(&root.divisor.times(&Self::of(limit)));
            match &root.radical {
                None => rest.signum(),
                Some(r) => {
                    Self::sign_with_root(&rest, &Self::of(if r.positive { 1.0 } else { -1.0 }), &r.square)
                }
            }
        };
        if span.min.is_nan() || span.max.is_nan() {
            return Ok(None);
        }
        if side(span.min) == Ordering::Less || side(span.max) == Ordering::Greater {
            return Ok(None);
        }
        let t = match (&root.radical, &root.isolated) {
            (_, Some(isolated)) => isolated.rounded(WORKING_BITS).to_f64(),
            (None, None) => root.rational.over(&root.divisor),
            (Some(radical), None) => {
                let term = radical.square.root();
                let term = if radical.positive { term } else { term.negative() };
                if (root.rational.signum() == Ordering::Greater) == radical.positive {
                    root.rational.plus(&term).over(&root.divisor)
                } else {
                    let conjugate = root.rational.minus(&term);
                    if conjugate.is_zero() { 0.0 } else { radical.norm.over(&conjugate) }
                }
            }
        };
        // A quotient is off by 3u, and what the working bits leave out; a subnormal by a step or two of its own.
        let error = t.abs() * 4.0 * UNIT_ROUNDOFF_F64 + f64::from_bits(2);
        Ok(t.is_finite().then_some(Located { t, error }))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn n(value: f64) -> Dyadic {
        Dyadic::of(value)
    }

    fn finite() -> impl Strategy<Value = f64> {
        any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |v| v.is_finite())
    }

    proptest! {
        #[test]
        fn every_number_comes_back(value in finite()) {
            prop_assert_eq!(n(value).to_f64(), value);
        }

        #[test]
        fn sums_compare_as_their_numbers_do(a in finite(), b in finite()) {
            prop_assert_eq!(n(a).minus(&n(b)).signum(), a.partial_cmp(&b).unwrap());
            prop_assert_eq!(n(a).plus(&n(b)).minus(&n(b)).to_f64(), a);
        }

        #[test]
        fn quotients_are_rounded_to_the_nearest_or_its_neighbour(a in 1_u32.., b in 1_u32.., e in -300..300) {
            let scale = 2.0_f64.powi(e);
            let (quotient, nearest) = (n(f64::from(a) * scale).over(&n(f64::from(b))), f64::from(a) / f64::from(b) * scale);
            prop_assert!((quotient - nearest).abs() <= nearest * f64::EPSILON);
        }

        #[test]
        fn roots_of_squares_cancel(a in -1e9..1e9_f64, b in -1e9..1e9_f64, c in -9..9_i32) {
            // a² has the root |a|, so that b + c √a² can be had without roots.
            let c = f64::from(c);
            let plain = n(b).plus(&n(c).times(&n(a.abs()))).signum();
            prop_assert_eq!(Dyadic::sign_with_root(&n(b), &n(c), &n(a).squared()), plain);
            let with_both = Dyadic::sign_with_roots([&n(b), &n(c), &n(1.0)], [&n(a).squared(), &n(b).squared()]);
            let plain = n(b).plus(&n(c).times(&n(a.abs()))).plus(&n(b.abs())).signum();
            prop_assert_eq!(with_both, Ok(plain));
        }
    }

    #[test]
    fn roots_that_differ_late_are_told_apart() {
        let large = n(1e15).squared();
        let beside = |by: f64| Dyadic::sign_with_root(&n(-1e15), &n(1.0), &large.plus(&n(by)));
        assert_eq!(
            [beside(-1e-300), beside(0.0), beside(1e-300)],
            [Ordering::Less, Ordering::Equal, Ordering::Greater]
        );
    }

    #[test]
    fn the_root_of_eighteen_is_that_of_eight_and_that_of_two() {
        // 3 √2 − √18 = 0, and √2 + 1 < √6 < √2 + 1.5.
        let sign = |a, b, s, c, r| Dyadic::sign_with_roots([&n(a), &n(b), &n(c)], [&n(s), &n(r)]);
        assert_eq!(sign(0.0, 3.0, 2.0, -1.0, 18.0), Ok(Ordering::Equal));
        assert_eq!(sign(1.0, 1.0, 2.0, -1.0, 6.0), Ok(Ordering::Less));
        assert_eq!(sign(1.5, 1.0, 2.0, -1.0, 6.0), Ok(Ordering::Greater));
    }

    #[test]
    fn the_range_of_f64_is_no_limit() {
        let (large, small) = (n(f64::MAX), n(f64::from_bits(1)));
        assert_eq!(large.squared().to_f64(), f64::INFINITY);
        assert_eq!(large.squared().over(&large), f64::MAX);
        assert_eq!(small.squared().over(&small), f64::from_bits(1));
        assert_eq!(small.squared().signum(), Ordering::Greater);
    }
}
