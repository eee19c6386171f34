//! The torus: a ring with a round cross section.

mod equation;

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::disk::disk_bounds;
use super::parametrization::turn_about;
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Verdict};
use crate::part::Given;
use crate::solid::{End, Passage};
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// All points at `minor` from the circle round `center`, across `axis`, at `major`.
#[derive(Debug, Clone, PartialEq)]
pub struct Torus {
    center: DVec3,
    /// The axis as it was given.
    upwards: DVec3,
    axis: DVec3,
    major: f64,
    minor: f64,
}

impl Torus {
    /// Round `center`, across `axis` (any length), `major` metres from the middle of the ring to that of the tube, `minor`
    /// metres from there to the surface.
    ///
    /// # Errors
    /// A centre that is not finite, an axis that is zero or not finite, radii that are not positive and finite, or a `minor`
    /// that is not less than `major`.
    pub fn new(center: DVec3, axis: DVec3, major: f64, minor: f64) -> Result<Self, InvalidPart> {
        let values = Values::new().with("center", Value::Vector(center)).with("axis", Value::Vector(axis));
        let values = values.with("major", Value::Number(major));
        crate::part::make(&values.with("minor", Value::Number(minor)))
    }

    /// Its middle.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// The axis as it was given, of any length: what decides where a ray meets the torus.
    #[must_use]
    pub fn upwards(&self) -> DVec3 {
        self.upwards
    }

    /// Its unit axis.
    #[must_use]
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// The radius of the ring and that of its cross section, the second greater than 0 and less than the first.
    #[must_use]
    pub fn radii(&self) -> [f64; 2] {
        [self.major, self.minor]
    }

    /// How far a point is from the surface, within rounding.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        (self.across(point).1.length() - self.minor).abs()
    }

    /// From the middle of the ring to that of the tube beside a point, as a unit vector, and the point as seen from there.
    fn across(&self, point: DVec3) -> (DVec3, DVec3) {
        let from_center = point - self.center;
        let out = turn_about(self.axis, from_center).outwards;
        (out, from_center - out * self.major)
    }
}

impl Part for Torus {
    const NAME: &'static str = "torus";
    const DOC: &'static str = "A ring with a round cross section.";
    const FIELDS: &'static [Field] = &[
        Field::required("center", FieldKind::Point, "m", "The middle.").or(|| Value::Vector(DVec3::ZERO)),
        Field::required("axis", FieldKind::Direction, "", "Perpendicular to the ring.")
            .or(|| Value::Vector(DVec3::Y)),
        Field::required("major", FieldKind::Length, "m", "From the middle of the ring to that of the tube."),
        Field::required("minor", FieldKind::Length, "m", "Radius of the tube, less than major."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (center, upwards) = (given.point("center")?, given.direction("axis")?);
        let (major, minor) = (given.positive("major")?, given.positive("minor")?);
        if minor >= major {
            return Err(InvalidPart::new("minor", format!("must be less than major, {major}"), minor));
        }
        Ok(Self { center, upwards, axis: upwards.normalize(), major, minor })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("center", Value::Vector(self.center))
            .with("axis", Value::Vector(self.upwards))
            .with("major", Value::Number(self.major))
            .with("minor", Value::Number(self.minor))
    }
}

impl Geometry for Torus {
    /// A ray that leaves it begins where the equation is 0, whatever rounding has made of that: what is left of it without its
    /// constant is divided by the parameter.
    fn nearest_root<N: Number>(
        &self,
        _: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        let Some(line) = self.along::<N>(own, leaving) else { return Ok(None) };
        N::find_root(&line.equation, line.reach, |root| FacetRoot::on(span, line.root(root), 0))
    }

    fn crossing(&self, own: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        let (_, from_tube) = self.across(own.at(at.t));
        let normal = from_tube.try_normalize().or_else(|| (-own.direction).try_normalize())?;
        Some(Crossing::flat(at, normal, facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        let ring = disk_bounds(self.center, self.axis, self.major);
        let reach = DVec3::splat(self.minor);
        Some(Aabb { min: ring.min - reach, max: ring.max + reach })
    }

    fn placed(&self, placement: &Placement) -> Self {
        let upwards = placement.direction(self.upwards);
        Self {
            center: placement.point(self.center),
            upwards,
            axis: upwards.normalize(),
            major: self.major * placement.scale(),
            minor: self.minor * placement.scale(),
        }
    }

    fn parametrization(&self, point: DVec3, _: u32) -> Parametrization {
        let (out, from_tube) = self.across(point);
        let place = DVec2::new(from_tube.dot(out), from_tube.dot(self.axis));
        let turn = turn_about(self.axis, point - self.center);
        let along_v = (self.axis * place.x - out * place.y) * TAU;
        let uv = DVec2::new(turn.share, (place.y.atan2(place.x) / TAU + 0.5).min(1.0));
        Parametrization { uv, along_u: turn.along, along_v }
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn is_solid(&self) -> bool {
        true
    }

    fn passage<N: Number>(&self, own: &Ray, leaving: Option<u32>) -> Verdict<Passage<N>> {
        let Some(line) = self.along::<N>(own, leaving) else { return Ok(Passage::by()) };
        let leaves = leaving.is_some();
        let mut passage = Passage { inside: leaves && line.begins_inside()?, ..Passage::by() };
        for root in N::sign_changes(&line.equation, line.reach)? {
            let root = line.root(root);
            if !leaves || root.side(&N::of(0.0), &N::of(1.0))?.is_gt() {
                passage.ends.push(End { root, facet: 0 });
            }
        }
        Ok(passage)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3 and 1 m, lying flat.
    fn ring() -> Torus {
        Torus::new(DVec3::ZERO, DVec3::Y * 2.0, 3.0, 1.0).unwrap()
    }

    fn all(torus: &Torus, origin: [f64; 3], direction: [f64; 3]) -> Vec<f64> {
        let (mut met, ray) = (Vec::new(), Ray::new(origin.into(), direction.into()));
        let mut span = Span::AHEAD;
        while let Some(hit) = torus.cross(&ray, span, None) {
            met.push(hit.t);
            span.min = hit.latest();
        }
        met
    }

    #[test]
    fn a_line_through_the_middle_meets_it_four_times() {
        let met = all(&ring(), [10.0, 0.0, 0.0], [-1.0, 0.0, 0.0]);
        assert_eq!(met, [6.0, 8.0, 12.0, 14.0]);
        assert_eq!(all(&ring(), [3.0, 5.0, 0.0], [0.0, -2.0, 0.0]), [2.0, 3.0]);
        assert_eq!(all(&ring(), [0.0, 5.0, 0.5], [0.0, -1.0, 0.0]), [0.0; 0]);
    }

    #[test]
    fn it_is_touched_above_and_in_the_hole() {
        // Along the top, where the plane y = 1 touches it all round.
        let hit =
            ring().cross(&Ray::new(DVec3::new(10.0, 1.0, 0.0), DVec3::NEG_X), Span::AHEAD, None).unwrap();
        assert_eq!((hit.t, hit.normal), (7.0, DVec3::Y));
        let beside = Ray::new(DVec3::new(10.0, 1.0_f64.next_up(), 0.0), DVec3::NEG_X);
        assert!(ring().cross(&beside, Span::AHEAD, None).is_none());
        // Down through the hole, along its narrowest circle.
        let down = |x: f64| all(&ring(), [x, 5.0, 0.0], [0.0, -1.0, 0.0]).len();
        assert_eq!((down(2.0), down(2.0_f64.next_down())), (1, 0));
    }

    #[test]
    fn normals_point_away_from_the_tube() {
        let cross =
            |origin: DVec3, direction| ring().cross(&Ray::new(origin, direction), Span::AHEAD, None).unwrap();
        assert_eq!(cross(DVec3::X * 9.0, DVec3::NEG_X).normal, DVec3::X);
        assert_eq!(cross(DVec3::ZERO, DVec3::X).normal, DVec3::NEG_X);
        assert_eq!(cross(DVec3::new(3.0, 9.0, 0.0), DVec3::NEG_Y).normal, DVec3::Y);
    }

    #[test]
    fn a_ray_that_leaves_does_not_meet_where_it_was() {
        let leave = |origin: [f64; 3], direction: [f64; 3]| {
            let ray = Ray::new(origin.into(), direction.into());
            ring().cross(&ray, Span::AHEAD, Some(0)).map(|hit| hit.t)
        };
        assert_eq!(leave([4.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), Some(2.0));
        assert_eq!(leave([2.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), Some(4.0));
        assert_eq!(leave([4.0 - 1e-15, 0.0, 0.0], [1.0, 0.0, 0.0]), None);
        assert_eq!(leave([3.0, 1.0, 0.0], [0.0, -1.0, 0.0]), Some(2.0));
        // Tangent to the hole: at once in the tube, out of it where the outer circle is met, at √(4² − 2²).
        let chord = leave([2.0, 0.0, 0.0], [0.0, 0.0, 1.0]).unwrap();
        assert!((chord - 12.0_f64.sqrt()).abs() < 1e-14, "{chord}");
    }

    #[test]
    fn a_ring_without_a_hole_is_refused() {
        let refused = Torus::new(DVec3::ZERO, DVec3::Y, 1.0, 1.0).unwrap_err();
        assert_eq!(refused.to_string(), "minor must be less than major, 1, not 1");
    }
}
