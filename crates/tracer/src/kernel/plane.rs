//! Rays against an infinite plane.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane};
use fearless_simd::Simd;

use super::contract::off_planes;
use super::{Blocking, Crossing, Facet, Kernel, NearHit, Proposal, Rays, Tried, bound};
use crate::lanes::{D, D3, F, F3, splat_wide, splat3};
use crate::numeric::{DIRECTION_ERROR, PLAN_MARGIN, POINT_ERROR, WIDE_SHARE, magnitude_of, rounded};

/// A plane `normal · p = distance`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaneRow {
    pub(crate) normal: DVec3,
    pub(crate) distance: f64,
    pub(crate) prim: u32,
    pub(crate) normal32: [f32; 3],
    distance32: f32,
    /// How far `distance` may be off, as `f64` loses digits where the sum that makes it cancels.
    pub(crate) distance_error: f64,
    /// What rounding errors of `normal · p - distance` grow with, beside the point's own magnitude.
    pub(super) reach: f32,
}

impl AsRef<Self> for PlaneRow {
    fn as_ref(&self) -> &Self {
        self
    }
}

impl PlaneRow {
    pub(crate) fn new(point: DVec3, normal: DVec3, prim: u32) -> Self {
        let distance = normal.dot(point);
        // Where the sum that makes the distance cancels, f64 itself rounds more than f32 shows.
        let cancelled = magnitude_of(point) * WIDE_SHARE;
        let reach = magnitude_of(normal * distance) + cancelled;
        Self {
            normal,
            distance,
            prim,
            normal32: rounded(normal),
            distance32: distance as f32,
            distance_error: f64::from((cancelled + 2.0 * reach * f32::EPSILON) * POINT_ERROR),
            reach,
        }
    }

    /// Signed distances of the origins from the plane, positive on the side the normal does not point to, and the
    /// bound on their error.
    #[inline(always)]
    pub(super) fn behind<S: Simd>(&self, s: S, rays: &Rays<S>) -> (F<S>, F<S>) {
        let n = splat3(s, self.normal32);
        let behind = F::splat(s, self.distance32) - n.dot(rays.origin);
        let error = (rays.reach + F::splat(s, self.reach)) * F::splat(s, POINT_ERROR);
        (behind, bound(s, error))
    }

    /// Whether a point certainly lies on the side that the normal points to.
    pub(crate) fn is_before(&self, point: DVec3) -> bool {
        let size = self.distance.abs() + point.abs().element_sum();
        self.normal.dot(point) - self.distance > PLAN_MARGIN * size
    }

    /// The crossing ahead.
    #[inline(always)]
    pub(crate) fn propose<S: Simd>(&self, s: S, rays: &Rays<S>) -> Proposal<S> {
        let slope = splat3(s, self.normal32).dot(rays.direction);
        let (behind, point_error) = self.behind(s, rays);
        let inverse = F::splat(s, 1.0) / slope;
        let t = behind * inverse;
        let direction_error = F::splat(s, DIRECTION_ERROR);
        Proposal {
            t,
            error: bound(s, t.mul_add(direction_error, point_error) * inverse.abs()),
            hit: F::splat(s, 0.0).less(t),
            undecided: !point_error.less(behind.abs()) | !direction_error.less(slope.abs()),
        }
    }

    /// A plane blocks a segment between two points on different sides of it; the target lies `target_behind` it.
    #[inline(always)]
    pub(crate) fn block<S: Simd>(&self, s: S, rays: &Rays<S>, target_behind: f64) -> Blocking<S> {
        let (behind, error) = self.behind(s, rays);
        let zero = F::splat(s, 0.0);
        let other = if target_behind > 0.0 {
            behind.less(zero)
        } else if target_behind < 0.0 {
            zero.less(behind)
        } else {
            zero.less(zero)
        };
        Blocking { blocked: other, undecided: !error.less(behind.abs()) }
    }
}

impl Kernel for PlaneRow {
    type Face = Self;

    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        let (proposal, lanes) = (self.propose(s, rays), tried.but_leaving(s, 0));
        found(Crossing { proposal, facet: Facet::Same(0), lanes });
    }

    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        (hit.point(), splat3(s, self.normal32))
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        off_planes(splat_wide(s, self.normal), D::splat(s, self.distance), hit)
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, _hit: &impl NearHit<S>, _point: D3<S>) -> D3<S> {
        splat_wide(s, self.normal)
    }

    fn all_normals(&self, _center: DVec3, _half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        test(self.normal, DVec3::ZERO)
    }

    fn is_outside(&self, _point: DVec3) -> bool {
        true
    }
}
