//! Direct light: adds what every light contributes to the packets of a chunk, and traces shadow rays.

use catoptra_core::light::LightVisitor;
use catoptra_core::{Arithmetic, Arrival, Emitter, Lane, LaneMask};
use fearless_simd::Simd;
use smallvec::SmallVec;

use super::Shader;
use super::chunk::{CHUNK, Chunk};
use crate::kernel::{Leaving, Rays, Target};
use crate::lanes::{F, F3, M, magnitude, outlined};
use crate::numeric::POINT_ERROR;
use crate::search::{Packet, ShadowRays, Shadows, ToLight, drift};
use crate::snapshot::LightRow;
use crate::stream::Batch;

/// What packets of the chunk have, each.
type OfChunk<T> = SmallVec<[T; CHUNK]>;

/// Adds what a light contributes to the first packets of the chunk.
struct AddLight<'t, 'a, S: Simd, B> {
    shader: &'t mut Shader<'a, S>,
    batch: &'t B,
    count: usize,
    /// How many of their lanes are lit.
    lit: u64,
    /// Which light.
    light: usize,
}

impl<S: Simd, B: Batch<S>> LightVisitor for AddLight<'_, '_, S, B> {
    #[inline(always)]
    fn visit<E: Emitter>(mut self, light: &E) {
        let open = self.shader.is_open(self.light, light.shadow());
        let smooth = self.shader.search.snapshot.columns().smooth;
        let faced = if open && !smooth {
            self.add_open(light)
        } else if !open && self.shader.walks_together(self.light) {
            self.add_past_meshes(light, smooth)
        } else {
            self.add(light, open, smooth)
        };
        let stats = &mut self.shader.search.stats;
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

/// How many lanes that are lit lie in a light's cone, and how many of those face it.
#[derive(Default)]
struct Faced {
    in_cone: u64,
    facing: u64,
}

/// Lanes that face a light, and what arrives at them.
#[derive(Clone, Copy)]
pub(super) struct Facing<S: Simd> {
    pub(super) arrival: Arrival<F<S>>,
    pub(super) cosine: F<S>,
    pub(super) lanes: M<S>,
}

impl<S: Simd, B: Batch<S>> AddLight<'_, '_, S, B> {
    /// Adds a light that nothing occludes, where all normals are geometric.
    #[inline(always)]
    fn add_open<E: Emitter>(&mut self, light: &E) -> Faced {
        let zero = F::splat(self.shader.s, 0.0);
        let color = F3::of(zero, light.color());
        let chunk = &mut *self.shader.chunk;
        let mut faced = Faced::default();
        for packet in 0..self.count.min(CHUNK) {
            let facing = face(chunk, light, packet, false, &mut faced);
            let arriving = F::pick(facing.lanes, facing.cosine * facing.arrival.strength, zero);
            chunk.irradiance[packet] = color.scale_add(arriving, chunk.irradiance[packet]);
        }
        for packet in 0..self.count.min(CHUNK) {
            if self.shader.chunk.glossy[packet] {
                let facing = face(self.shader.chunk, light, packet, false, &mut Faced::default());
                self.shader.add_specular(packet, &facing, facing.lanes, color);
            }
        }
        faced
    }

    /// Adds any light.
    #[inline(always)]
    fn add<E: Emitter>(&mut self, light: &E, open: bool, smooth: bool) -> Faced {
        let color = F3::of(F::splat(self.shader.s, 0.0), light.color());
        let mut faced = Faced::default();
        for packet in 0..self.count.min(CHUNK) {
            let facing = face(self.shader.chunk, light, packet, smooth, &mut faced);
            let reached = if open {
                facing.lanes
            } else {
                facing.lanes & !self.shader.shadowed(self.batch, packet, self.light, &facing)
            };
            self.shader.add_reached(packet, &facing, reached, color);
        }
        faced
    }

    /// Adds a light that meshes may occlude: their trees are walked by the packets together.
    #[inline(always)]
    fn add_past_meshes<E: Emitter>(&mut self, light: &E, smooth: bool) -> Faced {
        let color = F3::of(F::splat(self.shader.s, 0.0), light.color());
        let mut faced = Faced::default();
        let mut facing: OfChunk<Facing<S>> = SmallVec::new();
        for packet in 0..self.count.min(CHUNK) {
            facing.push(face(self.shader.chunk, light, packet, smooth, &mut faced));
        }
        let reached = self.shader.reached_past_meshes(self.batch, self.light, &facing);
        for (packet, facing) in facing.iter().enumerate() {
            self.shader.add_reached(packet, facing, reached[packet], color);
        }
        faced
    }
}

/// What arrives at a packet of the chunk from a light, if nothing occludes it.
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

impl<S: Simd> Shader<'_, S> {
    /// Adds what every light contributes to the first `count` packets of the chunk. Each kind of light has a loop of
    /// its own.
    #[inline(always)]
    pub(crate) fn add_lights(&mut self, batch: &impl Batch<S>, count: usize) {
        let rows = self.search.snapshot.light_rows();
        let lit = self.chunk.lit[..count].iter().map(|lit| lit.count()).sum();
        self.search.stats.skipped.unreached += lit * (rows.len() - self.plan.reached.len()) as u64;
        for index in 0..self.plan.reached.len() {
            let light = self.plan.reached[index];
            let row = &rows[light];
            outlined(
                self.s,
                #[inline(always)]
                || row.light.visit(AddLight { shader: self, batch, count, lit, light }),
            );
        }
    }

    /// Whether nothing may occlude a light from the chunk's points, or the light throws no shadows.
    #[inline(always)]
    fn is_open(&self, light: usize, shadow: bool) -> bool {
        let general = &self.search.snapshot.columns().general_unbounded;
        !shadow || (self.plan.occluders[light].is_empty() && general.is_empty())
    }

    /// Whether packets of the chunk are to walk meshes together on their ways to a light.
    #[inline(always)]
    fn walks_together(&self, light: usize) -> bool {
        let snapshot = self.search.snapshot;
        self.view.skip.walks && self.plan.occluders[light].hold_meshes(snapshot.columns())
    }

    /// Adds what arrives of a light at the lanes of a packet that it reaches.
    #[inline(always)]
    fn add_reached(&mut self, packet: usize, facing: &Facing<S>, reached: M<S>, color: F3<S>) {
        let arriving = F::pick(reached, facing.cosine * facing.arrival.strength, F::splat(self.s, 0.0));
        let irradiance = &mut self.chunk.irradiance[packet];
        *irradiance = color.scale_add(arriving, *irradiance);
        if self.chunk.glossy[packet] {
            self.add_specular(packet, facing, reached, color);
        }
    }

    /// Adds what glossy lobes show of a light in the lanes that it reaches.
    #[inline(always)]
    pub(super) fn add_specular(&mut self, packet: usize, facing: &Facing<S>, reached: M<S>, color: F3<S>) {
        let zero = F::splat(self.s, 0.0);
        let light = color.scale(F::pick(reached, facing.arrival.strength, zero));
        let materials = self.search.snapshot.material_rows();
        let (at, groups) = (self.shading_point(packet), &self.chunk.groups[packet]);
        let mut sum = self.chunk.specular[packet];
        for group in 0..groups.len() {
            let (mask, material) = groups.get(self.s, group);
            let shown = materials[material].material.visit_lobes(
                #[inline(always)]
                || at,
                #[inline(always)]
                |lobes| lobes.glossy(&at, facing.arrival.direction, facing.cosine),
            );
            if let Some(shown) = shown {
                sum = F3::select(mask, shown.times_add(light, sum), sum);
            }
        }
        self.chunk.specular[packet] = sum;
    }

    /// Lanes whose shadow rays to a light are blocked.
    #[inline(always)]
    fn shadowed(&mut self, batch: &impl Batch<S>, packet: usize, light: usize, facing: &Facing<S>) -> M<S> {
        if !facing.lanes.any() {
            return facing.lanes;
        }
        let row = &self.search.snapshot.light_rows()[light];
        let rays = self.shadow_rays(packet, row, facing);
        let occluders = &self.plan.occluders[light];
        if let Some(blocked) = self.search.occluded_for_certain(&rays, occluders) {
            return blocked;
        }
        // A copy, so that the rays may stay in registers where this is not reached.
        let copy = rays;
        outlined(
            self.s,
            #[inline(always)]
            || {
                let on_meshes = self.chunk.on_meshes[packet];
                let packet = batch.packet(self.s, self.chunk.at[packet]);
                let segments = ToLight { packet: &packet, from: copy.leaving, on_meshes, light: row };
                self.search.occluded(&segments, &copy, occluders)
            },
        )
    }

    /// The shadow rays of a packet of the chunk to a light that it faces.
    #[inline(always)]
    fn shadow_rays<'r>(&self, packet: usize, row: &'r LightRow, facing: &Facing<S>) -> ShadowRays<'r, S> {
        let (best, point, arrival) = (self.chunk.best[packet], self.chunk.point[packet], &facing.arrival);
        let reach = row.reach + drift(self.search.snapshot.origin_in_frame());
        ShadowRays {
            rays: Rays {
                origin: point,
                direction: arrival.direction,
                reach: best
                    .error
                    .mul_add(F::splat(self.s, 1.0 / POINT_ERROR), magnitude(point) + F::splat(self.s, reach)),
            },
            leaving: self.leaving(packet),
            live: facing.lanes,
            target: Target { distance: arrival.distance, end: Some(row.end()) },
            behind: &row.behind,
        }
    }

    /// The surfaces that shadow rays of a packet of the chunk leave.
    #[inline(always)]
    fn leaving(&self, packet: usize) -> Leaving<S> {
        let best = &self.chunk.best[packet];
        Leaving { prim: best.prim, facet: best.facet, any: true }
    }

    /// Lanes of the first packets of the chunk whose shadow rays to a light nothing blocks. See [`outlined`].
    #[inline(always)]
    fn reached_past_meshes<B: Batch<S>>(
        &mut self,
        batch: &B,
        light: usize,
        facing: &[Facing<S>],
    ) -> [M<S>; CHUNK] {
        let mut reached = [M::splat(self.s, false); CHUNK];
        let Some(first) = facing.iter().position(|facing| facing.lanes.any()) else { return reached };
        outlined(
            self.s,
            #[inline(always)]
            || {
                let row = &self.search.snapshot.light_rows()[light];
                let mut packets: OfChunk<(usize, Packet<'_, S, B::Precise>)> = SmallVec::new();
                for packet in (first..facing.len()).filter(|&packet| facing[packet].lanes.any()) {
                    packets.push((packet, batch.packet(self.s, self.chunk.at[packet])));
                }
                let mut segments: OfChunk<ToLight<'_, S, B::Precise>> = SmallVec::new();
                for (number, packet) in &packets {
                    segments.push(ToLight {
                        packet,
                        from: self.leaving(*number),
                        on_meshes: self.chunk.on_meshes[*number],
                        light: row,
                    });
                }
                let mut shadows: OfChunk<Shadows<'_, S, _>> = SmallVec::new();
                for ((number, _), segments) in packets.iter().zip(&segments) {
                    let rays = self.shadow_rays(*number, row, &facing[*number]);
                    shadows.push(Shadows { segments, rays, open: rays.live });
                }
                let occluders = &self.plan.occluders[light];
                self.search.occluded_together(&mut shadows, occluders, self.bundle);
                for ((number, _), shadows) in packets.iter().zip(&shadows) {
                    reached[*number] = shadows.open;
                }
            },
        );
        reached
    }
}
