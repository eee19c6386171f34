//! Light from surfaces: adds what every lamp contributes to the packets of a chunk. In lanes where a lamp has straight edges
//! and at most one ball hides some of it, point by point in `f64` elsewhere.

use catoptra_core::contour::Scratch;
use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, LaneMask, Rgb, ShadingPoint, Shape};
use fearless_simd::Simd;

use super::Shader;
use crate::lamps::{BallOutline, Drawn, Gathered, LampRays, LitPoint, Outline, follow, gather};
use crate::lanes::{D3, F, F3, M, narrow3, outlined, splat_wide};
use crate::numeric::{CUT_MARGIN, SMALL_LAMP};
use crate::rays::RayList;
use crate::sampler::Sampler;
use crate::search::Refined;
use crate::snapshot::{FlatLamp, LampRow};
use crate::stream::Batch;
use crate::{SurfaceId, Tile};

/// Room for light from surfaces, kept from tile to tile.
#[derive(Default)]
pub(crate) struct LampRoom {
    scratch: Scratch,
    /// Rays to a lamp, whether each is blocked, and how many each point has.
    rays: RayList,
    blocked: Vec<bool>,
}

/// The points of a packet as lamps see them.
struct LitPacket<S: Simd> {
    slot: usize,
    depth: u32,
    /// In `f64`, relative to the snapshot's origin.
    refined: Refined<S>,
}

impl<S: Simd> Shader<'_, S> {
    /// Adds what lamps contribute to the first packets of the chunk.
    #[inline(always)]
    pub(crate) fn add_lamps(&mut self, batch: &impl Batch<S>, count: usize, tile: &Tile, depth: u32) {
        if self.plan.lamps.is_empty() {
            return;
        }
        for slot in 0..count {
            if self.chunk.lit[slot].any() {
                outlined(
                    self.s,
                    #[inline(always)]
                    || self.add_lamps_to(batch, slot, tile, depth),
                );
            }
        }
    }

    /// Adds what every lamp contributes to a packet.
    #[inline(always)]
    fn add_lamps_to(&mut self, batch: &impl Batch<S>, slot: usize, tile: &Tile, depth: u32) {
        let (packet, best) = (self.packet_of(batch, slot), self.chunk.best[slot]);
        let lit = self.chunk.lit[slot];
        let at = LitPacket { slot, depth, refined: self.search.refine_every(&packet, &best, lit) };
        for number in 0..self.plan.lamps.len() {
            if !self.plan.lamps[number].reached {
                self.search.stats.lamps.facing_away += lit.count();
                continue;
            }
            let lamp = &self.search.snapshot.lamps().rows[number];
            let (mut seen, mut answered) = (F::splat(self.s, 0.0), M::splat(self.s, false));
            if let Some(flat) = &lamp.flat
                && !self.chunk.glossy[slot]
            {
                (seen, answered) = self.seen_of_flat(&at, lamp, flat, number);
            }
            for lane in (lit & !answered).lanes() {
                let pixel = batch.pixels(self.s, self.chunk.at[slot]).lane(lane);
                let irradiance = self.seen_in_lane(&at, lane, lamp, number, tile.place_of(pixel as usize));
                seen.set(lane, irradiance as f32);
            }
            let radiance = F3::of(seen, &lamp.radiance);
            self.chunk.irradiance[slot] = radiance.scale_add(seen, self.chunk.irradiance[slot]);
        }
    }

    /// What a packet sees of a flat lamp with straight edges under unit radiance, and the lanes for which that is known.
    #[inline(always)]
    fn seen_of_flat(
        &mut self,
        at: &LitPacket<S>,
        lamp: &LampRow,
        flat: &FlatLamp,
        number: usize,
    ) -> (F<S>, M<S>) {
        let (s, slot, point) = (self.s, at.slot, at.refined.point);
        let lit = self.chunk.lit[slot];
        let none = M::splat(s, false);
        if self.search.snapshot.columns().smooth {
            return (F::splat(s, 0.0), none);
        }
        let from_point = |to: DVec3| narrow3(splat_wide(s, to) - point);
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| from_point(flat.corners()[i % flat.corners().len()]));
        let zero = F::splat(s, 0.0);
        let own = flat.normal.as_vec3();
        let above = -(a.x * F::splat(s, own.x) + a.y * F::splat(s, own.y) + a.z * F::splat(s, own.z));
        let (front, behind) = (zero.less(above), above.less(zero));
        let faced = if flat.two_sided { front | behind } else { front };
        // As seen from outside the sphere of directions, corners run counter-clockwise for a point behind the lamp.
        let normal = self.chunk.normal[slot];
        let outline = if flat.corners().len() == 4 {
            let (second, last) = (F3::select(front, d, b), F3::select(front, b, d));
            Outline::new(&[a, second, c, last], normal, normal)
        } else {
            let (second, last) = (F3::select(front, c, b), F3::select(front, b, c));
            Outline::new(&[a, second, last], normal, normal)
        };
        let away = from_point(lamp.ball.center);
        let small = away.dot(away) * F::splat(s, SMALL_LAMP * SMALL_LAMP);
        let radius = F::splat(s, lamp.ball.radius as f32);
        let mut answered = lit & !(radius * radius).less(small);
        let open = F::pick(faced, outline.open(), zero);
        let seeing = answered & zero.less(open);
        let (mut hidden, mut touched) = (zero, none);
        for at_blocker in 0..self.plan.lamps[number].blockers.len() {
            let prim = self.plan.lamps[number].blockers[at_blocker];
            let Shape::Sphere(ball) = &self.search.snapshot.prims()[prim as usize].shape else {
                return (zero, none);
            };
            let center = ball.center() - self.search.snapshot.origin_in_frame();
            let own = self.chunk.best[slot].prim.is(prim);
            if own.any() && !self.search.outside {
                return (zero, none);
            }
            let towards = from_point(center);
            let radius = F::splat(s, ball.radius() as f32);
            let inside = towards.dot(towards).less(radius * radius * F::splat(s, 1.0 + CUT_MARGIN));
            let seen = BallOutline::new(towards, radius);
            let met = seeing & !own & (outline.may_be_hidden_by(&seen) | inside);
            if !met.any() {
                continue;
            }
            // Wholly on one side of the lamp's plane, it stands before the lamp or never does.
            let height = flat.normal.dot(center - flat.corners()[0]) / ball.radius();
            let cut = height.abs() < 1.0 + f64::from(CUT_MARGIN);
            let before = if height > 0.0 { front } else { behind };
            answered = answered & !(met & (inside | touched | M::splat(s, cut)));
            let hides = met & before & answered;
            touched = touched | met;
            hidden = F::pick(hides, outline.hidden_by(&seen, normal), hidden);
        }
        let seen = (open - hidden).max(zero);
        let stats = &mut self.search.stats.lamps;
        stats.facing_away += (answered & !seeing).count();
        let past = answered & touched;
        stats.past_a_ball += past.count();
        stats.open += (answered & seeing & !touched).count();
        (seen, answered)
    }

    /// What a point sees of a lamp under unit radiance; adds what its glossy lobes show to the packet's.
    fn seen_in_lane(
        &mut self,
        at: &LitPacket<S>,
        lane: usize,
        lamp: &LampRow,
        number: usize,
        pixel: [u32; 2],
    ) -> f64 {
        let snapshot = self.search.snapshot;
        let slot = at.slot;
        let vector = |v: D3<S>| DVec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane));
        let front = self.chunk.front[slot].bits() >> lane & 1 == 1;
        let side = if front { 1.0 } else { -1.0 };
        let best = self.chunk.best[slot];
        let surface = SurfaceId { prim: best.prim.lane(lane), facet: best.facet.lane(lane) };
        let position = vector(at.refined.point);
        let lit = LitPoint {
            point: position + snapshot.origin_in_frame(),
            normal: vector(at.refined.shading) * side,
            surface: Some(surface),
        };
        let blockers = self.plan.lamps[number].blockers.iter().copied();
        let gathered =
            gather(snapshot, lamp, blockers, &lit, &mut self.lamp_room.scratch, &mut self.search.stats.lamps);
        let material = &snapshot.materials()[snapshot.prims()[surface.prim as usize].material as usize];
        let glossy = self.chunk.glossy[slot] && gathered != Gathered::Exactly(0.0);
        if let (Gathered::Exactly(seen), false) = (gathered, glossy) {
            return seen;
        }
        let drawn = Drawn {
            sampler: Sampler::new(self.view.seed, pixel[0], pixel[1]),
            sample: self.sample,
            depth: at.depth,
        };
        let rays = LampRays::new(lamp, number, &lit, &drawn, self.view.lamp_rays);
        let open = !lamp.shadow || self.plan.lamps[number].blockers.is_empty();
        if !open {
            self.trace_to_lamp(&rays, surface);
        }
        let to_viewer = self.chunk.to_viewer[slot];
        let viewer = DVec3::new(
            f64::from(to_viewer.x.lane(lane)),
            f64::from(to_viewer.y.lane(lane)),
            f64::from(to_viewer.z.lane(lane)),
        );
        let point = ShadingPoint {
            position: position.into(),
            normal: lit.normal.into(),
            to_viewer: viewer.into(),
            distance: f64::from(best.t.lane(lane)),
            front,
        };
        let mut at_ray = 0;
        let blocked = &self.lamp_room.blocked;
        let (found, shown) = follow(&rays, &point, &material.lobes(&point), |_| {
            at_ray += 1;
            !open && blocked[at_ray - 1]
        });
        if glossy {
            self.add_glossy(slot, lane, shown * lamp.radiance.rgb());
        }
        found.of(gathered)
    }

    /// Finds out which rays to a lamp are blocked, of those above the surface.
    fn trace_to_lamp(&mut self, rays: &LampRays, surface: SurfaceId) {
        let frame = self.search.snapshot.frame();
        let room = &mut *self.lamp_room;
        room.rays.clear();
        for lamp_ray in rays.above() {
            let ray = catoptra_core::Ray::new(lamp_ray.ray.origin + frame, lamp_ray.ray.direction);
            room.rays.push(&ray, [0.0, lamp_ray.span.max], Some(surface));
        }
        room.blocked.clear();
        room.blocked.resize(room.rays.len().next_multiple_of(F::<S>::LANES), false);
        self.search.stats.rays.lamp += room.rays.len() as u64;
        let (search, s) = (&mut self.search, self.s);
        outlined(
            s,
            #[inline(always)]
            || search.occluded_rays(room.rays.as_slice(), &mut room.blocked),
        );
    }

    fn add_glossy(&mut self, slot: usize, lane: usize, light: Rgb) {
        let specular = &mut self.chunk.specular[slot];
        for (channel, light) in
            [&mut specular.x, &mut specular.y, &mut specular.z].into_iter().zip(light.to_array())
        {
            channel.set(lane, channel.lane(lane) + light as f32);
        }
    }
}
