//! Convex polygons of directions round the eye: how are they cut, and what is their share of the contour?
//!
//! A polygon is a loop of vectors from the eye, of any length, counter-clockwise as seen from outside the sphere of
//! directions. Each corner also holds the plane of the edge that leaves it: an edge keeps its plane when it is cut, however
//! short the rest, and neighbours share planes bit for bit.
//!
//! Outlines of neighbouring faces share edges and corners, so that planes run along edges and through corners but for
//! rounding. A corner that near to a plane lies in it: to which side it lies would be chance, and might be another for each
//! corner of an edge. What is cut off then is no polygon that its planes bound.

use glam::DVec3;

use super::angle::angle;
use crate::numeric::CUT_ROUNDING;

/// A corner and the edge from it to the next one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// From the eye; only its direction matters.
    pub at: DVec3,
    /// Unit normal of the plane through the eye and the edge; the polygon lies on its side. Zero where the eye looks along
    /// the edge.
    pub edge: DVec3,
}

/// Unit normal of the plane through the eye and the edge between two places, zero where the eye looks along it.
#[inline]
pub(super) fn edge_to(at: DVec3, next: DVec3) -> DVec3 {
    at.cross(next - at).normalize_or_zero()
}

/// Twice the projected solid angle of a polygon above the horizon: Σ n·g θ over its edges.
#[inline]
pub(super) fn contour(normal: DVec3, piece: &[Corner]) -> f64 {
    let mut sum = 0.0;
    for_each_edge(piece, |corner, next| {
        sum += normal.dot(corner.edge) * edge_angle(corner, next - corner.at, next);
    });
    sum
}

/// The angle along an edge, positive in its direction.
#[inline]
fn edge_angle(corner: Corner, along: DVec3, next: DVec3) -> f64 {
    angle(corner.edge.dot(corner.at.cross(along)), corner.at.dot(next))
}

/// Every corner with the place of the next.
#[inline]
pub(super) fn for_each_edge(piece: &[Corner], mut visit: impl FnMut(Corner, DVec3)) {
    let Some(first) = piece.first() else { return };
    for (i, corner) in piece.iter().enumerate() {
        visit(*corner, piece.get(i + 1).unwrap_or(first).at);
    }
}

/// Gives out, corner by corner, what of a polygon lies on the side that a plane through the eye looks to. Corners within `off`
/// of the plane count as lying in it.
#[inline]
pub(super) fn half(piece: &[Corner], plane: DVec3, off: f64, mut out: impl FnMut(Corner)) {
    let Some(first) = piece.first() else { return };
    let height_of = |corner: &Corner| {
        let height = plane.dot(corner.at);
        if height.abs() <= off { 0.0 } else { height }
    };
    let mut height = height_of(first);
    for (i, corner) in piece.iter().enumerate() {
        let next = piece.get(i + 1).unwrap_or(first);
        let next_height = height_of(next);
        if height >= 0.0 {
            let leaves = height == 0.0 && next_height < 0.0;
            out(if leaves { Corner { at: corner.at, edge: plane } } else { *corner });
        }
        if (height > 0.0 && next_height < 0.0) || (height < 0.0 && next_height > 0.0) {
            let at = corner.at + (next.at - corner.at) * (height / (height - next_height));
            out(Corner { at, edge: if height > 0.0 { plane } else { corner.edge } });
        }
        height = next_height;
    }
}

/// Whether no corner of a polygon lies on the side that a plane through the eye looks to, by more than `off`.
#[inline]
fn is_outside(piece: &[Corner], plane: DVec3, off: f64) -> bool {
    piece.iter().all(|corner| plane.dot(corner.at) <= off)
}

/// Whether no corner lies on the other side.
#[inline]
fn is_inside(piece: &[Corner], plane: DVec3, off: f64) -> bool {
    piece.iter().all(|corner| plane.dot(corner.at) >= -off)
}

/// Convex polygons that do not overlap.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    corners: Vec<Corner>,
    ends: Vec<usize>,
    /// How far from a plane a corner may be and still count as lying in it.
    off: f64,
}

impl Pieces {
    /// Forgets all but one polygon, of which others are to be cut.
    pub(super) fn begin(&mut self, whole: &[Corner]) {
        let reach2 = whole.iter().map(|corner| corner.at.length_squared()).fold(0.0, f64::max);
        self.clear(CUT_ROUNDING * reach2.sqrt());
        self.push(whole);
    }

    fn clear(&mut self, off: f64) {
        self.corners.clear();
        self.ends.clear();
        self.off = off;
    }

    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[Corner]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(from, to)| &self.corners[from..*to])
    }

    fn push(&mut self, piece: &[Corner]) {
        self.corners.extend_from_slice(piece);
        self.ends.push(self.corners.len());
    }

    /// Adds the part of a polygon on one side of a plane through the eye, if it has corners enough.
    fn push_half(&mut self, piece: &[Corner], plane: DVec3) {
        let start = self.corners.len();
        half(piece, plane, self.off, |corner| self.corners.push(corner));
        if self.corners.len() < start + 3 {
            self.corners.truncate(start);
        } else {
            self.ends.push(self.corners.len());
        }
    }

    /// Takes a convex cone, the space on the side of all `planes`, away from all of `pieces`. `self` is overwritten with the
    /// rest; a polygon that the cone does not meet, or not in a part that `is_lit`, stays as it is. Whether it meets any.
    pub(super) fn set_to_rest(
        &mut self,
        pieces: &Self,
        planes: &[DVec3],
        spare: &mut [Vec<Corner>; 2],
        mut is_lit: impl FnMut(&[Corner]) -> bool,
    ) -> bool {
        self.clear(pieces.off);
        let mut meets = false;
        for piece in pieces.iter() {
            if planes.iter().any(|plane| is_outside(piece, *plane, self.off)) {
                self.push(piece);
                continue;
            }
            let before = (self.corners.len(), self.ends.len());
            if !(self.push_rest(piece, planes, spare) && is_lit(&spare[0])) {
                self.corners.truncate(before.0);
                self.ends.truncate(before.1);
                self.push(piece);
                continue;
            }
            meets = true;
        }
        meets
    }

    /// Adds what of one polygon lies outside a cone, plane by plane; `false` where the cone does not meet it.
    fn push_rest(
        &mut self,
        piece: &[Corner],
        planes: &[DVec3],
        [inside, next]: &mut [Vec<Corner>; 2],
    ) -> bool {
        inside.clear();
        inside.extend_from_slice(piece);
        for plane in planes {
            if is_inside(inside, *plane, self.off) {
                continue;
            }
            next.clear();
            half(inside, *plane, self.off, |corner| next.push(corner));
            if next.len() < 3 || is_outside(next, *plane, self.off) {
                return false;
            }
            self.push_half(inside, -*plane);
            std::mem::swap(inside, next);
        }
        true
    }
}
