//! The spans of a packet's own rays as segments for occlusion tests.

use catoptra_core::geometry::Mesh;
use catoptra_core::{Ray, Span};
use fearless_simd::Simd;

use super::Searcher;
use super::mesh::ends_of_segments;
use super::occluded::{Segments, ShadowRays};
use super::packet::{Packet, PreciseRays};
use crate::Snapshot;
use crate::kernel::mesh::{BundledRays, CommonOrigin, Lines, RayBundle, RaySetup};
use crate::lanes::M;
use crate::snapshot::Instance;

/// The spans of a packet's rays.
pub(crate) struct OwnSegments<'a, S: Simd, P>(pub(crate) &'a Packet<'a, S, P>);

impl<S: Simd, P: PreciseRays<S>> Segments<S> for OwnSegments<'_, S, P> {
    fn segment(&self, _snapshot: &Snapshot, lane: usize) -> Option<(Ray, Span)> {
        Some((self.0.ray(lane), self.0.span(lane)))
    }

    /// Forwards where all start at one point, backwards where all end at one.
    #[inline(always)]
    fn bundle(
        &self,
        search: &Searcher<'_, S>,
        rays: &ShadowRays<'_, S>,
        open: M<S>,
        instance: &Instance,
    ) -> Option<(CommonOrigin, [BundledRays<S>; 1])> {
        let s = search.s;
        let [start, end] = self.0.precise.ends(s, self.0.at);
        let (start, end) = (instance.own_points(s, start), instance.own_points(s, end));
        let ahead = Lines { origin: start, direction: end - start, live: open };
        let back = Lines { origin: end, direction: start - end, live: open };
        let (mut bundled, reach) = ([BundledRays::nothing(s)], search.reach(instance));
        let bundle = RayBundle::of(s, &mut bundled, |_| ahead, reach)
            .or_else(|| RayBundle::of(s, &mut bundled, |_| back, reach))?;
        let [begin, end] = ends_of_segments(s, bundled[0].scale, bundle.slack);
        bundled[0].start(s, begin, end, rays.leaving.facets_of(s, instance.prim));
        Some((bundle.common_origin.for_any(), bundled))
    }

    #[inline(always)]
    fn single_rays(
        &self,
        search: &Searcher<'_, S>,
        _rays: &ShadowRays<'_, S>,
        open: M<S>,
        instance: &Instance,
        _mesh: &Mesh,
    ) -> (RaySetup, M<S>) {
        (search.ray_setup(&search.own_lines(self.0, instance, open), instance), open)
    }

    fn span(&self, lane: usize) -> Span {
        self.0.span(lane)
    }
}
