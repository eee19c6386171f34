//! Rays against a flat shape: its plane, then whether they pass within its outline.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, LaneMask};
use fearless_simd::Simd;

use super::contract::surface_on_planes;
use super::{
    Crossing, DiskOutline, Facet, Kernel, NearHit, PlaneRow, Proposal, Rays, RectangleOutline, Tried, bound,
};
use crate::lanes::{D, D3, F, F3, M, splat_wide, splat3};
use crate::numeric::{POINT_ERROR, rounded};

/// A bounded flat shape.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlatRow {
    pub(crate) plane: PlaneRow,
    /// A point of its plane.
    from: [f32; 3],
    outline: Outline,
    reach: f32,
}

/// Where a flat shape ends.
#[derive(Debug, Clone, Copy)]
pub(super) enum Outline {
    Rectangle(RectangleOutline),
    Disk(DiskOutline),
}

/// Points of a plane that lie within an outline for certain, and those that lie outside it.
pub(super) struct Sides<S: Simd> {
    pub(super) inside: M<S>,
    pub(super) outside: M<S>,
}

impl FlatRow {
    /// Within an outline as seen from a point of its plane, no coordinate of which is larger than `reach`.
    pub(super) fn new(from: DVec3, normal: DVec3, outline: Outline, reach: f32, prim: u32) -> Self {
        Self { plane: PlaneRow::new(from, normal, prim), from: rounded(from), outline, reach }
    }

    #[inline(always)]
    pub(crate) fn propose<S: Simd>(&self, s: S, rays: &Rays<S>) -> Proposal<S> {
        let plane = self.plane.propose(s, rays);
        if !(plane.hit | plane.undecided).any() {
            return plane;
        }
        let point = rays.direction.scale_add(plane.t, rays.origin - splat3(s, self.from));
        let error = (rays.reach + F::splat(s, self.reach)).mul_add(F::splat(s, POINT_ERROR), plane.error);
        let Sides { inside, outside } = self.outline.sides(s, point, bound(s, error));
        Proposal {
            hit: plane.hit & inside,
            undecided: plane.undecided | (plane.hit & !(inside | outside)),
            ..plane
        }
    }
}

impl Outline {
    /// On which side points lie whose coordinates may each be off by an error.
    #[inline(always)]
    fn sides<S: Simd>(&self, s: S, point: F3<S>, error: F<S>) -> Sides<S> {
        match self {
            Self::Rectangle(outline) => outline.sides(s, point, error),
            Self::Disk(outline) => outline.sides(s, point, error),
        }
    }
}

impl Kernel for FlatRow {
    type Face = PlaneRow;

    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        let (proposal, lanes) = (self.propose(s, rays), tried.but_leaving(s, 0));
        found(Crossing { proposal, facet: Facet::Same(0), lanes });
    }

    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        match self.outline {
            Outline::Rectangle(_) => self.plane.surface(s, hit),
            Outline::Disk(_) => {
                let (normal, distance) = (splat_wide(s, self.plane.normal), D::splat(s, self.plane.distance));
                surface_on_planes(normal, distance, hit)
            }
        }
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        self.plane.off(s, hit)
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, hit: &impl NearHit<S>, point: D3<S>) -> D3<S> {
        self.plane.normal(s, hit, point)
    }

    fn all_normals(&self, center: DVec3, half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        self.plane.all_normals(center, half, test)
    }

    fn is_outside(&self, _point: DVec3) -> bool {
        true
    }
}
