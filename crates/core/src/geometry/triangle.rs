//! The flat triangle, seen from both sides, and the crossing that every shape made of triangles shares.

use glam::{DVec2, DVec3};

use super::Geometry;
use crate::numeric::EDGE_ROUNDING;
use crate::part::Given;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// Flat triangle; its normal is `(b − a) × (c − a)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangle {
    corners: [DVec3; 3],
}

impl Triangle {
    /// From its corners.
    ///
    /// # Errors
    /// A corner that is not finite, or corners on one line.
    pub fn new(a: DVec3, b: DVec3, c: DVec3) -> Result<Self, InvalidPart> {
        crate::part::make(&corner_values(&[a, b, c]))
    }

    /// Its corners a, b, c.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 3] {
        self.corners
    }
}

impl Part for Triangle {
    const NAME: &'static str = "triangle";
    const DOC: &'static str = "A flat triangle, seen from both sides.";
    const FIELDS: &'static [Field] = &[
        Field::required("a", FieldKind::Point, "m", "First corner."),
        Field::required("b", FieldKind::Point, "m", "Second corner."),
        Field::required("c", FieldKind::Point, "m", "Third corner."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let corners = [given.point("a")?, given.point("b")?, given.point("c")?];
        check_area(&corners)?;
        Ok(Self { corners })
    }

    fn values(&self) -> Values {
        corner_values(&self.corners)
    }
}

impl Geometry for Triangle {
    fn cross(&self, ray: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing> {
        if leaving.is_some() {
            return None;
        }
        let (t, _) = cross_triangle(&self.corners, ray)?;
        span.contains(t).then_some(Crossing::flat(t, unit_normal(&self.corners)?, 0))
    }

    fn bounds(&self) -> Option<Aabb> {
        Some(Aabb::of(self.corners))
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self { corners: self.corners.map(|p| placement.point(p)) }
    }

    fn is_closed(&self) -> bool {
        false
    }
}

/// Where a ray meets a triangle, edges and corners included: `t`, and the weights of the three corners, which sum
/// to one. `None` for a miss, a ray within the triangle's plane, a triangle without area, or a ray that is not
/// [valid](Ray::is_valid).
///
/// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: corners are sheared so that the
/// ray becomes an axis, which rounds a corner alike in all triangles that share it. An edge value is then the
/// difference of two products, each rounded once: as rounding keeps order, its sign is never wrong, at worst 0,
/// and 0 counts as inside. So no ray passes between triangles that share an edge or a corner.
#[must_use]
pub fn cross_triangle(corners: &[DVec3; 3], ray: &Ray) -> Option<(f64, [f64; 3])> {
    let [a, b, c] = corners.map(|p| p - ray.origin);
    let [p, q, r] = sheared([a, b, c], ray.direction);
    let edge = |v: DVec2, w: DVec2| v.x * w.y - v.y * w.x;
    let weights = [edge(r, q), edge(p, r), edge(q, p)];
    let one_side = weights.iter().all(|&w| w >= 0.0) || weights.iter().all(|&w| w <= 0.0);
    let sum = weights[0] + weights[1] + weights[2];
    if !one_side || sum == 0.0 {
        return None;
    }
    let normal = (b - a).cross(c - a);
    let along = normal.dot(ray.direction);
    let t = normal.dot(a) / along;
    (t.is_finite() && along.is_finite()).then(|| (t, weights.map(|w| w / sum)))
}

/// Where points lie across the ray through the origin along `direction`, moved along its largest component.
fn sheared(points: [DVec3; 3], direction: DVec3) -> [DVec2; 3] {
    let size = direction.abs();
    let along = if size.x > size.y.max(size.z) {
        0
    } else if size.y > size.z {
        1
    } else {
        2
    };
    let (x, y) = ((along + 1) % 3, (along + 2) % 3);
    let shear = DVec2::new(direction[x], direction[y]) / direction[along];
    points.map(|p| DVec2::new(p[x], p[y]) - shear * p[along])
}

/// Unit normal `(b − a) × (c − a)`; `None` without area.
pub(super) fn unit_normal(corners: &[DVec3; 3]) -> Option<DVec3> {
    let [a, b, c] = corners;
    (b - a).cross(c - a).try_normalize()
}

/// Refuses corners that lie on one line, but for what rounding makes of it.
pub(super) fn check_area([a, b, c]: &[DVec3; 3]) -> Result<(), InvalidPart> {
    let (u, v) = (b - a, c - a);
    let largest = [a, b, c].map(|p| p.abs().max_element()).into_iter().fold(0.0, f64::max);
    let area = u.cross(v).length();
    if area > EDGE_ROUNDING * largest * (u.length() + v.length()) && area.is_finite() {
        return Ok(());
    }
    Err(InvalidPart::new("c", "must not lie on one line with a and b", c))
}

/// Corners as values named a, b, c, d.
pub(super) fn corner_values(corners: &[DVec3]) -> Values {
    let names = ["a", "b", "c", "d"];
    names.iter().zip(corners).fold(Values::new(), |values, (name, p)| values.with(name, Value::Vector(*p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> Triangle {
        Triangle::new(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap()
    }

    #[test]
    fn the_middle_is_hit_and_beyond_the_edge_is_not() {
        let at = |x: f64, y: f64| Ray::new(DVec3::new(x, y, 5.0), -DVec3::Z);
        assert_eq!(triangle().cross(&at(0.25, 0.25), Span::AHEAD, None).unwrap().t, 5.0);
        assert!(triangle().cross(&at(0.51, 0.5), Span::AHEAD, None).is_none());
    }

    #[test]
    fn corner_weights_rebuild_the_point() {
        let ray = Ray::new(DVec3::new(0.2, 0.3, 1.0), DVec3::new(0.1, 0.05, -1.0));
        let (t, w) = cross_triangle(&triangle().corners, &ray).unwrap();
        let rebuilt =
            triangle().corners[0] * w[0] + triangle().corners[1] * w[1] + triangle().corners[2] * w[2];
        assert!((rebuilt - ray.at(t)).length() < 1e-15);
    }

    #[test]
    fn a_ray_in_its_plane_misses() {
        let ray = Ray::new(DVec3::new(-1.0, 0.2, 0.0), DVec3::X);
        assert!(triangle().cross(&ray, Span::AHEAD, None).is_none());
    }

    #[test]
    fn corners_on_a_line_are_refused() {
        assert_eq!(Triangle::new(DVec3::ZERO, DVec3::X, DVec3::X * 2.0).unwrap_err().field(), "c");
    }
}
