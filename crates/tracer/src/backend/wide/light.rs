//! What light arrives at the packets of a chunk, and which ways to lights are asked about.

use catoptra_core::light::LightVisitor;
use catoptra_core::{Arithmetic, Arrival, Emitter, Lane, LaneMask};
use fearless_simd::Simd;

use super::Tracer;
use super::batch::Batch;
use super::chunk::{CHUNK, Chunk};
use super::packet::{Left, drift};
use super::shadow::Ways;
use crate::kernel::{Rays, Target, magnitude};
use crate::lanes::{F, F3, M};
use crate::numeric::POINT_ERROR;

/// Adds to the first packets of the chunk what a light makes of them.
struct AddLight<'t, 'a, S: Simd, B> {
    tracer: &'t mut Tracer<'a, S>,
    batch: &'t B,
    count: usize,
    /// How many of their lanes answer lights.
    lit: u64,
    /// Which light.
    light: usize,
}

impl<S: Simd, B: Batch<S>> LightVisitor for AddLight<'_, '_, S, B> {
    #[inline(always)]
    fn visit<E: Emitter>(mut self, light: &E) {
        let open = self.tracer.is_open(self.light, light.shadow());
        let smooth = self.tracer.frame.snapshot.columns().smooth;
        let faced = if open && !smooth { self.add_open(light) } else { self.add(light, open, smooth) };
        let stats = &mut self.tracer.stats;
        let in_cone = if E::HAS_CONE { faced.in_cone } else { self.lit };
        stats.skipped.out_of_cone += self.lit - in_cone;
        stats.skipped.facing_away += in_cone - faced.facing;
        *match (light.shadow(), open) {
            (false, _) => &mut stats.skipped.shadow_off,
            (true, true) => &mut stats.skipped.nothing_between,
            (true, false) => &mut stats.rays.shadow,
        } += faced.facing;
    }
}

/// How many lanes that answer lights lie in a light's cone, and how many of those face it.
#[derive(Default)]
struct Faced {
    in_cone: u64,
    facing: u64,
}

/// Lanes that face a light, and what arrives at them.
struct Facing<S: Simd> {
    arrival: Arrival<F<S>>,
    cosine: F<S>,
    lanes: M<S>,
}

impl<S: Simd, B: Batch<S>> AddLight<'_, '_, S, B> {
    /// Adds a light that nothing stands in the way of, where all normals are geometric.
    #[inline(always)]
    fn add_open<E: Emitter>(&mut self, light: &E) -> Faced {
        let zero = F::splat(self.tracer.s, 0.0);
        let color = F3::of(zero, light.color());
        let chunk = &mut *self.tracer.chunk;
        let mut faced = Faced::default();
        for packet in 0..self.count.min(CHUNK) {
            let facing = face(chunk, light, packet, false, &mut faced);
            let arriving = F::pick(facing.lanes, facing.cosine * facing.arrival.strength, zero);
            chunk.irradiance[packet] = color.scale_add(arriving, chunk.irradiance[packet]);
        }
        for packet in 0..self.count.min(CHUNK) {
            if self.tracer.chunk.glossy[packet] {
                let facing = face(self.tracer.chunk, light, packet, false, &mut Faced::default());
                self.tracer.add_gloss(packet, &facing, facing.lanes, color);
            }
        }
        faced
    }

    /// Adds any light.
    #[inline(always)]
    fn add<E: Emitter>(&mut self, light: &E, open: bool, smooth: bool) -> Faced {
        let zero = F::splat(self.tracer.s, 0.0);
        let color = F3::of(zero, light.color());
        let mut faced = Faced::default();
        for packet in 0..self.count.min(CHUNK) {
            let facing = face(self.tracer.chunk, light, packet, smooth, &mut faced);
            let reached = if open {
                facing.lanes
            } else {
                facing.lanes & !self.tracer.shadowed(self.batch, packet, self.light, &facing)
            };
            let arriving = F::pick(reached, facing.cosine * facing.arrival.strength, zero);
            let irradiance = &mut self.tracer.chunk.irradiance[packet];
            *irradiance = color.scale_add(arriving, *irradiance);
            if self.tracer.chunk.glossy[packet] {
                self.tracer.add_gloss(packet, &facing, reached, color);
            }
        }
        faced
    }
}

/// What arrives at a packet of the chunk from a light, if nothing stands in its way.
#[inline(always)]
fn face<S: Simd, E: Emitter>(
    chunk: &Chunk<S>,
    light: &E,
    packet: usize,
    smooth: bool,
    faced: &mut Faced,
) -> Facing<S> {
    let lit = chunk.lit[packet];
    let arrival = light.arriving(chunk.point[packet]);
    let zero = arrival.strength.number(0.0);
    // Where the light itself is, the cosine is NaN, which faces nothing.
    let in_cone = if E::HAS_CONE { lit & arrival.lit } else { lit };
    let mut cosine = arrival.cosine(chunk.normal[packet]);
    let mut lanes = in_cone & zero.less(cosine);
    if smooth {
        cosine = arrival.cosine(chunk.smooth[packet]);
        lanes = lanes & zero.less(cosine);
    }
    if E::HAS_CONE {
        faced.in_cone += in_cone.count();
    }
    faced.facing += lanes.count();
    Facing { arrival, cosine, lanes }
}

impl<S: Simd> Tracer<'_, S> {
    /// Adds what every light makes of the first `count` packets of the chunk. Compiled apart for each kind of light.
    #[inline(always)]
    pub(super) fn add_lights(&mut self, batch: &impl Batch<S>, count: usize) {
        let rows = self.frame.snapshot.light_rows();
        let lit = self.chunk.lit[..count].iter().map(|lit| lit.count()).sum();
        self.stats.skipped.unreached += lit * (rows.len() - self.reached.len()) as u64;
        for place in 0..self.reached.len() {
            let light = self.reached[place];
            let row = &rows[light];
            self.s.vectorize(
                #[inline(always)]
                || row.light.visit(AddLight { tracer: self, batch, count, lit, light }),
            );
        }
    }

    /// Whether nothing stands between the chunk's points and a light, or the light throws no shadows.
    #[inline(always)]
    fn is_open(&self, light: usize, shadow: bool) -> bool {
        let general = &self.frame.snapshot.columns().general_unbounded;
        !shadow || (self.between[light].is_empty() && general.is_empty())
    }

    /// Adds the gloss of the lanes that a light reaches.
    #[inline(always)]
    fn add_gloss(&mut self, packet: usize, facing: &Facing<S>, reached: M<S>, color: F3<S>) {
        let zero = F::splat(self.s, 0.0);
        let light = color.scale(F::pick(reached, facing.arrival.strength, zero));
        let materials = self.frame.snapshot.material_rows();
        let (at, groups) = (self.shading_point(packet), &self.chunk.groups[packet]);
        let mut sum = self.chunk.gloss[packet];
        for group in 0..groups.len() {
            let (mask, material) = groups.get(self.s, group);
            let material = &materials[material].material;
            if material.is_glossy() {
                let gloss = material.gloss(&at, facing.arrival.towards, facing.cosine);
                sum = F3::select(mask, gloss.times_add(light, sum), sum);
            }
        }
        self.chunk.gloss[packet] = sum;
    }

    /// Lanes whose way to a light is blocked.
    #[inline(always)]
    fn shadowed(&mut self, batch: &impl Batch<S>, packet: usize, light: usize, facing: &Facing<S>) -> M<S> {
        let Facing { arrival, lanes, .. } = facing;
        if !lanes.any() {
            return *lanes;
        }
        let (best, point) = (self.chunk.best[packet], self.chunk.point[packet]);
        let row = &self.frame.snapshot.light_rows()[light];
        let ways = Ways {
            rays: Rays {
                origin: point,
                direction: arrival.towards,
                reach: best.error.mul_add(
                    F::splat(self.s, 1.0 / POINT_ERROR),
                    magnitude(point)
                        + F::splat(self.s, row.reach + drift(self.frame.snapshot.origin_in_frame())),
                ),
            },
            left: Left { prim: best.prim, facet: best.facet, any: true },
            live: *lanes,
            target: Target {
                distance: arrival.distance,
                place: row.place,
                in_frame: row.in_frame,
                at_infinity: row.at_infinity,
            },
        };
        if let Some(blocked) = self.blocked_for_certain(&ways, light) {
            return blocked;
        }
        // A copy, so that the ways may stay in registers where this is not reached.
        let copy = ways;
        self.s.vectorize(
            #[inline(always)]
            || {
                let packet = self.packet_of(batch, packet);
                self.blocked(&packet, &copy, light)
            },
        )
    }
}
