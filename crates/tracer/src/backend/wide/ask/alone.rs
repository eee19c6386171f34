//! What rays of anyone's choice meet where one mesh is all there is: groups of packets walk its tree together, and nothing
//! is worked out that only other shapes need.

use catoptra_core::LaneMask;
use catoptra_core::geometry::Mesh;
use fearless_simd::Simd;

use super::{Answers, Asked};
use crate::backend::wide::Tracer;
use crate::backend::wide::mesh::{NONE, ends_of_ways};
use crate::backend::wide::umpire::Alone;
use crate::film::NOTHING;
use crate::kernel::mesh::{Bundle, FanRays, GROUP, Lines, LoneBest};
use crate::lanes::{F, M, U};
use crate::snapshot::{Instance, Row};

/// The mesh that is all there is.
#[derive(Clone, Copy)]
pub(super) struct Only<'a> {
    instance: &'a Instance,
    mesh: &'a Mesh,
}

/// Packets that stand side by side.
#[derive(Clone, Copy)]
struct Group<S: Simd> {
    /// The first ray.
    at: usize,
    packets: usize,
    /// Rays to be followed.
    live: [M<S>; GROUP],
}

impl<S: Simd> Group<S> {
    /// The first ray of one of the packets.
    #[inline(always)]
    fn start(&self, packet: usize) -> usize {
        self.at + packet * F::<S>::LANES
    }

    /// Some of the packets.
    #[inline(always)]
    fn part(&self, s: S, first: usize, packets: usize) -> Self {
        let mut live = [M::splat(s, false); GROUP];
        live[..packets].copy_from_slice(&self.live[first..first + packets]);
        Self { at: self.start(first), packets, live }
    }
}

impl<'a, S: Simd> Tracer<'a, S> {
    /// The mesh that is all there is, if so.
    pub(super) fn only_mesh(&self) -> Option<Only<'a>> {
        let snapshot = self.frame.snapshot;
        let [Row::Instance(row)] = snapshot.columns().rows[..] else { return None };
        let instance = &snapshot.columns().instances[row as usize];
        Some(Only { instance, mesh: snapshot.mesh_at(instance.prim)? })
    }

    /// Answers about rays where a mesh is all there is.
    pub(super) fn answer_of_mesh(
        &mut self,
        asked: &Asked<'_>,
        only: Only<'_>,
        answers: &mut Answers<'_, '_>,
    ) {
        let (mut rays, mut backwards) = ([FanRays::nothing(self.s); GROUP], false);
        for at in (0..asked.len()).step_by(GROUP * F::<S>::LANES) {
            let packets = (asked.len() - at).div_ceil(F::<S>::LANES).min(GROUP);
            let mut group = Group { at, packets, live: [M::splat(self.s, false); GROUP] };
            for packet in 0..packets {
                group.live[packet] = asked.live(self.s, at + packet * F::<S>::LANES);
            }
            self.s.vectorize(
                #[inline(always)]
                || self.answer_group(asked, only, &group, (answers, &mut rays, &mut backwards)),
            );
        }
    }

    #[inline(always)]
    fn answer_group(
        &mut self,
        asked: &Asked<'_>,
        only: Only<'_>,
        group: &Group<S>,
        (answers, rays, backwards): (&mut Answers<'_, '_>, &mut [FanRays<S>; GROUP], &mut bool),
    ) {
        let mut slots = [U::splat(self.s, NONE); GROUP];
        // What does not go together is halved; what does doubles what is tried next.
        let (mut first, mut size) = (0, group.packets);
        while first < group.packets {
            let part = group.part(self.s, first, size.min(group.packets - first));
            if self.find_together(asked, only, &part, (&mut slots[first..], rays, backwards)) {
                (first, size) = (first + part.packets, 2 * part.packets);
            } else if part.packets == 1 {
                slots[first] = self.find_each(asked, only, &part);
                first += 1;
            } else {
                size = part.packets.div_ceil(2);
            }
        }
        for (packet, slots) in slots.into_iter().enumerate().take(group.packets) {
            let part = group.part(self.s, packet, 1);
            self.store_packet(asked, only, (&part, slots), answers);
        }
    }

    /// Finds triangles for all rays of a group at once, if they go through one point; whether they do.
    #[inline(always)]
    fn find_together(
        &mut self,
        asked: &Asked<'_>,
        only: Only<'_>,
        group: &Group<S>,
        (slots, rays, backwards): (&mut [U<S>], &mut [FanRays<S>; GROUP], &mut bool),
    ) -> bool {
        let rays = &mut rays[..group.packets];
        let bundle = if asked.any {
            // The way that went well last is tried first.
            let bundle = self.bundle_of_ways(asked, only, group, (rays, *backwards));
            bundle.or_else(|| {
                let bundle = self.bundle_of_ways(asked, only, group, (rays, !*backwards));
                *backwards ^= bundle.is_some();
                bundle
            })
        } else {
            self.bundle_of_rays(asked, only, group, rays)
        };
        let Some(bundle) = bundle else { return false };
        for (packet, rays) in rays.iter_mut().enumerate() {
            let at = group.start(packet);
            let [begin, end] = if asked.any {
                ends_of_ways(self.s, rays.scale, bundle.slack)
            } else {
                asked.depths(self.s, at, rays.scale)
            };
            rays.start(self.s, begin, end, asked.left(self.s, at).facets_of(self.s, only.instance.prim));
        }
        let mut umpire = self.umpire(asked, only, group);
        let fan = if asked.any { bundle.fan.for_any() } else { bundle.fan };
        let mut visits = std::mem::take(self.visits);
        fan.search(self.s, &only.instance.tree.tree, &mut visits, rays, &mut umpire);
        self.count(&mut visits);
        *self.visits = visits;
        for (slot, rays) in slots.iter_mut().zip(rays) {
            *slot = rays.slot;
            self.stats.settled += rays.settled;
        }
        true
    }

    #[inline(always)]
    fn bundle_of_rays(
        &self,
        asked: &Asked<'_>,
        only: Only<'_>,
        group: &Group<S>,
        rays: &mut [FanRays<S>],
    ) -> Option<Bundle> {
        Bundle::of(
            self.s,
            rays,
            #[inline(always)]
            |packet| {
                let (origin, direction) = asked.own_lines(self.s, group.start(packet), only.instance);
                Lines { origin, direction, live: group.live[packet % GROUP] }
            },
            self.reach(only.instance),
        )
    }

    /// The stretches of rays as lines from where they begin, or backwards from where they end.
    #[inline(always)]
    fn bundle_of_ways(
        &self,
        asked: &Asked<'_>,
        only: Only<'_>,
        group: &Group<S>,
        (rays, backwards): (&mut [FanRays<S>], bool),
    ) -> Option<Bundle> {
        Bundle::of(
            self.s,
            rays,
            #[inline(always)]
            |packet| {
                let [start, end] = asked.ends(self.s, group.start(packet));
                let start = only.instance.own_points(self.s, start);
                let end = only.instance.own_points(self.s, end);
                let (origin, other) = if backwards { (end, start) } else { (start, end) };
                Lines { origin, direction: other - origin, live: group.live[packet % GROUP] }
            },
            self.reach(only.instance),
        )
    }

    /// Finds triangles for the rays of a packet, one after another.
    #[inline(always)]
    fn find_each(&mut self, asked: &Asked<'_>, only: Only<'_>, packet: &Group<S>) -> U<S> {
        asked.rays.prefetch(packet.start(GROUP));
        let left = asked.left(self.s, packet.at).facets_of(self.s, only.instance.prim);
        let mut umpire = self.umpire(asked, only, packet);
        let mut visits = std::mem::take(self.visits);
        let (origin, direction) = asked.own_lines(self.s, packet.at, only.instance);
        let lines = Lines { origin, direction, live: packet.live[0] };
        let slots = self.lones(&lines, only.instance).search(
            self.s,
            (&only.instance.tree.tree, &mut visits),
            (lines.live, left),
            #[inline(always)]
            |lane| LoneBest::nothing_on(asked.span(packet.at + lane)).for_any(asked.any),
            &mut umpire,
        );
        self.count(&mut visits);
        *self.visits = visits;
        slots
    }

    #[inline(always)]
    fn umpire<'b>(&self, asked: &'b Asked<'b>, only: Only<'b>, group: &Group<S>) -> Alone<'b> {
        Alone { snapshot: asked.snapshot, mesh: only.mesh, prim: only.instance.prim, asked, at: group.at }
    }

    /// Keeps what a packet has found.
    #[inline(always)]
    fn store_packet(
        &mut self,
        asked: &Asked<'_>,
        only: Only<'_>,
        (packet, slots): (&Group<S>, U<S>),
        answers: &mut Answers<'_, '_>,
    ) {
        let (at, instance) = (packet.at, only.instance);
        let taken = packet.live[0] & !slots.is(NONE);
        match answers {
            Answers::Nearest(hits) => {
                let (prim, nothing) = (U::splat(self.s, instance.prim), U::splat(self.s, NOTHING));
                U::pick(taken, prim, nothing).store(&mut hits.prim[at..]);
                if taken.any() {
                    let triangles = instance.triangles(self.s, slots, taken);
                    let lines = asked.own_lines(self.s, at, instance);
                    let of_lane = |lane: usize| asked.way(at + lane);
                    let t = self.settled_t(instance.prim, lines, taken, &triangles, of_lane);
                    triangles.facet.store(&mut hits.facet[at..]);
                    t.store(&mut hits.t[at..]);
                }
            }
            Answers::Occluded(occluded) => {
                let bits = taken.bits();
                for (lane, occluded) in occluded[at..].iter_mut().enumerate().take(F::<S>::LANES) {
                    *occluded = bits >> lane & 1 == 1;
                }
            }
        }
        self.answer_odd(asked, at, packet.live[0], answers);
    }
}
