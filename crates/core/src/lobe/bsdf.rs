//! What does a surface do with light at one point, seen from one direction? All lobes there, weighed against each other.
//!
//! In `f64`, for integrators that follow one path at a time; [`Lobes`] answers for lanes. What light weighs is told in
//! [`local`](super::LocalLobe): radiance over the squared index of refraction.

use arrayvec::ArrayVec;
use glam::DVec3;
use smallvec::SmallVec;

use super::local::{Frame, LocalLobe, LocalSample};
use super::{BsdfLobe, Lobes, Mirror, SmoothReflection, SurfacePoint, ThinWall, fresnel::Fresnel};
use crate::numeric::LEAST_COSINE;
use crate::{Rgb, Triple};

/// Lobes that need no memory of their own: most points have as many.
const FEW_LOBES: usize = 2;

/// How light leaves a point of a surface towards the viewer.
#[derive(Debug, Clone)]
pub struct Bsdf {
    /// Radiance shown without any light's help.
    pub emission: Rgb,
    /// Radiance shown for each unit of ambient radiance, beside what [`rays`](Self::rays) bring.
    pub ambient: Rgb,
    frame: Frame,
    /// To the viewer, in the frame; its z is positive.
    to_viewer: DVec3,
    /// The shape's own normal on the viewer's side, in the frame.
    geometric: DVec3,
    lobes: SmallVec<[Weighted; FEW_LOBES]>,
}

/// A lobe, how much of it is there, and how often a sample is one of its.
#[derive(Debug, Clone, Copy)]
struct Weighted {
    lobe: BsdfLobe,
    weight: Rgb,
    chance: f64,
}

/// A direction that light may come from, chosen by [`Bsdf::sample`].
#[derive(Debug, Clone, Copy)]
pub struct Scattered {
    /// Unit vector, in the world.
    pub direction: DVec3,
    /// What one unit of radiance from there counts for: what it shows, over the density with which the direction was chosen.
    pub weight: Rgb,
    /// That density, 1/sr, over all lobes that have one; 0 where `is_delta`.
    pub pdf: f64,
    /// Whether light from this one direction counts, and not from those beside it.
    pub is_delta: bool,
    /// Whether it leads through the surface.
    pub is_transmitted: bool,
    /// Index of refraction where the direction leads over that on the viewer's side; 1 where it is the same medium.
    pub eta: f64,
}

/// A single ray that Whitted's integrator follows.
#[derive(Debug, Clone, Copy)]
pub struct Continuation {
    /// Unit vector, in the world.
    pub direction: DVec3,
    /// What one unit of radiance from there shows.
    pub weight: Rgb,
    /// Whether it leads through the surface.
    pub is_transmitted: bool,
}

impl Bsdf {
    /// One that shows nothing.
    #[must_use]
    pub fn new(at: &SurfacePoint) -> Self {
        Self::in_frame(at, Frame::new(at.normal(), at.tangent))
    }

    /// The same, with a frame of its own, whose z is the point's normal.
    #[must_use]
    pub fn in_frame(at: &SurfacePoint, frame: Frame) -> Self {
        let to_viewer = frame.to_local(at.to_viewer());
        let seen = DVec3::new(to_viewer.x, to_viewer.y, to_viewer.z.max(LEAST_COSINE));
        Self {
            emission: Rgb::BLACK,
            ambient: Rgb::BLACK,
            frame,
            to_viewer: seen.normalize(),
            geometric: frame.to_local(at.geometric),
            lobes: SmallVec::new(),
        }
    }

    /// What the lobes of lanes amount to.
    #[must_use]
    pub fn from_lobes(lobes: &Lobes<f64>, at: &SurfacePoint) -> Self {
        let rgb = |v: Triple<f64>| Rgb::new(v.x, v.y, v.z);
        let mut bsdf = Self::new(at);
        let base = Rgb::grey(lobes.share);
        if let Some(diffuse) = lobes.diffuse {
            bsdf.add(base, diffuse);
        }
        if let Some(phong) = lobes.phong {
            bsdf.add(base, phong);
        }
        if let Some(Mirror { tint }) = lobes.mirror {
            bsdf.add(Rgb::WHITE, SmoothReflection { fresnel: Fresnel::Constant(rgb(tint)) });
        }
        Self {
            emission: rgb(lobes.emission) * lobes.share,
            ambient: rgb(lobes.ambient) * lobes.share,
            ..bsdf
        }
    }

    /// Adds a lobe that counts `weight` per channel, and what it shows of ambient light. One that counts nothing is left out.
    pub fn add(&mut self, weight: Rgb, lobe: impl Into<BsdfLobe>) {
        let lobe = match lobe.into() {
            BsdfLobe::Complement(complement) => complement.seen_from(self.to_viewer).into(),
            lobe => lobe,
        };
        let chance = (weight * lobe.albedo(self.to_viewer)).max_channel();
        if chance > 0.0 {
            self.ambient += weight * lobe.ambient(self.to_viewer);
            self.lobes.push(Weighted { lobe, weight, chance });
        }
    }

    /// Cosine of the angle between the shading normal and the viewer, greater than 0.
    #[must_use]
    pub fn cosine(&self) -> f64 {
        self.to_viewer.z
    }

    /// A direction of the world in the frame, if it is on the same side of the surface as it is of its smooth normal.
    fn local(&self, direction: DVec3) -> Option<DVec3> {
        let i = self.frame.to_local(direction);
        (i.z * i.dot(self.geometric) > 0.0).then_some(i)
    }

    /// Radiance shown for each unit of irradiance at normal incidence from `direction`, a unit vector on either side: the BSDF
    /// times |cosine|, over all lobes that scatter over a range of directions.
    #[must_use]
    pub fn evaluate(&self, direction: DVec3) -> Rgb {
        self.local(direction).map_or(Rgb::BLACK, |i| self.sum(i, |_| true))
    }

    /// As [`evaluate`](Self::evaluate), without the lobes that [`diffuse`](Self::diffuse) stands for.
    #[must_use]
    pub fn glossy(&self, direction: DVec3) -> Rgb {
        self.local(direction)
            .map_or(Rgb::BLACK, |i| self.sum(i, |lobe| !matches!(lobe, BsdfLobe::Diffuse(_))))
    }

    /// Albedo of what scatters alike in all directions on the viewer's side: it shows this over π for each unit of irradiance.
    #[must_use]
    pub fn diffuse(&self) -> Rgb {
        let diffuse = self.lobes.iter().filter(|lobe| matches!(lobe.lobe, BsdfLobe::Diffuse(_)));
        diffuse.fold(Rgb::BLACK, |sum, lobe| sum + lobe.weight * lobe.lobe.albedo(self.to_viewer))
    }

    /// Whether there is anything that [`evaluate`](Self::evaluate) shows.
    #[must_use]
    pub fn is_lit(&self) -> bool {
        self.lobes.iter().any(|lobe| !is_delta(&lobe.lobe))
    }

    /// Whether there is anything that [`glossy`](Self::glossy) shows.
    #[must_use]
    pub fn is_glossy(&self) -> bool {
        self.lobes.iter().any(|lobe| !is_delta(&lobe.lobe) && !matches!(lobe.lobe, BsdfLobe::Diffuse(_)))
    }

    /// The share of light from the viewer's side that is shown, if it is the same from everywhere, by what neither
    /// [`rays`](Self::rays) bring nor lobes that scatter through the surface.
    #[must_use]
    pub fn scattered(&self) -> Rgb {
        let sum = |sum: Rgb, lobe: &Weighted| sum + lobe.weight * lobe.lobe.ambient(self.to_viewer);
        self.lobes.iter().fold(Rgb::BLACK, sum)
    }

    fn sum(&self, i: DVec3, counts: impl Fn(&BsdfLobe) -> bool) -> Rgb {
        let lobes = self.lobes.iter().filter(|lobe| counts(&lobe.lobe));
        lobes.fold(Rgb::BLACK, |sum, lobe| sum + lobe.weight * lobe.lobe.evaluate(self.to_viewer, i))
    }

    /// How densely [`sample`](Self::sample) spreads directions over solid angle at `direction`, 1/sr, without those of its
    /// choices that are delta.
    #[must_use]
    pub fn pdf(&self, direction: DVec3) -> f64 {
        let i = self.local(direction).filter(|_| !self.lobes.is_empty());
        i.map_or(0.0, |i| self.density(i))
    }

    fn density(&self, i: DVec3) -> f64 {
        let sum: f64 = self.lobes.iter().map(|lobe| lobe.chance * lobe.lobe.pdf(self.to_viewer, i)).sum();
        sum / self.chances()
    }

    fn chances(&self) -> f64 {
        self.lobes.iter().map(|lobe| lobe.chance).sum()
    }

    /// A direction that light may come from, chosen by three numbers in 0..1 with about the density of what it shows. `None`
    /// counts as one that brings no light.
    #[must_use]
    pub fn sample(&self, choose: f64, u: [f64; 2]) -> Option<Scattered> {
        let all = self.chances();
        let (lobe, choose) = self.choose(choose * all)?;
        let LocalSample { direction, delta, eta } = lobe.lobe.sample(self.to_viewer, choose, u)?;
        if !(direction.z * direction.dot(self.geometric) > 0.0) {
            return None;
        }
        let (weight, pdf) = match delta {
            Some(weight) => (lobe.weight * weight * (all / lobe.chance), 0.0),
            None => {
                let pdf = self.density(direction);
                (self.sum(direction, |_| true) / pdf, pdf)
            }
        };
        let usable = weight.all(f64::is_finite) && weight.max_channel() > 0.0;
        usable.then(|| Scattered {
            direction: self.frame.to_world(direction),
            weight,
            pdf,
            is_delta: delta.is_some(),
            is_transmitted: direction.z < 0.0,
            eta,
        })
    }

    /// The lobe at a place in the sum of chances, and how far within it, 0..1.
    fn choose(&self, mut place: f64) -> Option<(&Weighted, f64)> {
        let (last, before) = self.lobes.split_last()?;
        for lobe in before {
            if place < lobe.chance {
                return Some((lobe, place / lobe.chance));
            }
            place -= lobe.chance;
        }
        Some((last, (place / last.chance).min(1.0_f64.next_down())))
    }

    /// The rays of an integrator that follows only single ones: mirrored, bent and straight, as far as they are there.
    ///
    /// Lobes that send light on in single directions are met exactly. Of a rough reflection with a roughness r below 0.4 the
    /// mirrored ray carries the share (1 − r/0.4)², which is left out of [`ambient`](Self::ambient); rough glass is looked
    /// through as if it were smooth.
    #[must_use]
    pub fn rays(&self) -> ArrayVec<Continuation, 3> {
        let o = self.to_viewer;
        let (mut mirrored, mut straight, mut refracted) = (Rgb::BLACK, Rgb::BLACK, None);
        for lobe in &self.lobes {
            let rays = lobe.lobe.rays(o);
            mirrored += lobe.weight * rays.mirrored;
            straight += lobe.weight * rays.straight;
            refracted = rays.refracted.map(|(way, tint)| (way, lobe.weight * tint)).or(refracted);
        }
        let mirrored = (super::local::mirrored(o), mirrored);
        let ways = [Some(mirrored), refracted, Some((-o, straight))];
        let seen = |(way, weight): &(DVec3, Rgb)| {
            weight.max_channel() > 0.0 && way.z * way.dot(self.geometric) > 0.0
        };
        let ray = |(way, weight): (DVec3, Rgb)| Continuation {
            direction: self.frame.to_world(way),
            weight,
            is_transmitted: way.z < 0.0,
        };
        ways.into_iter().flatten().filter(seen).map(ray).collect()
    }
}
/// Whether a lobe sends light on in single directions alone.
fn is_delta(lobe: &BsdfLobe) -> bool {
    matches!(
        lobe,
        BsdfLobe::SmoothReflection(_)
            | BsdfLobe::SmoothInterface(_)
            | BsdfLobe::Passage(_)
            | BsdfLobe::ThinWall(ThinWall { facets: None, .. })
    )
}
