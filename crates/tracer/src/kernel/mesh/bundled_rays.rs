//! One packet of a bundle of rays: where they are, and what they have met.

use catoptra_core::Lane;
use fearless_simd::Simd;
use fearless_simd::prelude::*;

use crate::lanes::{F, M, U};
use crate::numeric::BUNDLE_STEEP;

/// One packet of a bundle: the places of its rays, which are slopes where they pass through one point, and their nearest hits.
#[derive(Clone, Copy)]
pub(crate) struct BundledRays<S: Simd> {
    pub(crate) u: F<S>,
    pub(crate) v: F<S>,
    /// Box round the places.
    pub(crate) around: [[f32; 2]; 2],
    /// Depths between which the stretch begins.
    pub(crate) begin: [F<S>; 2],
    /// Depths between which the nearest crossing so far lies, or the end of the stretch.
    pub(crate) end: [F<S>; 2],
    /// Slot of the nearest triangle in the tree's blocks; [`u32::MAX`] for none.
    pub(crate) slot: U<S>,
    /// Triangle that each ray leaves from.
    pub(crate) leaving: U<S>,
    /// Depth per `t`.
    pub(crate) scale: F<S>,
    pub(crate) live: M<S>,
    /// How often a triangle was decided on in `f64`.
    pub(crate) decided: u64,
}

impl<S: Simd> BundledRays<S> {
    /// No rays.
    #[inline(always)]
    pub(crate) fn nothing(s: S) -> Self {
        let (zero, none) = (F::splat(s, 0.0), U::splat(s, u32::MAX));
        Self {
            u: zero,
            v: zero,
            around: [[0.0; 2]; 2],
            begin: [zero; 2],
            end: [zero; 2],
            slot: none,
            leaving: none,
            scale: zero,
            live: M::splat(s, false),
            decided: 0,
        }
    }

    /// Lines whose slopes are small enough: that run along the main axis, or at least not much more across it.
    #[inline(always)]
    pub(super) fn are_small(&self, s: S) -> M<S> {
        let most = F::splat(s, BUNDLE_STEEP);
        self.u.abs().less(most) & self.v.abs().less(most)
    }

    /// Error of the slopes where a point of each line is off by `off`.
    #[inline(always)]
    pub(crate) fn error_where_off(&self, s: S, off: F<S>) -> f32 {
        // Both coordinates across and the depth, times a slope below 2, count; a quotient and a sum are rounded.
        let most = off * F::splat(s, 3.5) / self.scale;
        F::pick(self.live, most, F::splat(s, 0.0)).0.reduce_max()
    }

    /// Begins a search: `begin` are depths between which the stretch begins, `end` is known within a bound, `leaving` are
    /// the triangles that the rays leave.
    #[inline(always)]
    pub(crate) fn start(&mut self, s: S, begin: [F<S>; 2], [end, error]: [F<S>; 2], leaving: U<S>) {
        self.begin = begin;
        self.end = [end - error, end + error];
        (self.leaving, self.slot, self.decided) = (leaving, U::splat(s, u32::MAX), 0);
    }

    /// Box round the places of the rays that are still followed, of which there are some.
    #[inline(always)]
    pub(super) fn around_live(&self, s: S) -> [[f32; 2]; 2] {
        let (most, least) = (F::splat(s, f32::INFINITY), F::splat(s, f32::NEG_INFINITY));
        let low = |places| F::pick(self.live, places, most).0.reduce_min();
        let high = |places| F::pick(self.live, places, least).0.reduce_max();
        [[low(self.u), low(self.v)], [high(self.u), high(self.v)]]
    }
}
