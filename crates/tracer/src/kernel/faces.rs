//! Rays against a single triangle, or against the faces of a solid, one after another.

use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use super::contract::off_planes;
use super::{Crossing, Facet, Kernel, NearHit, PlaneRow, Rays, TriangleRow, Tried};
use crate::lanes::{D, D3, F, F3, pick3, splat_wide, splat3};

/// The triangles of one shape, in order of their facets.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Faces<'a>(pub(crate) &'a [TriangleRow]);

impl Kernel for Faces<'_> {
    type Face = TriangleRow;

    #[inline(always)]
    fn faces(&self) -> &[TriangleRow] {
        self.0
    }

    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        for face in self.0 {
            let (proposal, lanes) = (face.propose(s, rays), tried.but_leaving(s, face.facet));
            found(Crossing { proposal, facet: Facet::Same(face.facet), lanes });
        }
    }

    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        (hit.point(), facing_normals32(s, self.0, hit))
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        let (normal, distance) = planes_met(s, self.0, hit);
        off_planes(normal, distance, hit)
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, hit: &impl NearHit<S>, _point: D3<S>) -> D3<S> {
        planes_met(s, self.0, hit).0
    }

    fn all_normals(&self, _center: DVec3, _half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        self.0.iter().all(|face| test(face.plane.normal, DVec3::ZERO))
    }

    fn is_outside(&self, point: DVec3) -> bool {
        self.0.len() == 1 || self.0.iter().any(|face| face.plane.is_before(point))
    }
}

/// Normals of the faces that lanes have hit.
#[inline(always)]
fn facing_normals32<S: Simd>(s: S, faces: &[impl AsRef<PlaneRow>], hit: &impl NearHit<S>) -> F3<S> {
    let mut normal = hit.point();
    let (facets, mask) = hit.facets();
    for (facet, lanes) in facets.groups(mask) {
        let Some(face) = faces.get(facet as usize) else { continue };
        normal = F3::select(lanes, splat3(s, face.as_ref().normal32), normal);
    }
    normal
}

/// Normals and distances of the planes of the faces that lanes have hit.
#[inline(always)]
pub(super) fn planes_met<S: Simd>(
    s: S,
    faces: &[impl AsRef<PlaneRow>],
    hit: &impl NearHit<S>,
) -> (D3<S>, D<S>) {
    let none = D::splat(s, 0.0);
    let (mut normal, mut distance) = (D3::splat(none), none);
    let (facets, mask) = hit.facets();
    for (facet, lanes) in facets.groups(mask) {
        let Some(face) = faces.get(facet as usize) else { continue };
        normal = pick3(lanes, splat_wide(s, face.as_ref().normal), normal);
        distance = D::pick(lanes, D::splat(s, face.as_ref().distance), distance);
    }
    (normal, distance)
}
