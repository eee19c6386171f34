//! Closest hits of a packet on a mesh: as a bundle where the rays have a common origin, else ray by ray.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask, Ray, Span};
use fearless_simd::Simd;

use super::Searcher;
use super::exact_resolver::ClosestOfPackets;
use super::hits::Hits;
use super::packet::{Packet, PreciseRays, drift};
use crate::SurfaceId;
use crate::accel::WIDTH;
use crate::kernel::mesh::{
    BundledRays, ClosestHit, LaneTriangles, Lines, RayBundle, RaySetup, Reach, StartingRays, TreeWalk,
};
use crate::lanes::{Bits, D, D3, F, M, U, outlined, splat_wide};
use crate::numeric::{BOUNDS_ERROR, END_ERROR, POINT_ERROR};
use crate::snapshot::{Affine, Instance};

/// No triangle.
pub(crate) const NONE: u32 = u32::MAX;

impl<S: Simd> Searcher<'_, S> {
    /// Finds the nearest triangle of a mesh. See [`outlined`].
    pub(crate) fn walk_mesh<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        instance: &Instance,
    ) {
        outlined(
            self.s,
            #[inline(always)]
            || self.walk_mesh_here(packet, best, instance),
        );
    }

    #[inline(always)]
    fn walk_mesh_here<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        instance: &Instance,
    ) {
        let mut rays = [BundledRays::nothing(self.s)];
        let (alone, alone_best) = (std::slice::from_ref(packet), std::slice::from_mut(&mut *best));
        if self.walk_as_bundle(alone, 1, alone_best, instance, &mut rays) {
            return;
        }
        let snapshot = self.snapshot;
        let Some(mesh) = snapshot.mesh_at(instance.prim) else { return };
        let before = *best;
        let (packets, before) = (std::slice::from_ref(packet), std::slice::from_ref(&before));
        let mut exact = ClosestOfPackets { snapshot, mesh, prim: instance.prim, packets, before };
        let lines = self.own_lines(packet, instance, packet.live);
        let slots = self.search_each(packet, &lines, best, instance, &mut exact);
        self.count_visits();
        self.take(packet, best, instance, slots);
    }

    /// Finds the nearest triangle for some packets, told by bits, if their rays have a common origin; returns whether they do.
    #[inline(always)]
    pub(super) fn walk_as_bundle<P: PreciseRays<S>>(
        &mut self,
        packets: &[Packet<'_, S, P>],
        which: u32,
        best: &mut [Hits<S>],
        instance: &Instance,
        room: &mut [BundledRays<S>],
    ) -> bool {
        let snapshot = self.snapshot;
        let Some(mesh) = snapshot.mesh_at(instance.prim) else { return true };
        let rays = &mut room[..packets.len()];
        let bundle = RayBundle::of(
            self.s,
            rays,
            #[inline(always)]
            |number| {
                let packet = &packets[number];
                let live = if which >> number & 1 == 1 { packet.live } else { M::splat(self.s, false) };
                self.own_lines(packet, instance, live)
            },
            self.reach(instance),
        );
        let Some(bundle) = bundle else { return false };
        for ((rays, packet), best) in rays.iter_mut().zip(packets).zip(&*best) {
            // From metres to depth.
            let scale = rays.scale * packet.inverse_length;
            let (begin, end) = (self.begin(packet, scale), self.end(best, scale));
            rays.start(self.s, begin, end, packet.leaving.facets_of(self.s, instance.prim));
        }
        let mut exact = ClosestOfPackets { snapshot, mesh, prim: instance.prim, packets, before: &*best };
        bundle.common_origin.search(self.s, instance.tree.to_walk(), self.visits, rays, &mut exact);
        self.count_visits();
        for ((rays, packet), best) in rays.iter().zip(packets).zip(best) {
            self.stats.settled += rays.decided;
            self.take(packet, best, instance, rays.slot);
        }
        true
    }

    /// Depths between which the spans of a packet begin.
    #[inline(always)]
    fn begin<P: PreciseRays<S>>(&self, packet: &Packet<'_, S, P>, scale: F<S>) -> [F<S>; 2] {
        if P::FROM_ORIGIN {
            return [F::splat(self.s, 0.0); 2];
        }
        let [low, high] = packet.begins(self.s);
        [low * scale, high * scale * F::splat(self.s, 1.0 + END_ERROR)]
    }

    /// Depths up to which triangles are searched, and bounds on their errors.
    #[inline(always)]
    fn end(&self, best: &Hits<S>, scale: F<S>) -> [F<S>; 2] {
        let most = F::splat(self.s, f32::MAX);
        let end = (best.t * scale).min(most);
        let error = best.error.mul_add(scale, end * F::splat(self.s, END_ERROR));
        let near = end.less(F::splat(self.s, f32::MAX / 4.0));
        [F::pick(near, end, most), F::pick(near, error, F::splat(self.s, 0.0))]
    }

    /// Slots of the nearest triangles in the tree's blocks, one lane after another.
    #[inline(always)]
    fn search_each<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        lines: &Lines<S>,
        best: &Hits<S>,
        instance: &Instance,
        exact: &mut ClosestOfPackets<'_, '_, S, P>,
    ) -> U<S> {
        let leaving = packet.leaving.facets_of(self.s, instance.prim);
        self.ray_setup(lines, instance).search(
            self.s,
            TreeWalk { tree: instance.tree.to_walk(), visits: self.visits },
            StartingRays { lanes: lines.live, leaving },
            #[inline(always)]
            |lane| {
                let found = ClosestHit::nothing_on(packet.span(lane));
                if best.prim.lane(lane) == NONE {
                    return found;
                }
                let (metres, length) = (best.t.lane(lane), packet.inverse_length.lane(lane));
                let error = best.error.lane(lane) + metres * END_ERROR;
                found.before(metres * length, error * length)
            },
            exact,
        )
    }

    /// Lines in a mesh's own space as single rays.
    #[inline(always)]
    pub(crate) fn ray_setup(&self, lines: &Lines<S>, instance: &Instance) -> RaySetup {
        let reach = self.reach(instance);
        RaySetup::of(self.s, lines, F::splat(self.s, reach.off), reach.mesh)
    }

    /// Takes over triangles that are nearer for certain. Their `t` are functions of ray and triangle alone, however those
    /// were found, so that bits do not depend on which rays were traced together.
    #[inline(always)]
    fn take<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &mut Hits<S>,
        instance: &Instance,
        slots: U<S>,
    ) {
        let taken = packet.live & !slots.is(NONE);
        if !taken.any() {
            return;
        }
        let triangles = instance.triangles(self.s, slots, taken);
        let facet = triangles.facet;
        let lines = self.own_lines(packet, instance, taken);
        let of_lane = |lane: usize| packet.segment(lane);
        let t = self.refined_t(instance.prim, &lines, &triangles, of_lane).narrow();
        let metres = (t / packet.inverse_length).min(F::splat(self.s, f32::MAX.next_down()));
        best.t = F::pick(taken, metres, best.t);
        best.error = F::pick(taken, metres * F::splat(self.s, END_ERROR), best.error);
        best.prim = U::pick(taken, U::splat(self.s, instance.prim), best.prim);
        best.facet = U::pick(taken, facet, best.facet);
    }

    /// The `t` at which live lines meet triangles of a mesh that they are known to meet.
    #[inline(always)]
    pub(crate) fn refined_t(
        &self,
        prim: u32,
        lines: &Lines<S>,
        triangles: &LaneTriangles<S>,
        segment: impl Fn(usize) -> (Ray, Span, Option<SurfaceId>),
    ) -> D<S> {
        let (mut t, sure) = triangles.depths(self.s, lines.origin, lines.direction);
        for lane in Bits((lines.live & !sure).bits()) {
            let (ray, span, leaving) = segment(lane);
            let facet = Some(triangles.facet.lane(lane));
            if let Some(hit) = self.snapshot.cross_part(prim, facet, &ray, span, leaving) {
                t.set(lane, hit.crossing.t);
            }
        }
        t
    }

    /// The rays of some lanes of a packet in the mesh's own space.
    #[inline(always)]
    pub(crate) fn own_lines<P: PreciseRays<S>>(
        &self,
        packet: &Packet<'_, S, P>,
        instance: &Instance,
        lanes: M<S>,
    ) -> Lines<S> {
        let (origin, direction) = packet.precise(self.s);
        Lines {
            origin: instance.own_points(self.s, origin),
            direction: instance.own_vectors(self.s, direction),
            live: lanes,
        }
    }

    /// How far origins may be off in a mesh's own space, and the mesh's largest coordinate. Origins are relative to the
    /// snapshot's, and those on a mesh that is far from it are rounded as coarsely as the mesh's own position.
    pub(crate) fn reach(&self, instance: &Instance) -> Reach {
        let drifting = drift(self.snapshot.origin_in_frame()) * POINT_ERROR * instance.scale();
        let shift = instance.to_object.as_ref().map_or(0.0, |affine| affine.shift.abs().element_sum());
        Reach { off: drifting + (shift * BOUNDS_ERROR) as f32, mesh: instance.tree.reach }
    }

    /// Adds up the nodes and triangles that have been visited.
    #[inline(always)]
    pub(crate) fn count_visits(&mut self) {
        let eight = WIDTH as u64;
        self.stats.tests.boxes += std::mem::take(&mut self.visits.nodes) * eight;
        self.stats.tests.shapes += std::mem::take(&mut self.visits.blocks) * eight;
    }
}

/// Where segments begin and end that run one length of their directions, as depths, and within which bounds.
#[inline(always)]
pub(crate) fn ends_of_segments<S: Simd>(s: S, scale: F<S>, slack: f32) -> [[F<S>; 2]; 2] {
    let off = F::splat(s, slack * 2.0 + f32::MIN_POSITIVE);
    let error = scale.mul_add(F::splat(s, END_ERROR), off);
    [[F::splat(s, 0.0) - off, off], [scale, error]]
}

impl Instance {
    /// Points of the world in the mesh's own space.
    #[inline(always)]
    pub(crate) fn own_points<S: Simd>(&self, s: S, points: D3<S>) -> D3<S> {
        match &self.to_object {
            Some(affine) => affine.turn(s, points) + splat_wide(s, affine.shift),
            None => points,
        }
    }

    /// Directions of the world in the mesh's own space.
    #[inline(always)]
    pub(crate) fn own_vectors<S: Simd>(&self, s: S, vectors: D3<S>) -> D3<S> {
        match &self.to_object {
            Some(affine) => affine.turn(s, vectors),
            None => vectors,
        }
    }

    /// Unit vectors of the mesh's own space in the world.
    #[inline(always)]
    pub(crate) fn world_normals<S: Simd>(&self, s: S, normals: D3<S>) -> D3<S> {
        match &self.to_object {
            Some(affine) => affine.turn_back(s, normals),
            None => normals,
        }
    }

    /// Metres of the mesh's own space a metre of the world.
    pub(crate) fn scale(&self) -> f32 {
        self.to_object.as_ref().map_or(1.0, |affine| affine.matrix[0].length() as f32)
    }

    /// The triangles of the mesh that lanes name.
    #[inline(always)]
    pub(crate) fn facets<S: Simd>(&self, s: S, facets: U<S>, lanes: M<S>) -> LaneTriangles<S> {
        self.at_corners(s, facets, lanes, self.tree.mesh().positions())
    }

    /// The same with another attribute of corners instead of their positions, such as normals.
    #[inline(always)]
    pub(crate) fn at_corners<S: Simd>(
        &self,
        s: S,
        facets: U<S>,
        lanes: M<S>,
        of: &[[f32; 3]],
    ) -> LaneTriangles<S> {
        let triangles = self.tree.mesh().triangles();
        let mut all = LaneTriangles::nothing(s);
        for (facet, same) in facets.groups(lanes) {
            all.set(s, same, facet, &triangles[facet as usize].map(|corner| of[corner as usize]));
        }
        all
    }

    /// The triangles at slots of the tree's blocks.
    #[inline(always)]
    pub(crate) fn triangles<S: Simd>(&self, s: S, slots: U<S>, lanes: M<S>) -> LaneTriangles<S> {
        let mut all = LaneTriangles::nothing(s);
        for (slot, same) in slots.groups(lanes) {
            let block = &self.tree.tree.blocks[slot as usize / WIDTH];
            all.set(s, same, block.facet[slot as usize % WIDTH], &block.triangle(slot as usize));
        }
        all
    }
}

impl Affine {
    #[inline(always)]
    fn turn<S: Simd>(&self, s: S, v: D3<S>) -> D3<S> {
        let [x, y, z] = self.matrix;
        D3::new(splat_wide(s, x).dot(v), splat_wide(s, y).dot(v), splat_wide(s, z).dot(v))
    }

    /// The inverse rotation; lengths stay as they are.
    #[inline(always)]
    fn turn_back<S: Simd>(&self, s: S, v: D3<S>) -> D3<S> {
        let [x, y, z] = self.matrix.map(DVec3::normalize).map(|row| splat_wide(s, row));
        x.scale_add(v.x, y.scale_add(v.y, z.scale(v.z)))
    }
}
