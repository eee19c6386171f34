//! Shadow rays from refined points to points of a lamp. Where all lanes go to one, they are traced backwards as a bundle, else
//! one by one.

use catoptra_core::geometry::Mesh;
use catoptra_core::glam::DVec3;
use catoptra_core::{Geometry, Lane, LaneMask, Ray, Span};
use fearless_simd::Simd;

use super::occluded::{Segments, ShadowRays, Shadows};
use super::to_light::bundle_backwards;
use super::{Searcher, drift};
use crate::Snapshot;
use crate::cull::Candidates;
use crate::kernel::mesh::{AnyBundle, BundledRays, Lines, RaySetup};
use crate::kernel::{Leaving, Rays, Target};
use crate::lanes::{D, D3, F, M, magnitude, narrow3, splat_wide};
use crate::numeric::START_ERROR;
use crate::snapshot::Instance;

/// Segments from points to others, one in every lane; relative to the snapshot's origin.
pub(crate) struct ToPoints<S: Simd> {
    pub(crate) from: D3<S>,
    pub(crate) to: D3<S>,
    /// Which share of the way things block.
    pub(crate) end: D<S>,
    /// The surfaces that the points lie on.
    pub(crate) leaving: Leaving<S>,
    /// The lamp's own shape, unless that may be in its own way.
    pub(crate) arriving: Option<u32>,
}

impl<S: Simd> ToPoints<S> {
    fn vector(v: &D3<S>, lane: usize) -> DVec3 {
        DVec3::new(v.x.lane(lane), v.y.lane(lane), v.z.lane(lane))
    }

    /// Where the segments of some lanes end, if all of them end there.
    #[inline(always)]
    fn common_end(&self, s: S, lanes: M<S>) -> Option<DVec3> {
        let end = Self::vector(&self.to, lanes.bits().trailing_zeros() as usize);
        let off = self.to - splat_wide(s, end);
        let apart = off.x.abs().max(off.y.abs()).max(off.z.abs());
        let other = lanes & !apart.at_most(D::splat(s, 0.0));
        if other.any() { None } else { Some(end) }
    }
}

impl<S: Simd> Segments<S> for ToPoints<S> {
    fn segment(&self, snapshot: &Snapshot, lane: usize) -> Option<(Ray, Span)> {
        let from = Self::vector(&self.from, lane);
        let way = Self::vector(&self.to, lane) - from;
        Some((Ray::new(from + snapshot.origin_in_frame(), way), self.span(lane)))
    }

    #[inline(always)]
    fn arrives_at(&self) -> Option<u32> {
        self.arriving
    }

    #[inline(always)]
    fn bundle(
        shadows: &[Shadows<'_, S, Self>],
        search: &Searcher<'_, S>,
        instance: &Instance,
        room: &mut [BundledRays<S>],
    ) -> Option<AnyBundle> {
        let s = search.s;
        let [Shadows { segments, rays, open }] = shadows else { return None };
        let common = instance.own_points(s, splat_wide(s, segments.common_end(s, *open)?));
        let off = rays.rays.reach * F::splat(s, instance.scale() * START_ERROR);
        let start = instance.own_points(s, segments.from);
        bundle_backwards(search, shadows, &[(start, off)], common, instance, room)
    }

    #[inline(always)]
    fn single_rays(
        &self,
        search: &Searcher<'_, S>,
        _rays: &ShadowRays<'_, S>,
        open: M<S>,
        instance: &Instance,
        mesh: &Mesh,
    ) -> (RaySetup, M<S>) {
        let s = search.s;
        // Rounded starts of segments to one point give no bound on their directions.
        let own = |lane| self.segment(search.snapshot, lane).map(|(ray, _)| mesh.own_ray(&ray));
        let lines = Lines::gathered(s, open, own);
        (RaySetup::of(s, &lines, F::splat(s, 0.0), instance.tree.reach), lines.live)
    }

    fn span(&self, lane: usize) -> Span {
        Span::until(self.end.lane(lane))
    }
}

impl<S: Simd> Searcher<'_, S> {
    /// The lanes whose segments some shapes block.
    #[inline(always)]
    pub(crate) fn blocked(&mut self, segments: &ToPoints<S>, live: M<S>, among: &Candidates) -> M<S> {
        let s = self.s;
        let (origin, way) = (narrow3(segments.from), narrow3(segments.to - segments.from));
        let distance = way.dot(way).sqrt();
        let reach = magnitude(origin) + magnitude(narrow3(segments.to));
        let rays = ShadowRays {
            rays: Rays {
                origin,
                direction: way.scale(F::splat(s, 1.0) / distance),
                reach: reach + F::splat(s, drift(self.snapshot.origin_in_frame())),
            },
            leaving: segments.leaving,
            live,
            target: Target { distance, end: None },
            behind: &[],
        };
        self.occluded(segments, &rays, among)
    }
}
