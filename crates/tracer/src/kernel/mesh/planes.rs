//! Where rays with a common origin cross the planes of triangles, and which of two planes they cross first.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane};
use fearless_simd::Simd;

use super::edges::Prepared;
use super::{BundledRays, CommonOrigin};
use crate::kernel::bound;
use crate::lanes::{F, M};
use crate::numeric::{
    BUNDLE_DEPTH, BUNDLE_PLANE, ORDER_ERROR, ORDER_SHEAR, PRECISE_SLOPE_ERROR, PRECISE_TOP_ERROR,
};

/// The plane of a triangle, for rays with a common origin.
///
/// A ray of slope s = n·(u, v, 1) crosses it at the depth z = top / s. Off by errors of top and s, z is off by at most
/// (z · error of s + error of top) / (|s| − error of s); and |s| is |top| / z. So the error is z (z a + b), where a and b
/// are the errors of s and top over three quarters of |top|, as long as |top| is four times what z makes of them. On the
/// triangle z is at most the depth of its deepest corner: whether that holds is known for all rays at once.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    normal: [f32; 3],
    /// The common origin's distance from it along the normal.
    top: f32,
    /// What the error of a depth z on the triangle grows with: z² and z. Infinite where no depth is known.
    errors: [f32; 2],
}

/// Bounds on where rays cross the plane of a triangle.
pub(super) struct Crossing<S: Simd> {
    /// Depths between which the crossings lie.
    pub(super) depth: [F<S>; 2],
    /// Lanes that cross for certain before their nearest hit so far and within their span.
    pub(super) nearer: M<S>,
    /// Lanes that cross for certain behind that hit or before their span.
    pub(super) beside: M<S>,
}

impl<S: Simd> BundledRays<S> {
    /// Scalar products of a vector and the directions.
    #[inline(always)]
    pub(super) fn value(&self, s: S, [x, y, z]: [f32; 3]) -> F<S> {
        let (x, y, z) = (F::splat(s, x), F::splat(s, y), F::splat(s, z));
        self.u.mul_add(x, self.v.mul_add(y, z))
    }

    /// Where the rays cross a plane.
    #[inline(always)]
    pub(super) fn cross(&self, s: S, plane: &Plane) -> Crossing<S> {
        let z = F::splat(s, plane.top) / self.value(s, plane.normal);
        let (of_square, of_depth) = (F::splat(s, plane.errors[0]), F::splat(s, plane.errors[1]));
        let error = bound(s, z.abs() * z.abs().mul_add(of_square, of_depth));
        let (low, high) = (z - error, z + error);
        let nearer = high.less(self.end[0]) & self.begin[1].less(low);
        let beside = self.end[1].less(low) | high.less(self.begin[0]);
        Crossing { depth: [low, high], nearer, beside }
    }
}

impl Prepared {
    #[inline(always)]
    pub(super) fn plane(&self, at: usize) -> Plane {
        let [x, y, z] = &self.normal;
        let [of_square, of_depth] = &self.depth_errors;
        Plane { normal: [x[at], y[at], z[at]], top: self.top[at], errors: [of_square[at], of_depth[at]] }
    }
}

/// The plane of a triangle in `f64`, seen from the common origin.
pub(super) struct PrecisePlane {
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

impl CommonOrigin {
    /// The plane of a triangle.
    pub(super) fn precise_plane(&self, corners: &[[f32; 3]; 3]) -> PrecisePlane {
        let [u, v, z] = self.axes;
        let own = |p: &[f32; 3]| DVec3::new(p[u].into(), p[v].into(), p[z].into()) * f64::from(self.sign);
        let [a, b, c] = [own(&corners[0]), own(&corners[1]), own(&corners[2])];
        let (e, f, from) = (b - a, c - a, a - self.precise_origin);
        let normal = e.cross(f);
        let length = e.abs().max(f.abs()).max_element();
        let size = length * length;
        PrecisePlane {
            normal,
            top: normal.dot(from),
            slope_error: PRECISE_SLOPE_ERROR * self.spread().element_sum() * size,
            top_error: PRECISE_TOP_ERROR * size * from.abs().max_element(),
            size,
            deepest: (a.z.max(b.z).max(c.z) - self.precise_origin.z).max(0.0)
                + 2.0 * f64::from(self.precise_slack),
        }
    }

    /// A plane from `f64`: bounds are relative to its normal, so thin triangles have no larger ones.
    pub(super) fn plane_of(&self, precise: &PrecisePlane) -> Plane {
        let PrecisePlane { normal, top, .. } = *precise;
        let size = normal.abs();
        let slope_error = f64::from(BUNDLE_PLANE) * size.dot(self.spread())
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
    pub(super) fn order(&self, [first, second]: [&PrecisePlane; 2]) -> Option<([f32; 3], f32)> {
        if [first, second].iter().any(|plane| plane.top.abs() <= 2.0 * self.top_error(plane)) {
            return None;
        }
        let (a, b) = (first.normal * first.top.signum(), second.normal * second.top.signum());
        let (top_a, top_b) = (first.top.abs(), second.top.abs());
        let m = b * top_a - a * top_b;
        let spread = self.spread();
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

    /// How far the tops of rays may lie from the point's.
    fn top_error(&self, plane: &PrecisePlane) -> f64 {
        f64::from(self.precise_slack) * plane.normal.abs().element_sum() + plane.top_error
    }

    /// At most the size of any ray's slopes, and the 1 along the main axis.
    fn spread(&self) -> DVec3 {
        let [u, v] = self.steepest().map(f64::from);
        DVec3::new(u, v, 1.0)
    }
}
