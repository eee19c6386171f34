//! Parts of a picture that one plane, one face of a solid or one sphere fills: every lane meets the same shape and wears one material.

use fearless_simd::Simd;

use super::Tracer;
use super::batch::{Batch, Part};
use super::meet::Finder;
use super::packet::Packet;
use super::plan::Shapes;
use super::search::Best;
use super::surface::Surface;
use crate::Tile;
use crate::kernel::{PlaneRow, Proposal, SphereRow};
use crate::lanes::{F, M, U, splat3};
use crate::snapshot::Row;

/// A shape that can fill a part of a picture.
trait Filler<S: Simd> {
    /// What every ray meets of it, ahead of its origin.
    fn propose(&self, s: S, packet: &Packet<'_, S>) -> Proposal<S>;

    /// Its surface there.
    fn surface(&self, tracer: &Tracer<'_, S>, packet: &Packet<'_, S>, best: &Best<S>) -> Surface<S>;
}

impl<S: Simd> Filler<S> for &PlaneRow {
    #[inline(always)]
    fn propose(&self, s: S, packet: &Packet<'_, S>) -> Proposal<S> {
        PlaneRow::propose(self, s, &packet.rays)
    }

    #[inline(always)]
    fn surface(&self, tracer: &Tracer<'_, S>, packet: &Packet<'_, S>, best: &Best<S>) -> Surface<S> {
        Surface::flat(packet.point(best.t), splat3(tracer.s, self.normal32))
    }
}

impl<S: Simd> Filler<S> for &SphereRow {
    #[inline(always)]
    fn propose(&self, s: S, packet: &Packet<'_, S>) -> Proposal<S> {
        SphereRow::propose(self, s, &packet.rays, M::splat(s, false))
    }

    #[inline(always)]
    fn surface(&self, tracer: &Tracer<'_, S>, packet: &Packet<'_, S>, best: &Best<S>) -> Surface<S> {
        tracer.surface_of_sphere(packet, best, self)
    }
}

/// One shape that fills a part of a picture, and every shape that may be seen there where it does not.
struct Filled<'a, F> {
    filler: F,
    prim: u32,
    facet: u32,
    shapes: &'a Shapes,
}

impl<S: Simd, R: Filler<S>> Finder<S> for Filled<'_, R> {
    /// Packets in which the kernel leaves anything undecided go the common way.
    #[inline(always)]
    fn meet(&self, tracer: &mut Tracer<'_, S>, batch: &impl Batch<S>, at: usize, place: usize) {
        let packet = batch.packet(tracer.s, at);
        let proposal = self.filler.propose(tracer.s, &packet);
        if (!(packet.live & proposal.hit) | proposal.undecided).bits() != 0 {
            tracer.meet_apart(batch, self.shapes, at, place);
            return;
        }
        tracer.stats.tests.shapes += F::<S>::LANES as u64;
        let best = Best {
            t: proposal.t,
            error: proposal.error,
            prim: U::splat(tracer.s, self.prim),
            facet: U::splat(tracer.s, self.facet),
        };
        tracer.occupy(&best, place, at);
        let lit = tracer.wears(packet.live, self.prim, place);
        tracer.chunk.lit[place] = lit;
        let surface = self.filler.surface(tracer, &packet, &best);
        tracer.put(&packet, place, surface);
    }
}

impl<S: Simd> Tracer<'_, S> {
    /// Adds the light that arrives along the camera rays of a part that one shape fills.
    #[inline(always)]
    pub(super) fn trace_filled(&mut self, part: &Part<'_, S>, shapes: &Shapes, tile: &mut Tile) {
        let columns = self.frame.snapshot.columns();
        let flat = match (&*shapes.planes, &*shapes.faces) {
            ([plane], _) => Some((&columns.planes[*plane as usize], 0)),
            (_, [face]) => {
                let face = &columns.triangles[*face as usize];
                Some((&face.plane, face.facet))
            }
            _ => None,
        };
        if let Some((filler, facet)) = flat {
            let filled = Filled { filler, prim: filler.prim, facet, shapes };
            self.s.vectorize(
                #[inline(always)]
                || self.shade(part, &filled, tile, 0),
            );
        } else if let [prim] = *shapes.bounded
            && let Row::Sphere(row) = columns.rows[prim as usize]
        {
            let filled = Filled { filler: &columns.spheres[row as usize], prim, facet: 0, shapes };
            self.s.vectorize(
                #[inline(always)]
                || self.shade(part, &filled, tile, 0),
            );
        }
    }

    /// Puts what a packet meets at a place of the chunk. Compiled apart: few packets are not filled.
    #[inline(always)]
    fn meet_apart(&mut self, batch: &impl Batch<S>, shapes: &Shapes, at: usize, place: usize) {
        self.s.vectorize(
            #[inline(always)]
            || (&shapes).meet(self, batch, at, place),
        );
    }
}
