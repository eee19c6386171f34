//! What is everything that one ray meets, in order, and how does a hit look that was found elsewhere?

use std::cmp::Ordering;

use catoptra_core::{Crossing, Geometry, Span};

use super::search::{comes_first, leaving_facet};
use super::{Hit, RaySegment, Snapshot, SurfaceId};
use crate::numeric::NEAR;

/// A hit, and the segment of which it is the first on its surface.
struct Found<'a> {
    hit: Hit,
    segment: RaySegment<'a>,
}

impl Snapshot {
    /// Everything that a segment meets, nearest first; where surfaces lie in one place, in the order of their numbers, and what
    /// lies there [twice](catoptra_core::TriangleMesh::firsts_in_place) once. A ray through an edge that triangles share meets
    /// all of them. Of one round surface, meetings that lie closer together than `f64` tells apart, as those of a ray that
    /// grazes it, are one.
    pub(crate) fn all_on(&self, segment: &RaySegment<'_>) -> Vec<Hit> {
        let mut found: Vec<Found<'_>> = Vec::new();
        let mut keep =
            |span, hit| self.insert(&mut found, Found { hit, segment: RaySegment { span, ..*segment } });
        for &prim in self.index.unbounded.iter().filter(|&&prim| segment.sees(prim)) {
            self.cross_everywhere(prim, segment, &mut keep);
        }
        self.index.tree.walk(&self.box_ray(segment), segment.span, |item| {
            let prim = self.index.bounded[item as usize];
            if segment.sees(prim) {
                self.cross_everywhere(prim, segment, &mut keep);
            }
            segment.span.max
        });
        found.into_iter().map(|found| found.hit).collect()
    }

    /// Puts a hit where it belongs, unless it is there: a tree may show a triangle twice.
    fn insert<'a>(&self, found: &mut Vec<Found<'a>>, new: Found<'a>) {
        let place = found.partition_point(|old| self.comes_first(old, &new));
        let is_known =
            |old: &Found<'_>| old.hit.surface == new.hit.surface && old.segment.span == new.segment.span;
        if !found.get(place).is_some_and(is_known) {
            found.insert(place, new);
        }
    }

    /// Whether one hit comes before another: exactly, and of hits in one place that with the lower shape, then the lower facet.
    fn comes_first(&self, a: &Found<'_>, b: &Found<'_>) -> bool {
        let order = a.hit.crossing.order(
            &b.hit.crossing,
            || self.are_met_together(&a.segment, a.hit.surface, b.hit.surface),
            || [a, b].map(|found| self.root(&found.segment, found.hit.surface)),
            || [a, b].map(|found| self.root(&found.segment, found.hit.surface)),
        );
        let same = order == Ordering::Equal && a.hit.surface == b.hit.surface;
        comes_first(order, a.hit.surface, b.hit.surface) || (same && a.hit.crossing.t < b.hit.crossing.t)
    }

    /// Every meeting of a segment with one shape, with the span of which it is the first on its piece.
    fn cross_everywhere(&self, prim: u32, segment: &RaySegment<'_>, keep: &mut impl FnMut(Span, Hit)) {
        let RaySegment { ray, span, leaving, .. } = *segment;
        let mut keep = |span: Span, crossing: Crossing| {
            keep(span, Hit { surface: SurfaceId { prim, facet: crossing.facet }, crossing });
        };
        if let Some(member) = self.member(segment, prim) {
            let left = self.left(prim, leaving);
            return each_crossing(span, |span| member.cross(ray, span, left), &mut keep);
        }
        let (shape, left) = (self.shape(segment, prim), leaving_facet(prim, leaving));
        let tree = self.prims[prim as usize].mesh.map(|tree| &self.index.meshes[tree as usize].tree);
        let Some((tree, mesh)) = tree.zip(shape.as_mesh()) else {
            for piece in 0..shape.pieces() {
                each_crossing(span, |span| shape.cross_part(piece, ray, span, left), &mut keep);
            }
            return;
        };
        let own = Geometry::own_ray(mesh, ray);
        tree.walk(&own, span, |triangle| {
            if let Some(crossing) = Geometry::cross_piece(mesh, triangle, &own, span, left) {
                keep(span, crossing);
            }
            span.max
        });
    }

    /// How a hit looks that is known to lie at `t`; `None` without a normal.
    pub(crate) fn crossing_on(
        &self,
        segment: &RaySegment<'_>,
        surface: SurfaceId,
        t: f64,
    ) -> Option<Crossing> {
        // Only the solid knows on which of its sides a member's surface is.
        let near = Span { min: t - NEAR * t.abs(), max: t + NEAR * t.abs() };
        let of_solid =
            self.member(segment, surface.prim).and_then(|part| part.cross(segment.ray, near, None));
        of_solid.or_else(|| self.shape(segment, surface.prim).crossing(segment.ray, t, surface.facet))
    }
}

/// Shows every crossing on a span, with the part of it of which that is the first.
fn each_crossing(
    mut span: Span,
    cross: impl Fn(Span) -> Option<Crossing>,
    keep: &mut impl FnMut(Span, Crossing),
) {
    while let Some(crossing) = cross(span) {
        keep(span, crossing);
        span.min = crossing.latest();
    }
}
