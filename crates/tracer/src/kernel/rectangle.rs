//! Points against a rectangle's outline: how far along its edges.

use catoptra_core::Lane;
use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use super::flat::{FlatRow, Outline, Sides};
use crate::lanes::{F, F3, splat3};
use crate::numeric::{magnitude_of, rounded};

/// A rectangle, seen from its corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct RectangleOutline {
    /// Each edge over the square of its length: its scalar product with a point is the share of the edge.
    along: [[f32; 3]; 2],
    /// Sum of coordinates' magnitudes of the edges so divided.
    steepness: f32,
}

impl FlatRow {
    /// The rectangle with these edges from a corner.
    pub(crate) fn rectangle(corner: DVec3, edges: [DVec3; 2], prim: u32) -> Self {
        let along = edges.map(|e| e / e.length_squared());
        let outline = RectangleOutline {
            along: along.map(rounded),
            steepness: magnitude_of(along[0]).max(magnitude_of(along[1])),
        };
        let farthest = magnitude_of(corner) + magnitude_of(edges[0]) + magnitude_of(edges[1]);
        let normal = edges[0].cross(edges[1]).normalize_or_zero();
        Self::new(corner, normal, Outline::Rectangle(outline), farthest, prim)
    }
}

impl RectangleOutline {
    #[inline(always)]
    pub(super) fn sides<S: Simd>(&self, s: S, point: F3<S>, error: F<S>) -> Sides<S> {
        let (zero, one) = (F::splat(s, 0.0), F::splat(s, 1.0));
        let error = error * F::splat(s, self.steepness);
        let (mut inside, mut outside) = (!zero.less(zero), zero.less(zero));
        for along in self.along {
            let share = splat3(s, along).dot(point);
            inside = inside & error.less(share) & share.less(one - error);
            outside = outside | share.less(-error) | (one + error).less(share);
        }
        Sides { inside, outside }
    }
}
