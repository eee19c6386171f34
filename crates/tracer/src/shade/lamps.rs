//! Light from surfaces: adds what every lamp contributes to the packets of a chunk. In lanes where a lamp has straight edges
//! and at most one ball hides some of it, point by point in `f64` elsewhere.

use catoptra_core::contour::Scratch;
use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, LaneMask, Material, Rgb, ShadingPoint, Shape};
use fearless_simd::Simd;

use super::Shader;
use super::lamp_rays::{QuadRays, Weights, open_share};
use crate::cull::Candidates;
use crate::lamps::{
    BallOutline, Drawn, Gathered, LampRay, LampRays, LitPoint, Outline, follow, follow_picked, gather, picked,
};
use crate::lanes::{D3, F, F3, M, U, narrow3, outlined, splat_wide, widen3};
use crate::numeric::{CUT_MARGIN, SMALL_LAMP};
use crate::search::{FromPoint, Refined, ViewCones};
use crate::snapshot::{FlatLamp, LampRow, LampTree};
use crate::stream::Batch;
use crate::{SurfaceId, Tile};

/// Room for light from surfaces, kept from tile to tile.
#[derive(Default)]
pub(crate) struct LampRoom {
    scratch: Scratch,
    /// Rays from a point to lamps, and whether each is blocked.
    rays: FromPoint,
    blocked: Vec<bool>,
    /// How much would arrive along each.
    weights: Weights,
    /// Every shape.
    all: Candidates,
}

/// The points of a packet as lamps see them.
struct LitPacket<S: Simd> {
    slot: usize,
    depth: u32,
    /// Places of its pixels in the tile's columns.
    pixels: U<S>,
    /// In `f64`, relative to the snapshot's origin.
    refined: Refined<S>,
}

impl<'a, S: Simd> Shader<'a, S> {
    /// Adds what lamps contribute to the first packets of the chunk.
    #[inline(always)]
    pub(crate) fn add_lamps(&mut self, batch: &impl Batch<S>, count: usize, tile: &Tile, depth: u32) {
        if self.search.snapshot.lamps().rows.is_empty() {
            return;
        }
        for slot in 0..count {
            let lit = self.chunk.lit[slot];
            if !lit.any() {
                continue;
            }
            let (packet, best) = (self.packet_of(batch, slot), self.chunk.best[slot]);
            let pixels = batch.pixels(self.s, packet.at);
            let refined = self.search.refine_every(&packet, &best, lit);
            let at = LitPacket { slot, depth, pixels, refined };
            self.light_packet(&at, tile);
        }
    }

    /// Adds what every lamp contributes to a packet, wherever that comes from.
    #[inline(always)]
    fn light_packet(&mut self, at: &LitPacket<S>, tile: &Tile) {
        outlined(
            self.s,
            #[inline(always)]
            || {
                if let Some(tree) = &self.search.snapshot.lamps().tree {
                    for lane in self.chunk.lit[at.slot].lanes() {
                        self.add_picked(at, lane, tree, tile);
                    }
                }
                for number in 0..self.plan.lamps.len() {
                    self.add_lamp(at, number, tile);
                }
            },
        );
    }

    /// Adds what a lamp contributes to a packet.
    #[inline(always)]
    fn add_lamp(&mut self, at: &LitPacket<S>, number: usize, tile: &Tile) {
        let lit = self.chunk.lit[at.slot];
        if !self.plan.lamps[number].reached {
            self.search.stats.lamps.facing_away += lit.count();
            return;
        }
        let lamp = &self.search.snapshot.lamps().rows[number];
        let none = M::splat(self.s, false);
        let mut found = FoundInLanes { seen: F::splat(self.s, 0.0), answered: none, sampled: none };
        if let Some(flat) = &lamp.flat
            && !self.chunk.glossy[at.slot]
        {
            found = self.seen_of_flat(at, lamp, flat, number);
        }
        let FoundInLanes { mut seen, answered, sampled } = found;
        for lane in sampled.lanes() {
            let open = f64::from(seen.lane(lane));
            let found = match &lamp.flat {
                Some(flat) => self.sample_in_lane(at, lane, flat, number, open, tile),
                None => None,
            };
            seen.set(lane, found.unwrap_or_else(|| self.seen_in_lane(at, lane, lamp, number, tile)) as f32);
        }
        for lane in (lit & !answered & !sampled).lanes() {
            seen.set(lane, self.seen_in_lane(at, lane, lamp, number, tile) as f32);
        }
        let radiance = F3::of(seen, &lamp.radiance);
        self.chunk.irradiance[at.slot] = radiance.scale_add(seen, self.chunk.irradiance[at.slot]);
    }

    /// What a packet sees of a flat lamp with straight edges under unit radiance, where lanes can tell.
    #[inline(always)]
    fn seen_of_flat(
        &mut self,
        at: &LitPacket<S>,
        lamp: &LampRow,
        flat: &FlatLamp,
        number: usize,
    ) -> FoundInLanes<S> {
        let (s, slot, point) = (self.s, at.slot, at.refined.point);
        let (zero, none) = (F::splat(s, 0.0), M::splat(s, false));
        let from_point = |to: DVec3| narrow3(splat_wide(s, to) - point);
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| from_point(flat.corners()[i % flat.corners().len()]));
        let own = narrow3(splat_wide(s, flat.normal));
        let above = -a.dot(own);
        let (front, behind) = (zero.less(above), above.less(zero));
        let faced = if flat.two_sided { front | behind } else { front };
        let smooth = self.search.snapshot.columns().smooth;
        let ground = self.chunk.normal[slot];
        let normal = if smooth { self.chunk.smooth[slot] } else { ground };
        // As seen from outside the sphere of directions, corners run counter-clockwise for a point behind the lamp.
        let outline = if flat.corners().len() == 4 {
            let (second, last) = (F3::select(front, d, b), F3::select(front, b, d));
            Outline::new(&[a, second, c, last], normal, normal)
        } else {
            let (second, last) = (F3::select(front, c, b), F3::select(front, b, c));
            Outline::new(&[a, second, last], normal, normal)
        };
        let mut answered = self.chunk.lit[slot] & !is_small(from_point(lamp.ball.center), lamp.ball.radius);
        if smooth {
            // Two normals have two horizons: lanes know of those that cut nothing off.
            let below = |v: F3<S>| v.dot(normal).less(zero) | v.dot(ground).less(zero);
            answered = answered & !(below(a) | below(b) | below(c) | below(d));
        }
        let open = F::pick(faced, outline.open(), zero);
        let seeing = answered & zero.less(open);
        let (mut hidden, mut touched, mut sampled) = (zero, none, none);
        let snapshot = self.search.snapshot;
        for at_blocker in 0..self.plan.lamps[number].blockers.len() {
            let prim = self.plan.lamps[number].blockers[at_blocker];
            let own = self.chunk.best[slot].prim.is(prim);
            let ball = match &snapshot.prims()[prim as usize].shape {
                Shape::Sphere(ball) if self.search.outside || !own.any() => ball,
                Shape::Mesh(_) => {
                    let [e, f, g, h, i] = outline.planes();
                    let cones =
                        ViewCones { tip: point, planes: [e, f, g, h, i, ground], lanes: seeing & !sampled };
                    sampled = sampled | self.search.reaches_into(prim, &cones);
                    continue;
                }
                _ => return FoundInLanes { seen: zero, answered: none, sampled: none },
            };
            let center = ball.center() - snapshot.origin_in_frame();
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
            touched = touched | met;
            hidden = F::pick(met & before, outline.hidden_by(&seen, normal), hidden);
        }
        let sampled = sampled & answered;
        let seen = F::pick(sampled, open, (open - hidden).max(zero));
        let answered = answered & !sampled;
        let stats = &mut self.search.stats.lamps;
        stats.facing_away += (answered & !seeing).count();
        stats.past_a_ball += (answered & seeing & touched).count();
        stats.open += (answered & seeing & !touched).count();
        stats.sampled += sampled.count();
        FoundInLanes { seen, answered, sampled }
    }

    /// What a point sees of a rectangle that would give `open` if nothing blocked it; `None` if it is none.
    fn sample_in_lane(
        &mut self,
        at: &LitPacket<S>,
        lane: usize,
        flat: &FlatLamp,
        number: usize,
        open: f64,
        tile: &Tile,
    ) -> Option<f64> {
        let here = self.point_in_lane(at, lane, tile);
        let rays = QuadRays::new(flat, here.shading.position.into(), here.lit.normal)?;
        Some(open * self.open_share(&rays, &here, number))
    }

    /// A point of a packet, in `f64`.
    fn point_in_lane(&self, at: &LitPacket<S>, lane: usize, tile: &Tile) -> LanePoint<'a> {
        let (snapshot, slot) = (self.search.snapshot, at.slot);
        let vector = |v: D3<S>| DVec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane));
        let front = self.chunk.front[slot].bits() >> lane & 1 == 1;
        let best = &self.chunk.best[slot];
        let surface = SurfaceId { prim: best.prim.lane(lane), facet: best.facet.lane(lane) };
        let position = vector(at.refined.point);
        let side = if front { 1.0 } else { -1.0 };
        let [normal, ground] = [at.refined.shading, at.refined.normal].map(|normal| vector(normal) * side);
        let to_viewer = vector(widen3(self.chunk.to_viewer[slot]));
        let [x, y] = tile.place_of(at.pixels.lane(lane) as usize);
        LanePoint {
            lit: LitPoint {
                point: position + snapshot.origin_in_frame(),
                normal,
                ground,
                surface: Some(surface),
            },
            shading: ShadingPoint {
                position: position.into(),
                normal: normal.into(),
                to_viewer: to_viewer.into(),
                distance: f64::from(best.t.lane(lane)),
                front,
            },
            material: &snapshot.materials()[snapshot.prims()[surface.prim as usize].material as usize],
            drawn: Drawn { sampler: self.sample.sampler(x, y), sample: self.sample.index, depth: at.depth },
        }
    }

    /// What a point sees of a lamp under unit radiance; adds what its glossy lobes show to the packet's.
    fn seen_in_lane(
        &mut self,
        at: &LitPacket<S>,
        lane: usize,
        lamp: &LampRow,
        number: usize,
        tile: &Tile,
    ) -> f64 {
        let snapshot = self.search.snapshot;
        let here = self.point_in_lane(at, lane, tile);
        let blockers = &self.plan.lamps[number].blockers;
        let open = !lamp.shadow || blockers.is_empty();
        let (scratch, stats) = (&mut self.lamp_room.scratch, &mut self.search.stats.lamps);
        let gathered = gather(snapshot, lamp, blockers.iter().copied(), &here.lit, scratch, stats);
        let glossy = self.chunk.glossy[at.slot] && gathered != Gathered::Exactly(0.0);
        if let (Gathered::Exactly(seen), false) = (gathered, glossy) {
            return seen;
        }
        if let (Gathered::UpTo(open), false, Some(flat)) = (gathered, glossy, &lamp.flat)
            && let Some(rays) = QuadRays::new(flat, here.shading.position.into(), here.lit.normal)
        {
            return open * self.open_share(&rays, &here, number);
        }
        let rays = LampRays::new(lamp, number, &here.lit, &here.drawn, self.view.lamp_rays_of_sample());
        if !open {
            self.aim(rays.above(), &here.lit);
            self.trace(Some(number));
        }
        let mut blocked = self.lamp_room.blocked.iter();
        let lobes = here.material.lobes(&here.shading);
        let (found, shown) = follow(&rays, &here.shading, &lobes, |_| !open && blocked.next() == Some(&true));
        if glossy {
            self.add_glossy(at.slot, lane, shown * lamp.radiance.rgb());
        }
        found.of(gathered)
    }

    /// Which share of what would arrive from a rectangle does arrive.
    fn open_share(&mut self, rays: &QuadRays, here: &LanePoint<'_>, number: usize) -> f64 {
        let room = &mut *self.lamp_room;
        room.rays.start(here.lit.point, self.search.snapshot.origin_in_frame(), here.lit.surface);
        let (count, pair) = (self.view.lamp_rays_of_sample(), here.drawn.pair_of(number));
        outlined(
            self.s,
            #[inline(always)]
            || rays.aim(self.s, &here.drawn, pair, count, &mut room.rays, &mut room.weights),
        );
        self.search.stats.rays.lamp += room.rays.len() as u64;
        self.trace(Some(number));
        let LampRoom { rays, weights, blocked, .. } = &mut *self.lamp_room;
        if here.lit.ground != here.lit.normal {
            for (i, blocked) in blocked.iter_mut().enumerate() {
                *blocked |= !(rays.to(i).dot(here.lit.ground) > 0.0);
            }
        }
        open_share(weights, blocked)
    }

    /// Adds what lamps that a tree picks contribute to a point.
    fn add_picked(&mut self, at: &LitPacket<S>, lane: usize, tree: &LampTree, tile: &Tile) {
        let snapshot = self.search.snapshot;
        let here = self.point_in_lane(at, lane, tile);
        self.search.stats.lamps.sampled += 1;
        let (origin, count) = (snapshot.origin_in_frame(), self.view.lamp_rays_of_sample());
        let rays = || picked(snapshot.lamps(), tree, &here.lit, origin, &here.drawn, count);
        self.aim(rays().filter(|ray| ray.lamp.shadow).map(|ray| ray.ray), &here.lit);
        self.lamp_room.all.all(snapshot.columns());
        self.trace(None);
        let mut blocked = self.lamp_room.blocked.iter();
        let lobes = here.material.lobes(&here.shading);
        let shone = follow_picked(rays(), &here.shading, &lobes, |ray| {
            ray.lamp.shadow && blocked.next() == Some(&true)
        });
        let irradiance = &mut self.chunk.irradiance[at.slot];
        add_in_lane(irradiance, lane, shone.irradiance);
        if self.chunk.glossy[at.slot] {
            self.add_glossy(at.slot, lane, shone.glossy);
        }
    }

    /// Gathers the rays from a point to lamps that need to be traced.
    fn aim(&mut self, rays: impl Iterator<Item = LampRay>, here: &LitPoint) {
        let room = &mut self.lamp_room.rays;
        room.start(here.point, self.search.snapshot.origin_in_frame(), here.surface);
        for LampRay { ray, span, .. } in rays {
            room.push(ray.direction, span.max);
        }
        self.search.stats.rays.lamp += room.len() as u64;
    }

    /// Finds out which of the gathered rays the blockers of a lamp block, or of those anything does.
    fn trace(&mut self, lamp: Option<usize>) {
        let LampRoom { rays, blocked, all, .. } = &mut *self.lamp_room;
        let among = match lamp {
            Some(number) => &self.plan.lamps[number].among,
            None => all,
        };
        let search = &mut self.search;
        outlined(
            self.s,
            #[inline(always)]
            || search.blocked_from(rays, among, blocked),
        );
    }

    fn add_glossy(&mut self, slot: usize, lane: usize, light: Rgb) {
        add_in_lane(&mut self.chunk.specular[slot], lane, light);
    }
}

/// What lanes know of a lamp.
struct FoundInLanes<S: Simd> {
    /// Irradiance under unit radiance, where it is known; where rays are needed, what it would be if all were open.
    seen: F<S>,
    answered: M<S>,
    /// Lanes that need rays.
    sampled: M<S>,
}

/// Where a lamp is so small, seen from a point, that `f32` does not do.
#[inline(always)]
fn is_small<S: Simd>(away: F3<S>, radius: f64) -> M<S> {
    let radius = away.x.number(radius);
    (radius * radius).less(away.dot(away) * away.x.number(f64::from(SMALL_LAMP * SMALL_LAMP)))
}

/// A point of a packet, in `f64`.
struct LanePoint<'a> {
    lit: LitPoint,
    shading: ShadingPoint<f64>,
    material: &'a Material,
    drawn: Drawn,
}

fn add_in_lane<S: Simd>(sum: &mut F3<S>, lane: usize, light: Rgb) {
    for (channel, light) in [&mut sum.x, &mut sum.y, &mut sum.z].into_iter().zip(light.to_array()) {
        channel.set(lane, channel.lane(lane) + light as f32);
    }
}
