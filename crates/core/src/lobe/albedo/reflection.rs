//! How much light does the reflection of a rough metal lose that absorbs nothing?

use std::sync::LazyLock;

use glam::DVec3;

use super::axis::{Grid, Means, alpha_at, cosine_at, place_of_alpha, place_of_cosine};
use super::cap::{CapPoints, seen_under};
use crate::lobe::ggx::Ggx;
use crate::lobe::quadrature::mean_over_cosines;
use crate::optics::reflect;

/// Slopes and cosines in the table: with these it is off by less than 4e-4, as the tests measure.
const ALPHAS: usize = 24;
const COSINES: usize = 28;

/// Points of the quadrature: with these it is off by less than 2e-4.
const POINTS: u32 = 1500;

struct Reflection {
    /// What is lost over [`scale`].
    lost: Grid,
    /// Its mean over [`mean_scale`].
    mean: Means,
}

static REFLECTION: LazyLock<Reflection> = LazyLock::new(|| {
    let points = CapPoints::new(POINTS);
    let value = |alpha: f64, cosine: f64| computed(&points, alpha, cosine) / scale(alpha, cosine);
    let lost = Grid::new(ALPHAS, COSINES, |row, column| {
        let alpha = alpha_at(row);
        value(alpha, cosine_at(column, fine(alpha)))
    });
    let mean = Means::new(|row| {
        let alpha = alpha_at(row);
        let lost = |cosine| lost.at(row, place_of_cosine(cosine, fine(alpha))) * scale(alpha, cosine);
        mean_over_cosines(lost) / mean_scale(alpha)
    });
    Reflection { lost, mean }
});

/// How what is lost grows with the slope and falls with the cosine, so that the table need not say it.
pub(super) fn scale(alpha: f64, cosine: f64) -> f64 {
    let alpha2 = alpha * alpha;
    alpha2 / (cosine * cosine + alpha2)
}

/// The mean of [`scale`], weighted by twice the cosine.
pub(super) fn mean_scale(alpha: f64) -> f64 {
    let alpha2 = alpha * alpha;
    alpha2 * (1.0 / alpha2).ln_1p()
}

/// Cosines up to which the table is fine: what is lost changes fastest where they are small beside the slope.
pub(super) fn fine(alpha: f64) -> f64 {
    0.6 * alpha
}

/// By quadrature.
fn computed(points: &CapPoints, alpha: f64, cosine: f64) -> f64 {
    1.0 - kept_by_reflection(points, &Ggx::isotropic(alpha), seen_under(cosine), |_| 1.0)
}

/// Share of light that single reflection sends to `o`, by quadrature, if each facet reflects that share at that cosine to its
/// normal.
pub(in crate::lobe) fn kept_by_reflection(
    points: &CapPoints,
    ggx: &Ggx,
    o: DVec3,
    share: impl Fn(f64) -> f64,
) -> f64 {
    points.mean(ggx, o, |h| {
        let i = DVec3::from(reflect((-o).into(), h.into()));
        if i.z > 0.0 { share(o.dot(h)) * ggx.seen_from_both(o, i) } else { 0.0 }
    })
}

/// Share of light that single reflection on a GGX surface of slope `alpha` loses, seen under a cosine, where each facet reflects
/// all.
pub(in crate::lobe) fn lost_by_reflection(alpha: f64, cosine: f64) -> f64 {
    let lost = REFLECTION.lost.at(place_of_alpha(alpha), place_of_cosine(cosine, fine(alpha)));
    (lost * scale(alpha, cosine)).clamp(0.0, 1.0)
}

/// The mean of [`lost_by_reflection`], weighted by twice the cosine.
pub(in crate::lobe) fn mean_lost_by_reflection(alpha: f64) -> f64 {
    mean_scale(alpha) * REFLECTION.mean.at(alpha)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_its_values_the_table_says_what_the_integral_does() {
        let (points, mut worst) = (CapPoints::new(10_000), 0.0_f64);
        for roughness in [0.05, 0.1, 0.17, 0.3, 0.45, 0.62, 0.8, 0.95, 1.0] {
            for k in 1..20 {
                let (alpha, cosine) = (roughness * roughness, f64::from(k) / 19.0);
                worst =
                    worst.max((lost_by_reflection(alpha, cosine) - computed(&points, alpha, cosine)).abs());
            }
        }
        assert!(worst < 4e-4, "{worst}");
    }

    #[test]
    fn a_white_rough_metal_keeps_what_is_known_of_it() {
        // Computed by others for slope 1: .31, .45 and .76 of all light at cosines 1, .5 and .1.
        for (cosine, kept) in [(1.0, 0.31), (0.5, 0.45), (0.1, 0.76)] {
            let found = 1.0 - lost_by_reflection(1.0, cosine);
            assert!((found - kept).abs() < 0.005, "{cosine}: {found}");
        }
    }

    #[test]
    fn the_mean_is_that_of_the_table_between_its_rows() {
        for roughness in [0.05, 0.12, 0.33, 0.5, 0.77, 1.0_f64] {
            let alpha = roughness * roughness;
            let mean = mean_over_cosines(|cosine| lost_by_reflection(alpha, cosine));
            let found = mean_lost_by_reflection(alpha);
            assert!((found / mean - 1.0).abs() < 2e-3, "{roughness}: {found}, not {mean}");
        }
    }
}
