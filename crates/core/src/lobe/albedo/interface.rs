//! How much light does a rough boundary between two clear media reflect in all, and how much do its formulas lose on either side?

use std::sync::OnceLock;

use glam::DVec3;

use super::axis::{Grid, Stencil, alpha_at, cosine_at, place_of_alpha, place_of_cosine};
use super::cap::{mean_over_cosines, mean_over_visible, seen_under};
use super::reflection::scale;
use crate::lobe::fresnel::dielectric;
use crate::lobe::ggx::Ggx;
use crate::optics::{reflect, refract};

/// Ratios of indices, slopes and cosines in the table.
const RATIOS: usize = 15;
const ALPHAS: usize = 14;
const COSINES: usize = 28;

/// (n − 1)/(n + 1) of the largest ratio of indices in the table, which is 9; germanium in air has 4.
const LARGEST: f64 = 0.8;

/// A side of a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::lobe) enum Side {
    /// That of the lower index of refraction.
    Thin,
    /// That of the higher one.
    Dense,
}

impl Side {
    /// The index of refraction beyond over that on this side.
    fn eta(self, ratio: f64) -> f64 {
        match self {
            Self::Thin => ratio,
            Self::Dense => 1.0 / ratio,
        }
    }
}

/// A rough boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lobe) struct Interface {
    alpha: f64,
    /// The higher index of refraction over the lower.
    ratio: f64,
}

/// What the table says of one ratio of indices.
struct Slice {
    /// What is lost on the thin and on the dense side, over [`scale`].
    lost: [Grid; 2],
    /// Their means, over squared slopes.
    mean_lost: [Vec<f64>; 2],
    /// What is reflected on the thin side.
    reflected: Grid,
    mean_reflected: Vec<f64>,
}

/// Made one by one, as most scenes ask for few ratios.
static SLICES: [OnceLock<Slice>; RATIOS] = [const { OnceLock::new() }; RATIOS];

/// Cosines at which reflection changes are those of steep facets or of Fresnel's rise, whichever is wider.
fn width(alpha: f64) -> f64 {
    alpha + 0.1
}

impl Slice {
    fn number(k: usize) -> &'static Self {
        SLICES[k].get_or_init(|| {
            // Media that are one reflect nothing and have no bend to speak of; the least step tells how it begins.
            let place = (LARGEST * k as f64 / (RATIOS - 1) as f64).max(1e-3);
            Self::new((1.0 + place) / (1.0 - place))
        })
    }

    fn new(ratio: f64) -> Self {
        let lost = [Side::Thin, Side::Dense].map(|side| {
            Grid::new(ALPHAS, COSINES, |row, column| {
                let alpha = alpha_at(row);
                let cosine = cosine_at(column, alpha);
                Interface { alpha, ratio }.computed_loss(side, cosine) / scale(alpha, cosine)
            })
        });
        let reflected = Grid::new(ALPHAS, COSINES, |row, column| {
            let alpha = alpha_at(row);
            Interface { alpha, ratio }.computed_reflection(cosine_at(column, width(alpha)))
        });
        let rows = || (0..ALPHAS).map(|row| row as f64 / (ALPHAS - 1) as f64);
        let mean_of_lost = |lost: &Grid| {
            let mean = |row| {
                let alpha = alpha_at(row);
                let lost = |cosine| lost.at(row, place_of_cosine(cosine, alpha)) * scale(alpha, cosine);
                mean_over_cosines(lost) / (alpha * alpha)
            };
            rows().map(mean).collect()
        };
        let mean_of_reflected = |row| {
            let width = width(alpha_at(row));
            mean_over_cosines(|cosine| reflected.at(row, place_of_cosine(cosine, width)))
        };
        Self {
            mean_lost: [mean_of_lost(&lost[0]), mean_of_lost(&lost[1])],
            mean_reflected: rows().map(mean_of_reflected).collect(),
            lost,
            reflected,
        }
    }
}

impl Interface {
    /// Of a slope, and of the higher index of refraction over the lower.
    pub(in crate::lobe) const fn new(alpha: f64, ratio: f64) -> Self {
        Self { alpha, ratio }
    }

    /// Between the values of four slices.
    fn look_up(&self, value: impl Fn(&Slice) -> f64) -> f64 {
        let place = (self.ratio - 1.0) / (self.ratio + 1.0) / LARGEST;
        Stencil::at(place, RATIOS).of(|k| value(Slice::number(k)))
    }

    /// Share of light that single reflection and refraction lose of what comes to a side under a cosine.
    pub(in crate::lobe) fn lost(&self, side: Side, cosine: f64) -> f64 {
        let (row, column) = (place_of_alpha(self.alpha), place_of_cosine(cosine, self.alpha));
        let lost = self.look_up(|slice| slice.lost[side as usize].at(row, column));
        (lost * scale(self.alpha, cosine)).clamp(0.0, 1.0)
    }

    /// The mean of [`lost`](Self::lost), weighted by twice the cosine.
    pub(in crate::lobe) fn mean_lost(&self, side: Side) -> f64 {
        let row = Stencil::at(place_of_alpha(self.alpha), ALPHAS);
        self.alpha * self.alpha * self.look_up(|slice| row.of(|k| slice.mean_lost[side as usize][k]))
    }

    /// Share of light that is reflected once on the thin side, seen under a cosine.
    pub(in crate::lobe) fn reflected(&self, cosine: f64) -> f64 {
        let (row, column) = (place_of_alpha(self.alpha), place_of_cosine(cosine, width(self.alpha)));
        self.look_up(|slice| slice.reflected.at(row, column)).clamp(0.0, 1.0)
    }

    /// The mean of [`reflected`](Self::reflected), weighted by twice the cosine.
    pub(in crate::lobe) fn mean_reflected(&self) -> f64 {
        let row = Stencil::at(place_of_alpha(self.alpha), ALPHAS);
        self.look_up(|slice| row.of(|k| slice.mean_reflected[k]))
    }

    fn computed_loss(&self, side: Side, cosine: f64) -> f64 {
        let (ggx, o, eta) = (Ggx::isotropic(self.alpha), seen_under(cosine), side.eta(self.ratio));
        mean_over_visible(&ggx, o, |h| {
            let reflectance = dielectric(o.dot(h), eta);
            let reflected = kept(&ggx, o, Some(DVec3::from(reflect((-o).into(), h.into()))), 1.0);
            let refracted = kept(&ggx, o, refract(-o, h, 1.0 / eta), -1.0);
            1.0 - reflectance * reflected - (1.0 - reflectance) * refracted
        })
    }

    fn computed_reflection(&self, cosine: f64) -> f64 {
        let (ggx, o) = (Ggx::isotropic(self.alpha), seen_under(cosine));
        mean_over_visible(&ggx, o, |h| {
            let reflected = DVec3::from(reflect((-o).into(), h.into()));
            dielectric(o.dot(h), self.ratio) * kept(&ggx, o, Some(reflected), 1.0)
        })
    }
}

/// Share of what a facet sends on that meets no other facet: none where it goes to the wrong side.
fn kept(ggx: &Ggx, o: DVec3, i: Option<DVec3>, side: f64) -> f64 {
    i.filter(|i| i.z * side > 0.0).map_or(0.0, |i| ggx.seen_from_both(o, i))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worst(error: impl Fn(&Interface, f64) -> f64) -> f64 {
        let mut worst: f64 = 0.0;
        for ratio in [1.1, 1.33, 1.5, 1.52, 1.8, 2.42, 4.0] {
            for roughness in [0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0] {
                for k in 0..16 {
                    let cosine = (f64::from(k) + 0.5) / 16.0;
                    let interface = Interface::new(roughness * roughness, ratio);
                    let e = error(&interface, cosine).abs();
                    if e > 5e-4 {
                        eprintln!("{ratio} {roughness} {cosine} {e}");
                    }
                    worst = worst.max(e);
                }
            }
        }
        worst
    }

    #[test]
    fn between_its_values_the_table_says_what_the_integral_does() {
        let loss = |side| {
            worst(move |interface, cosine| {
                interface.lost(side, cosine) - interface.computed_loss(side, cosine)
            })
        };
        let t = std::time::Instant::now();
        Slice::new(1.5);
        eprintln!("{:?}", t.elapsed());
        let (thin, dense) = (loss(Side::Thin), loss(Side::Dense));
        let reflected =
            worst(|interface, cosine| interface.reflected(cosine) - interface.computed_reflection(cosine));
        assert!(thin < 5e-4 && dense < 5e-4 && reflected < 5e-4, "{thin} {dense} {reflected}");
    }
}
