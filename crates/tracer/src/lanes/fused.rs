//! `a * b + c`, rounded once, also where the CPU has no instruction for it.
//!
//! SSE2 has none: what stands in for it is a hundred instructions. Written into every formula, that made the code for SSE2 six
//! times as long as that for AVX2; as a function it is there once.

use fearless_simd::f32x8;
use fearless_simd::prelude::*;

/// Whether the instructions lack it: of those that are used on x86-64, the ones with four lanes.
const fn is_missing<S: Simd>() -> bool {
    cfg!(target_arch = "x86_64") && S::f32s::LEN == 4
}

#[inline(always)]
pub(super) fn mul_add32<S: Simd>(a: S::f32s, b: S::f32s, c: S::f32s) -> S::f32s {
    if is_missing::<S>() { stand_in32::<S>(a, b, c) } else { a.mul_add_precise(b, c) }
}

#[inline(always)]
pub(super) fn mul_add64<S: Simd>(a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
    if is_missing::<S>() { stand_in64::<S>(a, b, c) } else { a.mul_add_precise(b, c) }
}

#[inline(never)]
fn stand_in32<S: Simd>(a: S::f32s, b: S::f32s, c: S::f32s) -> S::f32s {
    a.mul_add_precise(b, c)
}

#[inline(never)]
fn stand_in64<S: Simd>(a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
    a.mul_add_precise(b, c)
}

/// `self * b + c` of eight numbers side by side.
pub(crate) trait MulAdd8 {
    /// Rounded once.
    #[must_use]
    fn fused(self, b: Self, c: Self) -> Self;
}

impl<S: Simd> MulAdd8 for f32x8<S> {
    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        if is_missing::<S>() { stand_in8(self, b, c) } else { self.mul_add_precise(b, c) }
    }
}

#[inline(never)]
fn stand_in8<S: Simd>(a: f32x8<S>, b: f32x8<S>, c: f32x8<S>) -> f32x8<S> {
    a.mul_add_precise(b, c)
}
