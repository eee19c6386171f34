//! Which shapes there are, and what a shape must answer.
//!
//! A new shape is one file here, its `mod` line and its name in the list below.

mod cuboid;
mod disk;
mod mesh;
mod plane;
mod rectangle;
mod sphere;
mod tetrahedron;
mod triangle;
mod triangle_mesh;

pub use cuboid::Cuboid;
pub use disk::Disk;
pub use mesh::Mesh;
pub use plane::Plane;
pub use rectangle::Rectangle;
pub use sphere::Sphere;
pub use tetrahedron::Tetrahedron;
pub use triangle::{Triangle, cross_triangle};
pub use triangle_mesh::TriangleMesh;

use crate::{Aabb, Crossing, Placement, Ray, Span};

/// What the tracer and the editor ask of a shape, in `f64`.
pub trait Geometry {
    /// The nearest crossing on `span`, or `None`. A ray that is not [valid](Ray::is_valid) crosses nothing; one
    /// that runs within a flat surface does not cross it.
    ///
    /// `leaving` names the facet that the ray's origin lies on, if it leaves from this very shape: that meeting
    /// (t ≈ 0) is not found again, while the far side of a curved shape is.
    fn cross(&self, ray: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing>;

    /// An axis-aligned box round it, `None` where it has no end: the smallest to rounding, except round a turned
    /// [`Mesh`], where it is the box of its turned box, so that no triangle need be looked at.
    fn bounds(&self) -> Option<Aabb>;

    /// The same shape standing elsewhere.
    #[must_use]
    fn placed(&self, placement: &Placement) -> Self
    where
        Self: Sized;

    /// Whether it encloses a volume: a ray from outside that enters it leaves it again.
    fn is_closed(&self) -> bool;
}

crate::part::parts! {
    $ each_shape
    /// A shape, in its own space until it is [placed](Shape::placed).
    pub enum Shape {
        /// Infinite plane.
        Plane,
        /// Sphere.
        Sphere,
        /// Flat triangle.
        Triangle,
        /// Four-cornered solid.
        Tetrahedron,
        /// Flat rectangle.
        Rectangle,
        /// Flat disk.
        Disk,
        /// Box with six faces.
        Cuboid,
        /// Triangle mesh from a file.
        Mesh,
    }
}

impl Shape {
    /// See [`Geometry::cross`].
    #[must_use]
    pub fn cross(&self, ray: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing> {
        each_shape!(self, shape => shape.cross(ray, span, leaving))
    }

    /// See [`Geometry::bounds`].
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        each_shape!(self, shape => shape.bounds())
    }

    /// See [`Geometry::placed`].
    #[must_use]
    pub fn placed(&self, placement: &Placement) -> Self {
        each_shape!(self, shape => shape.placed(placement).into())
    }

    /// See [`Geometry::is_closed`].
    #[must_use]
    pub fn is_closed(&self) -> bool {
        each_shape!(self, shape => shape.is_closed())
    }
}
