//! Fast path for parts of a picture that one plane, one face of a solid or one sphere fills: every lane meets the same
//! shape and has one material.

use fearless_simd::Simd;

use super::Shader;
use super::hits::Finder;
use crate::Tile;
use crate::cull::Candidates;
use crate::kernel::{PlaneRow, Proposal, SphereRow};
use crate::lanes::{F, M, U, outlined};
use crate::search::{Hits, Packet, PreciseRays, Searcher, Surface};
use crate::snapshot::Row;
use crate::stream::{Batch, Part};

/// A shape that can fill a part of a picture.
trait Filler<S: Simd> {
    /// The hit of every ray on it, ahead of the ray's origin.
    fn propose<P: PreciseRays<S>>(&self, s: S, packet: &Packet<'_, S, P>) -> Proposal<S>;

    /// Its surface there.
    fn surface<P: PreciseRays<S>>(
        &self,
        search: &Searcher<'_, S>,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
    ) -> Surface<S>;
}

impl<S: Simd> Filler<S> for &PlaneRow {
    #[inline(always)]
    fn propose<P: PreciseRays<S>>(&self, s: S, packet: &Packet<'_, S, P>) -> Proposal<S> {
        PlaneRow::propose(self, s, &packet.rays)
    }

    #[inline(always)]
    fn surface<P: PreciseRays<S>>(
        &self,
        search: &Searcher<'_, S>,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
    ) -> Surface<S> {
        search.surface_of(packet, best, *self)
    }
}

impl<S: Simd> Filler<S> for &SphereRow {
    #[inline(always)]
    fn propose<P: PreciseRays<S>>(&self, s: S, packet: &Packet<'_, S, P>) -> Proposal<S> {
        SphereRow::propose(self, s, &packet.rays, M::splat(s, false))
    }

    #[inline(always)]
    fn surface<P: PreciseRays<S>>(
        &self,
        search: &Searcher<'_, S>,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
    ) -> Surface<S> {
        search.surface_of(packet, best, *self)
    }
}

/// One shape that fills a part of a picture, and every shape that may be seen there where it does not.
struct Filled<'a, F> {
    filler: F,
    prim: u32,
    facet: u32,
    candidates: &'a Candidates,
}

impl<S: Simd, R: Filler<S>> Finder<S> for Filled<'_, R> {
    /// Packets in which the kernel leaves anything undecided are searched like any other.
    #[inline(always)]
    fn fill_slot(&self, shader: &mut Shader<'_, S>, batch: &impl Batch<S>, at: usize, slot: usize) {
        let packet = batch.packet(shader.s, at);
        let proposal = self.filler.propose(shader.s, &packet);
        if (!(packet.live & proposal.hit) | proposal.undecided).bits() != 0 {
            shader.fill_slot_among(batch, self.candidates, at, slot);
            return;
        }
        shader.search.stats.tests.shapes += F::<S>::LANES as u64;
        let best = Hits {
            t: proposal.t,
            error: proposal.error,
            prim: U::splat(shader.s, self.prim),
            facet: U::splat(shader.s, self.facet),
        };
        shader.begin_slot(&best, slot, at);
        let lit = shader.add_material_group(packet.live, self.prim, slot);
        shader.chunk.lit[slot] = lit;
        let surface = self.filler.surface(&shader.search, &packet, &best);
        shader.store_surface(&packet, slot, surface);
    }
}

impl<S: Simd> Shader<'_, S> {
    /// Adds the light that arrives along the camera rays of a part that one shape fills.
    #[inline(always)]
    pub(crate) fn shade_filled(&mut self, part: &Part<'_, S>, candidates: &Candidates, tile: &mut Tile) {
        let columns = self.search.snapshot.columns();
        let flat = match (&*candidates.planes, &*candidates.faces) {
            ([plane], _) => Some((&columns.planes[*plane as usize], 0)),
            (_, [face]) => {
                let face = &columns.triangles[*face as usize];
                Some((&face.plane, face.facet))
            }
            _ => None,
        };
        if let Some((filler, facet)) = flat {
            let filled = Filled { filler, prim: filler.prim, facet, candidates };
            outlined(
                self.s,
                #[inline(always)]
                || self.shade(part, &filled, tile, 0),
            );
        } else if let [prim] = *candidates.bounded
            && let Row::Sphere(row) = columns.rows[prim as usize]
        {
            let filled = Filled { filler: &columns.spheres[row as usize], prim, facet: 0, candidates };
            outlined(
                self.s,
                #[inline(always)]
                || self.shade(part, &filled, tile, 0),
            );
        }
    }

    /// Fills a slot where one shape does not fill all of a packet, as few do. See [`outlined`].
    #[inline(always)]
    fn fill_slot_among(&mut self, batch: &impl Batch<S>, candidates: &Candidates, at: usize, slot: usize) {
        outlined(
            self.s,
            #[inline(always)]
            || (&candidates).fill_slot(self, batch, at, slot),
        );
    }
}
