//! Bounds of the vectors in many lanes, shape by shape.

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Lane};
use fearless_simd::Simd;

use crate::film::NOTHING;
use crate::lanes::{F3, M, U, splat3};

/// Most shapes that have a box of their own; vectors of further ones share one.
const MOST_SHAPES: usize = 8;

/// Boxes round `N` vectors of every lane, shape by shape.
pub(crate) struct LaneBounds<S: Simd, const N: usize> {
    count: usize,
    prims: [u32; MOST_SHAPES],
    low: [[F3<S>; N]; MOST_SHAPES],
    high: [[F3<S>; N]; MOST_SHAPES],
    unset: F3<S>,
}

impl<S: Simd, const N: usize> LaneBounds<S, N> {
    #[inline(always)]
    pub(crate) fn nothing(s: S) -> Self {
        let most = splat3(s, [f32::MAX; 3]);
        Self {
            count: 0,
            prims: [0; MOST_SHAPES],
            low: [[most; N]; MOST_SHAPES],
            high: [[most; N]; MOST_SHAPES],
            unset: most,
        }
    }

    /// Forgets all vectors.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds the lanes of a mask to the boxes of their shapes.
    #[inline(always)]
    pub(crate) fn add(&mut self, lanes: M<S>, prims: U<S>, vectors: &[F3<S>; N]) {
        let mut remaining = lanes.bits();
        while remaining != 0 {
            let prim = prims.lane(remaining.trailing_zeros() as usize);
            let mask = lanes & prims.is(prim);
            self.grow(prim, mask, vectors);
            remaining &= !mask.bits();
        }
    }

    #[inline(always)]
    fn grow(&mut self, prim: u32, mask: M<S>, vectors: &[F3<S>; N]) {
        let (under, over) = (self.unset, F3::new(-self.unset.x, -self.unset.y, -self.unset.z));
        let mut at = 0;
        while at < self.count && self.prims[at] != prim {
            at += 1;
        }
        if at == self.count {
            if self.count == MOST_SHAPES {
                // The last entry collects all shapes that have no entry of their own, under no number.
                at = MOST_SHAPES - 1;
                self.prims[at] = NOTHING;
            } else {
                (self.prims[at], self.low[at], self.high[at]) = (prim, [under; N], [over; N]);
                self.count += 1;
            }
        }
        let (lows, highs) = (&mut self.low[at], &mut self.high[at]);
        for vector in 0..N {
            let (low, high) = (lows[vector], highs[vector]);
            let p = F3::select(mask, vectors[vector], under);
            let q = F3::select(mask, vectors[vector], over);
            lows[vector] = F3::new(low.x.min(p.x), low.y.min(p.y), low.z.min(p.z));
            highs[vector] = F3::new(high.x.max(q.x), high.y.max(q.y), high.z.max(q.z));
        }
    }

    /// How many shapes have a box.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// The boxes of a shape; [`NOTHING`] means several shapes together.
    #[inline(always)]
    pub(crate) fn get(&self, at: usize) -> (u32, [Aabb; N]) {
        let mut bounds = [Aabb::EMPTY; N];
        for (vector, bounds) in bounds.iter_mut().enumerate() {
            let (low, high) = (&self.low[at][vector], &self.high[at][vector]);
            *bounds = Aabb {
                min: DVec3::new(low.x.least(), low.y.least(), low.z.least()),
                max: DVec3::new(high.x.greatest(), high.y.greatest(), high.z.greatest()),
            };
        }
        (self.prims[at], bounds)
    }
}
