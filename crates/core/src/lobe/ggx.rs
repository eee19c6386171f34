//! How are the slopes of a rough surface spread, and which of them are seen? The GGX distribution and its visible normals.
//!
//! Walter, Marschner, Li and Torrance, "Microfacet models for refraction through rough surfaces", EGSR 2007; masking and
//! shadowing after Heitz, JCGT 3(2), 2014; visible normals by spherical caps after Dupuy and Benyoub, "Sampling visible GGX
//! normals with spherical caps", HPG 2023.

use std::f64::consts::PI;

use glam::DVec3;

/// A GGX surface: an ellipsoid's normals, in the local frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ggx {
    /// Typical slope along x, greater than 0.
    x: f64,
    /// Typical slope along y, greater than 0.
    y: f64,
}

impl Ggx {
    /// With typical slopes α along x and y, each at least [`SMOOTH_SLOPE`](crate::numeric::SMOOTH_SLOPE) and at most 1.
    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// Alike in all directions.
    #[must_use]
    pub const fn isotropic(alpha: f64) -> Self {
        Self::new(alpha, alpha)
    }

    /// The one slope of a surface that is as rough alike in all directions.
    #[must_use]
    pub fn alpha(&self) -> f64 {
        (self.x * self.y).sqrt()
    }

    /// Whether it is rougher along one direction than along another.
    #[must_use]
    pub fn is_stretched(&self) -> bool {
        self.x != self.y
    }

    /// Area of facets with normals round `h`, per area of surface and solid angle.
    #[must_use]
    pub fn density(&self, h: DVec3) -> f64 {
        let stretched = DVec3::new(h.x / self.x, h.y / self.y, h.z).length_squared();
        1.0 / (PI * self.x * self.y * stretched * stretched)
    }

    /// Smith's Λ: hidden area over seen area of the facets that face `v`.
    #[must_use]
    pub fn hidden(&self, v: DVec3) -> f64 {
        let (x, y) = (self.x * v.x, self.y * v.y);
        let slope2 = (x * x + y * y) / (v.z * v.z);
        if slope2 < f64::INFINITY {
            // (√(1 + a) − 1) / 2 without cancellation.
            0.5 * slope2 / ((1.0 + slope2).sqrt() + 1.0)
        } else {
            f64::INFINITY
        }
    }

    /// Share of facets seen from `o` that are seen from `i` as well, in 0..=1: both see the same heights better (Smith's
    /// height-correlated form over the masking of `o`).
    #[must_use]
    pub fn seen_from_both(&self, o: DVec3, i: DVec3) -> f64 {
        let (o, i) = (self.hidden(o), self.hidden(i));
        (1.0 + o) / (1.0 + o + i)
    }

    /// Density of normals [seen](Self::visible_normal) from `o`, per solid angle.
    #[must_use]
    pub fn visible_density(&self, o: DVec3, h: DVec3) -> f64 {
        o.dot(h).max(0.0) * self.density(h) / (o.z * (1.0 + self.hidden(o)))
    }

    /// A normal of those that are seen from `o`, as dense as they are seen, chosen by two numbers in 0..1.
    #[must_use]
    pub fn visible_normal(&self, o: DVec3, [turn, along]: [f64; 2]) -> DVec3 {
        let (sin, cos) = (2.0 * PI * turn).sin_cos();
        self.normal_on_cap(self.stretched(o), [cos, sin], along)
    }

    /// A direction as it is seen where this surface is stretched to a half sphere.
    pub(super) fn stretched(&self, o: DVec3) -> DVec3 {
        DVec3::new(o.x * self.x, o.y * self.y, o.z).normalize()
    }

    /// The visible normal that belongs to a direction mirrored by the half sphere: those are spread evenly over a cap.
    pub(super) fn normal_on_cap(&self, stretched: DVec3, turn: [f64; 2], along: f64) -> DVec3 {
        let z = (1.0 - along) * (1.0 + stretched.z) - stretched.z;
        let across = (1.0 - z * z).max(0.0).sqrt();
        let h = DVec3::new(across * turn[0], across * turn[1], z) + stretched;
        // Only where the cap's rim is hit to the last digit is there nothing to normalise.
        DVec3::new(h.x * self.x, h.y * self.y, h.z.max(0.0)).try_normalize().unwrap_or(DVec3::Z)
    }

    /// Density of directions mirrored about [visible normals](Self::visible_normal), per solid angle; 0 below the surface.
    #[must_use]
    pub fn reflected_density(&self, o: DVec3, i: DVec3) -> f64 {
        match (o + i).try_normalize() {
            Some(h) if i.z > 0.0 => self.density(h) / (4.0 * o.z * (1.0 + self.hidden(o))),
            _ => 0.0,
        }
    }
}
