//! Whole numbers of 32 bits, one or a register of them, so that one formula over bits serves both.

use fearless_simd::prelude::*;

use super::{F, U};
use crate::numeric::SAMPLE_STEP;

/// Whole numbers of 32 bits, side by side; sums and products wrap.
pub(crate) trait Word: Copy {
    /// The constant in every lane; `self` only says which lanes.
    fn of(self, constant: u32) -> Self;
    /// The sum.
    fn plus(self, other: Self) -> Self;
    /// The product.
    fn times(self, other: Self) -> Self;
    /// Bits that are set in one of both.
    fn xor(self, other: Self) -> Self;
    /// Bits that are set in both.
    fn and(self, other: Self) -> Self;
    /// Shifts bits to the left by `places`, which is below 32.
    fn shift_up(self, places: u32) -> Self;
    /// Shifts bits to the right by `places`, which is below 32.
    fn shift_down(self, places: u32) -> Self;

    /// Sum with a constant.
    #[inline(always)]
    fn plus_number(self, constant: u32) -> Self {
        self.plus(self.of(constant))
    }

    /// Product with a constant.
    #[inline(always)]
    fn times_number(self, constant: u32) -> Self {
        self.times(self.of(constant))
    }

    /// The lowest bit becomes the highest, and so on.
    #[inline(always)]
    fn reversed(self) -> Self {
        let mut bits = self;
        for (places, lower) in HALVES {
            let mask = bits.of(lower);
            // The two shifted parts share no bit.
            bits = bits.and(mask).shift_up(places).xor(bits.shift_down(places).and(mask));
        }
        bits
    }
}

/// How many bits lie in a half of a word, of a half of it and so on, and where the lower ones of both halves are.
pub(crate) const HALVES: [(u32, u32); 5] =
    [(16, 0x0000_ffff), (8, 0x00ff_00ff), (4, 0x0f0f_0f0f), (2, 0x3333_3333), (1, 0x5555_5555)];

impl Word for u32 {
    #[inline(always)]
    fn of(self, constant: u32) -> Self {
        constant
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self.wrapping_mul(other)
    }
    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        self ^ other
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self & other
    }
    #[inline(always)]
    fn shift_up(self, places: u32) -> Self {
        self << places
    }
    #[inline(always)]
    fn shift_down(self, places: u32) -> Self {
        self >> places
    }
    #[inline(always)]
    fn reversed(self) -> Self {
        self.reverse_bits()
    }
}

impl<S: Simd> Word for U<S> {
    #[inline(always)]
    fn of(self, constant: u32) -> Self {
        Self::splat(self.0.token(), constant)
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        Self(self.0 ^ other.0)
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
    #[inline(always)]
    fn shift_up(self, places: u32) -> Self {
        Self(self.0 << places)
    }
    #[inline(always)]
    fn shift_down(self, places: u32) -> Self {
        Self(self.0 >> places)
    }
}

/// A share of 2³² as a share of 1: the multiple of 2⁻²⁴ below it.
#[inline(always)]
pub(crate) fn share_of_one<S: Simd>(bits: U<S>) -> F<S> {
    let whole: S::f32s = (bits.0 >> 8).bitcast::<S::i32s>().to_float();
    F(whole * (1.0 / (1_u32 << 24) as f32))
}

/// A share of 2³² as a share of 1, cut off to a multiple of [`SAMPLE_STEP`].
#[inline(always)]
pub(crate) fn steps_of_one<S: Simd>(bits: U<S>) -> F<S> {
    const STEP_BITS: u32 = (1.0 / SAMPLE_STEP) as u32;
    let below = u32::BITS - STEP_BITS.ilog2();
    let whole: S::f32s = (bits.0 >> below).bitcast::<S::i32s>().to_float();
    F(whole * SAMPLE_STEP as f32)
}
