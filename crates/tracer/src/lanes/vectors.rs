//! Three numbers in every lane: points, directions, colours.

use std::ops::{Deref, DerefMut};

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, Triple};
use fearless_simd::prelude::*;

use super::{D, F, M, MOST_LANES};

/// Points, directions or colours in every lane.
pub(crate) type F3<S> = Triple<F<S>>;

/// Points or directions in every lane, in `f64`.
pub(crate) type D3<S> = Triple<D<S>>;

/// The same vector in every lane.
#[inline(always)]
pub(crate) fn splat3<S: Simd>(s: S, v: [f32; 3]) -> F3<S> {
    Triple::new(F::splat(s, v[0]), F::splat(s, v[1]), F::splat(s, v[2]))
}

/// The same vector in every lane, in `f64`.
#[inline(always)]
pub(crate) fn splat_wide<S: Simd>(s: S, v: DVec3) -> D3<S> {
    Triple::new(D::splat(s, v.x), D::splat(s, v.y), D::splat(s, v.z))
}

/// A packet's lanes of three columns, from index `at` on.
#[inline(always)]
pub(crate) fn load3<S: Simd>(s: S, [x, y, z]: &[impl Deref<Target = [f32]>; 3], at: usize) -> F3<S> {
    Triple::new(F::load(s, &x[at..]), F::load(s, &y[at..]), F::load(s, &z[at..]))
}

/// A packet's lanes of three columns, from index `at` on, in `f64`.
#[inline(always)]
pub(crate) fn load_wide3<S: Simd>(s: S, [x, y, z]: &[impl Deref<Target = [f64]>; 3], at: usize) -> D3<S> {
    Triple::new(D::load(s, &x[at..]), D::load(s, &y[at..]), D::load(s, &z[at..]))
}

/// Writes a packet's lanes into three columns, from index `at` on.
#[inline(always)]
pub(crate) fn store3<S: Simd>(v: F3<S>, [x, y, z]: &mut [impl DerefMut<Target = [f32]>; 3], at: usize) {
    v.x.store(&mut x[at..]);
    v.y.store(&mut y[at..]);
    v.z.store(&mut z[at..]);
}

/// Writes a packet's lanes into three columns, from index `at` on, in `f64`.
#[inline(always)]
pub(crate) fn store_wide3<S: Simd>(v: D3<S>, [x, y, z]: &mut [impl DerefMut<Target = [f64]>; 3], at: usize) {
    v.x.store(&mut x[at..]);
    v.y.store(&mut y[at..]);
    v.z.store(&mut z[at..]);
}

/// The lanes where the mask holds one after another, and anything after them.
#[inline(always)]
pub(crate) fn compress3<S: Simd>(v: F3<S>, mask: M<S>) -> F3<S> {
    Triple::new(v.x.compressed(mask), v.y.compressed(mask), v.z.compressed(mask))
}

/// Writes the lanes where the mask holds one after another into three columns, from index `at` on, and anything after
/// them, up to all lanes.
#[inline(always)]
pub(crate) fn compress_wide3<S: Simd>(
    v: D3<S>,
    mask: M<S>,
    [x, y, z]: &mut [impl DerefMut<Target = [f64]>; 3],
    at: usize,
) {
    v.x.compress(mask, &mut x[at..]);
    v.y.compress(mask, &mut y[at..]);
    v.z.compress(mask, &mut z[at..]);
}

/// Vectors of a packet that are found lane by lane.
#[derive(Default)]
pub(crate) struct LaneVectors([[f64; MOST_LANES]; 3]);

impl LaneVectors {
    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: DVec3) {
        for (column, v) in self.0.iter_mut().zip(v.to_array()) {
            column[lane % MOST_LANES] = v;
        }
    }

    /// Those of all lanes; zero where none was set.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, s: S) -> D3<S> {
        let [x, y, z] = &self.0;
        Triple::new(D::load(s, x), D::load(s, y), D::load(s, z))
    }
}

/// The vector of one lane.
#[inline(always)]
pub(crate) fn vector_of<S: Simd>(v: &D3<S>, lane: usize) -> DVec3 {
    DVec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane))
}

/// In `f64`, exactly.
#[inline(always)]
pub(crate) fn widen3<S: Simd>(v: F3<S>) -> D3<S> {
    Triple::new(v.x.widen(), v.y.widen(), v.z.widen())
}

/// The vector over its length: an `f32` estimate and one Newton step in `f64`.
#[inline(always)]
pub(crate) fn unit<S: Simd>(s: S, v: D3<S>) -> D3<S> {
    // Scaled by its largest coordinate first, so that tiny triangles do not underflow in `f32`.
    let largest = v.x.abs().max(v.y.abs()).max(v.z.abs());
    let v = v.scale(D::splat(s, 1.0) / largest);
    let length2 = v.dot(v);
    let estimate = (F::splat(s, 1.0) / length2.narrow().sqrt()).widen();
    let half = D::splat(s, 0.5) * length2;
    let inverse = estimate * (-(half * estimate)).mul_add(estimate, D::splat(s, 1.5));
    v.scale(inverse)
}

/// Sum of the magnitudes of the coordinates.
#[inline(always)]
pub(crate) fn magnitude<S: Simd>(v: F3<S>) -> F<S> {
    v.x.abs() + v.y.abs() + v.z.abs()
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
