//! Occlusion by a mesh: segments are traced as a bundle where they have a common origin, else ray by ray.

use catoptra_core::LaneMask;
use fearless_simd::Simd;

use super::Searcher;
use super::exact_resolver::AnyInTheWay;
use super::mesh::NONE;
use super::occluded::{Segments, ShadowRays};
use crate::kernel::mesh::{ClosestHit, StartingRays, TreeWalk};
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
        let snapshot = self.snapshot;
        let Some(mesh) = snapshot.mesh_at(instance.prim) else { return open };
        let tree = &instance.tree.tree;
        let mut exact = AnyInTheWay { snapshot, mesh, prim: instance.prim, segments, leaving: rays.leaving };
        let slots = if let Some((common_origin, mut bundled)) = segments.bundle(self, rays, open, instance) {
            common_origin.search(self.s, tree, self.visits, &mut bundled, &mut exact);
            self.stats.settled += bundled[0].decided;
            bundled[0].slot
        } else {
            let (setup, live) = segments.single_rays(self, rays, open, instance, mesh);
            let leaving = rays.leaving.facets_of(self.s, instance.prim);
            let begun = |lane| ClosestHit::nothing_on(segments.span(lane)).for_any(true);
            let walk = TreeWalk { tree, visits: self.visits };
            setup.search(self.s, walk, StartingRays { lanes: live, leaving }, begun, &mut exact)
        };
        self.count_visits();
        open & slots.is(NONE)
    }
}
