//! Decides exactly, one ray at a time, what error bounds leave open between a ray and a mesh.

use catoptra_core::geometry::Mesh;
use catoptra_core::{Geometry, Ray, Span};
use fearless_simd::Simd;

use super::hits::Hits;
use super::mesh::NONE;
use super::occluded::{Segments, Shadows};
use super::packet::{Packet, PreciseRays};
use crate::kernel::mesh::ExactResolver;
use crate::lanes::F;
use crate::snapshot::{RaySegment, leaving_facet};
use crate::{Hit, Snapshot};

/// Exact closest hits of the rays of some packets; their lanes are counted through.
pub(crate) struct ClosestOfPackets<'a, 'p, S: Simd, P> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) mesh: &'a Mesh,
    pub(crate) prim: u32,
    pub(crate) packets: &'a [Packet<'p, S, P>],
    /// What the rays had met before they came to the mesh.
    pub(crate) before: &'a [Hits<S>],
}

impl<S: Simd, P: PreciseRays<S>> ExactResolver for ClosestOfPackets<'_, '_, S, P> {
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)> {
        let (packet, lane) = (&self.packets[lane / F::<S>::LANES], lane % F::<S>::LANES);
        Some((self.mesh.own_ray(&packet.ray(lane)), packet.span(lane)))
    }

    fn leaves(&self, left: u32, facet: u32) -> bool {
        self.mesh.triangles().lies_in_plane(left, facet)
    }

    #[cold]
    #[inline(never)]
    fn decide(&mut self, lane: usize, facet: u32, held: Option<u32>) -> Option<f64> {
        let (number, lane) = (lane / F::<S>::LANES, lane % F::<S>::LANES);
        let (ray, span, leaving) = self.packets[number].segment(lane);
        if let Some(held) = held {
            let leaving = leaving_facet(self.prim, leaving);
            return self.mesh.met_before([facet, held], &self.mesh.own_ray(&ray), span, leaving);
        }
        let cross = |prim: u32, facet: u32| self.snapshot.cross_part(prim, Some(facet), &ray, span, leaving);
        let hit = cross(self.prim, facet)?;
        let before = &self.before[number];
        let other: Option<Hit> = match before.prim.lane(lane) {
            NONE => None,
            prim => cross(prim, before.facet.lane(lane)),
        };
        let segment = RaySegment::new(&ray, span, leaving);
        other.is_none_or(|other| self.snapshot.precedes(&segment, &hit, &other)).then_some(hit.crossing.t)
    }
}

/// Exact occlusion of the segments of some packets; their lanes are counted through.
pub(crate) struct AnyInTheWay<'a, 's, S: Simd, G> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) mesh: &'a Mesh,
    pub(crate) prim: u32,
    pub(crate) shadows: &'a [Shadows<'s, S, G>],
}

impl<S: Simd, G: Segments<S>> ExactResolver for AnyInTheWay<'_, '_, S, G> {
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)> {
        let shadows = &self.shadows[lane / F::<S>::LANES];
        let (ray, span) = shadows.segments.segment(self.snapshot, lane % F::<S>::LANES)?;
        Some((self.mesh.own_ray(&ray), span))
    }

    fn leaves(&self, left: u32, facet: u32) -> bool {
        self.mesh.triangles().lies_in_plane(left, facet)
    }

    #[cold]
    #[inline(never)]
    fn decide(&mut self, lane: usize, facet: u32, _: Option<u32>) -> Option<f64> {
        let (shadows, lane) = (&self.shadows[lane / F::<S>::LANES], lane % F::<S>::LANES);
        let (ray, span) = shadows.segments.segment(self.snapshot, lane)?;
        let leaving = leaving_facet(self.prim, shadows.rays.leaving.lane(lane));
        let met = self.mesh.locate_piece(facet, &self.mesh.own_ray(&ray), span, leaving);
        met.map(|(at, _)| at.t)
    }
}
