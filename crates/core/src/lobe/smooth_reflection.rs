//! Perfect reflection, as strong as the angle has it.

use glam::DVec3;

use super::fresnel::Fresnel;
use super::local::{LocalLobe, LocalSample, Rays, mirrored};
use crate::Rgb;

/// All light comes from the mirrored direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmoothReflection {
    /// Share of light that is reflected.
    pub fresnel: Fresnel,
}

impl LocalLobe for SmoothReflection {
    fn sample(&self, o: DVec3, _: f64, _: [f64; 2]) -> Option<LocalSample> {
        Some(LocalSample { direction: mirrored(o), delta: Some(self.albedo(o)), eta: 1.0 })
    }

    fn albedo(&self, o: DVec3) -> Rgb {
        self.fresnel.at(o.z)
    }

    fn rays(&self, o: DVec3) -> Rays {
        Rays { mirrored: self.albedo(o), ..Rays::default() }
    }

    fn ambient(&self, _: DVec3) -> Rgb {
        Rgb::BLACK
    }
}
