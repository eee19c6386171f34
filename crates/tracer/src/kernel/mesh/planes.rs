//! At which depths the rays of a bundle cross the planes of triangles.

use catoptra_core::{Arithmetic, Lane};
use fearless_simd::Simd;

use super::BundledRays;
use super::bundle::Bundle;
use super::common::Common;
use super::edges::Prepared;
use crate::kernel::bound;
use crate::lanes::{F, M};

/// The plane of a triangle, as [`Common::depths`] takes it.
#[derive(Clone, Copy)]
pub(crate) struct Plane {
    pub(super) normal: [f32; 3],
    pub(super) top: f32,
    /// What the error of a depth on the triangle grows with. Infinite where no depth is known.
    pub(super) errors: [f32; 2],
}

/// Bounds on where rays cross the plane of a triangle.
pub(super) struct Crossing<S: Simd> {
    /// Depths between which the crossings lie.
    pub(super) depth: [F<S>; 2],
    /// Lanes that cross for certain before their nearest hit so far and within their span.
    pub(super) nearer: M<S>,
    /// Lanes that cross for certain behind that hit or before their span.
    pub(super) beside: M<S>,
}

impl<S: Simd> BundledRays<S> {
    /// Scalar products of a vector and (u, v, 1).
    #[inline(always)]
    pub(super) fn value(&self, s: S, [x, y, z]: [f32; 3]) -> F<S> {
        let (x, y, z) = (F::splat(s, x), F::splat(s, y), F::splat(s, z));
        self.u.mul_add(x, self.v.mul_add(y, z))
    }

    /// Where rays that have something in common cross a plane.
    #[inline(always)]
    pub(super) fn cross<C: Common>(&self, s: S, _: &Bundle<C>, plane: &Plane) -> Crossing<S> {
        let [z, error] = C::depths(s, self, plane);
        let error = bound(s, error);
        let (low, high) = (z - error, z + error);
        let nearer = high.less(self.end[0]) & self.begin[1].less(low);
        let beside = self.end[1].less(low) | high.less(self.begin[0]);
        Crossing { depth: [low, high], nearer, beside }
    }
}

impl Prepared {
    #[inline(always)]
    pub(super) fn plane(&self, at: usize) -> Plane {
        let [x, y, z] = &self.normal;
        let [of_first, of_second] = &self.depth_errors;
        Plane { normal: [x[at], y[at], z[at]], top: self.top[at], errors: [of_first[at], of_second[at]] }
    }
}
