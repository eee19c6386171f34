//! A surface that reflects, smooth or rough: which lobe is it, and how much does it leave for what is below?

use glam::DVec3;

use super::fresnel::Fresnel;
use super::ggx::Ggx;
use super::{BsdfLobe, GgxReflection, SmoothReflection};
use crate::Rgb;
use crate::numeric::SMOOTH_SLOPE;

use super::albedo::{CapPoints, Interface, kept_by_reflection, mean_lost_by_reflection};

/// How rough a surface is, as people give it: slopes are the square of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughness {
    /// Typical slopes along x and y.
    slopes: [f64; 2],
}

impl Roughness {
    /// The same in all directions, 0..=1.
    #[must_use]
    pub const fn new(roughness: f64) -> Self {
        Self { slopes: [roughness * roughness; 2] }
    }

    /// Rougher along x by `anisotropy` in 0..=1, as glTF's `KHR_materials_anisotropy` has it: slopes across stay as they are, those
    /// along x grow to 1.
    #[must_use]
    pub fn stretched(roughness: f64, anisotropy: f64) -> Self {
        let slope = roughness * roughness;
        Self { slopes: [slope + (1.0 - slope) * anisotropy * anisotropy, slope] }
    }

    /// The facets; `None` where they are all but smooth.
    #[must_use]
    pub fn facets(self) -> Option<Ggx> {
        let [x, y] = self.slopes;
        (x.max(y) >= SMOOTH_SLOPE).then(|| Ggx::new(x.max(SMOOTH_SLOPE), y.max(SMOOTH_SLOPE)))
    }
}

/// A surface that reflects a share of light and lets the rest go where it may.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boundary {
    facets: Option<Ggx>,
    fresnel: Fresnel,
}

impl Boundary {
    /// As rough as that, of facets that reflect so.
    #[must_use]
    pub fn new(roughness: Roughness, fresnel: Fresnel) -> Self {
        Self { facets: roughness.facets(), fresnel }
    }

    /// The facets, unless it is smooth.
    #[must_use]
    pub const fn facets(&self) -> Option<Ggx> {
        self.facets
    }

    /// Its own reflection.
    #[must_use]
    pub fn lobe(&self) -> BsdfLobe {
        let fresnel = self.fresnel;
        match self.facets {
            Some(ggx) => GgxReflection { ggx, fresnel }.into(),
            None => SmoothReflection { fresnel }.into(),
        }
    }

    /// Share of light that its lobe reflects in all, seen under a cosine.
    #[must_use]
    pub fn reflected(&self, cosine: f64) -> Rgb {
        match self.facets {
            Some(ggx) => GgxReflection { ggx, fresnel: self.fresnel }.reflected(cosine),
            None => self.fresnel.at(cosine),
        }
    }

    /// Share of light that its lobe reflects to `o`, by quadrature; `None` where it is alike in all directions.
    pub(super) fn computed(&self, o: DVec3) -> Option<Rgb> {
        let ggx = self.facets.filter(Ggx::is_stretched)?;
        let channel = |pick: fn(Rgb) -> f64| {
            kept_by_reflection(CapPoints::few(), &ggx, o, |cosine| pick(self.fresnel.at(cosine)))
        };
        Some(Rgb::new(channel(|c| c.r), channel(|c| c.g), channel(|c| c.b)))
    }

    /// The mean of [`reflected`](Self::reflected), weighted by twice the cosine.
    #[must_use]
    pub fn mean_reflected(&self) -> Rgb {
        let Some(ggx) = self.facets else { return self.fresnel.mean() };
        let kept = || 1.0 - mean_lost_by_reflection(ggx.alpha());
        match self.fresnel {
            Fresnel::Dielectric { eta, base, slope } => {
                slope * Interface::new(ggx.alpha(), eta).mean_reflected() + base * kept()
            }
            Fresnel::Constant(_) | Fresnel::Metal { .. } => self.fresnel.mean() * kept(),
        }
    }
}
