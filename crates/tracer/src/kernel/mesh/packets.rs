//! Which packets of a group may enter a box: tested for all of them at once, by boxes round their slopes.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};

use super::GROUP;

/// The packets of a group side by side.
pub(super) struct Packets {
    /// Boxes round their slopes.
    low: [[f32; GROUP]; 2],
    high: [[f32; GROUP]; 2],
    /// At least how far each still looks.
    far: [f32; GROUP],
}

impl Packets {
    pub(super) const NONE: Self =
        Self { low: [[0.0; GROUP]; 2], high: [[0.0; GROUP]; 2], far: [f32::NEG_INFINITY; GROUP] };

    #[inline(always)]
    pub(super) fn set(&mut self, at: usize, [low, high]: [[f32; 2]; 2], far: f32) {
        for axis in 0..2 {
            (self.low[axis][at], self.high[axis][at]) = (low[axis], high[axis]);
        }
        self.far[at] = far;
    }

    /// Which of them have a larger box round their slopes than half of another: one that it touches need not hold a ray.
    #[inline(always)]
    pub(super) fn larger_than_half<S: Simd>(&self, s: S, [low_u, high_u, low_v, high_v]: [f32; 4]) -> u32 {
        let size = |axis: usize| {
            f32x16::load_array_ref(s, &self.high[axis]) - f32x16::load_array_ref(s, &self.low[axis])
        };
        let (wide, high) =
            (f32x16::splat(s, 0.5 * (high_u - low_u)), f32x16::splat(s, 0.5 * (high_v - low_v)));
        (size(0).simd_gt(wide) | size(1).simd_gt(high)).to_bitmask() as u32
    }

    /// How far the one that looks farthest does.
    #[inline(always)]
    pub(super) fn farthest<S: Simd>(&self, s: S) -> f32 {
        f32x16::load_array_ref(s, &self.far).reduce_max()
    }

    /// Which of them look as far as that.
    #[inline(always)]
    pub(super) fn within<S: Simd>(&self, s: S, near: f32) -> u32 {
        f32x16::load_array_ref(s, &self.far).simd_ge(f32x16::splat(s, near)).to_bitmask() as u32
    }

    /// Which of them look as far as that, with a box round their slopes that touches another.
    #[inline(always)]
    pub(super) fn entering<S: Simd>(
        &self,
        s: S,
        ([low_u, high_u, low_v, high_v], near): ([f32; 4], f32),
    ) -> u32 {
        let row = |row| f32x16::load_array_ref(s, row);
        let beside = row(&self.high[0]).simd_lt(f32x16::splat(s, low_u))
            | row(&self.low[0]).simd_gt(f32x16::splat(s, high_u))
            | row(&self.high[1]).simd_lt(f32x16::splat(s, low_v))
            | row(&self.low[1]).simd_gt(f32x16::splat(s, high_v));
        self.within(s, near) & !(beside.to_bitmask() as u32)
    }
}
