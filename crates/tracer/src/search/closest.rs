//! The closest hits of a packet.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::Searcher;
use super::hits::Hits;
use super::packet::{Packet, PreciseRays};
use crate::SurfaceId;
use crate::cull::Candidates;
use crate::film::NOTHING;
use crate::kernel::{Crossing, Facet, Kernel, Proposal, Tried};
use crate::lanes::{Bits, F, M, U, outlined};
use crate::numeric::{CERTAIN, SETTLED_ERROR};
use crate::snapshot::{Instance, KernelVisitor, RaySegment};

/// A shape that may be the nearest, within the error bounds of `f32`.
#[derive(Clone, Copy)]
struct Doubtful<S: Simd> {
    prim: u32,
    /// The facet in question; `None` for a shape without a kernel.
    facet: Option<U<S>>,
    t: F<S>,
    error: F<S>,
    /// Lanes where `t` is a crossing for certain, and only its order among the others is in doubt.
    known: M<S>,
}

impl<S: Simd> Searcher<'_, S> {
    /// The closest hit of every ray among the given shapes.
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

    /// Searches the given shapes for hits that are nearer than those found so far.
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
            self.consider(packet, best, packet.live, SurfaceId { prim: plane.prim, facet: 0 }, proposal);
        }
        for &prim in &columns.general_unbounded {
            self.decide_all(packet, best, packet.live, prim);
        }
        for &prim in &shapes.bounded {
            if !(columns.instance(prim).is_some() && self.later.takes(prim)) {
                self.try_prim(packet, best, prim);
            }
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
                    let surface = SurfaceId { prim: face.plane.prim, facet: face.facet };
                    self.consider(&packet, &mut best, packet.live, surface, proposal);
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
        let (s, columns) = (self.s, self.snapshot.columns());
        *best = columns.visit(s, prim, TryShape { search: self, packet: *packet, best: *best, prim });
    }

    /// Takes over a proposal where it is nearer, leaving out rays that leave that very facet.
    #[inline(always)]
    pub(crate) fn consider<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        live: M<S>,
        surface: SurfaceId,
        proposal: Proposal<S>,
    ) {
        let allowed = if packet.leaving.any {
            live & !packet.leaving.from(self.s, surface.prim, surface.facet)
        } else {
            live
        };
        let facet = Facet::Same(surface.facet);
        self.accept(packet, best, surface.prim, Crossing { proposal, facet, lanes: allowed });
    }

    /// Takes over a proposal where it is nearer; what `f32` cannot decide is decided in `f64`.
    #[inline(always)]
    fn accept<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        prim: u32,
        crossing: Crossing<S>,
    ) {
        let Crossing { proposal, facet, lanes: allowed } = crossing;
        let facet = facet.in_lanes(self.s);
        self.stats.tests.shapes += F::<S>::LANES as u64;
        let doubt = proposal.error + best.error;
        let hit = allowed & proposal.hit;
        let nearer = hit & (proposal.t + doubt).less(best.t);
        // Written so that NaN, from numbers beyond those of f32, stays in doubt.
        let maybe = hit & !nearer & !best.t.less(proposal.t - doubt);
        let mut undecided = (allowed & proposal.undecided) | maybe;
        if !P::FROM_ORIGIN {
            // A hit before the span begins may hide one on it.
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
        let solid = snapshot.columns().is_asked_whole(prim);
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
                // Both are met for certain: only their order is to be decided, unless the span may begin behind one.
                (Some(facet), Some(held)) if known && P::FROM_ORIGIN => snapshot
                    .surface_precedes(&segment, SurfaceId { prim, facet }, held)
                    .then_some((facet, 0.0)),
                _ => {
                    let cross = |prim, facet| snapshot.cross_part(prim, facet, &ray, span, leaving);
                    let hit = cross(prim, part);
                    let held = held.and_then(|held| cross(held.prim, Some(held.facet)));
                    let hit =
                        hit.filter(|hit| held.is_none_or(|held| snapshot.precedes(&segment, hit, &held)));
                    hit.map(|hit| (hit.surface.facet, hit.crossing.t * ray.direction.length()))
                }
            };
            let Some((facet, metres)) = first else { continue };
            // The `t` that a kernel was certain of is kept, whichever hit it was compared with.
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

/// Tests every ray of a packet against one shape, on copies; returns the nearest crossings after it.
struct TryShape<'t, 'a, 'b, S: Simd, P> {
    search: &'t mut Searcher<'a, S>,
    packet: Packet<'b, S, P>,
    best: Hits<S>,
    prim: u32,
}

impl<S: Simd, P: PreciseRays<S>> KernelVisitor for TryShape<'_, '_, '_, S, P> {
    type Output = Hits<S>;

    #[inline(always)]
    fn visit(self, kernel: &impl Kernel) -> Hits<S> {
        let Self { search, packet, mut best, prim } = self;
        let (s, leaving) = (search.s, packet.leaving);
        let nothing = U::splat(s, NOTHING);
        let mut tried =
            Tried { prim, lanes: packet.live, leaving, entered: nothing, outside: search.outside };
        if !kernel.faces().is_empty() {
            let hits = search.self_hits(&packet, kernel.faces());
            if hits.undecided.any() {
                search.decide_all(&packet, &mut best, hits.undecided, prim);
            }
            if !hits.possible.any() {
                return best;
            }
            (tried.lanes, tried.entered) = (hits.possible, hits.entered(s, &leaving));
        }
        kernel.propose(
            s,
            &packet.rays,
            &tried,
            #[inline(always)]
            |crossing| search.accept(&packet, &mut best, prim, crossing),
        );
        best
    }

    #[inline(always)]
    fn visit_mesh(self, instance: &Instance) -> Hits<S> {
        let Self { search, packet, mut best, prim } = self;
        if !search.later.takes(prim) {
            search.walk_mesh(&packet, &mut best, instance);
        }
        best
    }

    #[inline(always)]
    fn visit_none(self) -> Hits<S> {
        let Self { search, packet, mut best, prim } = self;
        search.decide_all(&packet, &mut best, packet.live, prim);
        best
    }
}
