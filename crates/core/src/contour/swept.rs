//! Convex solids round an axis, cylinders, cones and capsules: where are they, and what do they hide?
//!
//! Seen from outside, such a solid is the hull of its two ends, disks or balls: both ends' outlines, and between them a flat
//! piece whose corners lie where the two planes through the eye touch the ends. Where no plane through the eye touches both
//! ends, one end hides the other.

use glam::{DVec2, DVec3};

use super::lamp::Round;
use crate::Shape;
use crate::geometry::{Capsule, Cone, Cylinder};
use crate::numeric::HELD_WITHIN;

/// A closed convex solid round an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Swept {
    pub ends: [DVec3; 2],
    pub radii: [f64; 2],
    /// Whether its ends are balls rather than disks.
    pub has_balls: bool,
    /// Unit vector from end to end.
    axis: DVec3,
    length: f64,
}

impl Swept {
    /// The solid that a shape is; `None` for any other shape, and for an open one.
    pub(super) fn of(shape: &Shape) -> Option<Self> {
        match shape {
            Shape::Cylinder(shape) if !shape.is_open() => Some(Self::of_cylinder(shape)),
            Shape::Cone(shape) if !shape.is_open() => Some(Self::of_cone(shape)),
            Shape::Capsule(shape) => Some(Self::of_capsule(shape)),
            _ => None,
        }
    }

    /// As if it were closed.
    pub(super) fn of_cylinder(shape: &Cylinder) -> Self {
        Self::new(shape.ends(), [shape.radius(); 2], false)
    }

    /// As if it were closed.
    pub(super) fn of_cone(shape: &Cone) -> Self {
        Self::new(shape.ends(), shape.radii(), false)
    }

    pub(super) fn of_capsule(shape: &Capsule) -> Self {
        Self::new(shape.ends(), [shape.radius(); 2], true)
    }

    fn new(ends: [DVec3; 2], radii: [f64; 2], has_balls: bool) -> Self {
        let along = ends[1] - ends[0];
        Self { ends, radii, has_balls, axis: along.normalize(), length: along.length() }
    }

    /// Middle and radius of a ball round it; the radius is rounded up.
    pub(super) fn ball(&self) -> (DVec3, f64) {
        let (middle, half) = (self.ends[0].midpoint(self.ends[1]), self.length / 2.0);
        let radius = self.radii[0].max(self.radii[1]);
        let reach = if self.has_balls { half + radius } else { half.hypot(radius) };
        (middle, reach + crate::numeric::EDGE_ROUNDING * (self.size() + reach))
    }

    /// The largest coordinate of its ends.
    fn size(&self) -> f64 {
        self.ends.map(|end| end.abs().max_element()).into_iter().fold(0.0, f64::max)
    }

    /// How far from it a point still counts as lying on it.
    pub(super) fn reach(&self, point: DVec3) -> f64 {
        let size = self.size() + self.length + self.radii[0].max(self.radii[1]);
        HELD_WITHIN * (point.abs().max_element() + size)
    }

    /// A point as its distance from the axis and its height, and the unit vector to it from the axis.
    fn profile(&self, point: DVec3) -> (DVec2, DVec3) {
        let from = point - self.ends[0];
        let height = from.dot(self.axis);
        let across = from - self.axis * height;
        let out = across.try_normalize().unwrap_or_else(|| self.axis.any_orthonormal_vector());
        (DVec2::new(across.length(), height), out)
    }

    /// The unit vector in the profile's plane that points away from the side.
    fn side_normal(&self) -> DVec2 {
        DVec2::new(self.length, self.radii[0] - self.radii[1]).normalize()
    }

    /// How far a point is from a facet (0: the side, 1 and 2: the ends) along the normal of that, outwards, and that normal; the
    /// largest of all is greater than 0 outside.
    fn above(&self, point: DVec3, facet: u32) -> (f64, DVec3) {
        let (place, out) = self.profile(point);
        let end = facet.saturating_sub(1).min(1) as usize;
        match facet {
            0 => {
                let normal = self.side_normal();
                let above = (place - DVec2::new(self.radii[0], 0.0)).dot(normal);
                (above, out * normal.x + self.axis * normal.y)
            }
            _ if self.has_balls => {
                let from = point - self.ends[end];
                (from.length() - self.radii[end], from.try_normalize().unwrap_or(out))
            }
            1 => (-place.y, -self.axis),
            _ => (place.y - self.length, self.axis),
        }
    }

    /// Which facets there are.
    fn facets(&self) -> impl Iterator<Item = u32> {
        let tip = !self.has_balls && self.radii[1] == 0.0;
        0..if tip { 2 } else { 3 }
    }

    /// The facet that decides whether a point is outside: that which it is highest above.
    fn decisive(&self, point: DVec3) -> (f64, DVec3) {
        let highest = |best: (f64, DVec3), next: (f64, DVec3)| if next.0 > best.0 { next } else { best };
        if self.has_balls {
            let (place, _) = self.profile(point);
            let facet = if place.y < 0.0 {
                1
            } else if place.y > self.length {
                2
            } else {
                0
            };
            return self.above(point, facet);
        }
        self.facets().map(|facet| self.above(point, facet)).fold((f64::NEG_INFINITY, DVec3::ZERO), highest)
    }

    /// Where a point lies: how far outside, and the outward normal of the nearest part of the surface; `None` beside a rim, where
    /// there is no one normal.
    pub(super) fn place(&self, point: DVec3) -> (f64, Option<DVec3>) {
        let (above, normal) = self.decisive(point);
        let near = |facet: u32| self.above(point, facet).0.abs() <= self.reach(point);
        let is_rim = !self.has_balls && self.facets().filter(|&facet| near(facet)).count() > 1;
        (above, (!is_rim).then_some(normal))
    }

    /// The outward unit normal of a facet at a point of it.
    pub(super) fn normal(&self, point: DVec3, facet: u32) -> DVec3 {
        self.above(point, facet).1
    }

    /// How far a point is from a facet.
    pub(super) fn distance(&self, point: DVec3, facet: u32) -> f64 {
        let (place, _) = self.profile(point);
        let rims = [DVec2::new(self.radii[0], 0.0), DVec2::new(self.radii[1], self.length)];
        let end = facet.saturating_sub(1).min(1) as usize;
        if facet == 0 {
            return to_stretch(rims, place);
        }
        if !self.has_balls {
            return to_stretch([DVec2::new(0.0, rims[end].y), rims[end]], place);
        }
        let is_beyond = if facet == 1 { place.y <= 0.0 } else { place.y >= self.length };
        if is_beyond { self.above(point, facet).0.abs() } else { place.distance(rims[end]) }
    }

    /// The point of it that is nearest to another.
    pub(super) fn nearest(&self, point: DVec3) -> DVec3 {
        let (place, out) = self.profile(point);
        if self.has_balls {
            let on_axis = self.ends[0] + self.axis * place.y.clamp(0.0, self.length);
            return on_axis + (point - on_axis).clamp_length_max(self.radii[0]);
        }
        if self.decisive(point).0 <= 0.0 {
            return point;
        }
        let [lower, upper] = [DVec2::new(self.radii[0], 0.0), DVec2::new(self.radii[1], self.length)];
        let sides = [[DVec2::ZERO, lower], [lower, upper], [DVec2::new(0.0, self.length), upper]];
        let nearest = sides
            .map(|side| on_stretch(side, place))
            .into_iter()
            .min_by(|a, b| a.distance_squared(place).total_cmp(&b.distance_squared(place)));
        nearest.map_or(point, |p| self.ends[0] + out * p.x + self.axis * p.y)
    }

    /// How far it reaches along a vector.
    pub(super) fn most_along(&self, vector: DVec3) -> f64 {
        let across = if self.has_balls { vector.length() } else { self.axis.cross(vector).length() };
        let along = |i: usize| vector.dot(self.ends[i]) + self.radii[i] * across;
        along(0).max(along(1))
    }

    /// The flat piece between both ends as seen from a point, by its corners in order; `None` where one end hides the other.
    ///
    /// A plane through the point touches the side along the line at u from the axis where u · w = r, with w what of the point lies
    /// across the axis and r the side's radius at its height.
    pub(super) fn between(&self, point: DVec3) -> Option<[DVec3; 4]> {
        let (place, out) = self.profile(point);
        let [lower, upper] = self.radii;
        let radius = lower + (upper - lower) * (place.y / self.length);
        let cosine = radius / place.x;
        if !(cosine.abs() < 1.0) {
            return None;
        }
        // √((w − r)(w + r)) / w keeps its digits near the side.
        let sine = ((place.x - radius) * (place.x + radius)).sqrt() / place.x;
        let [ahead, aside] = [out * cosine, self.axis.cross(out) * sine];
        let [u, v] = [ahead + aside, ahead - aside];
        let [from, to] = self.ends;
        Some([from + u * lower, to + u * upper, to + v * upper, from + v * lower])
    }

    /// The disk at an end, where that is one.
    pub(super) fn disk(&self, end: usize) -> Round {
        Round { center: self.ends[end], normal: self.axis, radius: self.radii[end] }
    }
}

fn on_stretch([a, b]: [DVec2; 2], p: DVec2) -> DVec2 {
    let along = b - a;
    let share = (p - a).dot(along) / along.length_squared();
    if share.is_finite() { a + along * share.clamp(0.0, 1.0) } else { a }
}

fn to_stretch(stretch: [DVec2; 2], p: DVec2) -> f64 {
    on_stretch(stretch, p).distance(p)
}
