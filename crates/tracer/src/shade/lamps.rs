//! Light from surfaces: adds what every lamp contributes to the packets of a chunk. In lanes where a lamp has straight edges
//! and at most one ball hides some of it, point by point in `f64` elsewhere.

use catoptra_core::contour::Scratch;
use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, LaneMask, Rgb, ShadingPoint, Shape, Triple};
use fearless_simd::Simd;

use super::Shader;
use crate::cull::is_few;
use crate::lamps::{
    BallOutline, Drawn, Gathered, LitPoint, Outline, PickedRay, follow_picked, gather, gather_for_rays,
    open_from_afar, picked,
};
use crate::lanes::{D3, F, F3, M, U, magnitude, narrow3, outlined, splat_wide, widen3};
use crate::numeric::{CUT_MARGIN, SMALL_LAMP};
use crate::search::{Refined, ViewCones};
use crate::snapshot::{Ball, FlatLamp, LampRow, LampTree};
use crate::stream::Batch;
use crate::{LampLight, Prim, SurfaceId, Tile};

/// Room for light from surfaces, kept from tile to tile.
#[derive(Default)]
pub(crate) struct LampRoom {
    scratch: Scratch,
}

/// The points of a packet as lamps see them.
pub(super) struct LitPacket<S: Simd> {
    pub(super) slot: usize,
    pub(super) depth: u32,
    /// Places of its pixels in the tile's columns.
    pub(super) pixels: U<S>,
    /// In `f64`, relative to the snapshot's origin.
    pub(super) refined: Refined<S>,
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
            && is_few(self.search.snapshot)
            && self.view.lamp_light == LampLight::Exact
        {
            found = self.seen_of_flat(at, lamp, flat, number);
        }
        let FoundInLanes { mut seen, mut answered, mut sampled } = found;
        if self.gathers.paths {
            // One ray tells paths as much: what they find by chance is off by more.
            seen = F::pick(answered, seen, F::splat(self.s, 1.0));
            (sampled, answered) = (!answered, !none);
        }
        for lane in (lit & !answered & !sampled).lanes() {
            let gathered = self.gather_in_lane(at, lane, number);
            let (Gathered::Exactly(irradiance) | Gathered::UpTo(irradiance)) = gathered;
            seen.set(lane, irradiance as f32);
            if matches!(gathered, Gathered::UpTo(_)) {
                sampled = sampled | M::from_bits(self.s, 1 << lane);
            }
        }
        let shown = lit & F::splat(self.s, 0.0).less(seen);
        let cast = if self.chunk.glossy[at.slot] { shown } else { shown & sampled };
        if cast.any() {
            let share = self.cast(at, lamp, number, (cast, seen), tile);
            seen = F::pick(sampled, seen * share, seen);
        }
        let radiance = F3::of(seen, &lamp.radiance);
        self.chunk.irradiance[at.slot] = radiance.scale_add(seen, self.chunk.irradiance[at.slot]);
    }

    /// How a packet sees a flat lamp with straight edges that nothing blocks.
    #[inline(always)]
    fn view_of_flat(&self, at: &LitPacket<S>, lamp: &LampRow, flat: &FlatLamp) -> FlatView<S> {
        let (s, slot, zero) = (self.s, at.slot, F::splat(self.s, 0.0));
        let (corners, point) = (flat.corners(), at.refined.point);
        let [a, b, c] = [way(s, point, corners[0]), way(s, point, corners[1]), way(s, point, corners[2])];
        let d = if corners.len() == 4 { way(s, point, corners[3]) } else { a };
        let above = -a.dot(narrow3(splat_wide(s, flat.normal)));
        let (front, behind) = (zero.less(above), above.less(zero));
        let faced = if lamp.two_sided { front | behind } else { front };
        let smooth = self.search.snapshot.columns().smooth;
        let ground = self.chunk.normal[slot];
        let normal = if smooth { self.chunk.smooth[slot] } else { ground };
        // As seen from outside the sphere of directions, corners run counter-clockwise for a point behind the lamp.
        let others = if corners.len() == 4 {
            [F3::select(front, d, b), c, F3::select(front, b, d)]
        } else {
            [F3::select(front, c, b), F3::select(front, b, c), a]
        };
        let outline = Outline::new(&[a, others[0], others[1], others[2]], corners.len(), normal, normal);
        let small = is_small(way(s, point, lamp.ball.center), lamp.ball.radius);
        let (mut known, mut open) = (self.chunk.lit[slot], outline.open());
        if smooth || small.any() {
            let mut cut = M::splat(s, false);
            for corner in [a, b, c, d] {
                cut = cut | corner.dot(normal).less(zero) | corner.dot(ground).less(zero);
            }
            // Two normals have two horizons: lanes know of those that cut nothing off.
            known = known & !(cut & (small | M::splat(s, smooth)));
            if corners.len() == 4 {
                open = F::pick(small, open_from_afar([a, b, d], normal, lamp.area), open);
            } else {
                known = known & !small;
            }
        }
        let open = F::pick(faced, open, zero);
        FlatView { outline, normal, front, behind, open, small, known }
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
        let FlatView { outline, normal, front, behind, open, small, known } =
            self.view_of_flat(at, lamp, flat);
        let (mut answered, ground) = (known, self.chunk.normal[slot]);
        let seeing = answered & zero.less(open);
        let (mut hidden, mut touched, mut sampled) = (zero, none, none);
        let snapshot = self.search.snapshot;
        for at_blocker in 0..self.plan.lamps[number].blockers.len() {
            let prim = self.plan.lamps[number].blockers[at_blocker];
            let own = self.chunk.best[slot].prim.is(prim);
            let Prim { shape, member, .. } = &snapshot.prims()[prim as usize];
            if member.is_some() {
                answered = answered & !(seeing & self.may_hide(&outline, prim, lamp, point));
                continue;
            }
            if shape.as_mesh().is_some() {
                let [e, f, g, h, i] = outline.planes();
                let cones =
                    ViewCones { tip: point, planes: [e, f, g, h, i, ground], lanes: seeing & !sampled };
                sampled = sampled | self.search.reaches_into(prim, &cones);
                continue;
            }
            // Points on a convex shape that is seen from outside have it below them, as those on a flat one have.
            let below =
                shape.bounds().is_none() || (self.search.outside && snapshot.columns().is_convex(prim));
            if !below {
                answered = answered & !own;
            }
            let Shape::Sphere(ball) = shape else {
                answered = answered & !(seeing & !own & self.may_hide(&outline, prim, lamp, point));
                continue;
            };
            let center = ball.center() - snapshot.origin_in_frame();
            let towards = way(s, point, center);
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
            let met = met & (before | M::splat(s, cut));
            answered = answered & !(met & (inside | touched | small | M::splat(s, cut)));
            touched = touched | met;
            hidden = F::pick(met, outline.hidden_by(&seen, normal), hidden);
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

    /// The lanes from which a shape that is no ball may hide some of a lamp.
    #[inline(always)]
    fn may_hide(&self, outline: &Outline<F<S>>, prim: u32, lamp: &LampRow, point: D3<S>) -> M<S> {
        let (s, snapshot) = (self.s, self.search.snapshot);
        let Some(bounds) = snapshot.prims()[prim as usize].bounds() else {
            return !self.is_beside_plane(prim, lamp, point);
        };
        let ball = Ball::round(bounds);
        let towards = way(s, point, ball.center - snapshot.origin_in_frame());
        let radius = F::splat(s, (ball.radius * (1.0 + f64::from(CUT_MARGIN))) as f32);
        let inside = towards.dot(towards).less(radius * radius);
        inside | outline.may_be_hidden_by(&BallOutline::new(towards, radius))
    }

    /// The lanes whose points lie on the same side of a plane as all of a lamp, clear of it.
    #[inline(always)]
    fn is_beside_plane(&self, prim: u32, lamp: &LampRow, point: D3<S>) -> M<S> {
        let (s, snapshot) = (self.s, self.search.snapshot);
        let Shape::Plane(plane) = &snapshot.prims()[prim as usize].shape else { return M::splat(s, false) };
        let (normal, on) = (plane.normal(), plane.point() - snapshot.origin_in_frame());
        let of_lamp = normal.dot(lamp.ball.center - on);
        let clear = of_lamp.abs() > lamp.ball.radius * (1.0 + f64::from(CUT_MARGIN));
        let from_plane = narrow3(point - splat_wide(s, on));
        let above = from_plane.dot(narrow3(splat_wide(s, normal * of_lamp.signum())));
        M::splat(s, clear) & (magnitude(from_plane) * F::splat(s, CUT_MARGIN)).less(above)
    }

    /// A point of a packet, in `f64`.
    fn lit_in_lane(&self, at: &LitPacket<S>, lane: usize) -> LitPoint {
        let vector = |v: D3<S>| DVec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane));
        let best = &self.chunk.best[at.slot];
        let side = if self.is_front(at, lane) { 1.0 } else { -1.0 };
        LitPoint {
            point: vector(at.refined.point) + self.search.snapshot.origin_in_frame(),
            normal: vector(at.refined.shading) * side,
            ground: vector(at.refined.normal) * side,
            surface: Some(SurfaceId { prim: best.prim.lane(lane), facet: best.facet.lane(lane) }),
        }
    }

    fn is_front(&self, at: &LitPacket<S>, lane: usize) -> bool {
        self.chunk.front[at.slot].bits() >> lane & 1 == 1
    }

    /// Where a point of a packet is seen, and from where, in `f64`.
    fn shading_in_lane(&self, at: &LitPacket<S>, lane: usize, lit: &LitPoint) -> ShadingPoint<f64> {
        let viewer = widen3(self.chunk.to_viewer[at.slot]);
        ShadingPoint {
            position: (lit.point - self.search.snapshot.origin_in_frame()).into(),
            normal: lit.normal.into(),
            to_viewer: Triple::new(viewer.x.lane(lane), viewer.y.lane(lane), viewer.z.lane(lane)),
            distance: f64::from(self.chunk.best[at.slot].t.lane(lane)),
            front: self.is_front(at, lane),
        }
    }

    /// What a point sees of a lamp under unit radiance, in `f64`.
    fn gather_in_lane(&mut self, at: &LitPacket<S>, lane: usize, number: usize) -> Gathered {
        let snapshot = self.search.snapshot;
        let lit = self.lit_in_lane(at, lane);
        let blockers = self.plan.lamps[number].blockers.iter().copied();
        let (scratch, stats) = (&mut self.lamp_room.scratch, &mut self.search.stats.lamps);
        let lamp = &snapshot.lamps().rows[number];
        match self.view.lamp_light {
            LampLight::Exact => gather(snapshot, lamp, blockers, &lit, scratch, stats),
            LampLight::Rays | LampLight::PlainRays => gather_for_rays(lamp, &lit, stats),
        }
    }

    /// Adds what lamps that a tree picks contribute to a point.
    fn add_picked(&mut self, at: &LitPacket<S>, lane: usize, tree: &LampTree, tile: &Tile) {
        let snapshot = self.search.snapshot;
        let lit = self.lit_in_lane(at, lane);
        let shading = self.shading_in_lane(at, lane, &lit);
        let [x, y] = tile.place_of(at.pixels.lane(lane) as usize);
        let drawn = Drawn { sampler: self.sample.sampler(x, y), sample: self.sample.index, depth: at.depth };
        let prim = self.chunk.best[at.slot].prim.lane(lane);
        let lobes = snapshot.materials()[snapshot.prims()[prim as usize].material as usize].lobes(&shading);
        let stats = &mut self.search.stats;
        stats.lamps.sampled += 1;
        let (origin, count) = (snapshot.origin_in_frame(), self.view.lamp_rays_of_sample());
        let rays = picked(snapshot.lamps(), tree, &lit, origin, &drawn, count);
        let shone = follow_picked(rays, &shading, &lobes, |PickedRay { lamp, ray }| {
            lamp.shadow && {
                stats.rays.lamp += 1;
                snapshot.occluded_in_frame(&ray.ray, ray.span, lit.surface)
            }
        });
        add_in_lane(&mut self.chunk.irradiance[at.slot], lane, shone.irradiance);
        if self.chunk.glossy[at.slot] {
            add_in_lane(&mut self.chunk.specular[at.slot], lane, shone.glossy);
        }
    }
}

/// A flat lamp with straight edges as the points of a packet see it.
struct FlatView<S: Simd> {
    outline: Outline<F<S>>,
    /// To shade with.
    normal: F3<S>,
    /// Lanes before and behind the lamp's plane.
    front: M<S>,
    behind: M<S>,
    /// Irradiance under unit radiance if nothing blocks it.
    open: F<S>,
    /// Lanes that see it so small that they know it only where nothing blocks it.
    small: M<S>,
    /// Lanes that know it.
    known: M<S>,
}

/// What lanes know of a lamp.
struct FoundInLanes<S: Simd> {
    /// Irradiance under unit radiance, where it is known; where rays are needed, what it would be if all were open.
    seen: F<S>,
    answered: M<S>,
    /// Lanes that need rays.
    sampled: M<S>,
}

/// The way from points to a place.
#[inline(always)]
fn way<S: Simd>(s: S, points: D3<S>, to: DVec3) -> F3<S> {
    narrow3(splat_wide(s, to) - points)
}

/// Where a lamp is so small, seen from a point, that `f32` does not do.
#[inline(always)]
fn is_small<S: Simd>(away: F3<S>, radius: f64) -> M<S> {
    let radius = away.x.number(radius);
    (radius * radius).less(away.dot(away) * away.x.number(f64::from(SMALL_LAMP * SMALL_LAMP)))
}

fn add_in_lane<S: Simd>(sum: &mut F3<S>, lane: usize, light: Rgb) {
    for (channel, light) in [&mut sum.x, &mut sum.y, &mut sum.z].into_iter().zip(light.to_array()) {
        channel.set(lane, channel.lane(lane) + light as f32);
    }
}
