//! The number that knows how far it may be off.

use std::cmp::Ordering;

use super::enclosed::find_root;
use super::{Located, Number, Root, Undecided, Verdict};
use crate::Span;
use crate::numeric::{ROOT_PRECISION, UNIT_ROUNDOFF_F64 as U, WHOLE_PRODUCT};

/// An `f64` and a bound on its distance from the exact number.
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

    /// A number that lies within `value ± error`.
    pub(super) const fn within(value: f64, error: f64) -> Self {
        Self { value, error }
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

/// Whether a normal number is a power of two, by which products are not rounded.
#[inline]
fn is_power_of_two(value: f64) -> bool {
    value.to_bits() << (u64::BITS - f64::MANTISSA_DIGITS + 1) == 0
}

impl Number for Bounded {
    const EXACT: bool = false;

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
        if (is_power_of_two(self.value) || is_power_of_two(other.value))
            && self.error + other.error == 0.0
            && value.is_normal()
        {
            return Self { value, error: 0.0 };
        }
        let brought =
            self.value.abs() * other.error + other.value.abs() * self.error + self.error * other.error;
        Self { value, error: (brought + U * value.abs()) * INFLATION + f64::MIN_POSITIVE }
    }

    /// Products of numbers without error are compared by their rounding errors, each a number of `f64`
    /// (Dekker, Numerische Mathematik 18, 1971) unless it underflows.
    fn compare_products([a, b]: [&Self; 2], [c, d]: [&Self; 2]) -> Verdict<Ordering> {
        let by_bounds = a.times(b).minus(&c.times(d)).sign();
        let (left, right) = (a.value * b.value, c.value * d.value);
        let whole = |product: f64| product.is_finite() && product.abs() >= WHOLE_PRODUCT;
        let exact = a.error + b.error + c.error + d.error == 0.0;
        if by_bounds.is_ok() || !exact || !whole(left) || !whole(right) {
            return by_bounds;
        }
        // Rounding keeps order.
        let rest = || a.value.mul_add(b.value, -left).partial_cmp(&c.value.mul_add(d.value, -right));
        left.partial_cmp(&right).filter(|order| order.is_ne()).or_else(rest).ok_or(Undecided)
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

    fn find_root<T>(
        coefficients: &[Self; 5],
        reach: f64,
        mut take: impl FnMut(Root<Self>) -> Verdict<Option<T>>,
    ) -> Verdict<Option<T>> {
        find_root(coefficients, reach, |root| take(Root::of(root)))
    }

    /// There are none among such numbers.
    fn compare_isolated(_: &Root<Self>, _: &Root<Self>) -> Verdict<Ordering> {
        Err(Undecided)
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::Dyadic;
    use super::*;

    /// Numbers of few and of many digits, large and small, so that sums of products cancel often.
    fn number() -> impl Strategy<Value = f64> {
        let whole = (-9_i32..10).prop_map(f64::from);
        let any = (-1.0..1.0_f64, -40..40_i32).prop_map(|(m, e)| m * 2.0_f64.powi(e));
        prop_oneof![whole, any, -2.0..2.0_f64]
    }

    /// How far a number is from the exact one, in units of its bound; 0 where both are 0.
    fn off(bounded: &Bounded, exact: &Dyadic) -> f64 {
        let (value, error) = bounded.parts();
        let off = Dyadic::of(value).minus(exact);
        if off.signum().is_eq() { 0.0 } else { off.over(&Dyadic::of(error)).abs() }
    }

    /// (a b − c d)(e − f) + c².
    fn formula<N: Number>(v: [f64; 6]) -> N {
        let [a, b, c, d, e, f] = v.map(N::of);
        a.times(&b).minus(&c.times(&d)).times(&e.minus(&f)).plus(&c.squared())
    }

    proptest! {
        #[test]
        fn the_bound_holds(a in number(), b in number(), c in number(), d in number(), e in number(), f in number()) {
            // a b and c d differ by little.
            for v in [[a, b, c, d, e, f], [a, b, c, a * b / c, e, e + f], [a, a, a, a.next_up(), e, f]] {
                if v.iter().all(|v| v.is_finite()) {
                    let (bounded, exact) = (formula::<Bounded>(v), formula::<Dyadic>(v));
                    prop_assert!(off(&bounded, &exact) <= 1.0, "{v:?}: {bounded:?}");
                    if let Ok(sign) = bounded.sign() {
                        prop_assert_eq!(sign, exact.signum());
                    }
                }
            }
        }

        #[test]
        fn products_compare_as_they_are(a in number(), b in number(), c in number(), e in -600..600_i32) {
            let scale = 2.0_f64.powi(e);
            // Often equal, or so near that only their rounding errors differ.
            for [a, b, c, d] in [[a, b, b, a], [a, b, c, a * b / c], [a, b, a.next_up(), b.next_down()]] {
                let [a, b, c, d] = [a * scale, b, c, d * scale];
                prop_assume!(d.is_finite());
                let exact = |a, b| Dyadic::of(a).times(&Dyadic::of(b));
                let right = exact(a, b).minus(&exact(c, d)).signum();
                let tiny = (a * b).abs().min((c * d).abs()) < WHOLE_PRODUCT;
                let [a, b, c, d] = [a, b, c, d].map(Bounded::of);
                let found = Bounded::compare_products([&a, &b], [&c, &d]);
                prop_assert!(found == Ok(right) || (found.is_err() && tiny), "{found:?} {right:?}");
            }
        }

        #[test]
        fn a_root_lies_within_its_bound(a in number(), b in number()) {
            let square = Bounded::of(a).squared().plus(&Bounded::of(b).squared());
            let exact = Dyadic::of(a).squared().plus(&Dyadic::of(b).squared());
            let (value, error) = square.root().parts();
            let end = |by: f64| Dyadic::of(value).plus(&Dyadic::of(by));
            prop_assert!(exact.minus(&end(error).squared()).signum().is_le());
            let low = end(-error);
            prop_assert!(low.signum().is_lt() || exact.minus(&low.squared()).signum().is_ge());
        }

        #[test]
        fn a_quotient_lies_within_its_bound(a in number(), b in number(), c in number()) {
            let (p, q) = (Bounded::of(a).plus(&Bounded::of(b)), Bounded::of(b).minus(&Bounded::of(c)));
            prop_assume!(q.sign().is_ok_and(Ordering::is_ne));
            let (value, error) = p.over(q).parts();
            let [p, q] = [Dyadic::of(a).plus(&Dyadic::of(b)), Dyadic::of(b).minus(&Dyadic::of(c))];
            // |value − p / q| <= error, times |q|.
            let off = Dyadic::of(value).times(&q).minus(&p).squared();
            let bound = Dyadic::of(error).times(&q).squared();
            prop_assert!(off.minus(&bound).signum().is_le());
        }
    }

    #[test]
    fn the_bound_is_no_larger_than_it_need_be() {
        // Of products of random digits some are rounded by nearly half a step.
        let products = (1..2000_u32).map(|i| (f64::from(i).sqrt(), f64::from(i).cbrt()));
        let worst = products.map(|(a, b)| {
            let (bounded, exact) =
                (Bounded::of(a).times(&Bounded::of(b)), Dyadic::of(a).times(&Dyadic::of(b)));
            off(&bounded, &exact)
        });
        let worst = worst.fold(0.0, f64::max);
        assert!(0.9 < worst && worst <= 1.0, "{worst}");
    }

    #[test]
    fn overflow_and_nan_decide_nothing() {
        let large = Bounded::of(1e300);
        assert_eq!(large.times(&large).sign(), Err(Undecided));
        assert_eq!(large.times(&large).minus(&large.times(&large)).sign(), Err(Undecided));
    }

    #[test]
    fn underflow_decides_nothing_and_zero_is_zero() {
        let small = Bounded::of(1e-200);
        assert_eq!(small.times(&small).sign(), Err(Undecided));
        assert_eq!(Bounded::of(0.0).times(&small).sign(), Ok(Ordering::Equal));
        assert_eq!(small.minus(&small).sign(), Ok(Ordering::Equal));
    }
}
