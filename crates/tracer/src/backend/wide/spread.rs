//! Between which coordinates the vectors of many lanes lie, shape by shape.

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Lane};
use fearless_simd::Simd;

use crate::film::NOTHING;
use crate::lanes::{F3, M, U, splat3};

/// Most shapes whose vectors are told apart; those of others are put together.
const APART: usize = 8;

/// Boxes round vectors, shape by shape.
pub(super) struct Spread<S: Simd> {
    count: usize,
    prims: [u32; APART],
    low: [F3<S>; APART],
    high: [F3<S>; APART],
    tops: F3<S>,
}

impl<S: Simd> Spread<S> {
    #[inline(always)]
    pub(super) fn nothing(s: S) -> Self {
        let most = splat3(s, [f32::MAX; 3]);
        Self { count: 0, prims: [0; APART], low: [most; APART], high: [most; APART], tops: most }
    }

    /// Forgets all vectors.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds the lanes of a mask to the boxes of their shapes.
    #[inline(always)]
    pub(super) fn add(&mut self, lanes: M<S>, prims: U<S>, vectors: F3<S>) {
        let mut left = lanes.bits();
        while left != 0 {
            let prim = prims.lane(left.trailing_zeros() as usize);
            let mask = lanes & prims.is(prim);
            self.grow(prim, mask, vectors);
            left &= !mask.bits();
        }
    }

    #[inline(always)]
    fn grow(&mut self, prim: u32, mask: M<S>, vectors: F3<S>) {
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
                (self.prims[at], self.low[at], self.high[at]) = (prim, under, over);
                self.count += 1;
            }
        }
        let (low, high) = (&mut self.low[at], &mut self.high[at]);
        let (p, q) = (F3::select(mask, vectors, under), F3::select(mask, vectors, over));
        *low = F3::new(low.x.min(p.x), low.y.min(p.y), low.z.min(p.z));
        *high = F3::new(high.x.max(q.x), high.y.max(q.y), high.z.max(q.z));
    }

    /// The boxes with the shapes that they belong to; [`NOTHING`] for that of many.
    pub(super) fn boxes(&self) -> impl Iterator<Item = (u32, Aabb)> + '_ {
        (0..self.count).map(|at| {
            let (low, high) = (&self.low[at], &self.high[at]);
            let min = DVec3::new(low.x.least(), low.y.least(), low.z.least());
            let max = DVec3::new(high.x.greatest(), high.y.greatest(), high.z.greatest());
            (self.prims[at], Aabb { min, max })
        })
    }
}

/// What is spread out while a batch is under way.
pub(super) struct Spreads<S: Simd> {
    /// Points that are seen.
    pub(super) seen: Spread<S>,
    /// Where the rays of a stream start.
    pub(super) starts: Spread<S>,
    /// The unit vectors along which they run.
    pub(super) units: Spread<S>,
}

impl<S: Simd> Spreads<S> {
    #[inline(always)]
    pub(super) fn nothing(s: S) -> Self {
        Self { seen: Spread::nothing(s), starts: Spread::nothing(s), units: Spread::nothing(s) }
    }
}
