//! Rays side by side: those to the sun.
//!
//! The place of a ray is where it crosses the plane across the main axis, and depths are counted from there: all is sheared, so
//! that the rays become parallel to that axis. An edge of (e, f) across it, through (p, q), is the line (f, −e, e q − f p).

use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use super::bundle::Bundle;
use super::bundled_rays::BundledRays;
use super::common::{Common, Eight3, Sides};
use super::edges::{Around, Prepared, cross, dot, largest, seen, stored};
use super::planes::Plane;
use super::ray_bundle::{Aim, component};
use super::{LeafBlock, bound_eight};
use crate::accel::WIDTH;
use crate::lanes::{D, D3, F, M, MulAdd8, U, vector_of};
use crate::numeric::{
    BUNDLE_DEPTH, BUNDLE_PLANE, PARALLEL_EDGE, PARALLEL_PLACE, PARALLEL_SLOPE, PARALLEL_TOP, PARALLEL_WIDE,
    PRECISE_PARALLEL_SLOPE, PRECISE_PARALLEL_TOP,
};

/// A direction that rays run in.
pub(crate) struct CommonDirection {
    /// How far along the axes of places rays get per length along the main axis; at most 1.
    lean: [f32; 2],
    precise_lean: DVec2,
    /// How far places and depths may be off, beyond their own rounding.
    off: f32,
    /// The same of places with that.
    error: f32,
    /// At most the depth at which any ray begins.
    least: f32,
}

/// Where rays begin that run one way, and the triangles that they leave.
pub(crate) struct Starts<S: Simd> {
    pub(crate) origin: D3<S>,
    /// How far origins may be off along every axis.
    pub(crate) off: F<S>,
    pub(crate) live: M<S>,
    pub(crate) leaving: U<S>,
}

/// What the bounds of edges grow with.
pub(crate) struct RayBounds {
    places: Around,
    /// The largest places.
    most: [f32; 2],
}

/// The plane of a triangle: the depth at a place (u, v) is its product with (u, v, 1).
pub(crate) struct PrecisePlane {
    depth: DVec3,
    /// What its error in `f64` grows with, beside what starts are off by; infinite where it is not known.
    errors: [f64; 2],
}

impl Bundle<CommonDirection> {
    /// Of rays that begin there and run in one direction, through a mesh whose corners' coordinates stay within `reach`, if there are
    /// any. Stores their places in `rays`. `spans` are those of a packet's rays as depths from their origins: between which
    /// they begin, and where they end and how far that may be off; it gets the depth per length.
    #[inline(always)]
    pub(crate) fn along<S: Simd>(
        s: S,
        rays: &mut [BundledRays<S>],
        starts: &[Starts<S>],
        direction: DVec3,
        reach: f32,
        spans: impl Fn(usize, F<S>) -> [[F<S>; 2]; 2],
    ) -> Option<Self> {
        let first = |starts: &Starts<S>| Some(vector_of(&starts.origin, starts.live.lanes().next()?));
        let (first, aim) = (starts.iter().find_map(first)?, Aim::of(direction));
        let [u, v, z] = aim.axes;
        let origin = aim.axes.map(|axis| first[axis] as f32 * aim.sign);
        let precise_lean = DVec2::new(direction[u], direction[v]) / direction[z];
        let zero = F::splat(s, 0.0);
        let (mut off, mut least) = (zero, F::splat(s, f32::MAX));
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        let scale = F::splat(s, direction[z].abs() as f32);
        for (packet, (rays, starts)) in rays.iter_mut().zip(starts).enumerate() {
            let from = |which: usize| {
                let own = component(&starts.origin, aim.axes[which]) * D::splat(s, aim.sign.into());
                own - D::splat(s, origin[which].into())
            };
            let depth = from(2);
            let place = |which: usize| {
                let place = from(which) - depth * D::splat(s, precise_lean[which]);
                F::pick(starts.live, place.narrow(), zero)
            };
            (rays.u, rays.v) = (place(0), place(1));
            let largest =
                starts.origin.x.abs().max(starts.origin.y.abs()).max(starts.origin.z.abs()).narrow();
            let error = starts.off.mul_add(F::splat(s, 2.5), largest * F::splat(s, PARALLEL_WIDE));
            let depth = depth.narrow();
            let depth_error = depth.abs().mul_add(F::splat(s, BUNDLE_DEPTH), error);
            let [begin, [end, end_error]] = spans(packet, scale);
            rays.begin = [depth - depth_error + begin[0], depth + depth_error + begin[1]];
            let (end, end_error) = (depth + end, depth_error + end_error);
            rays.end = [end - end_error, end + end_error];
            let most = F::splat(s, f32::MAX);
            let known = rays.u.abs().less(most) & rays.v.abs().less(most) & rays.begin[1].abs().less(most);
            if (starts.live & !known).any() {
                return None;
            }
            off = F::pick(starts.live, off.max(error), off);
            least = F::pick(starts.live, least.min(rays.begin[0]), least);
            rays.follow_from(s, starts, scale);
            for axis in 0..2 {
                low[axis] = low[axis].min(rays.around[0][axis]);
                high[axis] = high[axis].max(rays.around[1][axis]);
            }
        }
        let off = off.0.reduce_max();
        let most = low.iter().chain(&high).fold(0.0_f32, |most, at| most.max(at.abs()));
        let common = CommonDirection {
            lean: precise_lean.as_vec2().to_array(),
            precise_lean,
            off,
            error: PARALLEL_PLACE * most + off,
            least: least.0.reduce_min(),
        };
        Some(Self::new(&aim, origin, [low, high], [reach, 0.0], common))
    }
}

impl<S: Simd> BundledRays<S> {
    /// Begins a search from there, with so much depth per length.
    #[inline(always)]
    fn follow_from(&mut self, s: S, starts: &Starts<S>, scale: F<S>) {
        let (u, v) = (self.u.0, self.v.0);
        self.around = [[u.reduce_min(), v.reduce_min()], [u.reduce_max(), v.reduce_max()]];
        (self.live, self.leaving, self.scale) = (starts.live, starts.leaving, scale);
        (self.slot, self.decided) = (U::splat(s, u32::MAX), 0);
    }
}

impl CommonDirection {
    /// Vectors sheared.
    #[inline(always)]
    fn sheared<S: Simd>(&self, s: S, [x, y, z]: Eight3<S>) -> Eight3<S> {
        let [lean_u, lean_v] = self.lean.map(|lean| f32x8::splat(s, -lean));
        [z.fused(lean_u, x), z.fused(lean_v, y), z]
    }
}

impl Common for CommonDirection {
    type RayBounds = RayBounds;
    type PrecisePlane = PrecisePlane;

    #[inline(always)]
    fn error(&self) -> f32 {
        self.error
    }

    #[inline(always)]
    fn sides<S: Simd>(&self, s: S, _: &Bundle<Self>, rows: &[[f32x8<S>; 2]; 3]) -> Sides<S> {
        let [u, v, [near, away]] = *rows;
        let wider = f32x8::splat(s, self.error);
        let (mut low, mut high) = ([u[0], v[0]], [u[1], v[1]]);
        for which in 0..2 {
            let lean = self.lean[which];
            let (of_low, of_high) = if lean > 0.0 { (away, near) } else { (near, away) };
            low[which] = of_low.fused(f32x8::splat(s, -lean), low[which]) - wider;
            high[which] = of_high.fused(f32x8::splat(s, -lean), high[which]) + wider;
        }
        Sides { low, high, near: near.max(f32x8::splat(s, self.least)), away }
    }

    fn ray_bounds(&self, bundle: &Bundle<Self>) -> RayBounds {
        RayBounds { places: Around::of(bundle.widened([bundle.low, bundle.high])), most: bundle.steepest() }
    }

    #[inline(always)]
    fn prepare<S: Simd>(
        &self,
        s: S,
        bundle: &Bundle<Self>,
        leaf: &LeafBlock<'_>,
        ray_bounds: &RayBounds,
    ) -> Option<(Prepared, u64)> {
        let [raw, [from, b, c]] = bundle.triangles(s, leaf);
        let edges = [self.sheared(s, raw[0]), self.sheared(s, raw[1]), self.sheared(s, raw[2])];
        let (p, q, r) = (self.sheared(s, from), self.sheared(s, b), self.sheared(s, c));
        let lines = [line(edges[0], q), line(edges[1], r), line(edges[2], p)];
        // The sizes of edges, and how far places and corners lie from each other.
        let size = largest(raw);
        let far = size[2] + from[2].abs();
        let [across_u, across_v] = [size[0] + size[2], size[1] + size[2]];
        let most = ray_bounds.most.map(|most| f32x8::splat(s, most));
        let apart_u = size[0] + from[0].abs() + far + most[0];
        let apart_v = size[1] + from[1].abs() + far + most[1];
        let (off, least) = (f32x8::splat(s, self.off), f32x8::splat(s, f32::MIN_POSITIVE));
        let of_starts = (across_u + across_v).fused(off, least);
        let both = across_u.fused(apart_v, across_v * apart_u);
        let edge_error = bound_eight(s, both.fused(f32x8::splat(s, PARALLEL_EDGE), of_starts));
        let seen = seen(s, &lines, edge_error, &ray_bounds.places) & leaf.own;
        if seen == 0 {
            return None;
        }
        let normal = cross(edges[1], edges[2]);
        let top = dot(p, normal);
        let doubled = size[2] + size[2];
        let areas = [across_v * doubled, across_u * doubled, (across_u + across_u) * across_v];
        let top_error = areas[0].fused(apart_u, areas[1].fused(apart_v, areas[2] * far));
        let of_starts = (areas[0] + areas[1]).fused(off, least);
        let top_error = top_error.fused(f32x8::splat(s, PARALLEL_TOP), of_starts);
        let slope_error = areas[2].fused(f32x8::splat(s, PARALLEL_SLOPE), least);
        let certain = (slope_error * f32x8::splat(s, 4.0)).simd_lt(normal[2].abs());
        let share = certain.select(f32x8::splat(s, 1.5) / normal[2].abs(), f32x8::splat(s, f32::INFINITY));
        let inverse = f32x8::splat(s, 1.0) / normal[2];
        let prepared = Prepared {
            edges: [stored(lines[0]), stored(lines[1]), stored(lines[2])],
            edge_error: edge_error.to_array(),
            normal: stored([-normal[0] * inverse, -normal[1] * inverse, top * inverse]),
            top: [0.0; WIDTH],
            depth_errors: [
                bound_eight(s, top_error * share).to_array(),
                bound_eight(s, slope_error.fused(share, f32x8::splat(s, BUNDLE_DEPTH))).to_array(),
            ],
        };
        Some((prepared, seen))
    }

    /// A plane N·x = N·p is crossed at the depth z = (N·p − N_u u − N_v v) / N_z. With errors of both it is off by at most (error of
    /// the numerator + z · error of N_z) / (|N_z| − error of N_z): three quarters of N_z are certain where that is four times its
    /// error. Then the error is a + z b.
    #[inline(always)]
    fn depths<S: Simd>(s: S, rays: &BundledRays<S>, plane: &Plane) -> [F<S>; 2] {
        let z = rays.value(s, plane.normal);
        [z, z.abs().mul_add(F::splat(s, plane.errors[1]), F::splat(s, plane.errors[0]))]
    }

    fn precise_plane(&self, bundle: &Bundle<Self>, corners: &[[f32; 3]; 3]) -> PrecisePlane {
        let [u, v, z] = bundle.axes;
        let [from_u, from_v, from_z] = bundle.origin.map(f64::from);
        let own = |p: &[f32; 3]| {
            let p = DVec3::new(p[u].into(), p[v].into(), p[z].into()) * f64::from(bundle.sign);
            p - DVec3::new(from_u, from_v, from_z)
        };
        let corners = [own(&corners[0]), own(&corners[1]), own(&corners[2])];
        let sheared = |p: DVec3| (p.truncate() - self.precise_lean * p.z).extend(p.z);
        let [e, f] = [corners[1] - corners[0], corners[2] - corners[0]];
        let size = e.abs().max(f.abs());
        let far = size + corners[0].abs();
        let normal = sheared(e).cross(sheared(f));
        let across = size.truncate() + DVec2::splat(size.z);
        let apart = far.truncate() + DVec2::splat(far.z) + DVec2::from(bundle.steepest().map(f64::from));
        let areas = DVec3::new(across.y * size.z, across.x * size.z, across.x * across.y) * 2.0;
        let top_error = PRECISE_PARALLEL_TOP * areas.dot(apart.extend(far.z));
        let slope_error = PRECISE_PARALLEL_SLOPE * areas.z;
        let certain = 4.0 * slope_error < normal.z.abs();
        let share = if certain { 1.5 / normal.z.abs() } else { f64::INFINITY };
        let top = normal.dot(sheared(corners[0]));
        PrecisePlane {
            depth: DVec3::new(-normal.x, -normal.y, top) / normal.z,
            errors: [top_error * share, slope_error * share],
        }
    }

    fn plane_of(&self, bundle: &Bundle<Self>, precise: &PrecisePlane) -> Plane {
        let PrecisePlane { depth, errors: [constant, per_depth] } = precise;
        let [most_u, most_v] = bundle.steepest().map(f64::from);
        let sizes = depth.abs();
        let rounding = f64::from(BUNDLE_PLANE) * sizes.dot(DVec3::new(most_u, most_v, 1.0));
        let of_starts = f64::from(self.off) * (sizes.x + sizes.y);
        let above = |error: f64| (error as f32).next_up();
        Plane {
            normal: depth.as_vec3().to_array(),
            top: 0.0,
            errors: [
                above(constant + rounding + of_starts + f64::from(f32::MIN_POSITIVE)),
                above(per_depth + f64::from(BUNDLE_DEPTH)),
            ],
        }
    }
}

/// The line of an edge through a corner.
#[inline(always)]
fn line<S: Simd>(edge: Eight3<S>, corner: Eight3<S>) -> Eight3<S> {
    [edge[1], -edge[0], edge[0].mul_sub_precise(corner[1], edge[1] * corner[0])]
}
