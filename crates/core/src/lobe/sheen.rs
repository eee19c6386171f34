//! The soft rim of cloth: fibres that stand up and scatter light where they are seen from the side.
//!
//! Estevez and Kulla, "Production friendly microfacet sheen BRDF", SIGGRAPH 2017 course: normals are spread as a power of their sine,
//! and the shadowing is their fit to it. Its albedo is tabled, so that what is below can be dimmed by it.

use std::f64::consts::PI;

use glam::DVec3;

use super::albedo::{most_sheen, sheen_albedo};
use super::local::{LocalLobe, LocalSample};
use crate::Rgb;

/// A layer of white fibres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sheen {
    alpha: f64,
    /// What the formula is multiplied by, so that narrow rims show no more than all light.
    strength: f64,
}

/// The least slope, a roughness of 0.2.
const LEAST: f64 = 0.2 * 0.2;

/// The fit at slope 0 and 1: L(x) = a/(1 + b x^c) + d x + e.
const FIT: [[f64; 5]; 2] =
    [[25.3245, 3.32435, 0.16801, -1.27393, -4.85967], [21.5473, 3.82987, 0.19823, -1.97760, -4.32054]];

impl Sheen {
    /// With a roughness in 0..=1; below 0.2 counts as 0.2.
    #[must_use]
    pub fn new(roughness: f64) -> Self {
        let formula = Self::by_formula((roughness * roughness).max(LEAST));
        Self { strength: 1.0 / most_sheen(formula.alpha.sqrt()).max(1.0), ..formula }
    }

    /// Of that slope, as strong as the formula has it.
    pub(super) const fn by_formula(alpha: f64) -> Self {
        Self { alpha, strength: 1.0 }
    }

    /// Share of light that it scatters to a viewer under that cosine to the normal.
    #[must_use]
    pub fn scattered(&self, cosine: f64) -> f64 {
        (sheen_albedo(self.alpha.sqrt(), cosine) * self.strength).min(1.0)
    }

    /// Λ: hidden area over seen area of the fibres that face a direction under that cosine.
    pub(super) fn hidden(&self, cosine: f64) -> f64 {
        let smooth = (1.0 - self.alpha) * (1.0 - self.alpha);
        let [a, b, c, d, e] = std::array::from_fn(|k| smooth * FIT[0][k] + (1.0 - smooth) * FIT[1][k]);
        let fit = |x: f64| a / (1.0 + b * x.powf(c)) + d * x + e;
        let cosine = cosine.clamp(0.0, 1.0);
        (if cosine < 0.5 { fit(cosine) } else { 2.0 * fit(0.5) - fit(1.0 - cosine) }).exp()
    }

    /// Density of fibre normals under that cosine, per area and solid angle.
    pub(super) fn density(&self, cosine: f64) -> f64 {
        let sine2 = (1.0 - cosine * cosine).max(0.0);
        (2.0 + 1.0 / self.alpha) * sine2.powf(0.5 / self.alpha) / (2.0 * PI)
    }
}

impl LocalLobe for Sheen {
    fn evaluate(&self, o: DVec3, i: DVec3) -> Rgb {
        let Some(h) = (o + i).try_normalize().filter(|_| i.z > 0.0) else { return Rgb::BLACK };
        let seen = 1.0 / (1.0 + self.hidden(o.z) + self.hidden(i.z));
        Rgb::grey(self.strength * self.density(h.z) * seen / (4.0 * o.z))
    }

    fn pdf(&self, _: DVec3, i: DVec3) -> f64 {
        if i.z > 0.0 { 1.0 / (2.0 * PI) } else { 0.0 }
    }

    /// All over the half sphere alike.
    fn sample(&self, _: DVec3, _: f64, [turn, z]: [f64; 2]) -> Option<LocalSample> {
        let across = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = (2.0 * PI * turn).sin_cos();
        (z > 0.0).then_some(LocalSample::spread(DVec3::new(across * cos, across * sin, z)))
    }

    fn albedo(&self, o: DVec3) -> Rgb {
        Rgb::grey(self.scattered(o.z))
    }
}
