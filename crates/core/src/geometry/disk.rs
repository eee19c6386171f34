//! The flat round disk, seen from both sides.

use glam::DVec3;

use super::parametrization::on_disk;
use super::plane::plane_root;
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Root, Vector, Verdict};
use crate::part::Given;
use crate::{Aabb, Crossing, Field, FieldKind, InvalidPart, Part, Placement, Ray, Span, Value, Values};

/// All points of the plane through `center`, perpendicular to `normal`, that lie within `radius` of the centre; the
/// rim belongs to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Disk {
    center: DVec3,
    /// The normal as it was given.
    upwards: DVec3,
    normal: DVec3,
    radius: f64,
}

impl Disk {
    /// Round `center`, perpendicular to `normal` (any length), out to `radius` metres.
    ///
    /// # Errors
    /// A centre that is not finite, a normal that is zero or not finite, a radius that is not positive and finite.
    pub fn new(center: DVec3, normal: DVec3, radius: f64) -> Result<Self, InvalidPart> {
        let values =
            Values::new().with("center", Value::Vector(center)).with("normal", Value::Vector(normal));
        crate::part::make(&values.with("radius", Value::Number(radius)))
    }

    /// The normal as it was given, of any length: what decides where a ray meets the disk.
    #[must_use]
    pub fn upwards(&self) -> DVec3 {
        self.upwards
    }

    /// Its middle.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Its unit normal.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Its radius, greater than 0.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

impl Part for Disk {
    const NAME: &'static str = "disk";
    const DOC: &'static str = "A flat round disk, seen from both sides.";
    const FIELDS: &'static [Field] = &[
        Field::required("center", FieldKind::Point, "m", "The middle.").or(|| Value::Vector(DVec3::ZERO)),
        Field::required("normal", FieldKind::Direction, "", "Perpendicular to the disk.")
            .or(|| Value::Vector(DVec3::Y)),
        Field::required("radius", FieldKind::Length, "m", "Distance from the middle to the rim."),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (center, upwards) = (given.point("center")?, given.direction("normal")?);
        Ok(Self { center, upwards, normal: upwards.normalize(), radius: given.positive("radius")? })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("center", Value::Vector(self.center))
            .with("normal", Value::Vector(self.upwards))
            .with("radius", Value::Number(self.radius))
    }
}

impl Geometry for Disk {
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
        meet_disk(self.center, &Vector::of(self.upwards), self.radius, own)?
            .map_or(Ok(None), |root| FacetRoot::on(span, root, 0))
    }

    fn crossing(&self, _: &Ray, at: Located, facet: u32) -> Option<Crossing> {
        Some(Crossing::flat(at, self.normal, facet))
    }

    fn bounds(&self) -> Option<Aabb> {
        Some(disk_bounds(self.center, self.normal, self.radius))
    }

    fn placed(&self, placement: &Placement) -> Self {
        let upwards = placement.direction(self.upwards);
        Self {
            center: placement.point(self.center),
            upwards,
            normal: upwards.normalize(),
            radius: self.radius * placement.scale(),
        }
    }

    fn parametrization(&self, point: DVec3, _: u32) -> Parametrization {
        on_disk(point - self.center, self.normal, self.radius)
    }

    fn is_closed(&self) -> bool {
        false
    }
}

/// Where a ray meets the disk round a centre, perpendicular to a normal of any length; its rim belongs to it.
pub(super) fn meet_disk<N: Number>(
    center: DVec3,
    normal: &Vector<N>,
    radius: f64,
    ray: &Ray,
) -> Verdict<Option<Root<N>>> {
    let Some(root) = plane_root(center, normal, ray)? else { return Ok(None) };
    // From the centre to where the ray meets the plane, times the root's divisor.
    let from_center = Vector::of(ray.origin).minus(&Vector::of(center)).scaled(&root.divisor);
    let from_center = from_center.plus(&Vector::of(ray.direction).scaled(&root.rational));
    let reach = N::of(radius).times(&root.divisor);
    let is_beside = from_center.squared().minus(&reach.squared()).sign()?.is_gt();
    Ok(if is_beside { None } else { Some(root) })
}

/// The smallest box round a disk with a unit normal, to rounding.
pub(super) fn disk_bounds(center: DVec3, n: DVec3, radius: f64) -> Aabb {
    // Along an axis the rim reaches as far as the radius times the sine between axis and normal. The sine is taken
    // from the two other components: √(1 − n²) would lose half its digits where the disk nearly faces the axis.
    let half = DVec3::new(n.y.hypot(n.z), n.z.hypot(n.x), n.x.hypot(n.y)) * radius;
    Aabb { min: center - half, max: center + half }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_met_from_both_sides_and_ends_at_its_rim() {
        let disk = Disk::new(DVec3::Y, DVec3::Y * 7.0, 2.0).unwrap();
        for (from, along) in [(3.0, -1.0), (-1.0, 1.0)] {
            let at = |x| disk.cross(&Ray::new(DVec3::new(x, from, 0.0), DVec3::Y * along), Span::AHEAD, None);
            let hit = at(2.0).unwrap();
            assert_eq!((hit.t, hit.normal), (2.0, DVec3::Y));
            assert!(at(2.0 + 1e-15).is_none() && at(-2.1).is_none());
        }
    }

    #[test]
    fn a_ray_that_leaves_or_runs_within_it_does_not_meet_it() {
        let disk = Disk::new(DVec3::ZERO, DVec3::Y, 1.0).unwrap();
        assert!(disk.cross(&Ray::new(DVec3::Y * 1e-12, -DVec3::Y), Span::AHEAD, Some(0)).is_none());
        assert!(disk.cross(&Ray::new(DVec3::X * -3.0, DVec3::X), Span::AHEAD, None).is_none());
    }

    #[test]
    fn bounds_of_a_tilted_disk_touch_its_rim() {
        let disk = Disk::new(DVec3::ONE, DVec3::new(3.0, 4.0, 0.0), 10.0).unwrap();
        let bounds = disk.bounds().unwrap();
        assert!(bounds.min.distance(DVec3::new(-7.0, -5.0, -9.0)) < 1e-14, "{bounds:?}");
        assert!(bounds.max.distance(DVec3::new(9.0, 7.0, 11.0)) < 1e-14, "{bounds:?}");
    }

    #[test]
    fn bounds_of_a_disk_that_nearly_faces_an_axis_keep_its_thickness() {
        let disk = Disk::new(DVec3::ZERO, DVec3::new(1e-9, 1.0, 0.0), 1.0).unwrap();
        assert_eq!(disk.bounds().unwrap().max.y, 1e-9);
    }
}
