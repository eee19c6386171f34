//! Rays through one point: those of a camera, and backwards those to a point light.
//!
//! The place of a ray are its slopes over the axis that all rays run along. An edge e that is seen from the common origin in
//! the direction p spans the plane n = e × p, which is the edge's line.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use super::bundle::Bundle;
use super::bundled_rays::BundledRays;
use super::common::{Common, Sides};
use super::edges::{Around, Prepared, cross, dot, largest, products, seen, stored, weighted};
use super::planes::Plane;
use super::ray_bundle::Aim;
use super::{LeafBlock, bound_eight};
use crate::lanes::{F, MulAdd8};
use crate::numeric::{
    BUNDLE_BOX, BUNDLE_DEPTH, BUNDLE_EDGE, BUNDLE_PLANE, BUNDLE_SLOPE, BUNDLE_TOP, ORDER_ERROR, ORDER_SHEAR,
    PRECISE_SLOPE_ERROR, PRECISE_TOP_ERROR,
};

/// A point that rays pass through, more or less.
pub(crate) struct CommonOrigin {
    /// How far a ray may pass it by.
    slack: f32,
    /// The point in `f64`, mirrored as the rays are, and how far a ray may pass that by.
    precise: DVec3,
    precise_slack: f32,
    /// How far slopes may be off beyond their own rounding.
    slopes_off: f32,
}

/// What the bounds of edges grow with.
pub(crate) struct RayBounds {
    slopes: Around,
    /// Errors of an edge's value per size of its plane's components, axis by axis, and per length of the edge.
    shares: [f32; 3],
    beside: f32,
}

/// The plane of a triangle in `f64`, seen from the common origin.
pub(crate) struct PrecisePlane {
    normal: DVec3,
    top: f64,
    /// Errors of both from `f64`: of the normal times a direction, and of the top.
    slope_error: f64,
    top_error: f64,
    /// Square of the triangle's largest extent.
    size: f64,
    /// Depth of its deepest corner.
    deepest: f64,
}

impl Bundle<CommonOrigin> {
    /// Rays within a box of slopes, each at most 2 in magnitude, that pass a point by at most `slack`; through a mesh
    /// whose corners' coordinates stay within `reach`.
    pub(super) fn through(aim: &Aim, origin: DVec3, slack: f32, slopes: [[f32; 2]; 2], reach: f32) -> Self {
        let ([u, v, z], sign) = (aim.axes, f64::from(aim.sign));
        let precise = DVec3::new(origin[u] * sign, origin[v] * sign, origin[z] * sign);
        let rounded = precise.as_vec3();
        let off = (precise - rounded.as_dvec3()).abs().max_element() as f32;
        let (precise_slack, slack) = (slack, (slack + off).next_up());
        let common = CommonOrigin { slack, precise, precise_slack, slopes_off: 0.0 };
        Self::new(aim, rounded.to_array(), slopes, [reach, 4.0 * slack], common)
    }

    /// The same with slopes that may be off by `more` beside.
    pub(crate) fn with_slopes_off(mut self, more: f32) -> Self {
        self.common.slopes_off += more;
        self
    }

    /// At most the size of any ray's slopes, and the 1 along the main axis.
    fn spread(&self) -> DVec3 {
        let [u, v] = self.steepest().map(f64::from);
        DVec3::new(u, v, 1.0)
    }
}

impl CommonOrigin {
    /// How far the tops of rays may lie from the point's.
    fn top_error(&self, plane: &PrecisePlane) -> f64 {
        f64::from(self.precise_slack) * plane.normal.abs().element_sum() + plane.top_error
    }
}

impl Common for CommonOrigin {
    type RayBounds = RayBounds;
    type PrecisePlane = PrecisePlane;

    #[inline(always)]
    fn error(&self) -> f32 {
        self.slopes_off + 3.0 * BUNDLE_SLOPE
    }

    #[inline(always)]
    fn sides<S: Simd>(&self, s: S, _: &Bundle<Self>, rows: &[[f32x8<S>; 2]; 3]) -> Sides<S> {
        let (one, zero) = (f32x8::splat(s, 1.0), f32x8::splat(s, 0.0));
        let [u, v, [near, away]] = *rows;
        let near = near.max(zero);
        let (of_near, of_away) = (one / near, one / away);
        let wider = f32x8::splat(s, BUNDLE_BOX + BUNDLE_SLOPE + self.slopes_off);
        let low = [u[0], v[0]].map(
            #[inline(always)]
            |low| low * low.simd_lt(zero).select(of_near, of_away) - wider,
        );
        let high = [u[1], v[1]].map(
            #[inline(always)]
            |high| high * high.simd_lt(zero).select(of_away, of_near) + wider,
        );
        Sides { low, high, near, away }
    }

    fn ray_bounds(&self, bundle: &Bundle<Self>) -> RayBounds {
        let most = bundle.steepest();
        RayBounds {
            slopes: Around::of(bundle.widened([bundle.low, bundle.high])),
            shares: [
                BUNDLE_EDGE * most[0] + self.slopes_off,
                BUNDLE_EDGE * most[1] + self.slopes_off,
                BUNDLE_EDGE,
            ],
            beside: 2.0 * (1.0 + most[0] + most[1]) * self.slack,
        }
    }

    #[inline(always)]
    fn prepare<S: Simd>(
        &self,
        s: S,
        bundle: &Bundle<Self>,
        leaf: &LeafBlock<'_>,
        ray_bounds: &RayBounds,
    ) -> Option<(Prepared, u64)> {
        let [edges, [p, q, r]] = bundle.triangles(s, leaf);
        let planes = [cross(edges[0], q), cross(edges[1], r), cross(edges[2], p)];
        // Each axis counts with its own sizes: rays run mostly along one, and edges often along few.
        let size = largest(edges);
        let far = [p[0].abs() + size[0], p[1].abs() + size[1], p[2].abs() + size[2]];
        let length = size[0].max(size[1]).max(size[2]);
        let least = f32x8::splat(s, f32::MIN_POSITIVE);
        let of_point = length.fused(f32x8::splat(s, ray_bounds.beside), least);
        let edge_error = bound_eight(s, weighted(s, products(size, far), ray_bounds.shares, of_point));
        let seen = seen(s, &planes, edge_error, &ray_bounds.slopes) & leaf.own;
        if seen == 0 {
            return None;
        }
        let normal = cross(edges[1], edges[2]);
        let top = dot(p, normal);
        let areas = [size[1] * size[2], size[2] * size[0], size[0] * size[1]];
        let of_point = (length * length).fused(f32x8::splat(s, 6.0 * self.slack), least);
        let top_error = dot(areas, far).fused(f32x8::splat(s, 2.0 * BUNDLE_TOP), of_point);
        let slope_error = weighted(s, areas, ray_bounds.shares.map(|share| share + share), least);
        let deepest = p[2].max(q[2]).max(r[2]).max(f32x8::splat(s, 0.0)) + f32x8::splat(s, 2.0 * self.slack);
        let most = (deepest * f32x8::splat(s, 1.5)).fused(slope_error, top_error);
        let certain = (most * f32x8::splat(s, 4.0)).simd_lt(top.abs());
        let share = certain.select(f32x8::splat(s, 1.5) / top.abs(), f32x8::splat(s, f32::INFINITY));
        let of_square = bound_eight(s, slope_error * share);
        let of_depth = bound_eight(s, top_error.fused(share, f32x8::splat(s, BUNDLE_DEPTH)));
        let prepared = Prepared {
            edges: [stored(planes[0]), stored(planes[1]), stored(planes[2])],
            edge_error: edge_error.to_array(),
            normal: stored(normal),
            top: top.to_array(),
            depth_errors: [of_square.to_array(), of_depth.to_array()],
        };
        Some((prepared, seen))
    }

    /// A ray of slope s = n·(u, v, 1) crosses a plane at the depth z = top / s, where top is the common origin's distance from it
    /// along n. Off by errors of top and s, z is off by at most (z · error of s + error of top) / (|s| − error of s); and
    /// |s| is |top| / z. So the error is z (z a + b), where a and b are the errors of s and top over three quarters of
    /// |top|, as long as |top| is four times what z makes of them. On the triangle z is at most the depth of its deepest
    /// corner: whether that holds is known for all rays at once.
    #[inline(always)]
    fn depths<S: Simd>(s: S, rays: &BundledRays<S>, plane: &Plane) -> [F<S>; 2] {
        let z = F::splat(s, plane.top) / rays.value(s, plane.normal);
        let (of_square, of_depth) = (F::splat(s, plane.errors[0]), F::splat(s, plane.errors[1]));
        [z, z.abs() * z.abs().mul_add(of_square, of_depth)]
    }

    fn precise_plane(&self, bundle: &Bundle<Self>, corners: &[[f32; 3]; 3]) -> PrecisePlane {
        let [u, v, z] = bundle.axes;
        let own = |p: &[f32; 3]| DVec3::new(p[u].into(), p[v].into(), p[z].into()) * f64::from(bundle.sign);
        let [a, b, c] = [own(&corners[0]), own(&corners[1]), own(&corners[2])];
        let (e, f, from) = (b - a, c - a, a - self.precise);
        let normal = e.cross(f);
        let length = e.abs().max(f.abs()).max_element();
        let size = length * length;
        PrecisePlane {
            normal,
            top: normal.dot(from),
            slope_error: PRECISE_SLOPE_ERROR * bundle.spread().element_sum() * size,
            top_error: PRECISE_TOP_ERROR * size * from.abs().max_element(),
            size,
            deepest: (a.z.max(b.z).max(c.z) - self.precise.z).max(0.0) + 2.0 * f64::from(self.precise_slack),
        }
    }

    fn plane_of(&self, bundle: &Bundle<Self>, precise: &PrecisePlane) -> Plane {
        let PrecisePlane { normal, top, .. } = *precise;
        let size = normal.abs();
        let slope_error = f64::from(BUNDLE_PLANE) * size.dot(bundle.spread())
            + f64::from(self.slopes_off) * (size.x + size.y)
            + precise.slope_error;
        let top_error = self.top_error(precise);
        // A normal as large as a unit vector, so that `f32` holds those of tiny triangles as well.
        let scale = 1.0 / size.max_element();
        let rounded = (top * scale) as f32;
        let certain =
            4.0 * (1.5 * precise.deepest).mul_add(slope_error, top_error) < top.abs() && rounded.is_normal();
        let share = if certain { 1.5 / top.abs() } else { f64::INFINITY };
        let above = |error: f64| (error as f32).next_up();
        Plane {
            normal: (normal * scale).as_vec3().to_array(),
            top: rounded,
            errors: [above(slope_error * share), above(top_error * share + f64::from(BUNDLE_DEPTH))],
        }
    }

    /// A vector m whose product with a ray's direction is negative where the ray crosses one plane before another, both
    /// ahead of it, and positive where it does so behind; and the error of that product. None where the common origin may
    /// lie in either plane.
    ///
    /// Where both tops are positive, z₁ < z₂ means top₁ s₂ < top₂ s₁: m = top₁ n₂ − top₂ n₁, whose terms all but cancel
    /// where the planes all but coincide: in `f64`, before anything is rounded to `f32`. A ray that passes the origin
    /// by δ changes the product by δ·(d × (n₁ × n₂)).
    fn order(&self, bundle: &Bundle<Self>, [first, second]: [&PrecisePlane; 2]) -> Option<([f32; 3], f32)> {
        if [first, second].iter().any(|plane| plane.top.abs() <= 2.0 * self.top_error(plane)) {
            return None;
        }
        let (a, b) = (first.normal * first.top.signum(), second.normal * second.top.signum());
        let (top_a, top_b) = (first.top.abs(), second.top.abs());
        let m = b * top_a - a * top_b;
        let spread = bundle.spread();
        let (slope_a, slope_b) = (a.abs().dot(spread), b.abs().dot(spread));
        let from_tops = (first.top_error + ORDER_ERROR * top_a) * slope_b
            + (second.top_error + ORDER_ERROR * top_b) * slope_a;
        let from_slopes = first.slope_error * top_b + second.slope_error * top_a;
        let from_shear = f64::from(self.precise_slack)
            * spread.element_sum()
            * (a.cross(b).abs().element_sum() + ORDER_SHEAR * first.size * second.size);
        let from_rounding = f64::from(BUNDLE_PLANE) * m.abs().dot(spread)
            + f64::from(self.slopes_off) * (m.x.abs() + m.y.abs());
        let error = 1.5 * (from_tops + from_slopes) + from_shear + from_rounding;
        let scale = 1.0 / m.abs().max_element();
        Some(((m * scale).as_vec3().to_array(), ((error * scale) as f32).next_up()))
    }
}
