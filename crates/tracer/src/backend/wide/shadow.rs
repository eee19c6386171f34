//! Which ways from points to a light are blocked.

use catoptra_core::{LaneMask, Ray, Span};
use fearless_simd::Simd;

use super::Tracer;
use super::packet::{Left, Packet};
use crate::Snapshot;
use crate::kernel::{Blocking, Rays, Target};
use crate::lanes::{Bits, F, M};
use crate::numeric::CERTAIN;
use crate::snapshot::Row;

/// Ways from points to a light.
#[derive(Clone, Copy)]
pub(super) struct Ways<S: Simd> {
    /// Ways as kernels see them; how far their starts may be off is part of their reach.
    pub(super) rays: Rays<S>,
    /// Surfaces that they leave from.
    pub(super) left: Left<S>,
    /// Lanes that are asked about.
    pub(super) live: M<S>,
    /// Where they end.
    pub(super) target: Target<S>,
}

impl<S: Simd> Ways<S> {
    /// The way of a lane, from where its ray meets its surface in `f64`, whatever `f32` made of that point.
    pub(super) fn of_lane(
        &self,
        snapshot: &Snapshot,
        packet: &Packet<'_, S>,
        lane: usize,
    ) -> Option<(Ray, Span)> {
        let (ray, from) = (packet.ray(lane), self.left.lane(lane)?);
        let met = snapshot.cross_part(
            from.prim,
            Some(from.facet),
            &ray,
            packet.span(lane),
            packet.leaving(lane),
        )?;
        Some(self.target.way_from(ray.at(met.crossing.t)))
    }
}

impl<S: Simd> Tracer<'_, S> {
    /// Which ways to a light are blocked, where only planes and spheres may stand there and `f32` can tell.
    #[inline(always)]
    pub(super) fn blocked_for_certain(&mut self, ways: &Ways<S>, light: usize) -> Option<M<S>> {
        let columns = self.frame.snapshot.columns();
        let between = &self.between[light];
        if between.tree || !columns.general_unbounded.is_empty() {
            return None;
        }
        let behind = &self.frame.snapshot.light_rows()[light].behind;
        let (mut open, mut undecided) = (ways.live, M::splat(self.s, false));
        for &row in &between.planes {
            let plane = &columns.planes[row as usize];
            let blocking = plane.block(self.s, &ways.rays, behind[row as usize]);
            let other = open & !ways.left.from(self.s, plane.prim, 0);
            undecided = undecided | (other & blocking.undecided);
            open = open & !(other & blocking.blocked);
        }
        for &prim in &between.bounded {
            let Row::Sphere(row) = columns.rows[prim as usize] else { return None };
            let own = ways.left.from(self.s, prim, 0) & open;
            if own.any() && !self.outside {
                return None;
            }
            let nothing = M::splat(self.s, false);
            let blocking =
                columns.spheres[row as usize].block(self.s, &ways.rays, &ways.target, nothing, self.outside);
            let other = open & !own;
            undecided = undecided | (other & blocking.undecided);
            open = open & !(other & blocking.blocked);
        }
        if undecided.any() {
            return None;
        }
        self.stats.tests.shapes += ((between.planes.len() + between.bounded.len()) * F::<S>::LANES) as u64;
        Some(ways.live & !open)
    }

    /// Which ways to a light are blocked.
    #[inline(always)]
    pub(super) fn blocked(&mut self, packet: &Packet<'_, S>, ways: &Ways<S>, light: usize) -> M<S> {
        let columns = self.frame.snapshot.columns();
        let behind = &self.frame.snapshot.light_rows()[light].behind;
        let mut open = ways.live;
        for at in 0..self.between[light].planes.len() {
            let row = self.between[light].planes[at] as usize;
            let plane = &columns.planes[row];
            let blocking = plane.block(self.s, &ways.rays, behind[row]);
            let allowed = open & !ways.left.from(self.s, plane.prim, 0);
            open = self.block((packet, ways), open, allowed, (plane.prim, Some(0)), blocking);
        }
        for &prim in &columns.general_unbounded {
            open = self.block_lanes((packet, ways), open, open, (prim, None));
        }
        if !open.any() {
            return ways.live;
        }
        for at in 0..self.between[light].bounded.len() {
            open = self.block_prim(packet, ways, open, self.between[light].bounded[at]);
        }
        if self.between[light].tree {
            open = self.walk_scene_to_light(packet, ways, open);
        }
        ways.live & !open
    }

    /// The ways still open once one bounded shape stands there.
    #[inline(always)]
    pub(super) fn block_prim(
        &mut self,
        packet: &Packet<'_, S>,
        ways: &Ways<S>,
        open: M<S>,
        prim: u32,
    ) -> M<S> {
        let columns = self.frame.snapshot.columns();
        if let Row::Sphere(row) = columns.rows[prim as usize] {
            let own = ways.left.from(self.s, prim, 0) & open;
            // Seen from outside, what faces the light is not shadowed by its own sphere.
            let (asked, leaving) =
                if self.outside { (open & !own, M::splat(self.s, false)) } else { (open, own) };
            let blocking =
                columns.spheres[row as usize].block(self.s, &ways.rays, &ways.target, leaving, self.outside);
            self.block((packet, ways), open, asked, (prim, Some(0)), blocking)
        } else {
            let (packet, ways) = (*packet, *ways);
            self.s.vectorize(
                #[inline(always)]
                || self.block_facets(&packet, &ways, open, prim),
            )
        }
    }

    /// As [`block_prim`](Self::block_prim) for a shape that is no sphere.
    #[inline(always)]
    fn block_facets(&mut self, packet: &Packet<'_, S>, ways: &Ways<S>, open: M<S>, prim: u32) -> M<S> {
        let columns = self.frame.snapshot.columns();
        match columns.rows[prim as usize] {
            Row::Flat(row) => {
                let blocking = columns.flats[row as usize].propose(self.s, &ways.rays).blocking(&ways.target);
                let allowed = open & !ways.left.from(self.s, prim, 0);
                self.block((packet, ways), open, allowed, (prim, Some(0)), blocking)
            }
            Row::Cuboid(row) => {
                let cuboid = &columns.cuboids[row as usize];
                let again = self.again_to_light(ways, &cuboid.faces);
                let open = self.block_lanes((packet, ways), open, again.undecided, (prim, None));
                if !(open & again.may).any() {
                    return open;
                }
                let entered = again.entered(self.s, &ways.left);
                let (proposal, _) = cuboid.propose(self.s, &ways.rays, entered);
                let blocking = proposal.blocking(&ways.target);
                self.block((packet, ways), open, open & again.may, (prim, None), blocking)
            }
            Row::Triangles(first, count) => {
                let triangles = &columns.triangles[first as usize..(first + count) as usize];
                let again = self.again_to_light(ways, triangles);
                let mut open = self.block_lanes((packet, ways), open, again.undecided, (prim, None));
                if !(open & again.may).any() {
                    return open;
                }
                for triangle in triangles {
                    let blocking = triangle.propose(self.s, &ways.rays).blocking(&ways.target);
                    let allowed = open & again.may & !ways.left.from(self.s, prim, triangle.facet);
                    open = self.block((packet, ways), open, allowed, (prim, Some(triangle.facet)), blocking);
                }
                open
            }
            Row::Instance(row) => {
                self.walk_mesh_to_light(packet, ways, open, &columns.instances[row as usize])
            }
            Row::General | Row::Plane(_) | Row::Sphere(_) => {
                self.block_lanes((packet, ways), open, open, (prim, None))
            }
        }
    }

    /// The ways still open after what a kernel found; what it could not decide is settled in `f64`.
    #[inline(always)]
    pub(super) fn block(
        &mut self,
        (packet, ways): (&Packet<'_, S>, &Ways<S>),
        open: M<S>,
        allowed: M<S>,
        place: (u32, Option<u32>),
        blocking: Blocking<S>,
    ) -> M<S> {
        self.stats.tests.shapes += F::<S>::LANES as u64;
        let undecided = allowed & blocking.undecided;
        let left = open & !(allowed & blocking.blocked & !undecided);
        if CERTAIN && undecided.any() {
            self.block_lanes((packet, ways), left, undecided, place)
        } else {
            left
        }
    }

    /// Decides in `f64`, lane by lane, whether a shape blocks the way.
    #[inline(always)]
    fn block_lanes(
        &mut self,
        (packet, ways): (&Packet<'_, S>, &Ways<S>),
        open: M<S>,
        lanes: M<S>,
        place: (u32, Option<u32>),
    ) -> M<S> {
        let (packet, ways) = (*packet, *ways);
        let closed = self.block_each_lane(&packet, &ways, (lanes & open).bits(), place);
        open & !M::from_bits(self.s, closed)
    }

    #[cold]
    #[inline(never)]
    fn block_each_lane(
        &mut self,
        packet: &Packet<'_, S>,
        ways: &Ways<S>,
        lanes: u64,
        (prim, facet): (u32, Option<u32>),
    ) -> u64 {
        let snapshot = self.frame.snapshot;
        let mut closed = 0;
        for lane in Bits(lanes) {
            self.stats.settled += 1;
            let Some((way, span)) = ways.of_lane(snapshot, packet, lane) else { continue };
            if snapshot.cross_part(prim, facet, &way, span, ways.left.lane(lane)).is_some() {
                closed |= 1 << lane;
            }
        }
        closed
    }
}
