//! What shines: the outlines of constant radiance that have a contour.

use glam::DVec3;

use crate::Shape;

/// A surface that shines alike everywhere and in all directions.
#[derive(Debug, Clone, PartialEq)]
pub struct Lamp {
    pub(crate) outline: Outline,
    pub(super) two_sided: bool,
}

/// The outline of a lamp.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Outline {
    /// Convex and flat.
    Polygon(Flat),
    /// Flat and round.
    Disk(Round),
    /// Shines outwards.
    Sphere { center: DVec3, radius: f64 },
}

/// A flat convex polygon with three or four corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Flat {
    corners: [DVec3; 4],
    count: usize,
    /// Unit normal; the corners run counter-clockwise as seen from where it points to.
    pub normal: DVec3,
}

impl Flat {
    /// `None` for a polygon without area.
    pub(super) fn new(corners: &[DVec3]) -> Option<Self> {
        let (&[a, b, c], rest) = corners.split_first_chunk()?;
        let last = *rest.first().unwrap_or(&c);
        // Of a quadrilateral the diagonals, so that each corner has its say.
        let area = if rest.is_empty() { (b - a).cross(c - a) } else { (c - a).cross(last - b) };
        Some(Self { corners: [a, b, c, last], count: 3 + rest.len().min(1), normal: unit(area)? })
    }

    #[inline]
    pub(crate) fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    #[inline]
    pub(super) fn face(&self) -> Face<'_> {
        Face { corners: self.corners(), normal: self.normal }
    }
}

/// A flat convex polygon with any number of corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face<'a> {
    /// Counter-clockwise as seen from where the normal points to.
    pub corners: &'a [DVec3],
    /// Of unit length.
    pub normal: DVec3,
}

/// The direction of a vector of almost any length; `None` for zero and what is not finite.
pub(super) fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() { Some((v / largest).normalize()) } else { None }
}

/// A flat disk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Round {
    pub center: DVec3,
    /// Unit normal.
    pub normal: DVec3,
    pub radius: f64,
}

impl Lamp {
    fn one_sided(outline: Outline) -> Self {
        Self { outline, two_sided: false }
    }

    /// A flat convex polygon with three or four corners, counter-clockwise as seen from the lit side. `None` for another
    /// number of corners or no area.
    #[must_use]
    pub fn polygon(corners: &[DVec3]) -> Option<Self> {
        if corners.len() > 4 {
            return None;
        }
        Flat::new(corners).map(|flat| Self::one_sided(Outline::Polygon(flat)))
    }

    /// A disk that is lit on the side its normal (of any length) points to. `None` without a normal or a positive radius.
    #[must_use]
    pub fn disk(center: DVec3, normal: DVec3, radius: f64) -> Option<Self> {
        let normal = unit(normal)?;
        (radius > 0.0).then(|| Self::one_sided(Outline::Disk(Round { center, normal, radius })))
    }

    /// A sphere that shines outwards. `None` without a positive radius.
    #[must_use]
    pub fn sphere(center: DVec3, radius: f64) -> Option<Self> {
        (radius > 0.0).then(|| Self::one_sided(Outline::Sphere { center, radius }))
    }

    /// The same lamp, lit on both sides or on one. Makes no difference to a sphere.
    #[must_use]
    pub fn with_two_sides(self, two_sided: bool) -> Self {
        Self { two_sided, ..self }
    }

    /// What a shape is made of as lamps: the faces of a solid with flat faces, lit outwards, cut into triangles where they have
    /// more than four corners; the triangles of a mesh; or the whole of a flat shape or a sphere, lit where its normal points
    /// to. None of a plane, and of shapes whose outlines have no closed form as lamps: what is round about an axis.
    pub fn pieces_of(shape: &Shape) -> impl Iterator<Item = Self> {
        let of_solid = shape.faceted().into_iter().flat_map(|solid| {
            (0..solid.count()).flat_map(move |facet| match solid.outline(facet) {
                outline @ [_, _, _, _] => {
                    let corners: Vec<DVec3> = outline.iter().map(|&i| solid.corners()[i as usize]).collect();
                    Self::polygon(&corners).into_iter().collect()
                }
                _ => solid.triangles(facet).filter_map(|face| Self::polygon(&face)).collect::<Vec<_>>(),
            })
        });
        of_solid.chain((0..Self::facets(shape)).filter_map(|facet| Self::of(shape, facet)))
    }

    /// A facet of a shape as a lamp: a face of a box or tetrahedron, lit outwards, a triangle of a mesh, or the whole of any
    /// other shape as facet 0, lit where its normal points to. `None` for a plane, a facet that the shape does not have, one
    /// without area, and shapes of which [`pieces_of`](Self::pieces_of) tells more.
    #[must_use]
    pub fn of(shape: &Shape, facet: u32) -> Option<Self> {
        if let Some(mesh) = shape.as_mesh() {
            let exists = (facet as usize) < mesh.triangles().triangles().len();
            let corners = || mesh.triangles().corners(facet).map(|p| mesh.placement().point(p));
            return if exists { Self::polygon(&corners()) } else { None };
        }
        match shape {
            Shape::Cuboid(_) => super::blocker::box_face(shape, facet).and_then(|face| Self::polygon(&face)),
            Shape::Tetrahedron(solid) if facet < 4 => Self::polygon(&solid.face(facet)),
            _ if facet > 0 => None,
            Shape::Rectangle(flat) => {
                let (corner, [u, v]) = (flat.corner(), flat.edges());
                Self::polygon(&[corner, corner + u, corner + u + v, corner + v])
            }
            Shape::Triangle(flat) => Self::polygon(&flat.corners()),
            Shape::Disk(disk) => Self::disk(disk.center(), disk.normal(), disk.radius()),
            Shape::Sphere(ball) => Self::sphere(ball.center(), ball.radius()),
            Shape::Plane(_)
            | Shape::Mesh(_)
            | Shape::Heightfield(_)
            | Shape::Tetrahedron(_)
            | Shape::Cylinder(_)
            | Shape::Cone(_)
            | Shape::Capsule(_)
            | Shape::Torus(_)
            | Shape::Polyhedron(_)
            | Shape::Platonic(_)
            | Shape::Prism(_) => None,
        }
    }

    /// How many facets of a shape [`of`](Self::of) knows: 6 of a box, 4 of a tetrahedron, one for each triangle of a mesh, none
    /// of a plane, of a solid with a list of facets and of what is round about an axis, 1 of any other shape.
    #[must_use]
    pub fn facets(shape: &Shape) -> u32 {
        if let Some(mesh) = shape.as_mesh() {
            return u32::try_from(mesh.triangles().triangles().len()).unwrap_or(u32::MAX);
        }
        match shape {
            Shape::Plane(_)
            | Shape::Mesh(_)
            | Shape::Heightfield(_)
            | Shape::Cylinder(_)
            | Shape::Cone(_)
            | Shape::Capsule(_)
            | Shape::Torus(_)
            | Shape::Polyhedron(_)
            | Shape::Platonic(_)
            | Shape::Prism(_) => 0,
            Shape::Cuboid(_) => 6,
            Shape::Tetrahedron(_) => 4,
            Shape::Rectangle(_) | Shape::Triangle(_) | Shape::Disk(_) | Shape::Sphere(_) => 1,
        }
    }

    /// Middle and radius of a ball round it.
    #[must_use]
    pub fn ball(&self) -> (DVec3, f64) {
        match &self.outline {
            Outline::Polygon(flat) => super::blocker::ball_round(flat.corners()),
            Outline::Disk(disk) => (disk.center, disk.radius),
            Outline::Sphere { center, radius } => (*center, *radius),
        }
    }

    /// A point of a flat lamp that shines to one side, and its unit normal there.
    #[must_use]
    pub fn lit_side(&self) -> Option<(DVec3, DVec3)> {
        match &self.outline {
            _ if self.two_sided => None,
            Outline::Polygon(flat) => Some((flat.corners()[0], flat.normal)),
            Outline::Disk(disk) => Some((disk.center, disk.normal)),
            Outline::Sphere { .. } => None,
        }
    }

    /// The unit normal on the lit side of a flat lamp, or on either of two.
    #[must_use]
    pub fn normal(&self) -> Option<DVec3> {
        match &self.outline {
            Outline::Polygon(flat) => Some(flat.normal),
            Outline::Disk(disk) => Some(disk.normal),
            Outline::Sphere { .. } => None,
        }
    }

    /// Whether the side that a point is on is lit.
    #[must_use]
    pub fn is_lit_at(&self, point: DVec3) -> bool {
        self.lit_side().is_none_or(|(on, normal)| normal.dot(point - on) > 0.0)
    }

    /// The corners of a flat lamp with straight edges, counter-clockwise as seen from its lit side, and its unit normal there.
    #[must_use]
    pub fn corners(&self) -> Option<(&[DVec3], DVec3)> {
        match &self.outline {
            Outline::Polygon(flat) => Some((flat.corners(), flat.normal)),
            _ => None,
        }
    }

    /// Area of the sides that shine, square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        use std::f64::consts::PI;
        let one_side = match &self.outline {
            Outline::Polygon(flat) => {
                let c = flat.corners();
                (2..c.len()).map(|i| (c[i - 1] - c[0]).cross(c[i] - c[0]).length() / 2.0).sum()
            }
            Outline::Disk(disk) => PI * disk.radius * disk.radius,
            Outline::Sphere { radius, .. } => return 4.0 * PI * radius * radius,
        };
        if self.two_sided { 2.0 * one_side } else { one_side }
    }
}
