//! The number that knows how far it may be off.

use std::cmp::Ordering;

use super::{Located, Number, Root, Undecided, Verdict};
use crate::Span;
use crate::numeric::{ROOT_PRECISION, UNIT_ROUNDOFF_F64 as U};

/// An `f64` and a bound on its distance from the number that it stands for.
///
/// Running error analysis (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., section 3.3): rounding to
/// nearest is off by at most u times the *result*, so every operation adds u|v| to what its operands bring along.
/// Overflow makes the bound infinite or NaN, which decides nothing; underflow is covered by
/// [`f64::MIN_POSITIVE`], far above the half step 2⁻¹⁰⁷⁵ that it may cost.
#[derive(Debug, Clone, Copy)]
pub struct Bounded {
    value: f64,
    error: f64,
}

/// What the few operations that work out a bound may themselves round away: at most eight of them in a row.
const INFLATION: f64 = 1.0 + 16.0 * U;

impl Bounded {
    /// The number stood for lies within `value ± error`.
    #[must_use]
    pub const fn parts(&self) -> (f64, f64) {
        (self.value, self.error)
    }

    /// A sum or difference, which never underflows. It is free of error where taking either operand away again gives the
    /// other: the larger of the two proves it (Dekker, Numerische Mathematik 18, 1971).
    #[inline]
    fn sum(a: f64, b: f64, brought: f64) -> Self {
        let value = a + b;
        let is_exact = value - a == b && value - b == a;
        let error = if is_exact { brought } else { brought + U * value.abs() };
        Self { value, error: if error == 0.0 { 0.0 } else { error * INFLATION } }
    }

    /// The root of a number that is not negative, whatever its error says: |√x − √v| = |x − v| / (√x + √v).
    #[inline]
    fn root(self) -> Self {
        let value = self.value.max(0.0).sqrt();
        let brought = (self.error / value).min(self.error.sqrt());
        Self { value, error: if self.error == 0.0 { U * value } else { (brought + U * value) * INFLATION } }
    }

    /// `self / other`, where `other` is certain to differ from zero.
    #[inline]
    fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        let brought = (self.error + value.abs() * other.error) / (other.value.abs() - other.error);
        if value == 0.0 && self.value == 0.0 && self.error == 0.0 {
            return Self { value, error: 0.0 };
        }
        Self { value, error: (brought + U * value.abs()) * INFLATION + f64::MIN_POSITIVE }
    }
}

impl Number for Bounded {
    #[inline]
    fn of(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    #[inline]
    fn plus(&self, other: &Self) -> Self {
        Self::sum(self.value, other.value, self.error + other.error)
    }

    #[inline]
    fn minus(&self, other: &Self) -> Self {
        Self::sum(self.value, -other.value, self.error + other.error)
    }

    #[inline]
    fn times(&self, other: &Self) -> Self {
        let value = self.value * other.value;
        let is_zero = |n: &Self| n.value == 0.0 && n.error == 0.0;
        if value == 0.0 && (is_zero(self) || is_zero(other)) {
            return Self { value, error: 0.0 };
        }
        let brought =
            self.value.abs() * other.error + other.value.abs() * self.error + self.error * other.error;
        Self { value, error: (brought + U * value.abs()) * INFLATION + f64::MIN_POSITIVE }
    }

    #[inline]
    fn negative(&self) -> Self {
        Self { value: -self.value, ..*self }
    }

    #[inline]
    fn sign(&self) -> Verdict<Ordering> {
        if self.value > self.error {
            Ok(Ordering::Greater)
        } else if self.value < -self.error {
            Ok(Ordering::Less)
        } else if self.value == 0.0 && self.error == 0.0 {
            Ok(Ordering::Equal)
        } else {
            Err(Undecided)
        }
    }

    fn sign_with_roots([a, b, c]: [&Self; 3], [s, r]: [&Self; 2]) -> Verdict<Ordering> {
        a.plus(&b.times(&s.root())).plus(&c.times(&r.root())).sign()
    }

    #[inline]
    fn locate(root: &Root<Self>, span: Span) -> Verdict<Option<Located>> {
        let t = match &root.radical {
            None => root.rational.over(root.divisor),
            Some(radical) => {
                let term = radical.square.root();
                let term = if radical.positive { term } else { term.negative() };
                // (p + r) / q = n / (p − r), where n is the norm: whichever has no difference in it.
                if (root.rational.value > 0.0) == radical.positive {
                    root.rational.plus(&term).over(root.divisor)
                } else {
                    let conjugate = root.rational.minus(&term);
                    conjugate.sign()?;
                    radical.norm.over(conjugate)
                }
            }
        };
        // Comparisons of rounded sums hold for the sums themselves, as rounding keeps order.
        let (low, high) = (t.value - t.error, t.value + t.error);
        if high < span.min || low > span.max {
            return Ok(None);
        }
        let precise = t.error <= t.value.abs() * ROOT_PRECISION;
        if low >= span.min && high <= span.max && precise && t.value.is_finite() {
            Ok(Some(Located { t: t.value, error: t.error }))
        } else {
            Err(Undecided)
        }
    }
}
