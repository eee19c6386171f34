//! Places on a ray, and which of two comes first.

use std::cmp::Ordering;

use catoptra_core::Span;
use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use super::integer::{doublings, integer};
use super::isolated::Isolated;

/// A parameter of a ray.
#[derive(Debug, Clone)]
pub struct Place(Form);

#[derive(Debug, Clone)]
enum Form {
    Surd(Surd),
    /// A root of a higher degree.
    Isolated(Isolated),
}

/// The number `(p ± √s) / q` with q > 0 and s ≥ 0.
#[derive(Debug, Clone)]
struct Surd {
    p: BigInt,
    /// Whether the root is taken away.
    minus: bool,
    s: BigInt,
    q: BigInt,
}

/// Bits of a root's first enclosure, and those at which two places that still overlap count as one. Sums of two square
/// roots that differ, over integers of b bits, differ by more than 2^(-8b) or so (Burnikel et al., "A strong and easily
/// computable separation bound for arithmetic expressions involving radicals", Algorithmica 27, 2000); integers here have
/// at most some thousand bits.
const ENCLOSURES: (u32, u32) = (128, 1 << 17);

impl From<Isolated> for Place {
    fn from(root: Isolated) -> Self {
        Self(Form::Isolated(root))
    }
}

impl Place {
    /// `(p ± √s) / q`, times 2^`doubled`; q is not 0.
    pub(super) fn new([p, s, q]: [BigInt; 3], minus: bool, doubled: i32) -> Self {
        let negative = q.sign() == Sign::Minus;
        let (p, q, minus) = if negative { (-p, -q, !minus) } else { (p, q, minus) };
        Self(Form::Surd(if doubled >= 0 {
            Surd { p: p << doubled, minus, s: s << (2 * doubled), q }
        } else {
            Surd { p, minus, s, q: q << -doubled }
        }))
    }

    /// p / q, times 2^`doubled`; q is not 0.
    pub(super) fn ratio(p: BigInt, q: BigInt, doubled: i32) -> Self {
        Self::new([p, BigInt::ZERO, q], false, doubled)
    }

    /// Which comes first.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Form::Surd(a), Form::Surd(b)) => a.compare(b),
            (Form::Isolated(a), Form::Isolated(b)) => a.compare(b),
            (Form::Isolated(a), Form::Surd(b)) => b.compare_isolated(a).reverse(),
            (Form::Surd(a), Form::Isolated(b)) => a.compare_isolated(b),
        }
    }

    /// Whether it lies on a stretch, ends included.
    #[must_use]
    pub fn lies_on(&self, span: Span) -> bool {
        let side = |limit: f64| {
            if limit.is_infinite() {
                return if limit > 0.0 { Ordering::Less } else { Ordering::Greater };
            }
            let scale = doublings(limit);
            self.compare(&Self::ratio(integer(limit, scale), BigInt::from(1), -scale))
        };
        !span.min.is_nan() && !span.max.is_nan() && side(span.min).is_ge() && side(span.max).is_le()
    }

    /// The `f64` nearest to it, or one beside that.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        let root = match &self.0 {
            Form::Surd(surd) => return surd.to_f64(),
            Form::Isolated(root) => root,
        };
        let (mut root, mut bits) = (root.clone(), 128);
        loop {
            let [low, high] = root.enclosed(bits);
            // Known to 2⁻⁸⁰ of itself, or smaller than any number.
            if low == high || (&high - &low) * (BigInt::from(1) << 80) < low.abs() || bits > 2000 {
                return ((low + high) / BigInt::from(2)).to_f64().unwrap_or(f64::NAN);
            }
            bits *= 2;
        }
    }
}

impl Surd {
    fn ratio(&self) -> BigRational {
        BigRational::new(self.p.clone(), self.q.clone())
    }

    /// How it compares with a root of a higher degree: as a root of (q x − p)² = s.
    fn compare_isolated(&self, other: &Isolated) -> Ordering {
        if self.s == BigInt::ZERO {
            return other.compare_ratio(&self.ratio()).reverse();
        }
        let equation = vec![&self.p * &self.p - &self.s, &self.p * &self.q * -2, &self.q * &self.q];
        let roots = Isolated::all_of(equation);
        let root = if self.minus { roots.first() } else { roots.last() };
        root.map_or(Ordering::Equal, |root| root.compare(other))
    }

    /// The numerator times `factor` and 2^`bits`: an integer at most one below it.
    fn numerator(&self, factor: &BigInt, bits: u32) -> BigInt {
        let root = ((&self.s * factor * factor) << (2 * bits)).sqrt();
        let rational = (&self.p * factor) << bits;
        if self.minus { rational - root - 1 } else { rational + root }
    }

    fn compare(&self, other: &Self) -> Ordering {
        let is_rational = |place: &Self| place.s == BigInt::ZERO;
        if is_rational(self) && is_rational(other) {
            return (&self.p * &other.q).cmp(&(&other.p * &self.q));
        }
        let (mut bits, most) = ENCLOSURES;
        loop {
            let (a, b) = (self.numerator(&other.q, bits), other.numerator(&self.q, bits));
            if &a + 1 < b {
                return Ordering::Less;
            }
            if &b + 1 < a {
                return Ordering::Greater;
            }
            if bits >= most || self.is_same_root(other) {
                return Ordering::Equal;
            }
            bits *= 4;
        }
    }

    /// Whether both are made of the same numbers, up to a factor.
    fn is_same_root(&self, other: &Self) -> bool {
        let square = |q: &BigInt| q * q;
        let rational = &self.p * &other.q == &other.p * &self.q;
        let root = &self.s * square(&other.q) == &other.s * square(&self.q);
        rational && root && (self.minus == other.minus || self.s == BigInt::ZERO)
    }

    fn to_f64(&self) -> f64 {
        // A root that nearly cancels p is enclosed as closely as all of p's and q's bits and more.
        let bits = (self.p.bits() + self.q.bits() + self.s.bits() + 128) as u32;
        let numerator = self.numerator(&BigInt::from(1), bits);
        let rational = if self.s == BigInt::ZERO { &self.p << bits } else { numerator };
        BigRational::new(rational, &self.q << bits).to_f64().unwrap_or(f64::NAN)
    }
}
