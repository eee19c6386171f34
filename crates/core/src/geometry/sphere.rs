//! The sphere, met from outside and from inside.
//!
//! Roots by the remainder form of Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere
//! Intersection", *Ray Tracing Gems* (2019), ch. 7.

use glam::DVec3;

use super::Geometry;
use crate::part::Given;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// All points at `radius` from `center`.
#[derive(Debug, Clone, PartialEq)]
pub struct Sphere {
    center: DVec3,
    radius: f64,
}

impl Sphere {
    /// Round `center` at `radius` metres.
    ///
    /// # Errors
    /// A centre that is not finite, a radius that is not positive and finite.
    pub fn new(center: DVec3, radius: f64) -> Result<Self, InvalidPart> {
        crate::part::make(
            &Values::new().with("center", Value::Vector(center)).with("radius", Value::Number(radius)),
        )
    }

    /// Its middle.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Its radius, greater than 0.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    fn roots(&self, ray: &Ray, leaving: bool) -> Option<[f64; 2]> {
        let from_center = ray.origin - self.center;
        let a = ray.direction.length_squared();
        let b = from_center.dot(ray.direction);
        if leaving {
            return Some([f64::NEG_INFINITY, -2.0 * b / a]);
        }
        let closest = from_center - ray.direction * (b / a);
        let discriminant = self.radius * self.radius - closest.length_squared();
        if discriminant < 0.0 || discriminant.is_nan() {
            return None;
        }
        let distance = from_center.length();
        let c = (distance - self.radius) * (distance + self.radius);
        let q = -(b + (discriminant * a).sqrt().copysign(b));
        let (t0, t1) = (c / q, q / a);
        Some(if t0 <= t1 { [t0, t1] } else { [t1, t0] })
    }
}

impl Part for Sphere {
    const NAME: &'static str = "sphere";
    const DOC: &'static str = "A sphere.";
    const FIELDS: &'static [Field] = &[
        Field::required("center", FieldKind::Point, "m", "The middle.").or(|| Value::Vector(DVec3::ZERO)),
        Field::required("radius", FieldKind::Length, "m", "Distance from the middle to the surface."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self { center: given.point("center")?, radius: given.positive("radius")? })
    }

    fn values(&self) -> Values {
        Values::new().with("center", Value::Vector(self.center)).with("radius", Value::Number(self.radius))
    }
}

impl Geometry for Sphere {
    fn cross(&self, ray: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing> {
        let t =
            self.roots(ray, leaving.is_some())?.into_iter().find(|&t| span.contains(t) && t.is_finite())?;
        Some(Crossing::flat(t, (ray.at(t) - self.center).try_normalize()?, 0))
    }

    fn bounds(&self) -> Option<Aabb> {
        let r = DVec3::splat(self.radius);
        Some(Aabb { min: self.center - r, max: self.center + r })
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self { center: placement.point(self.center), radius: self.radius * placement.scale() }
    }

    fn is_closed(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit() -> Sphere {
        Sphere::new(DVec3::ZERO, 1.0).unwrap()
    }

    #[test]
    fn a_ray_from_outside_meets_the_near_side() {
        let hit = unit().cross(&Ray::new(DVec3::Z * 3.0, -DVec3::Z * 2.0), Span::AHEAD, None).unwrap();
        assert_eq!((hit.t, hit.normal), (1.0, DVec3::Z));
    }

    #[test]
    fn a_ray_from_inside_meets_the_far_side() {
        let hit = unit().cross(&Ray::new(DVec3::ZERO, -DVec3::Z), Span::AHEAD, None).unwrap();
        assert_eq!((hit.t, hit.normal), (1.0, -DVec3::Z));
    }

    #[test]
    fn a_ray_that_leaves_meets_only_the_other_side() {
        let inward = Ray::new(DVec3::Z, -DVec3::Z);
        assert_eq!(unit().cross(&inward, Span::AHEAD, Some(0)).unwrap().t, 2.0);
        let outward = Ray::new(DVec3::Z, DVec3::new(1.0, 0.0, 0.1));
        assert!(unit().cross(&outward, Span::AHEAD, Some(0)).is_none());
    }

    #[test]
    fn a_far_small_sphere_is_met_where_it_is() {
        let sphere = Sphere::new(DVec3::Z * -1e7, 1e-3).unwrap();
        let hit = sphere.cross(&Ray::new(DVec3::ZERO, -DVec3::Z), Span::AHEAD, None).unwrap();
        assert_eq!(hit.t, 1e7 - 1e-3);
    }
}
