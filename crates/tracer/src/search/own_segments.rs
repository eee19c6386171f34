//! The spans of a packet's own rays as segments for occlusion tests.

use catoptra_core::geometry::Mesh;
use catoptra_core::{Ray, Span};
use fearless_simd::Simd;

use super::Searcher;
use super::mesh::ends_of_segments;
use super::occluded::{Segments, ShadowRays, Shadows};
use super::packet::{Packet, PreciseRays};
use crate::Snapshot;
use crate::kernel::mesh::{AnyBundle, BundledRays, Lines, RayBundle, RaySetup};
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
        shadows: &[Shadows<'_, S, Self>],
        search: &Searcher<'_, S>,
        instance: &Instance,
        room: &mut [BundledRays<S>],
    ) -> Option<AnyBundle> {
        let (s, reach) = (search.s, search.reach(instance));
        let mut bundle_of = |backwards: bool| {
            RayBundle::of(
                s,
                room,
                #[inline(always)]
                |number| {
                    let Shadows { segments, open, .. } = &shadows[number];
                    let [start, end] = segments.0.precise.ends(s, segments.0.at);
                    let (start, end) = (instance.own_points(s, start), instance.own_points(s, end));
                    let (origin, other) = if backwards { (end, start) } else { (start, end) };
                    Lines { origin, direction: other - origin, live: *open }
                },
                reach,
            )
        };
        let bundle = bundle_of(false).or_else(|| bundle_of(true))?;
        for (rays, shadows) in room.iter_mut().zip(shadows) {
            let [begin, end] = ends_of_segments(s, rays.scale, bundle.slack);
            rays.start(s, begin, end, shadows.rays.leaving.facets_of(s, instance.prim));
        }
        Some(AnyBundle::Through(bundle.common_origin.for_any()))
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
