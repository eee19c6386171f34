//! Where exactly the rays of a packet meet what `f32` has found: points and normals in `f64`.
//!
//! One Newton step from the `f32` distance, evaluated in `f64`, leaves an error of second order: about 2⁻⁴⁵ relative
//! where the ray is not grazing, and grazing rays have been settled before.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, Span};
use fearless_simd::Simd;

use super::Tracer;
use super::packet::Packet;
use super::search::Best;
use crate::kernel::{PlaneRow, cross};
use crate::lanes::{D, D3, F, LaneVectors, M, MOST_LANES, narrow3, pick3, splat_wide};
use crate::snapshot::{Instance, Row};

/// Points and normals of the lanes that meet something, in `f64`.
#[derive(Clone, Copy)]
pub(super) struct Settled<S: Simd> {
    /// Relative to the snapshot's origin.
    pub(super) point: D3<S>,
    /// Geometric, of unit length, on the shape's outer side.
    pub(super) normal: D3<S>,
    /// To shade with, of unit length.
    pub(super) shading: D3<S>,
}

impl<S: Simd> Tracer<'_, S> {
    /// Settles the lanes of `mask`, which all meet the shape `prim`.
    #[inline(always)]
    pub(super) fn settle(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        mask: M<S>,
        prim: u32,
    ) -> Settled<S> {
        let columns = self.frame.snapshot.columns();
        match columns.rows[prim as usize] {
            Row::Plane(row) => {
                let plane = &columns.planes[row as usize];
                self.settle_flat(packet, best, plane)
            }
            Row::Sphere(row) => {
                let sphere = &columns.spheres[row as usize];
                self.settle_sphere(packet, best, sphere.center, sphere.radius)
            }
            _ => self.settle_facets(packet, best, mask, prim),
        }
    }

    /// As [`settle`](Self::settle), of shapes that are less common. Compiled apart, on copies.
    #[inline(always)]
    pub(super) fn settle_facets(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        mask: M<S>,
        prim: u32,
    ) -> Settled<S> {
        let (packet, best) = (*packet, *best);
        self.s.vectorize(
            #[inline(always)]
            || self.settle_each_facet(&packet, &best, mask, prim),
        )
    }

    #[inline(always)]
    fn settle_each_facet(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        mask: M<S>,
        prim: u32,
    ) -> Settled<S> {
        let columns = self.frame.snapshot.columns();
        match columns.rows[prim as usize] {
            Row::Flat(row) => {
                let plane = &columns.flats[row as usize].plane;
                self.settle_flat(packet, best, plane)
            }
            row @ (Row::Cuboid(_) | Row::Triangles(..)) => {
                let none = D::splat(self.s, 0.0);
                let (mut normal, mut distance) = (D3::splat(none), none);
                for (facet, lanes) in best.facet.groups(mask) {
                    let Some(plane) = columns.plane_of(row, facet) else { continue };
                    normal = pick3(lanes, splat_wide(self.s, plane.normal), normal);
                    distance = D::pick(lanes, D::splat(self.s, plane.distance), distance);
                }
                self.settle_on_planes(packet, best, normal, distance)
            }
            Row::Instance(row) => self.settle_mesh(packet, best, mask, &columns.instances[row as usize]),
            Row::General | Row::Plane(_) | Row::Sphere(_) => self.settle_general(packet, mask, prim),
        }
    }

    #[inline(always)]
    fn settle_flat(&mut self, packet: &Packet<'_, S>, best: &Best<S>, plane: &PlaneRow) -> Settled<S> {
        let (normal, distance) = (splat_wide(self.s, plane.normal), D::splat(self.s, plane.distance));
        self.settle_on_planes(packet, best, normal, distance)
    }

    /// Lanes on planes of their own, `normal · p = distance`.
    #[inline(always)]
    fn settle_on_planes(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        normal: D3<S>,
        distance: D<S>,
    ) -> Settled<S> {
        let near = self.near(packet, best);
        let off = normal.dot(near) - distance;
        let slope = narrow3(normal).dot(packet.rays.direction);
        let point = self.step(packet, near, off.narrow(), slope);
        Settled { point, normal, shading: normal }
    }

    #[inline(always)]
    fn settle_sphere(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        center: DVec3,
        radius: f64,
    ) -> Settled<S> {
        let center = splat_wide(self.s, center);
        let near = self.near(packet, best);
        let from = near - center;
        let off = from.dot(from) - D::splat(self.s, radius * radius);
        let slope = narrow3(from).dot(packet.rays.direction);
        let point = self.step(packet, near, off.narrow(), slope + slope);
        let normal = (point - center).scale(D::splat(self.s, 1.0 / radius));
        Settled { point, normal, shading: normal }
    }

    /// The points at the distances that `f32` has found.
    #[inline(always)]
    pub(super) fn near(&self, packet: &Packet<'_, S>, best: &Best<S>) -> D3<S> {
        let (origin, direction) = packet.precise(self.s);
        direction.scale_add((best.t * packet.inverse_length).widen(), origin)
    }

    /// One Newton step along the rays from where a value is `off` and changes by `slope` a metre to where it is 0.
    #[inline(always)]
    fn step(&self, packet: &Packet<'_, S>, near: D3<S>, off: F<S>, slope: F<S>) -> D3<S> {
        let metres = -(off / slope);
        let (_, direction) = packet.precise(self.s);
        direction.scale_add((metres * packet.inverse_length).widen(), near)
    }

    /// Lanes on triangles of a mesh, in the mesh's own space.
    #[inline(always)]
    fn settle_mesh(
        &mut self,
        packet: &Packet<'_, S>,
        best: &Best<S>,
        mask: M<S>,
        instance: &Instance,
    ) -> Settled<S> {
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
        let Some(normals) = mesh.normals() else { return Settled { point, normal, shading: normal } };
        let from = instance.own_points(self.s, point) - a;
        let weights = [across.dot(cross(from, f)), across.dot(cross(e, from))];
        let [of_b, of_c] = weights.map(|weight| weight / across.dot(across));
        let [at_a, at_b, at_c] = at_corners(normals);
        let blend = (at_c - at_a).scale_add(of_c, (at_b - at_a).scale_add(of_b, at_a));
        // Normals that cancel out tell nothing, nor does NaN.
        let (zero, size) = (D::splat(self.s, 0.0), blend.dot(blend));
        let some = zero.at_most(size) & !size.at_most(zero);
        let shading = pick3(some, unit(self.s, blend), own_normal);
        Settled { point, normal, shading: instance.world_normals(self.s, shading) }
    }

    /// Lanes on a shape without a kernel.
    #[inline(always)]
    fn settle_general(&mut self, packet: &Packet<'_, S>, mask: M<S>, prim: u32) -> Settled<S> {
        let [mut points, mut normals, mut shading] = [(); 3].map(|()| LaneVectors::default());
        for lane in mask.lanes() {
            let (ray, leaving) = (packet.ray(lane), packet.leaving(lane));
            if let Some(hit) = self.frame.snapshot.cross_part(prim, None, &ray, Span::AHEAD, leaving) {
                let c = hit.crossing;
                points.set(lane, ray.at(c.t) - self.frame.snapshot.origin_in_frame());
                normals.set(lane, c.normal);
                shading.set(lane, c.shading_normal);
            }
        }
        let s = self.s;
        Settled { point: points.load(s), normal: normals.load(s), shading: shading.load(s) }
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

impl<S: Simd> Settled<S> {
    /// This one where the mask holds, else the other.
    #[inline(always)]
    pub(super) fn over(self, mask: M<S>, other: Self) -> Self {
        Self {
            point: pick3(mask, self.point, other.point),
            normal: pick3(mask, self.normal, other.normal),
            shading: pick3(mask, self.shading, other.shading),
        }
    }
}

/// The lanes of a packet by the material they have met: read and written in place, element by element.
pub(super) struct Groups {
    count: usize,
    lanes: [u64; MOST_LANES],
    materials: [u32; MOST_LANES],
}

impl Groups {
    /// No lanes.
    pub(super) const NONE: Self = Self { count: 0, lanes: [0; MOST_LANES], materials: [0; MOST_LANES] };

    /// Forgets all lanes.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds lanes that wear a material.
    #[inline(always)]
    pub(super) fn add(&mut self, lanes: u64, material: u32) {
        for group in 0..self.count {
            if self.materials[group] == material {
                self.lanes[group] |= lanes;
                return;
            }
        }
        (self.lanes[self.count], self.materials[self.count]) = (lanes, material);
        self.count += 1;
    }

    /// How many materials there are.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Lanes and material of a group.
    #[inline(always)]
    pub(super) fn get<S: Simd>(&self, s: S, group: usize) -> (M<S>, usize) {
        (M::from_bits(s, self.lanes[group]), self.materials[group] as usize)
    }
}
