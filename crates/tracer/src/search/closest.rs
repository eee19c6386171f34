//! What the rays of a packet meet first.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::Searcher;
use super::hits::Hits;
use super::packet::{Packet, PreciseRays};
use crate::SurfaceId;
use crate::cull::Candidates;
use crate::film::NOTHING;
use crate::kernel::Proposal;
use crate::lanes::{Bits, F, M, U, outlined};
use crate::numeric::{CERTAIN, SETTLED_ERROR};
use crate::snapshot::{RaySegment, Row};

/// A shape that may be the nearest, as far as `f32` can tell.
#[derive(Clone, Copy)]
struct Doubtful<S: Simd> {
    prim: u32,
    /// The facet in question; `None` for a shape without a kernel.
    facet: Option<U<S>>,
    t: F<S>,
    error: F<S>,
    /// Lanes where `t` is a crossing for certain, and only its place in the order is in doubt.
    known: M<S>,
}

impl<S: Simd> Searcher<'_, S> {
    /// What every ray meets first of the given shapes.
    #[inline(always)]
    pub(crate) fn closest<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        shapes: &Candidates,
    ) -> Hits<S> {
        let mut best = Hits::nothing(self.s);
        self.look(packet, &mut best, shapes);
        best
    }

    /// Looks among the given shapes for what is nearer than what has been found.
    #[inline(always)]
    pub(crate) fn look<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        shapes: &Candidates,
    ) {
        let columns = self.snapshot.columns();
        for &row in &shapes.planes {
            let plane = &columns.planes[row as usize];
            let proposal = plane.propose(self.s, &packet.rays);
            self.consider(packet, best, packet.live, (plane.prim, 0), proposal);
        }
        for &prim in &columns.general_unbounded {
            self.decide_all(packet, best, packet.live, prim);
        }
        for &prim in &shapes.bounded {
            self.try_prim(packet, best, prim);
        }
        if !shapes.faces.is_empty() {
            *best = self.try_faces(packet, *best, &shapes.faces);
        }
        if shapes.tree {
            *best = self.walk_scene(packet, *best);
        }
    }

    /// Tests every ray against some faces. See [`outlined`].
    #[inline(always)]
    fn try_faces<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: Hits<S>,
        faces: &[u32],
    ) -> Hits<S> {
        let (packet, mut best) = (*packet, best);
        outlined(
            self.s,
            #[inline(always)]
            || {
                for &row in faces {
                    let face = &self.snapshot.columns().triangles[row as usize];
                    let proposal = face.propose(self.s, &packet.rays);
                    self.consider(&packet, &mut best, packet.live, (face.plane.prim, face.facet), proposal);
                }
            },
        );
        best
    }

    /// Tests every ray against one bounded shape.
    #[inline(always)]
    pub(crate) fn try_prim<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        prim: u32,
    ) {
        let columns = self.snapshot.columns();
        if let Row::Sphere(row) = columns.rows[prim as usize] {
            let leaving = packet.leaving.from(self.s, prim, 0);
            let proposal = columns.spheres[row as usize].propose(self.s, &packet.rays, leaving);
            // A sphere may be met again by a ray that leaves it, on its far side.
            self.accept(packet, best, packet.live, (prim, U::splat(self.s, 0)), proposal);
        } else {
            *best = self.try_facets(packet, *best, prim);
        }
    }

    /// Tests every ray against one bounded shape that is no sphere. See [`outlined`].
    #[inline(always)]
    fn try_facets<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: Hits<S>,
        prim: u32,
    ) -> Hits<S> {
        let (packet, mut best) = (*packet, best);
        outlined(
            self.s,
            #[inline(always)]
            || self.try_each_facet(&packet, &mut best, prim),
        );
        best
    }

    #[inline(always)]
    fn try_each_facet<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        prim: u32,
    ) {
        let columns = self.snapshot.columns();
        match columns.rows[prim as usize] {
            Row::Flat(row) => {
                let proposal = columns.flats[row as usize].propose(self.s, &packet.rays);
                self.consider(packet, best, packet.live, (prim, 0), proposal);
            }
            Row::Cuboid(row) => {
                let cuboid = &columns.cuboids[row as usize];
                let self_hits = self.self_hits(packet, &cuboid.faces);
                if self_hits.undecided.any() {
                    self.decide_all(packet, best, self_hits.undecided, prim);
                }
                if self_hits.possible.any() {
                    let entered = self_hits.entered(self.s, &packet.leaving);
                    let (proposal, facet) = cuboid.propose(self.s, &packet.rays, entered);
                    self.accept(packet, best, self_hits.possible, (prim, facet), proposal);
                }
            }
            Row::Triangles(first, count) => {
                let triangles = &columns.triangles[first as usize..(first + count) as usize];
                let self_hits = self.self_hits(packet, triangles);
                if self_hits.undecided.any() {
                    self.decide_all(packet, best, self_hits.undecided, prim);
                }
                if !self_hits.possible.any() {
                    return;
                }
                for triangle in triangles {
                    let proposal = triangle.propose(self.s, &packet.rays);
                    self.consider(packet, best, self_hits.possible, (prim, triangle.facet), proposal);
                }
            }
            Row::Instance(row) => self.walk_mesh(packet, best, &columns.instances[row as usize]),
            Row::General | Row::Plane(_) | Row::Sphere(_) => {
                self.decide_all(packet, best, packet.live, prim);
            }
        }
    }

    /// Takes over a proposal where it is nearer, leaving out rays that leave that very facet.
    #[inline(always)]
    pub(crate) fn consider<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        live: M<S>,
        place: (u32, u32),
        proposal: Proposal<S>,
    ) {
        let allowed =
            if packet.leaving.any { live & !packet.leaving.from(self.s, place.0, place.1) } else { live };
        self.accept(packet, best, allowed, (place.0, U::splat(self.s, place.1)), proposal);
    }

    /// Takes over a proposal where it is nearer; what cannot be decided is settled in `f64`.
    #[inline(always)]
    fn accept<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        allowed: M<S>,
        (prim, facet): (u32, U<S>),
        proposal: Proposal<S>,
    ) {
        self.stats.tests.shapes += F::<S>::LANES as u64;
        let doubt = proposal.error + best.error;
        let hit = allowed & proposal.hit;
        let nearer = hit & (proposal.t + doubt).less(best.t);
        // Written so that NaN, from numbers beyond those of f32, stays in doubt.
        let maybe = hit & !nearer & !best.t.less(proposal.t - doubt);
        let mut undecided = (allowed & proposal.undecided) | maybe;
        if !P::FROM_ORIGIN {
            // What is met before the span begins may hide what is met on it.
            undecided = undecided | (hit & !packet.begins(self.s)[1].less(proposal.t - proposal.error));
        }
        let take = if CERTAIN { nearer & !undecided } else { nearer };
        best.t = F::pick(take, proposal.t, best.t);
        best.error = F::pick(take, proposal.error, best.error);
        best.prim = U::pick(take, U::splat(self.s, prim), best.prim);
        best.facet = U::pick(take, facet, best.facet);
        if CERTAIN && undecided.any() {
            let doubtful = Doubtful {
                prim,
                facet: Some(facet),
                t: proposal.t,
                error: proposal.error,
                known: maybe & !proposal.undecided,
            };
            self.decide_lanes(packet, best, undecided, &doubtful);
        }
    }

    /// Decides in `f64` about a shape without a kernel.
    #[inline(always)]
    fn decide_all<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        lanes: M<S>,
        prim: u32,
    ) {
        let none = F::splat(self.s, 0.0);
        let doubtful = Doubtful { prim, facet: None, t: none, error: none, known: M::splat(self.s, false) };
        self.decide_lanes(packet, best, lanes, &doubtful);
    }

    /// Decides in `f64`, lane by lane, whether a shape is nearer than what has been found. Works on copies, so that
    /// packet and best may stay in registers.
    #[inline(always)]
    fn decide_lanes<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        lanes: M<S>,
        doubtful: &Doubtful<S>,
    ) {
        let (packet, mut copy, doubtful) = (*packet, *best, *doubtful);
        self.decide_each_lane(&packet, &mut copy, lanes.bits(), &doubtful);
        *best = copy;
    }

    #[cold]
    #[inline(never)]
    fn decide_each_lane<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        lanes: u64,
        doubtful: &Doubtful<S>,
    ) {
        let (snapshot, prim) = (self.snapshot, doubtful.prim);
        let solid = snapshot.columns().faces_of(prim).is_some();
        for lane in Bits(lanes) {
            self.stats.settled += 1;
            let facet = doubtful.facet.map(|facet| facet.lane(lane));
            // A mesh is crossed in that triangle only; of a solid, other faces that pass through the same edge may not
            // have been looked at.
            let part = facet.filter(|_| !solid);
            let (ray, span, leaving) = packet.segment(lane);
            let segment = RaySegment::new(&ray, span, leaving);
            let known = doubtful.known.bits() >> lane & 1 == 1;
            let other = best.prim.lane(lane);
            let held = (other != NOTHING).then(|| SurfaceId { prim: other, facet: best.facet.lane(lane) });
            let first = match (facet, held) {
                // Both are met for certain: only which is first is asked, unless the stretch may begin behind one.
                (Some(facet), Some(held)) if known && P::FROM_ORIGIN => snapshot
                    .surface_precedes(&segment, SurfaceId { prim, facet }, held)
                    .then_some((facet, 0.0)),
                _ => {
                    let cross = |prim, facet| snapshot.cross_part(prim, facet, &ray, span, leaving);
                    let hit = cross(prim, part);
                    let held = held.and_then(|held| cross(held.prim, Some(held.facet)));
                    let hit =
                        hit.filter(|hit| held.is_none_or(|held| snapshot.precedes(&segment, hit, &held)));
                    hit.map(|hit| (hit.place.facet, hit.crossing.t * ray.direction.length()))
                }
            };
            let Some((facet, metres)) = first else { continue };
            // What a kernel found where it was certain stays, whatever it had to compete with.
            let (t, error) = if known {
                (doubtful.t.lane(lane), doubtful.error.lane(lane))
            } else {
                let metres = metres as f32;
                (metres.min(f32::MAX.next_down()), metres * SETTLED_ERROR + f32::MIN_POSITIVE)
            };
            best.t.set(lane, t);
            best.error.set(lane, error);
            best.prim.set(lane, prim);
            best.facet.set(lane, facet);
        }
    }
}
