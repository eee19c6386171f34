//! The round cone, pointed or cut off, with caps or open.

use glam::{DVec2, DVec3};

use super::disk::{disk_bounds, meet_disk};
use super::lateral::{LOWER, Lateral, SIDE, UPPER, WayOut, check_axis, outwards};
use super::parametrization::{on_disk, turn_about};
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Vector, Verdict};
use crate::part::Given;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// The round side between two circles across an axis, the second of which may be a point, and unless it is open the disks at
/// both ends. Facet 0 is the side, 1 the cap at `from`, 2 that at `to`, where there is one; normals point outwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Cone {
    from: DVec3,
    to: DVec3,
    radius: f64,
    top_radius: f64,
    open: bool,
}

impl Cone {
    /// From a circle round `from`, at `radius` metres, to one round `to` at `top_radius`, or to the tip there if that is 0;
    /// with caps.
    ///
    /// # Errors
    /// Ends that are not finite or the same, a radius that is not positive and finite, a top radius that is negative or not
    /// finite.
    pub fn new(from: DVec3, to: DVec3, radius: f64, top_radius: f64) -> Result<Self, InvalidPart> {
        let values = Values::new().with("from", Value::Vector(from)).with("to", Value::Vector(to));
        let values = values.with("radius", Value::Number(radius));
        crate::part::make(&values.with("top-radius", Value::Number(top_radius)))
    }

    /// The same, without caps.
    #[must_use]
    pub fn opened(self) -> Self {
        Self { open: true, ..self }
    }

    /// The middles of both ends; the second is the tip, if there is one.
    #[must_use]
    pub fn ends(&self) -> [DVec3; 2] {
        [self.from, self.to]
    }

    /// The radii at both ends: the first greater than 0, the second at least 0.
    #[must_use]
    pub fn radii(&self) -> [f64; 2] {
        [self.radius, self.top_radius]
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

    /// The outer unit normal of the side, where that lies on this side of the axis.
    fn normal(&self, outwards: DVec3) -> DVec3 {
        let along = self.to - self.from;
        (outwards * along.length() + self.axis() * (self.radius - self.top_radius)).normalize()
    }

    fn lateral<N: Number>(&self, ray: &Ray) -> Lateral<N> {
        Lateral::of_cone(self.ends(), self.radii(), ray)
    }

    /// A cap's middle, its normal, of the axis' length, and its radius.
    fn cap<N: Number>(&self, facet: u32) -> (DVec3, Vector<N>, f64) {
        let [from, to] = self.ends().map(Vector::of);
        if facet == LOWER {
            (self.from, from.minus(&to), self.radius)
        } else {
            (self.to, to.minus(&from), self.top_radius)
        }
    }
}

impl Part for Cone {
    const NAME: &'static str = "cone";
    const DOC: &'static str = "A round cone, pointed or cut off, with caps or open.";
    const FIELDS: &'static [Field] = &[
        Field::required("from", FieldKind::Point, "m", "The middle of the base."),
        Field::required("to", FieldKind::Point, "m", "The tip, or the middle of the top."),
        Field::required("radius", FieldKind::Length, "m", "Radius of the base."),
        Field::required("top-radius", FieldKind::Number, "m", "Radius of the top, at least 0: 0 for a tip.")
            .or(|| Value::Number(0.0)),
        Field::required("open", FieldKind::Flag, "", "Whether the caps are left away.")
            .or(|| Value::Flag(false)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (from, to) = (given.point("from")?, given.point("to")?);
        check_axis(from, to)?;
        let (radius, top_radius) = (given.positive("radius")?, given.not_negative("top-radius")?);
        Ok(Self { from, to, radius, top_radius, open: given.flag("open")? })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("from", Value::Vector(self.from))
            .with("to", Value::Vector(self.to))
            .with("radius", Value::Number(self.radius))
            .with("top-radius", Value::Number(self.top_radius))
            .with("open", Value::Flag(self.open))
    }
}

impl Geometry for Cone {
    fn pieces(&self) -> u32 {
        match (self.open, self.top_radius > 0.0) {
            (true, _) => 1,
            (false, false) => 2,
            (false, true) => 3,
        }
    }

    fn nearest_root<N: Number>(
        &self,
        piece: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        let Some(left) = leaving else {
            if piece == SIDE {
                return self.lateral(own).nearest(span);
            }
            let (center, normal, radius) = self.cap(piece);
            let root = meet_disk(center, &normal, radius, own)?;
            return root.map_or(Ok(None), |root| FacetRoot::on(span, root, piece));
        };
        let lateral = self.lateral(own);
        let runs_out = match left {
            SIDE => !lateral.runs_in()?,
            LOWER => lateral.climbs()?.is_le(),
            _ => lateral.climbs()?.is_ge(),
        };
        if runs_out {
            return Ok(None);
        }
        let out = match lateral.way_out(left)? {
            // A side that ends in a tip is left before it.
            WayOut::Cap(UPPER) if self.top_radius == 0.0 => {
                lateral.chord()?.map_or(WayOut::Nowhere, WayOut::Side)
            }
            out => out,
        };
        out.through([piece, left], own, span, |cap| {
            let (center, normal, _) = self.cap(cap);
            (center, normal)
        })
    }

    fn crossing(&self, own: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        let axis = self.axis();
        let normal = match facet {
            SIDE => self.normal(outwards(own.at(at.t) - self.from, axis, own.direction)),
            LOWER => -axis,
            _ => axis,
        };
        Some(Crossing::flat(at, normal, facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        let lower = disk_bounds(self.from, self.axis(), self.radius);
        Some(lower.union(disk_bounds(self.to, self.axis(), self.top_radius)))
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self {
            from: placement.point(self.from),
            to: placement.point(self.to),
            radius: self.radius * placement.scale(),
            top_radius: self.top_radius * placement.scale(),
            open: self.open,
        }
    }

    fn parametrization(&self, point: DVec3, facet: u32) -> Parametrization {
        let axis = self.axis();
        match facet {
            SIDE => {
                let (along, from_end) = (self.to - self.from, point - self.from);
                let turn = turn_about(axis, from_end);
                let uv = DVec2::new(turn.share, from_end.dot(along) / along.length_squared());
                let along_v = along + turn.outwards * (self.top_radius - self.radius);
                Parametrization { uv, along_u: turn.along, along_v }
            }
            LOWER => on_disk(point - self.from, -axis, self.radius),
            _ => on_disk(point - self.to, axis, self.top_radius),
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
    use super::*;

    /// Half as wide as high, so that the side falls by 2 for 1.
    fn pointed() -> Cone {
        Cone::new(DVec3::ZERO, DVec3::Y * 4.0, 2.0, 0.0).unwrap()
    }

    fn hit(shape: &Cone, origin: [f64; 3], direction: [f64; 3]) -> Option<(f64, DVec3, u32)> {
        let ray = Ray::new(origin.into(), direction.into());
        shape.cross(&ray, Span::AHEAD, None).map(|c| (c.t, c.normal, c.facet))
    }

    #[test]
    fn the_side_leans_and_the_base_is_flat() {
        let normal = DVec3::new(2.0, 1.0, 0.0) / 5.0_f64.sqrt();
        let (t, n, facet) = hit(&pointed(), [5.0, 2.0, 0.0], [-1.0, 0.0, 0.0]).unwrap();
        assert_eq!((t, facet), (4.0, SIDE));
        assert!(n.distance(normal) < 1e-15, "{n}");
        assert_eq!(hit(&pointed(), [0.5, -3.0, 0.0], [0.0, 1.0, 0.0]), Some((3.0, DVec3::NEG_Y, LOWER)));
        assert_eq!(hit(&pointed(), [0.5, 9.0, 0.0], [0.0, -1.0, 0.0]).unwrap().0, 6.0);
        assert_eq!(hit(&pointed(), [5.0, 4.5, 0.0], [-1.0, 0.0, 0.0]), None, "above the tip is another cone");
    }

    #[test]
    fn the_tip_is_met_from_above_and_from_beside() {
        assert_eq!(hit(&pointed(), [0.0, 9.0, 0.0], [0.0, -1.0, 0.0]).map(|h| (h.0, h.2)), Some((5.0, SIDE)));
        assert_eq!(hit(&pointed(), [3.0, 4.0, 0.0], [-1.0, 0.0, 0.0]).map(|h| (h.0, h.2)), Some((3.0, SIDE)));
        let beside = 4.0_f64.next_up();
        assert_eq!(hit(&pointed(), [3.0, beside, 0.0], [-1.0, 0.0, 0.0]), None);
    }

    #[test]
    fn a_line_along_the_side_meets_the_base_alone() {
        assert_eq!(hit(&pointed(), [-1.0, 6.0, 0.0], [1.0, -2.0, 0.0]), Some((3.0, DVec3::NEG_Y, LOWER)));
    }

    #[test]
    fn a_line_parallel_to_the_side_meets_it_once() {
        // Along the left side, 1 to the right of it: out at the right side, where 4 − 2x = 2 + 2x.
        let (t, _, facet) = hit(&pointed(), [-1.0, 0.0, 0.0], [1.0, 2.0, 0.0]).unwrap();
        assert_eq!((t, facet), (1.5, SIDE));
    }

    #[test]
    fn a_cut_off_one_has_a_top_and_widens_if_it_is_told_to() {
        let bucket = Cone::new(DVec3::ZERO, DVec3::Y * 4.0, 1.0, 3.0).unwrap();
        assert_eq!(hit(&bucket, [2.5, 9.0, 0.0], [0.0, -1.0, 0.0]), Some((5.0, DVec3::Y, UPPER)));
        assert_eq!(hit(&bucket, [2.5, -9.0, 0.0], [0.0, 1.0, 0.0]).unwrap().2, SIDE);
        assert_eq!(hit(&bucket.opened(), [0.5, 9.0, 0.0], [0.0, -1.0, 0.0]), None);
    }

    #[test]
    fn a_ray_that_leaves_meets_only_the_other_side() {
        let c = pointed();
        let leave = |origin: [f64; 3], direction: [f64; 3], facet| {
            let ray = Ray::new(origin.into(), direction.into());
            c.cross(&ray, Span::AHEAD, Some(facet)).map(|c| (c.t, c.facet))
        };
        assert_eq!(leave([1.0, 2.0, 0.0], [-1.0, 0.0, 0.0], SIDE), Some((2.0, SIDE)));
        assert_eq!(leave([1.0, 2.0, 0.0], [0.0, -1.0, 0.0], SIDE), Some((2.0, LOWER)));
        assert_eq!(leave([0.5, 0.0, 0.0], [0.0, 1.0, 0.0], LOWER), Some((3.0, SIDE)));
        assert_eq!(leave([1.0, 2.0, 0.0], [0.0, 1.0, 0.0], SIDE), None);
        // Steeper than the side, towards the cone above the tip.
        assert_eq!(leave([1.0 - 1e-16, 2.0, 0.0], [-0.9, 2.0, 0.0], SIDE), None);
    }
}
