//! Points on a rectangle, evenly over the solid angle under which it is seen.
//!
//! Ureña, Fajardo and King, "An area-preserving parametrization for spherical rectangles", EGSR 2013.

use std::f64::consts::PI;

use glam::DVec3;

use super::Aimed;

/// A rectangle as it is seen from the origin, in axes along its edges.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quad {
    axes: [DVec3; 3],
    /// Where its edges lie along the first two axes, and how far away its plane is along the third (not positive).
    x: [f64; 2],
    y: [f64; 2],
    z: f64,
    /// Third components of the inward unit normals of the planes through the edges along the first axis.
    edge: [f64; 2],
    /// Where the angle that is drawn evenly begins.
    first: f64,
    /// Solid angle, sr.
    solid: f64,
}

impl Quad {
    /// The rectangle with a corner and two edges from it, all relative to the point that it is seen from; `None` where its
    /// solid angle is lost to rounding.
    pub(super) fn new(corner: DVec3, edges: [DVec3; 2], smallest: f64) -> Option<Self> {
        let lengths = edges.map(DVec3::length);
        let [along, up] = [edges[0] / lengths[0], edges[1] / lengths[1]];
        let mut away = along.cross(up);
        let mut z = corner.dot(away);
        if z > 0.0 {
            (away, z) = (-away, -z);
        }
        let (x, y) = (corner.dot(along), corner.dot(up));
        let (x, y) = ([x, x + lengths[0]], [y, y + lengths[1]]);
        // Components along `away` of the unit normals of the planes through the edges, which face inwards.
        let [low, high] = [-y[0] / y[0].hypot(z), y[1] / y[1].hypot(z)];
        let [left, right] = [-x[0] / x[0].hypot(z), x[1] / x[1].hypot(z)];
        let angle = |a: f64, b: f64| (-a * b).clamp(-1.0, 1.0).acos();
        let first = 2.0 * PI - angle(high, left) - angle(left, low);
        let solid = angle(low, right) + angle(right, high) - first;
        let edge = [low, high];
        (solid > smallest).then_some(Self { axes: [along, up, away], x, y, z, edge, first, solid })
    }

    /// The point for two shares.
    pub(super) fn point(&self, [u, v]: [f64; 2]) -> Aimed {
        let angle = u.mul_add(self.solid, self.first);
        let slope = (angle.cos() * self.edge[0] - self.edge[1]) / angle.sin();
        let cosine = (1.0 / slope.hypot(self.edge[0])).copysign(slope).clamp(-1.0, 1.0);
        let x = (-(cosine * self.z) / (1.0 - cosine * cosine).sqrt()).clamp(self.x[0], self.x[1]);
        let distance = x.hypot(self.z);
        let [low, high] = self.y.map(|y| y / distance.hypot(y));
        let sine = v.mul_add(high - low, low);
        let y = (sine * distance / (1.0 - sine * sine).sqrt()).clamp(self.y[0], self.y[1]);
        let to = self.axes[0] * x + self.axes[1] * y + self.axes[2] * self.z;
        Aimed { to, solid: self.solid }
    }
}
