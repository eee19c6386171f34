//! What is a quantity on average over the facets of a rough surface that are seen?

use std::f64::consts::TAU;
use std::sync::LazyLock;

use glam::DVec3;

use crate::lobe::ggx::Ggx;
use crate::numeric::LEAST_COSINE;

/// Where a surface is seen from, under that cosine.
pub(super) fn seen_under(cosine: f64) -> DVec3 {
    let cosine = cosine.max(LEAST_COSINE);
    DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine)
}

/// Points that stand for all visible facets: the numbers that choose them, and what each counts for.
///
/// Places turn by the golden ratio, and steps along are finer where facets are steep, as edges of what is seen lie there.
/// Products of one-dimensional rules do worse: what is asked has edges at the horizon and at the angle of total reflection.
#[derive(Debug, Clone)]
pub(in crate::lobe) struct CapPoints(Vec<CapPoint>);

#[derive(Debug, Clone, Copy)]
struct CapPoint {
    /// Cosine and sine of the turn.
    turn: [f64; 2],
    along: f64,
    weight: f64,
}

impl CapPoints {
    pub(super) fn new(count: u32) -> Self {
        let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
        let point = |k: u32| {
            let left = 1.0 - (f64::from(k) + 0.5) / f64::from(count);
            let (sin, cos) = ((f64::from(k) * golden).fract() * TAU).sin_cos();
            CapPoint { turn: [cos, sin], along: 1.0 - left * left, weight: 2.0 * left / f64::from(count) }
        };
        Self((0..count).map(point).collect())
    }

    /// Few points, for what no table holds: good to some thousandths.
    pub(in crate::lobe) fn few() -> &'static Self {
        static FEW: LazyLock<CapPoints> = LazyLock::new(|| CapPoints::new(128));
        &FEW
    }

    /// The mean of `value` over the facet normals that are visible from `o`.
    pub(in crate::lobe) fn mean(&self, ggx: &Ggx, o: DVec3, value: impl Fn(DVec3) -> f64) -> f64 {
        let stretched = ggx.stretched(o);
        self.0.iter().map(|p| p.weight * value(ggx.normal_on_cap(stretched, p.turn, p.along))).sum()
    }
}
