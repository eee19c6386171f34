//! What lights make the lanes of a packet show, and which ways to them are asked about.

use catoptra_core::{Arrival, Lane, LaneMask, Light};
use fearless_simd::Simd;

use super::Tracer;
use super::meet::Meeting;
use super::packet::Packet;
use super::search::Best;
use crate::kernel::{Rays, Target, magnitude};
use crate::lanes::{F, F3, M, splat3};

impl<S: Simd> Tracer<'_, S> {
    /// The surfaces' own look, in the share that is not reflected.
    #[inline(always)]
    pub(super) fn local(&mut self, packet: &Packet<S>, best: &Best<S>, meeting: &Meeting<S>) -> F3<S> {
        let snapshot = self.frame.snapshot;
        let mut shown = super::dark(self.s);
        let mut lit = M::splat(self.s, false);
        let ambient = splat3(self.s, snapshot.ambient().to_array().map(|c| c as f32));
        for (mask, material) in meeting.groups.iter() {
            let material = &snapshot.materials()[material];
            if material.reflectiveness().wide >= 1.0 {
                continue;
            }
            let own = material.own(&meeting.shading);
            let own = material.under_ambient(&meeting.shading).times_add(ambient, own);
            shown = F3::select(mask, own, shown);
            if material.answers_light() {
                lit = lit | mask;
            }
        }
        let lights = snapshot.lights();
        self.stats.skipped.unlit_material += (meeting.hits & !lit).count() * lights.len() as u64;
        if lit.any() {
            for light in lights {
                self.add_light(packet, best, meeting, lit, light, &mut shown);
            }
        }
        self.keep_unreflected(meeting, shown)
    }

    /// Multiplies by the share that is not reflected.
    #[inline(always)]
    fn keep_unreflected(&self, meeting: &Meeting<S>, shown: F3<S>) -> F3<S> {
        let mut kept = shown;
        for (mask, material) in meeting.groups.iter() {
            let reflected = self.frame.snapshot.materials()[material].reflectiveness();
            if reflected.wide > 0.0 {
                let share = F::splat(self.s, (1.0 - reflected.wide) as f32);
                kept = F3::select(mask, shown.scale(share), kept);
            }
        }
        kept
    }

    /// Adds what one light makes the lanes of `lit` show.
    #[inline(always)]
    fn add_light(
        &mut self,
        packet: &Packet<S>,
        best: &Best<S>,
        meeting: &Meeting<S>,
        lit: M<S>,
        light: &Light,
        shown: &mut F3<S>,
    ) {
        let zero = F::splat(self.s, 0.0);
        let arrival = light.arriving(meeting.point);
        let in_cone = lit & arrival.lit;
        self.stats.skipped.out_of_cone += (lit & !arrival.lit).count();
        let cosine = arrival.towards.dot(meeting.shading.normal);
        let mut facing = in_cone & zero.less(cosine);
        if meeting.settled.shading.is_some() {
            facing = facing & zero.less(arrival.towards.dot(meeting.normal));
        }
        self.stats.skipped.facing_away += (in_cone & !facing).count();
        if !facing.any() {
            return;
        }
        let reached = if light.shadow() {
            self.stats.rays.shadow += facing.count();
            facing & !self.shadowed(packet, best, meeting, facing, light, &arrival)
        } else {
            self.stats.skipped.shadow_off += facing.count();
            facing
        };
        if !reached.any() {
            return;
        }
        for (mask, material) in meeting.groups.iter() {
            let lanes = mask & reached;
            if lanes.any() {
                let material = &self.frame.snapshot.materials()[material];
                let response = material.under_light(&meeting.shading, arrival.towards, cosine);
                *shown = F3::select(lanes, response.times_add(arrival.irradiance, *shown), *shown);
            }
        }
    }

    /// Lanes whose way to a light is blocked.
    #[inline(always)]
    fn shadowed(
        &mut self,
        packet: &Packet<S>,
        best: &Best<S>,
        meeting: &Meeting<S>,
        facing: M<S>,
        light: &Light,
        arrival: &Arrival<F<S>>,
    ) -> M<S> {
        let Some(target) = Target::of(light, arrival.distance) else { return M::splat(self.s, false) };
        let ways = Packet {
            origin: meeting.settled.point,
            direction: target.directions(self.s, meeting.settled.point),
            rays: Rays {
                origin: meeting.point,
                direction: arrival.towards,
                reach: magnitude(meeting.point) + target.reach(self.s),
            },
            inverse_length: target.inverse_length(self.s),
            weight: packet.weight,
            pixel: packet.pixel,
            left_prim: best.prim,
            left_facet: best.facet,
            leaves: true,
            live: facing,
        };
        self.blocked(&ways, &target)
    }
}
