//! What do the rays of a bundle have in common, and how are boxes and triangles seen along them?

use fearless_simd::{Simd, f32x8};

use super::LeafBlock;
use super::bundle::Bundle;
use super::bundled_rays::BundledRays;
use super::edges::Prepared;
use super::planes::Plane;
use crate::lanes::F;

/// A vector in each of eight lanes.
pub(super) type Eight3<S> = [f32x8<S>; 3];

/// What the rays of a bundle have in common: a point that all pass through, or their direction.
pub(crate) trait Common: Sized {
    /// Bounds of all rays that every block is tested with.
    type RayBounds;
    /// The plane of a triangle in `f64`.
    type PrecisePlane;

    /// How far the places of rays, and of a box round them, may be off.
    fn error(&self) -> f32;

    /// Eight boxes, of which lower and upper sides along each axis are given, as the rays see them.
    fn sides<S: Simd>(&self, s: S, bundle: &Bundle<Self>, rows: &[[f32x8<S>; 2]; 3]) -> Sides<S>;

    /// Those of a bundle.
    fn ray_bounds(&self, bundle: &Bundle<Self>) -> Self::RayBounds;

    /// A block as the rays see it, and which of a leaf's triangles in it they may meet, if any.
    fn prepare<S: Simd>(
        &self,
        s: S,
        bundle: &Bundle<Self>,
        leaf: &LeafBlock<'_>,
        ray_bounds: &Self::RayBounds,
    ) -> Option<(Prepared, u64)>;

    /// Depths at which rays cross a plane, and how far those may be off.
    fn depths<S: Simd>(s: S, rays: &BundledRays<S>, plane: &Plane) -> [F<S>; 2];

    /// The plane of a triangle.
    fn precise_plane(&self, bundle: &Bundle<Self>, corners: &[[f32; 3]; 3]) -> Self::PrecisePlane;

    /// A plane from `f64`.
    fn plane_of(&self, bundle: &Bundle<Self>, precise: &Self::PrecisePlane) -> Plane;

    /// A vector whose product with (u, v, 1) is negative where a ray crosses the first plane before the second, both ahead of it,
    /// and positive where it does so behind; and the error of that product. None where it is not known, as where any
    /// crossing will do.
    fn order(&self, _: &Bundle<Self>, _: [&Self::PrecisePlane; 2]) -> Option<([f32; 3], f32)> {
        None
    }
}

/// Eight boxes as the rays see them: between which places and depths they lie.
pub(crate) struct Sides<S: Simd> {
    pub(super) low: [f32x8<S>; 2],
    pub(super) high: [f32x8<S>; 2],
    pub(super) near: f32x8<S>,
    pub(super) away: f32x8<S>,
}
