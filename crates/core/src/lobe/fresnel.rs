//! How much light does a smooth boundary reflect? Fresnel's formulas for clear matter, and a two-colour form of them for metals.
//!
//! Metals: the F82-tint form (Kutz, Hašan and Edmondson, "Novel aspects of the Adobe Standard Material", 2021; Hoffman,
//! "Fresnel equations considered harmful", MAM 2019): Schlick's curve from the colour at normal incidence, less a dip that
//! multiplies it by the edge colour at the angle of cosine 1/7, about 82°.

use crate::Rgb;
use crate::numeric::LEAST_INDEX_STEP;

use super::quadrature::mean_over_cosines;

/// Share of unpolarised light that the boundary between two clear media reflects: the mean of both polarisations. `cosine` in
/// 0..=1 is that of the angle to the normal on the side that the light is on, `eta` the index of refraction beyond over that
/// on this side. 1 for total reflection.
#[must_use]
pub fn dielectric(cosine: f64, eta: f64) -> f64 {
    let cosine = cosine.clamp(0.0, 1.0);
    match transmitted_cosine(cosine, eta) {
        Some(beyond) => {
            let across = (cosine - eta * beyond) / (cosine + eta * beyond);
            let along = (eta * cosine - beyond) / (eta * cosine + beyond);
            f64::midpoint(across * across, along * along)
        }
        None => 1.0,
    }
}

/// Cosine of the angle to the normal beyond the boundary (Snell); `None` for total reflection.
#[must_use]
pub fn transmitted_cosine(cosine: f64, eta: f64) -> Option<f64> {
    let sine2 = (1.0 - cosine * cosine).max(0.0) / (eta * eta);
    (sine2 < 1.0).then(|| (1.0 - sine2).sqrt())
}

/// What [`dielectric`] reflects of light that comes from everywhere alike: its mean, weighted by twice the cosine. For
/// `eta` of at least 1.
#[must_use]
pub fn mean_dielectric(eta: f64) -> f64 {
    mean_over_cosines(|cosine| dielectric(cosine, eta))
}

/// The largest ratio of indices of refraction that opaque matter is given: germanium in air has 4, and from here on all are
/// mirrors.
pub const LARGEST_ETA: f64 = 9.0;

/// Whether two media are one, optically.
#[must_use]
pub fn is_no_boundary(eta: f64) -> bool {
    (eta - 1.0).abs() < LEAST_INDEX_STEP
}

/// A boundary, and how much it reflects by channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fresnel {
    /// The same at every angle.
    Constant(Rgb),
    /// Metal.
    Metal {
        /// At normal incidence.
        color: Rgb,
        /// Strength of the dip near 82°.
        dip: Rgb,
    },
    /// Clear matter: `base + slope · F`, with F of [`dielectric`].
    Dielectric {
        /// Index of refraction beyond over that on this side, at least 1.
        eta: f64,
        /// Reflected at any angle.
        base: Rgb,
        /// Times Fresnel's share.
        slope: Rgb,
    },
}

impl Fresnel {
    /// A metal that reflects `color` at normal incidence and Schlick's curve times `edge` at 82°.
    #[must_use]
    pub fn metal(color: Rgb, edge: Rgb) -> Self {
        let cosine: f64 = 1.0 / 7.0;
        let rest = 1.0 - cosine;
        let schlick = color + (Rgb::WHITE - color) * rest.powi(5);
        Self::Metal { color, dip: schlick * (Rgb::WHITE - edge) / (cosine * rest.powi(6)) }
    }

    /// The surface of opaque matter of that index of refraction, relative to what is round it: from 1 to [`LARGEST_ETA`], or as
    /// the nearer of these.
    #[must_use]
    pub const fn clear(eta: f64) -> Self {
        Self::Dielectric { eta: eta.clamp(1.0, LARGEST_ETA), base: Rgb::BLACK, slope: Rgb::WHITE }
    }

    /// The same, whose reflection is scaled by `strength` at all angles and by `color` at normal incidence, each in 0..=1: as
    /// glTF's `KHR_materials_specular` has it, with Fresnel's curve in place of Schlick's.
    #[must_use]
    pub fn specular(eta: f64, strength: f64, color: Rgb) -> Self {
        let eta = eta.clamp(1.0, LARGEST_ETA);
        let head_on = dielectric(1.0, eta);
        // From F0 · color at F = F0 to 1 at F = 1.
        let slope = (Rgb::WHITE - color * head_on) / (1.0 - head_on);
        let base = (color - slope) * head_on;
        Self::Dielectric { eta, base: base * strength, slope: slope * strength }
    }

    /// Share that is reflected at that cosine to the normal, 0..=1.
    #[must_use]
    pub fn at(&self, cosine: f64) -> Rgb {
        match *self {
            Self::Constant(color) => color,
            Self::Metal { color, dip } => {
                let cosine = cosine.clamp(0.0, 1.0);
                let rest = 1.0 - cosine;
                let fifth = rest.powi(5);
                let schlick = color + (Rgb::WHITE - color) * fifth;
                (schlick - dip * (cosine * fifth * rest)).map(|share| share.max(0.0))
            }
            Self::Dielectric { eta, base, slope } => {
                (base + slope * dielectric(cosine, eta)).map(|share| share.max(0.0))
            }
        }
    }

    /// Share of light that comes from everywhere alike: the mean, weighted by twice the cosine.
    #[must_use]
    pub fn mean(&self) -> Rgb {
        match *self {
            Self::Constant(color) => color,
            // ∫ 2µ (1 − µ)⁵ = 1/21, ∫ 2µ² (1 − µ)⁶ = 1/126.
            Self::Metal { color, dip } => color + (Rgb::WHITE - color) / 21.0 - dip / 126.0,
            Self::Dielectric { eta, base, slope } => base + slope * mean_dielectric(eta),
        }
    }
}
