//! The diffuse lobe: how much light leaves alike in all directions? (Lambert 1760.)

use super::hemisphere::{Disk, about};
use super::{Sample, Scatter, ShadingPoint};
use crate::{Coefficient, Lane, Triple};

/// The BRDF albedo/π.
#[derive(Debug, Clone, Copy)]
pub struct Diffuse<L: Lane> {
    /// Share of arriving light that is sent on, by channel.
    pub albedo: Triple<L>,
}

/// 1/π: what a Lambert surface of albedo 1 sends on, per unit of irradiance.
const LAMBERT: Coefficient = Coefficient::new(std::f64::consts::FRAC_1_PI);

impl<L: Lane> Diffuse<L> {
    /// Radiance shown for each unit of irradiance, from wherever it comes.
    #[inline(always)]
    #[must_use]
    pub fn brdf(&self) -> Triple<L> {
        self.albedo.scale(self.albedo.x.of(LAMBERT))
    }

    /// A unit vector on the side of a unit normal, chosen by two numbers in 0..1 with a density of its cosine to the
    /// normal over π, and that cosine: points spread evenly over the unit disk, raised to the half sphere (Malley's
    /// method).
    #[inline(always)]
    #[must_use]
    pub fn direction(normal: Triple<L>, u: [L; 2]) -> (Triple<L>, L) {
        let disk = Disk::at(u);
        let zero = disk.radius.number(0.0);
        let cosine = (zero.number(1.0) - disk.radius * disk.radius).max(zero).sqrt();
        (about(normal, disk.raised(disk.radius, cosine)), cosine)
    }
}

impl<L: Lane> Scatter<L> for Diffuse<L> {
    #[inline(always)]
    fn evaluate(&self, _: &ShadingPoint<L>, _: Triple<L>, cosine: L) -> Triple<L> {
        self.albedo.scale(cosine * cosine.of(LAMBERT))
    }

    #[inline(always)]
    fn pdf(&self, _: &ShadingPoint<L>, _: Triple<L>, cosine: L) -> L {
        cosine * cosine.of(LAMBERT)
    }

    #[inline(always)]
    fn sample(&self, at: &ShadingPoint<L>, u: [L; 2]) -> Sample<L> {
        let (direction, cosine) = Self::direction(at.normal, u);
        let lanes = cosine.number(0.0).less(cosine);
        Sample { direction, cosine, pdf: cosine * cosine.of(LAMBERT), lanes }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::scatter_checks::{check, seen};
    use super::*;

    #[test]
    fn directions_are_spread_as_the_density_says() {
        let diffuse = Diffuse { albedo: Triple::new(1.0, 0.5, 0.25) };
        for normal in [DVec3::Y, DVec3::NEG_Z, DVec3::new(-2.0, 1.0, -2.0) / 3.0] {
            let found = check(&diffuse, &seen(normal, 50.0));
            assert!((found.spread - 1.0).abs() < 1e-5, "the density sums up to {}", found.spread);
            assert!((found.albedo - 1.0).abs() < 1e-5, "{}", found.albedo);
        }
    }

    #[test]
    fn every_direction_weighs_the_albedo() {
        let diffuse = Diffuse { albedo: Triple::new(1.0, 0.5, 0.25) };
        let at = seen(DVec3::new(0.6, 0.0, -0.8), 10.0);
        for u in [[0.1, 0.7], [0.999, 0.5], [0.5, 0.5], [0.25, 0.01]] {
            let sample = diffuse.sample(&at, u);
            let weight = diffuse.evaluate(&at, sample.direction, sample.cosine).y / sample.pdf;
            assert!(sample.lanes && (weight - 0.5).abs() < 1e-15, "{u:?}");
        }
    }

    #[test]
    fn light_runs_both_ways_alike() {
        let diffuse = Diffuse { albedo: Triple::splat(0.5) };
        let at = seen(DVec3::Z, 50.0);
        let brdf = |cosine: f64| diffuse.evaluate(&at, Triple::splat(0.0), cosine).x / cosine;
        assert!((brdf(0.3) - brdf(0.9)).abs() < 1e-16 && (brdf(0.3) - diffuse.brdf().x).abs() < 1e-16);
    }
}
