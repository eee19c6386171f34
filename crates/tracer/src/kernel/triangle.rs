//! Rays against a triangle: edge values as scalar triple products, with error bounds.
//!
//! After Segura and Feito, "Algorithms to test ray–triangle intersection", WSCG 2001, with the edge itself in the
//! product, so that errors shrink with the triangle.

use catoptra_core::geometry::unit_normal;
use catoptra_core::glam::DVec3;
use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::{PlaneRow, Proposal, Rays};
use crate::lanes::{F, M, cross, magnitude, splat3};
use crate::numeric::{EDGE_ERROR, magnitude_of, rounded};

/// A single triangle, or a face of a solid.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TriangleRow {
    /// The plane that it lies in.
    pub(crate) plane: PlaneRow,
    pub(crate) facet: u32,
    edges: Edges,
}

impl AsRef<PlaneRow> for TriangleRow {
    fn as_ref(&self) -> &PlaneRow {
        &self.plane
    }
}

impl TriangleRow {
    /// A facet of the shape `prim`; `None` without area.
    pub(crate) fn new(corners: [DVec3; 3], prim: u32, facet: u32) -> Option<Self> {
        let largest = corners.map(magnitude_of).into_iter().fold(0.0, f32::max);
        Some(Self {
            plane: PlaneRow::new(corners[0], unit_normal(&corners)?, prim),
            facet,
            edges: Edges::new(&corners.map(rounded), largest),
        })
    }

    /// Its corners, rounded.
    pub(crate) fn corners(&self) -> [DVec3; 3] {
        self.edges.corners.map(|corner| DVec3::from(corner.map(f64::from)))
    }

    #[inline(always)]
    pub(crate) fn propose<S: Simd>(&self, s: S, rays: &Rays<S>) -> Proposal<S> {
        let Within { inside, miss } = self.edges.within(s, rays);
        let none = F::splat(s, 0.0);
        if !(!miss).any() {
            let nowhere = inside & miss;
            return Proposal { t: none, error: none, hit: nowhere, undecided: nowhere };
        }
        let plane = self.plane.propose(s, rays);
        Proposal {
            hit: plane.hit & inside,
            undecided: !miss & (plane.undecided | (plane.hit & !inside)),
            ..plane
        }
    }
}

/// On which side of a triangle's edges rays pass, within the error bounds of `f32`.
struct Within<S: Simd> {
    inside: M<S>,
    miss: M<S>,
}

/// What the test needs of a triangle.
#[derive(Debug, Clone, Copy)]
struct Edges {
    corners: [[f32; 3]; 3],
    /// Edge `i` runs opposite corner `i`.
    edges: [[f32; 3]; 3],
    /// Largest coordinate of an edge.
    length: f32,
    /// Sum of coordinates' magnitudes of the farthest corner.
    reach: f32,
}

impl Edges {
    /// Of corners whose coordinates sum up to at most `reach` in magnitude.
    fn new(corners: &[[f32; 3]; 3], reach: f32) -> Self {
        let [a, b, c] = *corners;
        let minus = |p: [f32; 3], q: [f32; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
        let edges = [minus(c, b), minus(a, c), minus(b, a)];
        let length = edges.as_flattened().iter().fold(0.0_f32, |l, e| l.max(e.abs()));
        Self { corners: *corners, edges, length, reach }
    }

    #[inline(always)]
    fn within<S: Simd>(&self, s: S, rays: &Rays<S>) -> Within<S> {
        let zero = F::splat(s, 0.0);
        let size = rays.reach + F::splat(s, self.reach);
        let spread = magnitude(rays.direction) * F::splat(s, self.length);
        let edge_error = spread * (size * F::splat(s, EDGE_ERROR));
        let (mut above, mut below) = (zero.less(zero), zero.less(zero));
        let (mut all_above, mut all_below) = (!above, !above);
        for i in 0..3 {
            let from = splat3(s, self.corners[(i + 1) % 3]) - rays.origin;
            let w = cross(splat3(s, self.edges[i]), from).dot(rays.direction);
            let (up, down) = (edge_error.less(w), w.less(-edge_error));
            (above, below) = (above | up, below | down);
            (all_above, all_below) = (all_above & up, all_below & down);
        }
        Within { inside: all_above | all_below, miss: above & below }
    }
}
