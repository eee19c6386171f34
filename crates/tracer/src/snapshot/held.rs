//! What holds a point in space, and what blocks rays from there? Surfaces on which a point lies are left by every ray from it.

use catoptra_core::contour::{facet_holds, facets_that_hold};
use catoptra_core::glam::DVec3;
use catoptra_core::numeric::HELD_WITHIN;
use catoptra_core::{Geometry, Ray, Span};

use super::search::RaySegment;
use super::{Prim, Snapshot, SurfaceId};
use crate::numeric::BOUNDS_ERROR;

/// Boxes are looked into at most so far beside a point, given the size of all coordinates: [`facet_holds`] counts with that of
/// the point, of a middle and of a radius, and a point carried over into a shape's own space is off by [`BOUNDS_ERROR`].
fn reach(size: f64) -> f64 {
    (4.0 * HELD_WITHIN + BOUNDS_ERROR) * size
}

impl Snapshot {
    /// Sets `held` to the facets that hold a point in the snapshot's frame, but for rounding, sorted.
    pub(crate) fn find_holding(&self, point: DVec3, held: &mut Vec<SurfaceId>) {
        held.clear();
        for &prim in &self.index.unbounded {
            self.add_holding(prim, point, held);
        }
        let origin = self.origin_in_frame();
        let size = self.index.tree.nodes.first().map_or(0.0, |root| root.bounds.largest());
        let reach = reach(size + origin.abs().max_element() + point.abs().max_element());
        self.index.tree.around(point - origin, reach, |item| {
            self.add_holding(self.index.bounded[item as usize], point, held);
        });
        held.sort_unstable_by_key(|surface| (surface.prim, surface.facet));
        held.dedup();
    }

    fn add_holding(&self, prim: u32, point: DVec3, held: &mut Vec<SurfaceId>) {
        let Prim { shape, member: None, .. } = &self.prims[prim as usize] else { return };
        let add = |facet: u32| {
            if facet_holds(shape, facet, point) {
                held.push(SurfaceId { prim, facet });
            }
        };
        match (shape.as_mesh(), self.prims[prim as usize].mesh) {
            (Some(mesh), Some(tree)) => {
                let own = mesh.to_object().point(point);
                let bounds = mesh.triangles().bounds();
                let size = bounds.min.abs().max(bounds.max.abs()).max_element();
                let placed = point.abs().max_element() * mesh.to_object().scale();
                self.index.meshes[tree as usize].tree.around(own, reach(size + placed), add);
            }
            _ => (0..facets_that_hold(shape)).for_each(add),
        }
    }

    /// As [`occluded`](Self::occluded), for a ray that leaves all of the surfaces that hold its origin.
    pub(crate) fn is_occluded_beside(&self, ray: &Ray, span: Span, held: &[SurfaceId]) -> bool {
        let segment = RaySegment::new(ray, span, None);
        self.any_in_the_way(&segment, |prim| {
            let mut own = held.iter().filter(|surface| surface.prim == prim).map(|surface| surface.facet);
            match own.next() {
                None => self.cross(prim, &segment).is_some(),
                Some(first) => self.blocks_beside(prim, &segment, std::iter::once(first).chain(own)),
            }
        })
    }

    /// Whether a shape blocks a ray that leaves some facets of it.
    fn blocks_beside(
        &self,
        prim: u32,
        segment: &RaySegment<'_>,
        mut left: impl Iterator<Item = u32> + Clone,
    ) -> bool {
        let shape = &self.prims[prim as usize].shape;
        let (Some(mesh), Some(tree)) = (shape.as_mesh(), self.prims[prim as usize].mesh) else {
            // A ray that leaves a solid by any of its faces does not meet it again.
            return left.all(|facet| shape.cross(segment.ray, segment.span, Some(facet)).is_some());
        };
        let (own, mut found) = (mesh.own_ray(segment.ray), false);
        self.index.meshes[tree as usize].tree.walk(&own, segment.span, |triangle| {
            let other = !left.clone().any(|facet| facet == triangle);
            found = found || other && mesh.cross_piece(triangle, &own, segment.span, None).is_some();
            if found { f64::NEG_INFINITY } else { segment.span.max }
        });
        found
    }
}
