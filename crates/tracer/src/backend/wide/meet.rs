//! What the lanes of a packet meet, and what they show of their surfaces' own look.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask, Material, Rgb, ShadingPoint};
use fearless_simd::Simd;

use super::batch::Batch;
use super::chunk::CHUNK;
use super::packet::Packet;
use super::plan::Shapes;
use super::search::Best;
use super::settle::Settled;
use super::surface::Surface;
use super::{Tracer, dark};
use crate::Tile;
use crate::kernel::magnitude;
use crate::lanes::{F, F3, M};
use crate::numeric::POSITION_ERROR;

/// How packets find what they meet.
pub(super) trait Finder<S: Simd> {
    /// Puts what the packet at a place of its batch meets at a place of the chunk.
    fn meet(&self, tracer: &mut Tracer<'_, S>, batch: &impl Batch<S>, at: usize, place: usize);
}

/// Among some shapes.
impl<S: Simd> Finder<S> for &Shapes {
    #[inline(always)]
    fn meet(&self, tracer: &mut Tracer<'_, S>, batch: &impl Batch<S>, at: usize, place: usize) {
        let packet = batch.packet(tracer.s, at);
        let best = tracer.nearest(&packet, self);
        tracer.meet(&packet, &best, place, at);
    }
}

/// As found before.
pub(super) struct Before;

impl<S: Simd> Finder<S> for Before {
    #[inline(always)]
    fn meet(&self, tracer: &mut Tracer<'_, S>, batch: &impl Batch<S>, at: usize, place: usize) {
        let packet = batch.packet(tracer.s, at);
        let best = Best::found(tracer.s, tracer.found, at);
        tracer.meet(&packet, &best, place, at);
    }
}

impl<S: Simd> Tracer<'_, S> {
    /// Finds what the packets of a batch meet, and adds the light that arrives along them.
    #[inline(always)]
    pub(super) fn shade(
        &mut self,
        batch: &impl Batch<S>,
        finder: &impl Finder<S>,
        tile: &mut Tile,
        depth: u32,
    ) {
        let mut count = 0;
        for stretch in 0..batch.stretches() {
            for at in batch.stretch(stretch).step_by(F::<S>::LANES) {
                finder.meet(self, batch, at, count);
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

    /// Adds the light of the first packets of the chunk. Compiled apart.
    #[inline(always)]
    fn show_chunk(&mut self, batch: &impl Batch<S>, count: usize, tile: &mut Tile, depth: u32) {
        self.s.vectorize(
            #[inline(always)]
            || {
                self.add_lights(batch, count);
                for packet in 0..count {
                    self.show(batch, packet, tile, depth);
                }
                if self.frame.snapshot.has_mirrors() {
                    self.send_on(batch, count, depth);
                }
            },
        );
    }

    /// Puts what a packet has met at a place of the chunk.
    #[inline(always)]
    pub(super) fn meet(&mut self, packet: &Packet<'_, S>, best: &Best<S>, place: usize, at: usize) {
        self.occupy(best, place, at);
        let hits = best.hits() & packet.live;
        let mut lit = M::splat(self.s, false);
        if hits.any() {
            let mut left = hits.bits();
            let prim = best.prim.lane(left.trailing_zeros() as usize);
            let mask = hits & best.prim.is(prim);
            let mut surface = self.surface(packet, best, mask, prim);
            lit = lit | self.wears(mask, prim, place);
            left &= !mask.bits();
            while left != 0 {
                let prim = best.prim.lane(left.trailing_zeros() as usize);
                let mask = hits & best.prim.is(prim);
                surface = self.surface_too(packet, best, mask, prim, surface);
                lit = lit | self.wears(mask, prim, place);
                left &= !mask.bits();
            }
            self.put(packet, place, surface);
        }
        self.chunk.lit[place] = lit;
    }

    /// Gives a place of the chunk to a packet.
    #[inline(always)]
    pub(super) fn occupy(&mut self, best: &Best<S>, place: usize, at: usize) {
        let dark = dark(self.s);
        self.chunk.at[place] = at;
        self.chunk.best[place] = *best;
        self.chunk.irradiance[place] = dark;
        self.chunk.gloss[place] = dark;
        self.chunk.glossy[place] = false;
        self.chunk.groups[place].clear();
    }

    /// Adds lanes by their material; answers those that answer lights.
    #[inline(always)]
    pub(super) fn wears(&mut self, mask: M<S>, prim: u32, place: usize) -> M<S> {
        let snapshot = self.frame.snapshot;
        let material = snapshot.prims()[prim as usize].material;
        self.chunk.groups[place].add(mask.bits(), material);
        let row = &snapshot.material_rows()[material as usize];
        if row.answers_light {
            self.chunk.glossy[place] |= row.material.is_glossy();
            mask
        } else {
            self.stats.skipped.unlit_material += mask.count() * snapshot.light_rows().len() as u64;
            M::splat(self.s, false)
        }
    }

    /// Puts the lanes' surfaces, turned to the viewer, at a place of the chunk.
    #[inline(always)]
    pub(super) fn put(&mut self, packet: &Packet<'_, S>, place: usize, surface: Surface<S>) {
        let d = packet.rays.direction;
        let away = F::splat(self.s, 0.0).less(surface.normal.dot(d));
        self.chunk.point[place] = surface.point;
        self.chunk.normal[place] = turned(away, surface.normal);
        if self.frame.snapshot.columns().smooth {
            self.chunk.smooth[place] = turned(away, surface.shading);
        }
        if self.chunk.glossy[place] {
            self.chunk.to_viewer[place] = F3::new(-d.x, -d.y, -d.z);
        }
    }

    /// Where the lanes' surfaces are seen, and from where.
    #[inline(always)]
    pub(super) fn shading_point(&self, place: usize) -> ShadingPoint<F<S>> {
        let chunk = &self.chunk;
        let smooth = self.frame.snapshot.columns().smooth;
        ShadingPoint {
            position: chunk.point[place],
            normal: if smooth { chunk.smooth[place] } else { chunk.normal[place] },
            to_viewer: chunk.to_viewer[place],
            distance: chunk.best[place].t,
        }
    }

    /// Adds the light of a packet of the chunk to its pixels.
    #[inline(always)]
    fn show(&mut self, batch: &impl Batch<S>, place: usize, tile: &mut Tile, depth: u32) {
        let (at, groups) = (self.chunk.at[place], self.chunk.groups[place].len());
        if groups == 0 && depth > 0 && self.frame.snapshot.background() == Rgb::BLACK {
            return;
        }
        let sky = F3::of(self.chunk.best[place].t, self.frame.snapshot.background_light());
        let mut shown = F3::select(batch.live_lanes(self.s, at), sky, dark(self.s));
        if groups > 0 {
            shown = self.show_group(batch, place, 0, shown);
        }
        if groups > 1 {
            shown = self.show_others(batch, place, shown);
        }
        self.stats.not_finite += batch.add(self.s, at, &self.chunk.best[place], shown, tile);
    }

    /// What the lanes of one material show.
    #[inline(always)]
    fn show_group(&mut self, batch: &impl Batch<S>, place: usize, group: usize, shown: F3<S>) -> F3<S> {
        let (mask, material) = self.chunk.groups[place].get(self.s, group);
        if !self.frame.snapshot.material_rows()[material].reflects {
            self.stats.skipped.not_reflective += mask.count();
        }
        F3::select(mask, self.own_look(batch, place, (mask, material)), shown)
    }

    /// What the lanes of further materials show. Compiled apart: most packets meet one material.
    #[inline(always)]
    fn show_others(&mut self, batch: &impl Batch<S>, place: usize, shown: F3<S>) -> F3<S> {
        let mut shown = shown;
        self.s.vectorize(
            #[inline(always)]
            || {
                for group in 1..self.chunk.groups[place].len() {
                    shown = self.show_group(batch, place, group, shown);
                }
                shown
            },
        )
    }

    /// The own look of the lanes of `mask`, which wear one material, in the share that is not reflected.
    #[inline(always)]
    fn own_look(&mut self, batch: &impl Batch<S>, place: usize, (mask, material): (M<S>, usize)) -> F3<S> {
        let snapshot = self.frame.snapshot;
        let row = &snapshot.material_rows()[material];
        if row.is_pattern {
            // Compiled apart, as it is seldom asked for.
            self.s.vectorize(
                #[inline(always)]
                || self.move_off_edges(batch, place, mask, &row.material),
            );
        }
        let ambient = F3::of(F::splat(self.s, 0.0), snapshot.ambient_light());
        let irradiance = self.chunk.irradiance[place];
        let mut shown = row.material.shown(|| self.shading_point(place), ambient, irradiance);
        if self.chunk.glossy[place] {
            shown = shown + self.chunk.gloss[place];
        }
        if row.reflects { shown.scale(ambient.x.of(row.kept)) } else { shown }
    }

    /// Where `f32` cannot tell on which side of a pattern's edge a point lies, takes one for it that `f64` has found to
    /// look the same.
    #[inline(always)]
    fn move_off_edges(&mut self, batch: &impl Batch<S>, place: usize, mask: M<S>, material: &Material) {
        let at = self.shading_point(place);
        // A ray's origin is no farther out than its end and three times its length.
        let size = at.distance.mul_add(F::splat(self.s, 4.0), magnitude(at.position));
        let error = size.mul_add(F::splat(self.s, POSITION_ERROR), self.chunk.best[place].error);
        let lanes = mask & material.undecided(&at, error);
        if !lanes.any() {
            return;
        }
        let (packet, best) = (self.packet_of(batch, place), self.chunk.best[place]);
        let point = self.settle_every(&packet, &best, lanes).point;
        let position = &mut self.chunk.point[place];
        for lane in lanes.lanes() {
            self.stats.settled += 1;
            let near =
                material.reduced(DVec3::new(point.x.lane(lane), point.y.lane(lane), point.z.lane(lane)));
            position.x.set(lane, near.x as f32);
            position.y.set(lane, near.y as f32);
            position.z.set(lane, near.z as f32);
        }
    }

    /// The packet in a place of the chunk.
    #[inline(always)]
    pub(super) fn packet_of<'b, B: Batch<S>>(&self, batch: &'b B, place: usize) -> Packet<'b, S> {
        batch.packet(self.s, self.chunk.at[place])
    }

    /// Settles lanes, shape by shape.
    #[inline(always)]
    pub(super) fn settle_every(&mut self, packet: &Packet<'_, S>, best: &Best<S>, lanes: M<S>) -> Settled<S> {
        let mut left = lanes.bits();
        let prim = best.prim.lane(left.trailing_zeros() as usize);
        let mut mask = lanes & best.prim.is(prim);
        let mut settled = self.settle(packet, best, mask, prim);
        left &= !mask.bits();
        while left != 0 {
            let prim = best.prim.lane(left.trailing_zeros() as usize);
            mask = lanes & best.prim.is(prim);
            settled = self.settle_too(packet, best, mask, prim, settled);
            left &= !mask.bits();
        }
        settled
    }

    /// Settles the lanes on another shape. Compiled apart: most packets meet one shape.
    #[inline(always)]
    fn settle_too(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        mask: M<S>,
        prim: u32,
        before: Settled<S>,
    ) -> Settled<S> {
        let (packet, best) = (*packet, *best);
        self.s.vectorize(
            #[inline(always)]
            || self.settle(&packet, &best, mask, prim).over(mask, before),
        )
    }
}

/// The vector turned round where the mask holds.
#[inline(always)]
fn turned<S: Simd>(mask: M<S>, v: F3<S>) -> F3<S> {
    F3::select(mask, F3::new(-v.x, -v.y, -v.z), v)
}
