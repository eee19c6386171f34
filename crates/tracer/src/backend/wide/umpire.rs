//! What decides for certain where bounds leave open what a mesh does to a ray: exact crossings, one ray at a time.

use catoptra_core::geometry::Mesh;
use catoptra_core::{Geometry, Ray, Span};
use fearless_simd::Simd;

use super::ask::Asked;
use super::mesh::NONE;
use super::packet::Packet;
use super::search::Best;
use super::shadow::Ways;
use crate::kernel::mesh::Umpire;
use crate::snapshot::Way;
use crate::{Hit, Snapshot};

/// Decides what a ray of a packet meets first.
pub(super) struct Nearest<'a, S: Simd> {
    pub(super) snapshot: &'a Snapshot,
    pub(super) mesh: &'a Mesh,
    pub(super) prim: u32,
    pub(super) packet: &'a Packet<'a, S>,
    /// What the rays had met before they came to the mesh.
    pub(super) before: &'a Best<S>,
}

impl<S: Simd> Umpire for Nearest<'_, S> {
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)> {
        Some((self.mesh.own_ray(&self.packet.ray(lane)), self.packet.span(lane)))
    }

    #[cold]
    #[inline(never)]
    fn decide(&mut self, lane: usize, facet: u32, held: Option<u32>) -> Option<f64> {
        let (ray, span, leaving) = (self.packet.ray(lane), self.packet.span(lane), self.packet.leaving(lane));
        let cross = |prim: u32, facet: u32| self.snapshot.cross_part(prim, Some(facet), &ray, span, leaving);
        let hit = cross(self.prim, facet)?;
        let other: Option<Hit> = match (held, self.before.prim.lane(lane)) {
            (Some(held), _) => cross(self.prim, held),
            (None, NONE) => None,
            (None, prim) => cross(prim, self.before.facet.lane(lane)),
        };
        let way = Way::new(&ray, span, leaving);
        other.is_none_or(|other| self.snapshot.precedes(&way, &hit, &other)).then_some(hit.crossing.t)
    }
}

/// Decides what rays of anyone's choice meet, of a mesh that is all there is.
pub(super) struct Alone<'a> {
    pub(super) snapshot: &'a Snapshot,
    pub(super) mesh: &'a Mesh,
    pub(super) prim: u32,
    pub(super) asked: &'a Asked<'a>,
    /// The ray of lane 0.
    pub(super) at: usize,
}

impl Umpire for Alone<'_> {
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)> {
        let (ray, span, _) = self.asked.way(self.at + lane);
        Some((self.mesh.own_ray(&ray), span))
    }

    #[cold]
    #[inline(never)]
    fn decide(&mut self, lane: usize, facet: u32, held: Option<u32>) -> Option<f64> {
        let (ray, span, leaving) = self.asked.way(self.at + lane);
        let cross = |facet: u32| self.snapshot.cross_part(self.prim, Some(facet), &ray, span, leaving);
        let hit = cross(facet)?;
        let way = Way::new(&ray, span, leaving);
        let other = held.and_then(cross);
        other.is_none_or(|other| self.snapshot.precedes(&way, &hit, &other)).then_some(hit.crossing.t)
    }
}

/// Decides whether a way to a light is blocked.
pub(super) struct Blocked<'a, S: Simd> {
    pub(super) snapshot: &'a Snapshot,
    pub(super) mesh: &'a Mesh,
    pub(super) prim: u32,
    pub(super) packet: &'a Packet<'a, S>,
    pub(super) ways: &'a Ways<S>,
}

impl<S: Simd> Blocked<'_, S> {
    /// The way from where the ray of a lane meets its surface in `f64`, whatever `f32` made of that point.
    fn way(&self, lane: usize) -> Option<(Ray, Span)> {
        self.ways.of_lane(self.snapshot, self.packet, lane)
    }
}

impl<S: Simd> Umpire for Blocked<'_, S> {
    fn ray(&mut self, lane: usize) -> Option<(Ray, Span)> {
        let (way, span) = self.way(lane)?;
        Some((self.mesh.own_ray(&way), span))
    }

    #[cold]
    #[inline(never)]
    fn decide(&mut self, lane: usize, facet: u32, _: Option<u32>) -> Option<f64> {
        let (way, span) = self.way(lane)?;
        let hit = self.snapshot.cross_part(self.prim, Some(facet), &way, span, self.ways.left.lane(lane));
        hit.map(|hit| hit.crossing.t)
    }
}
