//! On which stretch of a line does it run inside a convex shape, as far as `f32` can tell?

use catoptra_core::Lane;
use fearless_simd::Simd;

use super::super::Rays;
use crate::lanes::{F, M, U};

/// Where lines run inside a convex shape. What lies behind the beginnings of rays is not reckoned with.
#[derive(Clone, Copy)]
pub(crate) struct Stretch<S: Simd> {
    /// Where they come in, and where they go out.
    pub(crate) ends: [End<S>; 2],
    /// Rays that certainly pass by, and lines that certainly run inside somewhere.
    pub(crate) misses: M<S>,
    pub(crate) crosses: M<S>,
}

/// One end of a stretch, in metres along the rays.
#[derive(Clone, Copy)]
pub(crate) struct End<S: Simd> {
    /// At least and at most; infinite where the shape has no end.
    pub(crate) least: F<S>,
    pub(crate) most: F<S>,
    /// The facet it lies on, and where that is certain.
    pub(crate) facet: U<S>,
    pub(crate) known: M<S>,
}

/// Which rays are inside a shape somewhere, and which are outside; neither where `f32` cannot tell. A bit for each.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides {
    pub(super) inside: u64,
    pub(super) outside: u64,
}

impl Sides {
    /// All rays are inside.
    pub(super) const ALL: Self = Self { inside: u64::MAX, outside: 0 };

    /// On the inner side of both.
    pub(super) fn and(self, other: Self) -> Self {
        Self { inside: self.inside & other.inside, outside: self.outside | other.outside }
    }

    /// With the inside for the outside.
    pub(super) fn not(self) -> Self {
        Self { inside: self.outside, outside: self.inside }
    }
}

impl<S: Simd> End<S> {
    /// Off by no more than an error.
    #[inline(always)]
    pub(crate) fn about(t: F<S>, error: F<S>, facet: U<S>, known: M<S>) -> Self {
        Self { least: t - error, most: t + error, facet, known }
    }

    /// Ahead of the rays' beginnings, for certain.
    #[inline(always)]
    pub(super) fn is_ahead(&self, s: S) -> M<S> {
        F::splat(s, 0.0).less(self.least) & self.most.less(F::splat(s, f32::INFINITY))
    }

    /// Behind the rays' beginnings, or nowhere, for certain.
    #[inline(always)]
    pub(super) fn is_not_ahead(&self, s: S) -> M<S> {
        self.most.less(F::splat(s, 0.0)) | F::splat(s, f32::MAX).less(self.least)
    }
}

impl<S: Simd> Stretch<S> {
    /// Between two ends; beyond the numbers of `f32` nothing is certain.
    #[inline(always)]
    pub(crate) fn between(s: S, rays: &Rays<S>, ends: [End<S>; 2]) -> Self {
        let [enters, leaves] = &ends;
        let held = rays.reach.less(F::splat(s, f32::INFINITY));
        let misses = leaves.most.less(enters.least) | leaves.most.less(F::splat(s, 0.0));
        let crosses = enters.most.less(leaves.least);
        Self { ends, misses: held & misses, crosses: held & crosses }
    }

    /// On which side of the shape rays are at a place.
    #[inline(always)]
    pub(super) fn sides(&self, at: &End<S>) -> Sides {
        let [enters, leaves] = &self.ends;
        let within = enters.most.less(at.least) & at.most.less(leaves.least);
        let beyond = at.most.less(enters.least) | leaves.most.less(at.least);
        Sides {
            inside: (self.crosses & within).bits(),
            outside: (self.misses | (self.crosses & beyond)).bits(),
        }
    }
}
