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
use crate::kernel::cross;
use crate::lanes::{D, D3, F, F3, M, U, narrow3, pick3, splat_wide};
use crate::snapshot::{Instance, Row};

/// Points and normals of the lanes that meet something.
#[derive(Clone, Copy)]
pub(super) struct Settled<S: Simd> {
    /// Relative to the snapshot's origin.
    pub(super) point: D3<S>,
    /// Geometric, of unit length, on the shape's outer side.
    pub(super) normal: D3<S>,
    /// To shade with, of unit length; `None` where the geometric one does for all lanes.
    pub(super) shading: Option<D3<S>>,
}

impl<S: Simd> Tracer<'_, S> {
    /// Settles the lanes of `mask`, which all meet the shape `prim`.
    #[inline(always)]
    pub(super) fn settle(&mut self, packet: &Packet<S>, best: &Best<S>, mask: M<S>, prim: u32) -> Settled<S> {
        let columns = self.frame.snapshot.columns();
        match columns.rows[prim as usize] {
            Row::Plane(row) => {
                let plane = &columns.planes[row as usize];
                self.settle_flat(packet, best, plane.normal, plane.distance)
            }
            Row::Rectangle(row) => {
                let plane = &columns.rectangles[row as usize].plane;
                self.settle_flat(packet, best, plane.normal, plane.distance)
            }
            Row::Sphere(row) => {
                let sphere = &columns.spheres[row as usize];
                self.settle_sphere(packet, best, sphere.center, sphere.radius)
            }
            Row::Triangles(first, _) => {
                let corners = |facet: u32| columns.triangles[(first + facet) as usize].corners;
                self.settle_triangles(packet, best, mask, corners)
            }
            Row::Instance(row) => self.settle_mesh(packet, best, mask, &columns.instances[row as usize]),
            Row::General => self.settle_general(packet, mask, prim),
        }
    }

    #[inline(always)]
    fn settle_flat(
        &mut self,
        packet: &Packet<S>,
        best: &Best<S>,
        normal: DVec3,
        distance: f64,
    ) -> Settled<S> {
        let normal = splat_wide(self.s, normal);
        let point = self.step(packet, best, |p| {
            let slope = narrow3(normal).dot(packet.rays.direction);
            (normal.dot(p) - D::splat(self.s, distance), slope)
        });
        Settled { point, normal, shading: None }
    }

    #[inline(always)]
    fn settle_sphere(
        &mut self,
        packet: &Packet<S>,
        best: &Best<S>,
        center: DVec3,
        radius: f64,
    ) -> Settled<S> {
        let center = splat_wide(self.s, center);
        let point = self.step(packet, best, |p| {
            let from = p - center;
            let excess = from.dot(from) - D::splat(self.s, radius * radius);
            let slope = narrow3(from).dot(packet.rays.direction);
            (excess, slope + slope)
        });
        let normal = (point - center).scale(D::splat(self.s, 1.0 / radius));
        Settled { point, normal, shading: None }
    }

    /// The point where `residual`, which answers a signed distance-like value and its slope along the ray, vanishes.
    #[inline(always)]
    fn step(&self, packet: &Packet<S>, best: &Best<S>, residual: impl Fn(D3<S>) -> (D<S>, F<S>)) -> D3<S> {
        let t = (best.t * packet.inverse_length).widen();
        let near = packet.direction.scale_add(t, packet.origin);
        let (value, slope) = residual(near);
        let metres = -(value.narrow() / slope);
        packet.direction.scale_add((metres * packet.inverse_length).widen(), near)
    }

    /// Lanes on triangles, each on one of its own.
    #[inline(always)]
    fn settle_triangles(
        &mut self,
        packet: &Packet<S>,
        best: &Best<S>,
        mask: M<S>,
        corners: impl Fn(u32) -> [DVec3; 3],
    ) -> Settled<S> {
        let mut columns = [[0.0_f64; MOST_LANES]; 9];
        for lane in mask.lanes() {
            let corners = corners(best.facet.lane(lane));
            for (k, corner) in corners.iter().enumerate() {
                for axis in 0..3 {
                    columns[3 * k + axis][lane] = corner[axis];
                }
            }
        }
        let corner = |k: usize| {
            let axis = |axis: usize| D::load(self.s, &columns[3 * k + axis]);
            D3::new(axis(0), axis(1), axis(2))
        };
        let (a, b, c) = (corner(0), corner(1), corner(2));
        let normal = unit(self.s, cross(b - a, c - a));
        let point =
            self.step(packet, best, |p| (normal.dot(p - a), narrow3(normal).dot(packet.rays.direction)));
        Settled { point, normal, shading: None }
    }

    #[inline(always)]
    fn settle_mesh(
        &mut self,
        packet: &Packet<S>,
        best: &Best<S>,
        mask: M<S>,
        instance: &Instance,
    ) -> Settled<S> {
        let mesh = instance.tree.mesh();
        let Some(shape) = self.frame.snapshot.mesh_at(instance.prim) else {
            return self.settle_general(packet, mask, instance.prim);
        };
        if mesh.normals().is_none() {
            let placed = shape.placement();
            return self
                .settle_triangles(packet, best, mask, |facet| mesh.corners(facet).map(|p| placed.point(p)));
        }
        let mut lanes = LaneVectors::default();
        for lane in mask.lanes() {
            let own = shape.own_ray(&packet.ray(lane));
            if let Some(c) = shape.cross_one(
                &own,
                Span { min: f64::NEG_INFINITY, max: f64::INFINITY },
                best.facet.lane(lane),
            ) {
                lanes.set(lane, packet.ray(lane).at(c.t), c.normal, c.shading_normal);
            }
        }
        lanes.settled(self.s)
    }

    /// Lanes on a shape without a kernel.
    #[inline(always)]
    fn settle_general(&mut self, packet: &Packet<S>, mask: M<S>, prim: u32) -> Settled<S> {
        let mut lanes = LaneVectors::default();
        for lane in mask.lanes() {
            let (ray, leaving) = (packet.ray(lane), packet.leaving(lane));
            if let Some(hit) = self.frame.snapshot.cross_part(prim, None, &ray, Span::AHEAD, leaving) {
                let c = hit.crossing;
                lanes.set(lane, ray.at(c.t), c.normal, c.shading_normal);
            }
        }
        lanes.settled(self.s)
    }
}

/// Most lanes that any packet has.
const MOST_LANES: usize = 16;

/// Vectors filled lane by lane: points, normals, shading normals.
#[derive(Default)]
struct LaneVectors([[[f64; MOST_LANES]; 3]; 3]);

impl LaneVectors {
    fn set(&mut self, lane: usize, point: DVec3, normal: DVec3, shading: DVec3) {
        for (columns, v) in self.0.iter_mut().zip([point, normal, shading]) {
            for (column, c) in columns.iter_mut().zip(v.to_array()) {
                column[lane] = c;
            }
        }
    }

    #[inline(always)]
    fn settled<S: Simd>(&self, s: S) -> Settled<S> {
        let vector = |k: usize| {
            let axis = |axis: usize| D::load(s, &self.0[k][axis]);
            D3::new(axis(0), axis(1), axis(2))
        };
        Settled { point: vector(0), normal: vector(1), shading: Some(vector(2)) }
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
    /// What stands for lanes that meet nothing.
    #[inline(always)]
    pub(super) fn nothing(packet: &Packet<S>) -> Self {
        Self { point: packet.origin, normal: packet.direction, shading: None }
    }

    /// This one where the mask holds, else the other.
    #[inline(always)]
    pub(super) fn over(self, mask: M<S>, other: Self) -> Self {
        let shading = match (self.shading, other.shading) {
            (None, None) => None,
            (a, b) => Some(pick3(mask, a.unwrap_or(self.normal), b.unwrap_or(other.normal))),
        };
        Self {
            point: pick3(mask, self.point, other.point),
            normal: pick3(mask, self.normal, other.normal),
            shading,
        }
    }
}

/// A packet of which every lane knows the material it has met.
pub(super) struct Groups<S: Simd> {
    count: usize,
    lanes: [(M<S>, u32); MOST_LANES],
}

impl<S: Simd> Groups<S> {
    #[inline(always)]
    pub(super) fn new(s: S) -> Self {
        Self { count: 0, lanes: [(M::splat(s, false), 0); MOST_LANES] }
    }

    /// Adds lanes that wear a material.
    #[inline(always)]
    pub(super) fn add(&mut self, mask: M<S>, material: u32) {
        match self.lanes[..self.count].iter_mut().find(|(_, m)| *m == material) {
            Some(group) => group.0 = group.0 | mask,
            None => {
                self.lanes[self.count] = (mask, material);
                self.count += 1;
            }
        }
    }

    /// Lanes by material.
    #[inline(always)]
    pub(super) fn iter(&self) -> impl Iterator<Item = (M<S>, usize)> + '_ {
        self.lanes[..self.count].iter().map(|&(mask, material)| (mask, material as usize))
    }
}

/// Unused lanes of a column keep what they hold.
#[inline(always)]
pub(super) fn shading_of<S: Simd>(settled: &Settled<S>) -> F3<S> {
    narrow3(settled.shading.unwrap_or(settled.normal))
}

/// All lanes of one shape.
#[inline(always)]
pub(super) fn lanes_of<S: Simd>(prims: U<S>, hits: M<S>, prim: u32) -> M<S> {
    prims.is(prim) & hits
}
