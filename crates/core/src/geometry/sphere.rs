//! The sphere, met from outside and from inside.
//!
//! The discriminant is the remainder form of Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere
//! Intersection", *Ray Tracing Gems* (2019), ch. 7, times the square of the direction, so that nothing is divided.

use std::cmp::Ordering;

use glam::DVec3;

use super::parametrization::on_sphere;
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Radical, Root, Vector, Verdict};
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
    fn nearest_root<N: Number>(
        &self,
        _: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        if leaving.is_some() {
            return chord(self.center, own)?.map_or(Ok(None), |end| FacetRoot::on(span, end, 0));
        }
        let Some([near, far]) = roots(self.center, self.radius, own, span)? else { return Ok(None) };
        match FacetRoot::on(span, near, 0)? {
            None => FacetRoot::on(span, far, 0),
            near => Ok(near),
        }
    }

    fn crossing(&self, own: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        // Of a sphere so small that `f64` takes the point for the centre, the side that faces the ray.
        let outwards =
            (own.at(at.t) - self.center).try_normalize().or_else(|| (-own.direction).try_normalize());
        Some(Crossing::flat(at, outwards?, facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        let r = DVec3::splat(self.radius);
        Some(Aabb { min: self.center - r, max: self.center + r })
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self { center: placement.point(self.center), radius: self.radius * placement.scale() }
    }

    fn parametrization(&self, point: DVec3, _: u32) -> Parametrization {
        on_sphere(point - self.center, self.radius)
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn is_solid(&self) -> bool {
        true
    }
}

/// The near and the far crossing of a line with a sphere, `None` where it passes by, and where both lie before the stretch
/// for certain. With o from the centre to the origin: (−o·d ± √s) / d², where s = r² d² − |o × d|².
///
/// That form of s, rather than (o·d)² − d² (o² − r²), keeps its digits when the sphere is small and far away.
pub(super) fn roots<N: Number>(
    center: DVec3,
    radius: f64,
    ray: &Ray,
    span: Span,
) -> Verdict<Option<[Root<N>; 2]>> {
    let direction = Vector::<N>::of(ray.direction);
    let from_center = Vector::of(ray.origin).minus(&Vector::of(center));
    let radius2 = N::of(radius).squared();
    let towards = from_center.dot(&direction).negative();
    let norm = from_center.squared().minus(&radius2);
    let is_behind = |sign: Verdict<Ordering>, than: Ordering| span.min >= 0.0 && sign == Ok(than);
    if is_behind(towards.sign(), Ordering::Less) && is_behind(norm.sign(), Ordering::Greater) {
        return Ok(None);
    }
    let divisor = direction.squared();
    let square = radius2.times(&divisor).minus(&from_center.cross(&direction).squared());
    if square.sign()?.is_lt() {
        return Ok(None);
    }
    let root = |positive| Root {
        rational: towards.clone(),
        radical: Some(Radical { positive, square: square.clone(), norm: norm.clone() }),
        divisor: divisor.clone(),
        isolated: None,
    };
    Ok(Some([root(false), root(true)]))
}

/// The other end of the chord that a ray from a sphere's surface goes along, `None` where it goes outwards: at
/// −2 o·d / d², whatever rounding has made of the distance of its origin.
pub(super) fn chord<N: Number>(center: DVec3, ray: &Ray) -> Verdict<Option<Root<N>>> {
    let direction = Vector::<N>::of(ray.direction);
    let towards = Vector::of(center).minus(&Vector::of(ray.origin)).dot(&direction);
    if towards.sign()?.is_le() {
        return Ok(None);
    }
    Root::ratio(&towards.plus(&towards), &direction.squared())
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

    #[test]
    fn a_sphere_smaller_than_the_steps_of_f64_is_met() {
        let speck = Sphere::new(DVec3::X, f64::from(f32::from_bits(1))).unwrap();
        let hit = speck.cross(&Ray::new(-DVec3::X, DVec3::X), Span::AHEAD, None).unwrap();
        assert_eq!((hit.t, hit.normal), (2.0, -DVec3::X));
    }
}
