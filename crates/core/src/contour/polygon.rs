//! Convex polygons of directions round the eye: how are they cut, and what is their share of the contour?
//!
//! A polygon is a loop of vectors from the eye, of any length, counter-clockwise as seen from outside the sphere of
//! directions. Each corner also holds the plane of the edge that leaves it: an edge keeps its plane when it is cut, however
//! short the rest, so slivers as short as rounding leave are harmless, and neighbours share planes bit for bit.

use glam::DVec3;

use super::angle::angle;

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

/// Gives out, corner by corner, what of a polygon lies on the side that a plane through the eye looks to.
#[inline]
pub(super) fn half(piece: &[Corner], plane: DVec3, mut out: impl FnMut(Corner)) {
    let Some(first) = piece.first() else { return };
    let mut height = plane.dot(first.at);
    for (i, corner) in piece.iter().enumerate() {
        let next = piece.get(i + 1).unwrap_or(first);
        let next_height = plane.dot(next.at);
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

/// Whether no corner of a polygon lies on the side that a plane through the eye looks to.
#[inline]
pub(super) fn is_outside(piece: &[Corner], plane: DVec3) -> bool {
    piece.iter().all(|corner| plane.dot(corner.at) <= 0.0)
}

/// Whether no corner lies on the other side.
#[inline]
pub(super) fn is_inside(piece: &[Corner], plane: DVec3) -> bool {
    piece.iter().all(|corner| plane.dot(corner.at) >= 0.0)
}

/// Convex polygons that do not overlap.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    corners: Vec<Corner>,
    ends: Vec<usize>,
}

impl Pieces {
    pub(super) fn clear(&mut self) {
        self.corners.clear();
        self.ends.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[Corner]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(from, to)| &self.corners[from..*to])
    }

    pub(super) fn push(&mut self, piece: &[Corner]) {
        self.corners.extend_from_slice(piece);
        self.ends.push(self.corners.len());
    }

    /// Adds the part of a polygon on one side of a plane through the eye, if it has corners enough.
    fn push_half(&mut self, piece: &[Corner], plane: DVec3) {
        let start = self.corners.len();
        half(piece, plane, |corner| self.corners.push(corner));
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
        self.clear();
        let mut meets = false;
        for piece in pieces.iter() {
            if planes.iter().any(|plane| is_outside(piece, *plane)) {
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
            if is_inside(inside, *plane) {
                continue;
            }
            next.clear();
            half(inside, *plane, |corner| next.push(corner));
            if next.len() < 3 {
                return false;
            }
            self.push_half(inside, -*plane);
            std::mem::swap(inside, next);
        }
        true
    }
}
