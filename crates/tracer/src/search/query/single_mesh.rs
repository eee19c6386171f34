//! Ray queries on a scene that is a single mesh: groups of packets walk its tree together, and nothing is computed that
//! only other shapes need.

use catoptra_core::geometry::Mesh;
use catoptra_core::{Geometry, LaneMask, Ray, Span};
use fearless_simd::Simd;
use smallvec::SmallVec;

use super::{Answers, RayQuery};
use crate::Snapshot;
use crate::film::NOTHING;
use crate::kernel::mesh::{
    AnyBundle, Bundle, BundledRays, ClosestHit, ExactResolver, GROUP, Lines, RayBundle, StartingRays, Starts,
    TreeWalk,
};
use crate::lanes::{D, F, M, U, outlined, splat_wide, vector_of};
use crate::search::Searcher;
use crate::search::mesh::{NONE, ends_of_segments};
use crate::snapshot::{Instance, Row, leaving_facet};

/// Rays of a caller, and the only mesh of the scene.
#[derive(Clone, Copy)]
struct MeshQuery<'a> {
    query: &'a RayQuery<'a>,
    instance: &'a Instance,
    mesh: &'a Mesh,
    /// Whether any hit will do (occlusion) rather than the nearest.
    any: bool,
}

/// Consecutive packets of a query.
#[derive(Clone, Copy)]
struct Group<S: Simd> {
    /// The first ray.
    at: usize,
    packets: usize,
    /// Rays that kernels may follow.
    live: [M<S>; GROUP],
}

/// Memory that is used for one group after another.
struct GroupRoom<S: Simd> {
    rays: [BundledRays<S>; GROUP],
    /// Whether the last bundle of segments had its common origin at their ends.
    backwards: bool,
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

/// The instance, if the scene is a single mesh.
pub(super) fn single_mesh(snapshot: &Snapshot) -> Option<&Instance> {
    let columns = snapshot.columns();
    let [Row::Instance(row)] = columns.rows[..] else { return None };
    Some(&columns.instances[row as usize])
}

impl<S: Simd> Searcher<'_, S> {
    /// Answers a query on a scene that is a single mesh.
    pub(super) fn answer_of_mesh(
        &mut self,
        query: &RayQuery<'_>,
        instance: &Instance,
        answers: &mut Answers<'_, '_>,
    ) {
        let Some(mesh) = self.snapshot.mesh_at(instance.prim) else { return };
        let of = &MeshQuery { query, instance, mesh, any: matches!(answers, Answers::Occluded(_)) };
        let mut room = GroupRoom { rays: [BundledRays::nothing(self.s); GROUP], backwards: false };
        for at in (0..query.len()).step_by(GROUP * F::<S>::LANES) {
            let packets = (query.len() - at).div_ceil(F::<S>::LANES).min(GROUP);
            let mut group = Group { at, packets, live: [M::splat(self.s, false); GROUP] };
            for packet in 0..packets {
                group.live[packet] = query.live(self.s, at + packet * F::<S>::LANES);
            }
            outlined(
                self.s,
                #[inline(always)]
                || self.answer_group(of, &group, answers, &mut room),
            );
        }
    }

    #[inline(always)]
    fn answer_group(
        &mut self,
        of: &MeshQuery<'_>,
        group: &Group<S>,
        answers: &mut Answers<'_, '_>,
        room: &mut GroupRoom<S>,
    ) {
        let mut slots = [U::splat(self.s, NONE); GROUP];
        // A group without a common origin or direction is halved; after one with, the next try is twice as large.
        let (mut first, mut size) = (0, group.packets);
        while first < group.packets {
            let part = group.part(self.s, first, size.min(group.packets - first));
            if self.find_together(of, &part, &mut slots[first..], room) {
                (first, size) = (first + part.packets, 2 * part.packets);
            } else if part.packets == 1 {
                slots[first] = self.find_each(of, &part);
                first += 1;
            } else {
                size = part.packets.div_ceil(2);
            }
        }
        for (packet, slots) in slots.into_iter().enumerate().take(group.packets) {
            let part = group.part(self.s, packet, 1);
            self.store_packet(of, &part, slots, answers);
        }
    }

    /// Finds triangles for all rays of a group at once, if they have a common origin or are to be tested for occlusion in one
    /// direction; returns whether they are.
    #[inline(always)]
    fn find_together(
        &mut self,
        of: &MeshQuery<'_>,
        group: &Group<S>,
        slots: &mut [U<S>],
        room: &mut GroupRoom<S>,
    ) -> bool {
        let GroupRoom { rays, backwards } = room;
        let rays = &mut rays[..group.packets];
        let bundle = if of.any {
            // The direction in which the last group had a common origin is tried first.
            let bundle = self.bundle_of_segments(of, group, rays, *backwards);
            bundle.or_else(|| {
                let bundle = self.bundle_of_segments(of, group, rays, !*backwards);
                *backwards ^= bundle.is_some();
                bundle
            })
        } else {
            self.bundle_of_rays(of, group, rays)
        };
        let Some(bundle) = bundle else {
            let along = of.any.then(|| self.bundle_along(of, group, rays)).flatten();
            return along.inspect(|along| self.search_bundle(of, group, along, rays, slots)).is_some();
        };
        for (packet, rays) in rays.iter_mut().enumerate() {
            let at = group.start(packet);
            let [begin, end] = if of.any {
                ends_of_segments(self.s, rays.scale, bundle.slack)
            } else {
                of.query.depths(self.s, at, rays.scale)
            };
            rays.start(self.s, begin, end, of.query.leaving(self.s, at).facets_of(self.s, of.instance.prim));
        }
        let common_origin = if of.any { bundle.common_origin.for_any() } else { bundle.common_origin };
        self.search_bundle(of, group, &AnyBundle::Through(common_origin), rays, slots);
        true
    }

    /// Finds triangles for the rays of a bundle.
    #[inline(always)]
    fn search_bundle(
        &mut self,
        of: &MeshQuery<'_>,
        group: &Group<S>,
        bundle: &AnyBundle,
        rays: &mut [BundledRays<S>],
        slots: &mut [U<S>],
    ) {
        let mut exact = of.resolver(group.at);
        bundle.search(self.s, of.instance.tree.to_walk(), self.visits, rays, &mut exact);
        self.count_visits();
        for (slot, rays) in slots.iter_mut().zip(rays) {
            *slot = rays.slot;
            self.stats.settled += rays.decided;
        }
    }

    /// Rays in one direction, to the last bit.
    #[inline(always)]
    fn bundle_along(
        &self,
        of: &MeshQuery<'_>,
        group: &Group<S>,
        rays: &mut [BundledRays<S>],
    ) -> Option<AnyBundle> {
        let (s, mut direction) = (self.s, None);
        let reach = self.reach(of.instance);
        let mut all: SmallVec<[Starts<S>; GROUP]> = SmallVec::new();
        for packet in 0..group.packets {
            let (at, live) = (group.start(packet), group.live[packet % GROUP]);
            let lines = of.query.own_lines(s, at, of.instance, live);
            if direction.is_none() {
                direction = live.lanes().next().map(|lane| vector_of(&lines.direction, lane));
            }
            let apart = lines.direction - splat_wide(s, direction.unwrap_or_default());
            let apart = apart.x.abs().max(apart.y.abs()).max(apart.z.abs());
            let same = apart.at_most(D::splat(s, 0.0));
            if (live & !same).any() {
                return None;
            }
            let leaving = of.query.leaving(s, at).facets_of(s, of.instance.prim);
            all.push(Starts { origin: lines.origin, off: F::splat(s, reach.off), live, leaving });
        }
        let bundle = Bundle::along(
            s,
            rays,
            &all,
            direction?,
            reach.mesh,
            #[inline(always)]
            |packet, scale| of.query.depths(s, group.start(packet), scale),
        )?;
        Some(AnyBundle::Along(bundle.for_any()))
    }

    #[inline(always)]
    fn bundle_of_rays(
        &self,
        of: &MeshQuery<'_>,
        group: &Group<S>,
        rays: &mut [BundledRays<S>],
    ) -> Option<RayBundle> {
        RayBundle::of(
            self.s,
            rays,
            #[inline(always)]
            |packet| {
                let live = group.live[packet % GROUP];
                of.query.own_lines(self.s, group.start(packet), of.instance, live)
            },
            self.reach(of.instance),
        )
    }

    /// The spans of rays as lines from where they begin, or backwards from where they end.
    #[inline(always)]
    fn bundle_of_segments(
        &self,
        of: &MeshQuery<'_>,
        group: &Group<S>,
        rays: &mut [BundledRays<S>],
        backwards: bool,
    ) -> Option<RayBundle> {
        RayBundle::of(
            self.s,
            rays,
            #[inline(always)]
            |packet| {
                let [start, end] = of.query.span_ends(self.s, group.start(packet));
                let start = of.instance.own_points(self.s, start);
                let end = of.instance.own_points(self.s, end);
                let (origin, other) = if backwards { (end, start) } else { (start, end) };
                Lines { origin, direction: other - origin, live: group.live[packet % GROUP] }
            },
            self.reach(of.instance),
        )
    }

    /// Finds triangles for the rays of a packet, one after another.
    #[inline(always)]
    fn find_each(&mut self, of: &MeshQuery<'_>, packet: &Group<S>) -> U<S> {
        of.query.rays.prefetch(packet.start(GROUP));
        let leaving = of.query.leaving(self.s, packet.at).facets_of(self.s, of.instance.prim);
        let mut exact = of.resolver(packet.at);
        let lines = of.query.own_lines(self.s, packet.at, of.instance, packet.live[0]);
        let slots = self.ray_setup(&lines, of.instance).search(
            self.s,
            TreeWalk { tree: of.instance.tree.to_walk(), visits: self.visits },
            StartingRays { lanes: lines.live, leaving },
            #[inline(always)]
            |lane| ClosestHit::nothing_on(of.query.span_at(packet.at + lane)).for_any(of.any),
            &mut exact,
        );
        self.count_visits();
        slots
    }

    /// Stores the results of a packet.
    #[inline(always)]
    fn store_packet(
        &mut self,
        of: &MeshQuery<'_>,
        packet: &Group<S>,
        slots: U<S>,
        answers: &mut Answers<'_, '_>,
    ) {
        let (at, instance) = (packet.at, of.instance);
        let taken = packet.live[0] & !slots.is(NONE);
        match answers {
            Answers::Nearest(hits) => {
                let (prim, nothing) = (U::splat(self.s, instance.prim), U::splat(self.s, NOTHING));
                U::pick(taken, prim, nothing).store(&mut hits.prim[at..]);
                if taken.any() {
                    let triangles = instance.triangles(self.s, slots, taken);
                    let lines = of.query.own_lines(self.s, at, instance, taken);
                    let of_lane = |lane: usize| of.query.segment(at + lane);
                    let t = self.refined_t(instance.prim, &lines, &triangles, of_lane);
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
        self.answer_one_by_one(of.query, at, !packet.live[0], answers);
    }
}

impl<'a> MeshQuery<'a> {
    /// The exact resolver of a group of packets whose first ray is `at`.
    fn resolver(&self, at: usize) -> ClosestOfQuery<'a> {
        ClosestOfQuery { of: *self, at }
    }
}

/// Exact hits of a caller's rays on a single mesh.
struct ClosestOfQuery<'a> {
    of: MeshQuery<'a>,
    /// The ray of lane 0.
    at: usize,
}

impl ExactResolver for ClosestOfQuery<'_> {
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)> {
        let (ray, span, _) = self.of.query.segment(self.at + lane);
        Some((self.of.mesh.own_ray(&ray), span))
    }

    fn leaves(&self, left: u32, facet: u32) -> bool {
        self.of.mesh.triangles().lies_in_plane(left, facet)
    }

    #[cold]
    #[inline(never)]
    fn decide(&mut self, lane: usize, facet: u32, held: Option<u32>) -> Option<f64> {
        let (ray, span, leaving) = self.of.query.segment(self.at + lane);
        let (mesh, leaving) = (self.of.mesh, leaving_facet(self.of.instance.prim, leaving));
        let own = mesh.own_ray(&ray);
        match held {
            Some(held) => mesh.met_before([facet, held], &own, span, leaving),
            None => mesh.locate_piece(facet, &own, span, leaving).map(|(at, _)| at.t),
        }
    }
}
