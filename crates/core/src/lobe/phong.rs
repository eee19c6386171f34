//! The Phong lobe: how bright is the highlight? Phong's model with Blinn's half vector, classic and energy-normalised.
//!
//! Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977. The normalised lobe is
//! divided by its integral over the half sphere for light along the normal, 8π (2^(−n/2) + n) / ((n + 2) (n + 4)),
//! so that a white one then gives back all the light, and less from the side; the usual (n + 8) / 8π
//! (Akenine-Möller, Haines and Hoffman, *Real-Time Rendering*, 3rd ed., section 7.6) gives back up to 7.5 % more.

use std::f64::consts::PI;

use super::hemisphere::{Disk, about};
use super::{Sample, Scatter, ShadingPoint};
use crate::{Coefficient, Lane, Triple};

/// A highlight. With θ the angle between the normal and the half vector and i that of the light, one unit of irradiance
/// shows
/// * classic: `specular cosⁿ θ / π`,
/// * normalised: `specular (n + 2) (n + 4) / (8π (2^(−n/2) + n)) cosⁿ θ cos i`.
#[derive(Debug, Clone, Copy)]
pub struct Phong<L: Lane> {
    /// Strength, by channel.
    pub specular: Triple<L>,
    /// How wide it is, and how strong for that.
    pub shape: PhongShape,
}

/// What a highlight is scaled by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PhongModel {
    /// 1/π, whatever the angle of the light: not reciprocal, and more than all light at grazing angles.
    Classic,
    /// Its integral, and the cosine of the light: keeps energy.
    Normalised,
}

/// The form of a highlight, the same in all lanes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhongShape {
    exponent: Coefficient,
    /// What cosⁿ θ is multiplied by.
    scale: Coefficient,
    model: PhongModel,
}

impl PhongShape {
    /// With an exponent of at least 0.
    #[must_use]
    pub fn new(exponent: f64, model: PhongModel) -> Self {
        let scale = match model {
            PhongModel::Classic => 1.0 / PI,
            PhongModel::Normalised => normalisation(exponent),
        };
        Self { exponent: Coefficient::new(exponent), scale: Coefficient::new(scale), model }
    }

    /// n.
    #[must_use]
    pub const fn exponent(&self) -> f64 {
        self.exponent.wide
    }

    /// Which of the two it is.
    #[must_use]
    pub const fn model(&self) -> PhongModel {
        self.model
    }
}

/// One over what cosⁿ θ cos i gives in all, for light along the normal.
fn normalisation(n: f64) -> f64 {
    (n + 2.0) * ((n + 4.0) / (8.0 * PI * ((-n / 2.0).exp2() + n)))
}

impl<L: Lane> Phong<L> {
    /// cosⁿ θ, and how long the sum of the unit vectors to the light and the viewer is. That is zero only for light from
    /// straight behind, where the cosine is not positive.
    #[inline(always)]
    fn highlight(&self, at: &ShadingPoint<L>, direction: Triple<L>) -> [L; 2] {
        let half = direction + at.to_viewer;
        let length = half.dot(half).sqrt();
        let along = half.dot(at.normal) / length;
        [along.max(length.number(0.0)).power(self.shape.exponent), length]
    }
}

impl<L: Lane> Scatter<L> for Phong<L> {
    #[inline(always)]
    fn evaluate(&self, at: &ShadingPoint<L>, direction: Triple<L>, cosine: L) -> Triple<L> {
        let [highlight, _] = self.highlight(at, direction);
        let classic = highlight * cosine.of(self.shape.scale);
        self.specular.scale(match self.shape.model {
            PhongModel::Classic => classic,
            PhongModel::Normalised => classic * cosine,
        })
    }

    /// Half vectors h are as dense as (n + 1) / 2π cosⁿ θ; a solid angle of them makes 4 (h · viewer) times as much of
    /// directions, and h · viewer is half the length of the sum of the unit vectors to light and viewer.
    #[inline(always)]
    fn pdf(&self, at: &ShadingPoint<L>, direction: Triple<L>, _: L) -> L {
        let [highlight, length] = self.highlight(at, direction);
        highlight * length.number((self.shape.exponent.wide + 1.0) / (4.0 * PI)) / length
    }

    /// By half vectors. Those that would send the viewer's ray below the surface are lost: what [`pdf`](Self::pdf) sums
    /// up to over the half sphere is the share of the others.
    #[inline(always)]
    fn sample(&self, at: &ShadingPoint<L>, u: [L; 2]) -> Sample<L> {
        let disk = Disk::at(u);
        let (zero, one) = (disk.radius.number(0.0), disk.radius.number(1.0));
        let root = Coefficient::new(1.0 / (self.shape.exponent.wide + 1.0));
        let along = (one - disk.radius * disk.radius).max(zero).power(root);
        let across = (one - along * along).max(zero).sqrt();
        let half = about(at.normal, disk.raised(across, along));
        let facing = half.dot(at.to_viewer);
        let direction = half.scale(facing + facing) - at.to_viewer;
        let cosine = direction.dot(at.normal);
        let pdf = self.pdf(at, direction, cosine);
        Sample { direction, cosine, pdf, lanes: zero.less(cosine) & zero.less(facing) & zero.less(pdf) }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::scatter_checks::{check, seen};
    use super::*;

    const NORMAL: DVec3 = DVec3::new(-2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0);

    fn phong(exponent: f64, model: PhongModel) -> Phong<f64> {
        Phong { specular: Triple::new(1.0, 0.5, 0.25), shape: PhongShape::new(exponent, model) }
    }

    #[test]
    fn directions_are_spread_as_the_density_says() {
        for exponent in [0.0, 1.0, 2.5, 16.0, 300.0] {
            for degrees in [0.0, 40.0, 80.0] {
                for model in [PhongModel::Classic, PhongModel::Normalised] {
                    check(&phong(exponent, model), &seen(NORMAL, degrees));
                }
            }
        }
    }

    #[test]
    fn the_density_sums_up_to_one_but_for_what_is_lost_below_the_surface() {
        let spread = |exponent, degrees| {
            check(&phong(exponent, PhongModel::Normalised), &seen(NORMAL, degrees)).spread
        };
        assert!((spread(300.0, 0.0) - 1.0).abs() < 1e-3, "{}", spread(300.0, 0.0));
        assert!((spread(300.0, 40.0) - 1.0).abs() < 1e-3, "{}", spread(300.0, 40.0));
        // Seen head-on with n = 0, a direction is above the surface where θ < 45°: 1 − cos 45° of all half vectors.
        assert!((spread(0.0, 0.0) - (1.0 - 0.5_f64.sqrt())).abs() < 1e-4, "{}", spread(0.0, 0.0));
    }

    #[test]
    fn a_normalised_highlight_seen_head_on_gives_back_all_light() {
        for exponent in [0.0, 4.0, 16.0, 300.0] {
            let found = check(&phong(exponent, PhongModel::Normalised), &seen(NORMAL, 0.0));
            assert!((found.albedo - 1.0).abs() < 1e-3, "n = {exponent}: {}", found.albedo);
        }
    }

    #[test]
    fn weights_of_directions_are_bounded() {
        for exponent in [0.0, 3.0, 100.0, 1e5] {
            let phong = phong(exponent, PhongModel::Classic);
            let at = seen(NORMAL, 70.0);
            for i in 0..1000 {
                let sample = phong.sample(&at, [f64::from(i) / 1000.0, (0.618 * f64::from(i)).fract()]);
                if sample.lanes {
                    let weight = phong.evaluate(&at, sample.direction, sample.cosine).x / sample.pdf;
                    assert!(weight <= 8.0 / (exponent + 1.0) * (1.0 + 1e-9), "n = {exponent}: {weight}");
                }
            }
        }
    }

    #[test]
    fn a_normalised_highlight_runs_both_ways_alike() {
        let phong = phong(16.0, PhongModel::Normalised);
        let [a, b] = [seen(DVec3::Z, 60.0), seen(DVec3::Z, -35.0)];
        let brdf = |at: &ShadingPoint<f64>, direction: Triple<f64>| {
            phong.evaluate(at, direction, direction.z).x / direction.z
        };
        let (there, back) = (brdf(&a, b.to_viewer), brdf(&b, a.to_viewer));
        assert!(there > 0.01 && (there - back).abs() < 1e-15, "{there} and {back}");
    }
}
