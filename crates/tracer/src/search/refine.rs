//! Refines the hits of a packet that `f32` has found: points and normals in `f64`.
//!
//! One Newton step from the `f32` distance, evaluated in `f64`, leaves an error of second order: about 2⁻⁴⁵ relative
//! where the ray is not grazing, and grazing rays have been decided before.

use catoptra_core::Span;
use fearless_simd::Simd;

use super::Searcher;
use super::hits::Hits;
use super::packet::{Packet, PreciseRays};
use crate::kernel::{Kernel, NearHit};
use crate::lanes::{D, D3, F, F3, LaneVectors, M, U, cross, outlined, pick3, unit};
use crate::snapshot::{Instance, KernelVisitor};

/// Points and normals of the lanes that meet something, in `f64`.
#[derive(Clone, Copy)]
pub(crate) struct Refined<S: Simd> {
    /// Relative to the snapshot's origin.
    pub(crate) point: D3<S>,
    /// Geometric, of unit length, on the shape's outer side.
    pub(crate) normal: D3<S>,
    /// To shade with, of unit length.
    pub(crate) shading: D3<S>,
}

impl<S: Simd> Searcher<'_, S> {
    /// Refines lanes, shape by shape.
    #[inline(always)]
    pub(crate) fn refine_every<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        lanes: M<S>,
    ) -> Refined<S> {
        let mut remaining = lanes.bits();
        let prim = best.prim.lane(remaining.trailing_zeros() as usize);
        let mut mask = lanes & best.prim.is(prim);
        let mut refined = self.refine(packet, best, mask, prim);
        remaining &= !mask.bits();
        while remaining != 0 {
            let prim = best.prim.lane(remaining.trailing_zeros() as usize);
            mask = lanes & best.prim.is(prim);
            refined = self.refine_too(packet, best, mask, prim, refined);
            remaining &= !mask.bits();
        }
        refined
    }

    /// Refines the lanes on another shape. Most packets meet one shape; see [`outlined`].
    #[inline(always)]
    fn refine_too<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        mask: M<S>,
        prim: u32,
        before: Refined<S>,
    ) -> Refined<S> {
        let (packet, best) = (*packet, *best);
        outlined(
            self.s,
            #[inline(always)]
            || self.refine(&packet, &best, mask, prim).over(mask, before),
        )
    }

    /// Refines the lanes of `mask`, which all meet the shape `prim`.
    #[inline(always)]
    pub(crate) fn refine<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        mask: M<S>,
        prim: u32,
    ) -> Refined<S> {
        let columns = self.snapshot.columns();
        match columns.visit_common(prim, Refine { search: self, packet, best, mask, prim }) {
            Ok(refined) => refined,
            Err(_) => self.refine_apart(packet, best, mask, prim),
        }
    }

    /// As [`refine`](Self::refine), [`outlined`].
    #[inline(always)]
    pub(super) fn refine_apart<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        mask: M<S>,
        prim: u32,
    ) -> Refined<S> {
        let columns = self.snapshot.columns();
        let (packet, best) = (*packet, *best);
        outlined(
            self.s,
            #[inline(always)]
            || columns.visit_here(prim, Refine { search: self, packet: &packet, best: &best, mask, prim }),
        )
    }

    /// One Newton step along the rays from where a value is `off` and changes by `slope` a metre to where it is 0.
    #[inline(always)]
    fn step<P: PreciseRays<S>>(
        &self,
        packet: &Packet<'_, S, P>,
        near: D3<S>,
        off: F<S>,
        slope: F<S>,
    ) -> D3<S> {
        let metres = -(off / slope);
        let (_, direction) = packet.precise(self.s);
        direction.scale_add((metres * packet.inverse_length).widen(), near)
    }

    /// Lanes on triangles of a mesh, in the mesh's own space.
    #[inline(always)]
    fn refine_on_mesh<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        mask: M<S>,
        instance: &Instance,
    ) -> Refined<S> {
        let mesh = instance.tree.mesh();
        let triangles = instance.facets(self.s, best.facet, mask);
        let lines = self.own_lines(packet, instance, mask);
        let of_lane = |lane: usize| packet.segment(lane);
        let t = self.refined_t(instance.prim, &lines, &triangles, of_lane);
        let (origin, direction) = packet.precise(self.s);
        let point = direction.scale_add(t, origin);
        let [a, b, c] = triangles.wide();
        let (e, f) = (b - a, c - a);
        let across = cross(e, f);
        let own_normal = unit(self.s, across);
        let normal = instance.world_normals(self.s, own_normal);
        let Some(normals) = mesh.normals() else { return Refined { point, normal, shading: normal } };
        let from = instance.own_points(self.s, point) - a;
        let weights = [across.dot(cross(from, f)), across.dot(cross(e, from))];
        let [of_b, of_c] = weights.map(|weight| weight / across.dot(across));
        let [at_a, at_b, at_c] = instance.at_corners(self.s, best.facet, mask, normals).wide();
        let blend = (at_c - at_a).scale_add(of_c, (at_b - at_a).scale_add(of_b, at_a));
        // Normals that cancel out give no direction, nor does NaN.
        let (zero, size) = (D::splat(self.s, 0.0), blend.dot(blend));
        let some = zero.at_most(size) & !size.at_most(zero);
        let shading = pick3(some, unit(self.s, blend), own_normal);
        Refined { point, normal, shading: instance.world_normals(self.s, shading) }
    }

    /// Lanes on a shape without a kernel.
    #[inline(always)]
    fn refine_general<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        mask: M<S>,
        prim: u32,
    ) -> Refined<S> {
        let [mut points, mut normals, mut shading] = [(); 3].map(|()| LaneVectors::default());
        for lane in mask.lanes() {
            let (ray, leaving) = (packet.ray(lane), packet.leaving.lane(lane));
            if let Some(hit) = self.snapshot.cross_part(prim, None, &ray, Span::AHEAD, leaving) {
                let c = hit.crossing;
                points.set(lane, ray.at(c.t) - self.snapshot.origin_in_frame());
                normals.set(lane, c.normal);
                shading.set(lane, c.shading_normal);
            }
        }
        let s = self.s;
        Refined { point: points.load(s), normal: normals.load(s), shading: shading.load(s) }
    }
}

/// The points at the distances that `f32` has found.
#[inline(always)]
fn near<S: Simd, P: PreciseRays<S>>(s: S, packet: &Packet<'_, S, P>, best: &Hits<S>) -> D3<S> {
    let (origin, direction) = packet.precise(s);
    direction.scale_add((best.t * packet.inverse_length).widen(), origin)
}

impl<S: Simd> Refined<S> {
    /// This one where the mask holds, else the other.
    #[inline(always)]
    pub(crate) fn over(self, mask: M<S>, other: Self) -> Self {
        Self {
            point: pick3(mask, self.point, other.point),
            normal: pick3(mask, self.normal, other.normal),
            shading: pick3(mask, self.shading, other.shading),
        }
    }
}

/// The hits of some lanes of a packet.
pub(super) struct PacketHit<'a, 'b, S: Simd, P> {
    pub(super) s: S,
    pub(super) packet: &'a Packet<'b, S, P>,
    pub(super) best: &'a Hits<S>,
    pub(super) mask: M<S>,
}

impl<S: Simd, P: PreciseRays<S>> NearHit<S> for PacketHit<'_, '_, S, P> {
    #[inline(always)]
    fn point(&self) -> F3<S> {
        self.packet.point(self.best.t)
    }

    #[inline(always)]
    fn near(&self) -> D3<S> {
        near(self.s, self.packet, self.best)
    }

    #[inline(always)]
    fn direction(&self) -> F3<S> {
        self.packet.rays.direction
    }

    #[inline(always)]
    fn facets(&self) -> (U<S>, M<S>) {
        (self.best.facet, self.mask)
    }
}

struct Refine<'t, 'a, 'b, S: Simd, P> {
    search: &'t mut Searcher<'a, S>,
    packet: &'t Packet<'b, S, P>,
    best: &'t Hits<S>,
    mask: M<S>,
    prim: u32,
}

impl<S: Simd, P: PreciseRays<S>> KernelVisitor for Refine<'_, '_, '_, S, P> {
    type Output = Refined<S>;

    #[inline(always)]
    fn visit(self, kernel: &impl Kernel) -> Refined<S> {
        let Self { search, packet, best, mask, .. } = self;
        let s = search.s;
        let hit = PacketHit { s, packet, best, mask };
        let (off, slope) = kernel.off(s, &hit);
        let point = search.step(packet, hit.near(), off, slope);
        let normal = kernel.normal(s, &hit, point);
        Refined { point, normal, shading: normal }
    }

    #[inline(always)]
    fn visit_mesh(self, instance: &Instance) -> Refined<S> {
        self.search.refine_on_mesh(self.packet, self.best, self.mask, instance)
    }

    #[inline(always)]
    fn visit_none(self) -> Refined<S> {
        self.search.refine_general(self.packet, self.mask, self.prim)
    }
}
