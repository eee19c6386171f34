//! A wall of clear matter too thin to bend light: both of its faces at once, with all light that goes to and fro between them.
//!
//! A face reflects F, and what goes through the matter is multiplied by t. Summed over all orders the wall reflects
//! F + (1 − F)² F t²/(1 − F² t²) and lets (1 − F)² t/(1 − F² t²) through, without absorption 2F/(1 + F) and (1 − F)/(1 + F).

use glam::DVec3;

use super::fresnel::{dielectric, transmitted_cosine};
use super::ggx::Ggx;
use super::ggx_reflection::half_angle_cosine;
use super::local::{LocalLobe, LocalSample, Rays, mirrored};
use super::quadrature::mean_over_cosines;
use crate::Rgb;
use crate::optics::reflect;

/// A thin wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinWall {
    /// Index of refraction of the matter over that of what is round it.
    pub eta: f64,
    /// What of light that goes straight through the matter is left.
    pub tint: Rgb,
    /// The facets of its faces, which scatter what is reflected and what goes through alike; `None` for smooth ones.
    pub facets: Option<Ggx>,
}

impl ThinWall {
    /// Shares of light that are reflected and let through, under a cosine to the normal.
    #[must_use]
    pub fn shares(&self, cosine: f64) -> [Rgb; 2] {
        let face = dielectric(cosine, self.eta);
        let Some(within) = transmitted_cosine(cosine, self.eta) else { return [Rgb::WHITE, Rgb::BLACK] };
        let way = self.tint.map(|tint| if tint == 1.0 { 1.0 } else { tint.powf(1.0 / within) });
        let entering = (1.0 - face) * (1.0 - face);
        // At a grazing angle all is reflected: 0/0 otherwise.
        let rest = |t: f64| entering / (1.0 - face * face * t * t).max(f64::MIN_POSITIVE);
        [way.map(|t| face + rest(t) * face * t * t), way.map(|t| rest(t) * t)]
    }

    /// The mean of [`shares`](Self::shares), weighted by twice the cosine.
    #[must_use]
    pub fn mean_shares(&self) -> [Rgb; 2] {
        [0, 1].map(|way| mean_over_cosines(|cosine| self.shares(cosine)[way]))
    }
}

impl LocalLobe for ThinWall {
    fn evaluate(&self, o: DVec3, i: DVec3) -> Rgb {
        let Some(ggx) = self.facets else { return Rgb::BLACK };
        let near = DVec3::new(i.x, i.y, i.z.abs());
        let density = ggx.reflected_density(o, near);
        if !(density > 0.0) {
            return Rgb::BLACK;
        }
        let [reflected, through] = self.shares(half_angle_cosine(o, near));
        let share = if i.z > 0.0 { reflected } else { through };
        share * (density * ggx.seen_from_both(o, near))
    }

    fn pdf(&self, o: DVec3, i: DVec3) -> f64 {
        let Some(ggx) = self.facets else { return 0.0 };
        let near = DVec3::new(i.x, i.y, i.z.abs());
        let chance = self.chance(half_angle_cosine(o, near));
        let chance = if i.z > 0.0 { chance } else { 1.0 - chance };
        chance * ggx.reflected_density(o, near)
    }

    fn sample(&self, o: DVec3, choose: f64, u: [f64; 2]) -> Option<LocalSample> {
        let Some(ggx) = self.facets else {
            let chance = self.chance(o.z);
            let [reflected, through] = self.shares(o.z);
            return Some(if choose < chance {
                LocalSample { direction: mirrored(o), delta: Some(reflected / chance), eta: 1.0 }
            } else {
                LocalSample { direction: -o, delta: Some(through / (1.0 - chance)), eta: 1.0 }
            });
        };
        let h = ggx.visible_normal(o, u);
        let near = DVec3::from(reflect((-o).into(), h.into()));
        let side = if choose < self.chance(o.dot(h)) { 1.0 } else { -1.0 };
        (near.z > 0.0).then_some(LocalSample::spread(DVec3::new(near.x, near.y, near.z * side)))
    }

    fn albedo(&self, o: DVec3) -> Rgb {
        let [reflected, through] = self.shares(o.z);
        reflected + through
    }

    /// Those of a smooth wall, as of glass.
    fn rays(&self, o: DVec3) -> Rays {
        let [mirrored, straight] = self.shares(o.z);
        Rays { mirrored, straight, refracted: None }
    }

    fn ambient(&self, _: DVec3) -> Rgb {
        Rgb::BLACK
    }
}

impl ThinWall {
    /// How likely a sample is reflected.
    fn chance(&self, cosine: f64) -> f64 {
        let [reflected, through] = self.shares(cosine).map(Rgb::max_channel);
        if reflected + through > 0.0 { reflected / (reflected + through) } else { 1.0 }
    }
}
