//! The infinite plane through a point, seen from both sides.

use std::cmp::Ordering;

use glam::{DVec2, DVec3};
use smallvec::smallvec;

use super::parametrization::level_axes;
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Bounded, Dyadic, Located, Number, Root, Vector, Verdict, decide};
use crate::part::Given;
use crate::solid::{End, Passage};
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// All points `p` with `normal · (p − point) = 0`.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    point: DVec3,
    /// The normal as it was given.
    upwards: DVec3,
    normal: DVec3,
}

impl Plane {
    /// Through `point`, perpendicular to `normal` (any length).
    ///
    /// # Errors
    /// A point that is not finite, a normal that is zero or not finite.
    pub fn new(point: DVec3, normal: DVec3) -> Result<Self, InvalidPart> {
        crate::part::make(
            &Values::new().with("point", Value::Vector(point)).with("normal", Value::Vector(normal)),
        )
    }

    /// The normal as it was given, of any length: what decides where a ray meets the plane.
    #[must_use]
    pub fn upwards(&self) -> DVec3 {
        self.upwards
    }

    /// On which side of the plane a point lies, exactly: `Greater` where the normal points to, `Equal` on it.
    #[must_use]
    pub fn side_of(&self, point: DVec3) -> Ordering {
        fn side<N: Number>(plane: &Plane, point: DVec3) -> Verdict<Option<Ordering>> {
            let away = Vector::<N>::of(point).minus(&Vector::of(plane.point));
            Vector::of(plane.upwards).dot(&away).sign().map(Some)
        }
        decide(|| side::<Bounded>(self, point), || side::<Dyadic>(self, point)).unwrap_or(Ordering::Equal)
    }

    /// Whether a direction points to the side that the normal points to, exactly; `Equal` along the plane.
    #[must_use]
    pub fn side_of_direction(&self, direction: DVec3) -> Ordering {
        fn side<N: Number>(plane: &Plane, direction: DVec3) -> Verdict<Option<Ordering>> {
            Vector::<N>::of(plane.upwards).dot(&Vector::of(direction)).sign().map(Some)
        }
        decide(|| side::<Bounded>(self, direction), || side::<Dyadic>(self, direction))
            .unwrap_or(Ordering::Equal)
    }

    /// A point on it.
    #[must_use]
    pub fn point(&self) -> DVec3 {
        self.point
    }

    /// Its unit normal.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }
}

impl Part for Plane {
    const NAME: &'static str = "plane";
    const DOC: &'static str = "An infinite plane, seen from both sides.";
    const FIELDS: &'static [Field] = &[
        Field::required("point", FieldKind::Point, "m", "A point on the plane.")
            .or(|| Value::Vector(DVec3::ZERO)),
        Field::required("normal", FieldKind::Direction, "", "Perpendicular to the plane.")
            .or(|| Value::Vector(DVec3::Y)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let upwards = given.direction("normal")?;
        Ok(Self { point: given.point("point")?, upwards, normal: upwards.normalize() })
    }

    fn values(&self) -> Values {
        Values::new().with("point", Value::Vector(self.point)).with("normal", Value::Vector(self.upwards))
    }
}

impl Geometry for Plane {
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
        match plane_root(self.point, &Vector::of(self.upwards), own)? {
            Some(root) => FacetRoot::on(span, root, 0),
            None => Ok(None),
        }
    }

    fn crossing(&self, _: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        Some(Crossing::flat(at, self.normal, facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        None
    }

    fn placed(&self, placement: &Placement) -> Self {
        let upwards = placement.direction(self.upwards);
        Self { point: placement.point(self.point), upwards, normal: upwards.normalize() }
    }

    fn parametrization(&self, point: DVec3, _: u32) -> Parametrization {
        let [along_u, along_v] = level_axes(self.normal);
        let from_point = point - self.point;
        let uv = DVec2::new(from_point.dot(along_u), from_point.dot(along_v));
        Parametrization { uv, along_u, along_v }
    }

    fn is_closed(&self) -> bool {
        false
    }

    /// All that lies below it.
    fn is_solid(&self) -> bool {
        true
    }

    fn passage<N: Number>(&self, own: &Ray, leaving: Option<u32>) -> Verdict<Passage<N>> {
        let up = Vector::<N>::of(self.upwards);
        let climbs = up.dot(&Vector::of(own.direction)).sign()?;
        if leaving.is_some() {
            return Ok(Passage { inside: climbs.is_lt(), ..Passage::by() });
        }
        let Some(root) = plane_root(self.point, &up, own)? else {
            let above = up.dot(&Vector::of(own.origin).minus(&Vector::of(self.point)));
            return Ok(Passage { inside: above.sign()?.is_lt(), ..Passage::by() });
        };
        Ok(Passage { inside: climbs.is_gt(), ends: smallvec![End { root, facet: 0 }] })
    }
}

/// Where a ray meets the plane through `point` with a `normal` of any length; `None` when parallel to it.
pub(super) fn plane_root<N: Number>(point: DVec3, normal: &Vector<N>, ray: &Ray) -> Verdict<Option<Root<N>>> {
    let along = normal.dot(&Vector::of(ray.direction));
    let away = normal.dot(&Vector::of(point).minus(&Vector::of(ray.origin)));
    Root::ratio(&away, &along)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_met_from_both_sides() {
        let plane = Plane::new(DVec3::Y, DVec3::Y).unwrap();
        for (from, along) in [(3.0, -1.0), (-1.0, 1.0)] {
            let ray = Ray::new(DVec3::Y * from, DVec3::Y * along);
            assert_eq!(plane.cross(&ray, Span::AHEAD, None).unwrap().t, 2.0);
        }
    }

    #[test]
    fn nothing_is_met_behind_or_alongside() {
        let plane = Plane::new(DVec3::Y, DVec3::Y).unwrap();
        assert!(plane.cross(&Ray::new(DVec3::ZERO, -DVec3::Y), Span::AHEAD, None).is_none());
        assert!(plane.cross(&Ray::new(DVec3::ZERO, DVec3::X), Span::AHEAD, None).is_none());
        assert!(plane.cross(&Ray::new(DVec3::Y, DVec3::X), Span::AHEAD, None).is_none());
    }
}
