//! Where exactly the rays of a packet meet what `f32` has found: points and normals in `f64`.
//!
//! One Newton step from the `f32` distance, evaluated in `f64`, leaves an error of second order: about 2⁻⁴⁵ relative
//! where the ray is not grazing, and grazing rays have been decided before.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, Span};
use fearless_simd::Simd;

use super::Searcher;
use super::hits::Hits;
use super::packet::{Packet, PreciseRays};
use crate::kernel::PlaneRow;
use crate::lanes::{D, D3, F, LaneVectors, M, cross, narrow3, outlined, pick3, splat_wide};
use crate::snapshot::{Instance, Row};

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
        let mut left = lanes.bits();
        let prim = best.prim.lane(left.trailing_zeros() as usize);
        let mut mask = lanes & best.prim.is(prim);
        let mut refined = self.refine(packet, best, mask, prim);
        left &= !mask.bits();
        while left != 0 {
            let prim = best.prim.lane(left.trailing_zeros() as usize);
            mask = lanes & best.prim.is(prim);
            refined = self.refine_too(packet, best, mask, prim, refined);
            left &= !mask.bits();
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
        match columns.rows[prim as usize] {
            Row::Plane(row) => {
                let plane = &columns.planes[row as usize];
                self.refine_on_plane(packet, best, plane)
            }
            Row::Sphere(row) => {
                let sphere = &columns.spheres[row as usize];
                self.refine_on_sphere(packet, best, sphere.center, sphere.radius)
            }
            _ => self.refine_uncommon(packet, best, mask, prim),
        }
    }

    /// As [`refine`](Self::refine), of shapes that are less common. See [`outlined`].
    #[inline(always)]
    pub(crate) fn refine_uncommon<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        mask: M<S>,
        prim: u32,
    ) -> Refined<S> {
        let (packet, best) = (*packet, *best);
        outlined(
            self.s,
            #[inline(always)]
            || self.refine_facets(&packet, &best, mask, prim),
        )
    }

    #[inline(always)]
    fn refine_facets<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        mask: M<S>,
        prim: u32,
    ) -> Refined<S> {
        let columns = self.snapshot.columns();
        match columns.rows[prim as usize] {
            Row::Flat(row) => {
                let plane = &columns.flats[row as usize].plane;
                self.refine_on_plane(packet, best, plane)
            }
            row @ (Row::Cuboid(_) | Row::Triangles(..)) => {
                let none = D::splat(self.s, 0.0);
                let (mut normal, mut distance) = (D3::splat(none), none);
                for (facet, lanes) in best.facet.groups(mask) {
                    let Some(plane) = columns.plane_of(row, facet) else { continue };
                    normal = pick3(lanes, splat_wide(self.s, plane.normal), normal);
                    distance = D::pick(lanes, D::splat(self.s, plane.distance), distance);
                }
                self.refine_on_planes(packet, best, normal, distance)
            }
            Row::Instance(row) => self.refine_on_mesh(packet, best, mask, &columns.instances[row as usize]),
            Row::General | Row::Plane(_) | Row::Sphere(_) => self.refine_general(packet, mask, prim),
        }
    }

    #[inline(always)]
    fn refine_on_plane<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        plane: &PlaneRow,
    ) -> Refined<S> {
        let (normal, distance) = (splat_wide(self.s, plane.normal), D::splat(self.s, plane.distance));
        self.refine_on_planes(packet, best, normal, distance)
    }

    /// Lanes on planes of their own, `normal · p = distance`.
    #[inline(always)]
    fn refine_on_planes<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        normal: D3<S>,
        distance: D<S>,
    ) -> Refined<S> {
        let near = self.near(packet, best);
        let off = normal.dot(near) - distance;
        let slope = narrow3(normal).dot(packet.rays.direction);
        let point = self.step(packet, near, off.narrow(), slope);
        Refined { point, normal, shading: normal }
    }

    #[inline(always)]
    fn refine_on_sphere<P: PreciseRays<S>>(
        &mut self,
        packet: &Packet<'_, S, P>,
        best: &Hits<S>,
        center: DVec3,
        radius: f64,
    ) -> Refined<S> {
        let center = splat_wide(self.s, center);
        let near = self.near(packet, best);
        let from = near - center;
        let off = from.dot(from) - D::splat(self.s, radius * radius);
        let slope = narrow3(from).dot(packet.rays.direction);
        let point = self.step(packet, near, off.narrow(), slope + slope);
        let normal = (point - center).scale(D::splat(self.s, 1.0 / radius));
        Refined { point, normal, shading: normal }
    }

    /// The points at the distances that `f32` has found.
    #[inline(always)]
    pub(crate) fn near<P: PreciseRays<S>>(&self, packet: &Packet<'_, S, P>, best: &Hits<S>) -> D3<S> {
        let (origin, direction) = packet.precise(self.s);
        direction.scale_add((best.t * packet.inverse_length).widen(), origin)
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
        let at_corners = |of: &[[f32; 3]]| instance.at_corners(self.s, best.facet, mask, of).wide();
        let [a, b, c] = at_corners(mesh.positions());
        let (e, f) = (b - a, c - a);
        let across = cross(e, f);
        let own_normal = unit(self.s, across);
        let near = self.near(packet, best);
        let off = own_normal.dot(instance.own_points(self.s, near) - a).narrow();
        let off = off * F::splat(self.s, 1.0 / instance.scale());
        let normal = instance.world_normals(self.s, own_normal);
        let point = self.step(packet, near, off, narrow3(normal).dot(packet.rays.direction));
        let Some(normals) = mesh.normals() else { return Refined { point, normal, shading: normal } };
        let from = instance.own_points(self.s, point) - a;
        let weights = [across.dot(cross(from, f)), across.dot(cross(e, from))];
        let [of_b, of_c] = weights.map(|weight| weight / across.dot(across));
        let [at_a, at_b, at_c] = at_corners(normals);
        let blend = (at_c - at_a).scale_add(of_c, (at_b - at_a).scale_add(of_b, at_a));
        // Normals that cancel out tell nothing, nor does NaN.
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

/// The vector over its length: an `f32` estimate and one Newton step in `f64`.
#[inline(always)]
fn unit<S: Simd>(s: S, v: D3<S>) -> D3<S> {
    // Scaled by its largest coordinate first, so that tiny triangles do not underflow in `f32`.
    let largest = v.x.abs().max(v.y.abs()).max(v.z.abs());
    let v = v.scale(D::splat(s, 1.0) / largest);
    let length2 = v.dot(v);
    let estimate = (F::splat(s, 1.0) / length2.narrow().sqrt()).widen();
    let half = D::splat(s, 0.5) * length2;
    let inverse = estimate * (-(half * estimate)).mul_add(estimate, D::splat(s, 1.5));
    v.scale(inverse)
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
