//! The radiance that the lanes of a packet show under the light that has arrived, without mirror reflection.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, LaneMask, Material};
use fearless_simd::Simd;

use super::{Shader, dark};
use crate::Tile;
use crate::lanes::{F, F3, M, magnitude, outlined};
use crate::numeric::POSITION_ERROR;
use crate::search::Packet;
use crate::stream::Batch;

impl<S: Simd> Shader<'_, S> {
    /// Adds the light of a packet of the chunk to its pixels.
    #[inline(always)]
    pub(super) fn show(&mut self, batch: &impl Batch<S>, slot: usize, tile: &mut Tile, depth: u32) {
        let (at, groups) = (self.chunk.at[slot], self.chunk.groups[slot].len());
        if groups == 0 && depth > 0 && self.gathers.is_dark() {
            return;
        }
        let sky = F3::of(self.chunk.best[slot].t, &self.gathers.sky);
        let mut shown = F3::select(batch.live_lanes(self.s, at), sky, dark(self.s));
        if groups > 0 {
            shown = self.show_group(batch, slot, 0, shown);
        }
        if groups > 1 {
            shown = self.show_others(batch, slot, shown);
        }
        self.search.stats.not_finite += batch.add(self.s, at, &self.chunk.best[slot], shown, tile);
    }

    /// What the lanes of one material show.
    #[inline(always)]
    fn show_group(&mut self, batch: &impl Batch<S>, slot: usize, group: usize, shown: F3<S>) -> F3<S> {
        let (mask, material) = self.chunk.groups[slot].get(self.s, group);
        if !self.search.snapshot.material_rows()[material].lobes.mirror {
            self.search.stats.skipped.not_reflective += mask.count();
        }
        F3::select(mask, self.base(batch, slot, mask, material), shown)
    }

    /// What the lanes of further materials show. Most packets meet one material; see [`outlined`].
    #[inline(always)]
    fn show_others(&mut self, batch: &impl Batch<S>, slot: usize, shown: F3<S>) -> F3<S> {
        let mut shown = shown;
        outlined(
            self.s,
            #[inline(always)]
            || {
                for group in 1..self.chunk.groups[slot].len() {
                    shown = self.show_group(batch, slot, group, shown);
                }
                shown
            },
        )
    }

    /// What the base of the lanes of `mask`, which have one material, shows in its share.
    #[inline(always)]
    fn base(&mut self, batch: &impl Batch<S>, slot: usize, mask: M<S>, material: usize) -> F3<S> {
        let snapshot = self.search.snapshot;
        let row = &snapshot.material_rows()[material];
        if row.is_pattern && batch.has_footprints() {
            return outlined(
                self.s,
                #[inline(always)]
                || self.mean_base(batch, slot, &row.material),
            );
        }
        if row.is_pattern {
            outlined(
                self.s,
                #[inline(always)]
                || self.move_off_edges(batch, slot, mask, &row.material),
            );
        }
        let ambient = F3::of(F::splat(self.s, 0.0), &self.gathers.ambient);
        let irradiance = self.chunk.irradiance[slot];
        let counted = self.counted_emission(batch, slot, mask, row);
        let (mut shown, share) = row.material.visit_lobes(
            #[inline(always)]
            || self.shading_point(slot),
            #[inline(always)]
            |lobes| (lobes.shining(counted).without_glossy(ambient, irradiance), lobes.share),
        );
        if self.chunk.glossy[slot] {
            shown = shown + self.chunk.specular[slot];
        }
        shown.scale(share)
    }

    /// What the base of lanes of a pattern shows on average over the squares that their rays stand for.
    #[inline(always)]
    fn mean_base(&mut self, batch: &impl Batch<S>, slot: usize, material: &Material) -> F3<S> {
        let footprint = batch.footprint(self.s, self.chunk.at[slot]);
        let ambient = F3::of(F::splat(self.s, 0.0), &self.gathers.ambient);
        let irradiance = self.chunk.irradiance[slot];
        let (mut shown, share) = material.visit_mean_lobes(
            (&self.shading_point(slot), &footprint),
            #[inline(always)]
            |lobes| (lobes.without_glossy(ambient, irradiance), lobes.share),
        );
        if self.chunk.glossy[slot] {
            shown = shown + self.chunk.specular[slot];
        }
        shown.scale(share)
    }

    /// Where `f32` cannot decide on which side of a pattern's edge a point lies, replaces it by one from `f64` that
    /// lies in the same cell.
    #[inline(always)]
    pub(super) fn move_off_edges(
        &mut self,
        batch: &impl Batch<S>,
        slot: usize,
        mask: M<S>,
        material: &Material,
    ) {
        let at = self.shading_point(slot);
        // A ray's origin is no farther out than its end and three times its length.
        let size = at.distance.mul_add(F::splat(self.s, 4.0), magnitude(at.position));
        let error = size.mul_add(F::splat(self.s, POSITION_ERROR), self.chunk.best[slot].error);
        let lanes = mask & material.undecided(&at, error);
        if !lanes.any() {
            return;
        }
        let (packet, best) = (self.packet_of(batch, slot), self.chunk.best[slot]);
        let point = self.search.refine_every(&packet, &best, lanes).point;
        let position = &mut self.chunk.point[slot];
        for lane in lanes.lanes() {
            self.search.stats.settled += 1;
            let near =
                material.reduced(DVec3::new(point.x.lane(lane), point.y.lane(lane), point.z.lane(lane)));
            position.x.set(lane, near.x as f32);
            position.y.set(lane, near.y as f32);
            position.z.set(lane, near.z as f32);
        }
    }

    /// The packet in a slot of the chunk.
    #[inline(always)]
    pub(crate) fn packet_of<'b, B: Batch<S>>(&self, batch: &'b B, slot: usize) -> Packet<'b, S, B::Precise> {
        batch.packet(self.s, self.chunk.at[slot])
    }
}
