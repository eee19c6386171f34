//! From hits to surfaces: fills the slots of a chunk with the points, normals and materials of hits.

use catoptra_core::{Lane, LaneMask, ShadingPoint};
use fearless_simd::Simd;

use super::chunk::CHUNK;
use super::{Shader, dark};
use crate::Tile;
use crate::cull::Candidates;
use crate::lanes::{F, F3, M, outlined};
use crate::search::{HitColumns, Hits, Packet, PreciseRays, Surface};
use crate::stream::Batch;

/// How packets find their hits.
pub(crate) trait Finder<S: Simd> {
    /// Fills a slot of the chunk with the hits of the packet that begins with ray `at` of a batch.
    fn fill_slot(&self, shader: &mut Shader<'_, S>, batch: &impl Batch<S>, at: usize, slot: usize);
}

/// Searches some shapes.
impl<S: Simd> Finder<S> for &Candidates {
    #[inline(always)]
    fn fill_slot(&self, shader: &mut Shader<'_, S>, batch: &impl Batch<S>, at: usize, slot: usize) {
        let packet = batch.packet(shader.s, at);
        let best = shader.search.closest(&packet, self);
        shader.fill_slot(&packet, &best, slot);
    }
}

/// Takes hits that were found before.
impl<S: Simd> Finder<S> for &HitColumns {
    #[inline(always)]
    fn fill_slot(&self, shader: &mut Shader<'_, S>, batch: &impl Batch<S>, at: usize, slot: usize) {
        let packet = batch.packet(shader.s, at);
        let best = Hits::found(shader.s, self, at);
        shader.fill_slot(&packet, &best, slot);
    }
}

impl<S: Simd> Shader<'_, S> {
    /// Finds the hits of a batch, and adds the light that arrives along its rays.
    #[inline(always)]
    pub(crate) fn shade(
        &mut self,
        batch: &impl Batch<S>,
        finder: &impl Finder<S>,
        tile: &mut Tile,
        depth: u32,
    ) {
        let mut count = 0;
        for stretch in 0..batch.stretches() {
            for at in batch.stretch(stretch).step_by(F::<S>::LANES) {
                if batch.is_idle(at) {
                    continue;
                }
                finder.fill_slot(self, batch, at, count);
                count += 1;
                if count == CHUNK {
                    self.show_chunk(batch, CHUNK, tile, depth);
                    count = 0;
                }
            }
        }
        if count > 0 {
            self.show_chunk(batch, count, tile, depth);
        }
    }

    /// Adds the light of the first packets of the chunk. See [`outlined`].
    #[inline(always)]
    fn show_chunk(&mut self, batch: &impl Batch<S>, count: usize, tile: &mut Tile, depth: u32) {
        outlined(
            self.s,
            #[inline(always)]
            || {
                self.add_lights(batch, count);
                self.add_lamps(batch, count, tile, depth);
                for packet in 0..count {
                    self.show(batch, packet, tile, depth);
                }
                if self.gathers.paths {
                    self.scatter_paths(batch, count, tile, depth);
                } else if self.search.snapshot.has_mirrors() {
                    self.continue_paths(batch, count, depth);
                }
            },
        );
    }

    /// Fills a slot of the chunk with the hits of a packet.
    #[inline(always)]
    fn fill_slot<P: PreciseRays<S>>(&mut self, packet: &Packet<'_, S, P>, best: &Hits<S>, slot: usize) {
        self.begin_slot(best, slot, packet.at);
        let hits = best.hits() & packet.live;
        let mut lit = M::splat(self.s, false);
        if hits.any() {
            let mut remaining = hits.bits();
            let prim = best.prim.lane(remaining.trailing_zeros() as usize);
            let mask = hits & best.prim.is(prim);
            let mut surface = self.search.surface(packet, best, mask, prim);
            lit = lit | self.add_material_group(mask, prim, slot);
            remaining &= !mask.bits();
            while remaining != 0 {
                let prim = best.prim.lane(remaining.trailing_zeros() as usize);
                let mask = hits & best.prim.is(prim);
                surface = self.search.surface_too(packet, best, mask, prim, surface);
                lit = lit | self.add_material_group(mask, prim, slot);
                remaining &= !mask.bits();
            }
            self.store_surface(packet, slot, surface);
        }
        self.chunk.lit[slot] = lit;
    }

    /// Gives a slot of the chunk to the packet that begins with ray `at`.
    #[inline(always)]
    pub(crate) fn begin_slot(&mut self, best: &Hits<S>, slot: usize, at: usize) {
        let dark = dark(self.s);
        self.chunk.at[slot] = at;
        self.chunk.best[slot] = *best;
        self.chunk.on_meshes[slot].lanes = M::splat(self.s, false);
        self.search.on_meshes.lanes = M::splat(self.s, false);
        self.chunk.irradiance[slot] = dark;
        self.chunk.specular[slot] = dark;
        self.chunk.glossy[slot] = false;
        self.chunk.groups[slot].clear();
    }

    /// Adds lanes by their material; returns those that are lit.
    #[inline(always)]
    pub(crate) fn add_material_group(&mut self, mask: M<S>, prim: u32, slot: usize) -> M<S> {
        let snapshot = self.search.snapshot;
        let material = snapshot.prims()[prim as usize].material;
        self.chunk.groups[slot].add(mask.bits(), material);
        let row = &snapshot.material_rows()[material as usize];
        if row.lobes.is_lit() {
            self.chunk.glossy[slot] |= row.lobes.is_glossy();
            mask
        } else {
            self.search.stats.skipped.unlit_material += mask.count() * snapshot.light_rows().len() as u64;
            M::splat(self.s, false)
        }
    }

    /// Stores the lanes' surfaces, facing the viewer, in a slot of the chunk.
    #[inline(always)]
    pub(crate) fn store_surface<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        slot: usize,
        surface: Surface<S>,
    ) {
        let d = packet.rays.direction;
        let away = F::splat(self.s, 0.0).less(surface.normal.dot(d));
        self.chunk.point[slot] = surface.point;
        if self.search.on_meshes.lanes.any() {
            self.chunk.on_meshes[slot] = self.search.on_meshes;
        }
        self.chunk.normal[slot] = face_forward(away, surface.normal);
        self.chunk.front[slot] = !away;
        if self.search.snapshot.columns().smooth {
            self.chunk.smooth[slot] = face_forward(away, surface.shading);
        }
        if self.chunk.glossy[slot] {
            self.chunk.to_viewer[slot] = F3::new(-d.x, -d.y, -d.z);
        }
    }

    /// Where the lanes' surfaces are seen, and from where.
    #[inline(always)]
    pub(crate) fn shading_point(&self, slot: usize) -> ShadingPoint<F<S>> {
        let chunk = &self.chunk;
        let smooth = self.search.snapshot.columns().smooth;
        ShadingPoint {
            position: chunk.point[slot],
            normal: if smooth { chunk.smooth[slot] } else { chunk.normal[slot] },
            to_viewer: chunk.to_viewer[slot],
            distance: chunk.best[slot].t,
            front: chunk.front[slot],
        }
    }
}

/// The vector, negated where the mask holds.
#[inline(always)]
fn face_forward<S: Simd>(mask: M<S>, v: F3<S>) -> F3<S> {
    F3::select(mask, F3::new(-v.x, -v.y, -v.z), v)
}
