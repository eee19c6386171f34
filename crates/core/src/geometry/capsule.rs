//! The capsule: a cylinder with half a ball at each end.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::lateral::{LOWER, Lateral, SIDE, WayOut, check_axis, outwards};
use super::parametrization::turn_about;
use super::sphere::{chord, roots};
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Verdict};
use crate::part::Given;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// All points at `radius` from the stretch between two points. Facet 0 is the round side, 1 the half ball at `from`, 2 that at
/// `to`; normals point outwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Capsule {
    from: DVec3,
    to: DVec3,
    radius: f64,
}

impl Capsule {
    /// Round the stretch between two points, at `radius` metres.
    ///
    /// # Errors
    /// Ends that are not finite or the same, a radius that is not positive and finite.
    pub fn new(from: DVec3, to: DVec3, radius: f64) -> Result<Self, InvalidPart> {
        let values = Values::new().with("from", Value::Vector(from)).with("to", Value::Vector(to));
        crate::part::make(&values.with("radius", Value::Number(radius)))
    }

    /// The middles of both half balls.
    #[must_use]
    pub fn ends(&self) -> [DVec3; 2] {
        [self.from, self.to]
    }

    /// Its radius, greater than 0.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The unit vector from end to end.
    #[must_use]
    pub fn axis(&self) -> DVec3 {
        (self.to - self.from).normalize()
    }

    /// The middle of a half ball.
    fn end(&self, facet: u32) -> DVec3 {
        if facet == LOWER { self.from } else { self.to }
    }

    /// The nearest crossing with a half ball.
    fn meet_cap<N: Number>(&self, facet: u32, own: &Ray, span: Span) -> Verdict<Option<FacetRoot<N>>> {
        let Some(both) = roots(self.end(facet), self.radius, own, span)? else { return Ok(None) };
        let lateral = Lateral::of_cylinder(self.ends(), self.radius, own);
        for root in both {
            if lateral.reaches(&root, facet)?
                && let Some(found) = FacetRoot::on(span, root, facet)?
            {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    /// Where a ray that leaves a facet meets the capsule again: on its other side, if it runs into it.
    fn meet_again<N: Number>(&self, left: u32, own: &Ray, span: Span) -> Verdict<Option<FacetRoot<N>>> {
        let lateral = Lateral::of_cylinder(self.ends(), self.radius, own);
        let runs_in =
            if left == SIDE { lateral.runs_in()? } else { chord::<N>(self.end(left), own)?.is_some() };
        if !runs_in {
            return Ok(None);
        }
        let cap = match lateral.way_out(left)? {
            WayOut::Side(root) => return FacetRoot::on(span, root, SIDE),
            WayOut::Cap(cap) => cap,
            WayOut::Nowhere => left,
        };
        let root = if cap == left {
            chord(self.end(cap), own)?
        } else {
            roots(self.end(cap), self.radius, own, span)?.map(|[_, far]| far)
        };
        root.map_or(Ok(None), |root| FacetRoot::on(span, root, cap))
    }
}

impl Part for Capsule {
    const NAME: &'static str = "capsule";
    const DOC: &'static str = "A cylinder with half a ball at each end.";
    const FIELDS: &'static [Field] = &[
        Field::required("from", FieldKind::Point, "m", "The middle of one half ball."),
        Field::required("to", FieldKind::Point, "m", "The middle of the other half ball."),
        Field::required("radius", FieldKind::Length, "m", "Distance from the axis to the surface."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (from, to) = (given.point("from")?, given.point("to")?);
        check_axis(from, to)?;
        Ok(Self { from, to, radius: given.positive("radius")? })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("from", Value::Vector(self.from))
            .with("to", Value::Vector(self.to))
            .with("radius", Value::Number(self.radius))
    }
}

impl Geometry for Capsule {
    fn pieces(&self) -> u32 {
        3
    }

    fn nearest_root<N: Number>(
        &self,
        piece: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        match leaving {
            Some(left) => Ok(self.meet_again(left, own, span)?.filter(|found| found.facet == piece)),
            None if piece == SIDE => Lateral::of_cylinder(self.ends(), self.radius, own).nearest(span),
            None => self.meet_cap(piece, own, span),
        }
    }

    fn crossing(&self, own: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        let point = own.at(at.t);
        let normal = if facet == SIDE {
            outwards(point - self.from, self.axis(), own.direction)
        } else {
            (point - self.end(facet)).try_normalize().or_else(|| (-own.direction).try_normalize())?
        };
        Some(Crossing::flat(at, normal, facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        let (ends, reach) = (Aabb::of(self.ends()), DVec3::splat(self.radius));
        Some(Aabb { min: ends.min - reach, max: ends.max + reach })
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self {
            from: placement.point(self.from),
            to: placement.point(self.to),
            radius: self.radius * placement.scale(),
        }
    }

    fn parametrization(&self, point: DVec3, facet: u32) -> Parametrization {
        let (axis, length) = (self.axis(), self.from.distance(self.to));
        let from_end = point - self.from;
        let turn = turn_about(axis, from_end);
        let quarter = self.radius * PI / 2.0;
        // How far the point lies from the lower tip, along the surface.
        let (way, along) = if facet == SIDE {
            (quarter + from_end.dot(axis), axis)
        } else {
            let from_middle = point - self.end(facet);
            let (up, out) = (from_middle.dot(axis), from_middle.dot(turn.outwards));
            let base = if facet == LOWER { quarter } else { quarter + length };
            let reach = up.hypot(out);
            (base + self.radius * up.atan2(out), (axis * out - turn.outwards * up) / reach)
        };
        let whole = length + 2.0 * quarter;
        Parametrization {
            uv: DVec2::new(turn.share, way / whole),
            along_u: turn.along,
            along_v: along * whole,
        }
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn is_solid(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::super::lateral::UPPER;
    use super::*;

    fn upright() -> Capsule {
        Capsule::new(DVec3::ZERO, DVec3::Y * 4.0, 1.0).unwrap()
    }

    fn hit(origin: [f64; 3], direction: [f64; 3]) -> Option<(f64, DVec3, u32)> {
        let ray = Ray::new(origin.into(), direction.into());
        upright().cross(&ray, Span::AHEAD, None).map(|c| (c.t, c.normal, c.facet))
    }

    #[test]
    fn side_and_ends_are_met_from_outside_and_inside() {
        assert_eq!(hit([5.0, 1.0, 0.0], [-1.0, 0.0, 0.0]), Some((4.0, DVec3::X, SIDE)));
        assert_eq!(hit([0.0, 9.0, 0.0], [0.0, -1.0, 0.0]), Some((4.0, DVec3::Y, UPPER)));
        assert_eq!(hit([0.0, -9.0, 0.0], [0.0, 2.0, 0.0]), Some((4.0, DVec3::NEG_Y, LOWER)));
        assert_eq!(hit([0.0, 4.5, 0.0], [0.0, -1.0, 0.0]), Some((5.5, DVec3::NEG_Y, LOWER)));
        assert_eq!(hit([0.6, 9.0, 0.0], [0.0, -1.0, 0.0]).map(|h| (h.0, h.2)), Some((4.2, UPPER)));
        assert_eq!(hit([5.0, 5.0_f64.next_up(), 0.0], [-1.0, 0.0, 0.0]), None);
    }

    #[test]
    fn a_seam_belongs_to_the_side() {
        assert_eq!(hit([5.0, 4.0, 0.0], [-1.0, 0.0, 0.0]).unwrap().2, SIDE);
        assert_eq!(hit([5.0, 4.0_f64.next_up(), 0.0], [-1.0, 0.0, 0.0]).unwrap().2, UPPER);
        // Along the side, where both half balls are touched at their seams.
        assert_eq!(hit([1.0, 9.0, 0.0], [0.0, -1.0, 0.0]), Some((5.0, DVec3::X, UPPER)));
    }

    #[test]
    fn a_ray_that_leaves_meets_only_the_other_side() {
        let leave = |origin: [f64; 3], direction: [f64; 3], facet| {
            let ray = Ray::new(origin.into(), direction.into());
            upright().cross(&ray, Span::AHEAD, Some(facet)).map(|c| (c.t, c.facet))
        };
        assert_eq!(leave([1.0, 1.0, 0.0], [-1.0, 0.0, 0.0], SIDE), Some((2.0, SIDE)));
        assert_eq!(leave([0.0, 5.0, 0.0], [0.0, -1.0, 0.0], UPPER), Some((6.0, LOWER)));
        // Across one half ball alone: from (0.6, 4.8) to the left.
        assert_eq!(leave([0.6, 4.8, 0.0], [-1.0, 0.0, 0.0], UPPER).map(|h| h.1), Some(UPPER));
        assert_eq!(leave([0.6, 4.8, 0.0], [-1.0, -2.0, 0.0], UPPER).map(|h| h.1), Some(SIDE));
        assert_eq!(leave([0.6, 4.8, 0.0], [1.0, 0.1, 0.0], UPPER), None);
        assert_eq!(leave([1.0, 1.0, 0.0], [0.0, 1.0, 0.0], SIDE), None);
    }
}
