//! What stands in the way: the shapes whose outline has a closed form.

use glam::DVec3;

use super::cone::{MOST_CORNERS, MOST_FACES};
use super::lamp::{Face, Flat, Round};
use super::swept::Swept;
use crate::geometry::Faceted;
use crate::{Aabb, Shape};

/// A shape that can hide a part of a lamp.
#[derive(Debug, Clone, PartialEq)]
pub struct Blocker {
    pub(super) kind: Kind,
    /// Middle and radius of a ball round it; infinite round a plane.
    pub(super) bound: (DVec3, f64),
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kind {
    /// A point on it and its unit normal.
    Plane(DVec3, DVec3),
    Sphere(DVec3, f64),
    Disk(Round),
    Polygon(Flat),
    Solid(Solid),
    Swept(Swept),
    /// What lies below a plane through the eye, whose unit normal this is.
    Ground(DVec3),
}

/// A closed convex solid with flat faces.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Solid {
    pub corners: Vec<DVec3>,
    /// With outward normals, and which facet of the shape each is.
    pub faces: Vec<SolidFace>,
    pub facets: Vec<u32>,
    pub edges: Vec<SolidEdge>,
}

/// A face of a solid.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SolidFace {
    corners: Vec<DVec3>,
    normal: DVec3,
}

impl SolidFace {
    pub(super) fn view(&self) -> Face<'_> {
        Face { corners: &self.corners, normal: self.normal }
    }
}

impl From<Flat> for SolidFace {
    fn from(flat: Flat) -> Self {
        Self { corners: flat.corners().to_vec(), normal: flat.normal }
    }
}

/// An edge between two faces; it runs `from`, `to` as the loop of the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SolidEdge {
    pub faces: [usize; 2],
    pub from: DVec3,
    pub to: DVec3,
}

impl Blocker {
    /// What of a shape blocks light, `None` for one whose outline has no closed form.
    #[must_use]
    pub fn of(shape: &Shape) -> Option<Self> {
        let kind = match shape {
            Shape::Plane(plane) => Kind::Plane(plane.point(), plane.normal()),
            Shape::Sphere(ball) => Kind::Sphere(ball.center(), ball.radius()),
            Shape::Disk(disk) => {
                Kind::Disk(Round { center: disk.center(), normal: disk.normal(), radius: disk.radius() })
            }
            Shape::Triangle(flat) => polygon(&flat.corners()),
            Shape::Rectangle(flat) => {
                let (corner, [u, v]) = (flat.corner(), flat.edges());
                polygon(&[corner, corner + u, corner + u + v, corner + v])
            }
            Shape::Cuboid(_) => {
                let face = |facet| Some((facet, Flat::new(&box_face(shape, facet)?)?));
                solid_or_flat((0..6).filter_map(face))
            }
            Shape::Tetrahedron(four) => {
                solid_or_flat((0..4).filter_map(|facet| Some((facet, Flat::new(&four.face(facet))?))))
            }
            shape => match (Swept::of(shape), shape.faceted()) {
                (Some(swept), _) => Kind::Swept(swept),
                (_, Some(facets)) => Kind::Solid(convex(facets)?),
                _ => return None,
            },
        };
        Some(Self { bound: kind.bound(), kind })
    }
}

impl Blocker {
    /// All that lies below the surface of the given unit normal which the point itself lies on: where a surface is shaded with
    /// another normal than its own, it blocks what comes from below.
    #[must_use]
    pub fn ground(normal: DVec3) -> Self {
        let kind = Kind::Ground(normal);
        Self { bound: kind.bound(), kind }
    }
}

impl Kind {
    /// A ball round it.
    fn bound(&self) -> (DVec3, f64) {
        match self {
            Self::Plane(point, _) => (*point, f64::INFINITY),
            Self::Ground(_) => (DVec3::ZERO, f64::INFINITY),
            Self::Sphere(center, radius) => (*center, *radius),
            Self::Disk(disk) => (disk.center, disk.radius),
            Self::Polygon(flat) => ball_round(flat.corners()),
            Self::Solid(solid) => ball_round(&solid.corners),
            Self::Swept(swept) => swept.ball(),
        }
    }
}

/// A ball round corners, about the middle of their box. Its radius is rounded up.
pub(super) fn ball_round(corners: &[DVec3]) -> (DVec3, f64) {
    let bounds = Aabb::of(corners.iter().copied());
    let middle = bounds.min + (bounds.max - bounds.min) / 2.0;
    let reach = corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max);
    // Three roundings in the middle and the difference, as many in the length: of the largest coordinate's size.
    let coordinate = corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    (middle, reach + crate::numeric::EDGE_ROUNDING * coordinate)
}

/// The corners of a face of a box, counter-clockwise as seen from outside.
pub(super) fn box_face(shape: &Shape, facet: u32) -> Option<[DVec3; 4]> {
    let Shape::Cuboid(solid) = shape else { return None };
    if facet >= 6 {
        return None;
    }
    let (Aabb { min, max }, axis) = (solid.object_bounds(), (facet / 2) as usize);
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let is_upper = facet % 2 == 1;
    let corner = |at_u: bool, at_v: bool| {
        let mut p = if is_upper { max } else { min };
        p[u] = if at_u { max[u] } else { min[u] };
        p[v] = if at_v { max[v] } else { min[v] };
        solid.placement().point(p)
    };
    let [a, b, c, d] = [corner(false, false), corner(true, false), corner(true, true), corner(false, true)];
    Some(if is_upper { [a, b, c, d] } else { [a, d, c, b] })
}

fn polygon(corners: &[DVec3]) -> Kind {
    Flat::new(corners).map_or_else(|| Kind::Solid(solid(std::iter::empty())), Kind::Polygon)
}

/// The solid between faces; the faces of a flat box coincide, and one of them is all that blocks.
fn solid_or_flat(faces: impl Iterator<Item = (u32, Flat)>) -> Kind {
    let faces: Vec<(u32, Flat)> = faces.collect();
    if let [(_, flat), _] = faces[..] {
        return Kind::Polygon(flat);
    }
    Kind::Solid(solid(faces.into_iter().map(|(facet, flat)| (facet, flat.into()))))
}

/// A solid with a list of facets; `None` where it is not convex, or has too many of them.
fn convex(facets: &Faceted) -> Option<Solid> {
    let outlines = || (0..facets.count()).map(|facet| facets.outline(facet));
    let is_simple = outlines().all(|outline| outline.len() <= MOST_CORNERS);
    if !facets.is_convex() || facets.count() as usize > MOST_FACES || !is_simple {
        return None;
    }
    let face = |(facet, outline): (u32, &[u32])| {
        let corners = outline.iter().map(|&i| facets.corners()[i as usize]).collect();
        (facet, SolidFace { corners, normal: facets.normal(facet) })
    };
    Some(solid((0..).zip(outlines()).map(face)))
}

fn solid(faces: impl Iterator<Item = (u32, SolidFace)>) -> Solid {
    let (facets, faces): (Vec<_>, Vec<_>) = faces.unzip();
    let mut corners: Vec<DVec3> = Vec::new();
    for corner in faces.iter().flat_map(|face| &face.corners) {
        if !corners.contains(corner) {
            corners.push(*corner);
        }
    }
    let ends = |face: &SolidFace| {
        let loop_of = face.corners.clone();
        (0..loop_of.len()).map(move |i| (loop_of[i], loop_of[(i + 1) % loop_of.len()]))
    };
    let mut edges = Vec::new();
    for (first, face) in faces.iter().enumerate() {
        for (second, other) in faces.iter().enumerate().skip(first + 1) {
            for (from, to) in ends(face).filter(|&(from, to)| ends(other).any(|other| other == (to, from))) {
                edges.push(SolidEdge { faces: [first, second], from, to });
            }
        }
    }
    Solid { corners, faces, facets, edges }
}
