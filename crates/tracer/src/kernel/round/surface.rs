//! Points and normals where rays have met what is round about an axis.

use catoptra_core::Arithmetic;
use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use super::super::{Crossing, Facet, Kernel, NearHit, PlaneRow, Rays, Tried};
use super::{LOWER, RoundRow, SIDE, UPPER};
use crate::lanes::{D, D3, F, F3, narrow3, pick3, splat_wide, splat3, unit, widen3};
use crate::numeric::{PLAN_MARGIN, rounded};

impl RoundRow {
    /// From the lower end, what lies across the axis, and the height.
    #[inline(always)]
    fn profile<S: Simd>(&self, s: S, point: D3<S>) -> (D3<S>, D<S>) {
        let (from, axis) = (point - splat_wide(s, self.ends[0]), splat_wide(s, self.axis));
        let height = from.dot(axis);
        (axis.scale_add(-height, from), height)
    }

    #[inline(always)]
    fn plane(&self, facet: u32) -> (DVec3, f64) {
        let (normal, end) =
            if facet == LOWER { (-self.axis, self.ends[0]) } else { (self.axis, self.ends[1]) };
        (normal, normal.dot(end))
    }
}

impl Kernel for RoundRow {
    type Face = PlaneRow;

    /// Rays that leave it are left to `f64`, unless none begins inside: then they do not meet it again.
    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        let (mut proposal, facet) = self.propose(s, rays);
        let mut lanes = tried.lanes;
        if tried.leaving.any {
            let own = tried.leaving.prim.is(tried.prim);
            if tried.outside {
                lanes = lanes & !own;
            } else {
                proposal.undecided = proposal.undecided | own;
                proposal.hit = proposal.hit & !own;
            }
        }
        found(Crossing { proposal, facet: Facet::ByLane(facet), lanes });
    }

    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        let (off, slope) = self.off(s, hit);
        let point = hit.near() + widen3(hit.direction().scale(-(off / slope)));
        (narrow3(point), narrow3(self.normal(s, hit, point)))
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        let (near, direction) = (hit.near(), hit.direction());
        let (across, height) = self.profile(s, near);
        let radius = D::splat(s, self.growth).mul_add(height, D::splat(s, self.radii[0]));
        let climb = direction.dot(splat3(s, self.axis32));
        let mut off = (across.dot(across) - radius * radius).narrow();
        let widens = F::splat(s, self.growth32) * climb * radius.narrow();
        let half = narrow3(across).dot(direction) - widens;
        let mut slope = half + half;
        let (facets, mask) = hit.facets();
        for (facet, lanes) in facets.groups(mask).filter(|(facet, _)| *facet != SIDE) {
            let there = if self.has_balls {
                let from = near - splat_wide(s, self.ends[usize::from(facet == UPPER)]);
                let slope = narrow3(from).dot(direction);
                ((from.dot(from) - D::splat(s, self.radii[0] * self.radii[0])).narrow(), slope + slope)
            } else {
                let (normal, distance) = self.plane(facet);
                let off = splat_wide(s, normal).dot(near) - D::splat(s, distance);
                (off.narrow(), splat3(s, rounded(normal)).dot(direction))
            };
            (off, slope) = (F::pick(lanes, there.0, off), F::pick(lanes, there.1, slope));
        }
        (off, slope)
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, hit: &impl NearHit<S>, point: D3<S>) -> D3<S> {
        let (across, _) = self.profile(s, point);
        let axis = splat_wide(s, self.axis);
        // At a tip, any way out.
        let aside = splat_wide(s, self.axis.any_orthonormal_vector());
        let out = unit(s, pick3(across.dot(across).at_most(D::splat(s, 0.0)), aside, across));
        let lean = 1.0 / (1.0 + self.growth * self.growth).sqrt();
        let mut normal = axis.scale_add(D::splat(s, -self.growth * lean), out.scale(D::splat(s, lean)));
        let (facets, mask) = hit.facets();
        for (facet, lanes) in facets.groups(mask).filter(|(facet, _)| *facet != SIDE) {
            let there = if self.has_balls {
                let from = point - splat_wide(s, self.ends[usize::from(facet == UPPER)]);
                from.scale(D::splat(s, 1.0 / self.radii[0]))
            } else {
                splat_wide(s, self.plane(facet).0)
            };
            normal = pick3(lanes, there, normal);
        }
        normal
    }

    /// Of all that any such shape may have.
    fn all_normals(&self, _center: DVec3, _half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        test(DVec3::ZERO, DVec3::ONE)
    }

    fn is_outside(&self, point: DVec3) -> bool {
        let (from, length) = (point - self.ends[0], self.ends[0].distance(self.ends[1]));
        let height = from.dot(self.axis);
        let margin = PLAN_MARGIN * (point.abs().element_sum() + f64::from(self.reach));
        if self.has_balls {
            let on_axis = self.ends[0] + self.axis * height.clamp(0.0, length);
            return point.distance(on_axis) > self.radii[0] + margin;
        }
        let across = (from - self.axis * height).length();
        let above = across - self.radii[0] - self.growth * height;
        height < -margin || height > length + margin || above > margin * (1.0 + self.growth.abs())
    }
}
