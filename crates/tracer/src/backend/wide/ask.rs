//! Questions about rays of anyone's choice, answered by the code that finds what pictures show.

mod alone;

use catoptra_core::glam::DVec3;
use catoptra_core::{Camera, Lane, Ray, Span};
use fearless_simd::{Level, Simd};

use super::batch::Found;
use super::chunk::Chunk;
use super::packet::{Left, Packet, Precise, drift, kernel_rays};
use super::plan::Shapes;
use super::queue::Queue;
use super::search::Best;
use super::spread::Spreads;
use super::{Tracer, Work, at_level};
use crate::backend::Frame;
use crate::film::NOTHING;
use crate::kernel::mesh::Visits;
use crate::lanes::{Bits, D, D3, F, M, U, load_wide3, narrow3, splat_wide};
use crate::numeric::{END_ERROR, ORDINARY};
use crate::query::{HitSlice, RaySlice};
use crate::snapshot::{Instance, Row};
use crate::{Place, Size, Snapshot, Stats, View};

/// What is asked about some rays.
pub(super) struct Asked<'a> {
    rays: RaySlice<'a>,
    /// Whether anything they meet will do.
    pub(super) any: bool,
    pub(super) snapshot: &'a Snapshot,
}

impl Asked<'_> {
    /// How many rays there are.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.rays.len()
    }

    /// A ray in the snapshot's frame, the stretch it is asked about, and the place it leaves from.
    #[inline]
    pub(super) fn way(&self, at: usize) -> (Ray, Span, Option<Place>) {
        (self.ray(at), self.span(at), self.rays.leaving(at))
    }

    /// A ray, in the snapshot's frame.
    #[inline]
    pub(super) fn ray(&self, at: usize) -> Ray {
        self.snapshot.own_ray(&self.rays.ray(at))
    }

    /// The stretch it is asked about.
    #[inline]
    pub(super) fn span(&self, at: usize) -> Span {
        self.rays.span(at).unwrap_or(Span { min: 0.0, max: 0.0 })
    }

    /// Origins and directions from ray `at` on.
    #[inline(always)]
    pub(super) fn precise<S: Simd>(&self, s: S, at: usize) -> (D3<S>, D3<S>) {
        let (rays, lane) = self.rays.block(at);
        let [x, y, z] = &rays.origin;
        let origin = load_wide3(s, &[&x[..], &y[..], &z[..]], lane);
        let [x, y, z] = &rays.direction;
        let direction = load_wide3(s, &[&x[..], &y[..], &z[..]], lane);
        (origin - splat_wide(s, self.snapshot.origin()), direction)
    }

    /// As [`precise`](Self::precise), in a mesh's own space.
    #[inline(always)]
    pub(super) fn own_lines<S: Simd>(&self, s: S, at: usize, instance: &Instance) -> (D3<S>, D3<S>) {
        let (origin, direction) = self.precise(s, at);
        (instance.own_points(s, origin), instance.own_vectors(s, direction))
    }

    /// Where the stretches of the packet at ray `at` begin and end; not finite for those without an end.
    #[inline(always)]
    pub(super) fn ends<S: Simd>(&self, s: S, at: usize) -> [D3<S>; 2] {
        let (origin, direction) = self.precise(s, at);
        let (rays, lane) = self.rays.block(at);
        let min = D::load(s, &rays.min[lane..]).max(D::splat(s, 0.0));
        let max = D::load(s, &rays.max[lane..]);
        [direction.scale_add(min, origin), direction.scale_add(max, origin)]
    }

    /// Metres between which the stretches begin.
    #[inline(always)]
    pub(super) fn begins<S: Simd>(&self, s: S, at: usize) -> [F<S>; 2] {
        let (rays, lane) = self.rays.block(at);
        let min = self.in_metres(s, &rays.min[lane..], at).max(F::splat(s, 0.0));
        let error = min * F::splat(s, END_ERROR);
        [min - error, min + error]
    }

    /// Metres at which the stretches end, within [`END_ERROR`] of themselves.
    #[inline(always)]
    fn ends_in_metres<S: Simd>(&self, s: S, at: usize) -> F<S> {
        let (rays, lane) = self.rays.block(at);
        self.in_metres(s, &rays.max[lane..], at)
    }

    /// Lengths of the directions in metres, within [`END_ERROR`] of themselves.
    #[inline(always)]
    fn in_metres<S: Simd>(&self, s: S, lengths: &[f64], at: usize) -> F<S> {
        let (_, direction) = self.precise(s, at);
        let (_, inverse_length) = kernel_rays(s, narrow3(direction), narrow3(direction));
        D::load(s, lengths).narrow() / inverse_length
    }

    /// Depths between which the stretches begin, and those at which they end and how far these may be off; for rays of so
    /// much depth per `t`.
    #[inline(always)]
    pub(super) fn depths<S: Simd>(&self, s: S, at: usize, scale: F<S>) -> [[F<S>; 2]; 2] {
        let (rays, lane) = self.rays.block(at);
        let (error, most) = (F::splat(s, END_ERROR), F::splat(s, f32::MAX));
        let begin = D::load(s, &rays.min[lane..]).narrow().max(F::splat(s, 0.0)) * scale;
        let end = (D::load(s, &rays.max[lane..]).narrow() * scale).min(most);
        let near = end.less(F::splat(s, f32::MAX / 4.0));
        let off = begin * error;
        [[begin - off, begin + off], [F::pick(near, end, most), F::pick(near, end * error, F::splat(s, 0.0))]]
    }

    /// Where the rays of the packet at ray `at` leave from.
    #[inline(always)]
    pub(super) fn left<S: Simd>(&self, s: S, at: usize) -> Left<S> {
        let (from, rays) = (self.rays.first + at, self.rays.rays);
        if rays.prim.is_empty() {
            return Left::nothing(s);
        }
        Left { prim: U::load(s, &rays.prim[from..]), facet: U::load(s, &rays.facet[from..]), any: true }
    }

    /// Rays of the packet at ray `at` that kernels may follow; the others are answered one by one.
    #[inline(always)]
    pub(super) fn live<S: Simd>(&self, s: S, at: usize) -> M<S> {
        let (origin, direction) = self.precise(s, at);
        let count = (self.rays.len() - at).min(F::<S>::LANES);
        let there = M::from_bits(s, u64::MAX >> (64 - count));
        there & self.in_order(s, at) & self.is_exact(s, at) & is_ordinary(s, origin, direction)
    }

    /// The packet that starts with ray `at`.
    #[inline(always)]
    fn packet<S: Simd>(&self, s: S, at: usize) -> Packet<'_, S> {
        let (origin, direction) = self.precise(s, at);
        let (rays, inverse_length) = kernel_rays(s, narrow3(origin), narrow3(direction));
        Packet {
            precise: Precise::Asked(self, at),
            rays: rays.drifting(F::splat(s, drift(self.snapshot.origin_in_frame()))),
            inverse_length,
            left: self.left(s, at),
            live: self.live(s, at),
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

/// Answers with the best of the instructions there are.
pub(super) fn answer(snapshot: &Snapshot, rays: RaySlice<'_>, answers: Answers<'_, '_>) -> Stats {
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
        let view = View::new(Camera::default(), Size::new(1, 1));
        let (mut next, mut found, mut visits) = (Queue::default(), Found::default(), Visits::default());
        let mut tracer = Tracer {
            s,
            frame: &Frame::without_eye(snapshot, &view),
            stats: Stats::default(),
            next: &mut next,
            bounce: None,
            found: &mut found,
            between: &mut [],
            reached: &mut Vec::new(),
            dark: &mut Vec::new(),
            visits: &mut visits,
            chunk: &mut Chunk::new(s),
            spreads: &mut Spreads::nothing(s),
            outside: false,
        };
        let asked = Asked { rays, any: matches!(answers, Answers::Occluded(_)), snapshot };
        match tracer.only_mesh() {
            Some(mesh) => tracer.answer_of_mesh(&asked, mesh, &mut answers),
            None => tracer.answer(&asked, &mut answers),
        }
        tracer.stats
    }
}

/// Where answers go.
pub(super) enum Answers<'a, 'b> {
    /// What is met first.
    Nearest(&'a mut HitSlice<'b>),
    /// Whether anything is met.
    Occluded(&'a mut [bool]),
}

impl Answers<'_, '_> {
    fn set(&mut self, at: usize, hit: Option<(Place, f64)>) {
        match self {
            Self::Nearest(hits) => hits.set(at, hit),
            Self::Occluded(occluded) => occluded[at] = hit.is_some(),
        }
    }
}

impl<S: Simd> Tracer<'_, S> {
    #[inline(always)]
    fn answer(&mut self, asked: &Asked<'_>, answers: &mut Answers<'_, '_>) {
        let mut shapes = Shapes::default();
        shapes.all(self.frame.snapshot.columns());
        for at in (0..asked.rays.len()).step_by(F::<S>::LANES) {
            let packet = asked.packet(self.s, at);
            let far = asked.ends_in_metres(self.s, at).min(F::splat(self.s, f32::MAX));
            let finite = far.less(F::splat(self.s, f32::MAX));
            let none = F::splat(self.s, 0.0);
            let error = F::pick(finite, far * F::splat(self.s, END_ERROR), none);
            let mut best = Best::nothing_until(self.s, far, error);
            self.look(&packet, &mut best, &shapes);
            self.store(asked, (&packet, &best), at, answers);
        }
    }

    /// Keeps what a packet has found.
    #[inline(always)]
    fn store(
        &mut self,
        asked: &Asked<'_>,
        (packet, best): (&Packet<'_, S>, &Best<S>),
        at: usize,
        answers: &mut Answers<'_, '_>,
    ) {
        let lanes = (asked.rays.len() - at).min(F::<S>::LANES);
        match answers {
            Answers::Nearest(hits) => {
                best.prim.store(&mut hits.prim[at..]);
                best.facet.store(&mut hits.facet[at..]);
                self.settled_hits(packet, best).store(&mut hits.t[at..]);
            }
            Answers::Occluded(occluded) => {
                for (lane, occluded) in occluded[at..at + lanes].iter_mut().enumerate() {
                    *occluded = best.prim.lane(lane) != NOTHING;
                }
            }
        }
        self.answer_odd(asked, at, packet.live, answers);
    }

    /// Answers about the rays of the packet at ray `at` that kernels may not follow.
    #[inline(always)]
    pub(super) fn answer_odd(
        &mut self,
        asked: &Asked<'_>,
        at: usize,
        live: M<S>,
        answers: &mut Answers<'_, '_>,
    ) {
        let lanes = (asked.rays.len() - at).min(F::<S>::LANES);
        let odd = !live.bits() & (u64::MAX >> (64 - lanes));
        for lane in Bits(odd) {
            answers.set(at + lane, self.plainly(asked, at + lane));
        }
    }

    /// The `t` of what lanes have found, from `f64`.
    #[inline(always)]
    fn settled_hits(&mut self, packet: &Packet<'_, S>, best: &Best<S>) -> D<S> {
        let snapshot = self.frame.snapshot;
        let mut all = (best.t * packet.inverse_length).widen();
        let mut left = (best.hits() & packet.live).bits();
        while left != 0 {
            let prim = best.prim.lane(left.trailing_zeros() as usize);
            let lanes = M::from_bits(self.s, left) & best.prim.is(prim);
            left &= !lanes.bits();
            if let Row::Instance(row) = snapshot.columns().rows[prim as usize] {
                let instance = &snapshot.columns().instances[row as usize];
                let triangles = instance.facets(self.s, best.facet, lanes);
                let lines = self.own_lines(packet, instance);
                let of_lane = |lane: usize| packet.way(lane);
                let t = self.settled_t(prim, lines, lanes, &triangles, of_lane);
                all = D::pick(lanes, t, all);
                continue;
            }
            for lane in lanes.lanes() {
                let (ray, span, leaving) = (packet.ray(lane), packet.span(lane), packet.leaving(lane));
                let facet = Some(best.facet.lane(lane));
                // What `f32` was certain of stands, though `f64` may see its `t` at the very end of the stretch.
                if let Some(hit) = snapshot.cross_part(prim, facet, &ray, span, leaving) {
                    all.set(lane, hit.crossing.t);
                }
            }
        }
        all
    }

    /// What a ray meets that `f32` cannot hold.
    #[cold]
    fn plainly(&self, asked: &Asked<'_>, at: usize) -> Option<(Place, f64)> {
        let hit = asked.rays.follow(self.frame.snapshot, at, |way| self.frame.snapshot.nearest_on(way))?;
        Some((hit.place, hit.crossing.t))
    }
}
