//! Roots of polynomials of any degree as exact numbers: a polynomial, and a stretch on which it has no other root.

use std::cmp::Ordering;

use super::polynomial::{Polynomial, Sturm};
use super::{Dyadic, Number};

/// The only root of a polynomial between two numbers at which it is not 0, or the number that both are. The polynomial has
/// simple roots.
#[derive(Debug, Clone)]
pub struct Isolated {
    polynomial: Polynomial,
    low: Dyadic,
    high: Dyadic,
}

/// The number `(p + c √s) / q` with c of 1, 0 or −1 and q > 0.
#[derive(Debug)]
pub(super) struct Surd<'a> {
    pub(super) p: &'a Dyadic,
    pub(super) c: f64,
    pub(super) s: &'a Dyadic,
    pub(super) q: &'a Dyadic,
}

impl Isolated {
    /// All roots of a polynomial, given from its constant coefficient upwards, in order; none where it is 0 everywhere.
    #[must_use]
    pub fn all_of(coefficients: &[Dyadic]) -> Vec<Self> {
        let polynomial = Polynomial::new(coefficients.to_vec()).with_simple_roots();
        let mut found = Vec::new();
        if polynomial.degree().is_none_or(|degree| degree == 0) {
            return found;
        }
        let (sturm, high) = (Sturm::new(&polynomial), polynomial.bound());
        let low = high.negative();
        let changes = [&low, &high].map(|end| sturm.changes(end));
        separate(&polynomial, &sturm, [(low, changes[0]), (high, changes[1])], &mut found);
        found
    }

    /// Those of its roots at which a polynomial changes its sign: all that it has an odd number of times.
    #[must_use]
    pub fn sign_changes_of(coefficients: &[Dyadic]) -> Vec<Self> {
        let (polynomial, one) = (Polynomial::new(coefficients.to_vec()), Dyadic::of(1.0));
        let mut roots = Self::all_of(coefficients);
        let Some((first, last)) = roots.first().zip(roots.last()) else { return roots };
        // One place before each root and one behind all, where the polynomial is not 0.
        let between = roots.windows(2).map(|pair| pair[0].high.plus(&pair[1].low).doubled(-1));
        let places = std::iter::once(first.low.minus(&one)).chain(between);
        let signs: Vec<Ordering> =
            places.chain([last.high.plus(&one)]).map(|x| polynomial.at(&x).signum()).collect();
        let mut pairs = signs.windows(2);
        roots.retain(|_| pairs.next().is_some_and(|pair| pair[0] != pair[1]));
        roots
    }

    /// The number of the opposite sign.
    pub(super) fn negated(&self) -> Self {
        Self { polynomial: self.polynomial.mirrored(), low: self.high.negative(), high: self.low.negative() }
    }

    /// How it compares with such a number.
    pub(super) fn compare_surd(&self, other: &Surd<'_>) -> Ordering {
        self.compare_by(|x| other.compare(x), || other.sign_of(&self.polynomial))
    }

    /// How it compares with a number.
    pub(super) fn compare_number(&self, x: &Dyadic) -> Ordering {
        self.compare_by(|end| x.minus(end).signum(), || self.polynomial.at(x).signum())
    }

    /// How it compares with a number, of which it is known how that compares with others, and the polynomial's sign there.
    fn compare_by(&self, against: impl Fn(&Dyadic) -> Ordering, sign: impl FnOnce() -> Ordering) -> Ordering {
        if against(&self.low).is_lt() {
            return Ordering::Greater;
        }
        if against(&self.high).is_gt() {
            return Ordering::Less;
        }
        match sign() {
            Ordering::Equal => Ordering::Equal,
            sign if sign == self.polynomial.at(&self.high).signum() => Ordering::Less,
            _ => Ordering::Greater,
        }
    }

    /// Whether it is known exactly.
    fn is_point(&self) -> bool {
        self.high.minus(&self.low).signum().is_eq()
    }

    /// The same number on half the stretch.
    fn halved(&self) -> Self {
        let middle = self.low.plus(&self.high).doubled(-1);
        let [low, high] = match self.compare_number(&middle) {
            Ordering::Equal => [middle.clone(), middle],
            Ordering::Less => [self.low.clone(), middle],
            Ordering::Greater => [middle, self.high.clone()],
        };
        Self { polynomial: self.polynomial.clone(), low, high }
    }

    /// How it compares with another.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        let (mut a, mut b) = (self.clone(), other.clone());
        let mut may_be_same = true;
        loop {
            if a.is_point() {
                return b.compare_number(&a.low).reverse();
            }
            if b.is_point() {
                return a.compare_number(&b.low);
            }
            if a.high.minus(&b.low).signum().is_le() {
                return Ordering::Less;
            }
            if b.high.minus(&a.low).signum().is_le() {
                return Ordering::Greater;
            }
            if may_be_same && a.shares_a_root_with(&b) {
                return Ordering::Equal;
            }
            may_be_same = false;
            (a, b) = (a.halved(), b.halved());
        }
    }

    /// Whether both polynomials have a root in common where the stretches overlap: each has no other there than its number. At
    /// the ends of the overlap one of the two is not 0, so what they have in common is not.
    fn shares_a_root_with(&self, other: &Self) -> bool {
        let common = self.polynomial.common(&other.polynomial);
        let later = |a: &Dyadic, b: &Dyadic| if a.minus(b).signum().is_ge() { a.clone() } else { b.clone() };
        let low = later(&self.low, &other.low);
        let high = later(&self.high.negative(), &other.high.negative()).negative();
        common.at(&low).signum() != common.at(&high).signum()
    }

    /// A number that differs from it by less than 2^−`bits` of itself.
    pub(super) fn rounded(&self, bits: i64) -> Dyadic {
        let mut root = self.clone();
        if root.compare_number(&Dyadic::of(0.0)).is_eq() {
            return Dyadic::of(0.0);
        }
        while !root.is_point() {
            let width = root.high.minus(&root.low).magnitude_bits();
            let least = root.low.magnitude_bits().min(root.high.magnitude_bits());
            let same_sign = root.low.signum() == root.high.signum() && root.low.signum().is_ne();
            if same_sign && width + bits < least {
                break;
            }
            root = root.halved();
        }
        root.low.plus(&root.high).doubled(-1)
    }
}

/// Halves a stretch until each part has one root, given how often signs change at both ends.
fn separate(
    polynomial: &Polynomial,
    sturm: &Sturm,
    [(low, before), (high, after)]: [(Dyadic, usize); 2],
    found: &mut Vec<Isolated>,
) {
    match before - after {
        0 => {}
        1 if polynomial.at(&high).signum().is_eq() => {
            found.push(Isolated { polynomial: polynomial.clone(), low: high.clone(), high });
        }
        1 if polynomial.at(&low).signum().is_ne() => {
            found.push(Isolated { polynomial: polynomial.clone(), low, high });
        }
        _ => {
            let middle = low.plus(&high).doubled(-1);
            let changes = sturm.changes(&middle);
            separate(polynomial, sturm, [(low, before), (middle.clone(), changes)], found);
            separate(polynomial, sturm, [(middle, changes), (high, after)], found);
        }
    }
}

impl Surd<'_> {
    /// How it compares with a number.
    fn compare(&self, x: &Dyadic) -> Ordering {
        Dyadic::sign_with_root(&self.p.minus(&self.q.times(x)), &Dyadic::of(self.c), self.s)
    }

    /// The sign of a polynomial there: of a + b √s, where q and its powers are taken out.
    fn sign_of(&self, polynomial: &Polynomial) -> Ordering {
        let (mut a, mut b, mut power) = (Dyadic::of(0.0), Dyadic::of(0.0), Dyadic::of(1.0));
        let c = Dyadic::of(self.c);
        for coefficient in polynomial.coefficients().iter().rev() {
            let root = b.times(&c).times(self.s);
            (a, b) = (a.times(self.p).plus(&root), b.times(self.p).plus(&a.times(&c)));
            a = a.plus(&coefficient.times(&power));
            power = power.times(self.q);
        }
        Dyadic::sign_with_root(&a, &b, self.s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(coefficients: &[f64]) -> Vec<Isolated> {
        Isolated::all_of(&coefficients.iter().map(|c| Dyadic::of(*c)).collect::<Vec<_>>())
    }

    #[test]
    fn the_fourth_root_of_two_lies_where_it_does() {
        let [low, high] = <[Isolated; 2]>::try_from(of(&[-2.0, 0.0, 0.0, 0.0, 1.0])).unwrap();
        assert_eq!(high.rounded(60).to_f64(), 2.0_f64.sqrt().sqrt());
        assert_eq!(low.rounded(60).to_f64(), -2.0_f64.sqrt().sqrt());
        assert_eq!((low.compare(&high), high.compare(&high)), (Ordering::Less, Ordering::Equal));
        // √2, of another polynomial and as a surd.
        let [_, root] = <[Isolated; 2]>::try_from(of(&[-2.0, 0.0, 1.0])).unwrap();
        let (zero, one, two) = (Dyadic::of(0.0), Dyadic::of(1.0), Dyadic::of(2.0));
        let surd = Surd { p: &zero, c: 1.0, s: &two, q: &one };
        assert_eq!((root.compare_surd(&surd), high.compare_surd(&surd)), (Ordering::Equal, Ordering::Less));
        assert_eq!(high.compare(&root), Ordering::Less);
    }

    #[test]
    fn the_same_number_of_two_polynomials_is_the_same() {
        // (x² − 3)(x² − x − 1) and (x² − 3)(x² + 5x + 1): ±√3, the golden ratio and −1/it; −0.2 and −4.8.
        let first = of(&[3.0, 3.0, -4.0, -1.0, 1.0]);
        let second = of(&[-3.0, -15.0, -2.0, 5.0, 1.0]);
        assert_eq!((first.len(), second.len()), (4, 4));
        let order = |i: usize, j: usize| first[i].compare(&second[j]);
        assert_eq!((order(0, 1), order(3, 3)), (Ordering::Equal, Ordering::Equal));
        assert_eq!(
            (order(2, 3), order(0, 0), order(1, 2)),
            (Ordering::Less, Ordering::Greater, Ordering::Less)
        );
    }

    #[test]
    fn double_roots_are_single_numbers() {
        // (x − 1)² (x² − 2).
        let roots = of(&[-2.0, 4.0, -1.0, -2.0, 1.0]);
        assert_eq!(roots.len(), 3);
        assert_eq!(roots[1].rounded(60).to_f64(), 1.0);
        let one = Dyadic::of(1.0);
        assert_eq!(roots[1].compare_number(&one), Ordering::Equal);
        assert_eq!(roots[2].compare_number(&one), Ordering::Greater);
    }

    #[test]
    fn signs_change_at_roots_that_are_there_an_odd_number_of_times() {
        // (x − 1)² (x² − 2), and (x + 1)³ x.
        for (coefficients, changes) in [
            ([-2.0, 4.0, -1.0, -2.0, 1.0], vec![-(2.0_f64.sqrt()), 2.0_f64.sqrt()]),
            ([0.0, 1.0, 3.0, 3.0, 1.0], vec![-1.0, 0.0]),
        ] {
            let found = Isolated::sign_changes_of(&coefficients.map(Dyadic::of));
            let found: Vec<f64> = found.iter().map(|root| root.rounded(60).to_f64()).collect();
            assert_eq!(found, changes);
        }
        assert!(Isolated::sign_changes_of(&[1.0, 2.0, 1.0].map(Dyadic::of)).is_empty());
        assert!(Isolated::sign_changes_of(&[Dyadic::of(3.0)]).is_empty());
    }

    #[test]
    fn roots_a_hair_apart_are_told_apart() {
        // (x − 1)(x − 1 − 2⁻⁵²) x.
        let next = 1.0_f64.next_up();
        let step = f64::EPSILON;
        let roots = Isolated::all_of(&[
            Dyadic::of(0.0),
            Dyadic::of(next),
            Dyadic::of(-2.0).minus(&Dyadic::of(step)),
            Dyadic::of(1.0),
        ]);
        let values: Vec<f64> = roots.iter().map(|root| root.rounded(70).to_f64()).collect();
        assert_eq!(values, [0.0, 1.0, next]);
    }
}
