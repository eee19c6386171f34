//! Where on a ray something is met: a root of an equation of first or second degree, kept as what it is made of, or of a higher
//! one, kept as what tells it from the others.

use std::cmp::Ordering;
use std::sync::Arc;

use super::{Isolated, Number, Verdict};

/// The number `(p ± √s) / q` with q > 0, or p / q.
#[derive(Debug, Clone)]
pub struct Root<N> {
    /// p.
    pub rational: N,
    /// ± √s; `None` for none.
    pub radical: Option<Radical<N>>,
    /// q, greater than 0.
    pub divisor: N,
    /// The number itself where it is an exact root of a higher degree; p is 0 then and q is 1.
    pub isolated: Option<Arc<Isolated>>,
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
        Ok(Some(Self { rational, radical: None, divisor, isolated: None }))
    }

    /// A number as it is.
    #[must_use]
    pub fn of(value: N) -> Self {
        Self { rational: value, radical: None, divisor: N::of(1.0), isolated: None }
    }

    /// A root of a higher degree.
    #[must_use]
    pub fn isolated(root: Isolated) -> Self {
        Self { isolated: Some(Arc::new(root)), ..Self::of(N::of(0.0)) }
    }

    /// The root of the opposite sign: of the same equation along the ray the other way.
    #[must_use]
    pub fn negated(&self) -> Self {
        let radical =
            self.radical.as_ref().map(|radical| Radical { positive: !radical.positive, ..radical.clone() });
        let isolated = self.isolated.as_ref().map(|root| Arc::new(root.negated()));
        Self { rational: self.rational.negative(), radical, divisor: self.divisor.clone(), isolated }
    }

    /// How `constant + slope × root` compares with zero: on which side of a plane that the ray runs through, say.
    ///
    /// # Errors
    /// When the sum lies too close to zero for such numbers.
    pub fn side(&self, constant: &N, slope: &N) -> Verdict<Ordering> {
        if self.isolated.is_some() {
            return match (slope.sign()?, Self::ratio(&constant.negative(), slope)?) {
                (Ordering::Less, Some(zero)) => Ok(self.compare(&zero)?.reverse()),
                (_, Some(zero)) => self.compare(&zero),
                (_, None) => constant.sign(),
            };
        }
        let rest = constant.times(&self.divisor).plus(&slope.times(&self.rational));
        let Some(radical) = &self.radical else { return rest.sign() };
        let zero = N::of(0.0);
        let slope = if radical.positive { slope.clone() } else { slope.negative() };
        N::sign_with_roots([&rest, &slope, &zero], [&radical.square, &zero])
    }

    /// How it compares with another root.
    ///
    /// # Errors
    /// When the two lie too close together for such numbers.
    pub fn compare(&self, other: &Self) -> Verdict<Ordering> {
        if self.isolated.is_some() || other.isolated.is_some() {
            return N::compare_isolated(self, other);
        }
        let products = [[&self.rational, &other.divisor], [&other.rational, &self.divisor]];
        if self.radical.is_none() && other.radical.is_none() {
            return N::compare_products(products[0], products[1]);
        }
        let [left, right] = products.map(|[a, b]| a.times(b));
        let difference = left.minus(&right);
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

#[cfg(test)]
mod tests {
    use super::super::{Bounded, Dyadic};
    use super::*;

    fn ratio<N: Number>(p: f64, q: f64) -> Root<N> {
        Root::ratio(&N::of(p), &N::of(q)).unwrap().unwrap()
    }

    /// (p ± √s) / q.
    fn quadratic<N: Number>(p: f64, s: f64, q: f64, positive: bool) -> Root<N> {
        let norm = N::of((p * p - s) / q);
        Root {
            rational: N::of(p),
            radical: Some(Radical { positive, square: N::of(s), norm }),
            divisor: N::of(q),
            isolated: None,
        }
    }

    #[test]
    fn exact_roots_are_ordered() {
        let golden = quadratic::<Dyadic>(1.0, 5.0, 2.0, true);
        assert_eq!(golden.compare(&ratio(1.618_033_988_749_894, 1.0)), Ok(Ordering::Greater));
        assert_eq!(golden.compare(&ratio(-1.618_033_988_749_895_3, -1.0)), Ok(Ordering::Less));
        // (1 + √5) / 2 = (3 + √45) / 6 = 2 / (√5 − 1) is more than its conjugate.
        assert_eq!(golden.compare(&quadratic(3.0, 45.0, 6.0, true)), Ok(Ordering::Equal));
        assert_eq!(quadratic::<Dyadic>(1.0, 5.0, 2.0, false).compare(&golden), Ok(Ordering::Less));
        // Tangent: a double root is the same as a rational one.
        assert_eq!(quadratic::<Dyadic>(3.0, 0.0, 2.0, false).compare(&ratio(1.5, 1.0)), Ok(Ordering::Equal));
    }

    #[test]
    fn bounded_roots_are_ordered_where_they_can_be() {
        let golden = quadratic::<Bounded>(1.0, 5.0, 2.0, true);
        assert_eq!(golden.compare(&ratio(1.618, 1.0)), Ok(Ordering::Greater));
        assert!(golden.compare(&quadratic(3.0, 45.0, 6.0, true)).is_err());
    }

    #[test]
    fn roots_of_higher_degree_are_ordered_among_all() {
        // x⁴ = 2 and x³ = 2: 1.189… and 1.259…; √2 and 5/4.
        let of = |c: [f64; 5]| Isolated::all_of(&c.map(Dyadic::of)).pop().map(Root::isolated).unwrap();
        let (fourth, third) = (of([-2.0, 0.0, 0.0, 0.0, 1.0]), of([-2.0, 0.0, 0.0, 1.0, 0.0]));
        let (root, ratio) = (quadratic(0.0, 2.0, 1.0, true), ratio(5.0, 4.0));
        assert_eq!(fourth.compare(&third), Ok(Ordering::Less));
        assert_eq!((third.compare(&root), root.compare(&third)), (Ok(Ordering::Less), Ok(Ordering::Greater)));
        assert_eq!(
            (third.compare(&ratio), fourth.compare(&ratio)),
            (Ok(Ordering::Greater), Ok(Ordering::Less))
        );
        // 3 − 2 ∛2 and −1 + ⁴√2.
        let side = |root: &Root<Dyadic>, c: f64, s: f64| root.side(&Dyadic::of(c), &Dyadic::of(s));
        assert_eq!(
            (side(&third, 3.0, -2.0), side(&fourth, -1.0, 1.0)),
            (Ok(Ordering::Greater), Ok(Ordering::Greater))
        );
        // √2 as a root of x⁴ = 4.
        assert_eq!(of([-4.0, 0.0, 0.0, 0.0, 1.0]).compare(&root), Ok(Ordering::Equal));
        // −∛2 is its own opposite's opposite, and less than −⁴√2.
        assert_eq!(third.negated().compare(&fourth.negated()), Ok(Ordering::Less));
        assert_eq!(third.negated().negated().compare(&third), Ok(Ordering::Equal));
        assert_eq!(side(&third.negated(), 1.25, 1.0), Ok(Ordering::Less));
        let at = Dyadic::locate(&third, crate::Span::AHEAD).unwrap().unwrap();
        assert!((at.t - 2.0_f64.cbrt()).abs() <= at.error, "{at:?}");
        assert!(Dyadic::locate(&third, crate::Span::until(1.2599)).unwrap().is_none());
    }

    #[test]
    fn a_root_lies_on_one_side_of_a_line() {
        let golden = quadratic::<Dyadic>(1.0, 5.0, 2.0, true);
        let side = |constant, slope| golden.side(&Dyadic::of(constant), &Dyadic::of(slope));
        // 1.618… − 1.75, 1.75 − 1.618…, and −1 + 0 times it.
        assert_eq!(side(-1.75, 1.0), Ok(Ordering::Less));
        assert_eq!(side(1.75, -1.0), Ok(Ordering::Greater));
        assert_eq!(side(-1.0, 0.0), Ok(Ordering::Less));
        // (6 − √16) / 2 = 1 lies on it.
        let whole = quadratic::<Dyadic>(6.0, 16.0, 2.0, false);
        assert_eq!(whole.side(&Dyadic::of(-3.0), &Dyadic::of(3.0)), Ok(Ordering::Equal));
        assert!(
            quadratic::<Bounded>(6.0, 16.0, 2.0, false).side(&Bounded::of(-3.0), &Bounded::of(3.0)).is_err()
        );
    }

    #[test]
    fn a_root_that_nearly_cancels_is_located() {
        // The smaller root of x² − 2x + 2⁻⁶⁰: about 2⁻⁶¹.
        let small = 2.0_f64.powi(-60);
        let root = quadratic::<Dyadic>(1.0, 1.0 - 2.0_f64.powi(-50), 1.0, false);
        let at = Dyadic::locate(&root, crate::Span::AHEAD).unwrap().unwrap();
        assert!((at.t / 2.0_f64.powi(-51) - 1.0).abs() < 1e-14, "{at:?}");
        let radical = Radical { positive: false, square: Bounded::of(1.0 - small), norm: Bounded::of(small) };
        let root = Root { radical: Some(radical), ..Root::of(Bounded::of(1.0)) };
        let at = Bounded::locate(&root, crate::Span::AHEAD).unwrap().unwrap();
        assert!((at.t / (small / 2.0) - 1.0).abs() < 1e-14, "{at:?}");
    }
}
