//! Occlusion by a mesh: segments are traced as a bundle where they have a common origin or direction, else ray by ray.

use catoptra_core::LaneMask;
use fearless_simd::Simd;

use super::Searcher;
use super::exact_resolver::AnyInTheWay;
use super::mesh::NONE;
use super::occluded::{Segments, ShadowRays, Shadows};
use crate::kernel::mesh::{BundledRays, ClosestHit, StartingRays, TreeWalk};
use crate::lanes::{M, outlined};
use crate::snapshot::Instance;

impl<S: Simd> Searcher<'_, S> {
    /// The segments that a mesh does not block. See [`outlined`].
    pub(crate) fn occlude_by_mesh(
        &mut self,
        segments: &impl Segments<S>,
        rays: &ShadowRays<'_, S>,
        open: M<S>,
        instance: &Instance,
    ) -> M<S> {
        if !open.any() {
            // What stands before this mesh blocks them all.
            return open;
        }
        outlined(
            self.s,
            #[inline(always)]
            || self.occlude_by_triangles(segments, rays, open, instance),
        )
    }

    #[inline(always)]
    fn occlude_by_triangles(
        &mut self,
        segments: &impl Segments<S>,
        rays: &ShadowRays<'_, S>,
        open: M<S>,
        instance: &Instance,
    ) -> M<S> {
        let mut alone = [Shadows { segments, rays: *rays, open }];
        if self.occlude_as_bundle(&mut alone, 1, instance, &mut [BundledRays::nothing(self.s)]) {
            return alone[0].open;
        }
        let snapshot = self.snapshot;
        let Some(mesh) = snapshot.mesh_at(instance.prim) else { return open };
        let mut exact = AnyInTheWay { snapshot, mesh, prim: instance.prim, shadows: &alone };
        let (setup, live) = segments.single_rays(self, rays, open, instance, mesh);
        let leaving = rays.leaving.facets_of(self.s, instance.prim);
        let begun = |lane| ClosestHit::nothing_on(segments.span(lane)).for_any(true);
        let walk = TreeWalk { tree: instance.tree.to_walk(), visits: self.visits };
        let slots = setup.search(self.s, walk, StartingRays { lanes: live, leaving }, begun, &mut exact);
        self.count_visits();
        open & slots.is(NONE)
    }

    /// Closes the open segments of some packets, told by bits, that a mesh blocks, if they have a common origin or direction; returns
    /// whether they do.
    #[inline(always)]
    pub(super) fn occlude_as_bundle<G: Segments<S>>(
        &mut self,
        shadows: &mut [Shadows<'_, S, G>],
        which: u32,
        instance: &Instance,
        room: &mut [BundledRays<S>],
    ) -> bool {
        let snapshot = self.snapshot;
        let Some(mesh) = snapshot.mesh_at(instance.prim) else { return true };
        let rays = &mut room[..shadows.len()];
        let Some(bundle) = G::bundle(shadows, self, instance, rays) else { return false };
        for (number, rays) in rays.iter_mut().enumerate() {
            if which >> number & 1 == 0 {
                rays.live = M::splat(self.s, false);
            }
        }
        let mut exact = AnyInTheWay { snapshot, mesh, prim: instance.prim, shadows: &*shadows };
        bundle.search(self.s, instance.tree.to_walk(), self.visits, rays, &mut exact);
        self.count_visits();
        for (rays, shadows) in rays.iter().zip(shadows) {
            self.stats.settled += rays.decided;
            shadows.open = shadows.open & rays.slot.is(NONE);
        }
        true
    }
}
