//! Rays against a sphere: the remainder form of Haines et al. (*Ray Tracing Gems*, 2019), with error bounds.

use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::solid::{End, Stretch};
use super::{
    Blocking, Crossing, End as TargetEnd, Facet, Kernel, NearHit, Obstacle, PlaneRow, Proposal, Rays, Target,
    Tried, bound,
};
use crate::lanes::{D, D3, F, F3, M, U, narrow3, splat_wide, splat3};
use crate::numeric::{PLAN_MARGIN, POINT_ERROR, magnitude_of, rounded};

/// A sphere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SphereRow {
    pub(crate) center: DVec3,
    pub(crate) radius: f64,
    center32: [f32; 3],
    inverse_radius: f32,
    radius32: f32,
    reach: f32,
}

/// How a line passes a sphere.
struct Passage<S: Simd> {
    /// From the ray's origin to the centre.
    to_center: F3<S>,
    /// Parameter of the point nearest to the centre.
    closest: F<S>,
    /// Square of half the chord; negative where the line passes by.
    half_chord2: F<S>,
    /// Bound on the error of `half_chord2`.
    error: F<S>,
    /// Bound on the error of a coordinate of `to_center` and of `closest`.
    point_error: F<S>,
}

impl SphereRow {
    pub(crate) fn new(center: DVec3, radius: f64) -> Self {
        Self {
            center,
            radius,
            center32: rounded(center),
            inverse_radius: (1.0 / radius) as f32,
            radius32: radius as f32,
            reach: magnitude_of(center) + (radius as f32).next_up(),
        }
    }

    #[inline(always)]
    fn pass<S: Simd>(&self, s: S, rays: &Rays<S>) -> Passage<S> {
        let radius = F::splat(s, self.radius32);
        let to_center = splat3(s, self.center32) - rays.origin;
        let closest = to_center.dot(rays.direction);
        let remainder = rays.direction.scale_add(-closest, to_center);
        let half_chord2 = radius * radius - remainder.dot(remainder);
        let point_error = bound(s, (rays.reach + F::splat(s, self.reach)) * F::splat(s, POINT_ERROR));
        // At the silhouette the remainder is as long as the radius r, off by e: |r² − (r ± e)²| ≤ e (2r + e).
        let error = bound(s, point_error * (radius + radius + radius + point_error));
        Passage { to_center, closest, half_chord2, error, point_error }
    }

    /// The crossing nearest ahead. Where a ray leaves this very sphere, the far crossing.
    #[inline(always)]
    pub(crate) fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, leaving: M<S>) -> Proposal<S> {
        let (zero, two) = (F::splat(s, 0.0), F::splat(s, 2.0));
        let pass = self.pass(s, rays);
        let crosses = pass.error.less(pass.half_chord2);
        // Written so that NaN, from numbers beyond those of f32, stays in doubt.
        let maybe = !pass.half_chord2.less(-pass.error);
        if !(maybe | leaving).any() {
            return Proposal { t: zero, error: zero, hit: maybe, undecided: maybe };
        }
        let half = pass.half_chord2.max(zero).sqrt();
        let error = bound(s, pass.point_error + pass.error / half);
        let (near, far) = (pass.closest - half, pass.closest + half);
        let ahead = error.less(near);
        let inside = near.less(-error) & error.less(far);
        let behind = far.less(-error);
        // The origin of a ray that leaves lies on the sphere, so its far crossing is at twice the closest point.
        let through = leaving & pass.point_error.less(pass.closest);
        let outwards = leaving & pass.closest.less(-pass.point_error);
        Proposal {
            t: F::pick(leaving, pass.closest * two, F::pick(ahead, near, far)),
            error: F::pick(leaving, pass.point_error * two, error),
            hit: (crosses & (ahead | inside) & !leaving) | through,
            undecided: (maybe & !(crosses & (ahead | inside | behind)) & !leaving)
                | (leaving & !(through | outwards)),
        }
    }

    /// A sphere blocks a segment between two points outside it if the line crosses it between them, and always one
    /// between a point inside and one outside. `starts_outside` says that no segment starts inside.
    #[inline(always)]
    pub(crate) fn block<S: Simd>(
        &self,
        s: S,
        rays: &Rays<S>,
        target: &Target<S>,
        leaving: M<S>,
        starts_outside: bool,
    ) -> Blocking<S> {
        let most = self.radius * self.radius * (1.0 + PLAN_MARGIN);
        let may_end_inside = match target.end {
            Some(TargetEnd::At(point)) => point.distance_squared(self.center) <= most,
            Some(TargetEnd::AtInfinity(_)) => false,
            None => true,
        };
        if may_end_inside || leaving.any() {
            return self.propose(s, rays, leaving).blocking(target);
        }
        let zero = F::splat(s, 0.0);
        let pass = self.pass(s, rays);
        let radius = F::splat(s, self.radius32);
        let between =
            pass.point_error.less(pass.closest) & (pass.closest + pass.point_error).less(target.distance);
        let beyond =
            pass.closest.less(-pass.point_error) | target.distance.less(pass.closest - pass.point_error);
        let misses = pass.half_chord2.less(-pass.error);
        if !(!misses).any() || (starts_outside && !(!(misses | beyond)).any()) {
            return Blocking { blocked: zero.less(zero), undecided: zero.less(zero) };
        }
        let outside = radius + radius + pass.point_error;
        let depth = pass.to_center.dot(pass.to_center) - radius * radius;
        // The square of a distance near the radius is off by no more than e (2r + e).
        let is_outside = (outside * pass.point_error).less(depth);
        let crosses = pass.error.less(pass.half_chord2);
        Blocking {
            blocked: crosses & between & is_outside,
            undecided: !(misses | (beyond & is_outside) | (crosses & between & is_outside)),
        }
    }
}

impl SphereRow {
    /// Where lines run inside it.
    #[inline(always)]
    pub(super) fn stretch<S: Simd>(&self, s: S, rays: &Rays<S>) -> Stretch<S> {
        let pass = self.pass(s, rays);
        let half = pass.half_chord2.max(F::splat(s, 0.0)).sqrt();
        let error = bound(s, pass.point_error + pass.error / half);
        let end = |t: F<S>| End::about(t, error, U::splat(s, 0), M::splat(s, true));
        Stretch {
            ends: [end(pass.closest - half), end(pass.closest + half)],
            misses: pass.half_chord2.less(-pass.error),
            crosses: pass.error.less(pass.half_chord2),
        }
    }
}

impl Kernel for SphereRow {
    type Face = PlaneRow;

    /// A sphere may be met again by a ray that leaves it, on its far side.
    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        let leaving = tried.leaving.from(s, tried.prim, 0);
        let proposal = self.propose(s, rays, leaving);
        found(Crossing { proposal, facet: Facet::Same(0), lanes: tried.lanes });
    }

    #[inline(always)]
    fn block<S: Simd>(
        &self,
        s: S,
        rays: &Rays<S>,
        target: &Target<S>,
        tried: &Tried<S>,
        mut found: impl FnMut(Obstacle<S>),
    ) {
        let own = tried.leaving.from(s, tried.prim, 0) & tried.lanes;
        // Seen from outside, what faces the light is not shadowed by its own sphere.
        let (lanes, leaving) =
            if tried.outside { (tried.lanes & !own, M::splat(s, false)) } else { (tried.lanes, own) };
        let blocking = self.block(s, rays, target, leaving, tried.outside);
        found(Obstacle { blocking, facet: Some(0), lanes });
    }

    /// Relative to the centre, where `f32` is fine enough for sharp highlights; one Newton step brings it there.
    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        let (direction, near) = (hit.direction(), hit.near());
        let from_center = narrow3(near - splat_wide(s, self.center));
        let radius2 = F::splat(s, (self.radius * self.radius) as f32);
        let slope = from_center.dot(direction);
        let metres = (radius2 - from_center.dot(from_center)) / (slope + slope);
        let normal = direction.scale_add(metres, from_center).scale(F::splat(s, self.inverse_radius));
        (direction.scale_add(metres, narrow3(near)), normal)
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        let from = hit.near() - splat_wide(s, self.center);
        let off = from.dot(from) - D::splat(s, self.radius * self.radius);
        let slope = narrow3(from).dot(hit.direction());
        (off.narrow(), slope + slope)
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, _hit: &impl NearHit<S>, point: D3<S>) -> D3<S> {
        (point - splat_wide(s, self.center)).scale(D::splat(s, 1.0 / self.radius))
    }

    fn all_normals(&self, center: DVec3, half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        test((center - self.center) / self.radius, half / self.radius)
    }

    fn is_outside(&self, point: DVec3) -> bool {
        self.center.distance(point) > self.radius * (1.0 + PLAN_MARGIN)
    }
}
