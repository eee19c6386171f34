//! Kernels: test a packet of rays against one shape in `f32`, and mark the lanes that `f32` cannot decide.
//!
//! A kernel may leave a lane undecided, never decide it wrongly: undecided lanes go to `f64`, one ray at a time.
//! A shape without a kernel leaves every lane undecided: slower, the same answer.

mod apart;
mod contract;
mod cuboid;
mod disk;
#[cfg(test)]
mod error_bounds_tests;
mod faces;
mod facets;
mod flat;
pub(crate) mod mesh;
mod plane;
mod rectangle;
mod round;
mod solid;
mod sphere;
mod torus;
mod triangle;

use catoptra_core::Lane;
use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use crate::lanes::{F, F3, M};
use crate::numeric::CERTAIN;

pub(crate) use apart::Apart;
pub(crate) use contract::{Crossing, Facet, Kernel, Leaving, NearHit, Obstacle, Tried};
pub(crate) use cuboid::CuboidRow;
use disk::DiskOutline;
pub(crate) use faces::Faces;
pub(crate) use facets::FacetsRow;
pub(crate) use flat::FlatRow;
pub(crate) use plane::PlaneRow;
use rectangle::RectangleOutline;
pub(crate) use round::RoundRow;
pub(crate) use solid::SolidRow;
pub(crate) use sphere::SphereRow;
pub(crate) use torus::TorusRow;
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

/// The nearest crossing ahead that a kernel proposes.
#[derive(Clone, Copy)]
pub(crate) struct Proposal<S: Simd> {
    /// Parameter of the crossing where `hit` holds.
    pub(crate) t: F<S>,
    /// Bound on the error of `t`.
    pub(crate) error: F<S>,
    /// Where there is a crossing ahead, for certain unless undecided.
    pub(crate) hit: M<S>,
    /// Where `f32` cannot decide.
    pub(crate) undecided: M<S>,
}

/// Whether a kernel finds a segment blocked.
#[derive(Clone, Copy)]
pub(crate) struct Blocking<S: Simd> {
    /// Where the segment is blocked, for certain unless undecided.
    pub(crate) blocked: M<S>,
    /// Where `f32` cannot decide.
    pub(crate) undecided: M<S>,
}

/// Where segments end, as kernels see it.
#[derive(Clone, Copy)]
pub(crate) struct Target<S: Simd> {
    /// Metres along each ray; infinite for unbounded segments.
    pub(crate) distance: F<S>,
    /// Where all of them end, if they are known to have a common end.
    pub(crate) end: Option<End>,
}

/// A common end of segments.
#[derive(Debug, Clone, Copy)]
pub(crate) enum End {
    /// A point.
    At(DVec3),
    /// Infinitely far in the direction of a unit vector.
    AtInfinity(DVec3),
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

/// A bound on an error, unless `f32` is [trusted](CERTAIN): then it is 0, and not computed.
#[inline(always)]
pub(crate) fn bound<S: Simd>(s: S, error: F<S>) -> F<S> {
    if CERTAIN { error } else { F::splat(s, 0.0) }
}
