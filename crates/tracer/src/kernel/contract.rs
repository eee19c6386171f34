//! The trait that the kernel of a shape implements.

use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use super::{Blocking, PlaneRow, Proposal, Rays, Target};
use crate::film::NOTHING;
use crate::lanes::{D, D3, F, F3, M, U, narrow3, widen3};

/// The surfaces that the rays of a packet leave.
#[derive(Clone, Copy)]
pub(crate) struct Leaving<S: Simd> {
    /// Shape that each ray leaves, [`NOTHING`] for rays that leave none.
    pub(crate) prim: U<S>,
    /// Facet that each ray leaves.
    pub(crate) facet: U<S>,
    /// Whether any ray leaves a surface.
    pub(crate) any: bool,
}

impl<S: Simd> Leaving<S> {
    /// Rays that leave no surface.
    #[inline(always)]
    pub(crate) fn nothing(s: S) -> Self {
        Self { prim: U::splat(s, NOTHING), facet: U::splat(s, 0), any: false }
    }

    /// The facet of a shape that each ray leaves; [`NOTHING`] where it leaves none of them.
    #[inline(always)]
    pub(crate) fn facets_of(&self, s: S, prim: u32) -> U<S> {
        U::pick(self.prim.is(prim), self.facet, U::splat(s, NOTHING))
    }

    /// Lanes whose rays leave a facet of a shape.
    #[inline(always)]
    pub(crate) fn from(&self, s: S, prim: u32, facet: u32) -> M<S> {
        if self.any { self.prim.is(prim) & self.facet.is(facet) } else { M::splat(s, false) }
    }
}

/// The rays that a shape is tried with.
#[derive(Clone, Copy)]
pub(crate) struct Tried<S: Simd> {
    pub(crate) prim: u32,
    /// Lanes that are tried.
    pub(crate) lanes: M<S>,
    /// Which surfaces the rays leave.
    pub(crate) leaving: Leaving<S>,
    /// The facets through which rays run into the solid that they leave; [`NOTHING`] for all others.
    pub(crate) entered: U<S>,
    /// Whether no ray starts inside a convex solid, so that it does not meet again the solid that it leaves.
    pub(crate) outside: bool,
}

impl<S: Simd> Tried<S> {
    /// The lanes that are tried, but for those that leave that very facet.
    #[inline(always)]
    pub(super) fn but_leaving(&self, s: S, facet: u32) -> M<S> {
        if self.leaving.any { self.lanes & !self.leaving.from(s, self.prim, facet) } else { self.lanes }
    }
}

/// The facet of a shape that the rays of a packet cross.
#[derive(Clone, Copy)]
pub(crate) enum Facet<S: Simd> {
    /// The same one in all lanes.
    Same(u32),
    /// One for each lane.
    ByLane(U<S>),
}

impl<S: Simd> Facet<S> {
    /// The facet of each lane.
    #[inline(always)]
    pub(crate) fn in_lanes(self, s: S) -> U<S> {
        match self {
            Self::Same(facet) => U::splat(s, facet),
            Self::ByLane(facets) => facets,
        }
    }

    /// The facet of all lanes, if it is the same.
    #[inline(always)]
    fn same(self) -> Option<u32> {
        match self {
            Self::Same(facet) => Some(facet),
            Self::ByLane(_) => None,
        }
    }
}

/// A crossing that a kernel proposes.
#[derive(Clone, Copy)]
pub(crate) struct Crossing<S: Simd> {
    pub(crate) proposal: Proposal<S>,
    /// The facet that it lies on.
    pub(crate) facet: Facet<S>,
    /// Lanes that it is proposed for.
    pub(crate) lanes: M<S>,
}

/// What a kernel finds out about segments to a target.
#[derive(Clone, Copy)]
pub(crate) struct Obstacle<S: Simd> {
    pub(crate) blocking: Blocking<S>,
    /// The facet in question, where it is the same in all lanes.
    pub(crate) facet: Option<u32>,
    /// Lanes that it holds for.
    pub(crate) lanes: M<S>,
}

/// Hits of a packet on a shape, with the precision of `f32`.
pub(crate) trait NearHit<S: Simd> {
    /// The points, in `f32`.
    fn point(&self) -> F3<S>;

    /// The points that the `f32` distances lead to in `f64`.
    fn near(&self) -> D3<S>;

    /// Unit directions of the rays.
    fn direction(&self) -> F3<S>;

    /// Facets that were met, of the lanes that met the shape.
    fn facets(&self) -> (U<S>, M<S>);
}

/// A shape that packets are tested against in `f32`.
pub(crate) trait Kernel {
    /// A face of a solid with flat faces.
    type Face: AsRef<PlaneRow>;

    /// The faces of a solid with flat faces, by facet, so that rays which leave it need not meet it again; none of any
    /// other shape.
    #[inline(always)]
    fn faces(&self) -> &[Self::Face] {
        &[]
    }

    /// Passes on the nearest crossing ahead of each piece of the shape.
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, found: impl FnMut(Crossing<S>));

    /// Passes on what blocks the segments from the rays' origins to a target.
    #[inline(always)]
    fn block<S: Simd>(
        &self,
        s: S,
        rays: &Rays<S>,
        target: &Target<S>,
        tried: &Tried<S>,
        mut found: impl FnMut(Obstacle<S>),
    ) {
        self.propose(
            s,
            rays,
            tried,
            #[inline(always)]
            |Crossing { proposal, facet, lanes }| {
                found(Obstacle { blocking: proposal.blocking(target), facet: facet.same(), lanes });
            },
        );
    }

    /// Points and outer unit normals to shade with, in `f32`.
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>);

    /// How far `f64` points near the shape are off it, in a measure of the shape's own, and how much that changes with
    /// a metre along the rays: what a Newton step needs.
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>);

    /// Outer unit normals at `f64` points of the shape.
    fn normal<S: Simd>(&self, s: S, hit: &impl NearHit<S>, point: D3<S>) -> D3<S>;

    /// Whether every normal that the surface has within a box, given by centre and half its size, passes a test; normals
    /// are given as one and how far each coordinate may differ.
    fn all_normals(&self, center: DVec3, half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool;

    /// Whether a point certainly lies outside the solid; also for shapes that have no inside.
    fn is_outside(&self, point: DVec3) -> bool;
}

/// How far points are off planes, and how much that changes along rays.
#[inline(always)]
pub(super) fn off_planes<S: Simd>(normal: D3<S>, distance: D<S>, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
    let off = normal.dot(hit.near()) - distance;
    (off.narrow(), narrow3(normal).dot(hit.direction()))
}

/// Points and normals on planes as exact as `f32` can hold them: one Newton step from the `f64` points that the `f32`
/// distances lead to.
#[inline(always)]
pub(super) fn surface_on_planes<S: Simd>(
    normal: D3<S>,
    distance: D<S>,
    hit: &impl NearHit<S>,
) -> (F3<S>, F3<S>) {
    let (off, slope) = off_planes(normal, distance, hit);
    let step = hit.direction().scale(-(off / slope));
    (narrow3(hit.near() + widen3(step)), narrow3(normal))
}
