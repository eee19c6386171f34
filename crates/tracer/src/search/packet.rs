//! A packet of rays: one in every lane, in `f32` for kernels and in `f64` for what they leave undecided.

use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, Ray, Span};
use fearless_simd::Simd;

use crate::SurfaceId;
use crate::film::NOTHING;
use crate::kernel::{Leaving, Rays};
use crate::lanes::{D3, F, F3, M, magnitude};
use crate::numeric::WORLD_DRIFT;

/// The rays of packets in `f64`, as their source (camera, stream or caller) keeps them. They are read again where they
/// are needed, so that they take no registers elsewhere.
pub(crate) trait PreciseRays<S: Simd> {
    /// Whether directions are of unit length, up to rounding in `f32`.
    const UNIT: bool;

    /// Whether every ray is followed from its origin on.
    const FROM_ORIGIN: bool;

    /// A ray, in the snapshot's frame.
    fn ray(&self, at: usize) -> Ray;

    /// The span that a ray is followed on.
    fn span(&self, at: usize) -> Span;

    /// Origins, relative to the snapshot's, and directions of the packet that begins with ray `at`.
    fn precise(&self, s: S, at: usize) -> (D3<S>, D3<S>);

    /// Metres between which the spans of the packet that begins with ray `at` begin.
    #[inline(always)]
    fn begins(&self, s: S, _at: usize) -> [F<S>; 2] {
        [F::splat(s, 0.0); 2]
    }

    /// Where the spans of the packet that begins with ray `at` begin and end, relative to the snapshot's origin; not
    /// finite for unbounded ones.
    fn ends(&self, s: S, at: usize) -> [D3<S>; 2];
}

/// One ray in every lane.
pub(crate) struct Packet<'a, S: Simd, P> {
    /// The rays in `f64`, of which this packet begins with ray `at`.
    pub(crate) precise: &'a P,
    pub(crate) at: usize,
    /// The same rays as kernels see them.
    pub(crate) rays: Rays<S>,
    /// 1 over the length of each direction.
    pub(crate) inverse_length: F<S>,
    /// Which surfaces the rays leave.
    pub(crate) leaving: Leaving<S>,
    /// Lanes that are rays at all.
    pub(crate) live: M<S>,
}

impl<S: Simd, P> Clone for Packet<'_, S, P> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Simd, P> Copy for Packet<'_, S, P> {}

impl<S: Simd, P: PreciseRays<S>> Packet<'_, S, P> {
    /// The ray of a lane, in the snapshot's frame.
    #[inline]
    pub(crate) fn ray(&self, lane: usize) -> Ray {
        self.precise.ray(self.at + lane)
    }

    /// The span that the ray of a lane is followed on.
    #[inline]
    pub(crate) fn span(&self, lane: usize) -> Span {
        self.precise.span(self.at + lane)
    }

    /// Ray, span and the surface that the ray of a lane leaves.
    pub(crate) fn segment(&self, lane: usize) -> (Ray, Span, Option<SurfaceId>) {
        (self.ray(lane), self.span(lane), self.leaving.lane(lane))
    }

    /// Points at distances `t`.
    #[inline(always)]
    pub(crate) fn point(&self, t: F<S>) -> F3<S> {
        self.rays.direction.scale_add(t, self.rays.origin)
    }

    /// Origins, relative to the snapshot's, and directions of unit length, up to rounding in `f32`.
    #[inline(always)]
    pub(crate) fn precise_unit(&self, s: S) -> (D3<S>, D3<S>) {
        let (origin, direction) = self.precise(s);
        let direction = if P::UNIT { direction } else { direction.scale(self.inverse_length.widen()) };
        (origin, direction)
    }

    /// Origins, relative to the snapshot's, and directions of any length.
    #[inline(always)]
    pub(crate) fn precise(&self, s: S) -> (D3<S>, D3<S>) {
        self.precise.precise(s, self.at)
    }

    /// Metres between which the spans begin.
    #[inline(always)]
    pub(crate) fn begins(&self, s: S) -> [F<S>; 2] {
        self.precise.begins(s, self.at)
    }
}

impl<S: Simd> Leaving<S> {
    /// The surface that the ray of a lane leaves.
    pub(crate) fn lane(&self, lane: usize) -> Option<SurfaceId> {
        let prim = self.prim.lane(lane);
        (prim != NOTHING).then(|| SurfaceId { prim, facet: self.facet.lane(lane) })
    }
}

/// Rays as kernels see them, and 1 over the length of each direction.
#[inline(always)]
pub(crate) fn kernel_rays<S: Simd>(s: S, origin: F3<S>, direction: F3<S>) -> (Rays<S>, F<S>) {
    let inverse_length = F::splat(s, 1.0) / direction.dot(direction).sqrt();
    let rays = Rays { origin, direction: direction.scale(inverse_length), reach: magnitude(origin) };
    (rays, inverse_length)
}

/// As [`kernel_rays`] of directions whose lengths differ from 1 by no more than 2⁻¹³: a Newton step from 1 brings 1 over
/// their roots there.
#[inline(always)]
pub(crate) fn nearly_unit_rays<S: Simd>(s: S, origin: F3<S>, direction: F3<S>) -> (Rays<S>, F<S>) {
    let half = F::splat(s, -0.5) * direction.dot(direction);
    let inverse_length = half + F::splat(s, 1.5);
    let rays = Rays { origin, direction: direction.scale(inverse_length), reach: magnitude(origin) };
    (rays, inverse_length)
}

/// What to add to a reach where coordinates are relative to an origin other than the frame's: there they are rounded more
/// coarsely.
#[inline]
pub(crate) fn drift(origin: DVec3) -> f32 {
    origin.abs().element_sum() as f32 * WORLD_DRIFT
}
