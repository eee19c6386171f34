//! The box with six faces, axis-aligned in its own space.
//!
//! Slabs after Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986.

use glam::DVec3;

use super::Geometry;
use crate::part::Given;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// A closed box. Face `2 * axis` lies at the lower end of that axis, face `2 * axis + 1` at the upper end.
#[derive(Debug, Clone, PartialEq)]
pub struct Cuboid {
    bounds: Aabb,
    to_world: Placement,
    to_object: Placement,
}

impl Cuboid {
    /// Between two opposite corners.
    ///
    /// # Errors
    /// Corners that are not finite, or `max` not above `min` on every axis.
    pub fn new(min: DVec3, max: DVec3) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("min", Value::Vector(min)).with("max", Value::Vector(max)))
    }

    /// Its corners in its own space.
    #[must_use]
    pub fn object_bounds(&self) -> Aabb {
        self.bounds
    }

    /// From its own space to where it has been placed.
    #[must_use]
    pub fn placement(&self) -> &Placement {
        &self.to_world
    }
}

impl Part for Cuboid {
    const NAME: &'static str = "box";
    const DOC: &'static str = "A box with six faces.";
    const FIELDS: &'static [Field] = &[
        Field::required("min", FieldKind::Point, "m", "The corner with the lowest coordinates."),
        Field::required("max", FieldKind::Point, "m", "The corner with the highest coordinates."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let bounds = Aabb { min: given.point("min")?, max: given.point("max")? };
        if !bounds.min.cmplt(bounds.max).all() {
            return Err(InvalidPart::new("max", "must be above min on every axis", bounds.max));
        }
        Ok(Self { bounds, to_world: Placement::IDENTITY, to_object: Placement::IDENTITY })
    }

    /// The corners in its own space; where it has been placed is not a value of the box.
    fn values(&self) -> Values {
        Values::new().with("min", Value::Vector(self.bounds.min)).with("max", Value::Vector(self.bounds.max))
    }
}

impl Geometry for Cuboid {
    fn cross(&self, ray: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing> {
        let own = Ray::new(self.to_object.point(ray.origin), self.to_object.vector(ray.direction));
        if !own.is_valid() {
            // A slab that NaN leaves undecided must not count as crossed.
            return None;
        }
        let ends = slabs(&self.bounds, &own)?;
        let (t, facet) = ends.into_iter().find(|&(t, facet)| span.contains(t) && leaving != Some(facet))?;
        let outwards = if facet % 2 == 0 { -1.0 } else { 1.0 };
        let normal = DVec3::AXES[(facet / 2) as usize % 3] * outwards;
        t.is_finite().then(|| Crossing::flat(t, self.to_world.direction(normal), facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        Some(Aabb::of(self.bounds.corners().map(|p| self.to_world.point(p))))
    }

    fn placed(&self, placement: &Placement) -> Self {
        let to_world = self.to_world.then(placement);
        Self { bounds: self.bounds, to_world, to_object: to_world.inverse() }
    }

    fn is_closed(&self) -> bool {
        true
    }
}

/// Where a line enters and leaves a box, and through which faces; `None` when it passes by.
fn slabs(bounds: &Aabb, ray: &Ray) -> Option<[(f64, u32); 2]> {
    let (mut enter, mut leave) = ((f64::NEG_INFINITY, 0), (f64::INFINITY, 0));
    for axis in 0..3_u32 {
        let i = axis as usize;
        let (origin, direction) = (ray.origin[i], ray.direction[i]);
        if direction == 0.0 {
            if !(bounds.min[i] <= origin && origin <= bounds.max[i]) {
                return None;
            }
            continue;
        }
        let low = ((bounds.min[i] - origin) / direction, 2 * axis);
        let high = ((bounds.max[i] - origin) / direction, 2 * axis + 1);
        let (near, far) = if direction > 0.0 { (low, high) } else { (high, low) };
        if near.0 > enter.0 {
            enter = near;
        }
        if far.0 < leave.0 {
            leave = far;
        }
    }
    (enter.0 <= leave.0).then_some([enter, leave])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit() -> Cuboid {
        Cuboid::new(DVec3::ZERO, DVec3::ONE).unwrap()
    }

    #[test]
    fn a_ray_enters_and_from_inside_leaves() {
        let ray = Ray::new(DVec3::new(-1.0, 0.5, 0.5), DVec3::X);
        let entry = unit().cross(&ray, Span::AHEAD, None).unwrap();
        assert_eq!((entry.t, entry.normal, entry.facet), (1.0, -DVec3::X, 0));
        let inside = Ray::new(ray.at(entry.t), ray.direction);
        let exit = unit().cross(&inside, Span::AHEAD, Some(entry.facet)).unwrap();
        assert_eq!((exit.t, exit.normal, exit.facet), (1.0, DVec3::X, 1));
    }

    #[test]
    fn a_ray_along_a_face_plane_is_inside_it() {
        let ray = Ray::new(DVec3::new(-1.0, 0.0, 0.5), DVec3::X);
        assert_eq!(unit().cross(&ray, Span::AHEAD, None).unwrap().t, 1.0);
    }

    #[test]
    fn a_turned_box_turns_its_normals() {
        let eighth = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::Y, std::f64::consts::FRAC_PI_2).unwrap();
        let hit =
            unit().placed(&eighth).cross(&Ray::new(DVec3::new(0.5, 0.5, -9.0), DVec3::Z), Span::AHEAD, None);
        assert!((hit.unwrap().normal + DVec3::Z).length() < 1e-15);
    }
}
