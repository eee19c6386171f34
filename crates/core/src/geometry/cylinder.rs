//! The round cylinder, with caps or open.

use glam::{DVec2, DVec3};

use super::disk::{disk_bounds, meet_disk};
use super::lateral::{LOWER, Lateral, SIDE, check_axis, outwards};
use super::parametrization::{on_disk, turn_about};
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Vector, Verdict};
use crate::part::Given;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// All points at `radius` from the stretch between two points, across it, and unless it is open the disks at both ends. Facet 0
/// is the round side, 1 the cap at `from`, 2 that at `to`; normals point outwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Cylinder {
    from: DVec3,
    to: DVec3,
    radius: f64,
    open: bool,
}

impl Cylinder {
    /// Round the stretch between two points, at `radius` metres, with caps.
    ///
    /// # Errors
    /// Ends that are not finite or the same, a radius that is not positive and finite.
    pub fn new(from: DVec3, to: DVec3, radius: f64) -> Result<Self, InvalidPart> {
        let values = Values::new().with("from", Value::Vector(from)).with("to", Value::Vector(to));
        crate::part::make(&values.with("radius", Value::Number(radius)))
    }

    /// The same, without caps.
    #[must_use]
    pub fn opened(self) -> Self {
        Self { open: true, ..self }
    }

    /// The middles of both ends.
    #[must_use]
    pub fn ends(&self) -> [DVec3; 2] {
        [self.from, self.to]
    }

    /// Its radius, greater than 0.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether it has no caps.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// The unit vector from end to end.
    #[must_use]
    pub fn axis(&self) -> DVec3 {
        (self.to - self.from).normalize()
    }

    fn lateral<N: Number>(&self, ray: &Ray) -> Lateral<N> {
        Lateral::of_cylinder(self.ends(), self.radius, ray)
    }

    /// A cap's middle and its normal, of the axis' length.
    fn cap<N: Number>(&self, facet: u32) -> (DVec3, Vector<N>) {
        let [from, to] = self.ends().map(Vector::of);
        if facet == LOWER { (self.from, from.minus(&to)) } else { (self.to, to.minus(&from)) }
    }
}

impl Part for Cylinder {
    const NAME: &'static str = "cylinder";
    const DOC: &'static str = "A round cylinder, with caps or open.";
    const FIELDS: &'static [Field] = &[
        Field::required("from", FieldKind::Point, "m", "The middle of one end."),
        Field::required("to", FieldKind::Point, "m", "The middle of the other end."),
        Field::required("radius", FieldKind::Length, "m", "Distance from the axis to the side."),
        Field::required("open", FieldKind::Flag, "", "Whether the caps are left away.")
            .or(|| Value::Flag(false)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (from, to) = (given.point("from")?, given.point("to")?);
        check_axis(from, to)?;
        Ok(Self { from, to, radius: given.positive("radius")?, open: given.flag("open")? })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("from", Value::Vector(self.from))
            .with("to", Value::Vector(self.to))
            .with("radius", Value::Number(self.radius))
            .with("open", Value::Flag(self.open))
    }
}

impl Geometry for Cylinder {
    fn pieces(&self) -> u32 {
        if self.open { 1 } else { 3 }
    }

    fn nearest_root<N: Number>(
        &self,
        piece: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        let on_cap = |facet| {
            let (center, normal) = self.cap(facet);
            meet_disk(center, &normal, self.radius, own)?
                .map_or(Ok(None), |root| FacetRoot::on(span, root, facet))
        };
        let Some(left) = leaving else {
            return if piece == SIDE { self.lateral(own).nearest(span) } else { on_cap(piece) };
        };
        let lateral = self.lateral(own);
        let runs_out = match left {
            SIDE => !lateral.runs_in()? && !lateral.is_along()?,
            LOWER => lateral.climbs()?.is_le(),
            _ => lateral.climbs()?.is_ge(),
        };
        if runs_out {
            return Ok(None);
        }
        lateral.way_out(left)?.through([piece, left], own, span, |cap| self.cap(cap))
    }

    fn crossing(&self, own: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        let axis = self.axis();
        let normal = match facet {
            SIDE => outwards(own.at(at.t) - self.from, axis, own.direction),
            LOWER => -axis,
            _ => axis,
        };
        Some(Crossing::flat(at, normal, facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        let [lower, upper] = self.ends().map(|end| disk_bounds(end, self.axis(), self.radius));
        Some(lower.union(upper))
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self {
            from: placement.point(self.from),
            to: placement.point(self.to),
            radius: self.radius * placement.scale(),
            open: self.open,
        }
    }

    fn parametrization(&self, point: DVec3, facet: u32) -> Parametrization {
        let axis = self.axis();
        match facet {
            SIDE => {
                let (along_v, from_end) = (self.to - self.from, point - self.from);
                let turn = turn_about(axis, from_end);
                let uv = DVec2::new(turn.share, from_end.dot(along_v) / along_v.length_squared());
                Parametrization { uv, along_u: turn.along, along_v }
            }
            LOWER => on_disk(point - self.from, -axis, self.radius),
            _ => on_disk(point - self.to, axis, self.radius),
        }
    }

    fn is_closed(&self) -> bool {
        !self.open
    }

    fn is_solid(&self) -> bool {
        !self.open
    }
}

#[cfg(test)]
mod tests {
    use super::super::lateral::UPPER;
    use super::*;

    fn upright() -> Cylinder {
        Cylinder::new(DVec3::ZERO, DVec3::Y * 4.0, 1.0).unwrap()
    }

    fn hit(shape: &Cylinder, origin: [f64; 3], direction: [f64; 3]) -> Option<(f64, DVec3, u32)> {
        let ray = Ray::new(origin.into(), direction.into());
        shape.cross(&ray, Span::AHEAD, None).map(|c| (c.t, c.normal, c.facet))
    }

    #[test]
    fn side_and_caps_are_met_from_outside_and_inside() {
        let c = upright();
        assert_eq!(hit(&c, [5.0, 1.0, 0.0], [-1.0, 0.0, 0.0]), Some((4.0, DVec3::X, SIDE)));
        assert_eq!(hit(&c, [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]), Some((1.0, DVec3::NEG_X, SIDE)));
        assert_eq!(hit(&c, [0.5, 9.0, 0.0], [0.0, -1.0, 0.0]), Some((5.0, DVec3::Y, UPPER)));
        assert_eq!(hit(&c, [0.5, 1.0, 0.0], [0.0, -1.0, 0.0]), Some((1.0, DVec3::NEG_Y, LOWER)));
        assert_eq!(hit(&c, [5.0, 4.5, 0.0], [-1.0, 0.0, 0.0]), None);
    }

    #[test]
    fn a_rim_belongs_to_the_side_and_a_line_along_the_side_meets_the_caps_alone() {
        let c = upright();
        assert_eq!(hit(&c, [5.0, 4.0, 0.0], [-1.0, 0.0, 0.0]).unwrap().2, SIDE);
        assert_eq!(hit(&c, [1.0, 9.0, 0.0], [0.0, -1.0, 0.0]), Some((5.0, DVec3::Y, UPPER)));
        assert_eq!(hit(&c, [1.0_f64.next_up(), 9.0, 0.0], [0.0, -1.0, 0.0]), None);
    }

    #[test]
    fn an_open_one_is_seen_through_its_ends() {
        let tube = upright().opened();
        assert_eq!(hit(&tube, [0.0, 9.0, 0.0], [0.0, -1.0, 0.0]), None);
        // Down into it, to the far wall: at x = 1 after 2 of 3 seconds.
        assert_eq!(hit(&tube, [-1.0, 6.0, 0.0], [1.0, -1.5, 0.0]), Some((2.0, DVec3::X, SIDE)));
        assert!(!tube.is_closed());
    }

    #[test]
    fn a_ray_that_leaves_meets_only_the_other_side() {
        let c = upright();
        let leave = |origin: [f64; 3], direction: [f64; 3], facet| {
            let ray = Ray::new(origin.into(), direction.into());
            c.cross(&ray, Span::AHEAD, Some(facet)).map(|c| (c.t, c.facet))
        };
        assert_eq!(leave([1.0, 1.0, 0.0], [-1.0, 0.0, 0.0], SIDE), Some((2.0, SIDE)));
        assert_eq!(leave([1.0, 1.0, 0.0], [-1.0, 4.0, 0.0], SIDE), Some((0.75, UPPER)));
        assert_eq!(leave([1.0, 1.0, 0.0], [0.0, -1.0, 0.0], SIDE), Some((1.0, LOWER)));
        assert_eq!(leave([0.5, 4.0, 0.0], [0.0, -2.0, 0.0], UPPER), Some((2.0, LOWER)));
        assert_eq!(leave([0.5, 4.0, 0.0], [1.0, -1.0, 0.0], UPPER), Some((0.5, SIDE)));
        for outwards in [[1.0, 1.0, 0.0], [0.0, 1.0, 1.0]] {
            assert_eq!(leave([1.0 - 1e-16, 1.0, 0.0], outwards, SIDE), None);
            assert_eq!(leave([0.5, 4.0 - 1e-15, 0.0], outwards, UPPER), None);
        }
    }

    #[test]
    fn a_far_thin_one_is_met_where_it_is() {
        let wire = Cylinder::new(DVec3::new(0.0, -1.0, -1e7), DVec3::new(0.0, 1.0, -1e7), 1e-3).unwrap();
        assert_eq!(hit(&wire, [0.0; 3], [0.0, 0.0, -1.0]).unwrap().0, 1e7 - 1e-3);
    }

    #[test]
    fn ends_in_one_place_are_refused() {
        assert_eq!(Cylinder::new(DVec3::ONE, DVec3::ONE, 1.0).unwrap_err().field(), "to");
    }
}
