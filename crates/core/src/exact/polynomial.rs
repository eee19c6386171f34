//! Polynomials of exact numbers, and how many different roots one has on a stretch (Sturm 1829; Basu, Pollack and Roy,
//! *Algorithms in Real Algebraic Geometry*, 2006, section 2.2).

use std::cmp::Ordering;

use super::{Dyadic, Number};

/// Coefficients from the constant one upwards; the last one is not 0. None at all for the polynomial that is 0 everywhere.
#[derive(Debug, Clone)]
pub(super) struct Polynomial(Vec<Dyadic>);

impl Polynomial {
    pub(super) fn new(mut coefficients: Vec<Dyadic>) -> Self {
        while coefficients.last().is_some_and(|last| last.signum().is_eq()) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    /// `None` for 0 everywhere.
    pub(super) fn degree(&self) -> Option<usize> {
        self.0.len().checked_sub(1)
    }

    /// From the constant one upwards.
    pub(super) fn coefficients(&self) -> &[Dyadic] {
        &self.0
    }

    pub(super) fn at(&self, x: &Dyadic) -> Dyadic {
        self.0.iter().rev().fold(Dyadic::of(0.0), |sum, c| sum.times(x).plus(c))
    }

    /// The polynomial whose roots are those of this one with other signs.
    pub(super) fn mirrored(&self) -> Self {
        let turned = |(power, c): (usize, &Dyadic)| if power % 2 == 1 { c.negative() } else { c.clone() };
        Self(self.0.iter().enumerate().map(turned).collect())
    }

    fn derivative(&self) -> Self {
        let terms = self.0.iter().zip(0_u32..).skip(1);
        Self::new(terms.map(|(c, power)| c.times(&Dyadic::of(power.into()))).collect())
    }

    /// What division by another polynomial, not 0 everywhere, leaves, times a positive number, and the quotient, times the same.
    fn divided(&self, by: &Self) -> (Self, Self) {
        let zero = Dyadic::of(0.0);
        let Some(lead) = by.0.last() else { return (self.clone(), Self::new(Vec::new())) };
        let is_negative = lead.signum().is_lt();
        let size = if is_negative { lead.negative() } else { lead.clone() };
        let (mut rest, mut quotient) = (self.0.clone(), vec![zero; self.0.len()]);
        while rest.len() >= by.0.len() {
            let Some(top) = rest.pop() else { break };
            let shift = rest.len() + 1 - by.0.len();
            let factor = if is_negative { top.negative() } else { top };
            for c in rest.iter_mut().chain(&mut quotient) {
                *c = c.times(&size);
            }
            for (c, subtracted) in rest[shift..].iter_mut().zip(&by.0) {
                *c = c.minus(&subtracted.times(&factor));
            }
            quotient[shift] = quotient[shift].plus(&factor);
        }
        (Self::new(rest), Self::new(quotient))
    }

    /// A polynomial whose roots are those that both have, each as often as both have it.
    pub(super) fn common(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.clone(), other.clone());
        while b.degree().is_some() {
            let rest = a.divided(&b).0.reduced();
            (a, b) = (b, rest);
        }
        a
    }

    /// One with the same roots, each once.
    pub(super) fn with_simple_roots(&self) -> Self {
        let repeated = self.common(&self.derivative());
        if repeated.degree().is_none_or(|degree| degree == 0) {
            return self.clone();
        }
        self.divided(&repeated).1.reduced()
    }

    /// Times a power of two, so that numbers stay short.
    fn reduced(self) -> Self {
        let bits = self.0.iter().map(Dyadic::magnitude_bits).max().unwrap_or(0);
        Self(self.0.into_iter().map(|c| c.doubled(-bits)).collect())
    }

    /// A power of two that all roots are smaller than in magnitude (Cauchy's bound).
    pub(super) fn bound(&self) -> Dyadic {
        let Some((lead, rest)) = self.0.split_last() else { return Dyadic::of(1.0) };
        let most = rest.iter().map(Dyadic::magnitude_bits).max().unwrap_or(0);
        // The lead is at least half of its power of two.
        Dyadic::of(1.0).doubled((most - lead.magnitude_bits() + 2).max(1))
    }
}

/// A polynomial with simple roots and what counts them.
#[derive(Debug)]
pub(super) struct Sturm(Vec<Polynomial>);

impl Sturm {
    pub(super) fn new(polynomial: &Polynomial) -> Self {
        let mut chain = vec![polynomial.clone(), polynomial.derivative()];
        while let [.., a, b] = &chain[..]
            && b.degree().is_some_and(|degree| degree > 0)
        {
            let rest = a.divided(b).0.reduced();
            if rest.degree().is_none() {
                break;
            }
            chain.push(Polynomial(rest.0.iter().map(Dyadic::negative).collect()));
        }
        Self(chain)
    }

    /// How often the signs of the chain change at a place. Less what that is at a higher place, it is how many roots lie beyond
    /// the lower and not beyond the higher one.
    pub(super) fn changes(&self, x: &Dyadic) -> usize {
        let signs = self.0.iter().map(|polynomial| polynomial.at(x).signum()).filter(|sign| sign.is_ne());
        let signs: Vec<Ordering> = signs.collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_roots(roots: &[f64]) -> Polynomial {
        let start = vec![Dyadic::of(-3.0)];
        let product = roots.iter().fold(start, |product, root| {
            let mut next: Vec<Dyadic> = product.iter().map(|c| c.times(&Dyadic::of(-root))).collect();
            next.push(Dyadic::of(0.0));
            for (c, shifted) in next[1..].iter_mut().zip(&product) {
                *c = c.plus(shifted);
            }
            next
        });
        Polynomial::new(product)
    }

    #[test]
    fn roots_are_counted_each_once() {
        for roots in
            [&[1.0, 2.0, 2.0, 5.0][..], &[-0.5], &[3.0, 3.0, 3.0], &[0.0, -1.0, 0.1, 0.1_f64.next_up()]]
        {
            let polynomial = with_roots(roots);
            let simple = polynomial.with_simple_roots();
            let mut different = roots.to_vec();
            different.sort_by(f64::total_cmp);
            different.dedup();
            assert_eq!(simple.degree(), Some(different.len()));
            assert!(different.iter().all(|root| simple.at(&Dyadic::of(*root)).signum().is_eq()));
            let sturm = Sturm::new(&simple);
            let bound = simple.bound();
            let count = |from: &Dyadic, to: &Dyadic| sturm.changes(from) - sturm.changes(to);
            assert_eq!(count(&bound.negative(), &bound), different.len());
            for root in &different {
                let [below, at] = [root.next_down(), *root].map(Dyadic::of);
                assert_eq!(count(&below, &at), 1, "{root} of {roots:?}");
            }
        }
    }

    #[test]
    fn common_roots_are_found() {
        let common = with_roots(&[1.0, 2.0, 7.0]).common(&with_roots(&[2.0, 1.0, -4.0, 0.3]));
        assert_eq!(common.degree(), Some(2));
        assert!([1.0, 2.0].iter().all(|root| common.at(&Dyadic::of(*root)).signum().is_eq()));
        assert_eq!(with_roots(&[1.0]).common(&with_roots(&[3.0])).degree(), Some(0));
    }
}
