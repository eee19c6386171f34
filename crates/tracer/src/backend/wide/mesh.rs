//! How a packet finds the triangles of a mesh: all lanes together where they go through one point, else lane by lane.

use catoptra_core::geometry::Mesh;
use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::Simd;

use super::Tracer;
use super::ask::Asked;
use super::packet::{Packet, Precise, drift};
use super::search::Best;
use super::shadow::Ways;
use super::umpire::{Blocked, Nearest};
use crate::kernel::mesh::{FanRays, LaneCorners, Lines, Lone, LoneBest, Umpire, Visits};
use crate::lanes::{Bits, D, D3, F, M, U, splat_wide, widen3};
use crate::numeric::{END_ERROR, POINT_ERROR};
use crate::snapshot::{Affine, Instance};

/// Stands for no triangle.
pub(super) const NONE: u32 = u32::MAX;

impl<S: Simd> Tracer<'_, S> {
    /// Finds the nearest triangle of a mesh. Compiled apart.
    pub(super) fn walk_mesh(&mut self, packet: &Packet<'_, S>, best: &mut Best<S>, instance: &Instance) {
        self.s.vectorize(
            #[inline(always)]
            || self.walk_mesh_here(packet, best, instance),
        );
    }

    #[inline(always)]
    fn walk_mesh_here(&mut self, packet: &Packet<'_, S>, best: &mut Best<S>, instance: &Instance) {
        let Some(mesh) = self.frame.snapshot.mesh_at(instance.prim) else { return };
        let (origin, direction) = packet.precise(self.s);
        let (origin, direction) =
            (instance.own_points(self.s, origin), instance.own_vectors(self.s, direction));
        let lines = Lines { origin, direction, live: packet.live, off: self.drift(instance) };
        if let Precise::Asked(asked, at) = packet.precise
            && asked.any
        {
            *best = self.walk_mesh_for_any(packet, best, instance, (asked, at));
            return;
        }
        let before = *best;
        let mut umpire =
            Nearest { snapshot: self.frame.snapshot, mesh, prim: instance.prim, packet, before: &before };
        let mut visits = std::mem::take(self.visits);
        let facets = match lines.slopes(self.s, instance.tree.reach) {
            Some(slopes) => {
                // From metres to depth.
                let scale = slopes.scale * packet.inverse_length;
                let (begin, end) = (self.begin(packet, scale), self.end(best, scale));
                let mut rays = slopes.rays(self.s, begin, end, packet.live);
                rays.left = packet.left.facets_of(self.s, instance.prim);
                slopes.fan.search(self.s, &instance.tree.tree, &mut visits, &mut rays, &mut umpire);
                instance.facets(&rays)
            }
            None => self.search_each(packet, best, instance, &mut umpire, &mut visits),
        };
        self.count(&mut visits);
        *self.visits = visits;
        self.take(packet, best, (instance, mesh), &facets);
    }

    /// Marks the lanes that meet any triangle of a mesh.
    #[inline(always)]
    fn walk_mesh_for_any(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        instance: &Instance,
        (asked, at): (&Asked<'_>, usize),
    ) -> Best<S> {
        let Some(mesh) = self.frame.snapshot.mesh_at(instance.prim) else { return *best };
        let open = packet.live & !best.hits();
        let [start, end] = asked.ends(self.s, at);
        let (start, end) = (instance.own_points(self.s, start), instance.own_points(self.s, end));
        let (zero, reach) = (F::splat(self.s, 0.0), instance.tree.reach);
        let mut umpire =
            Nearest { snapshot: self.frame.snapshot, mesh, prim: instance.prim, packet, before: best };
        let mut visits = std::mem::take(self.visits);
        // Forwards where all start at one point, backwards where all end at one; lone where they do neither.
        let mut slopes =
            Lines { origin: start, direction: end - start, live: open, off: self.drift(instance) }
                .slopes(self.s, reach);
        if slopes.is_none() {
            slopes = Lines { origin: end, direction: start - end, live: open, off: self.drift(instance) }
                .slopes(self.s, reach);
        }
        let closed = match slopes {
            Some(slopes) => {
                let off = F::splat(self.s, slopes.slack * 2.0 + f32::MIN_POSITIVE);
                let error = slopes.scale.mul_add(F::splat(self.s, END_ERROR), off);
                let mut rays = slopes.rays(self.s, [zero - off, off], [slopes.scale, error], open);
                rays.left = packet.left.facets_of(self.s, instance.prim);
                slopes.fan.for_any().search(self.s, &instance.tree.tree, &mut visits, &mut rays, &mut umpire);
                !rays.slot.is(NONE)
            }
            None => {
                let asked = Packet { live: open, ..*packet };
                let facets = self.search_each(&asked, best, instance, &mut umpire, &mut visits);
                let bits = (0..16).fold(0, |bits, lane| bits | u64::from(facets[lane] != NONE) << lane);
                M::from_bits(self.s, bits & open.bits())
            }
        };
        self.count(&mut visits);
        *self.visits = visits;
        let prim = U::splat(self.s, instance.prim);
        Best { prim: U::pick(closed & open, prim, best.prim), ..*best }
    }

    /// Depths between which the stretches of a packet begin.
    #[inline(always)]
    fn begin(&self, packet: &Packet<'_, S>, scale: F<S>) -> [F<S>; 2] {
        let zero = F::splat(self.s, 0.0);
        match packet.precise {
            Precise::Camera(..) | Precise::Stream(..) => [zero, zero],
            Precise::Asked(asked, at) => {
                let [low, high] = asked.begins(self.s, at);
                [low * scale, high * scale * F::splat(self.s, 1.0 + END_ERROR)]
            }
        }
    }

    /// Depths up to which it is worth looking, and bounds on their errors.
    #[inline(always)]
    fn end(&self, best: &Best<S>, scale: F<S>) -> [F<S>; 2] {
        let most = F::splat(self.s, f32::MAX);
        let end = (best.t * scale).min(most);
        let error = best.error.mul_add(scale, end * F::splat(self.s, END_ERROR));
        let near = end.less(F::splat(self.s, f32::MAX / 4.0));
        [F::pick(near, end, most), F::pick(near, error, F::splat(self.s, 0.0))]
    }

    /// The nearest triangle for every lane, one lane after another.
    #[inline(always)]
    fn search_each(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        instance: &Instance,
        umpire: &mut Nearest<'_, S>,
        visits: &mut Visits,
    ) -> [u32; 16] {
        let tree = &instance.tree;
        let mut facets = [NONE; 16];
        let left = packet.left.facets_of(self.s, instance.prim);
        for lane in Bits(packet.live.bits()) {
            let Some((ray, span)) = umpire.ray(lane) else { continue };
            let metres = f64::from(best.t.lane(lane));
            let length = f64::from(packet.inverse_length.lane(lane));
            let error = (f64::from(best.error.lane(lane)) + metres * f64::from(END_ERROR)) * length;
            let met = best.prim.lane(lane) != NONE;
            let (t, error) = if met { (metres * length, error) } else { (span.max, 0.0) };
            let any = matches!(packet.precise, Precise::Asked(asked, _) if asked.any);
            let mut found = LoneBest { t, error, slot: None, any, min: span.min };
            let lone = Lone::new(ray, lane, left.lane(lane), tree.reach);
            lone.search(self.s, &tree.tree, visits, &mut found, umpire);
            facets[lane] = found.slot.map_or(NONE, |slot| tree.tree.facet(slot));
        }
        facets
    }

    /// Takes over triangles that are nearer for certain. Their `t` are functions of ray and triangle alone, however those
    /// were found, so that bits do not depend on which rays were traced together.
    #[inline(always)]
    fn take(
        &mut self,
        packet: &Packet<'_, S>,
        best: &mut Best<S>,
        (instance, mesh): (&Instance, &Mesh),
        facets: &[u32; 16],
    ) {
        let facet = U::load(self.s, facets);
        let taken = packet.live & !facet.is(NONE);
        if !taken.any() {
            return;
        }
        let t = self.settled_t(packet, (instance, mesh), taken, &facet).narrow();
        let metres = (t / packet.inverse_length).min(F::splat(self.s, f32::MAX.next_down()));
        best.t = F::pick(taken, metres, best.t);
        best.error = F::pick(taken, metres * F::splat(self.s, END_ERROR), best.error);
        best.prim = U::pick(taken, U::splat(self.s, instance.prim), best.prim);
        best.facet = U::pick(taken, facet, best.facet);
    }

    /// Where rays meet triangles of a mesh that they are known to meet.
    #[inline(always)]
    pub(super) fn settled_t(
        &self,
        packet: &Packet<'_, S>,
        (instance, mesh): (&Instance, &Mesh),
        lanes: M<S>,
        facet: &U<S>,
    ) -> D<S> {
        let (triangles, at) = (mesh.triangles().triangles(), mesh.triangles().positions());
        let mut corners = LaneCorners::NONE;
        for lane in lanes.lanes() {
            let [a, b, c] = triangles[facet.lane(lane) as usize];
            corners.set(lane, &[at[a as usize], at[b as usize], at[c as usize]]);
        }
        let (origin, direction) = packet.precise(self.s);
        let (origin, direction) =
            (instance.own_points(self.s, origin), instance.own_vectors(self.s, direction));
        let (mut t, sure) = corners.depths(self.s, origin, direction);
        for lane in Bits((lanes & !sure).bits()) {
            let (ray, span, leaving) = (packet.ray(lane), packet.span(lane), packet.leaving(lane));
            let facet = Some(facet.lane(lane));
            if let Some(hit) = self.frame.snapshot.cross_part(instance.prim, facet, &ray, span, leaving) {
                t.set(lane, hit.crossing.t);
            }
        }
        t
    }

    /// The ways still open once a mesh stands there. Compiled apart.
    pub(super) fn walk_mesh_to_light(
        &mut self,
        packet: &Packet<'_, S>,
        ways: &Ways<S>,
        open: M<S>,
        instance: &Instance,
    ) -> M<S> {
        self.s.vectorize(
            #[inline(always)]
            || self.walk_mesh_to_light_here(packet, ways, open, instance),
        )
    }

    #[inline(always)]
    fn walk_mesh_to_light_here(
        &mut self,
        packet: &Packet<'_, S>,
        ways: &Ways<S>,
        open: M<S>,
        instance: &Instance,
    ) -> M<S> {
        let Some(mesh) = self.frame.snapshot.mesh_at(instance.prim) else { return open };
        let mut umpire = Blocked { snapshot: self.frame.snapshot, mesh, prim: instance.prim, packet, ways };
        let mut visits = std::mem::take(self.visits);
        let left = ways.left.facets_of(self.s, instance.prim);
        let fan = if ways.target.at_infinity { None } else { self.fan_to_light(ways, open, instance) };
        let closed = match fan {
            Some((fan, mut rays)) => {
                rays.left = left;
                fan.search(self.s, &instance.tree.tree, &mut visits, &mut rays, &mut umpire);
                (!rays.slot.is(NONE) & open).bits()
            }
            None => {
                let mut closed = 0;
                for lane in Bits(open.bits()) {
                    let Some((ray, span)) = umpire.ray(lane) else { continue };
                    let mut found =
                        LoneBest { t: span.max, error: 0.0, slot: None, any: true, min: span.min };
                    let lone = Lone::new(ray, lane, left.lane(lane), instance.tree.reach);
                    lone.search(self.s, &instance.tree.tree, &mut visits, &mut found, &mut umpire);
                    closed |= u64::from(found.slot.is_some()) << lane;
                }
                closed
            }
        };
        self.count(&mut visits);
        *self.visits = visits;
        open & !M::from_bits(self.s, closed)
    }

    /// Ways to a light as rays from it, if they lie close enough together.
    #[inline(always)]
    fn fan_to_light(
        &self,
        ways: &Ways<S>,
        open: M<S>,
        instance: &Instance,
    ) -> Option<(crate::kernel::mesh::Fan, FanRays<S>)> {
        let apex = instance.own_points(self.s, splat_wide(self.s, ways.target.place));
        let start = instance.own_points(self.s, widen3(ways.rays.origin));
        let lines = Lines { origin: apex, direction: start - apex, live: open, off: self.drift(instance) };
        let slopes = lines.slopes(self.s, instance.tree.reach)?;
        let zero = F::splat(self.s, 0.0);
        let off = ways.rays.reach * F::splat(self.s, POINT_ERROR * instance.scale());
        let error = slopes.scale.mul_add(F::splat(self.s, END_ERROR), off);
        let rays = slopes.rays(self.s, [zero, zero], [slopes.scale, error], open);
        let steep = slopes.slope_error(self.s, off, open);
        Some((slopes.fan.for_any().with_slope_error(steep), rays))
    }

    /// How far origins relative to the snapshot's may be off, metres of the mesh's own space.
    fn drift(&self, instance: &Instance) -> f32 {
        drift(self.frame.snapshot.origin_in_frame()) * POINT_ERROR * instance.scale()
    }

    /// Adds up what has been looked at.
    #[inline(always)]
    fn count(&mut self, visits: &mut Visits) {
        let eight = crate::accel::WIDTH as u64;
        self.stats.tests.boxes += std::mem::take(&mut visits.nodes) * eight;
        self.stats.tests.shapes += std::mem::take(&mut visits.blocks) * eight;
    }
}

impl Instance {
    /// Points of the world in the mesh's own space.
    #[inline(always)]
    fn own_points<S: Simd>(&self, s: S, points: D3<S>) -> D3<S> {
        match &self.to_object {
            Some(affine) => affine.turn(s, points) + splat_wide(s, affine.shift),
            None => points,
        }
    }

    /// Directions of the world in the mesh's own space.
    #[inline(always)]
    fn own_vectors<S: Simd>(&self, s: S, vectors: D3<S>) -> D3<S> {
        match &self.to_object {
            Some(affine) => affine.turn(s, vectors),
            None => vectors,
        }
    }

    /// Metres of the mesh's own space a metre of the world.
    fn scale(&self) -> f32 {
        self.to_object.as_ref().map_or(1.0, |affine| affine.matrix[0].length() as f32)
    }

    /// Which triangles rays have found.
    #[inline(always)]
    fn facets<S: Simd>(&self, rays: &FanRays<S>) -> [u32; 16] {
        let mut facets = [NONE; 16];
        for lane in Bits((!rays.slot.is(NONE)).bits()) {
            facets[lane % 16] = self.tree.tree.facet(rays.slot.lane(lane));
        }
        facets
    }
}

impl Affine {
    #[inline(always)]
    fn turn<S: Simd>(&self, s: S, v: D3<S>) -> D3<S> {
        let [x, y, z] = self.matrix;
        D3::new(splat_wide(s, x).dot(v), splat_wide(s, y).dot(v), splat_wide(s, z).dot(v))
    }
}
