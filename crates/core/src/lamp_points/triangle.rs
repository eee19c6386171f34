//! Points on a triangle, evenly over the solid angle under which it is seen.
//!
//! Arvo, "Stratified sampling of spherical triangles", SIGGRAPH 1995.

use std::f64::consts::PI;

use glam::DVec3;

use super::Aimed;

/// A triangle as it is seen from the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle {
    /// Unit vectors to its corners.
    corners: [DVec3; 3],
    /// Unit vector in the plane of the first and the last corner, across the first.
    across: DVec3,
    /// Angle at the first corner, with its sine and cosine.
    angle: f64,
    sine: f64,
    cosine: f64,
    /// Cosine of the side from the first to the second corner.
    side: f64,
    /// A corner and the normal of its plane, of any length.
    plane: [DVec3; 2],
    /// Solid angle, sr.
    solid: f64,
}

impl Triangle {
    /// The triangle with those corners, relative to the point that it is seen from; `None` where its solid angle is lost
    /// to rounding.
    pub(super) fn new(corners: [DVec3; 3], smallest: f64) -> Option<Self> {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let unit = corners.map(DVec3::normalize_or_zero);
        let [a, b, c] = unit;
        // Unit normals of the planes through the sides.
        let [ab, bc, ca] = [a.cross(b), b.cross(c), c.cross(a)].map(DVec3::normalize_or_zero);
        let between = |a: DVec3, b: DVec3| a.cross(b).length().atan2(-a.dot(b));
        let (angle, second, third) = (between(ab, ca), between(bc, ab), between(ca, bc));
        let solid = angle + second + third - PI;
        let across = (c - a * c.dot(a)).try_normalize()?;
        let (sine, cosine) = angle.sin_cos();
        let side = a.dot(b);
        (solid > smallest).then_some(Self {
            corners: unit,
            across,
            angle,
            sine,
            cosine,
            side,
            plane: [corners[0], normal],
            solid,
        })
    }

    /// The point for two shares.
    pub(super) fn point(&self, [u, v]: [f64; 2]) -> Aimed {
        let [a, b, _] = self.corners;
        // The part of the triangle with the share u of its solid angle that is cut off by a side from the second corner.
        let (s, t) = (u * self.solid - self.angle).sin_cos();
        let (p, q) = (t - self.cosine, self.sine.mul_add(self.side, s));
        let along = ((q * t - p * s) * self.cosine - q) / ((q * s + p * t) * self.sine);
        let along = along.clamp(-1.0, 1.0);
        let third = a * along + self.across * (1.0 - along * along).max(0.0).sqrt();
        // On that side, evenly in the cosine from the second corner.
        let height = 1.0 - v * (1.0 - third.dot(b));
        let aside = (third - b * third.dot(b)).normalize_or_zero();
        let direction = b * height + aside * (1.0 - height * height).max(0.0).sqrt();
        let [on, normal] = self.plane;
        Aimed { to: direction * (on.dot(normal) / direction.dot(normal)), solid: self.solid }
    }
}
