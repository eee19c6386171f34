//! Rays against a solid of flat facets that need not be convex: the triangles of all facets, one after another.

use catoptra_core::geometry::Faceted;
use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::contract::{off_planes, surface_on_planes};
use super::faces::planes_met;
use super::{Crossing, Facet, Kernel, NearHit, PlaneRow, Proposal, Rays, TriangleRow, Tried};
use crate::lanes::{D3, F, F3, M, U};

/// The triangles of such a solid, and the planes of its facets.
#[derive(Debug, Clone)]
pub(crate) struct FacetsRow {
    triangles: Vec<TriangleRow>,
    planes: Vec<PlaneRow>,
}

impl FacetsRow {
    /// `None` where a facet or a triangle of it has no area.
    pub(crate) fn new(solid: &Faceted, prim: u32) -> Option<Self> {
        let (mut triangles, mut planes) = (Vec::new(), Vec::new());
        for facet in 0..solid.count() {
            let normal = Some(solid.normal(facet)).filter(|normal| *normal != DVec3::ZERO)?;
            let corner = solid.corners()[*solid.outline(facet).first()? as usize];
            planes.push(PlaneRow::new(corner, normal, prim));
            for corners in solid.triangles(facet) {
                triangles.push(TriangleRow::new(corners, prim, facet)?);
            }
        }
        Some(Self { triangles, planes })
    }
}

impl Kernel for FacetsRow {
    type Face = PlaneRow;

    /// The nearest of all crossings; where two are too near each other to tell, nothing is decided.
    #[inline(always)]
    fn propose<S: Simd>(&self, s: S, rays: &Rays<S>, tried: &Tried<S>, mut found: impl FnMut(Crossing<S>)) {
        let (ever, none) = (F::splat(s, f32::INFINITY), M::splat(s, false));
        let (mut t, mut error, mut facet) = (ever, F::splat(s, 0.0), U::splat(s, 0));
        let (mut close, mut undecided) = (none, none);
        for triangle in &self.triangles {
            let lanes = tried.but_leaving(s, triangle.facet);
            let one = triangle.propose(s, rays);
            undecided = undecided | (lanes & one.undecided);
            let hit = lanes & one.hit;
            if !hit.any() {
                continue;
            }
            let nearer = hit & (one.t + one.error).less(t - error);
            let same = hit & !nearer & !(t + error).less(one.t - one.error);
            // A nearer one ends a doubt about those behind it.
            close = (close & !nearer) | same;
            t = F::pick(nearer, one.t, t);
            error = F::pick(nearer, one.error, error);
            facet = U::pick(nearer, U::splat(s, triangle.facet), facet);
        }
        let proposal = Proposal { t, error, hit: t.less(ever) & !close, undecided: undecided | close };
        found(Crossing { proposal, facet: Facet::ByLane(facet), lanes: tried.lanes });
    }

    #[inline(always)]
    fn surface<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F3<S>, F3<S>) {
        let (normal, distance) = planes_met(s, &self.planes, hit);
        surface_on_planes(normal, distance, hit)
    }

    #[inline(always)]
    fn off<S: Simd>(&self, s: S, hit: &impl NearHit<S>) -> (F<S>, F<S>) {
        let (normal, distance) = planes_met(s, &self.planes, hit);
        off_planes(normal, distance, hit)
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, s: S, hit: &impl NearHit<S>, _point: D3<S>) -> D3<S> {
        planes_met(s, &self.planes, hit).0
    }

    fn all_normals(&self, _center: DVec3, _half: DVec3, test: impl Fn(DVec3, DVec3) -> bool) -> bool {
        self.planes.iter().all(|plane| test(plane.normal, DVec3::ZERO))
    }

    /// Rays that leave it may meet it again, wherever they begin.
    fn is_outside(&self, _point: DVec3) -> bool {
        true
    }
}
