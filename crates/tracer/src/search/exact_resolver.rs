//! Decides exactly, one ray at a time, what error bounds leave open between a ray and a mesh.

use catoptra_core::geometry::Mesh;
use catoptra_core::{Geometry, Ray, Span};
use fearless_simd::Simd;

use super::hits::Hits;
use super::mesh::NONE;
use super::occluded::Segments;
use super::packet::{Packet, PreciseRays};
use crate::kernel::Leaving;
use crate::kernel::mesh::ExactResolver;
use crate::snapshot::RaySegment;
use crate::{Hit, Snapshot};

/// Exact closest hits of the rays of a packet.
pub(crate) struct ClosestOfPacket<'a, S: Simd, P> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) mesh: &'a Mesh,
    pub(crate) prim: u32,
    pub(crate) packet: &'a Packet<'a, S, P>,
    /// What the rays had met before they came to the mesh.
    pub(crate) before: &'a Hits<S>,
}

impl<S: Simd, P: PreciseRays<S>> ExactResolver for ClosestOfPacket<'_, S, P> {
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)> {
        Some((self.mesh.own_ray(&self.packet.ray(lane)), self.packet.span(lane)))
    }

    #[cold]
    #[inline(never)]
    fn decide(&mut self, lane: usize, facet: u32, held: Option<u32>) -> Option<f64> {
        let (ray, span, leaving) = self.packet.segment(lane);
        let cross = |prim: u32, facet: u32| self.snapshot.cross_part(prim, Some(facet), &ray, span, leaving);
        let hit = cross(self.prim, facet)?;
        let other: Option<Hit> = match (held, self.before.prim.lane(lane)) {
            (Some(held), _) => cross(self.prim, held),
            (None, NONE) => None,
            (None, prim) => cross(prim, self.before.facet.lane(lane)),
        };
        let segment = RaySegment::new(&ray, span, leaving);
        other.is_none_or(|other| self.snapshot.precedes(&segment, &hit, &other)).then_some(hit.crossing.t)
    }
}

/// Exact occlusion of segments.
pub(crate) struct AnyInTheWay<'a, S: Simd, G> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) mesh: &'a Mesh,
    pub(crate) prim: u32,
    pub(crate) segments: &'a G,
    /// Surfaces that the segments leave.
    pub(crate) leaving: Leaving<S>,
}

impl<S: Simd, G: Segments<S>> ExactResolver for AnyInTheWay<'_, S, G> {
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)> {
        let (ray, span) = self.segments.segment(self.snapshot, lane)?;
        Some((self.mesh.own_ray(&ray), span))
    }

    #[cold]
    #[inline(never)]
    fn decide(&mut self, lane: usize, facet: u32, _: Option<u32>) -> Option<f64> {
        let (ray, span) = self.segments.segment(self.snapshot, lane)?;
        let hit = self.snapshot.cross_part(self.prim, Some(facet), &ray, span, self.leaving.lane(lane));
        hit.map(|hit| hit.crossing.t)
    }
}
