//! What the rays of a packet meet first, and which ways to a light are blocked.

use catoptra_core::{Lane, LaneMask, Span};
use fearless_simd::Simd;

use super::Tracer;
use super::packet::Packet;
use crate::film::NOTHING;
use crate::kernel::{Blocking, Proposal, Target};
use crate::lanes::{F, M, U};
use crate::snapshot::Row;

/// Shapes are tried one by one up to this many; more go by the tree. Measured on the seed's scenes.
const FEW: usize = 4;

/// The nearest crossing of every lane so far.
#[derive(Clone, Copy)]
pub(super) struct Best<S: Simd> {
    /// Metres along the ray; [`f32::MAX`] where nothing is met.
    pub(super) t: F<S>,
    /// Bound on the error of `t`.
    pub(super) error: F<S>,
    /// Which shape; [`NOTHING`] where nothing is met.
    pub(super) prim: U<S>,
    /// Which facet of it.
    pub(super) facet: U<S>,
}

impl<S: Simd> Best<S> {
    #[inline(always)]
    fn nothing(s: S) -> Self {
        Self {
            t: F::splat(s, f32::MAX),
            error: F::splat(s, 0.0),
            prim: U::splat(s, NOTHING),
            facet: U::splat(s, 0),
        }
    }

    /// Lanes that meet something.
    #[inline(always)]
    pub(super) fn hits(&self) -> M<S> {
        !self.prim.is(NOTHING)
    }

    /// Metres to what is met, infinite where nothing is.
    #[inline(always)]
    pub(super) fn distance(&self, s: S) -> F<S> {
        F::pick(self.hits(), self.t, F::splat(s, f32::INFINITY))
    }
}

impl<S: Simd> Tracer<'_, S> {
    /// What every ray meets first.
    #[inline(always)]
    pub(super) fn nearest(&mut self, packet: &Packet<S>) -> Best<S> {
        let columns = self.frame.snapshot.columns();
        let mut best = Best::nothing(self.s);
        for plane in &columns.planes {
            let proposal = plane.propose(self.s, &packet.rays);
            self.consider(packet, &mut best, packet.live, (plane.prim, 0), proposal);
        }
        for &prim in &columns.general_unbounded {
            self.settle_lanes(packet, &mut best, packet.live, (prim, None));
        }
        if columns.bounded.len() <= FEW {
            for &prim in &columns.bounded {
                self.try_prim(packet, &mut best, prim);
            }
        } else {
            self.walk_scene(packet, &mut best);
        }
        best
    }

    /// Tests every ray against one bounded shape.
    #[inline(always)]
    pub(super) fn try_prim(&mut self, packet: &Packet<S>, best: &mut Best<S>, prim: u32) {
        let columns = self.frame.snapshot.columns();
        match columns.rows[prim as usize] {
            Row::Sphere(row) => {
                let leaving = packet.leaving_from(self.s, prim, 0);
                let proposal = columns.spheres[row as usize].propose(self.s, &packet.rays, leaving);
                // A sphere may be met again by a ray that leaves it, on its far side.
                self.weigh(packet, best, packet.live, (prim, 0), proposal);
            }
            Row::Rectangle(row) => {
                let proposal = columns.rectangles[row as usize].propose(self.s, &packet.rays);
                self.consider(packet, best, packet.live, (prim, 0), proposal);
            }
            Row::Triangles(first, count) => {
                for triangle in &columns.triangles[first as usize..(first + count) as usize] {
                    let proposal = triangle.propose(self.s, &packet.rays);
                    self.consider(packet, best, packet.live, (prim, triangle.facet), proposal);
                }
            }
            Row::Instance(row) => self.walk_mesh(packet, best, &columns.instances[row as usize]),
            Row::General | Row::Plane(_) => self.settle_lanes(packet, best, packet.live, (prim, None)),
        }
    }

    /// Takes over a proposal where it is nearer, leaving out rays that leave that very facet.
    #[inline(always)]
    pub(super) fn consider(
        &mut self,
        packet: &Packet<S>,
        best: &mut Best<S>,
        live: M<S>,
        place: (u32, u32),
        proposal: Proposal<S>,
    ) {
        let allowed =
            if packet.leaves { live & !packet.leaving_from(self.s, place.0, place.1) } else { live };
        self.weigh(packet, best, allowed, place, proposal);
    }

    /// Takes over a proposal where it is nearer; what cannot be decided is settled in `f64`.
    #[inline(always)]
    fn weigh(
        &mut self,
        packet: &Packet<S>,
        best: &mut Best<S>,
        allowed: M<S>,
        (prim, facet): (u32, u32),
        proposal: Proposal<S>,
    ) {
        self.stats.tests.shapes += F::<S>::LANES as u64;
        let doubt = proposal.error + best.error;
        let hit = allowed & proposal.hit;
        let nearer = hit & (proposal.t + doubt).less(best.t);
        let maybe = hit & !nearer & (proposal.t - doubt).less(best.t);
        let undecided = (allowed & proposal.undecided) | maybe;
        let take = nearer & !undecided;
        best.t = F::pick(take, proposal.t, best.t);
        best.error = F::pick(take, proposal.error, best.error);
        best.prim = U::pick(take, U::splat(self.s, prim), best.prim);
        best.facet = U::pick(take, U::splat(self.s, facet), best.facet);
        if undecided.any() {
            self.settle_lanes(packet, best, undecided, (prim, Some(facet)));
        }
    }

    /// Decides in `f64`, lane by lane, whether a shape is nearer than what has been found.
    ///
    /// With a facet, a mesh is crossed in that triangle only.
    #[inline(never)]
    fn settle_lanes(
        &mut self,
        packet: &Packet<S>,
        best: &mut Best<S>,
        lanes: M<S>,
        (prim, facet): (u32, Option<u32>),
    ) {
        let snapshot = self.frame.snapshot;
        for lane in lanes.lanes() {
            self.stats.settled += 1;
            let (ray, leaving) = (packet.ray(lane), packet.leaving(lane));
            let Some(hit) = snapshot.cross_part(prim, facet, &ray, Span::AHEAD, leaving) else { continue };
            let other = best.prim.lane(lane);
            let held = (other != NOTHING)
                .then(|| snapshot.cross_part(other, Some(best.facet.lane(lane)), &ray, Span::AHEAD, leaving))
                .flatten();
            if held.is_some_and(|held| (held.crossing.t, other) <= (hit.crossing.t, prim)) {
                continue;
            }
            let metres = (hit.crossing.t * ray.direction.length()) as f32;
            best.t.set(lane, metres.min(f32::MAX.next_down()));
            best.error.set(lane, metres * f32::EPSILON);
            best.prim.set(lane, prim);
            best.facet.set(lane, hit.place.facet);
        }
    }

    /// Which rays of a packet are blocked before they reach their light.
    #[inline(always)]
    pub(super) fn blocked(&mut self, packet: &Packet<S>, target: &Target<S>) -> M<S> {
        let columns = self.frame.snapshot.columns();
        let mut open = packet.live;
        for plane in &columns.planes {
            let blocking = plane.block(self.s, &packet.rays, target);
            let allowed = open & !packet.leaving_from(self.s, plane.prim, 0);
            self.block(packet, target, &mut open, allowed, (plane.prim, Some(0)), blocking);
        }
        for &prim in &columns.general_unbounded {
            self.block_lanes(packet, target, &mut open, packet.live, (prim, None));
        }
        if !open.any() {
            return packet.live;
        }
        if columns.bounded.len() <= FEW {
            for &prim in &columns.bounded {
                self.block_prim(packet, target, &mut open, prim);
            }
        } else {
            self.walk_scene_to_light(packet, target, &mut open);
        }
        packet.live & !open
    }

    /// Closes the ways that one bounded shape blocks.
    #[inline(always)]
    pub(super) fn block_prim(&mut self, packet: &Packet<S>, target: &Target<S>, open: &mut M<S>, prim: u32) {
        let columns = self.frame.snapshot.columns();
        match columns.rows[prim as usize] {
            Row::Sphere(row) => {
                let leaving = packet.leaving_from(self.s, prim, 0);
                let blocking =
                    columns.spheres[row as usize].block(self.s, &packet.rays, target, leaving & *open);
                let allowed = *open;
                self.block(packet, target, open, allowed, (prim, Some(0)), blocking);
            }
            Row::Rectangle(row) => {
                let blocking =
                    columns.rectangles[row as usize].propose(self.s, &packet.rays).blocking(target);
                let allowed = *open & !packet.leaving_from(self.s, prim, 0);
                self.block(packet, target, open, allowed, (prim, Some(0)), blocking);
            }
            Row::Triangles(first, count) => {
                for triangle in &columns.triangles[first as usize..(first + count) as usize] {
                    let blocking = triangle.propose(self.s, &packet.rays).blocking(target);
                    let allowed = *open & !packet.leaving_from(self.s, prim, triangle.facet);
                    self.block(packet, target, open, allowed, (prim, Some(triangle.facet)), blocking);
                }
            }
            Row::Instance(row) => {
                self.walk_mesh_to_light(packet, target, open, &columns.instances[row as usize]);
            }
            Row::General | Row::Plane(_) => {
                let all = *open;
                self.block_lanes(packet, target, open, all, (prim, None));
            }
        }
    }

    /// Closes the ways a kernel found blocked; what cannot be decided is settled in `f64`.
    #[inline(always)]
    pub(super) fn block(
        &mut self,
        packet: &Packet<S>,
        target: &Target<S>,
        open: &mut M<S>,
        allowed: M<S>,
        place: (u32, Option<u32>),
        blocking: Blocking<S>,
    ) {
        self.stats.tests.shapes += F::<S>::LANES as u64;
        let undecided = allowed & blocking.undecided;
        *open = *open & !(allowed & blocking.blocked & !undecided);
        if undecided.any() {
            self.block_lanes(packet, target, open, undecided, place);
        }
    }

    /// Decides in `f64`, lane by lane, whether a shape blocks the way.
    #[inline(never)]
    fn block_lanes(
        &mut self,
        packet: &Packet<S>,
        target: &Target<S>,
        open: &mut M<S>,
        lanes: M<S>,
        (prim, facet): (u32, Option<u32>),
    ) {
        let mut closed = 0;
        for lane in (lanes & *open).lanes() {
            self.stats.settled += 1;
            let (ray, span) = target.way_from(crate::lanes::lane3(packet.origin, lane));
            if self.frame.snapshot.cross_part(prim, facet, &ray, span, packet.leaving(lane)).is_some() {
                closed |= 1 << lane;
            }
        }
        *open = *open & !M::from_bits(self.s, closed);
    }
}
