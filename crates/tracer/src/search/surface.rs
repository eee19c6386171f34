//! Points and normals at the hits of a packet, in `f32`: enough to shade with.
//!
//! Shadow tests that `f32` leaves undecided and the origins of reflected rays use the `f64` point instead.

use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use super::Searcher;
use super::hits::Hits;
use super::packet::{Packet, PreciseRays};
use super::refine::{PacketHit, Refined};
use crate::kernel::Kernel;
use crate::lanes::{D3, F3, M, narrow3, outlined, pick3, splat_wide};
use crate::snapshot::{Instance, KernelVisitor};

/// Points and normals of the lanes that meet something.
#[derive(Clone, Copy)]
pub(crate) struct Surface<S: Simd> {
    /// Relative to the snapshot's origin.
    pub(crate) point: F3<S>,
    /// Geometric, of unit length, on the shape's outer side.
    pub(crate) normal: F3<S>,
    /// To shade with, of unit length.
    pub(crate) shading: F3<S>,
}

/// Points in `f64` of some lanes, relative to the snapshot's origin.
#[derive(Clone, Copy)]
pub(crate) struct PrecisePoints<S: Simd> {
    pub(crate) point: D3<S>,
    /// The lanes that have one.
    pub(crate) lanes: M<S>,
}

impl<S: Simd> PrecisePoints<S> {
    #[inline(always)]
    pub(crate) fn none(s: S) -> Self {
        Self { point: splat_wide(s, DVec3::ZERO), lanes: M::splat(s, false) }
    }

    /// Adds the points of some lanes.
    #[inline(always)]
    fn add(&mut self, lanes: M<S>, point: D3<S>) {
        self.point = pick3(lanes, point, self.point);
        self.lanes = self.lanes | lanes;
    }
}

impl<S: Simd> Surface<S> {
    #[inline(always)]
    pub(crate) fn flat(point: F3<S>, normal: F3<S>) -> Self {
        Self { point, normal, shading: normal }
    }

    /// This one where the mask holds, else the other.
    #[inline(always)]
    fn over(self, mask: M<S>, other: Self) -> Self {
        Self {
            point: F3::select(mask, self.point, other.point),
            normal: F3::select(mask, self.normal, other.normal),
            shading: F3::select(mask, self.shading, other.shading),
        }
    }
}

impl<S: Simd> Searcher<'_, S> {
    /// The surface of the lanes of `mask`, which all meet the shape `prim`. Notes where they meet meshes.
    #[inline(always)]
    pub(crate) fn surface<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        mask: M<S>,
        prim: u32,
    ) -> Surface<S> {
        let columns = self.snapshot.columns();
        columns.visit_here(prim, SurfaceOf { search: self, packet, best, mask, prim })
    }

    /// The surface that all lanes of a packet meet, of a shape with that kernel.
    #[inline(always)]
    pub(crate) fn surface_of<P: PreciseRays<S>>(
        &self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        kernel: &impl Kernel,
    ) -> Surface<S> {
        let hit = PacketHit { s: self.s, packet, best, mask: packet.live };
        let (point, normal) = kernel.surface(self.s, &hit);
        Surface::flat(point, normal)
    }

    /// Adds the lanes of another shape. Most packets meet one shape; see [`outlined`].
    #[inline(always)]
    pub(crate) fn surface_too<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        mask: M<S>,
        prim: u32,
        before: Surface<S>,
    ) -> Surface<S> {
        let (packet, best) = (*packet, *best);
        outlined(
            self.s,
            #[inline(always)]
            || self.surface(&packet, &best, mask, prim).over(mask, before),
        )
    }
}

struct SurfaceOf<'t, 'a, 'b, S: Simd, P> {
    search: &'t mut Searcher<'a, S>,
    packet: &'t Packet<'b, S, P>,
    best: &'t Hits<S>,
    mask: M<S>,
    prim: u32,
}

impl<S: Simd, P: PreciseRays<S>> SurfaceOf<'_, '_, '_, S, P> {
    /// From where the lanes meet the shape in `f64`.
    #[inline(always)]
    fn refined(&mut self) -> Refined<S> {
        self.search.refine_apart(self.packet, self.best, self.mask, self.prim)
    }
}

impl<S: Simd> From<Refined<S>> for Surface<S> {
    #[inline(always)]
    fn from(refined: Refined<S>) -> Self {
        Self {
            point: narrow3(refined.point),
            normal: narrow3(refined.normal),
            shading: narrow3(refined.shading),
        }
    }
}

impl<S: Simd, P: PreciseRays<S>> KernelVisitor for SurfaceOf<'_, '_, '_, S, P> {
    type Output = Surface<S>;

    #[inline(always)]
    fn visit(self, kernel: &impl Kernel) -> Surface<S> {
        let (s, packet, best, mask) = (self.search.s, self.packet, self.best, self.mask);
        let (point, normal) = kernel.surface(s, &PacketHit { s, packet, best, mask });
        Surface::flat(point, normal)
    }

    #[inline(always)]
    fn visit_mesh(mut self, _: &Instance) -> Surface<S> {
        let refined = self.refined();
        self.search.on_meshes.add(self.mask, refined.point);
        refined.into()
    }

    #[inline(always)]
    fn visit_none(mut self) -> Surface<S> {
        self.refined().into()
    }
}
