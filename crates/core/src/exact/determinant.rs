//! The sign of a determinant of three vectors: on which side of a line an edge passes, whether four points lie in one plane.
//!
//! Where `f64` cannot tell, whole numbers of 256 bits mostly can: they lie on the stack and take a hundredth of the time of
//! numbers of any size, which are left with what spans more than [`WINDOW`] bits. Between corners of meshes, which `f32` holds, 128
//! bits mostly do. Each vector has a scale of its own, which changes no sign.

use std::cmp::Ordering;

use ethnum::I256;
use glam::DVec3;

use super::{Dyadic, Vector, answer_exactly, count_side};

/// A vector: `to − from`, without rounding.
#[derive(Debug, Clone, Copy)]
pub struct Difference {
    /// What is taken away.
    pub from: DVec3,
    /// From what.
    pub to: DVec3,
}

impl Difference {
    /// A vector as it is.
    #[must_use]
    pub const fn of(vector: DVec3) -> Self {
        Self { from: DVec3::ZERO, to: vector }
    }

    fn exact(&self) -> Vector<Dyadic> {
        Vector::of(self.to).minus(&Vector::of(self.from))
    }

    /// Its coordinates as whole numbers below 2^[`SHORT`] in units of one power of two, if they are and `f64` rounds none.
    #[inline]
    fn short(&self) -> Option<[i128; 3]> {
        let Self { from, to } = *self;
        let difference = to - from;
        // Taking either away again gives the other: nothing was rounded (Dekker, Numerische Mathematik 18, 1971).
        if to - difference != from || from + difference != to {
            return None;
        }
        let exponent = difference.abs().max_element().to_bits() >> STORED;
        // 2^SHORT over the power of two above the largest, if it is a number of at least 1, by which nothing underflows.
        let scale = (2045 + u64::from(SHORT)).checked_sub(exponent);
        let scale = scale.filter(|scale| (1023..2047).contains(scale))?;
        let scaled = difference * f64::from_bits(scale << STORED);
        let whole = scaled.to_array().map(|c| c as i64);
        (whole.map(|c| c as f64) == scaled.to_array()).then_some(whole.map(i128::from))
    }

    /// Its coordinates as whole numbers below 2⁸⁴ in units of one power of two, if they are.
    #[inline]
    fn whole(&self) -> Option<[i128; 3]> {
        let digits = |v: DVec3| [Digits::of(v.x), Digits::of(v.y), Digits::of(v.z)];
        let (to, from) = (digits(self.to), digits(self.from));
        let mut largest = 0;
        for number in [&to[0], &to[1], &to[2], &from[0], &from[1], &from[2]] {
            largest = if number.mantissa == 0 { largest } else { largest.max(number.exponent) };
        }
        let unit = largest - (WINDOW - f64::MANTISSA_DIGITS).cast_signed();
        let coordinate = |i: usize| Some(to[i].in_units(unit)? - from[i].in_units(unit)?);
        Some([coordinate(0)?, coordinate(1)?, coordinate(2)?])
    }
}

/// Bits from the highest of the largest coordinate to the lowest of any: three coordinates multiplied, and sums of six such
/// products, stay below 2²⁵⁵.
const WINDOW: u32 = 83;

/// Bits of an `f64` below its exponent.
const STORED: u32 = f64::MANTISSA_DIGITS - 1;

/// Bits of coordinates of which three multiplied, and sums of six such products, stay below 2¹²⁷.
const SHORT: u32 = 40;

/// `mantissa × 2^exponent`, an `f64`.
struct Digits {
    mantissa: i64,
    exponent: i32,
}

impl Digits {
    /// Of a finite number.
    #[inline]
    fn of(value: f64) -> Self {
        let bits = value.abs().to_bits();
        let (fraction, exponent) = (bits & ((1 << STORED) - 1), (bits >> STORED) as i32);
        let normal = exponent > 0;
        let magnitude = (fraction | u64::from(normal) << STORED).cast_signed();
        let mantissa = if value.is_sign_negative() { -magnitude } else { magnitude };
        Self { mantissa, exponent: exponent.max(1) }
    }

    /// How many of `2^unit` it is, if it is a whole number of them.
    #[inline]
    fn in_units(&self, unit: i32) -> Option<i128> {
        let up = self.exponent - unit;
        if up >= 0 || self.mantissa == 0 {
            return Some(i128::from(self.mantissa) << up.max(0));
        }
        let down = up.unsigned_abs();
        (self.mantissa.trailing_zeros() >= down).then(|| i128::from(self.mantissa >> down))
    }
}

/// The sign of `(a × b) · c`, exactly; the coordinates are finite.
#[cold]
#[inline(never)]
#[must_use]
pub fn sign_of_determinant(rows: &[Difference; 3]) -> Ordering {
    count_side();
    answer_exactly(|| sign_of_short(rows).unwrap_or_else(|| sign_of_long(rows)))
}

/// The same of [short](Difference::short) vectors alone.
#[inline]
fn sign_of_short(rows: &[Difference; 3]) -> Option<Ordering> {
    let [a, b, c] = [rows[0].short()?, rows[1].short()?, rows[2].short()?];
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    Some((minor(1, 2) * c[0] + minor(2, 0) * c[1] + minor(0, 1) * c[2]).cmp(&0))
}

/// The same of all others.
fn sign_of_long(rows: &[Difference; 3]) -> Ordering {
    match rows.each_ref().map(Difference::whole) {
        [Some(a), Some(b), Some(c)] => sign_of_whole(&a, &b, &c),
        _ => {
            let [a, b, c] = rows.each_ref().map(Difference::exact);
            a.cross(&b).dot(&c).signum()
        }
    }
}

#[inline]
fn sign_of_whole(a: &[i128; 3], b: &[i128; 3], c: &[i128; 3]) -> Ordering {
    let minor = |i: usize, j: usize| product(a[i], b[j]) - product(a[j], b[i]);
    let volume =
        minor(1, 2) * I256::from(c[0]) + minor(2, 0) * I256::from(c[1]) + minor(0, 1) * I256::from(c[2]);
    volume.cmp(&I256::ZERO)
}

/// `a × b`, mostly of numbers that 64 bits hold.
#[inline]
fn product(a: i128, b: i128) -> I256 {
    match (i64::try_from(a), i64::try_from(b)) {
        (Ok(a), Ok(b)) => I256::from(i128::from(a) * i128::from(b)),
        _ => I256::from(a) * I256::from(b),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn exact(rows: &[Difference; 3]) -> Ordering {
        let [a, b, c] = rows.each_ref().map(Difference::exact);
        a.cross(&b).dot(&c).signum()
    }

    /// Of few and of many digits, of one size and of many, down to subnormal ones.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            (-9_i32..10).prop_map(f64::from),
            -2.0..2.0_f64,
            (-2.0..2.0_f32).prop_map(f64::from),
            (-1.0..1.0_f64, -90..40_i32).prop_map(|(m, e)| m * 2.0_f64.powi(e)),
            Just(0.0),
            Just(f64::from_bits(3)),
            (-1.0..1.0_f64).prop_map(|m| m * f64::MAX),
        ]
    }

    fn vector() -> impl Strategy<Value = DVec3> {
        [coordinate(), coordinate(), coordinate()].prop_map(DVec3::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn the_sign_is_that_of_numbers_of_any_size(
            o in vector(), p in vector(), q in vector(), d in vector(), along in -3.0..3.0_f64,
        ) {
            let to = |to: DVec3| Difference { from: o, to };
            // Of any direction, and of one that leads through p, or through a point of the edge from p to q.
            for d in [d, p - o, (p - o).lerp(q - o, along)] {
                if d.is_finite() {
                    let rows = [to(p), to(q), Difference::of(d)];
                    prop_assert_eq!(sign_of_determinant(&rows), exact(&rows), "{:?}", rows);
                }
            }
        }
    }

    #[test]
    fn ordinary_coordinates_are_whole_and_wide_ones_are_not() {
        let near = Difference { from: DVec3::new(0.1, 1e-3, -7.3), to: DVec3::new(1.7, 2e-4, 3.1) };
        assert!(near.whole().is_some());
        let wide = Difference { from: DVec3::new(1e-12, 0.3, 0.0), to: DVec3::splat(1.0 / 3.0) };
        assert!(wide.whole().is_none());
        assert_eq!(Difference::of(DVec3::ZERO).whole(), Some([0; 3]));
    }

    #[test]
    fn differences_of_corners_in_f32_are_short() {
        let corner = |p: [f32; 3]| DVec3::from(p.map(f64::from));
        let (from, to) = (corner([0.1, 1e-3, -7.3]), corner([1.7, 2e-4, 3.1]));
        assert!(Difference { from, to }.short().is_some());
        assert!(Difference { from: DVec3::ZERO, to: DVec3::splat(0.1) }.short().is_none());
        let most = (1_u64 << SHORT) as f64 - 1.0;
        assert_eq!(Difference::of(DVec3::splat(-most)).short(), Some([1 - (1 << SHORT); 3]));
        assert_eq!(Difference::of(DVec3::new(1e300, f64::from_bits(1), 0.0)).short(), None);
        let rows = [[1.0, -1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]];
        let rows = rows.map(|signs| Difference::of(DVec3::from(signs) * most));
        assert_eq!(sign_of_short(&rows), Some(exact(&rows)));
    }

    #[test]
    fn the_largest_whole_numbers_do_not_overflow() {
        // All of 84 bits: opposite ends of the window.
        let most = 2.0_f64.powi(30) * (2.0 - f64::EPSILON);
        let rows = [[1.0, -1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]].map(|signs| {
            let to = DVec3::from(signs) * most;
            Difference { from: -to, to }
        });
        assert_eq!(sign_of_determinant(&rows), exact(&rows));
        assert_eq!(exact(&rows), Ordering::Greater);
    }
}
