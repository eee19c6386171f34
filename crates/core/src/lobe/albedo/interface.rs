//! How much light does a rough boundary between two clear media reflect in all, and how much do its formulas lose on either side?

use std::sync::OnceLock;

use glam::DVec3;

use super::axis::{
    Grid, Means, Stencil, alpha_at, cosine_about_edge, cosine_at, place_about_edge, place_of_alpha,
    place_of_cosine,
};
use super::cap::{CapPoints, seen_under};
use super::reflection::{fine, kept_by_reflection, lost_by_reflection, mean_scale, scale};
use crate::lobe::fresnel::{LARGEST_ETA, dielectric};
use crate::lobe::ggx::Ggx;
use crate::lobe::quadrature::mean_over_cosines;
use crate::optics::{reflect, refract};

/// Ratios of indices (one of them is 1.5) and slopes in the table.
const RATIOS: usize = 17;
const ALPHAS: usize = 16;

/// (n − 1)/(n + 1) of the largest ratio of indices in the table.
const LARGEST: f64 = (LARGEST_ETA - 1.0) / (LARGEST_ETA + 1.0);

/// A side of a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::lobe) enum Side {
    /// That of the lower index of refraction.
    Thin,
    /// That of the higher one.
    Dense,
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
    /// Their means, over [`mean_scale`].
    mean_lost: [Means; 2],
    /// What is reflected on the thin side, over a guess.
    reflected: Grid,
    mean_reflected: Means,
}

/// Made one by one, in about 60 ms each, as most scenes ask for few ratios: 1.5 needs one, others up to four.
static SLICES: [OnceLock<Slice>; RATIOS] = [const { OnceLock::new() }; RATIOS];

impl Slice {
    fn number(k: usize) -> &'static Self {
        SLICES[k].get_or_init(|| {
            // Media that are one reflect nothing and have no bend to speak of; a small step tells how it begins.
            let root = k as f64 / (RATIOS - 1) as f64;
            let place = (LARGEST * root * root).max(1e-3);
            Self::new((1.0 + place) / (1.0 - place))
        })
    }

    /// By quadrature.
    fn new(ratio: f64) -> Self {
        let ((thin, mean_thin), (dense, mean_dense)) =
            (lost_on(Side::Thin, ratio), lost_on(Side::Dense, ratio));
        let (reflected, mean_reflected) = reflected_at(ratio);
        Self { lost: [thin, dense], mean_lost: [mean_thin, mean_dense], reflected, mean_reflected }
    }
}

/// What is lost on a side over [`scale`], and its means over [`mean_scale`].
fn lost_on(side: Side, ratio: f64) -> (Grid, Means) {
    let points = CapPoints::new(side.points());
    let lost = Grid::new(ALPHAS, side.cosines(), |row, column| {
        let interface = Interface { alpha: alpha_at(row), ratio };
        let cosine = interface.cosine_on(side, column);
        interface.computed_loss(&points, side, cosine) / scale(interface.alpha, cosine)
    });
    let mean = |row| {
        let interface = Interface { alpha: alpha_at(row), ratio };
        let lost = |cosine| lost.at(row, interface.place_on(side, cosine)) * scale(interface.alpha, cosine);
        mean_over_cosines(lost) / mean_scale(interface.alpha)
    };
    let means = Means::new(mean);
    (lost, means)
}

/// What is reflected on the thin side over [`Interface::guessed`], and the means of what is reflected.
fn reflected_at(ratio: f64) -> (Grid, Means) {
    let points = CapPoints::new(Side::Thin.points());
    let reflected = Grid::new(ALPHAS, Side::Thin.cosines(), |row, column| {
        let interface = Interface { alpha: alpha_at(row), ratio };
        let cosine = interface.cosine_on(Side::Thin, column);
        interface.computed_reflection(&points, cosine) / interface.guessed(cosine)
    });
    let mean = |row| {
        let interface = Interface { alpha: alpha_at(row), ratio };
        let share = |cosine| reflected.at(row, interface.place_on(Side::Thin, cosine));
        mean_over_cosines(|cosine| share(cosine) * interface.guessed(cosine))
    };
    let means = Means::new(mean);
    (reflected, means)
}

impl Side {
    /// The index of refraction beyond over that on this side.
    fn eta(self, ratio: f64) -> f64 {
        match self {
            Self::Thin => ratio,
            Self::Dense => 1.0 / ratio,
        }
    }

    /// Columns of the table.
    const fn cosines(self) -> usize {
        match self {
            Self::Thin => 40,
            Self::Dense => 45,
        }
    }

    /// Points of the quadrature; more where total reflection has an edge.
    const fn points(self) -> u32 {
        match self {
            Self::Thin => 600,
            Self::Dense => 1200,
        }
    }
}

impl Interface {
    /// Of a slope, and of the higher index of refraction over the lower, at most [`LARGEST_ETA`].
    pub(in crate::lobe) const fn new(alpha: f64, ratio: f64) -> Self {
        Self { alpha, ratio: ratio.min(LARGEST_ETA) }
    }

    /// The cosine beyond which all is reflected on the dense side.
    fn critical(&self) -> f64 {
        (1.0 - 1.0 / (self.ratio * self.ratio)).max(0.0).sqrt()
    }

    /// Where a cosine stands in the table of a side.
    fn place_on(&self, side: Side, cosine: f64) -> f64 {
        match side {
            Side::Thin => place_of_cosine(cosine, fine(self.alpha)),
            Side::Dense => place_about_edge(cosine, self.critical(), fine(self.alpha)),
        }
    }

    fn cosine_on(&self, side: Side, place: f64) -> f64 {
        match side {
            Side::Thin => cosine_at(place, fine(self.alpha)),
            Side::Dense => cosine_about_edge(place, self.critical(), fine(self.alpha)),
        }
    }

    /// Between the values of four slices.
    fn look_up(&self, value: impl Fn(&Slice) -> f64) -> f64 {
        let place = (self.ratio - 1.0) / (self.ratio + 1.0) / LARGEST;
        // By the root, as media that are almost one differ most from those that are.
        Stencil::at(place.sqrt(), RATIOS).of(|k| value(Slice::number(k)))
    }

    /// Share of light that single reflection and refraction lose of what comes to a side under a cosine.
    pub(in crate::lobe) fn lost(&self, side: Side, cosine: f64) -> f64 {
        let (row, column) = (place_of_alpha(self.alpha), self.place_on(side, cosine));
        let lost = self.look_up(|slice| slice.lost[side as usize].at(row, column));
        (lost * scale(self.alpha, cosine)).clamp(0.0, 1.0)
    }

    /// The mean of [`lost`](Self::lost), weighted by twice the cosine.
    pub(in crate::lobe) fn mean_lost(&self, side: Side) -> f64 {
        mean_scale(self.alpha) * self.look_up(|slice| slice.mean_lost[side as usize].at(self.alpha))
    }

    /// Share of light that is reflected once on the thin side, seen under a cosine.
    pub(in crate::lobe) fn reflected(&self, cosine: f64) -> f64 {
        let (row, column) = (place_of_alpha(self.alpha), self.place_on(Side::Thin, cosine));
        let share = self.look_up(|slice| slice.reflected.at(row, column));
        (share * self.guessed(cosine)).clamp(0.0, 1.0)
    }

    /// About what is reflected on the thin side: what a smooth surface would, seen less flatly by the slope of facets, less what
    /// those shadow. The table corrects it.
    fn guessed(&self, cosine: f64) -> f64 {
        let unshadowed = dielectric(cosine.hypot(self.alpha) / self.alpha.hypot(1.0), self.ratio);
        unshadowed * (1.0 - lost_by_reflection(self.alpha, cosine))
    }

    /// The mean of [`reflected`](Self::reflected), weighted by twice the cosine.
    pub(in crate::lobe) fn mean_reflected(&self) -> f64 {
        self.look_up(|slice| slice.mean_reflected.at(self.alpha))
    }

    fn computed_loss(&self, points: &CapPoints, side: Side, cosine: f64) -> f64 {
        lost_at_interface(points, &Ggx::isotropic(self.alpha), side.eta(self.ratio), seen_under(cosine))
    }

    fn computed_reflection(&self, points: &CapPoints, cosine: f64) -> f64 {
        let share = |cosine| dielectric(cosine, self.ratio);
        kept_by_reflection(points, &Ggx::isotropic(self.alpha), seen_under(cosine), share)
    }
}

/// Share of light that single reflection and refraction lose of what `o` sees, by quadrature; `eta` is the index of refraction
/// beyond over that on this side.
pub(in crate::lobe) fn lost_at_interface(points: &CapPoints, ggx: &Ggx, eta: f64, o: DVec3) -> f64 {
    points.mean(ggx, o, |h| {
        let reflectance = dielectric(o.dot(h), eta);
        let reflected = kept(ggx, o, Some(DVec3::from(reflect((-o).into(), h.into()))), 1.0);
        let refracted = kept(ggx, o, refract(-o, h, 1.0 / eta), -1.0);
        1.0 - reflectance * reflected - (1.0 - reflectance) * refracted
    })
}

/// Share of what a facet sends on that meets no other facet: none where it goes to the wrong side.
fn kept(ggx: &Ggx, o: DVec3, i: Option<DVec3>, side: f64) -> f64 {
    i.filter(|i| i.z * side > 0.0).map_or(0.0, |i| ggx.seen_from_both(o, i))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(what: &str, most: f64, error: impl Fn(&Interface, f64) -> f64) {
        for ratio in [1.1, 1.33, 1.5, 1.8, 2.42, 4.0] {
            for roughness in [0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0] {
                for cosine in [0.03, 0.1, 0.22, 0.45, 0.66, 0.73, 0.9, 1.0] {
                    let error = error(&Interface::new(roughness * roughness, ratio), cosine);
                    assert!(error.abs() < most, "{what}, n {ratio}, {roughness}, cosine {cosine}: {error}");
                }
            }
        }
    }

    #[test]
    fn between_its_values_the_table_says_what_the_integral_does() {
        let points = CapPoints::new(4000);
        // On the dense side the steep edge of total reflection keeps the quadratures from agreeing better.
        for (side, most) in [(Side::Thin, 7e-4), (Side::Dense, 4e-3)] {
            check(&format!("{side:?}"), most, |interface, cosine| {
                interface.lost(side, cosine) - interface.computed_loss(&points, side, cosine)
            });
        }
        check("reflected", 7e-4, |interface, cosine| {
            interface.reflected(cosine) - interface.computed_reflection(&points, cosine)
        });
    }

    #[test]
    fn means_are_those_of_the_table() {
        for (roughness, ratio) in [(0.12_f64, 1.5), (0.2, 1.5), (0.5, 1.33), (0.9, 2.4)] {
            let interface = Interface::new(roughness * roughness, ratio);
            for side in [Side::Thin, Side::Dense] {
                let mean = mean_over_cosines(|cosine| interface.lost(side, cosine));
                assert!(
                    (interface.mean_lost(side) / mean - 1.0).abs() < 5e-3,
                    "{side:?} {roughness} {ratio}"
                );
            }
            let mean = mean_over_cosines(|cosine| interface.reflected(cosine));
            assert!((interface.mean_reflected() - mean).abs() < 1e-4, "{roughness} {ratio}");
        }
    }
}
