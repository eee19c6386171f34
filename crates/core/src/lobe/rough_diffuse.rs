//! Light scattered by a rough matte surface: Oren and Nayar's, made to keep its energy.
//!
//! Portsmouth, Kutz and Hill, "EON: a practical energy-preserving rough diffuse BRDF", JCGT 14(1), 2025, with the exact albedo of
//! Fujii's form of single scattering.

use std::f64::consts::PI;

use glam::DVec3;

use super::hemisphere::Disk;
use super::local::{LocalLobe, LocalSample};
use crate::Rgb;

/// A rough matte surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughDiffuse {
    /// Albedo of the matter, which that of a rough surface lies under, but for 0 and 1.
    color: Rgb,
    /// Single scattering of white matter is `even` + `slope` · (what the angles say), over π.
    even: f64,
    slope: f64,
    /// Its mean albedo.
    mean: f64,
}

impl RoughDiffuse {
    /// With an albedo and a roughness in 0..=1.
    #[must_use]
    pub fn new(color: Rgb, roughness: f64) -> Self {
        let even = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness);
        let mean = even * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * roughness);
        Self { color, even, slope: roughness * even, mean }
    }

    /// Albedo of single scattering for white matter, seen under a cosine.
    fn once(&self, cosine: f64) -> f64 {
        let cosine = cosine.clamp(0.0, 1.0);
        let sine = (1.0 - cosine * cosine).sqrt();
        // (tan θ)(1 − sin³ θ), without the quotient of two small numbers.
        let rest = sine * cosine * (1.0 + sine + sine * sine) / (1.0 + sine);
        let angles = sine * (cosine.acos() - sine * cosine) + 2.0 / 3.0 * (rest - sine);
        self.even + self.slope / PI * angles
    }

    /// What of light scattered more than once is left.
    fn again(&self) -> Rgb {
        self.color.map(|c| c * c * self.mean / (1.0 - c * (1.0 - self.mean)))
    }
}

impl LocalLobe for RoughDiffuse {
    fn evaluate(&self, o: DVec3, i: DVec3) -> Rgb {
        if !(i.z > 0.0) {
            return Rgb::BLACK;
        }
        let across = o.dot(i) - o.z * i.z;
        let angles = if across > 0.0 { across / o.z.max(i.z) } else { across };
        let single = self.color * (self.even + self.slope * angles);
        let lost = (1.0 - self.once(o.z)) * (1.0 - self.once(i.z));
        // A smooth surface loses nothing.
        let multiple = if self.mean < 1.0 { self.again() * (lost / (1.0 - self.mean)) } else { Rgb::BLACK };
        (single + multiple) * (i.z / PI)
    }

    fn pdf(&self, _: DVec3, i: DVec3) -> f64 {
        i.z.max(0.0) / PI
    }

    fn sample(&self, _: DVec3, _: f64, u: [f64; 2]) -> Option<LocalSample> {
        let disk = Disk::at(u);
        let cosine = (1.0 - disk.radius * disk.radius).max(0.0).sqrt();
        (cosine > 0.0).then_some(LocalSample::spread(disk.raised(disk.radius, cosine).into()))
    }

    fn albedo(&self, o: DVec3) -> Rgb {
        let once = self.once(o.z);
        self.color * once + self.again() * (1.0 - once)
    }
}
