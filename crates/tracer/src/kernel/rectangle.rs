//! Rays against a rectangle: its plane, then how far along its edges.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::Simd;

use super::{PlaneRow, Proposal, Rays, bound, magnitude_of, rounded};
use crate::lanes::{F, splat3};
use crate::numeric::POINT_ERROR;

/// A rectangle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RectangleRow {
    pub(crate) plane: PlaneRow,
    corner: [f32; 3],
    /// Each edge over the square of its length: its scalar product with a point is the share of the edge.
    along: [[f32; 3]; 2],
    /// Sum of coordinates' magnitudes of the edges so divided.
    steepness: f32,
    reach: f32,
}

impl RectangleRow {
    pub(crate) fn new(corner: DVec3, edges: [DVec3; 2], prim: u32) -> Self {
        let along = edges.map(|e| e / e.length_squared());
        let farthest = magnitude_of(corner) + magnitude_of(edges[0]) + magnitude_of(edges[1]);
        Self {
            plane: PlaneRow::new(corner, edges[0].cross(edges[1]).normalize_or_zero(), prim),
            corner: rounded(corner),
            along: along.map(rounded),
            steepness: magnitude_of(along[0]).max(magnitude_of(along[1])),
            reach: farthest,
        }
    }

    #[inline(always)]
    pub(crate) fn propose<S: Simd>(&self, s: S, rays: &Rays<S>) -> Proposal<S> {
        let plane = self.plane.propose(s, rays);
        if !(plane.hit | plane.undecided).any() {
            return plane;
        }
        let (zero, one) = (F::splat(s, 0.0), F::splat(s, 1.0));
        let point = rays.direction.scale_add(plane.t, rays.origin - splat3(s, self.corner));
        let point_error =
            (rays.reach + F::splat(s, self.reach)).mul_add(F::splat(s, POINT_ERROR), plane.error);
        let error = bound(s, point_error * F::splat(s, self.steepness));
        let (mut inside, mut outside) = (!zero.less(zero), zero.less(zero));
        for along in self.along {
            let share = splat3(s, along).dot(point);
            inside = inside & error.less(share) & share.less(one - error);
            outside = outside | share.less(-error) | (one + error).less(share);
        }
        Proposal {
            hit: plane.hit & inside,
            undecided: plane.undecided | (plane.hit & !(inside | outside)),
            ..plane
        }
    }
}
