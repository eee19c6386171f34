//! Which packets of a group may enter a box: tested for all of them at once, by boxes round their places.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};

use super::GROUP;

/// A box as the rays see it: between which places it lies, and the depth at which rays enter it.
pub(super) struct SeenBox {
    pub(super) low: [f32; 2],
    pub(super) high: [f32; 2],
    pub(super) near: f32,
}

/// The packets of a group side by side.
pub(super) struct Packets {
    /// Boxes round their places.
    low: [[f32; GROUP]; 2],
    high: [[f32; GROUP]; 2],
    /// At least the depth of each packet's farthest hit so far.
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

    /// Which of them have a box round their places that is larger than half of a seen one: where these touch, that need
    /// not hold a ray.
    #[inline(always)]
    pub(super) fn larger_than_half<S: Simd>(&self, s: S, seen: &SeenBox) -> u32 {
        let size = |axis: usize| {
            f32x16::load_array_ref(s, &self.high[axis]) - f32x16::load_array_ref(s, &self.low[axis])
        };
        let (wide, high) = (
            f32x16::splat(s, 0.5 * (seen.high[0] - seen.low[0])),
            f32x16::splat(s, 0.5 * (seen.high[1] - seen.low[1])),
        );
        (size(0).simd_gt(wide) | size(1).simd_gt(high)).to_bitmask() as u32
    }

    /// The largest of these depths.
    #[inline(always)]
    pub(super) fn farthest<S: Simd>(&self, s: S) -> f32 {
        f32x16::load_array_ref(s, &self.far).reduce_max()
    }

    /// Which of them may have a nearer hit at that depth.
    #[inline(always)]
    pub(super) fn within<S: Simd>(&self, s: S, near: f32) -> u32 {
        f32x16::load_array_ref(s, &self.far).simd_ge(f32x16::splat(s, near)).to_bitmask() as u32
    }

    /// Which of them may have a nearer hit in a box that the one round their places touches.
    #[inline(always)]
    pub(super) fn entering<S: Simd>(&self, s: S, seen: &SeenBox) -> u32 {
        let row = |row| f32x16::load_array_ref(s, row);
        let beside = row(&self.high[0]).simd_lt(f32x16::splat(s, seen.low[0]))
            | row(&self.low[0]).simd_gt(f32x16::splat(s, seen.high[0]))
            | row(&self.high[1]).simd_lt(f32x16::splat(s, seen.low[1]))
            | row(&self.low[1]).simd_gt(f32x16::splat(s, seen.high[1]));
        self.within(s, seen.near) & !(beside.to_bitmask() as u32)
    }
}
