//! The box with six faces, axis-aligned in its own space.
//!
//! Slabs after Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986.

use glam::{DVec2, DVec3};

use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Root, Verdict};
use crate::part::Given;
use crate::texture::facing;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// A closed box, or a flat one where its corners share a coordinate. Face `2 * axis` lies at the lower end of that
/// axis, face `2 * axis + 1` at the upper end.
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
    /// Corners that are not finite, or `max` below `min` on some axis; a box may be flat.
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
        if bounds.is_empty() {
            return Err(InvalidPart::new("max", "must not be below min on any axis", bounds.max));
        }
        Ok(Self { bounds, to_world: Placement::IDENTITY, to_object: Placement::IDENTITY })
    }

    /// The corners in its own space; where it has been placed is not a value of the box.
    fn values(&self) -> Values {
        Values::new().with("min", Value::Vector(self.bounds.min)).with("max", Value::Vector(self.bounds.max))
    }
}

impl Geometry for Cuboid {
    fn own_ray(&self, ray: &Ray) -> Ray {
        Ray::new(self.to_object.point(ray.origin), self.to_object.vector(ray.direction))
    }

    fn nearest_root<N: Number>(
        &self,
        _: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        if leaving.is_some_and(|facet| outwards(facet).dot(own.direction) > 0.0) {
            return Ok(None);
        }
        let Some(ends) = slabs::<N>(&self.bounds, own)? else { return Ok(None) };
        for (root, facet) in ends {
            if leaving != Some(facet)
                && let Some(found) = FacetRoot::on(span, root, facet)?
            {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    fn crossing(&self, _: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        Some(Crossing::flat(at, self.to_world.direction(outwards(facet)), facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        Some(Aabb::of(self.bounds.corners().map(|p| self.to_world.point(p))))
    }

    fn placed(&self, placement: &Placement) -> Self {
        let to_world = self.to_world.then(placement);
        Self { bounds: self.bounds, to_world, to_object: to_world.inverse() }
    }

    fn parametrization(&self, point: DVec3, facet: u32) -> Parametrization {
        let (normal, size) = (outwards(facet), self.bounds.size());
        let from_min = self.to_object.point(point) - self.bounds.min;
        // Where an axis of the face runs backwards, the coordinate runs from the other end.
        let across = |v: DVec3| facing(v, normal);
        let sizes = across(size);
        let share = |along: f64, size: f64| if size == 0.0 { 0.0 } else { along / size.abs() };
        let place = across(from_min);
        let uv = DVec2::new(share(place.x, sizes.x), share(place.y, sizes.y))
            + DVec2::from(sizes.to_array().map(|v| f64::from(v < 0.0)));
        let axis = |i: usize| {
            let is_it = |axis: &DVec3| across(*axis)[i] != 0.0;
            let along = DVec3::AXES.into_iter().find(is_it).unwrap_or_default();
            self.to_world.vector(along * (along.dot(size) * across(along)[i]))
        };
        Parametrization { uv, along_u: axis(0), along_v: axis(1) }
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn is_solid(&self) -> bool {
        true
    }
}

/// The outer side of a face, in the box's own space.
fn outwards(facet: u32) -> DVec3 {
    let axis = DVec3::AXES[(facet / 2) as usize % 3];
    if facet.is_multiple_of(2) { -axis } else { axis }
}

/// A place on a line and the facet that lies there.
type End<N> = (Root<N>, u32);

/// Where a line enters and leaves a box, and through which faces; `None` when it passes by. Of faces met in one place
/// that of the first axis counts.
fn slabs<N: Number>(bounds: &Aabb, ray: &Ray) -> Verdict<Option<[End<N>; 2]>> {
    let mut ends: Option<[End<N>; 2]> = None;
    for axis in 0..3_u32 {
        let i = axis as usize;
        let (low, high, origin, direction) = (bounds.min[i], bounds.max[i], ray.origin[i], ray.direction[i]);
        if direction == 0.0 {
            if !(low <= origin && origin <= high) {
                return Ok(None);
            }
            continue;
        }
        let at = |face: f64| Root::ratio(&N::of(face).minus(&N::of(origin)), &N::of(direction));
        let (Some(low), Some(high)) = (at(low)?, at(high)?) else { return Ok(None) };
        let (low, high) = ((low, 2 * axis), (high, 2 * axis + 1));
        let [near, far] = if direction > 0.0 { [low, high] } else { [high, low] };
        ends = Some(match ends {
            None => [near, far],
            Some([enter, leave]) => {
                let later = near.0.compare(&enter.0)?.is_gt();
                let sooner = far.0.compare(&leave.0)?.is_lt();
                [if later { near } else { enter }, if sooner { far } else { leave }]
            }
        });
    }
    match ends {
        Some([enter, leave]) if enter.0.compare(&leave.0)?.is_le() => Ok(Some([enter, leave])),
        _ => Ok(None),
    }
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
    fn a_ray_that_leaves_it_outwards_does_not_meet_it_again() {
        // Beside the lower face of x by a rounding to the inner side, and beyond the lower face of y by another.
        let ray = Ray::new(DVec3::new(1e-17, -1e-17, 0.5), DVec3::new(-1.0, 4.0, 0.0));
        assert!(unit().cross(&ray, Span::AHEAD, None).is_some());
        assert_eq!(unit().cross(&ray, Span::AHEAD, Some(0)), None);
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
