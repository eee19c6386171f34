//! Occlusion of segments: of shadow rays from surfaces to a light, or of any others.

use catoptra_core::geometry::Mesh;
use catoptra_core::{LaneMask, Ray, Span};
use fearless_simd::Simd;

use super::Searcher;
use crate::Snapshot;
use crate::cull::Candidates;
use crate::film::NOTHING;
use crate::kernel::mesh::{AnyBundle, BundledRays, RaySetup};
use crate::kernel::{Blocking, Kernel, Leaving, Obstacle, PlaneRow, Rays, Target, Tried};
use crate::lanes::{Bits, F, M, U};
use crate::numeric::CERTAIN;
use crate::snapshot::{Instance, KernelVisitor, Row};

/// Segments that are tested for occlusion, one in every lane.
#[derive(Clone, Copy)]
pub(crate) struct ShadowRays<'a, S: Simd> {
    /// The segments as kernels see them; how far their starts and lengths may be off is part of their reach.
    pub(crate) rays: Rays<S>,
    /// Surfaces that they leave.
    pub(crate) leaving: Leaving<S>,
    /// Lanes that are segments at all.
    pub(crate) live: M<S>,
    /// Where they end.
    pub(crate) target: Target<S>,
    /// Where all end in one place: how far that lies behind each plane, see [`LightRow`](crate::snapshot::LightRow);
    /// else empty.
    pub(crate) behind: &'a [f64],
}

impl<S: Simd> ShadowRays<'_, S> {
    /// What a plane blocks.
    #[inline(always)]
    fn blocked_by_plane(&self, s: S, plane: &PlaneRow, row: u32) -> Blocking<S> {
        match self.behind.get(row as usize) {
            Some(&behind) => plane.block(s, &self.rays, behind),
            None => plane.propose(s, &self.rays).blocking(&self.target),
        }
    }
}

/// The shadow rays of a packet, and those of them that nothing has been found to block.
#[derive(Clone, Copy)]
pub(crate) struct Shadows<'a, S: Simd, G> {
    pub(crate) segments: &'a G,
    pub(crate) rays: ShadowRays<'a, S>,
    pub(crate) open: M<S>,
}

/// A shape that may block segments, or one facet of it.
#[derive(Clone, Copy)]
struct Blocker {
    prim: u32,
    facet: Option<u32>,
}

/// The `f64` segments of shadow rays, for what `f32` cannot decide; and how a mesh is searched for them.
pub(crate) trait Segments<S: Simd> {
    /// The segment of a lane, in the snapshot's frame.
    fn segment(&self, snapshot: &Snapshot, lane: usize) -> Option<(Ray, Span)>;

    /// The shape that they all end on, if that is known not to be in their way.
    #[inline(always)]
    fn arrives_at(&self) -> Option<u32> {
        None
    }

    /// The open ones of some packets as a bundle in the mesh's own space, if they have a common origin or direction. Fills
    /// `room`, which has as many places as there are packets.
    fn bundle(
        shadows: &[Shadows<'_, S, Self>],
        search: &Searcher<'_, S>,
        instance: &Instance,
        room: &mut [BundledRays<S>],
    ) -> Option<AnyBundle>
    where
        Self: Sized;

    /// The open ones as single rays in the mesh's own space, and which of them are rays at all.
    fn single_rays(
        &self,
        search: &Searcher<'_, S>,
        rays: &ShadowRays<'_, S>,
        open: M<S>,
        instance: &Instance,
        mesh: &Mesh,
    ) -> (RaySetup, M<S>);

    /// The span that single rays are searched on.
    fn span(&self, lane: usize) -> Span;
}

impl<S: Simd> Searcher<'_, S> {
    /// Which segments are blocked; `None` unless all occluders are planes and spheres and `f32` decides every lane.
    #[inline(always)]
    pub(crate) fn occluded_for_certain(
        &mut self,
        rays: &ShadowRays<'_, S>,
        occluders: &Candidates,
    ) -> Option<M<S>> {
        let columns = self.snapshot.columns();
        if occluders.tree || !columns.general_unbounded.is_empty() {
            return None;
        }
        let (mut open, mut undecided) = (rays.live, M::splat(self.s, false));
        for &row in &occluders.planes {
            let plane = &columns.planes[row as usize];
            let blocking = rays.blocked_by_plane(self.s, plane, row);
            let other = open & !rays.leaving.from(self.s, plane.prim, 0);
            undecided = undecided | (other & blocking.undecided);
            open = open & !(other & blocking.blocked);
        }
        for &prim in &occluders.bounded {
            let Row::Sphere(row) = columns.rows[prim as usize] else { return None };
            let own = rays.leaving.from(self.s, prim, 0) & open;
            if own.any() && !self.outside {
                return None;
            }
            let nothing = M::splat(self.s, false);
            let sphere = &columns.spheres[row as usize];
            let blocking = sphere.block(self.s, &rays.rays, &rays.target, nothing, self.outside);
            let other = open & !own;
            undecided = undecided | (other & blocking.undecided);
            open = open & !(other & blocking.blocked);
        }
        if undecided.any() {
            return None;
        }
        let tested = occluders.planes.len() + occluders.bounded.len();
        self.stats.tests.shapes += (tested * F::<S>::LANES) as u64;
        Some(rays.live & !open)
    }

    /// Which segments are blocked.
    #[inline(always)]
    pub(crate) fn occluded(
        &mut self,
        segments: &impl Segments<S>,
        rays: &ShadowRays<'_, S>,
        occluders: &Candidates,
    ) -> M<S> {
        let columns = self.snapshot.columns();
        let mut open = rays.live;
        for &row in &occluders.planes {
            let plane = &columns.planes[row as usize];
            let blocking = rays.blocked_by_plane(self.s, plane, row);
            let lanes = open & !rays.leaving.from(self.s, plane.prim, 0);
            open = self.close(segments, rays, open, plane.prim, Obstacle { blocking, facet: Some(0), lanes });
        }
        for &prim in &columns.general_unbounded {
            open = self.close_exactly(segments, rays, open, open, Blocker { prim, facet: None });
        }
        if !open.any() {
            return rays.live;
        }
        for &prim in &occluders.bounded {
            open = self.occlude_by(segments, rays, open, prim);
        }
        if occluders.tree {
            open = self.occlude_by_tree(segments, rays, open);
        }
        rays.live & !open
    }

    /// The segments that one bounded shape does not block.
    #[inline(always)]
    pub(crate) fn occlude_by(
        &mut self,
        segments: &impl Segments<S>,
        rays: &ShadowRays<'_, S>,
        open: M<S>,
        prim: u32,
    ) -> M<S> {
        if segments.arrives_at() == Some(prim) {
            return open;
        }
        let (s, columns) = (self.s, self.snapshot.columns());
        columns.visit(s, prim, OccludeBy { search: self, segments, rays: *rays, open, prim })
    }

    /// The segments still open after what a kernel found; what it could not decide is decided in `f64`.
    #[inline(always)]
    fn close(
        &mut self,
        segments: &impl Segments<S>,
        rays: &ShadowRays<'_, S>,
        open: M<S>,
        prim: u32,
        obstacle: Obstacle<S>,
    ) -> M<S> {
        self.stats.tests.shapes += F::<S>::LANES as u64;
        let Obstacle { blocking, facet, lanes } = obstacle;
        let undecided = lanes & blocking.undecided;
        let remaining = open & !(lanes & blocking.blocked & !undecided);
        if CERTAIN && undecided.any() {
            self.close_exactly(segments, rays, remaining, undecided, Blocker { prim, facet })
        } else {
            remaining
        }
    }

    /// Decides in `f64`, lane by lane, whether a shape blocks a segment.
    #[inline(always)]
    fn close_exactly(
        &mut self,
        segments: &impl Segments<S>,
        rays: &ShadowRays<'_, S>,
        open: M<S>,
        lanes: M<S>,
        blocker: Blocker,
    ) -> M<S> {
        let leaving = rays.leaving;
        let closed = self.closed_lanes(segments, &leaving, (lanes & open).bits(), blocker);
        open & !M::from_bits(self.s, closed)
    }

    #[cold]
    #[inline(never)]
    fn closed_lanes(
        &mut self,
        segments: &impl Segments<S>,
        leaving: &Leaving<S>,
        lanes: u64,
        blocker: Blocker,
    ) -> u64 {
        let snapshot = self.snapshot;
        let mut closed = 0;
        for lane in Bits(lanes) {
            self.stats.settled += 1;
            let Some((ray, span)) = segments.segment(snapshot, lane) else { continue };
            if snapshot.cross_part(blocker.prim, blocker.facet, &ray, span, leaving.lane(lane)).is_some() {
                closed |= 1 << lane;
            }
        }
        closed
    }
}

/// Tests segments against one shape, on copies; returns those that it does not block.
struct OccludeBy<'t, 'a, 'b, S: Simd, G> {
    search: &'t mut Searcher<'a, S>,
    segments: &'t G,
    rays: ShadowRays<'b, S>,
    open: M<S>,
    prim: u32,
}

impl<S: Simd, G: Segments<S>> KernelVisitor for OccludeBy<'_, '_, '_, S, G> {
    type Output = M<S>;

    #[inline(always)]
    fn visit(self, kernel: &impl Kernel) -> M<S> {
        let Self { search, segments, rays, mut open, prim } = self;
        let (s, leaving) = (search.s, rays.leaving);
        let mut tried =
            Tried { prim, lanes: open, leaving, entered: U::splat(s, NOTHING), outside: search.outside };
        if !kernel.faces().is_empty() {
            let hits = search.self_hits_of_segments(&rays, kernel.faces());
            open = search.close_exactly(segments, &rays, open, hits.undecided, Blocker { prim, facet: None });
            tried.lanes = open & hits.possible;
            if !tried.lanes.any() {
                return open;
            }
            tried.entered = hits.entered(s, &leaving);
        }
        kernel.block(
            s,
            &rays.rays,
            &rays.target,
            &tried,
            #[inline(always)]
            |obstacle: Obstacle<S>| {
                let obstacle = Obstacle { lanes: open & obstacle.lanes, ..obstacle };
                open = search.close(segments, &rays, open, prim, obstacle);
            },
        );
        open
    }

    #[inline(always)]
    fn visit_mesh(self, instance: &Instance) -> M<S> {
        if self.search.later.takes(self.prim) {
            return self.open;
        }
        self.search.occlude_by_mesh(self.segments, &self.rays, self.open, instance)
    }

    #[inline(always)]
    fn visit_none(self) -> M<S> {
        let Self { search, segments, rays, open, prim } = self;
        search.close_exactly(segments, &rays, open, open, Blocker { prim, facet: None })
    }
}
