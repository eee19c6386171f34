//! Reflection by facets with GGX slopes: a highlight, blurred as the surface is rough.
//!
//! What facets shadow is lost here, and given back by a [`Complement`](super::Complement).

use glam::DVec3;

use super::albedo::{Interface, lost_by_reflection};
use super::fresnel::Fresnel;
use super::ggx::Ggx;
use super::local::{LocalLobe, LocalSample, Rays};
use crate::Rgb;
use crate::optics::reflect;

/// Reflection of a rough surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GgxReflection {
    /// Its facets.
    pub ggx: Ggx,
    /// Share of light that each facet reflects.
    pub fresnel: Fresnel,
}

/// The roughness, √α, from which an integrator of single rays sees no mirror image in a surface.
const NO_IMAGE: f64 = 0.4;

impl GgxReflection {
    /// What is shown in an even surrounding of radiance 1, seen under a cosine: to a thousandth for clear matter, whose table has
    /// it, and for what reflects alike at every angle; near enough for coloured metal.
    #[must_use]
    pub fn reflected(&self, cosine: f64) -> Rgb {
        let alpha = self.ggx.alpha();
        let kept = || 1.0 - lost_by_reflection(alpha, cosine);
        match self.fresnel {
            Fresnel::Dielectric { eta, base, slope } => {
                let slope = slope * Interface::new(alpha, eta).reflected(cosine);
                if base == Rgb::BLACK {
                    slope
                } else {
                    (slope + base * kept()).map(|share| share.clamp(0.0, 1.0))
                }
            }
            _ => self.fresnel.at(cosine) * kept(),
        }
    }

    /// Share of what it shows that an integrator of single rays looks for in the mirrored direction.
    fn imaged(&self) -> f64 {
        let left = (1.0 - self.ggx.alpha().sqrt() / NO_IMAGE).max(0.0);
        left * left
    }
}

/// Cosine of half the angle between two unit vectors: that of each of them to the facet that mirrors one into the other.
#[must_use]
pub(super) fn half_angle_cosine(o: DVec3, i: DVec3) -> f64 {
    (0.5 + 0.5 * o.dot(i)).max(0.0).sqrt()
}

impl LocalLobe for GgxReflection {
    fn evaluate(&self, o: DVec3, i: DVec3) -> Rgb {
        let density = self.pdf(o, i);
        if !(density > 0.0) {
            return Rgb::BLACK;
        }
        self.fresnel.at(half_angle_cosine(o, i)) * (density * self.ggx.seen_from_both(o, i))
    }

    fn pdf(&self, o: DVec3, i: DVec3) -> f64 {
        self.ggx.reflected_density(o, i)
    }

    fn sample(&self, o: DVec3, _: f64, u: [f64; 2]) -> Option<LocalSample> {
        let h = self.ggx.visible_normal(o, u);
        let direction = DVec3::from(reflect((-o).into(), h.into()));
        (direction.z > 0.0).then_some(LocalSample::spread(direction))
    }

    fn albedo(&self, o: DVec3) -> Rgb {
        self.reflected(o.z)
    }

    fn rays(&self, o: DVec3) -> Rays {
        Rays { mirrored: self.albedo(o) * self.imaged(), ..Rays::default() }
    }

    fn ambient(&self, o: DVec3) -> Rgb {
        self.albedo(o) * (1.0 - self.imaged())
    }
}
