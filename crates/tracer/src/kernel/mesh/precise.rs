//! One ray against one triangle in `f64`, with error bounds that show when the result is certain.
//!
//! Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.

use catoptra_core::Ray;
use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use crate::lanes::{D, D3, F3, M, U, cross, splat3, widen3};
use crate::numeric::{DEPTH_ERROR, PRECISE_EDGE_ERROR, PRECISE_SLOPE_ERROR, PRECISE_TOP_ERROR};

/// Whether a ray hits a triangle, as far as `f64` is certain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Verdict {
    /// The ray misses the triangle.
    Miss,
    /// The ray hits it at a `t` that is known within a bound.
    Hit(f64, f64),
    /// Bounds do not decide.
    Open,
}

/// Where a ray meets a triangle of corners that `f32` holds, in the space of both.
#[inline(always)]
pub(crate) fn intersect(corners: &[[f32; 3]; 3], ray: &Ray) -> Verdict {
    let (a, b, c) = (widened(&corners[0]), widened(&corners[1]), widened(&corners[2]));
    let (o, d) = (ray.origin, ray.direction);
    let (along_a, along_b, along_c) = (c - b, a - c, b - a);
    let (p, q, r) = (a - o, b - o, c - o);
    let (u, v, w) = (along_a.cross(q).dot(d), along_b.cross(r).dot(d), along_c.cross(p).dot(d));
    let size = p.abs().max(q.abs()).max(r.abs()).max_element();
    let length = along_a.abs().max(along_b.abs()).max(along_c.abs()).max_element();
    let edge_error = PRECISE_EDGE_ERROR * d.abs().element_sum() * length * size;
    let (low, high) = (u.min(v).min(w), u.max(v).max(w));
    if low < -edge_error && high > edge_error {
        return Verdict::Miss;
    }
    if !(low > edge_error || high < -edge_error) {
        return Verdict::Open;
    }
    crossing(corners, ray)
}

/// Where a ray meets a triangle that it passes within all edges of.
#[inline(always)]
pub(crate) fn crossing(corners: &[[f32; 3]; 3], ray: &Ray) -> Verdict {
    let (t, error) = depth(corners, ray);
    if error.is_finite() { Verdict::Hit(t, error) } else { Verdict::Open }
}

/// Where a ray meets the plane of a triangle, and a bound on its error; infinite where `f64` gives none.
#[inline(always)]
pub(crate) fn depth(corners: &[[f32; 3]; 3], ray: &Ray) -> (f64, f64) {
    let (a, b, c) = (widened(&corners[0]), widened(&corners[1]), widened(&corners[2]));
    let (e, f) = (b - a, c - a);
    let (normal, from) = (e.cross(f), a - ray.origin);
    let length = e.abs().max(f.abs()).max_element();
    let slope = normal.dot(ray.direction);
    let slope_error = PRECISE_SLOPE_ERROR * ray.direction.abs().element_sum() * length * length;
    let t = normal.dot(from) / slope;
    let top_error = PRECISE_TOP_ERROR * length * length * from.abs().max_element();
    // Where a slope is four times its error, three quarters of it are certain.
    let error = 1.5 * (top_error + t.abs() * slope_error) / slope.abs() + t.abs() * (2.0 * f64::EPSILON);
    let certain = slope.abs() > 4.0 * slope_error && error.is_finite();
    (t, if certain { error } else { f64::INFINITY })
}

/// A triangle in every lane.
#[derive(Clone, Copy)]
pub(crate) struct LaneTriangles<S: Simd> {
    a: F3<S>,
    b: F3<S>,
    c: F3<S>,
    /// Which of its mesh's triangles it is.
    pub(crate) facet: U<S>,
}

impl<S: Simd> LaneTriangles<S> {
    /// All corners in one point.
    #[inline(always)]
    pub(crate) fn nothing(s: S) -> Self {
        let zero = splat3(s, [0.0; 3]);
        Self { a: zero, b: zero, c: zero, facet: U::splat(s, 0) }
    }

    /// Puts a triangle into some lanes.
    #[inline(always)]
    pub(crate) fn set(&mut self, s: S, lanes: M<S>, facet: u32, corners: &[[f32; 3]; 3]) {
        self.a = F3::select(lanes, splat3(s, corners[0]), self.a);
        self.b = F3::select(lanes, splat3(s, corners[1]), self.b);
        self.c = F3::select(lanes, splat3(s, corners[2]), self.c);
        self.facet = U::pick(lanes, U::splat(s, facet), self.facet);
    }

    /// Their corners in `f64`.
    #[inline(always)]
    pub(crate) fn wide(&self) -> [D3<S>; 3] {
        [widen3(self.a), widen3(self.b), widen3(self.c)]
    }

    /// As [`depth`], for rays in every lane; and where the bound on the error is below [`DEPTH_ERROR`] of it.
    #[inline(always)]
    pub(crate) fn depths(&self, s: S, origin: D3<S>, direction: D3<S>) -> (D<S>, M<S>) {
        let [a, b, c] = self.wide();
        let (e, f) = (b - a, c - a);
        let (normal, from) = (cross(e, f), a - origin);
        let length = largest(e).max(largest(f));
        let length2 = length * length;
        let slope = normal.dot(direction);
        let spread = direction.x.abs() + direction.y.abs() + direction.z.abs();
        let slope_error = D::splat(s, PRECISE_SLOPE_ERROR) * spread * length2;
        let t = normal.dot(from) / slope;
        let top_error = D::splat(s, PRECISE_TOP_ERROR) * length2 * largest(from);
        let error = D::splat(s, 1.5) * (top_error + t.abs() * slope_error) / slope.abs();
        let steep = (D::splat(s, 4.0) * slope_error).at_most(slope.abs());
        (t, steep & error.at_most(t.abs() * D::splat(s, DEPTH_ERROR)))
    }
}

#[inline(always)]
fn largest<S: Simd>(v: D3<S>) -> D<S> {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}

#[inline(always)]
fn widened(p: &[f32; 3]) -> DVec3 {
    DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn inside_is_a_hit_and_outside_a_miss() {
        let at = |x: f64, y: f64| intersect(&CORNERS, &Ray::new(DVec3::new(x, y, 2.0), -DVec3::Z));
        assert!(matches!(at(0.25, 0.25), Verdict::Hit(t, error) if (t - 2.0).abs() <= error));
        assert_eq!(at(0.6, 0.6), Verdict::Miss);
    }

    #[test]
    fn on_an_edge_and_within_the_plane_is_left_open() {
        let on_edge = Ray::new(DVec3::new(0.5, 0.5, 2.0), -DVec3::Z);
        let within = Ray::new(DVec3::new(-1.0, 0.25, 0.0), DVec3::X);
        assert_eq!([on_edge, within].map(|ray| intersect(&CORNERS, &ray)), [Verdict::Open; 2]);
    }
}
