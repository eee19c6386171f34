//! Lanes of the CPU's SIMD registers as the formulas' numbers: `f32` at native width and the same lanes in `f64`.

mod angle;
mod column;
mod double;
mod fused;
mod level;
mod precise;
mod prefetch;
mod vectors;
mod word;

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use catoptra_core::{Arithmetic, Coefficient, Lane, LaneMask};
use fearless_simd::prelude::*;

pub(crate) use column::Column;
pub(crate) use double::D;
pub(crate) use fused::MulAdd8;
use fused::mul_add32;
pub(crate) use level::{Work, at_level, outlined};
pub(crate) use precise::{Precise, narrow3, pick3};
pub(crate) use prefetch::prefetch;
pub(crate) use vectors::{
    D3, F3, LaneVectors, compress_wide3, compress3, cross, load_wide3, load3, magnitude, splat_wide, splat3,
    store_wide3, store3, unit, vector_of, widen3,
};
pub(crate) use word::{HALVES, Word, share_of_one, steps_of_one};

/// `f32` in every lane.
#[derive(Clone, Copy)]
pub(crate) struct F<S: Simd>(pub(crate) S::f32s);

/// A truth value in every lane.
#[derive(Clone, Copy)]
pub(crate) struct M<S: Simd>(pub(crate) S::mask32s);

/// Whole numbers in every lane.
#[derive(Clone, Copy)]
pub(crate) struct U<S: Simd>(pub(crate) S::u32s);

impl<S: Simd> F<S> {
    /// How many lanes there are.
    pub(crate) const LANES: usize = S::f32s::LEN;

    #[inline(always)]
    pub(crate) fn splat(s: S, v: f32) -> Self {
        Self(S::f32s::splat(s, v))
    }

    #[inline(always)]
    pub(crate) fn load(s: S, from: &[f32]) -> Self {
        Self(S::f32s::from_slice(s, &from[..Self::LANES]))
    }

    #[inline(always)]
    pub(crate) fn store(self, to: &mut [f32]) {
        self.0.store_slice(&mut to[..Self::LANES]);
    }

    #[inline(always)]
    pub(crate) fn lane(self, lane: usize) -> f32 {
        self.0.as_slice()[lane]
    }

    /// The lanes where the mask holds one after another, and anything after them.
    #[inline(always)]
    pub(crate) fn compressed(self, mask: M<S>) -> Self {
        Self(self.0.compress(mask.0))
    }

    /// The least of all lanes.
    #[inline(always)]
    pub(crate) fn least(self) -> f64 {
        f64::from(self.0.reduce_min())
    }

    /// The greatest of all lanes.
    #[inline(always)]
    pub(crate) fn greatest(self) -> f64 {
        f64::from(self.0.reduce_max())
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: f32) {
        self.0.as_mut_slice()[lane] = v;
    }

    #[inline(always)]
    pub(crate) fn widen(self) -> D<S> {
        let (lower, upper) = self.0.widen();
        D { lower, upper }
    }

    #[inline(always)]
    pub(crate) fn pick(mask: M<S>, if_true: Self, if_false: Self) -> Self {
        Self(mask.0.select(if_true.0, if_false.0))
    }

    /// `2^self` for magnitudes below 126, within 2 units in the last place.
    #[inline(always)]
    fn exp2(self) -> Self {
        let s = self.0.token();
        let clamped = self.max(Self::splat(s, -126.0)).min(Self::splat(s, 127.0));
        let whole = clamped.floor();
        let part = clamped - whole;
        // Taylor terms of 2^x = e^(x ln 2); the first one left out is below 2⁻²⁶ for x < 1.
        let terms: [f32; 9] = [
            1.321_548_7e-6,
            1.525_273_4e-5,
            1.540_353e-4,
            1.333_355_8e-3,
            9.618_129e-3,
            5.550_411e-2,
            2.402_265e-1,
            6.931_472e-1,
            1.0,
        ];
        let mantissa = polynomial(part, terms);
        let exponent: S::i32s = (whole + Self::splat(s, 127.0)).0.to_int();
        let bits = exponent.bitcast::<S::u32s>() << 23;
        mantissa * Self(bits.bitcast())
    }

    /// Binary logarithm of a normal positive number, within 2⁻²² absolute near 1 and relative elsewhere.
    #[inline(always)]
    fn log2(self) -> Self {
        let s = self.0.token();
        let bits = self.0.bitcast::<S::u32s>();
        // Mantissa in √½..√2, so that the series below converges fast and log2(1) is 0.
        let shifted = bits - 0x3f35_04f3;
        let exponent: S::f32s = (shifted.bitcast::<S::i32s>() >> 23).to_float();
        let mantissa = Self(((shifted & 0x007f_ffff) + 0x3f35_04f3).bitcast());
        let one = Self::splat(s, 1.0);
        // log2 m = 2 / ln 2 (z + z³/3 + z⁵/5 + …), z = (m − 1) / (m + 1), |z| < 0.172.
        let z = (mantissa - one) / (mantissa + one);
        let z2 = z * z;
        let terms: [f32; 5] = [0.320_598_9, 0.412_198_6, 0.577_078, 0.961_796_7, 2.885_39];
        let series = polynomial(z2, terms);
        series.mul_add(z, Self(exponent))
    }
}

/// The polynomial with those coefficients, highest power first.
#[inline(always)]
fn polynomial<S: Simd, const N: usize>(x: F<S>, coefficients: [f32; N]) -> F<S> {
    let s = x.0.token();
    let mut sum = F::splat(s, coefficients[0]);
    for &c in &coefficients[1..] {
        sum = sum.mul_add(x, F::splat(s, c));
    }
    sum
}

macro_rules! binary {
    ($type:ident, $trait:ident, $name:ident) => {
        impl<S: Simd> $trait for $type<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                Self(self.0.$name(o.0))
            }
        }
    };
}

binary!(F, Add, add);
binary!(F, Sub, sub);
binary!(F, Mul, mul);
binary!(F, Div, div);
binary!(M, BitAnd, bitand);
binary!(M, BitOr, bitor);

impl<S: Simd> Neg for F<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Simd> Not for M<S> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

impl<S: Simd> LaneMask for M<S> {
    #[inline(always)]
    fn any(self) -> bool {
        self.0.any_true()
    }
    #[inline(always)]
    fn count(self) -> u64 {
        M::count(self)
    }
}

impl<S: Simd> M<S> {
    #[inline(always)]
    pub(crate) fn splat(s: S, v: bool) -> Self {
        Self(S::mask32s::splat(s, v))
    }

    /// One bit a lane.
    #[inline(always)]
    pub(crate) fn bits(self) -> u64 {
        self.0.to_bitmask()
    }

    #[inline(always)]
    pub(crate) fn from_bits(s: S, bits: u64) -> Self {
        Self(S::mask32s::from_bitmask(s, bits))
    }

    /// How many lanes hold.
    #[inline(always)]
    pub(crate) fn count(self) -> u64 {
        u64::from(self.bits().count_ones())
    }

    #[inline(always)]
    pub(crate) fn lanes(self) -> Bits {
        Bits(self.bits())
    }
}

/// The lanes of a mask that hold, lowest first.
pub(crate) struct Bits(pub(crate) u64);

impl Iterator for Bits {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let lane = self.0.trailing_zeros() as usize;
        self.0 &= self.0.wrapping_sub(1);
        (lane < 64).then_some(lane)
    }
}

impl<S: Simd> Arithmetic for F<S> {
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        Self(mul_add32::<S>(self.0, factor.0, summand.0))
    }
}

impl<S: Simd> Lane for F<S> {
    type Mask = M<S>;

    #[inline(always)]
    fn of(self, constant: Coefficient) -> Self {
        Self::splat(self.0.token(), constant.narrow)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(self.0.floor())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
    #[inline(always)]
    fn less(self, other: Self) -> M<S> {
        M(self.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn select(mask: M<S>, if_true: Self, if_false: Self) -> Self {
        Self::pick(mask, if_true, if_false)
    }
    #[inline(always)]
    fn real_power(self, exponent: Coefficient) -> Self {
        let smallest = self.number(f64::from(f32::MIN_POSITIVE));
        let power = (self.max(smallest).log2() * self.of(exponent)).exp2();
        Self::pick(self.less(smallest), self.number(0.0), power)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        angle::atan2(self, x)
    }
    #[inline(always)]
    fn each(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut results = self;
        for lane in 0..Self::LANES {
            results.set(lane, f(f64::from(self.lane(lane)), f64::from(other.lane(lane))) as f32);
        }
        results
    }
}

/// As many lanes as there may be.
pub(crate) const MOST_LANES: usize = 16;

/// The numbers of lanes.
static COUNTED: [u32; MOST_LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

impl<S: Simd> U<S> {
    /// The numbers in the lanes of a mask, each with all lanes that hold it.
    #[inline(always)]
    pub(crate) fn groups(self, mask: M<S>) -> impl Iterator<Item = (u32, M<S>)> {
        let mut remaining = mask;
        std::iter::from_fn(
            #[inline(always)]
            move || {
                let bits = remaining.bits();
                let number = (bits != 0).then(|| self.lane(bits.trailing_zeros() as usize))?;
                let lanes = remaining & self.is(number);
                remaining = remaining & !lanes;
                Some((number, lanes))
            },
        )
    }

    #[inline(always)]
    pub(crate) fn splat(s: S, v: u32) -> Self {
        Self(S::u32s::splat(s, v))
    }

    #[inline(always)]
    pub(crate) fn load(s: S, from: &[u32]) -> Self {
        Self(S::u32s::from_slice(s, &from[..F::<S>::LANES]))
    }

    #[inline(always)]
    pub(crate) fn store(self, to: &mut [u32]) {
        self.0.store_slice(&mut to[..F::<S>::LANES]);
    }

    #[inline(always)]
    pub(crate) fn lane(self, lane: usize) -> u32 {
        self.0.as_slice()[lane]
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: u32) {
        self.0.as_mut_slice()[lane] = v;
    }

    /// The lanes where the mask holds one after another, and anything after them.
    #[inline(always)]
    pub(crate) fn compressed(self, mask: M<S>) -> Self {
        Self(self.0.compress(mask.0))
    }

    /// `first`, `first + 1`, …
    #[inline(always)]
    pub(crate) fn counted(s: S, first: u32) -> Self {
        Self(S::u32s::from_slice(s, &COUNTED[..F::<S>::LANES]) + first)
    }

    /// Lanes that hold what [`counted`](Self::counted) gives.
    #[inline(always)]
    pub(crate) fn counts_from(self, s: S, first: u32) -> M<S> {
        M(self.0.simd_eq(Self::counted(s, first).0))
    }

    #[inline(always)]
    pub(crate) fn is(self, v: u32) -> M<S> {
        M(self.0.simd_eq(v))
    }

    /// Lanes that hold the same number.
    #[inline(always)]
    pub(crate) fn equals(self, other: Self) -> M<S> {
        M(self.0.simd_eq(other.0))
    }

    #[inline(always)]
    pub(crate) fn pick(mask: M<S>, if_true: Self, if_false: Self) -> Self {
        Self(mask.0.select(if_true.0, if_false.0))
    }
}
