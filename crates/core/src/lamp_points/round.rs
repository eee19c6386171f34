//! Points on a sphere, evenly over the solid angle under which it is seen; and on a disk, evenly over its area.

use std::f64::consts::PI;

use glam::DVec3;

use super::Aimed;

/// The cap of a sphere that is seen from the origin outside it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cap {
    center: DVec3,
    radius: f64,
    axes: [DVec3; 3],
    distance: f64,
    /// 1 − the cosine of half its opening angle.
    depth: f64,
}

impl Cap {
    /// Round `center` at `radius`, relative to the point that it is seen from; `None` from within.
    pub(super) fn new(center: DVec3, radius: f64) -> Option<Self> {
        let distance = center.length();
        if !(distance > radius) {
            return None;
        }
        let axis = center / distance;
        let (right, up) = axis.any_orthonormal_pair();
        let sine2 = (radius / distance) * (radius / distance);
        let depth = sine2 / (1.0 + (1.0 - sine2).max(0.0).sqrt());
        Some(Self { center, radius, axes: [right, up, axis], distance, depth })
    }

    /// Cosine between the way to one of its points and the normal there.
    pub(super) fn slope(&self, to: DVec3) -> f64 {
        let normal = (self.center - to) / self.radius;
        normal.dot(to).abs() / to.length()
    }

    /// The point for two shares: the first picks the angle from the axis, the second the one about it.
    pub(super) fn point(&self, [u, v]: [f64; 2]) -> Aimed {
        let depth = u * self.depth;
        let sine = (depth * (2.0 - depth)).sqrt();
        let (about, across) = (v * 2.0 * PI).sin_cos();
        let [right, up, axis] = self.axes;
        let direction = right * (sine * across) + up * (sine * about) + axis * (1.0 - depth);
        // Where that direction enters the sphere: the near root in a form that keeps its digits.
        let middle = direction.dot(self.center);
        let aside = (self.center - direction * middle).length_squared();
        let half = (self.radius * self.radius - aside).max(0.0).sqrt();
        let near = (self.distance - self.radius) * (self.distance + self.radius) / (middle + half);
        Aimed { to: direction * near, solid: 2.0 * PI * self.depth }
    }
}

/// A disk as it is seen from the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Disk {
    center: DVec3,
    /// Two radii of it, and its unit normal.
    axes: [DVec3; 3],
    area: f64,
}

impl Disk {
    /// Round `center`, relative to the point that it is seen from.
    pub(super) fn new(center: DVec3, normal: DVec3, radius: f64) -> Self {
        let (right, up) = normal.any_orthonormal_pair();
        Self { center, axes: [right * radius, up * radius, normal], area: PI * radius * radius }
    }

    /// The point for two shares: the first picks the distance from the middle, the second the angle.
    pub(super) fn point(&self, [u, v]: [f64; 2]) -> Aimed {
        let (about, across) = (v * 2.0 * PI).sin_cos();
        let [right, up, normal] = self.axes;
        let to = self.center + (right * across + up * about) * u.sqrt();
        Aimed { to, solid: super::solid_of(self.area, normal, to) }
    }
}
