//! How much of a lamp do rays to it find? Where to send them, and what they tell.

use catoptra_core::glam::DVec3;
use catoptra_core::lamp_points::{LampPoint, LampPoints};
use catoptra_core::{Lobes, Ray, Rgb, ShadingPoint, Span, Triple};

use super::{Gathered, LitPoint};
use crate::sampler::{Sampler, share};
use crate::snapshot::LampRow;

/// Rays from a point to a lamp.
pub(crate) struct LampRays {
    points: Option<LampPoints>,
    from: DVec3,
    normal: DVec3,
    sampler: Sampler<u32>,
    /// Number of the first in the point's sequence.
    first: u32,
    pair: u32,
    /// How many.
    pub(crate) count: u32,
}

/// A ray to a lamp.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LampRay {
    /// In the snapshot's frame; its length is that of the way.
    pub(crate) ray: Ray,
    /// Where on it things block.
    pub(crate) span: Span,
    /// Unit vector along it.
    pub(crate) direction: DVec3,
    /// Cosine between that and the normal to shade with.
    pub(crate) cosine: f64,
    /// Irradiance that it brings under unit radiance if it were the only one.
    pub(crate) share: f64,
    /// The solid angle that it stands for if it were the only one, sr.
    pub(crate) solid: f64,
}

/// Which random numbers rays are drawn from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Drawn {
    /// Those of the pixel.
    pub(crate) sampler: Sampler<u32>,
    /// Which of the pixel's camera rays led to the point.
    pub(crate) sample: u32,
    /// How many reflections it came by.
    pub(crate) depth: u32,
}

/// The first pair of sample dimensions for lamps; those below are for what happens before.
const FIRST_PAIR: u32 = 64;

/// How far apart the pairs of two depths lie: more lamps than this share some.
const PAIRS_PER_DEPTH: u32 = 1 << 16;

impl LampRays {
    /// As many as `count` from a point to the lamp of a number.
    pub(crate) fn new(lamp: &LampRow, number: usize, at: &LitPoint, drawn: &Drawn, count: u32) -> Self {
        let pair = (number as u32).wrapping_add(drawn.depth.wrapping_mul(PAIRS_PER_DEPTH));
        Self {
            points: LampPoints::new(&lamp.outline, at.point, at.normal),
            from: at.point,
            normal: at.normal,
            sampler: drawn.sampler,
            first: drawn.sample.wrapping_mul(count),
            pair: pair.wrapping_add(FIRST_PAIR),
            count,
        }
    }

    /// Those of them that are above the surface; others bring nothing.
    pub(crate) fn above(&self) -> impl Iterator<Item = LampRay> {
        let all = (0..self.count).map(|k| {
            let shares = self.sampler.pair(self.first.wrapping_add(k), self.pair).map(share);
            let nothing = LampPoint { to: DVec3::ZERO, end: 0.0, solid: 0.0 };
            let LampPoint { to, end, solid } = match &self.points {
                Some(points) => points.point(shares),
                None => nothing,
            };
            let direction = to.normalize_or_zero();
            let cosine = direction.dot(self.normal);
            LampRay {
                ray: Ray::new(self.from, to),
                span: Span::until(end),
                direction,
                cosine,
                share: cosine.max(0.0) * solid,
                solid,
            }
        });
        all.filter(|ray| ray.cosine > 0.0)
    }
}

/// What rays to a lamp of unit radiance find: how much of it is seen, and what glossy lobes show of that.
pub(crate) fn follow(
    rays: &LampRays,
    at: &ShadingPoint<f64>,
    lobes: &Lobes<f64>,
    mut is_blocked: impl FnMut(&LampRay) -> bool,
) -> (Found, Rgb) {
    let (mut found, mut shown) = (Found::default(), Triple::splat(0.0));
    for lamp_ray in rays.above() {
        let open = !is_blocked(&lamp_ray);
        found.add(lamp_ray.share, open);
        if open && let Some(glossy) = lobes.glossy(at, lamp_ray.direction.into(), lamp_ray.cosine) {
            shown = glossy.scale(lamp_ray.solid / f64::from(rays.count)) + shown;
        }
    }
    (found, Rgb::new(shown.x, shown.y, shown.z))
}

/// The irradiance that rays have found, with what the lamp would give if nothing blocked it as control variate: the open
/// ones' part of it. So it is exact where all are open, and where none is.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Found {
    open: f64,
    all: f64,
}

impl Found {
    /// Adds a ray.
    pub(crate) fn add(&mut self, share: f64, is_open: bool) {
        self.all += share;
        self.open += if is_open { share } else { 0.0 };
    }

    /// What is seen of a lamp of which so much was gathered.
    pub(crate) fn of(&self, gathered: Gathered) -> f64 {
        match gathered {
            Gathered::Exactly(seen) => seen,
            Gathered::UpTo(open) if self.all > 0.0 => open * (self.open / self.all),
            Gathered::UpTo(_) => 0.0,
        }
    }
}
