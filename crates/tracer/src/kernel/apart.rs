//! Kernels that are compiled once rather than into everything that visits a kernel.
//!
//! Callers are compiled for every kind of packet and inline the kernels of shapes that most scenes are made of. For large
//! kernels of shapes that few scenes have, a call costs little and saves minutes of compiling.

use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use super::{Blocking, Crossing, Facet, Kernel, NearHit, Obstacle, Proposal, Rays, Target, Tried};
use crate::lanes::{D3, F, F3, M, U, outlined};

/// A kernel that is called, not inlined. Of each packet it proposes one crossing.
pub(crate) struct Apart<'a, K>(pub(crate) &'a K);

/// Hits whose numbers are at hand.
#[derive(Clone, Copy)]
struct Met<S: Simd> {
    point: F3<S>,
    near: D3<S>,
    direction: F3<S>,
    facets: (U<S>, M<S>),
}

impl<S: Simd> Met<S> {
    #[inline(always)]
    fn of(hit: &impl NearHit<S>) -> Self {
        Self { point: hit.point(), near: hit.near(), direction: hit.direction(), facets: hit.facets() }
    }
}

impl<S: Simd> NearHit<S> for Met<S> {
    #[inline(always)]
    fn point(&self) -> F3<S> {
        self.point
    }

    #[inline(always)]
    fn near(&self) -> D3<S> {
        self.near
    }

    #[inline(always)]
    fn direction(&self) -> F3<S> {
        self.direction
    }

    #[inline(always)]
    fn facets(&self) -> (U<S>, M<S>) {
        self.facets
    }
}

#[inline(never)]
fn proposed<S: Simd>(s: S, kernel: &impl Kernel, rays: &Rays<S>, tried: &Tried<S>) -> Crossing<S> {
    outlined(
        s,
        #[inline(always)]
        || {
            let (zero, none) = (F::splat(s, 0.0), M::splat(s, false));
            let proposal = Proposal { t: zero, error: zero, hit: none, undecided: none };
            let mut only = Crossing { proposal, facet: Facet::Same(0), lanes: none };
            kernel.propose(s, rays, tried, |crossing| only = crossing);
            only
        },
    )
}

#[inline(never)]
fn blocked<S: Simd>(
    s: S,
    kernel: &impl Kernel,
    rays: &Rays<S>,
    target: &Target<S>,
    tried: &Tried<S>,
) -> Obstacle<S> {
    outlined(
        s,
        #[inline(always)]
        || {
            let none = M::splat(s, false);
            let blocking = Blocking { blocked: none, undecided: none };
            let mut only = Obstacle { blocking, facet: None, lanes: none };
            kernel.block(s, rays, target, tried, |obstacle| only = obstacle);
            only
        },
    )
}

#[inline(never)]
fn surface<S: Simd>(s: S, kernel: &impl Kernel, hit: &Met<S>) -> (F3<S>, F3<S>) {
    outlined(
        s,
        #[inline(always)]
        || kernel.surface(s, hit),
    )
}

#[inline(never)]
fn off<S: Simd>(s: S, kernel: &impl Kernel, hit: &Met<S>) -> (F<S>, F<S>) {
    outlined(
        s,
        #[inline(always)]
        || kernel.off(s, hit),
    )
}

#[inline(never)]
fn normal<S: Simd>(s: S, kernel: &impl Kernel, hit: &Met<S>, point: &D3<S>) -> D3<S> {
    outlined(
        s,
        #[inline(always)]
        || kernel.normal(s, hit, *point),
    )
}

impl<K: Kernel> Kernel for Apart<'_, K> {
    type Face = K::Face;

    #[inline(always)]
    fn faces(&self) -> &[K::Face] {
        self.0.faces()
    }

    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        found(proposed(s, self.0, rays, tried));
    }

    #[inline(always)]
    fn block<S: Simd>(
        &self,
        s: S,
        rays: &Rays<S>,
        target: &Target<S>,
        tried: &Tried<S>,
        mut found: impl FnMut(Obstacle<S>),
    ) {
        found(blocked(s, self.0, rays, target, tried));
    }

    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        surface(s, self.0, &Met::of(hit))
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        off(s, self.0, &Met::of(hit))
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, hit: &impl NearHit<S>, point: D3<S>) -> D3<S> {
        normal(s, self.0, &Met::of(hit), &point)
    }

    fn all_normals(&self, center: DVec3, half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        self.0.all_normals(center, half, test)
    }

    fn is_outside(&self, point: DVec3) -> bool {
        self.0.is_outside(point)
    }
}
