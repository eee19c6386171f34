//! Roots of polynomials: halved apart by Descartes' rule of signs (Collins and Akritas, "Polynomial real root isolation using
//! Descartes' rule of signs", SYMSAC 1976).

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// The one root of a polynomial with simple roots between n / 2ᵏ and (n + 1) / 2ᵏ that are none, or n / 2ᵏ itself.
#[derive(Debug, Clone)]
pub(super) struct Isolated {
    /// From the constant coefficient upwards.
    polynomial: Vec<BigInt>,
    n: BigInt,
    k: i64,
    is_point: bool,
}

/// `number` times 2^`power`.
fn doubled(number: &BigInt, power: i64) -> BigRational {
    if power >= 0 {
        BigRational::from_integer(number << power)
    } else {
        BigRational::new(number.clone(), BigInt::one() << -power)
    }
}

/// How a polynomial compares with zero at n / m, m > 0.
fn at(polynomial: &[BigInt], [n, m]: [&BigInt; 2]) -> Ordering {
    let (mut sum, mut power) = (BigInt::zero(), BigInt::one());
    for c in polynomial.iter().rev() {
        sum = sum * n + c * &power;
        power *= m;
    }
    sum.cmp(&BigInt::zero())
}

/// How a polynomial compares with zero at n / 2ᵏ.
fn at_binary(polynomial: &[BigInt], n: &BigInt, k: i64) -> Ordering {
    if k < 0 {
        at(polynomial, [&(n << -k), &BigInt::one()])
    } else {
        at(polynomial, [n, &(BigInt::one() << k)])
    }
}

/// What division leaves, as whole numbers.
fn rest(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let mut a = a.to_vec();
    while a.len() >= b.len() {
        let (Some(top), Some(lead)) = (a.pop(), b.last()) else { break };
        let shift = a.len() + 1 - b.len();
        a.iter_mut().for_each(|c| *c *= lead);
        for (c, by) in a[shift..].iter_mut().zip(b) {
            *c -= by * &top;
        }
    }
    trimmed(a)
}

fn trimmed(mut polynomial: Vec<BigInt>) -> Vec<BigInt> {
    while polynomial.last().is_some_and(Zero::is_zero) {
        polynomial.pop();
    }
    polynomial
}

/// A polynomial with the roots that both have.
fn common(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    while !b.is_empty() {
        let next = rest(&a, &b);
        (a, b) = (b, next);
    }
    a
}

/// With each root once.
fn simple(polynomial: &[BigInt]) -> Vec<BigInt> {
    let derivative: Vec<BigInt> = polynomial.iter().zip(0..).skip(1).map(|(c, i)| c * i).collect();
    let a = common(polynomial, &derivative);
    // The quotient by what is common, over fractions.
    let divisor: Vec<BigRational> = a.into_iter().map(BigRational::from_integer).collect();
    let mut left: Vec<BigRational> = polynomial.iter().cloned().map(BigRational::from_integer).collect();
    let mut quotient = vec![BigRational::zero(); left.len() + 1 - divisor.len()];
    for i in (0..quotient.len()).rev() {
        let factor = &left[i + divisor.len() - 1] / &divisor[divisor.len() - 1];
        for (j, c) in divisor.iter().enumerate() {
            left[i + j] = &left[i + j] - c * &factor;
        }
        quotient[i] = factor;
    }
    let common = quotient.iter().fold(BigInt::one(), |common, c| common * c.denom());
    quotient.into_iter().map(|c| (c * &common).to_integer()).collect()
}

/// P(x + 1).
fn shifted(mut polynomial: Vec<BigInt>) -> Vec<BigInt> {
    let count = polynomial.len();
    for end in 1..count {
        for i in (end - 1..count - 1).rev() {
            let next = polynomial[i + 1].clone();
            polynomial[i] += next;
        }
    }
    polynomial
}

/// How many roots lie between 0 and 1, at most: none, one, or more for all that is known.
fn most_within(polynomial: &[BigInt]) -> usize {
    // The signs of (1 + x)ⁿ P(1 / (1 + x)).
    let turned = shifted(polynomial.iter().rev().cloned().collect());
    let signs: Vec<bool> = turned.iter().filter(|c| !c.is_zero()).map(Signed::is_positive).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// The stretches between 0 and 1 that have one root each, or are one, in order: n and k, and whether it is a point.
fn separated(polynomial: Vec<BigInt>) -> Vec<(BigInt, i64, bool)> {
    let (mut open, mut found) = (vec![(polynomial, BigInt::zero(), 0, false)], Vec::new());
    // A list and not a recursion: exponents far apart take hundreds of steps.
    while let Some((part, n, k, is_point)) = open.pop() {
        if is_point {
            found.push((n, k, true));
            continue;
        }
        let (degree, sum) = (part.len() as u64 - 1, part.iter().sum::<BigInt>());
        match most_within(&part) {
            0 => {}
            1 if !part[0].is_zero() && !sum.is_zero() => found.push((n, k, false)),
            _ => {
                let lower: Vec<BigInt> = (0..).zip(&part).map(|(i, c)| c << (degree - i)).collect();
                let upper = shifted(lower.clone());
                let (twice, is_root) = (n * 2, upper[0].is_zero());
                open.push((upper, &twice + 1, k + 1, false));
                if is_root {
                    open.push((Vec::new(), &twice + 1, k + 1, true));
                }
                open.push((lower, twice, k + 1, false));
            }
        }
    }
    found
}

impl Isolated {
    /// All roots, in order.
    pub(super) fn all_of(polynomial: Vec<BigInt>) -> Vec<Self> {
        let polynomial = trimmed(polynomial);
        if polynomial.len() < 2 {
            return Vec::new();
        }
        let polynomial = simple(&polynomial);
        let most = polynomial.iter().map(BigInt::bits).max().unwrap_or(0);
        // Cauchy's bound: one more than the largest coefficient in units of the lead, which is at least half its power.
        let bits = most - polynomial.last().map_or(0, BigInt::bits) + 2;
        let new = |n, k, is_point| Self { polynomial: polynomial.clone(), n, k: k - bits as i64, is_point };
        let scaled = |i: u64, c: &BigInt| c << (bits * i);
        let above: Vec<BigInt> = (0..).zip(&polynomial).map(|(i, c)| scaled(i, c)).collect();
        let below =
            (0..).zip(&above).map(|(i, c): (u32, _)| if i % 2 == 1 { -c } else { c.clone() }).collect();
        let mut found: Vec<Self> = Vec::new();
        for (n, k, is_point) in separated(below).into_iter().rev() {
            found.push(new(if is_point { -n } else { -n - 1 }, k, is_point));
        }
        if polynomial[0].is_zero() {
            found.push(new(BigInt::zero(), 0, true));
        }
        found.extend(separated(above).into_iter().map(|(n, k, is_point)| new(n, k, is_point)));
        found
    }

    /// Where the stretch begins and where it ends.
    fn ends(&self) -> [BigRational; 2] {
        let end = if self.is_point { self.n.clone() } else { &self.n + 1 };
        [doubled(&self.n, -self.k), doubled(&end, -self.k)]
    }

    /// Of two places within the stretch that are none of its ends: whether the root is at that of a sign, before or behind it.
    fn side(&self, sign: Ordering) -> Ordering {
        match sign {
            Ordering::Equal => Ordering::Equal,
            sign if sign == at_binary(&self.polynomial, &(&self.n + 1), self.k) => Ordering::Less,
            _ => Ordering::Greater,
        }
    }

    /// How it compares with a fraction.
    pub(super) fn compare_ratio(&self, x: &BigRational) -> Ordering {
        let [low, high] = self.ends();
        if self.is_point {
            return low.cmp(x);
        }
        if *x <= low {
            return Ordering::Greater;
        }
        if *x >= high {
            return Ordering::Less;
        }
        self.side(at(&self.polynomial, [x.numer(), x.denom()]))
    }

    /// Which of two comes first.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        let (mut a, mut b) = (self.clone(), other.clone());
        // Two such stretches lie one within the other, or apart.
        if !a.is_point && !b.is_point && a.may_be(&b) {
            let common = common(&a.polynomial, &b.polynomial);
            let smaller = if a.k > b.k { &a } else { &b };
            let ends = [&smaller.n, &(&smaller.n + 1)].map(|n| at_binary(&common, n, smaller.k));
            if ends[0] != ends[1] {
                return Ordering::Equal;
            }
        }
        loop {
            if a.is_point {
                return b.compare_ratio(&a.ends()[0]).reverse();
            }
            if b.is_point {
                return a.compare_ratio(&b.ends()[0]);
            }
            if !a.may_be(&b) {
                return a.ends()[0].cmp(&b.ends()[0]);
            }
            if a.k > b.k { b.halve() } else { a.halve() }
        }
    }

    /// Whether one of two stretches lies within the other.
    fn may_be(&self, other: &Self) -> bool {
        let (small, large) = if self.k > other.k { (self, other) } else { (other, self) };
        &small.n >> (small.k - large.k) == large.n
    }

    /// Halves the stretch that it lies on.
    fn halve(&mut self) {
        if self.is_point {
            return;
        }
        let middle = &self.n * 2 + 1;
        let side = self.side(at_binary(&self.polynomial, &middle, self.k + 1));
        self.k += 1;
        self.is_point = side.is_eq();
        self.n = if side.is_lt() { middle - 1 } else { middle };
    }

    /// A stretch no longer than 2^−`bits` that it lies on.
    pub(super) fn enclosed(&mut self, bits: u32) -> [BigRational; 2] {
        while !self.is_point && self.k < bits.into() {
            self.halve();
        }
        self.ends()
    }
}

/// The product of two polynomials.
pub(super) fn product(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let mut product = vec![BigInt::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(c: &[i64]) -> Vec<BigInt> {
        c.iter().map(|&c| BigInt::from(c)).collect()
    }

    #[test]
    fn the_same_number_of_two_polynomials_is_the_same() {
        // (x² − 3)(x² − x − 1) and (x² − 3)(x² + 5x + 1): ±√3, the golden ratio and −1/it; −0.2 and −4.8.
        let [first, second] = [[3, 3, -4, -1, 1], [-3, -15, -2, 5, 1]].map(|c| Isolated::all_of(whole(&c)));
        assert_eq!((first.len(), second.len()), (4, 4));
        let order = |i: usize, j: usize| first[i].compare(&second[j]);
        assert_eq!((order(0, 1), order(3, 3)), (Ordering::Equal, Ordering::Equal));
        assert_eq!(
            (order(2, 3), order(0, 0), order(1, 2)),
            (Ordering::Less, Ordering::Greater, Ordering::Less)
        );
    }

    #[test]
    fn roots_are_found_in_order_each_once() {
        // (x + 3) x (x − 1)² (3 x − 1).
        let factors: [&[i64]; 5] = [&[3, 1], &[0, 1], &[-1, 1], &[-1, 1], &[-1, 3]];
        let polynomial = factors.iter().fold(whole(&[1]), |p, factor| product(&p, &whole(factor)));
        let roots = Isolated::all_of(polynomial);
        let right = [(-3, 1), (0, 1), (1, 3), (1, 1)].map(|(p, q)| BigRational::new(p.into(), q.into()));
        assert_eq!(roots.len(), right.len());
        for (root, right) in roots.iter().zip(&right) {
            assert_eq!(root.compare_ratio(right), Ordering::Equal);
            let [low, high] = root.clone().enclosed(60);
            assert!(low <= *right && *right <= high);
        }
    }
}
