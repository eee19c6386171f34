//! The same lanes in `f64`: two registers, the lower half of the lanes and the upper half.

use std::ops::{Add, Div, Mul, Neg, Sub};

use catoptra_core::Arithmetic;
use fearless_simd::prelude::*;

use super::fused::mul_add64;
use super::{F, M};

/// `f64` in every lane: the lower half of the lanes and the upper half.
#[derive(Clone, Copy)]
pub(crate) struct D<S: Simd> {
    pub(super) lower: S::f64s,
    pub(super) upper: S::f64s,
}

impl<S: Simd> D<S> {
    #[inline(always)]
    pub(crate) fn splat(s: S, v: f64) -> Self {
        Self { lower: S::f64s::splat(s, v), upper: S::f64s::splat(s, v) }
    }

    #[inline(always)]
    pub(crate) fn load(s: S, from: &[f64]) -> Self {
        let half = S::f64s::LEN;
        Self {
            lower: S::f64s::from_slice(s, &from[..half]),
            upper: S::f64s::from_slice(s, &from[half..2 * half]),
        }
    }

    #[inline(always)]
    pub(crate) fn store(self, to: &mut [f64]) {
        let half = S::f64s::LEN;
        self.lower.store_slice(&mut to[..half]);
        self.upper.store_slice(&mut to[half..2 * half]);
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        Self { lower: self.lower.abs(), upper: self.upper.abs() }
    }

    #[inline(always)]
    pub(crate) fn max(self, o: Self) -> Self {
        Self { lower: self.lower.max(o.lower), upper: self.upper.max(o.upper) }
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: f64) {
        let half = S::f64s::LEN;
        if lane < half {
            self.lower.as_mut_slice()[lane] = v;
        } else {
            self.upper.as_mut_slice()[lane - half] = v;
        }
    }

    /// Where `self <= o`; never for NaN.
    #[inline(always)]
    pub(crate) fn at_most(self, o: Self) -> M<S> {
        let half = S::f64s::LEN;
        let (lower, upper) = (self.lower.simd_le(o.lower), self.upper.simd_le(o.upper));
        let s = self.lower.token();
        M(S::mask32s::from_bitmask(s, lower.to_bitmask() | upper.to_bitmask() << half))
    }

    #[inline(always)]
    pub(crate) fn lane(self, lane: usize) -> f64 {
        let half = S::f64s::LEN;
        if lane < half { self.lower.as_slice()[lane] } else { self.upper.as_slice()[lane - half] }
    }

    /// Writes the lanes where the mask holds one after another, and anything after them, up to all lanes.
    #[inline(always)]
    pub(crate) fn compress(self, mask: M<S>, to: &mut [f64]) {
        let [lower, upper] = Self::halves(mask);
        let half = S::f64s::LEN;
        let first = (mask.bits() & ((1 << half) - 1)).count_ones() as usize;
        self.lower.compress(lower).store_slice(&mut to[..half]);
        self.upper.compress(upper).store_slice(&mut to[first..first + half]);
    }

    #[inline(always)]
    fn halves(mask: M<S>) -> [S::mask64s; 2] {
        let (s, bits, half) = (mask.0.token(), mask.bits(), S::f64s::LEN);
        let low = (1_u64 << half) - 1;
        [S::mask64s::from_bitmask(s, bits & low), S::mask64s::from_bitmask(s, bits >> half & low)]
    }

    /// Rounded to `f32`.
    #[inline(always)]
    pub(crate) fn narrow(self) -> F<S> {
        F(self.lower.narrow(self.upper))
    }

    #[inline(always)]
    pub(crate) fn pick(mask: M<S>, if_true: Self, if_false: Self) -> Self {
        let [lower, upper] = Self::halves(mask);
        Self {
            lower: lower.select(if_true.lower, if_false.lower),
            upper: upper.select(if_true.upper, if_false.upper),
        }
    }
}

macro_rules! binary_double {
    ($trait:ident, $name:ident) => {
        impl<S: Simd> $trait for D<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                Self { lower: self.lower.$name(o.lower), upper: self.upper.$name(o.upper) }
            }
        }
    };
}

binary_double!(Add, add);
binary_double!(Sub, sub);
binary_double!(Mul, mul);
binary_double!(Div, div);

impl<S: Simd> Neg for D<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { lower: -self.lower, upper: -self.upper }
    }
}

impl<S: Simd> Arithmetic for D<S> {
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        Self {
            lower: mul_add64::<S>(self.lower, factor.lower, summand.lower),
            upper: mul_add64::<S>(self.upper, factor.upper, summand.upper),
        }
    }
}
