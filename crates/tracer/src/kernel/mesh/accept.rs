//! Tests a packet of a ray bundle against one triangle, and takes it over where it is the nearest hit.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::bundle::Bundle;
use super::bundled_rays::BundledRays;
use super::common::Common;
use super::edges::Prepared;
use super::planes::Crossing;
use super::{Decision, Edges, ExactResolver, RayTriangle, decide};
use crate::accel::{Planes, WIDTH, WideTree};
use crate::kernel::bound;
use crate::lanes::{Bits, F, M, MOST_LANES, U, outlined};
use crate::numeric::BUNDLE_SLOPE;

/// A triangle of a tree.
#[derive(Clone, Copy)]
pub(super) struct TreeTriangle<'a> {
    pub(super) tree: &'a WideTree,
    /// Its slot in the tree's blocks.
    pub(super) slot: u32,
    /// Its number in the mesh.
    pub(super) facet: u32,
    /// The planes of the tree, where they are numbered.
    pub(super) planes: Option<&'a Planes>,
}

impl TreeTriangle<'_> {
    fn corners(&self) -> [[f32; 3]; 3] {
        self.tree.triangle(self.slot)
    }
}

/// A packet of a bundle, and its number there.
pub(super) struct PacketRays<'a, S: Simd> {
    pub(super) rays: &'a mut BundledRays<S>,
    pub(super) packet: usize,
}

/// Lanes that `f32` leaves open, bit by bit, and those that pass within all edges for certain.
#[derive(Clone, Copy)]
struct OpenLanes {
    open: u64,
    inside: u64,
}

/// An open lane.
#[derive(Clone, Copy)]
struct OpenLane {
    lane: usize,
    /// Its number among the lanes of all packets of the group.
    in_group: usize,
    edges: Edges,
}

impl<S: Simd> BundledRays<S> {
    /// Takes over a triangle in some lanes.
    #[inline(always)]
    fn take(&mut self, s: S, lanes: M<S>, slot: u32, crossing: &Crossing<S>, any: bool) {
        self.end =
            [F::pick(lanes, crossing.depth[0], self.end[0]), F::pick(lanes, crossing.depth[1], self.end[1])];
        self.slot = U::pick(lanes, U::splat(s, slot), self.slot);
        if any {
            self.live = self.live & !lanes;
        }
    }

    /// Names the planes that rays leave instead of triangles.
    #[inline(always)]
    pub(super) fn leave_planes(&mut self, s: S, planes: &Planes) {
        let mut left = [u32::MAX; MOST_LANES];
        for lane in (!self.leaving.is(u32::MAX)).lanes() {
            left[lane % MOST_LANES] = planes.of_facet(self.leaving.lane(lane));
        }
        self.leaving = U::load(s, &left);
    }

    /// Takes over a triangle in lanes that pass within its edges and have met a later one in its plane; returns the lanes of
    /// `candidate` that have met none in its plane, or may yet take it over.
    #[inline(always)]
    fn take_in_plane(
        &mut self,
        s: S,
        triangle: &TreeTriangle<'_>,
        planes: &Planes,
        candidate: M<S>,
        inside: M<S>,
    ) -> M<S> {
        let TreeTriangle { tree, slot, facet, .. } = *triangle;
        let (plane, mut rest) = (planes.of_slot(slot), candidate);
        for (held, lanes) in self.slot.groups(candidate & !self.slot.is(u32::MAX)) {
            if planes.of_slot(held) != plane {
                continue;
            }
            if tree.facet(held) <= facet {
                rest = rest & !lanes;
            } else {
                // Both are met at one depth, which is known.
                self.slot = U::pick(lanes & inside, U::splat(s, slot), self.slot);
                rest = rest & !(lanes & inside);
            }
        }
        rest
    }

    /// Which of some lanes, told by bits, leave the plane of a triangle.
    fn leaving_plane_of(&self, facet: u32, lanes: u64, exact: &dyn ExactResolver) -> u64 {
        let own = M::from_bits(self.slot.0.token(), lanes) & !self.leaving.is(u32::MAX);
        let left = self.leaving.groups(own).filter(|(left, _)| exact.leaves(*left, facet));
        left.fold(0, |all, (_, lanes)| all | lanes.bits())
    }
}

impl<C: Common> Bundle<C> {
    /// Takes over a triangle where it is nearer; returns whether it is, or may be, for any ray.
    #[inline(always)]
    pub(super) fn accept<S: Simd>(
        &self,
        s: S,
        triangle: &TreeTriangle<'_>,
        prepared: &Prepared,
        packet: PacketRays<'_, S>,
        exact: &mut dyn ExactResolver,
    ) -> bool {
        let TreeTriangle { slot, facet, planes, .. } = *triangle;
        let left = planes.map_or(facet, |planes| planes.of_slot(slot));
        let PacketRays { rays, packet } = packet;
        let at = slot as usize % WIDTH;
        let edge = |[x, y, z]: &[[f32; WIDTH]; 3]| rays.value(s, [x[at], y[at], z[at]]);
        let [a, b, c] = &prepared.edges;
        let (a, b, c) = (edge(a), edge(b), edge(c));
        let error = bound(s, F::splat(s, prepared.edge_error[at]));
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let mut candidate = rays.live & !(low.less(-error) & error.less(high)) & !rays.leaving.is(left);
        if !candidate.any() {
            return false;
        }
        let inside = error.less(low) | high.less(-error);
        if let Some(planes) = planes {
            candidate = rays.take_in_plane(s, triangle, planes, candidate, inside);
            if !candidate.any() {
                return false;
            }
        }
        let crossing = rays.cross(s, self, &prepared.plane(at));
        let take = candidate & inside & crossing.nearer;
        let open = candidate & !take & !crossing.beside;
        if take.any() {
            rays.take(s, take, slot, &crossing, self.any);
        }
        if open.any() {
            let lanes = OpenLanes { open: open.bits(), inside: inside.bits() };
            self.decide(*triangle, lanes, PacketRays { rays, packet }, exact);
        }
        (take | open).any()
    }

    /// Decides what `f32` leaves open; lanes of `inside` pass within all edges for certain.
    #[cold]
    #[inline(never)]
    fn decide<S: Simd>(
        &self,
        triangle: TreeTriangle<'_>,
        lanes: OpenLanes,
        packet: PacketRays<'_, S>,
        exact: &mut dyn ExactResolver,
    ) {
        let PacketRays { rays, packet } = packet;
        let OpenLanes { open, inside } = lanes;
        let left = open & rays.leaving_plane_of(triangle.facet, open, exact);
        triangle.tree.planes.count(left.count_ones());
        let open = open & !left;
        let lanes = OpenLanes { open, inside };
        // Where only edges are open, depths have already been compared.
        let open = if open & inside == 0 { open } else { self.decide_by_depths(triangle, lanes, rays) };
        for lane in Bits(open) {
            let other = rays.slot.lane(lane);
            let held = (other != u32::MAX).then(|| triangle.tree.facet(other));
            if held == Some(triangle.facet) {
                continue;
            }
            rays.decided += 1;
            let edges = if inside >> lane & 1 == 1 { Edges::Inside } else { Edges::Open };
            let undecided = OpenLane { lane, in_group: packet * F::<S>::LANES + lane, edges };
            let Some(t) = self.nearer(triangle, rays, undecided, exact) else { continue };
            let z = t as f32 * rays.scale.lane(lane);
            let error = z.abs() * (BUNDLE_SLOPE + BUNDLE_SLOPE);
            rays.end[0].set(lane, z - error);
            rays.end[1].set(lane, z + error);
            rays.slot.set(lane, triangle.slot);
            if self.any {
                rays.live = rays.live & !M::from_bits(rays.slot.0.token(), 1 << lane);
            }
        }
    }

    /// Decides by depths from `f64` planes; returns the lanes that those leave open.
    fn decide_by_depths<S: Simd>(
        &self,
        triangle: TreeTriangle<'_>,
        lanes: OpenLanes,
        rays: &mut BundledRays<S>,
    ) -> u64 {
        let s = rays.slot.0.token();
        let TreeTriangle { tree, slot, .. } = triangle;
        let precise = self.common.precise_plane(self, &triangle.corners());
        let plane = self.common.plane_of(self, &precise);
        outlined(
            s,
            #[inline(always)]
            || {
                let (mut open, inside) = (M::from_bits(s, lanes.open), M::from_bits(s, lanes.inside));
                let crossing = rays.cross(s, self, &plane);
                let take = open & inside & crossing.nearer;
                rays.take(s, take, slot, &crossing, self.any);
                open = open & !take & !crossing.beside;
                let ahead = rays.begin[1].less(crossing.depth[0]) & rays.begin[1].less(rays.end[0]);
                let both = open & inside & ahead & !rays.slot.is(u32::MAX);
                // Surfaces so close together that depths in `f32` give no order.
                for (held, lanes) in rays.slot.groups(both) {
                    let held = self.common.precise_plane(self, &tree.triangle(held));
                    let Some((m, error)) = self.common.order(self, [&precise, &held]) else { continue };
                    let (order, error) = (rays.value(s, m), F::splat(s, error));
                    let before = lanes & order.less(-error);
                    rays.take(s, before, slot, &crossing, self.any);
                    open = open & !before & !(lanes & error.less(order));
                }
                open.bits()
            },
        )
    }

    /// The `t` at which the ray of a lane meets a triangle, if that is before its nearest hit so far.
    fn nearer<S: Simd>(
        &self,
        triangle: TreeTriangle<'_>,
        rays: &BundledRays<S>,
        open: OpenLane,
        exact: &mut dyn ExactResolver,
    ) -> Option<f64> {
        let OpenLane { lane, in_group, edges } = open;
        let (ray, span) = exact.ray(in_group)?;
        let other = Some(rays.slot.lane(lane)).filter(|&slot| slot != u32::MAX);
        // Two roundings of a sum and a quotient, towards smaller numbers.
        let least = rays.end[0].lane(lane) * (1.0 - 4.0 * BUNDLE_SLOPE);
        let before = if self.any { f64::INFINITY } else { f64::from(least / rays.scale.lane(lane)) };
        let held = other.map(|slot| triangle.tree.triangle(slot));
        let test = RayTriangle { ray: &ray, span, corners: &triangle.corners(), edges };
        match decide(&test, held, before) {
            Decision::NotNearer => None,
            Decision::Nearer(t) => Some(t),
            Decision::Open => {
                triangle.tree.planes.count(1);
                exact.decide(in_group, triangle.facet, other.map(|slot| triangle.tree.facet(slot)))
            }
        }
    }
}
