//! Batched ray queries: closest hit and occlusion for rays that the caller supplies, by the code that finds what pictures
//! show.

mod single_mesh;

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask, Ray, Span};
use fearless_simd::{Level, Simd};

use single_mesh::single_mesh;

use super::{Hits, OwnSegments, Packet, PreciseRays, Searcher, ShadowRays, drift, kernel_rays};
use crate::cull::Candidates;
use crate::film::NOTHING;
use crate::kernel::mesh::{Lines, Visits};
use crate::kernel::{Leaving, Target};
use crate::lanes::{Bits, D, D3, F, F3, M, U, Work, at_level, load_wide3, narrow3, splat_wide};
use crate::numeric::{END_ERROR, ORDINARY, POINT_ERROR};
use crate::rays::{HitSlice, RaySlice};
use crate::snapshot::Instance;
use crate::{Snapshot, Stats, SurfaceId};

/// Rays of a caller.
pub(crate) struct RayQuery<'a> {
    rays: RaySlice<'a>,
    snapshot: &'a Snapshot,
}

impl RayQuery<'_> {
    /// How many rays there are.
    #[inline(always)]
    fn len(&self) -> usize {
        self.rays.len()
    }

    /// A ray in the snapshot's frame, its span, and the surface that it leaves.
    #[inline]
    fn segment(&self, at: usize) -> (Ray, Span, Option<SurfaceId>) {
        (self.ray_at(at), self.span_at(at), self.rays.leaving(at))
    }

    #[inline]
    fn ray_at(&self, at: usize) -> Ray {
        self.snapshot.own_ray(&self.rays.ray(at))
    }

    #[inline]
    fn span_at(&self, at: usize) -> Span {
        self.rays.span(at).unwrap_or(Span { min: 0.0, max: 0.0 })
    }

    /// Origins and directions from ray `at` on.
    #[inline(always)]
    fn lines<S: Simd>(&self, s: S, at: usize) -> (D3<S>, D3<S>) {
        let (rays, lane) = self.rays.block(at);
        let [x, y, z] = &rays.origin;
        let origin = load_wide3(s, &[&x[..], &y[..], &z[..]], lane);
        let [x, y, z] = &rays.direction;
        let direction = load_wide3(s, &[&x[..], &y[..], &z[..]], lane);
        (origin - splat_wide(s, self.snapshot.origin()), direction)
    }

    /// As [`lines`](Self::lines), of some lanes and in a mesh's own space.
    #[inline(always)]
    fn own_lines<S: Simd>(&self, s: S, at: usize, instance: &Instance, live: M<S>) -> Lines<S> {
        let (origin, direction) = self.lines(s, at);
        Lines { origin: instance.own_points(s, origin), direction: instance.own_vectors(s, direction), live }
    }

    /// Where the spans of the packet at ray `at` begin and end; not finite for unbounded ones.
    #[inline(always)]
    fn span_ends<S: Simd>(&self, s: S, at: usize) -> [D3<S>; 2] {
        let (origin, direction) = self.lines(s, at);
        let (rays, lane) = self.rays.block(at);
        let min = D::load(s, &rays.min[lane..]).max(D::splat(s, 0.0));
        let max = D::load(s, &rays.max[lane..]);
        [direction.scale_add(min, origin), direction.scale_add(max, origin)]
    }

    /// Metres at which the spans end, within [`END_ERROR`] of themselves.
    #[inline(always)]
    fn ends_in_metres<S: Simd>(&self, s: S, at: usize) -> F<S> {
        let (rays, lane) = self.rays.block(at);
        self.in_metres(s, &rays.max[lane..], at)
    }

    /// Lengths of the directions in metres, within [`END_ERROR`] of themselves.
    #[inline(always)]
    fn in_metres<S: Simd>(&self, s: S, lengths: &[f64], at: usize) -> F<S> {
        let (_, direction) = self.lines(s, at);
        let (_, inverse_length) = kernel_rays(s, narrow3(direction), narrow3(direction));
        D::load(s, lengths).narrow() / inverse_length
    }

    /// Depths between which the spans begin, and those at which they end and how far these may be off; for rays of
    /// `scale` depth per `t`.
    #[inline(always)]
    fn depths<S: Simd>(&self, s: S, at: usize, scale: F<S>) -> [[F<S>; 2]; 2] {
        let (rays, lane) = self.rays.block(at);
        let (error, most) = (F::splat(s, END_ERROR), F::splat(s, f32::MAX));
        let begin = D::load(s, &rays.min[lane..]).narrow().max(F::splat(s, 0.0)) * scale;
        let end = (D::load(s, &rays.max[lane..]).narrow() * scale).min(most);
        let near = end.less(F::splat(s, f32::MAX / 4.0));
        let off = begin * error;
        [[begin - off, begin + off], [F::pick(near, end, most), F::pick(near, end * error, F::splat(s, 0.0))]]
    }

    /// The surfaces that the rays of the packet at ray `at` leave.
    #[inline(always)]
    fn leaving<S: Simd>(&self, s: S, at: usize) -> Leaving<S> {
        let (from, rays) = (self.rays.first + at, self.rays.rays);
        if rays.prim.is_empty() {
            return Leaving::nothing(s);
        }
        Leaving { prim: U::load(s, &rays.prim[from..]), facet: U::load(s, &rays.facet[from..]), any: true }
    }

    /// Rays of the packet at ray `at` that kernels may follow; the others are answered one by one.
    #[inline(always)]
    fn live<S: Simd>(&self, s: S, at: usize) -> M<S> {
        let (origin, direction) = self.lines(s, at);
        let count = (self.rays.len() - at).min(F::<S>::LANES);
        let there = M::from_bits(s, u64::MAX >> (64 - count));
        there & self.in_order(s, at) & self.is_exact(s, at) & is_ordinary(s, origin, direction)
    }

    /// The packet that starts with ray `at`.
    #[inline(always)]
    fn packet<S: Simd>(&self, s: S, at: usize) -> Packet<'_, S, Self> {
        let (origin, direction) = self.lines(s, at);
        let (rays, inverse_length) = kernel_rays(s, narrow3(origin), narrow3(direction));
        Packet {
            precise: self,
            at,
            rays: rays.drifting(F::splat(s, drift(self.snapshot.origin_in_frame()))),
            inverse_length,
            leaving: self.leaving(s, at),
            live: self.live(s, at),
        }
    }

    /// The spans of a packet as shadow rays. Rays that leave a surface but whose spans begin later are answered one by
    /// one instead.
    #[inline(always)]
    fn shadow_rays<S: Simd>(&self, s: S, packet: &Packet<'_, S, Self>) -> ShadowRays<'static, S> {
        let (rays, lane) = self.rays.block(packet.at);
        let zero = F::splat(s, 0.0);
        let begin = D::load(s, &rays.min[lane..]).max(D::splat(s, 0.0));
        let length = D::load(s, &rays.max[lane..]) - begin;
        let later = zero.less(begin.narrow());
        let mut kernel = packet.rays;
        if later.any() {
            let (start, _) = kernel_rays(s, narrow3(self.span_ends(s, packet.at)[0]), kernel.direction);
            kernel.origin = F3::select(later, start.origin, kernel.origin);
            kernel.reach = F::pick(later, start.reach, kernel.reach).max(kernel.reach);
        }
        let distance = length.narrow() / packet.inverse_length;
        let finite = distance.less(F::splat(s, f32::MAX));
        // Lengths are off by a share of themselves, and starts may be by a rounding of where they are moved to.
        let off =
            F::pick(finite, distance, zero) + F::pick(later, begin.narrow() / packet.inverse_length, zero);
        kernel.reach = off.mul_add(F::splat(s, END_ERROR / POINT_ERROR), kernel.reach);
        ShadowRays {
            rays: kernel,
            leaving: packet.leaving,
            live: packet.live & !(later & !packet.leaving.prim.is(NOTHING)),
            target: Target { distance, end: None },
            behind: &[],
        }
    }

    /// Rays that are carried over into the snapshot's frame without rounding; the others are answered one by one.
    #[inline(always)]
    fn is_exact<S: Simd>(&self, s: S, at: usize) -> M<S> {
        let (rays, lane) = self.rays.block(at);
        let frame = self.snapshot.frame();
        let mut exact = M::splat(s, true);
        if frame != DVec3::ZERO {
            for (column, zero) in rays.origin.iter().zip(frame.to_array()) {
                let (given, zero) = (D::load(s, &column[lane..]), D::splat(s, zero));
                let own = given - zero;
                let (back, other) = (own + zero, given - own);
                exact = exact & back.at_most(given) & given.at_most(back);
                exact = exact & other.at_most(zero) & zero.at_most(other);
            }
        }
        exact
    }

    /// Stretches that are not empty.
    #[inline(always)]
    fn in_order<S: Simd>(&self, s: S, at: usize) -> M<S> {
        let (rays, lane) = self.rays.block(at);
        let (min, max) = (D::load(s, &rays.min[lane..]), D::load(s, &rays.max[lane..]));
        let zero = D::splat(s, 0.0);
        min.at_most(max) & zero.at_most(max)
    }
}

/// Rays whose numbers are so ordinary that `f32` can hold them and their squares; false for NaN.
#[inline(always)]
fn is_ordinary<S: Simd>(s: S, origin: D3<S>, direction: D3<S>) -> M<S> {
    let (least, most) = (D::splat(s, ORDINARY[0]), D::splat(s, ORDINARY[1]));
    let largest = direction.x.abs().max(direction.y.abs()).max(direction.z.abs());
    sum(origin).at_most(most) & least.at_most(largest) & sum(direction).at_most(most)
}

/// Sum of magnitudes; NaN where any of them is, which the largest need not be.
#[inline(always)]
fn sum<S: Simd>(v: D3<S>) -> D<S> {
    v.x.abs() + v.y.abs() + v.z.abs()
}

impl<S: Simd> PreciseRays<S> for RayQuery<'_> {
    const UNIT: bool = false;
    const FROM_ORIGIN: bool = false;

    #[inline]
    fn ray(&self, at: usize) -> Ray {
        self.ray_at(at)
    }

    #[inline]
    fn span(&self, at: usize) -> Span {
        self.span_at(at)
    }

    #[inline(always)]
    fn precise(&self, s: S, at: usize) -> (D3<S>, D3<S>) {
        self.lines(s, at)
    }

    #[inline(always)]
    fn begins(&self, s: S, at: usize) -> [F<S>; 2] {
        let (rays, lane) = self.rays.block(at);
        let min = self.in_metres(s, &rays.min[lane..], at).max(F::splat(s, 0.0));
        let error = min * F::splat(s, END_ERROR);
        [min - error, min + error]
    }

    #[inline(always)]
    fn ends(&self, s: S, at: usize) -> [D3<S>; 2] {
        self.span_ends(s, at)
    }
}

/// Answers with the best of the instructions there are.
pub(crate) fn answer(snapshot: &Snapshot, rays: RaySlice<'_>, answers: Answers<'_, '_>) -> Stats {
    at_level(Level::new(), Answer { snapshot, rays, answers })
}

/// Answering about rays.
struct Answer<'a, 'b, 'c> {
    snapshot: &'a Snapshot,
    rays: RaySlice<'a>,
    answers: Answers<'b, 'c>,
}

impl Work for Answer<'_, '_, '_> {
    type Output = Stats;

    #[inline(always)]
    fn with<S: Simd>(self, s: S) -> Stats {
        let Self { snapshot, rays, mut answers } = self;
        let mut visits = Visits::default();
        let mut search = Searcher::new(s, snapshot, &mut visits, false);
        let query = RayQuery { rays, snapshot };
        match single_mesh(snapshot) {
            Some(mesh) => search.answer_of_mesh(&query, mesh, &mut answers),
            None => search.answer(&query, &mut answers),
        }
        search.stats
    }
}

/// Where results are stored.
pub(crate) enum Answers<'a, 'b> {
    /// Closest hits.
    Nearest(&'a mut HitSlice<'b>),
    /// Whether each ray is occluded.
    Occluded(&'a mut [bool]),
}

impl Answers<'_, '_> {
    fn set(&mut self, at: usize, hit: Option<(SurfaceId, f64)>) {
        match self {
            Self::Nearest(hits) => hits.set(at, hit),
            Self::Occluded(occluded) => occluded[at] = hit.is_some(),
        }
    }
}

impl<S: Simd> Searcher<'_, S> {
    #[inline(always)]
    fn answer(&mut self, query: &RayQuery<'_>, answers: &mut Answers<'_, '_>) {
        let mut candidates = Candidates::default();
        candidates.all(self.snapshot.columns());
        for at in (0..query.len()).step_by(F::<S>::LANES) {
            let packet = query.packet(self.s, at);
            let odd = match answers {
                Answers::Nearest(hits) => {
                    self.find_closest(query, &packet, &candidates, hits);
                    !packet.live
                }
                Answers::Occluded(occluded) => {
                    let rays = query.shadow_rays(self.s, &packet);
                    let blocked = self.occluded(&OwnSegments(&packet), &rays, &candidates).bits();
                    for (lane, occluded) in occluded[at..].iter_mut().enumerate().take(F::<S>::LANES) {
                        *occluded = blocked >> lane & 1 == 1;
                    }
                    !rays.live
                }
            };
            self.answer_one_by_one(query, at, odd, answers);
        }
    }

    /// Keeps what the rays of a packet meet first.
    #[inline(always)]
    fn find_closest(
        &mut self,
        query: &RayQuery<'_>,
        packet: &Packet<'_, S, RayQuery<'_>>,
        candidates: &Candidates,
        hits: &mut HitSlice<'_>,
    ) {
        let at = packet.at;
        let far = query.ends_in_metres(self.s, at).min(F::splat(self.s, f32::MAX));
        let finite = far.less(F::splat(self.s, f32::MAX));
        let none = F::splat(self.s, 0.0);
        let error = F::pick(finite, far * F::splat(self.s, END_ERROR), none);
        let mut best = Hits::nothing_until(self.s, far, error);
        self.look(packet, &mut best, candidates);
        best.prim.store(&mut hits.prim[at..]);
        best.facet.store(&mut hits.facet[at..]);
        self.refined_hits(packet, &best).store(&mut hits.t[at..]);
    }

    /// Answers about the rays of the packet at ray `at` that kernels may not follow.
    #[inline(always)]
    fn answer_one_by_one(
        &mut self,
        query: &RayQuery<'_>,
        at: usize,
        odd: M<S>,
        answers: &mut Answers<'_, '_>,
    ) {
        let lanes = (query.len() - at).min(F::<S>::LANES);
        let odd = odd.bits() & (u64::MAX >> (64 - lanes));
        for lane in Bits(odd) {
            answers.set(at + lane, self.scalar_answer(query, at + lane));
        }
    }

    /// The `t` of hits in `f64`.
    #[inline(always)]
    fn refined_hits<P: PreciseRays<S>>(&mut self, packet: &Packet<'_, S, P>, best: &Hits<S>) -> D<S> {
        let snapshot = self.snapshot;
        let mut all = (best.t * packet.inverse_length).widen();
        let mut remaining = (best.hits() & packet.live).bits();
        while remaining != 0 {
            let prim = best.prim.lane(remaining.trailing_zeros() as usize);
            let lanes = M::from_bits(self.s, remaining) & best.prim.is(prim);
            remaining &= !lanes.bits();
            if let Some(instance) = snapshot.columns().instance(prim) {
                let triangles = instance.facets(self.s, best.facet, lanes);
                let lines = self.own_lines(packet, instance, lanes);
                let of_lane = |lane: usize| packet.segment(lane);
                let t = self.refined_t(prim, &lines, &triangles, of_lane);
                all = D::pick(lanes, t, all);
                continue;
            }
            for lane in lanes.lanes() {
                let (ray, span, leaving) = packet.segment(lane);
                let facet = Some(best.facet.lane(lane));
                // A hit that `f32` was certain of is kept, though `f64` may find its `t` just outside the span.
                if let Some(hit) = snapshot.cross_part(prim, facet, &ray, span, leaving) {
                    all.set(lane, hit.crossing.t);
                }
            }
        }
        all
    }

    /// The closest hit of a ray whose numbers `f32` cannot hold.
    #[cold]
    fn scalar_answer(&self, query: &RayQuery<'_>, at: usize) -> Option<(SurfaceId, f64)> {
        let hit = query.rays.follow(self.snapshot, at, |segment| self.snapshot.nearest_on(segment))?;
        Some((hit.surface, hit.crossing.t))
    }
}
