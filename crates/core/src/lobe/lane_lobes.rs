//! The lobes that lanes know, as lobes of a [`Bsdf`](super::Bsdf).

use glam::DVec3;

use super::local::{LocalLobe, LocalSample};
use super::{Diffuse, Phong, PhongModel, Scatter, ShadingPoint};
use crate::{Rgb, Triple};

fn rgb(v: Triple<f64>) -> Rgb {
    Rgb::new(v.x, v.y, v.z)
}

/// The local frame's origin, seen from `o`.
fn seen(o: DVec3) -> ShadingPoint<f64> {
    ShadingPoint { to_viewer: o.into(), ..ShadingPoint::HEAD_ON }
}

fn evaluate(lobe: &impl Scatter<f64>, o: DVec3, i: DVec3) -> Rgb {
    if i.z > 0.0 { rgb(lobe.evaluate(&seen(o), i.into(), i.z)) } else { Rgb::BLACK }
}

fn pdf(lobe: &impl Scatter<f64>, o: DVec3, i: DVec3) -> f64 {
    if i.z > 0.0 { lobe.pdf(&seen(o), i.into(), i.z) } else { 0.0 }
}

fn sample(lobe: &impl Scatter<f64>, o: DVec3, u: [f64; 2]) -> Option<LocalSample> {
    let sample = lobe.sample(&seen(o), u);
    sample.lanes.then(|| LocalSample::spread(sample.direction.into()))
}

impl LocalLobe for Diffuse<f64> {
    fn evaluate(&self, o: DVec3, i: DVec3) -> Rgb {
        evaluate(self, o, i)
    }

    fn pdf(&self, o: DVec3, i: DVec3) -> f64 {
        pdf(self, o, i)
    }

    fn sample(&self, o: DVec3, _: f64, u: [f64; 2]) -> Option<LocalSample> {
        sample(self, o, u)
    }

    fn albedo(&self, _: DVec3) -> Rgb {
        rgb(self.albedo)
    }
}

impl LocalLobe for Phong<f64> {
    fn evaluate(&self, o: DVec3, i: DVec3) -> Rgb {
        evaluate(self, o, i)
    }

    fn pdf(&self, o: DVec3, i: DVec3) -> f64 {
        pdf(self, o, i)
    }

    fn sample(&self, o: DVec3, _: f64, u: [f64; 2]) -> Option<LocalSample> {
        sample(self, o, u)
    }

    /// That of one seen head-on, at most all; a classic one shows 8/(n + 2) (1 − 2^(−(n + 2)/2)).
    fn albedo(&self, _: DVec3) -> Rgb {
        let beyond = self.shape.exponent() + 2.0;
        let share = match self.shape.model() {
            PhongModel::Normalised => 1.0,
            PhongModel::Classic => 8.0 / beyond * (1.0 - (-beyond / 2.0).exp2()),
        };
        rgb(self.specular) * share.min(1.0)
    }
}
