//! How a packet of rays is tested against one shape in `f32`: what is proposed, and what cannot be decided.
//!
//! A kernel may leave a lane undecided, never decide it wrongly: undecided lanes go to `f64`, one ray at a time.
//! A shape without a kernel leaves every lane undecided: slower, the same answer.

#[cfg(test)]
mod attack;
mod cuboid;
mod disk;
mod flat;
pub(crate) mod mesh;
mod plane;
mod rectangle;
mod sphere;
mod triangle;

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, Ray, Span, Triple};
use fearless_simd::Simd;

use crate::integrator::LIGHT_ITSELF;
use crate::lanes::{F, F3, M};
use crate::numeric::{CERTAIN, LEAST_REACH};

pub(crate) use cuboid::CuboidRow;
use disk::DiskOutline;
pub(crate) use flat::FlatRow;
pub(crate) use plane::PlaneRow;
use rectangle::RectangleOutline;
pub(crate) use sphere::SphereRow;
pub(crate) use triangle::TriangleRow;

/// Rays as kernels see them.
#[derive(Clone, Copy)]
pub(crate) struct Rays<S: Simd> {
    /// Origins, rounded.
    pub(crate) origin: F3<S>,
    /// Directions, of unit length to rounding (in a mesh's own space: of one length for all), rounded.
    pub(crate) direction: F3<S>,
    /// At least the sum of an origin's coordinates' magnitudes: what rounding errors grow with.
    pub(crate) reach: F<S>,
}

impl<S: Simd> Rays<S> {
    /// With origins that may be off by more.
    #[inline(always)]
    pub(crate) fn drifting(self, drift: F<S>) -> Self {
        Self { reach: self.reach + drift, ..self }
    }
}

/// What a kernel says of the nearest crossing ahead.
#[derive(Clone, Copy)]
pub(crate) struct Proposal<S: Simd> {
    /// Parameter of the crossing where `hit` holds.
    pub(crate) t: F<S>,
    /// Bound on the error of `t`.
    pub(crate) error: F<S>,
    /// Where there is a crossing ahead, for certain unless undecided.
    pub(crate) hit: M<S>,
    /// Where `f32` cannot say.
    pub(crate) undecided: M<S>,
}

/// What a kernel says of a stretch from a point to a light.
#[derive(Clone, Copy)]
pub(crate) struct Blocking<S: Simd> {
    /// Where the way is blocked, for certain unless undecided.
    pub(crate) blocked: M<S>,
    /// Where `f32` cannot say.
    pub(crate) undecided: M<S>,
}

/// A light as kernels see it: how far rays to it reach, and where it stands.
#[derive(Clone, Copy)]
pub(crate) struct Target<S: Simd> {
    /// Metres along each ray; infinite for a light at infinity.
    pub(crate) distance: F<S>,
    /// Its position, or the unit vector towards it when `at_infinity`.
    pub(crate) place: DVec3,
    /// The same in the snapshot's frame.
    pub(crate) in_frame: DVec3,
    /// Whether it stands at infinity.
    pub(crate) at_infinity: bool,
}

impl<S: Simd> Target<S> {
    /// The way from a point to the light, in the snapshot's frame.
    pub(crate) fn way_from(&self, point: DVec3) -> (Ray, Span) {
        if self.at_infinity {
            (Ray::new(point, self.in_frame), Span::AHEAD)
        } else {
            (Ray::new(point, self.in_frame - point), LIGHT_ITSELF)
        }
    }
}

impl<S: Simd> Proposal<S> {
    /// Whether a crossing lies between the origin and the target.
    #[inline(always)]
    pub(crate) fn blocking(&self, target: &Target<S>) -> Blocking<S> {
        let before = self.hit & (self.t + self.error).less(target.distance);
        let maybe = self.hit & (self.t - self.error).less(target.distance) & !before;
        Blocking { blocked: before, undecided: self.undecided | maybe }
    }
}

/// A bound on an error, unless `f32` is [trusted](CERTAIN): then it is 0, and not worked out.
#[inline(always)]
pub(crate) fn bound<S: Simd>(s: S, error: F<S>) -> F<S> {
    if CERTAIN { error } else { F::splat(s, 0.0) }
}

/// Sum of the magnitudes of the coordinates.
#[inline(always)]
pub(crate) fn magnitude<S: Simd>(v: F3<S>) -> F<S> {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// Sum of the magnitudes of the coordinates, rounded up, and at least [`LEAST_REACH`].
pub(crate) fn magnitude_of(v: DVec3) -> f32 {
    (v.abs().element_sum() as f32).next_up() + LEAST_REACH
}

/// Coordinates rounded to `f32`.
pub(crate) fn rounded(v: DVec3) -> [f32; 3] {
    v.to_array().map(|c| c as f32)
}

/// `a × b` with one product and one fused product a component.
#[inline(always)]
pub(crate) fn cross<L: Arithmetic>(a: Triple<L>, b: Triple<L>) -> Triple<L> {
    Triple::new(
        a.y.mul_add(b.z, -(a.z * b.y)),
        a.z.mul_add(b.x, -(a.x * b.z)),
        a.x.mul_add(b.y, -(a.y * b.x)),
    )
}
