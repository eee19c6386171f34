//! What lights make the lanes of a packet show, and which ways to them are asked about.

use catoptra_core::{Arithmetic, Arrival, Lane, LaneMask, Triple};
use fearless_simd::Simd;

use super::Tracer;
use super::meet::Here;
use super::packet::{Left, drift};
use super::settle::Groups;
use super::shadow::Ways;
use crate::kernel::{Rays, Target, magnitude};
use crate::lanes::{F, F3, M};
use crate::numeric::POINT_ERROR;

impl<S: Simd> Tracer<'_, S> {
    /// The surfaces' own look, in the share that is not reflected.
    #[inline(always)]
    pub(super) fn local(&mut self, here: &Here<'_, S>) -> F3<S> {
        let Here { meeting, groups, .. } = here;
        let snapshot = self.frame.snapshot;
        let mut shown = super::dark(self.s);
        let mut lit = M::splat(self.s, false);
        let ambient = Triple::of(shown.x, snapshot.ambient_light());
        for group in 0..groups.len() {
            let (mask, material) = groups.get(self.s, group);
            let row = &snapshot.material_rows()[material];
            if row.kept.narrow > 0.0 {
                let own = row.material.own(&meeting.shading);
                let own = row.material.under_ambient(&meeting.shading).times_add(ambient, own);
                shown = F3::select(mask, own, shown);
            }
            if row.answers_light {
                lit = lit | mask;
            }
        }
        let lights = snapshot.light_rows();
        self.stats.skipped.unlit_material += (meeting.hits & !lit).count() * lights.len() as u64;
        if lit.any() {
            for light in 0..lights.len() {
                shown = self.add_light(here, lit, light, shown);
            }
        }
        self.keep_unreflected(groups, shown)
    }

    /// Multiplies by the share that is not reflected.
    #[inline(always)]
    fn keep_unreflected(&self, groups: &Groups, shown: F3<S>) -> F3<S> {
        let mut kept = shown;
        for group in 0..groups.len() {
            let (mask, material) = groups.get(self.s, group);
            let row = &self.frame.snapshot.material_rows()[material];
            if row.reflects() {
                kept = F3::select(mask, shown.scale(shown.x.of(row.kept)), kept);
            }
        }
        kept
    }

    /// Adds what one light makes the lanes of `lit` show.
    #[inline(always)]
    fn add_light(&mut self, here: &Here<'_, S>, lit: M<S>, light: usize, shown: F3<S>) -> F3<S> {
        let Here { meeting, groups, .. } = here;
        let zero = F::splat(self.s, 0.0);
        let row = &self.frame.snapshot.light_rows()[light];
        let arrival = row.light.arriving(meeting.point);
        let in_cone = lit & arrival.lit;
        self.stats.skipped.out_of_cone += (lit & !arrival.lit).count();
        let cosine = arrival.towards.dot(meeting.shading.normal);
        let mut facing = in_cone & zero.less(cosine);
        if self.frame.snapshot.columns().smooth {
            facing = facing & zero.less(arrival.towards.dot(meeting.normal));
        }
        self.stats.skipped.facing_away += (in_cone & !facing).count();
        if !facing.any() {
            return shown;
        }
        let reached = if !row.shadow {
            self.stats.skipped.shadow_off += facing.count();
            facing
        } else if self.between[light].is_empty() && self.frame.snapshot.columns().general_unbounded.is_empty()
        {
            self.stats.skipped.nothing_between += facing.count();
            facing
        } else {
            self.stats.rays.shadow += facing.count();
            facing & !self.shadowed(here, facing, light, &arrival)
        };
        if !reached.any() {
            return shown;
        }
        let mut sum = shown;
        for group in 0..groups.len() {
            let (mask, material) = groups.get(self.s, group);
            let lanes = mask & reached;
            if lanes.any() {
                let material = &self.frame.snapshot.material_rows()[material].material;
                let response = material.under_light(&meeting.shading, arrival.towards, cosine);
                sum = F3::select(lanes, response.times_add(arrival.irradiance, sum), sum);
            }
        }
        sum
    }

    /// Lanes whose way to a light is blocked.
    #[inline(always)]
    fn shadowed(&mut self, here: &Here<'_, S>, facing: M<S>, light: usize, arrival: &Arrival<F<S>>) -> M<S> {
        let Here { packet, best, meeting, .. } = here;
        let row = &self.frame.snapshot.light_rows()[light];
        let ways = Ways {
            rays: Rays {
                origin: meeting.point,
                direction: arrival.towards,
                reach: best.error.mul_add(
                    F::splat(self.s, 1.0 / POINT_ERROR),
                    magnitude(meeting.point)
                        + F::splat(self.s, row.reach + drift(self.frame.snapshot.origin_in_frame())),
                ),
            },
            left: Left { prim: best.prim, facet: best.facet, any: true },
            live: facing,
            target: Target {
                distance: arrival.distance,
                place: row.place,
                in_frame: row.in_frame,
                at_infinity: row.at_infinity,
            },
        };
        self.blocked(packet, &ways, light)
    }
}
