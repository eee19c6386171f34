//! The flat rectangle, seen from both sides.

use glam::{DVec2, DVec3};

use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Root, Vector, Verdict};
use crate::numeric::RIGHT_ANGLE_TOLERANCE;
use crate::part::{Given, degrees};
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// The points `corner + u * edge_u + v * edge_v` with u and v in 0..=1; its normal is `edge_u × edge_v`.
#[derive(Debug, Clone, PartialEq)]
pub struct Rectangle {
    corner: DVec3,
    edge_u: DVec3,
    edge_v: DVec3,
}

impl Rectangle {
    /// From a corner and the two edges that leave it.
    ///
    /// # Errors
    /// Anything not finite, an edge of no length, or edges that are not perpendicular.
    pub fn new(corner: DVec3, edge_u: DVec3, edge_v: DVec3) -> Result<Self, InvalidPart> {
        let values = Values::new().with("corner", Value::Vector(corner));
        crate::part::make(&values.with("edge-u", Value::Vector(edge_u)).with("edge-v", Value::Vector(edge_v)))
    }

    /// The corner where u = v = 0.
    #[must_use]
    pub fn corner(&self) -> DVec3 {
        self.corner
    }

    /// The two edges from that corner.
    #[must_use]
    pub fn edges(&self) -> [DVec3; 2] {
        [self.edge_u, self.edge_v]
    }
}

impl Part for Rectangle {
    const NAME: &'static str = "rectangle";
    const DOC: &'static str = "A flat rectangle, seen from both sides.";
    const FIELDS: &'static [Field] = &[
        Field::required("corner", FieldKind::Point, "m", "One corner."),
        Field::required("edge-u", FieldKind::Direction, "m", "From that corner to the next."),
        Field::required("edge-v", FieldKind::Direction, "m", "From that corner to the other neighbour."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (edge_u, edge_v) = (given.direction("edge-u")?, given.direction("edge-v")?);
        if !are_perpendicular(edge_u, edge_v) {
            let angle = degrees(edge_u.normalize().angle_between(edge_v.normalize()));
            let refused =
                InvalidPart::new("edge-v", "must be perpendicular to edge-u", format!("at {angle} to it"));
            return Err(match perpendicular(edge_u, edge_v) {
                Some(right) => refused.with_hint(format!("write {right}")),
                None => refused,
            });
        }
        if edge_u.cross(edge_v).try_normalize().is_none() {
            return Err(InvalidPart::new("edge-v", "must span an area with edge-u", edge_v));
        }
        Ok(Self { corner: given.point("corner")?, edge_u, edge_v })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("corner", Value::Vector(self.corner))
            .with("edge-u", Value::Vector(self.edge_u))
            .with("edge-v", Value::Vector(self.edge_v))
    }
}

/// Whether the angle between two edges is a right one, but for rounding.
fn are_perpendicular(edge_u: DVec3, edge_v: DVec3) -> bool {
    edge_u.normalize().dot(edge_v.normalize()).abs() <= RIGHT_ANGLE_TOLERANCE
}

/// `edge-v` as it should be written: what of it is perpendicular to `edge_u`, in as few digits as keep it so.
fn perpendicular(edge_u: DVec3, edge_v: DVec3) -> Option<String> {
    let right = edge_v - edge_v.project_onto_normalized(edge_u.try_normalize()?);
    let size = right.abs().max_element();
    (6..=15_usize).find_map(|digits| {
        let rounded = |v: f64| {
            let text = format!("{:.*e}", digits, if v.abs() < size * 1e-12 { 0.0 } else { v });
            text.parse::<f64>().unwrap_or(v)
        };
        let edge = right.to_array().map(rounded);
        are_perpendicular(edge_u, DVec3::from_array(edge))
            .then(|| format!("edge-v {} {} {}", edge[0], edge[1], edge[2]))
    })
}

impl Geometry for Rectangle {
    /// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", Journal of Graphics Tools 2(1), 1997: with
    /// the edges u and v and T from the corner to the origin, the place is (v · (T × u), T · (d × v), d · (T × u)) over
    /// u · (d × v), as ray parameter and shares of the edges.
    fn nearest_root<N: Number>(
        &self,
        _: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        if leaving.is_some() {
            return Ok(None);
        }
        let (u, v) = (Vector::<N>::of(self.edge_u), Vector::of(self.edge_v));
        let direction = Vector::of(own.direction);
        let from_corner = Vector::of(own.origin).minus(&Vector::of(self.corner));
        let (across, along) = (direction.cross(&v), from_corner.cross(&u));
        let determinant = u.dot(&across);
        let Some(root) = Root::ratio(&v.dot(&along), &determinant)? else { return Ok(None) };
        let turned = determinant.sign()?.is_lt();
        for share in [from_corner.dot(&across), direction.dot(&along)] {
            let share = if turned { share.negative() } else { share };
            if share.sign()?.is_lt() || share.minus(&root.divisor).sign()?.is_gt() {
                return Ok(None);
            }
        }
        FacetRoot::on(span, root, 0)
    }

    fn crossing(&self, own: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        let normal = self.edge_u.cross(self.edge_v).try_normalize()?;
        let Parametrization { uv, .. } = self.parametrization(own.at(at.t), facet);
        Some(Crossing { uv, ..Crossing::flat(at, normal, facet) })
    }

    fn bounds(&self) -> Option<Aabb> {
        let (c, u, v) = (self.corner, self.edge_u, self.edge_v);
        Some(Aabb::of([c, c + u, c + v, c + u + v]))
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self {
            corner: placement.point(self.corner),
            edge_u: placement.vector(self.edge_u),
            edge_v: placement.vector(self.edge_v),
        }
    }

    fn parametrization(&self, point: DVec3, _: u32) -> Parametrization {
        let from_corner = point - self.corner;
        let along = |edge: DVec3| from_corner.dot(edge) / edge.length_squared();
        let uv = DVec2::new(along(self.edge_u), along(self.edge_v));
        Parametrization { uv, along_u: self.edge_u, along_v: self.edge_v }
    }

    fn is_closed(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_ends_at_its_edges() {
        let r = Rectangle::new(DVec3::ZERO, DVec3::X * 2.0, DVec3::Y).unwrap();
        let at = |x, y| r.cross(&Ray::new(DVec3::new(x, y, 1.0), -DVec3::Z), Span::AHEAD, None);
        assert_eq!(at(1.0, 0.25).unwrap().uv, DVec2::new(0.5, 0.25));
        assert!(at(2.1, 0.5).is_none() && at(1.0, -0.1).is_none());
    }

    #[test]
    fn a_slanted_one_is_refused() {
        let slanted = Rectangle::new(DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1.0, 0.0));
        let refused = slanted.unwrap_err();
        assert_eq!(refused.to_string(), "edge-v must be perpendicular to edge-u, not at 63.43494882° to it");
        assert_eq!(refused.hint(), Some("write edge-v 0 1 0"));
    }

    #[test]
    fn edges_that_were_rounded_are_told_as_they_should_be() {
        let (u, v) = (DVec3::new(0.866, 0.0, -0.5), DVec3::new(0.333, 0.7, 0.577));
        let refused = Rectangle::new(DVec3::ZERO, u, v).unwrap_err();
        let numbers = refused.hint().and_then(|hint| hint.strip_prefix("write edge-v ")).unwrap();
        let right: Vec<f64> = numbers.split(' ').map(|number| number.parse().unwrap()).collect();
        let right = DVec3::new(right[0], right[1], right[2]);
        assert!((right - v).length() < 2e-4, "{numbers}");
        assert!(Rectangle::new(DVec3::ZERO, u, right).is_ok(), "{numbers}");
    }
}
