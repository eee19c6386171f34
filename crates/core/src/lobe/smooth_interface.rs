//! The boundary between two clear media: light is mirrored in part, and in part bent (Snell, Fresnel).

use glam::DVec3;

use super::fresnel::{dielectric, transmitted_cosine};
use super::local::{LocalLobe, LocalSample, Rays, mirrored};
use crate::Rgb;

/// A smooth boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmoothInterface {
    /// Index of refraction beyond over that on the viewer's side.
    pub eta: f64,
    /// Share of bent light that gets through, by channel.
    pub tint: Rgb,
}

impl SmoothInterface {
    /// Where bent light comes from; `None` for total reflection.
    fn refracted(&self, o: DVec3) -> Option<DVec3> {
        let beyond = transmitted_cosine(o.z, self.eta)?;
        DVec3::new(-o.x / self.eta, -o.y / self.eta, -beyond).try_normalize()
    }
}

impl LocalLobe for SmoothInterface {
    /// One of the two, as likely as it is strong.
    fn sample(&self, o: DVec3, choose: f64, _: [f64; 2]) -> Option<LocalSample> {
        if choose < dielectric(o.z, self.eta) {
            return Some(LocalSample { direction: mirrored(o), delta: Some(Rgb::WHITE), eta: 1.0 });
        }
        let direction = self.refracted(o)?;
        Some(LocalSample { direction, delta: Some(self.tint), eta: self.eta })
    }

    fn albedo(&self, o: DVec3) -> Rgb {
        let reflected = dielectric(o.z, self.eta);
        Rgb::grey(reflected) + self.tint * (1.0 - reflected)
    }

    fn rays(&self, o: DVec3) -> Rays {
        let reflected = dielectric(o.z, self.eta);
        let refracted = self.refracted(o).map(|direction| (direction, self.tint * (1.0 - reflected)));
        Rays { mirrored: Rgb::grey(reflected), refracted, straight: Rgb::BLACK }
    }

    fn ambient(&self, _: DVec3) -> Rgb {
        Rgb::BLACK
    }
}
