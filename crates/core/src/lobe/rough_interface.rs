//! The rough boundary between two clear media: every facet mirrors and bends light (Walter, Marschner, Li and Torrance, EGSR 2007).
//!
//! What facets shadow is lost here, and given back by a [`Complement`](super::Complement).

use glam::DVec3;

use super::fresnel::dielectric;
use super::ggx::Ggx;
use super::local::{LocalLobe, LocalSample, Rays};
use super::smooth_interface::SmoothInterface;
use crate::Rgb;
use crate::optics::{reflect, refract};

/// A rough boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughInterface {
    /// Its facets.
    pub ggx: Ggx,
    /// The boundary that each facet is.
    pub facet: SmoothInterface,
}

impl RoughInterface {
    /// The facet normal that sends light from `i` to `o`, and how densely directions stand to normals there; `None` where there is
    /// none.
    fn facet(&self, o: DVec3, i: DVec3) -> Option<(DVec3, f64)> {
        let eta = if i.z > 0.0 { 1.0 } else { self.facet.eta };
        let half = (o + i * eta).try_normalize()?;
        let h = if half.z < 0.0 { -half } else { half };
        let (to_o, to_i) = (o.dot(h), i.dot(h));
        if !(to_o > 0.0 && to_i * i.z > 0.0) {
            return None;
        }
        let length = to_o + eta * to_i;
        Some((h, eta * eta * to_i.abs() / (length * length)))
    }
}

impl LocalLobe for RoughInterface {
    fn evaluate(&self, o: DVec3, i: DVec3) -> Rgb {
        let tint = if i.z > 0.0 { Rgb::WHITE } else { self.facet.tint };
        tint * (self.pdf(o, i) * self.ggx.seen_from_both(o, i))
    }

    fn pdf(&self, o: DVec3, i: DVec3) -> f64 {
        let Some((h, density)) = self.facet(o, i) else { return 0.0 };
        let reflected = dielectric(o.dot(h), self.facet.eta);
        let share = if i.z > 0.0 { reflected } else { 1.0 - reflected };
        share * density * self.ggx.visible_density(o, h)
    }

    fn sample(&self, o: DVec3, choose: f64, u: [f64; 2]) -> Option<LocalSample> {
        let h = self.ggx.visible_normal(o, u);
        let eta = self.facet.eta;
        if choose < dielectric(o.dot(h), eta) {
            let direction = DVec3::from(reflect((-o).into(), h.into()));
            return (direction.z > 0.0).then_some(LocalSample::spread(direction));
        }
        let direction = refract(-o, h, 1.0 / eta)?.try_normalize()?;
        (direction.z < 0.0).then_some(LocalSample { direction, delta: None, eta })
    }

    fn albedo(&self, o: DVec3) -> Rgb {
        self.facet.albedo(o)
    }

    /// Those of a smooth boundary, so that one looks through frosted glass as through clear glass.
    fn rays(&self, o: DVec3) -> Rays {
        self.facet.rays(o)
    }

    fn ambient(&self, _: DVec3) -> Rgb {
        Rgb::BLACK
    }
}
