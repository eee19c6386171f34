//! Points and normals of what the rays of a packet meet, in `f32`: enough to shade with.
//!
//! Whether something stands in the way of a light, and where a reflected ray starts, is decided from the `f64` point.

use fearless_simd::Simd;

use super::Searcher;
use super::hits::Hits;
use super::packet::{Packet, PreciseRays};
use crate::kernel::SphereRow;
use crate::lanes::{F, F3, M, narrow3, outlined, splat_wide, splat3};
use crate::snapshot::Row;

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
    /// The surface of the lanes of `mask`, which all meet the shape `prim`.
    #[inline(always)]
    pub(crate) fn surface<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        mask: M<S>,
        prim: u32,
    ) -> Surface<S> {
        let columns = self.snapshot.columns();
        let point = packet.point(best.t);
        match columns.rows[prim as usize] {
            Row::Plane(row) => Surface::flat(point, splat3(self.s, columns.planes[row as usize].normal32)),
            Row::Flat(row) => {
                Surface::flat(point, splat3(self.s, columns.flats[row as usize].plane.normal32))
            }
            Row::Sphere(row) => self.surface_of_sphere(packet, best, &columns.spheres[row as usize]),
            row @ (Row::Cuboid(_) | Row::Triangles(..)) => {
                let mut normal = point;
                for (facet, lanes) in best.facet.groups(mask) {
                    let Some(plane) = columns.plane_of(row, facet) else { continue };
                    normal = F3::select(lanes, splat3(self.s, plane.normal32), normal);
                }
                Surface::flat(point, normal)
            }
            Row::Instance(_) | Row::General => {
                let refined = self.refine_uncommon(packet, best, mask, prim);
                Surface {
                    point: narrow3(refined.point),
                    normal: narrow3(refined.normal),
                    shading: narrow3(refined.shading),
                }
            }
        }
    }

    /// Relative to the centre, where `f32` is fine enough for sharp highlights; one Newton step brings it there.
    #[inline(always)]
    pub(crate) fn surface_of_sphere<P: PreciseRays<S>>(
        &self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        sphere: &SphereRow,
    ) -> Surface<S> {
        let direction = packet.rays.direction;
        let near = self.near(packet, best);
        let from_center = narrow3(near - splat_wide(self.s, sphere.center));
        let radius2 = F::splat(self.s, (sphere.radius * sphere.radius) as f32);
        let slope = from_center.dot(direction);
        let metres = (radius2 - from_center.dot(from_center)) / (slope + slope);
        let normal = direction.scale_add(metres, from_center).scale(F::splat(self.s, sphere.inverse_radius));
        Surface::flat(direction.scale_add(metres, narrow3(near)), normal)
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
