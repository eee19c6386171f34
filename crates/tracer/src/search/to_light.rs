//! Shadow rays from hits to a light. Those to a point light are traced backwards as a bundle with a common origin, those
//! to a directional light as one with a common direction.

use catoptra_core::geometry::Mesh;
use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Geometry, Ray, Span};
use fearless_simd::Simd;
use smallvec::SmallVec;

use super::Searcher;
use super::occluded::{Segments, ShadowRays, Shadows};
use super::packet::{Packet, PreciseRays};
use super::surface::PrecisePoints;
use crate::Snapshot;
use crate::kernel::Leaving;
use crate::kernel::mesh::{AnyBundle, Bundle, BundledRays, GROUP, Lines, RayBundle, RaySetup, Starts};
use crate::lanes::{D3, F, M, pick3, splat_wide, widen3};
use crate::numeric::{BUNDLE_STEEP, END_ERROR, POINT_ERROR, START_ERROR};
use crate::snapshot::{Instance, LightRow};

/// Segments from the surfaces that the rays of a packet meet to a light.
pub(crate) struct ToLight<'a, S: Simd, P> {
    pub(crate) packet: &'a Packet<'a, S, P>,
    /// The surfaces that the rays have hit.
    pub(crate) from: Leaving<S>,
    /// Where they have hit meshes.
    pub(crate) on_meshes: PrecisePoints<S>,
    pub(crate) light: &'a LightRow,
}

impl<S: Simd, P: PreciseRays<S>> Segments<S> for ToLight<'_, S, P> {
    /// Starts where the ray of a lane meets its surface in `f64`, not at the `f32` point.
    fn segment(&self, snapshot: &Snapshot, lane: usize) -> Option<(Ray, Span)> {
        let (ray, span, leaving) = self.packet.segment(lane);
        let from = self.from.lane(lane)?;
        let hit = snapshot.cross_part(from.prim, Some(from.facet), &ray, span, leaving)?;
        Some(self.light.segment_from(ray.at(hit.crossing.t)))
    }

    #[inline(always)]
    fn bundle(
        shadows: &[Shadows<'_, S, Self>],
        search: &Searcher<'_, S>,
        instance: &Instance,
        room: &mut [BundledRays<S>],
    ) -> Option<AnyBundle> {
        let (s, light) = (search.s, shadows.first()?.segments.light);
        let mut starts: SmallVec<[(D3<S>, F<S>); GROUP]> = SmallVec::new();
        for Shadows { segments, rays, .. } in shadows {
            starts.push(segments.own_starts(search, rays, instance));
        }
        if light.at_infinity {
            let sunwards = search.snapshot.mesh_at(instance.prim)?.to_object().vector(light.in_frame);
            return bundle_along(search, shadows, &starts, sunwards, instance, room);
        }
        let common = instance.own_points(s, splat_wide(s, light.position));
        bundle_backwards(search, shadows, &starts, common, instance, room)
    }

    #[inline(always)]
    fn single_rays(
        &self,
        search: &Searcher<'_, S>,
        rays: &ShadowRays<'_, S>,
        open: M<S>,
        instance: &Instance,
        mesh: &Mesh,
    ) -> (RaySetup, M<S>) {
        let (s, snapshot) = (search.s, search.snapshot);
        if self.light.at_infinity {
            let (origin, off) = self.own_starts(search, rays, instance);
            let sunwards = mesh.to_object().vector(self.light.in_frame);
            let lines = Lines { origin, direction: splat_wide(s, sunwards), live: open };
            (RaySetup::of(s, &lines, off, instance.tree.reach), open)
        } else {
            // Rounded starts of segments to one point give no bound on their directions.
            let own = |lane| self.segment(snapshot, lane).map(|(ray, _)| mesh.own_ray(&ray));
            let lines = Lines::gathered(s, open, own);
            let exact = F::splat(s, 0.0);
            (RaySetup::of(s, &lines, exact, instance.tree.reach), lines.live)
        }
    }

    fn span(&self, _lane: usize) -> Span {
        if self.light.at_infinity { Span::AHEAD } else { Span::TO_LIGHT }
    }
}

impl<S: Simd, P: PreciseRays<S>> ToLight<'_, S, P> {
    /// Where segments begin in a mesh's own space, and how far that may be off: known in `f64` where they leave meshes.
    #[inline(always)]
    fn own_starts(
        &self,
        search: &Searcher<'_, S>,
        rays: &ShadowRays<'_, S>,
        instance: &Instance,
    ) -> (D3<S>, F<S>) {
        let s = search.s;
        let PrecisePoints { point, lanes } = self.on_meshes;
        let start = instance.own_points(s, pick3(lanes, point, widen3(rays.rays.origin)));
        let share = F::pick(lanes, F::splat(s, START_ERROR), F::splat(s, POINT_ERROR));
        let reach = rays.rays.reach * F::splat(s, instance.scale());
        (start, reach.mul_add(share, F::splat(s, search.reach(instance).off)))
    }
}

/// The segments of some packets as a bundle of rays in one direction, of the mesh's own space as their starts.
#[inline(always)]
fn bundle_along<S: Simd, G>(
    search: &Searcher<'_, S>,
    shadows: &[Shadows<'_, S, G>],
    starts: &[(D3<S>, F<S>)],
    direction: DVec3,
    instance: &Instance,
    room: &mut [BundledRays<S>],
) -> Option<AnyBundle> {
    let mut all: SmallVec<[Starts<S>; GROUP]> = SmallVec::new();
    for (&(origin, off), shadows) in starts.iter().zip(shadows) {
        let leaving = shadows.rays.leaving.facets_of(search.s, instance.prim);
        all.push(Starts { origin, off, live: shadows.open, leaving });
    }
    let (zero, most) = (F::splat(search.s, 0.0), F::splat(search.s, f32::MAX));
    let bundle = Bundle::along(
        search.s,
        room,
        &all,
        direction,
        instance.tree.reach,
        #[inline(always)]
        |_, _| [[zero; 2], [most, zero]],
    )?;
    Some(AnyBundle::Along(bundle.for_any()))
}

/// The segments of some packets as a bundle of rays from where all of them end, backwards to their starts; those are given in the
/// mesh's own space, each with how far it may be off.
#[inline(always)]
pub(super) fn bundle_backwards<S: Simd, G>(
    search: &Searcher<'_, S>,
    shadows: &[Shadows<'_, S, G>],
    starts: &[(D3<S>, F<S>)],
    common: D3<S>,
    instance: &Instance,
    room: &mut [BundledRays<S>],
) -> Option<AnyBundle> {
    let (s, zero) = (search.s, F::splat(search.s, 0.0));
    let bundle = RayBundle::of(
        s,
        room,
        #[inline(always)]
        |number| {
            let (start, _) = starts[number];
            Lines { origin: common, direction: start - common, live: shadows[number].open }
        },
        search.reach(instance),
    )?;
    let mut steepest = 0.0_f32;
    for ((rays, (_, off)), shadows) in room.iter_mut().zip(starts).zip(shadows) {
        let error = rays.scale.mul_add(F::splat(s, END_ERROR), *off);
        let leaving = shadows.rays.leaving.facets_of(s, instance.prim);
        rays.start(s, [zero, zero], [rays.scale, error], leaving);
        let steep = rays.error_where_off(s, *off);
        // Written so that NaN counts.
        steepest = if steep <= steepest { steepest } else { steep };
    }
    // So close to the end that the slopes have no useful bound, rays are traced one by one.
    (steepest < 2.0 - BUNDLE_STEEP)
        .then(|| AnyBundle::Through(bundle.common_origin.for_any().with_slopes_off(steepest)))
}
