//! Which shapes there are, and what a shape must answer.
//!
//! A new shape is one file here, its `mod` line and its name in the list below.

mod capsule;
mod cone;
mod coplanar;
mod crossings;
mod cuboid;
mod cylinder;
mod derived;
mod disk;
mod doubles;
mod ears;
mod faceted;
mod faceted_geometry;
mod half_spaces;
mod heightfield;
mod hull;
mod lateral;
mod line_tree;
mod mesh;
mod parametrization;
mod plane;
mod platonic;
mod polyhedron;
mod prism;
mod rectangle;
mod sphere;
mod subdivision;
mod tangents;
mod tetrahedron;
mod torus;
mod triangle;
mod triangle_mesh;
mod watertight;

use std::cmp::Ordering;

pub use capsule::Capsule;
pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use disk::Disk;
pub use faceted::Faceted;
pub use heightfield::Heightfield;
pub use mesh::Mesh;
pub use parametrization::Parametrization;
pub use plane::Plane;
pub use platonic::Platonic;
pub use polyhedron::Polyhedron;
pub use prism::Prism;
pub use rectangle::Rectangle;
pub use sphere::Sphere;
pub use tetrahedron::Tetrahedron;
pub use torus::Torus;
pub use triangle::{Triangle, unit_normal};
pub use triangle_mesh::TriangleMesh;
pub use watertight::OpenEdge;

use crate::exact::{Bounded, Dyadic, Located, Number, Root, Verdict, decide};
use crate::solid::Passage;
use crate::{Aabb, Crossing, Placement, Ray, Rgb, Span};
use glam::{DVec2, DVec3};

/// What the tracer and the editor ask of a shape.
///
/// A shape says where a ray meets it once, in [`nearest_root`](Self::nearest_root), over any kind of number;
/// [`cross`](Self::cross) computes that first in `f64` with bounds, then, where those do not decide, exactly. So hit or
/// miss, and which crossing comes first, is the answer of exact arithmetic on the shape's numbers and those of
/// [`own_ray`](Self::own_ray).
pub trait Geometry {
    /// How many pieces it is made of that are met one by one, each a facet of that number: the triangles of a mesh. 1 for
    /// a shape that is met as a whole.
    fn pieces(&self) -> u32 {
        1
    }

    /// A ray of the world in the space that the shape's numbers are given in; `t` stays what it is.
    fn own_ray(&self, ray: &Ray) -> Ray {
        *ray
    }

    /// The nearest crossing of a [valid](Ray::is_valid) ray in the shape's own space with one piece. `leaving` as in
    /// [`cross`](Self::cross).
    ///
    /// # Errors
    /// When such numbers cannot decide.
    fn nearest_root<N: Number>(
        &self,
        piece: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>>;

    /// Normals and texture coordinates where a ray in the shape's own space meets a facet; `None` without a normal.
    fn crossing(&self, own: &Ray, at: Located, facet: u32) -> Option<Crossing>;

    /// The nearest crossing with one piece of a ray in the shape's own space.
    fn cross_piece(&self, piece: u32, own: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing> {
        let (at, facet) = self.locate_piece(piece, own, span, leaving)?;
        self.crossing(own, at, facet)
    }

    /// The same without how it looks there: where it is met, and on which facet.
    fn locate_piece(
        &self,
        piece: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Option<(Located, u32)> {
        if !own.is_valid() {
            return None;
        }
        decide(
            || self.nearest_root::<Bounded>(piece, own, span, leaving).map(located),
            || self.nearest_root::<Dyadic>(piece, own, span, leaving).map(located),
        )
    }

    /// The root behind a crossing that [`cross_piece`](Self::cross_piece) has found on a facet.
    ///
    /// # Errors
    /// When such numbers cannot decide whether there is one.
    fn root<N: Number>(
        &self,
        facet: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<Root<N>>> {
        let piece = if self.pieces() > 1 { facet } else { 0 };
        Ok(self.nearest_root(piece, own, span, leaving)?.map(|found| found.root))
    }

    /// How the positions of two crossings that [`cross_piece`](Self::cross_piece) has found compare.
    fn order(&self, own: &Ray, span: Span, leaving: Option<u32>, [a, b]: [&Crossing; 2]) -> Ordering {
        let together = || {
            let mesh = self.as_mesh();
            mesh.is_some_and(|mesh| mesh.meets_together(a.facet, (mesh, b.facet), own))
        };
        a.order(
            b,
            together,
            || [a, b].map(|crossing| self.root(crossing.facet, own, span, leaving)),
            || [a, b].map(|crossing| self.root(crossing.facet, own, span, leaving)),
        )
    }

    /// The nearest crossing on `span`, or `None`; of crossings in one place, that of the lowest piece. A ray that is not
    /// [valid](Ray::is_valid) crosses nothing; one that runs within a flat surface does not cross it.
    ///
    /// `leaving` names the facet that the ray's origin lies on, if it leaves from this very shape: that meeting
    /// (t ≈ 0) is not found again, nor are triangles of the same mesh in the same plane, while the far side of a solid is. A ray
    /// that leaves a convex solid outwards does not meet it again, whatever rounding has made of its origin.
    fn cross(&self, ray: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing> {
        let own = self.own_ray(ray);
        let mut best: Option<Crossing> = None;
        for piece in 0..self.pieces() {
            let within = Span { max: best.map_or(span.max, |b| b.latest().min(span.max)), ..span };
            let Some(next) = self.cross_piece(piece, &own, within, leaving) else { continue };
            if best.is_none_or(|b| self.order(&own, span, leaving, [&next, &b]).is_lt()) {
                best = Some(next);
            }
        }
        best
    }

    /// An axis-aligned box round it, `None` if it is unbounded: the smallest to rounding, except round a turned
    /// [`Mesh`], where it is the box of its turned box, so that no triangle need be looked at.
    fn bounds(&self) -> Option<Aabb>;

    /// The same shape, placed elsewhere.
    #[must_use]
    fn placed(&self, placement: &Placement) -> Self
    where
        Self: Sized;

    /// Texture coordinates at a point of a facet, in the space that the shape stands in. Of what has been placed they stay
    /// what they are, but for planes, disks, spheres and what is round about an axis, which do not remember how they were
    /// turned: ask those in their own space.
    ///
    /// | shape | u | v |
    /// |---|---|---|
    /// | plane | metres to the right (along x where it lies flat) | metres upwards (along −z) |
    /// | rectangle | share of `edge-u` | share of `edge-v` |
    /// | box | share of the face to the right, as seen from outside | upwards; of top and bottom towards −z and +z |
    /// | sphere | longitude, 1/2 at +z, growing to +x | latitude, 0 at −y, 1 at +y |
    /// | disk | angle counterclockwise from the right, 0..1 | distance from the middle, 0..1 |
    /// | cylinder, cone | angle about the axis, counterclockwise as seen from `to`, 0..1 | share of the axis |
    /// | their caps | as of a disk | |
    /// | capsule | angle about the axis, as of a cylinder | share of the way from tip to tip along the surface |
    /// | torus | angle about the axis, as of a cylinder | angle round the tube, 0 and 1 inside the ring, growing along the axis outside |
    /// | polyhedron, platonic, caps of a prism | share of the face to the right, as seen from outside before it was placed | upwards |
    /// | sides of a prism | share of the edge | share of the height |
    /// | triangle, face of a tetrahedron | weight of the second corner | weight of the third |
    /// | mesh | its own, else as of a triangle | |
    /// | heightfield | share of the picture to the right | upwards |
    fn parametrization(&self, point: DVec3, facet: u32) -> Parametrization;

    /// Texture coordinates at a point of a facet, and the derivative of the point by u, in metres.
    fn uv_and_tangent(&self, point: DVec3, facet: u32) -> (DVec2, DVec3) {
        let found = self.parametrization(point, facet);
        (found.uv, found.along_u)
    }

    /// The colour that a facet has of its own at a point, linear Rec. 709, as the corners of a mesh may have; `None` where
    /// there is none. Point and space as for [`parametrization`](Self::parametrization).
    fn color_at(&self, _point: DVec3, _facet: u32) -> Option<Rgb> {
        None
    }

    /// Which way normal maps and brushed metal lie at a point of a facet: where texture coordinates u and v grow, smoothly from
    /// facet to facet, in place of how they run on the facet itself. `None` where that is smooth. Point and space as for
    /// [`parametrization`](Self::parametrization).
    fn tangents(&self, _point: DVec3, _facet: u32) -> Option<[DVec3; 2]> {
        None
    }

    /// Whether it encloses a volume: a ray from outside that enters it leaves it again.
    fn is_closed(&self) -> bool;

    /// Whether it says where a line runs inside it, so that a [`Solid`](crate::Solid) can be made of it.
    fn is_solid(&self) -> bool {
        false
    }

    /// Where the line of a [valid](Ray::is_valid) ray in the shape's own space runs inside; asked only of what
    /// [is solid](Self::is_solid). With `leaving` a ray that leaves a facet of this very shape: what lies behind its origin is
    /// left out then.
    ///
    /// As it stands it is right for convex shapes. What the line runs along, a face or an edge, counts as inside.
    ///
    /// # Errors
    /// When such numbers cannot decide.
    fn passage<N: Number>(&self, own: &Ray, leaving: Option<u32>) -> Verdict<Passage<N>>
    where
        Self: Sized,
    {
        crate::solid::convex(self, own, leaving)
    }

    /// The mesh that it is, for what is made of many triangles: those of a file or a picture.
    fn as_mesh(&self) -> Option<&Mesh> {
        None
    }

    /// Corners and facets of a solid that has them in a list.
    fn faceted(&self) -> Option<&Faceted> {
        None
    }
}

/// Where a ray meets a facet of a shape.
#[derive(Debug, Clone)]
pub struct FacetRoot<N> {
    /// Where on the ray, as an equation's root.
    pub root: Root<N>,
    /// Where on the ray, in `f64`.
    pub at: Located,
    /// Which flat piece of the shape; see [`Crossing::facet`].
    pub facet: u32,
}

impl<N: Number> FacetRoot<N> {
    /// Where a root lies on the stretch.
    ///
    /// # Errors
    /// When such numbers cannot decide.
    pub(crate) fn on(span: Span, root: Root<N>, facet: u32) -> Verdict<Option<Self>> {
        Ok(N::locate(&root, span)?.map(|at| Self { root, at, facet }))
    }
}

fn located<N>(root: Option<FacetRoot<N>>) -> Option<(Located, u32)> {
    root.map(|root| (root.at, root.facet))
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
        /// Round cylinder.
        Cylinder,
        /// Round cone.
        Cone,
        /// Cylinder with rounded ends.
        Capsule,
        /// Convex solid with flat faces.
        Polyhedron,
        /// Regular solid.
        Platonic,
        /// Straight solid over an outline.
        Prism,
        /// Ground with heights from a picture.
        Heightfield,
        /// Ring.
        Torus,
    }
}

impl Shape {
    /// See [`Geometry::cross`].
    #[must_use]
    pub fn cross(&self, ray: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing> {
        each_shape!(self, shape => shape.cross(ray, span, leaving))
    }

    /// As [`cross`](Self::cross) for the piece alone that a facet belongs to: that facet, where the shape is made of
    /// them.
    #[must_use]
    pub fn cross_part(&self, facet: u32, ray: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing> {
        each_shape!(self, shape => {
            let piece = if shape.pieces() > 1 { facet } else { 0 };
            shape.cross_piece(piece, &shape.own_ray(ray), span, leaving)
        })
    }

    /// Normals and texture coordinates where a ray is known to meet a facet at `t`; `None` without a normal.
    #[must_use]
    pub fn crossing(&self, ray: &Ray, t: f64, facet: u32) -> Option<Crossing> {
        self.crossing_at(ray, Located { t, error: f64::INFINITY }, facet)
    }

    pub(crate) fn crossing_at(&self, ray: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        each_shape!(self, shape => shape.crossing(&shape.own_ray(ray), at, facet))
    }

    /// The root behind a crossing that [`cross`](Self::cross) has found on a facet.
    ///
    /// # Errors
    /// When such numbers cannot decide whether there is one.
    pub fn root<N: Number>(
        &self,
        facet: u32,
        ray: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<Root<N>>> {
        each_shape!(self, shape => shape.root(facet, &shape.own_ray(ray), span, leaving))
    }

    /// See [`Geometry::parametrization`].
    #[must_use]
    pub fn parametrization(&self, point: DVec3, facet: u32) -> Parametrization {
        each_shape!(self, shape => shape.parametrization(point, facet))
    }

    /// See [`Geometry::uv_and_tangent`].
    #[must_use]
    pub fn uv_and_tangent(&self, point: DVec3, facet: u32) -> (DVec2, DVec3) {
        each_shape!(self, shape => shape.uv_and_tangent(point, facet))
    }

    /// See [`Geometry::color_at`].
    #[must_use]
    pub fn color_at(&self, point: DVec3, facet: u32) -> Option<Rgb> {
        each_shape!(self, shape => shape.color_at(point, facet))
    }

    /// See [`Geometry::tangents`].
    #[must_use]
    pub fn tangents(&self, point: DVec3, facet: u32) -> Option<[DVec3; 2]> {
        each_shape!(self, shape => shape.tangents(point, facet))
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

    /// See [`Geometry::pieces`].
    #[must_use]
    pub fn pieces(&self) -> u32 {
        each_shape!(self, shape => shape.pieces())
    }

    /// See [`Geometry::is_closed`].
    #[must_use]
    pub fn is_closed(&self) -> bool {
        each_shape!(self, shape => shape.is_closed())
    }

    /// See [`Geometry::is_solid`].
    #[must_use]
    pub fn is_solid(&self) -> bool {
        each_shape!(self, shape => shape.is_solid())
    }

    /// See [`Geometry::passage`]; of a ray in the space that the shape stands in.
    ///
    /// # Errors
    /// When such numbers cannot decide.
    pub fn passage<N: Number>(&self, ray: &Ray, leaving: Option<u32>) -> Verdict<Passage<N>> {
        each_shape!(self, shape => shape.passage(&shape.own_ray(ray), leaving))
    }

    /// See [`Geometry::as_mesh`].
    #[must_use]
    pub fn as_mesh(&self) -> Option<&Mesh> {
        each_shape!(self, shape => shape.as_mesh())
    }

    /// See [`Geometry::faceted`].
    #[must_use]
    pub fn faceted(&self) -> Option<&Faceted> {
        each_shape!(self, shape => shape.faceted())
    }
}
