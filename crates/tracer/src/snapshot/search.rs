//! What one ray meets, for certain: by the trees, and by trying everything.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::sync::Arc;

use catoptra_core::exact::{Number, Root, Verdict};
use catoptra_core::geometry::Mesh;
use catoptra_core::solid::Left;
use catoptra_core::{Crossing, Geometry, Member, Placement, Ray, Shape, Span, order_of_roots};

use super::origin::{is_exact, relative};
use super::{Prim, Snapshot};
use crate::accel::{MeshTree, WideTree};

/// A facet of a shape. A ray that leaves from one does not meet it again at its origin, nor triangles of the same mesh in the same
/// plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurfaceId {
    /// Which shape of the snapshot.
    pub prim: u32,
    /// Which flat piece of it; see [`Crossing::facet`].
    pub facet: u32,
}

/// What a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The facet of a shape that it meets.
    pub surface: SurfaceId,
    /// The crossing, in the snapshot's frame.
    pub crossing: Crossing,
}

impl Snapshot {
    /// What a ray in the snapshot's frame meets first, found by the trees; ties go to the shape with the lower id.
    #[must_use]
    pub fn nearest_in_frame(&self, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> Option<Hit> {
        self.nearest_on(&RaySegment::new(ray, span, self.left_by(leaving)))
    }

    /// Whether a ray in the snapshot's frame meets anything on the stretch, found by the trees.
    #[must_use]
    pub fn occluded_in_frame(&self, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> bool {
        self.is_occluded_on(&RaySegment::new(ray, span, self.left_by(leaving)))
    }

    /// What a ray in the snapshot's frame meets first, found by trying every shape and every triangle.
    #[must_use]
    pub fn nearest_of_all_in_frame(&self, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> Option<Hit> {
        self.nearest_of_all_on(&RaySegment::new(ray, span, self.left_by(leaving)))
    }

    /// A ray of the world in the snapshot's frame, unless that rounds it.
    pub(crate) fn exactly_own(&self, ray: &Ray) -> Option<Ray> {
        is_exact(ray.origin, self.frame).then(|| self.own_ray(ray))
    }

    /// Asks about a ray of the world: in the snapshot's frame, or where that rounds it, in the world.
    pub(crate) fn follow<T>(
        &self,
        ray: &Ray,
        span: Span,
        leaving: Option<SurfaceId>,
        search: impl FnOnce(&RaySegment<'_>) -> T,
    ) -> T {
        let leaving = self.left_by(leaving);
        match self.exactly_own(ray) {
            Some(own) => search(&RaySegment::new(&own, span, leaving)),
            None => search(&RaySegment { in_world: true, ..RaySegment::new(ray, span, leaving) }),
        }
    }

    /// As [`nearest_in_frame`](Self::nearest_in_frame).
    pub(crate) fn nearest_on(&self, segment: &RaySegment<'_>) -> Option<Hit> {
        let mut best = None;
        for &prim in self.index.unbounded.iter().filter(|&&prim| segment.sees(prim)) {
            best = self.closer(segment, best, self.cross(prim, &segment.until(best)));
        }
        self.index.tree.walk(&self.box_ray(segment), segment.until(best).span, |item| {
            let prim = self.index.bounded[item as usize];
            if segment.sees(prim) {
                best = self.closer(segment, best, self.cross(prim, &segment.until(best)));
            }
            segment.until(best).span.max
        });
        best
    }

    /// As [`occluded_in_frame`](Self::occluded_in_frame).
    pub(crate) fn is_occluded_on(&self, segment: &RaySegment<'_>) -> bool {
        self.any_in_the_way(segment, |prim| segment.sees(prim) && self.cross(prim, segment).is_some())
    }

    /// Whether a shape that a segment may meet blocks it.
    pub(super) fn any_in_the_way(
        &self,
        segment: &RaySegment<'_>,
        mut blocks: impl FnMut(u32) -> bool,
    ) -> bool {
        if self.index.unbounded.iter().any(|&prim| blocks(prim)) {
            return true;
        }
        let mut found = false;
        self.index.tree.walk(&self.box_ray(segment), segment.span, |item| {
            found = found || blocks(self.index.bounded[item as usize]);
            if found { f64::NEG_INFINITY } else { segment.span.max }
        });
        found
    }

    /// As [`nearest_of_all_in_frame`](Self::nearest_of_all_in_frame).
    pub(crate) fn nearest_of_all_on(&self, segment: &RaySegment<'_>) -> Option<Hit> {
        (0..self.prims.len() as u32)
            .filter(|&prim| self.first_in_place(prim) == prim)
            .fold(None, |best, prim| self.closer(segment, best, self.cross_whole(prim, &segment.until(best))))
    }

    /// The ray of a segment relative to the origin, rounded: for boxes, which are wide enough for that.
    pub(super) fn box_ray(&self, segment: &RaySegment<'_>) -> Ray {
        let zero = if segment.in_world { self.origin } else { self.origin_in_frame() };
        Ray::new(segment.ray.origin - zero, segment.ray.direction)
    }

    /// A shape in the space that a segment's ray is given in.
    pub(super) fn shape(&self, segment: &RaySegment<'_>, prim: u32) -> Cow<'_, Shape> {
        let shape = &self.prims[prim as usize].shape;
        if segment.in_world { relative(shape, -self.frame) } else { Cow::Borrowed(shape) }
    }

    /// A part of a solid in the space that a segment's ray is given in; `None` for other shapes.
    pub(super) fn member(&self, segment: &RaySegment<'_>, prim: u32) -> Option<Cow<'_, Member>> {
        let member = self.prims[prim as usize].member.as_ref()?;
        let moved = Placement::IDENTITY.moved(self.frame).ok().filter(|_| segment.in_world);
        Some(moved.map_or(Cow::Borrowed(member), |moved| Cow::Owned(member.placed(&moved))))
    }

    /// The surface of its solid that a ray leaves, as parts of the solid name it.
    pub(super) fn left(&self, prim: u32, leaving: Option<SurfaceId>) -> Option<Left> {
        let surface = leaving?;
        let left = &self.prims[surface.prim as usize];
        let same = left.body == self.prims[prim as usize].body;
        left.member
            .as_ref()
            .filter(|_| same)
            .map(|member| Left { member: member.number(), facet: surface.facet })
    }

    /// The nearer of two hits of one ray; the lower shape where they tie.
    fn closer(&self, segment: &RaySegment<'_>, a: Option<Hit>, b: Option<Hit>) -> Option<Hit> {
        match (a, b) {
            (Some(a), Some(b)) => Some(if self.precedes(segment, &b, &a) { b } else { a }),
            (a, b) => a.or(b),
        }
    }

    /// Whether a ray meets one hit before another: exactly, and of hits at the same `t` that with the lower shape, then
    /// the lower facet.
    pub(crate) fn precedes(&self, segment: &RaySegment<'_>, a: &Hit, b: &Hit) -> bool {
        let order = a.crossing.order(
            &b.crossing,
            || self.are_met_together(segment, a.surface, b.surface),
            || [a, b].map(|hit| self.root(segment, hit.surface)),
            || [a, b].map(|hit| self.root(segment, hit.surface)),
        );
        comes_first(order, a.surface, b.surface)
    }

    /// As [`precedes`](Self::precedes), of hits that are known to be ones, wherever they are.
    pub(crate) fn surface_precedes(&self, segment: &RaySegment<'_>, a: SurfaceId, b: SurfaceId) -> bool {
        let order = if self.are_met_together(segment, a, b) {
            Ordering::Equal
        } else {
            order_of_roots(
                || [a, b].map(|surface| self.root(segment, surface)),
                || [a, b].map(|surface| self.root(segment, surface)),
            )
        };
        comes_first(order, a, b)
    }

    /// Whether two triangles of meshes, both met, are seen to be met at one point.
    pub(super) fn are_met_together(&self, segment: &RaySegment<'_>, a: SurfaceId, b: SurfaceId) -> bool {
        let is_mesh = |of: SurfaceId| {
            let prim = &self.prims[of.prim as usize];
            prim.mesh.is_some() && prim.member.is_none()
        };
        if !is_mesh(a) || !is_mesh(b) {
            return false;
        }
        let [first, second] = [a, b].map(|of| self.shape(segment, of.prim));
        let (Some(first), Some(second)) = (first.as_mesh(), second.as_mesh()) else { return false };
        first.meets_together(a.facet, (second, b.facet), &first.own_ray(segment.ray))
    }

    pub(super) fn root<N: Number>(
        &self,
        segment: &RaySegment<'_>,
        surface: SurfaceId,
    ) -> Verdict<Option<Root<N>>> {
        if let Some(member) = self.member(segment, surface.prim) {
            return member.root(segment.ray, segment.span, self.left(surface.prim, segment.leaving));
        }
        let leaving = leaving_facet(surface.prim, segment.leaving);
        self.shape(segment, surface.prim).root(surface.facet, segment.ray, segment.span, leaving)
    }

    /// Where a ray in the snapshot's frame crosses one shape, or the facet of it alone where it is made of facets.
    pub(crate) fn cross_part(
        &self,
        prim: u32,
        facet: Option<u32>,
        ray: &Ray,
        span: Span,
        leaving: Option<SurfaceId>,
    ) -> Option<Hit> {
        let Prim { shape, member: None, .. } = &self.prims[prim as usize] else {
            return self.cross(prim, &RaySegment::new(ray, span, leaving));
        };
        let Some(facet) = facet else {
            return self.cross(prim, &RaySegment::new(ray, span, leaving));
        };
        hit_on(prim, shape.cross_part(facet, ray, span, leaving_facet(prim, leaving)))
    }

    /// The first of the meshes of the same triangles that stand where a shape does; the shape itself where it stands alone. Only
    /// the first is met.
    pub(crate) fn first_in_place(&self, prim: u32) -> u32 {
        let doubles = &self.index.doubles;
        doubles.binary_search_by_key(&prim, |[double, _]| *double).map_or(prim, |at| doubles[at][1])
    }

    /// Whether anything lies in the place of something else.
    pub(crate) fn has_doubles(&self) -> bool {
        let repeats = |tree: &Arc<MeshTree>| tree.mesh().firsts_in_place().is_some();
        !self.index.doubles.is_empty() || self.index.meshes.iter().any(repeats)
    }

    /// What a ray leaves that leaves a surface: the one that is met there.
    fn left_by(&self, leaving: Option<SurfaceId>) -> Option<SurfaceId> {
        leaving.map(|surface| self.surface_in_place(surface))
    }

    /// The surface that is met where a surface lies.
    pub(crate) fn surface_in_place(&self, SurfaceId { prim, facet }: SurfaceId) -> SurfaceId {
        let mesh = self.prims.get(prim as usize).and_then(|prim| prim.shape.as_mesh());
        let firsts = mesh.and_then(|mesh| mesh.triangles().firsts_in_place());
        let facet = firsts.and_then(|firsts| firsts.get(facet as usize)).copied().unwrap_or(facet);
        SurfaceId { prim: self.first_in_place(prim), facet }
    }

    /// The mesh that a shape is, if it is one.
    pub(crate) fn mesh_at(&self, prim: u32) -> Option<&Mesh> {
        self.prims[prim as usize].shape.as_mesh()
    }

    /// Where a ray crosses one shape; meshes by their tree.
    pub(super) fn cross(&self, prim: u32, segment: &RaySegment<'_>) -> Option<Hit> {
        let Some(tree) = self.prims[prim as usize].mesh else { return self.cross_whole(prim, segment) };
        let shape = self.shape(segment, prim);
        let (mesh, tree) = (shape.as_mesh()?, &self.index.meshes[tree as usize].tree);
        let leaving = leaving_facet(prim, segment.leaving);
        hit_on(prim, cross_mesh(mesh, tree, &mesh.own_ray(segment.ray), segment.span, leaving))
    }

    /// Where a ray crosses one shape, each of its pieces being tried; of a part of a solid, what is the solid's surface.
    fn cross_whole(&self, prim: u32, segment: &RaySegment<'_>) -> Option<Hit> {
        let RaySegment { ray, span, leaving, .. } = *segment;
        hit_on(
            prim,
            match self.member(segment, prim) {
                Some(member) => member.cross(ray, span, self.left(prim, leaving)),
                None => self.shape(segment, prim).cross(ray, span, leaving_facet(prim, leaving)),
            },
        )
    }
}

/// A crossing as a hit on a shape.
fn hit_on(prim: u32, crossing: Option<Crossing>) -> Option<Hit> {
    crossing.map(|crossing| Hit { surface: SurfaceId { prim, facet: crossing.facet }, crossing })
}

/// A ray, the stretch of it that counts, and the surface that it leaves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RaySegment<'a> {
    pub(crate) ray: &'a Ray,
    pub(crate) span: Span,
    pub(crate) leaving: Option<SurfaceId>,
    /// Whether the ray is given in the world, and not in the snapshot's frame.
    pub(crate) in_world: bool,
    /// A shape that it meets nowhere.
    pub(crate) without: Option<u32>,
}

impl<'a> RaySegment<'a> {
    /// In the snapshot's frame.
    pub(crate) fn new(ray: &'a Ray, span: Span, leaving: Option<SurfaceId>) -> Self {
        Self { ray, span, leaving, in_world: false, without: None }
    }

    /// Whether it may meet a shape at all.
    pub(super) fn sees(&self, prim: u32) -> bool {
        self.without != Some(prim)
    }

    /// The same segment, up to the latest `t` of the hit so far.
    fn until(&self, best: Option<Hit>) -> Self {
        let max = best.map_or(self.span.max, |hit| hit.crossing.latest().min(self.span.max));
        Self { span: Span { max, ..self.span }, ..*self }
    }
}

/// Whether one surface comes before another on a ray: by the order of their roots, or by their numbers if that is equal.
pub(super) fn comes_first(order: Ordering, a: SurfaceId, b: SurfaceId) -> bool {
    order.then((a.prim, a.facet).cmp(&(b.prim, b.facet))).is_lt()
}

/// The nearest crossing of a ray in a mesh's own space with its triangles; of crossings at the same `t`, that of the
/// lowest.
fn cross_mesh(mesh: &Mesh, tree: &WideTree, own: &Ray, span: Span, leaving: Option<u32>) -> Option<Crossing> {
    let mut best: Option<Crossing> = None;
    tree.walk(own, span, |triangle| {
        let far = |best: Option<Crossing>| best.map_or(span.max, |b| b.latest().min(span.max));
        let within = Span { max: far(best), ..span };
        if let Some(next) = mesh.cross_piece(triangle, own, within, leaving) {
            let precedes = |b: Crossing| match mesh.order(own, span, leaving, [&next, &b]) {
                Ordering::Equal => next.facet < b.facet,
                order => order.is_lt(),
            };
            if best.is_none_or(precedes) {
                best = Some(next);
            }
        }
        far(best)
    });
    best
}

/// The facet of a shape that a ray leaves, if it leaves that shape.
pub(crate) fn leaving_facet(prim: u32, leaving: Option<SurfaceId>) -> Option<u32> {
    leaving.filter(|surface| surface.prim == prim).map(|surface| surface.facet)
}
