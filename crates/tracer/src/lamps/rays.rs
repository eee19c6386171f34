//! How much of a lamp do rays to it find? Where to send them, and what they tell.

use catoptra_core::glam::DVec3;
use catoptra_core::lamp_points::{LampPoint, LampPoints};
use catoptra_core::{Lane, Lobes, Ray, Rgb, ShadingPoint, Span, Triple};

use super::{Gathered, LitPoint};
use crate::sampler::{Sampler, pairs, share};
use crate::snapshot::{LampRow, LampTree, Lamps};

/// Rays from a point to a lamp.
pub(crate) struct LampRays {
    points: Option<LampPoints>,
    at: LitPoint,
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
    /// Whether it runs above the surface itself, and not only above the normal to shade with.
    pub(crate) above_ground: bool,
}

/// Which random numbers rays are drawn from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Drawn {
    /// Those of the pixel.
    pub(crate) sampler: Sampler<u32>,
    /// The number in its sequence of the camera ray that led to the point.
    pub(crate) sample: u32,
    /// How many reflections it came by.
    pub(crate) depth: u32,
}

/// The pair of sample dimensions of a lamp after some reflections.
pub(crate) fn pair_of_lamp(lamp: usize, depth: u32) -> u32 {
    let pair = (lamp as u32).wrapping_add(depth.wrapping_mul(PAIRS_PER_DEPTH));
    pair.wrapping_add(pairs::LAMPS)
}

/// The number and the pair of dimensions that ray number so and so to a lamp goes by: every other ray belongs to a half of its
/// own, which knows nothing of the other.
#[inline(always)]
pub(crate) fn half_of_ray(number: u32, pair: u32) -> (u32, u32) {
    (number / 2, pair.wrapping_add((number % 2) << 31))
}

/// How far apart the pairs of two depths lie: more lamps than this share some.
const PAIRS_PER_DEPTH: u32 = 1 << 16;

impl LampRay {
    fn new(at: &LitPoint, LampPoint { to, end, solid }: LampPoint) -> Self {
        let direction = to.normalize_or_zero();
        let cosine = direction.dot(at.normal);
        Self {
            ray: Ray::new(at.point, to),
            span: Span::until(end),
            direction,
            cosine,
            share: cosine.max(0.0) * solid,
            solid,
            above_ground: direction.dot(at.ground) > 0.0,
        }
    }
}

impl LampRays {
    /// As many as `count` from a point to the lamp of a number.
    pub(crate) fn new(lamp: &LampRow, number: usize, at: &LitPoint, drawn: &Drawn, count: u32) -> Self {
        Self {
            points: LampPoints::new(&lamp.outline, at.point, at.normal),
            at: *at,
            sampler: drawn.sampler,
            first: drawn.sample.wrapping_mul(count),
            pair: pair_of_lamp(number, drawn.depth),
            count,
        }
    }

    /// Those of them that are above the surface, by their numbers; others bring nothing.
    pub(crate) fn above(&self) -> impl Iterator<Item = (u32, LampRay)> {
        let all = (0..self.count).map(|k| {
            let (number, pair) = half_of_ray(self.first.wrapping_add(k), self.pair);
            let shares = self.sampler.pair(number, pair).map(share);
            let nothing = LampPoint { to: DVec3::ZERO, end: 0.0, solid: 0.0 };
            let point = self.points.as_ref().map_or(nothing, |points| points.point(shares));
            (k, LampRay::new(&self.at, point))
        });
        all.filter(|(_, ray)| ray.cosine > 0.0)
    }
}

/// A ray to a lamp that was picked from many.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PickedRay<'a> {
    pub(crate) lamp: &'a LampRow,
    /// What it brings is a share of what all lamps bring.
    pub(crate) ray: LampRay,
}

/// Rays from a point to `count` lamps that a tree picks.
pub(crate) fn picked<'a>(
    lamps: &'a Lamps,
    tree: &'a LampTree,
    at: &LitPoint,
    origin: DVec3,
    drawn: &Drawn,
    count: u32,
) -> impl Iterator<Item = PickedRay<'a>> {
    let (at, drawn) = (*at, *drawn);
    let pair = drawn.depth.wrapping_mul(PAIRS_PER_DEPTH).wrapping_add(pairs::LAMPS);
    (0..count).filter_map(move |k| {
        let number = drawn.sample.wrapping_mul(count).wrapping_add(k);
        let [pick, _] = drawn.sampler.pair(number, pair).map(share);
        let (lamp, chance) = tree.pick(at.point - origin, pick)?;
        let lamp = &lamps.rows[lamp as usize];
        let shares = drawn.sampler.pair(number, pair.wrapping_add(1)).map(share);
        let points = LampPoints::new(&lamp.outline, at.point, at.normal)?;
        let ray = LampRay::new(&at, points.point(shares));
        let times = 1.0 / (chance * f64::from(count));
        let ray = LampRay { share: ray.share * times, solid: ray.solid * times, ..ray };
        (lamp.outline.is_lit_at(at.point) && ray.cosine > 0.0).then_some(PickedRay { lamp, ray })
    })
}

/// Light from many lamps at a point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shone {
    /// W/m².
    pub(crate) irradiance: Rgb,
    /// What glossy lobes show.
    pub(crate) glossy: Rgb,
}

/// What picked rays bring.
pub(crate) fn follow_picked<'a>(
    rays: impl Iterator<Item = PickedRay<'a>>,
    at: &ShadingPoint<f64>,
    lobes: &Lobes<f64>,
    mut is_blocked: impl FnMut(&PickedRay<'a>) -> bool,
) -> Shone {
    let mut shone = Shone { irradiance: Rgb::BLACK, glossy: Rgb::BLACK };
    for picked in rays {
        if is_blocked(&picked) || !picked.ray.above_ground {
            continue;
        }
        let PickedRay { lamp, ray } = picked;
        shone.irradiance += lamp.radiance.rgb() * ray.share;
        if let Some(glossy) = lobes.glossy(at, ray.direction.into(), ray.cosine) {
            shone.glossy += Rgb::new(glossy.x, glossy.y, glossy.z) * lamp.radiance.rgb() * ray.solid;
        }
    }
    shone
}

/// What rays to a lamp of unit radiance find: how much of it is seen, and what glossy lobes show of that.
pub(crate) fn follow(
    rays: &LampRays,
    at: &ShadingPoint<f64>,
    lobes: &Lobes<f64>,
    mut is_blocked: impl FnMut(&LampRay) -> bool,
) -> (Found, Rgb) {
    let (mut found, mut shown) = (Found::default(), Triple::splat(0.0));
    for (number, lamp_ray) in rays.above() {
        let open = !is_blocked(&lamp_ray) && lamp_ray.above_ground;
        found.add(number, lamp_ray.share, open);
        if open && let Some(glossy) = lobes.glossy(at, lamp_ray.direction.into(), lamp_ray.cosine) {
            shown = glossy.scale(lamp_ray.solid / f64::from(rays.count)) + shown;
        }
    }
    (found, Rgb::new(shown.x, shown.y, shown.z))
}

/// What one half of the rays to a lamp has found, those of one lane each.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Half<L: Lane> {
    /// Of the rays that may bring light: how many are open, and how many there are.
    pub(crate) open: L,
    pub(crate) all: L,
    /// What the open ones bring, and what all would.
    pub(crate) brought: L,
    pub(crate) total: L,
}

/// What rays have found, with what the lamp would give if nothing blocked it as control variate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Found {
    halves: [Half<f64>; 2],
}

impl Default for Found {
    fn default() -> Self {
        Self { halves: [Half { open: 0.0, all: 0.0, brought: 0.0, total: 0.0 }; 2] }
    }
}

impl Found {
    /// Adds ray number so and so, which may bring light.
    pub(crate) fn add(&mut self, number: u32, share: f64, is_open: bool) {
        let half = &mut self.halves[(number % 2) as usize];
        half.all += 1.0;
        half.total += share;
        if is_open {
            half.open += 1.0;
            half.brought += share;
        }
    }

    /// What `count` rays say is seen of a lamp of which so much was gathered.
    pub(crate) fn of(&self, gathered: Gathered, count: u32) -> f64 {
        match gathered {
            Gathered::Exactly(seen) => seen,
            Gathered::UpTo(open) => open * share_seen(self.halves, 2.0 / (f64::from(count) * open)),
        }
    }
}

/// The share of a lamp's light that is seen, from what two halves of the rays have found that know nothing of each other;
/// `of_one` is the share of it that one ray of a half stands for.
///
/// What each half brings is corrected by how far it would be off for the whole lamp, times the part of the other half
/// that is open. So nothing is lost to the mean, it is exact where all are open and where none is, and errs by what is
/// open between.
#[inline(always)]
pub(crate) fn share_seen<L: Lane>([a, b]: [Half<L>; 2], of_one: L) -> L {
    let (zero, one) = (of_one.number(0.0), of_one.number(1.0));
    let [part_of_a, part_of_b] = [a.open / a.all.max(one), b.open / b.all.max(one)];
    let of_a = a.brought * of_one - part_of_b * (a.total * of_one - one);
    let of_b = b.brought * of_one - part_of_a * (b.total * of_one - one);
    ((of_a + of_b) * of_one.number(0.5)).max(zero).min(one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;

    /// A lamp over 0..1 that brings 3 x², of which half is hidden.
    #[test]
    fn few_rays_are_right_in_the_mean() {
        for count in [4, 16, 64] {
            let rounds = 4000;
            let (mut sum, mut square) = (0.0, 0.0);
            for round in 0..rounds {
                let (sampler, mut found) = (Sampler::new(7, round, 3), Found::default());
                for k in 0..count {
                    let (number, pair) = half_of_ray(k, pairs::LAMPS);
                    let [x, _] = sampler.pair(number, pair).map(share);
                    found.add(k, 3.0 * x * x, x < 0.8);
                }
                let seen = found.of(Gathered::UpTo(1.0), count);
                assert!((0.0..=1.0).contains(&seen));
                (sum, square) = (sum + seen, square + seen * seen);
            }
            let mean = sum / f64::from(rounds);
            let error = ((square / f64::from(rounds) - mean * mean) / f64::from(rounds)).sqrt();
            assert!(
                (mean - 0.512).abs() < 3.0 * error + 0.03 / f64::from(count),
                "{count}: {mean} ± {error}"
            );
        }
    }

    #[test]
    fn all_and_nothing_are_exact() {
        for (is_open, seen) in [(true, 0.7), (false, 0.0)] {
            let mut found = Found::default();
            [0.1, 0.9, 0.5, 0.2].iter().zip(0..).for_each(|(&share, k)| found.add(k, share, is_open));
            assert!((found.of(Gathered::UpTo(0.7), 4) - seen).abs() < 1e-15);
        }
        assert_eq!(Found::default().of(Gathered::UpTo(0.7), 4), 0.0);
        assert_eq!(Found::default().of(Gathered::Exactly(0.3), 4), 0.3);
    }
}
