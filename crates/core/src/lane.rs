//! How one formula serves one ray in `f64` and many rays in `f32`: arithmetic over lanes.
//!
//! Lights and materials are written once, generic over [`Lane`]. The exact backends evaluate them with `f64`; the
//! SIMD backend brings a lane type of its own. Every operation is a single correctly rounded one or a fixed
//! sequence of such, so that results do not depend on the number of lanes.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use glam::DVec3;

use crate::Rgb;

/// A constant of a part, in both precisions, rounded once when the part is made.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coefficient {
    /// As given.
    pub wide: f64,
    /// Rounded to `f32`.
    pub narrow: f32,
}

impl Coefficient {
    /// Keeps `value` and its rounding.
    #[inline(always)]
    #[must_use]
    pub const fn new(value: f64) -> Self {
        Self { wide: value, narrow: value as f32 }
    }
}

/// Which lanes a condition holds for.
pub trait LaneMask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Whether it holds for any lane.
    fn any(self) -> bool;
    /// How many lanes it holds for.
    fn count(self) -> u64;
}

impl LaneMask for bool {
    fn any(self) -> bool {
        self
    }
    fn count(self) -> u64 {
        u64::from(self)
    }
}

/// Numbers side by side that can be added and multiplied.
pub trait Arithmetic:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// `self * factor + summand`, rounded once.
    #[must_use]
    fn mul_add(self, factor: Self, summand: Self) -> Self;
}

/// Numbers side by side that formulas are written in; comparisons with NaN are false.
pub trait Lane: Arithmetic + Div<Output = Self> {
    /// One truth value per lane.
    type Mask: LaneMask;

    /// The constant in every lane; `self` only says which lanes.
    #[must_use]
    fn of(self, constant: Coefficient) -> Self;
    /// Square root; NaN below zero.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Largest whole number not above.
    #[must_use]
    fn floor(self) -> Self;
    /// Magnitude.
    #[must_use]
    fn abs(self) -> Self;
    /// The smaller; either where one is NaN.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// The larger; either where one is NaN.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// Where `self < other`.
    fn less(self, other: Self) -> Self::Mask;
    /// `if_true` where the mask holds, else `if_false`.
    #[must_use]
    fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self;
    /// `self` to a power that is not a small whole number; `self` ≥ 0.
    #[must_use]
    fn real_power(self, exponent: Coefficient) -> Self;
    /// The angle of the vector (`x`, `self`) from the x axis, radians in −π..=π; 0 where both are 0.
    #[must_use]
    fn atan2(self, x: Self) -> Self;
    /// What `f` makes of each lane and the same lane of `other`: for what has no formula, such as a table.
    #[must_use]
    fn each(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self;

    /// A constant given on the spot.
    #[inline(always)]
    #[must_use]
    fn number(self, value: f64) -> Self {
        self.of(Coefficient::new(value))
    }

    /// `self` to the power `exponent` ≥ 0; `self` ≥ 0. Small whole powers are products, so x¹ is x exactly.
    #[inline(always)]
    #[must_use]
    fn power(self, exponent: Coefficient) -> Self {
        if exponent.wide == 1.0 {
            return self;
        }
        let whole = exponent.wide as u32;
        if whole > MAX_PRODUCT_POWER || f64::from(whole) != exponent.wide {
            return self.real_power(exponent);
        }
        let (mut base, mut left, mut product) = (self, whole, self.number(1.0));
        while left > 0 {
            if left & 1 == 1 {
                product = product * base;
            }
            base = base * base;
            left >>= 1;
        }
        product
    }
}

/// Whole exponents up to this one are multiplied out: at most 20 products, each rounded once.
const MAX_PRODUCT_POWER: u32 = 1024;

impl Arithmetic for f64 {
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        f64::mul_add(self, factor, summand)
    }
}

impl Lane for f64 {
    type Mask = bool;

    fn of(self, constant: Coefficient) -> Self {
        constant.wide
    }
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    fn floor(self) -> Self {
        f64::floor(self)
    }
    fn abs(self) -> Self {
        f64::abs(self)
    }
    fn min(self, other: Self) -> Self {
        f64::min(self, other)
    }
    fn max(self, other: Self) -> Self {
        f64::max(self, other)
    }
    fn less(self, other: Self) -> bool {
        self < other
    }
    fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }
    fn real_power(self, exponent: Coefficient) -> Self {
        self.powf(exponent.wide)
    }
    fn atan2(self, x: Self) -> Self {
        f64::atan2(self, x)
    }
    fn each(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, other)
    }
}

/// Three numbers per lane: a point, a direction, or red, green and blue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triple<T> {
    /// First.
    pub x: T,
    /// Second.
    pub y: T,
    /// Third.
    pub z: T,
}

impl<T> Triple<T> {
    /// From three numbers.
    #[inline(always)]
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }
}

/// Three constants of a part.
pub type Constant3 = Triple<Coefficient>;

impl From<DVec3> for Constant3 {
    fn from(v: DVec3) -> Self {
        Self::new(Coefficient::new(v.x), Coefficient::new(v.y), Coefficient::new(v.z))
    }
}

impl From<Rgb> for Constant3 {
    fn from(c: Rgb) -> Self {
        Self::new(Coefficient::new(c.r), Coefficient::new(c.g), Coefficient::new(c.b))
    }
}

impl Constant3 {
    /// As given, a vector.
    #[must_use]
    pub fn vector(&self) -> DVec3 {
        DVec3::new(self.x.wide, self.y.wide, self.z.wide)
    }

    /// As given, a colour.
    #[must_use]
    pub fn rgb(&self) -> Rgb {
        Rgb::new(self.x.wide, self.y.wide, self.z.wide)
    }
}

impl From<DVec3> for Triple<f64> {
    fn from(v: DVec3) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl From<Triple<f64>> for DVec3 {
    fn from(v: Triple<f64>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl<L: Arithmetic> Triple<L> {
    /// The same number three times.
    #[inline(always)]
    #[must_use]
    pub fn splat(v: L) -> Self {
        Self::new(v, v, v)
    }

    /// Scalar product.
    #[inline(always)]
    #[must_use]
    pub fn dot(self, o: Self) -> L {
        self.x.mul_add(o.x, self.y.mul_add(o.y, self.z * o.z))
    }

    /// Each component times `k`.
    #[inline(always)]
    #[must_use]
    pub fn scale(self, k: L) -> Self {
        Self::new(self.x * k, self.y * k, self.z * k)
    }

    /// `self * k + o`, each component rounded once.
    #[inline(always)]
    #[must_use]
    pub fn scale_add(self, k: L, o: Self) -> Self {
        Self::new(self.x.mul_add(k, o.x), self.y.mul_add(k, o.y), self.z.mul_add(k, o.z))
    }

    /// Component by component product.
    #[inline(always)]
    #[must_use]
    pub fn times(self, o: Self) -> Self {
        Self::new(self.x * o.x, self.y * o.y, self.z * o.z)
    }

    /// `self * a + b`, component by component.
    #[inline(always)]
    #[must_use]
    pub fn times_add(self, a: Self, b: Self) -> Self {
        Self::new(self.x.mul_add(a.x, b.x), self.y.mul_add(a.y, b.y), self.z.mul_add(a.z, b.z))
    }
}

impl<L: Lane> Triple<L> {
    /// The constants in every lane of `like`.
    #[inline(always)]
    #[must_use]
    pub fn of(like: L, constants: &Constant3) -> Self {
        Self::new(like.of(constants.x), like.of(constants.y), like.of(constants.z))
    }

    /// `if_true` where the mask holds, else `if_false`.
    #[inline(always)]
    #[must_use]
    pub fn select(mask: L::Mask, if_true: Self, if_false: Self) -> Self {
        Self::new(
            L::select(mask, if_true.x, if_false.x),
            L::select(mask, if_true.y, if_false.y),
            L::select(mask, if_true.z, if_false.z),
        )
    }
}

impl<L: Arithmetic> Add for Triple<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}

impl<L: Arithmetic> Sub for Triple<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_powers_are_products() {
        assert_eq!(3.0_f64.power(Coefficient::new(5.0)), 243.0);
        assert_eq!(0.7_f64.power(Coefficient::new(1.0)), 0.7);
        assert_eq!(0.0_f64.power(Coefficient::new(0.0)), 1.0);
    }

    #[test]
    fn broken_powers_are_real_powers() {
        assert!((2.0_f64.power(Coefficient::new(0.5)) - std::f64::consts::SQRT_2).abs() < 1e-15);
    }
}
