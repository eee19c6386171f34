//! What light arrives at points in space that are no surfaces? By the rules of Whitted's direct light, in `f64`, and by paths for
//! all other.

use catoptra_core::glam::DVec3;
use catoptra_core::lobe::Diffuse;
use catoptra_core::{Camera, Integrator, Light, Ray, Rgb, Span};
use std::f64::consts::PI;

use super::paths::{rgb, shadow_ray};
use super::tally::{Picks, SETS, Tally};
use crate::integrator::Trees;
use crate::integrator::lamp_sight::LampSight;
use crate::integrator::matter::{Numbers, light_along};
use crate::lamps::{Drawn, Gathered, LampRays, LitPoint, picked};
use crate::sampler::{Sampler, pairs, share};
use crate::snapshot::LampRow;
use crate::{Frame, Irradiance, LampStats, ProbeOptions, Size, Snapshot, SurfaceId, View};

/// Asks for the light of receivers, one after another.
pub(crate) struct Receivers<'a> {
    snapshot: &'a Snapshot,
    options: &'a ProbeOptions,
    sight: LampSight,
    /// The surfaces that hold the point.
    held: Vec<SurfaceId>,
    /// By whose rules paths are followed.
    view: View,
}

/// Most rays that a set sends to a lamp.
const MOST_RAYS: u32 = 1 << 17;

/// Of many lamps at a point, those whose share rays must tell.
#[derive(Default)]
struct Sampled<'a> {
    lamps: Vec<(usize, &'a LampRow, Tally)>,
    picks: Option<Picks>,
    /// Light along directions chosen evenly by the cosine, which lamps and lights do not send straight.
    around: Option<Picks>,
}

impl<'a> Receivers<'a> {
    pub(crate) fn new(snapshot: &'a Snapshot, options: &'a ProbeOptions) -> Self {
        let view = View::new(Camera::default(), Size::new(1, 1));
        Self { snapshot, options, sight: LampSight::default(), held: Vec::new(), view }
    }

    /// The irradiance at a point of the snapshot's frame with a unit normal; `number` makes its random choices its own.
    pub(crate) fn irradiance(&mut self, point: DVec3, normal: DVec3, number: u32) -> Irradiance {
        let snapshot = self.snapshot;
        let at = LitPoint { point, normal, ground: normal, surface: None };
        snapshot.find_holding(point, &mut self.held);
        let all = self.options.integrator == Integrator::Path;
        // Paths find what ambient light stands for.
        let mut mean = if all { Rgb::BLACK } else { snapshot.ambient() * PI };
        for light in snapshot.lights() {
            mean += self.of_light(light, &at);
        }
        let mut sampled =
            Sampled { picks: snapshot.lamps().tree.as_ref().map(|_| Picks::default()), ..Sampled::default() };
        sampled.around = (all || !snapshot.matter().surroundings.is_empty()).then(Picks::default);
        let mut stats = LampStats::default();
        for (number, lamp) in snapshot.lamps().asked().iter().enumerate() {
            match self.sight.gather(&Trees, snapshot, lamp, &at, &mut stats) {
                Gathered::Exactly(seen) => mean += lamp.radiance.rgb() * seen,
                Gathered::UpTo(open) => sampled.lamps.push((number, lamp, Tally::new(open))),
            }
        }
        let Irradiance { mean: found, error } = self.of_sampled(&at, number, &mut sampled);
        Irradiance { mean: mean + found, error }
    }

    /// What a light that is no surface gives to a point.
    fn of_light(&self, light: &Light, at: &LitPoint) -> Rgb {
        let arrival = light.arriving::<f64>(at.point.into());
        let cosine = arrival.direction.dot(at.normal.into());
        if !(arrival.lit && cosine > 0.0) {
            return Rgb::BLACK;
        }
        let blocked = light.shadow()
            && shadow_ray(at.point, light).is_none_or(|(ray, span)| self.is_blocked(&ray, span));
        if blocked { Rgb::BLACK } else { rgb(light.irradiance(&arrival)) * cosine }
    }

    fn is_blocked(&self, ray: &Ray, span: Span) -> bool {
        self.snapshot.is_occluded_beside(ray, span, &self.held)
    }

    /// What lamps give whose share rays must tell: by as many as asked for, or as it takes to be as sure as that.
    fn of_sampled(&self, at: &LitPoint, number: u32, sampled: &mut Sampled<'a>) -> Irradiance {
        let nothing = Irradiance { mean: Rgb::BLACK, error: Rgb::BLACK };
        if sampled.lamps.is_empty() && sampled.picks.is_none() && sampled.around.is_none() {
            return nothing;
        }
        let (mut done, mut count) = (0, self.options.rays.clamp(1, SETS * MOST_RAYS).div_ceil(SETS));
        loop {
            for set in 0..SETS {
                let sampler = Sampler::new(self.options.seed, number, set);
                // The set's rays from number `done` on: the first ones, or as many as there were.
                let drawn = Drawn { sampler, sample: u32::from(done > 0), depth: 0 };
                self.send(at, &drawn, (set as usize, count), sampled);
            }
            done += count;
            let found = sampled.irradiance(done);
            let sure = self.options.max_error.is_none_or(|limit| found.error.max_channel() <= limit);
            if sure || done >= MOST_RAYS {
                return found;
            }
            count = done;
        }
    }

    /// Sends the rays of a set.
    fn send(&self, at: &LitPoint, drawn: &Drawn, (set, count): (usize, u32), sampled: &mut Sampled<'a>) {
        for (number, lamp, tally) in &mut sampled.lamps {
            for (_, ray) in LampRays::new(lamp, *number, at, drawn, count).above() {
                tally.add(set, ray.share, !(lamp.shadow && self.is_blocked(&ray.ray, ray.span)));
            }
        }
        if let Some(around) = &mut sampled.around {
            let frame = Frame::without_eye(self.snapshot, &self.view);
            let (leaving, bounces) =
                (self.held.first().copied(), self.options.integrator == Integrator::Path);
            for k in 0..count {
                let sample = drawn.sample.wrapping_mul(count).wrapping_add(k);
                let u = drawn.sampler.pair(sample, pairs::DIRECTION).map(share);
                let (direction, _) = Diffuse::direction(at.normal.into(), u);
                let numbers = Numbers { sampler: drawn.sampler, sample };
                let found = light_along(&frame, (at.point, direction.into()), leaving, &numbers, bounces);
                around.add(set, found * PI);
            }
        }
        let lamps = self.snapshot.lamps();
        if let (Some(picks), Some(tree)) = (&mut sampled.picks, &lamps.tree) {
            for found in picked(lamps, tree, at, self.snapshot.origin_in_frame(), drawn, count) {
                let ray = found.ray;
                if !(found.lamp.shadow && self.is_blocked(&ray.ray, ray.span)) {
                    picks.add(set, found.lamp.radiance.rgb() * (ray.share * f64::from(count)));
                }
            }
        }
    }
}

impl Sampled<'_> {
    /// What has been found, by so many rays of each set to each lamp.
    fn irradiance(&self, rays: u32) -> Irradiance {
        let (mut mean, mut variance) = (Rgb::BLACK, Rgb::BLACK);
        for (_, lamp, tally) in &self.lamps {
            let ((seen, error), radiance) = (tally.seen(), lamp.radiance.rgb());
            mean += radiance * seen;
            variance += radiance * radiance * (error * error);
        }
        for picks in self.picks.iter().chain(&self.around) {
            let (found, error) = picks.found(rays);
            mean += found;
            variance += error * error;
        }
        Irradiance { mean, error: variance.map(f64::sqrt) }
    }
}
