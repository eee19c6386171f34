//! Queues the mirrored rays of a chunk, from its points in `f64`.

use catoptra_core::LaneMask;
use fearless_simd::Simd;

use super::Shader;
use super::rules::{MirrorNormals, continues, mirror_direction};
use crate::lanes::{D3, F3, M, U, narrow3, outlined};
use crate::search::{Packet, PreciseRays, Refined};
use crate::stream::{Batch, QueuedRays};

impl<S: Simd> Shader<'_, S> {
    /// Queues the mirrored rays of the first packets of the chunk. See [`outlined`].
    #[inline(always)]
    pub(crate) fn continue_paths(&mut self, batch: &impl Batch<S>, count: usize, depth: u32) {
        outlined(
            self.s,
            #[inline(always)]
            || {
                for slot in 0..count {
                    let (lanes, weight) = self.reflections(batch, slot, depth);
                    if lanes.any() {
                        self.mirror(batch, slot, lanes, weight);
                    }
                }
            },
        );
    }

    /// Finds which lanes of a packet send rays on, and how much of their light counts.
    #[inline(always)]
    fn reflections(&mut self, batch: &impl Batch<S>, slot: usize, depth: u32) -> (M<S>, F3<S>) {
        let arriving = batch.weights(self.s, self.chunk.at[slot]);
        let (mut on, mut weights) = (M::splat(self.s, false), arriving);
        for group in 0..self.chunk.groups[slot].len() {
            let (mask, material) = self.chunk.groups[slot].get(self.s, group);
            let mirror = self.search.snapshot.material_rows()[material].material.visit_lobes(
                #[inline(always)]
                || self.shading_point(slot),
                #[inline(always)]
                |lobes| lobes.mirror,
            );
            let Some(mirror) = mirror else { continue };
            let weight = arriving.times(mirror.tint);
            let skipped = &mut self.search.stats.skipped;
            let traced = continues(mask, weight, depth, self.view, skipped);
            on = on | self.may_hit(traced, self.chunk.best[slot].prim);
            weights = F3::select(mask, weight, weights);
        }
        (on, weights)
    }

    /// Queues the mirrored rays of some lanes of a packet.
    #[inline(always)]
    fn mirror(&mut self, batch: &impl Batch<S>, slot: usize, lanes: M<S>, weight: F3<S>) {
        let packet = &self.packet_of(batch, slot);
        let best = self.chunk.best[slot];
        let refined = self.search.refine_every(packet, &best, lanes);
        let direction = self.mirrored(packet, &refined, slot);
        self.sent.add(lanes, best.prim, &[narrow3(refined.point), narrow3(direction)]);
        let rays = QueuedRays {
            origin: refined.point,
            direction,
            weight,
            pixel: batch.pixels(self.s, self.chunk.at[slot]),
            prim: best.prim,
            facet: best.facet,
        };
        self.next.push(lanes, &rays);
    }

    /// The directions in which the rays of a packet are mirrored.
    #[inline(always)]
    pub(super) fn mirrored<P: PreciseRays<S>>(
        &self,
        packet: &Packet<'_, S, P>,
        refined: &Refined<S>,
        slot: usize,
    ) -> D3<S> {
        let (_, arriving) = packet.precise_unit(self.s);
        let smooth = self.search.snapshot.columns().smooth;
        let normals = MirrorNormals {
            geometric: refined.normal,
            shading: smooth.then_some(refined.shading),
            facing: self.chunk.normal[slot],
        };
        mirror_direction(arriving, &normals)
    }

    /// The lanes whose reflected rays may meet anything; others are counted.
    #[inline(always)]
    fn may_hit(&mut self, lanes: M<S>, prims: U<S>) -> M<S> {
        let mut on = lanes;
        for &prim in &self.plan.dark {
            on = on & !prims.is(prim);
        }
        self.search.stats.skipped.nothing_ahead += lanes.count() - on.count();
        on
    }
}
