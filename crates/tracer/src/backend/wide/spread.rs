//! Between which coordinates the vectors of many lanes lie, shape by shape.

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Lane};
use fearless_simd::Simd;

use crate::film::NOTHING;
use crate::lanes::{F3, M, U, splat3};

/// Most shapes whose vectors are told apart; those of others are put together.
const APART: usize = 8;

/// Boxes round `N` vectors of every lane, shape by shape.
pub(super) struct Spread<S: Simd, const N: usize> {
    count: usize,
    prims: [u32; APART],
    low: [[F3<S>; N]; APART],
    high: [[F3<S>; N]; APART],
    tops: F3<S>,
}

impl<S: Simd, const N: usize> Spread<S, N> {
    #[inline(always)]
    pub(super) fn nothing(s: S) -> Self {
        let most = splat3(s, [f32::MAX; 3]);
        Self { count: 0, prims: [0; APART], low: [[most; N]; APART], high: [[most; N]; APART], tops: most }
    }

    /// Forgets all vectors.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds the lanes of a mask to the boxes of their shapes.
    #[inline(always)]
    pub(super) fn add(&mut self, lanes: M<S>, prims: U<S>, vectors: &[F3<S>; N]) {
        let mut left = lanes.bits();
        while left != 0 {
            let prim = prims.lane(left.trailing_zeros() as usize);
            let mask = lanes & prims.is(prim);
            self.grow(prim, mask, vectors);
            left &= !mask.bits();
        }
    }

    #[inline(always)]
    fn grow(&mut self, prim: u32, mask: M<S>, vectors: &[F3<S>; N]) {
        let (under, over) = (self.tops, F3::new(-self.tops.x, -self.tops.y, -self.tops.z));
        let mut at = 0;
        while at < self.count && self.prims[at] != prim {
            at += 1;
        }
        if at == self.count {
            if self.count == APART {
                // The last place takes in what has no place of its own, under no name.
                at = APART - 1;
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

    /// Of how many shapes there are boxes.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// The boxes of a shape; [`NOTHING`] stands for many.
    #[inline(always)]
    pub(super) fn get(&self, at: usize) -> (u32, [Aabb; N]) {
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

/// What is spread out while a batch is under way.
pub(super) struct Spreads<S: Simd> {
    /// Points that are seen.
    pub(super) seen: Spread<S, 1>,
    /// Where the rays of a stream start, and the unit vectors along which they run.
    pub(super) sent: Spread<S, 2>,
}

impl<S: Simd> Spreads<S> {
    #[inline(always)]
    pub(super) fn nothing(s: S) -> Self {
        Self { seen: Spread::nothing(s), sent: Spread::nothing(s) }
    }
}
