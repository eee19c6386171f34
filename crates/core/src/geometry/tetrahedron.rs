//! The solid between four corners.

use glam::DVec3;

use super::parametrization::{BARYCENTRIC, in_triangle};
use super::triangle::{check_area, corner_values, meet_triangle, unit_normal};
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Vector, Verdict};
use crate::numeric::EDGE_ROUNDING;
use crate::part::Given;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Values};

/// Closed solid with four flat faces; face `i` lies opposite corner `i` and its normal points outwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Tetrahedron {
    corners: [DVec3; 4],
}

impl Tetrahedron {
    /// From its corners, in any order.
    ///
    /// # Errors
    /// A corner that is not finite, or corners in one plane.
    pub fn new(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> Result<Self, InvalidPart> {
        crate::part::make(&corner_values(&[a, b, c, d]))
    }

    /// Its corners a, b, c, d.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 4] {
        self.corners
    }

    /// The corners of face `i`, wound so that `(q − p) × (r − p)` points outwards.
    #[must_use]
    pub fn face(&self, i: u32) -> [DVec3; 3] {
        let [a, b, c, d] = self.corners;
        let [p, q, r, opposite] = match i {
            0 => [b, c, d, a],
            1 => [a, c, d, b],
            2 => [a, b, d, c],
            _ => [a, b, c, d],
        };
        if (q - p).cross(r - p).dot(opposite - p) > 0.0 { [p, r, q] } else { [p, q, r] }
    }
}

impl Part for Tetrahedron {
    const NAME: &'static str = "tetrahedron";
    const DOC: &'static str = "A solid with four corners and four flat faces.";
    const FIELDS: &'static [Field] = &[
        Field::required("a", FieldKind::Point, "m", "First corner."),
        Field::required("b", FieldKind::Point, "m", "Second corner."),
        Field::required("c", FieldKind::Point, "m", "Third corner."),
        Field::required("d", FieldKind::Point, "m", "Fourth corner."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let corners @ [a, b, c, d] =
            [given.point("a")?, given.point("b")?, given.point("c")?, given.point("d")?];
        check_area(&[a, b, c])?;
        let [u, v, w] = [b - a, c - a, d - a];
        let faces = u.length() * v.length() + v.length() * w.length() + w.length() * u.length();
        let largest = corners.map(|p| p.abs().max_element()).into_iter().fold(0.0, f64::max);
        let volume = u.cross(v).dot(w).abs();
        if !(volume > EDGE_ROUNDING * largest * faces && volume.is_finite()) {
            return Err(InvalidPart::new("d", "must not lie in one plane with a, b and c", d));
        }
        Ok(Self { corners })
    }

    fn values(&self) -> Values {
        corner_values(&self.corners)
    }
}

impl Geometry for Tetrahedron {
    fn pieces(&self) -> u32 {
        4
    }

    fn nearest_root<N: Number>(
        &self,
        face: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        match leaving {
            Some(left) if left == face || runs_out::<N>(&self.face(left), own)? => Ok(None),
            _ => meet_triangle(&self.face(face), own, span, face),
        }
    }

    fn crossing(&self, _: &Ray, at: Located, face: u32) -> Option<Crossing> {
        Some(Crossing::flat(at, unit_normal(&self.face(face))?, face))
    }

    fn bounds(&self) -> Option<Aabb> {
        Some(Aabb::of(self.corners))
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self { corners: self.corners.map(|p| placement.point(p)) }
    }

    fn parametrization(&self, point: DVec3, facet: u32) -> Parametrization {
        in_triangle(&self.face(facet), BARYCENTRIC, point)
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn is_solid(&self) -> bool {
        true
    }
}

/// Whether a ray runs to the outer side of the face that it leaves.
fn runs_out<N: Number>(face: &[DVec3; 3], ray: &Ray) -> Verdict<bool> {
    let [p, q, r] = face.map(Vector::<N>::of);
    let normal = q.minus(&p).cross(&r.minus(&p));
    Ok(normal.dot(&Vector::of(ray.direction)).sign()?.is_gt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner() -> Tetrahedron {
        Tetrahedron::new(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z).unwrap()
    }

    #[test]
    fn a_ray_that_leaves_it_outwards_does_not_meet_it_again_whatever_rounding_made_of_its_origin() {
        // Off face z = 0 by a rounding to the inner side, and beyond face x = 0 by another.
        let origin = DVec3::new(-1e-17, 0.2, 1e-17);
        let outwards = Ray::new(origin, DVec3::new(4.0, 0.0, -1.0));
        assert_eq!(corner().cross(&outwards, Span::AHEAD, None).map(|hit| hit.facet), Some(1));
        assert_eq!(corner().cross(&outwards, Span::AHEAD, Some(3)), None);
    }

    #[test]
    fn a_ray_that_leaves_a_face_inwards_meets_another() {
        let inwards = Ray::new(DVec3::new(0.2, 0.2, 0.0), DVec3::Z);
        assert_eq!(corner().cross(&inwards, Span::AHEAD, Some(3)).map(|hit| hit.facet), Some(0));
    }

    #[test]
    fn every_face_looks_outwards() {
        let t = corner();
        let middle = DVec3::splat(0.25);
        for i in 0..4 {
            let face = t.face(i);
            assert!(unit_normal(&face).unwrap().dot(middle - face[0]) < 0.0, "face {i}");
        }
    }

    #[test]
    fn a_flat_one_is_refused() {
        let flat = Tetrahedron::new(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.0));
        assert_eq!(flat.unwrap_err().field(), "d");
    }
}
