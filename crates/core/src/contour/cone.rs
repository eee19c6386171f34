//! Which cone of directions does a flat-faced blocker hide, as seen past a lamp's plane?

use glam::DVec3;

use super::blocker::Solid;
use super::held;
use super::lamp::{Face, unit};
use super::place::rounding;
use super::view::View;
use crate::numeric::UNIT_ROUNDOFF_F64;

/// The directions on the side of every plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cone {
    planes: [DVec3; MOST_PLANES],
    count: usize,
}

/// The most planes of a cone: the edges of a face or of a solid's outline, and a lamp's plane.
const MOST_PLANES: usize = 16;

/// The most corners of a face.
pub(super) const MOST_CORNERS: usize = MOST_PLANES - 1;

/// The most faces of a solid: those that look at the eye are remembered as bits.
pub(super) const MOST_FACES: usize = 64;

impl Cone {
    pub(super) const EVERYTHING: Self = Self { planes: [DVec3::ZERO; MOST_PLANES], count: 0 };

    /// Unit normals of planes through the eye.
    pub(super) fn planes(&self) -> &[DVec3] {
        &self.planes[..self.count]
    }

    fn push(&mut self, plane: DVec3) {
        self.planes[self.count] = plane;
        self.count += 1;
    }

    /// Adds a plane with a normal of any length but zero.
    pub(super) fn push_any(&mut self, normal: DVec3) {
        if let Some(plane) = unit(normal) {
            self.push(plane);
        }
    }

    /// Adds the plane through an edge as seen from the eye, the cone to the left of it; none where the eye looks along the edge.
    /// The same edge the other way gives the same bits, with the other sign: two faces part where they meet.
    #[inline]
    fn push_edge(&mut self, from: DVec3, to: DVec3) {
        let is_ordered = from.to_array() < to.to_array();
        let (first, second) = if is_ordered { (from, to) } else { (to, from) };
        let along = second - first;
        let plane = first.cross(along);
        // Three roundings in each coordinate of the product.
        let certain = 3.0 * UNIT_ROUNDOFF_F64;
        let length2 = plane.length_squared();
        if length2 > certain * certain * first.length_squared() * along.length_squared() {
            let length = if is_ordered { length2.sqrt() } else { -length2.sqrt() };
            self.push(plane / length);
        }
    }

    /// The cone of a flat polygon in front of the eye; `None` where that lies in its plane.
    pub(super) fn of_polygon(eye: DVec3, flat: Face<'_>) -> Option<Self> {
        let corners = flat.corners;
        let towards = flat.normal.dot(corners[0] - eye);
        if !(towards.abs() > held::reach(eye, corners[0])) {
            return None;
        }
        let mut cone = Self::EVERYTHING;
        for (i, corner) in corners.iter().enumerate() {
            let [a, b] = [*corner - eye, corners[(i + 1) % corners.len()] - eye];
            if towards > 0.0 { cone.push_edge(a, b) } else { cone.push_edge(b, a) }
        }
        Some(cone)
    }

    /// That part of it that a flat lamp does not lie in front of; `None` where nothing is left.
    pub(super) fn before_lamp(mut self, eye: DVec3, flat: Face<'_>, view: &View) -> Option<Self> {
        let heights = Heights::of(eye, flat.corners, view);
        if heights.are_beyond() {
            return None;
        }
        if !heights.are_in_front() {
            // Where N·x = h and the lamp's plane L·x = H: on the near side of their common line.
            let own = flat.normal.dot(flat.corners[0] - eye);
            let plane = (flat.normal * view.height - view.away * own) * own.signum();
            self.push(unit(plane)?);
        }
        Some(self)
    }

    /// The cone of a convex solid that does not hold the eye: between faces that look at it and faces that look away; `None`
    /// where its outline has too many edges.
    pub(super) fn of_solid(eye: DVec3, solid: &Solid) -> Option<Self> {
        let mut cone = Self::EVERYTHING;
        let bits = solid.faces.iter().enumerate().map(|(i, face)| u64::from(looks_at(eye, face.view())) << i);
        let looking = bits.fold(0, |all, bit| all | bit);
        for edge in &solid.edges {
            let [first, second] = edge.faces.map(|face| looking >> face & 1 == 1);
            if first != second {
                if cone.count == MOST_PLANES {
                    return None;
                }
                let [a, b] = [edge.from - eye, edge.to - eye];
                if second { cone.push_edge(a, b) } else { cone.push_edge(b, a) }
            }
        }
        Some(cone)
    }
}

/// Whether the outer side of a face is seen from the eye, which does not lie in its plane.
pub(super) fn looks_at(eye: DVec3, face: Face<'_>) -> bool {
    let corner = face.corners[0];
    face.normal.dot(eye - corner) > held::reach(eye, corner)
}

/// How corners lie to a lamp's plane; within rounding they lie in it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Heights {
    least: f64,
    most: f64,
}

impl Heights {
    pub(super) fn of(eye: DVec3, corners: &[DVec3], view: &View) -> Self {
        let mut heights = Self { least: 0.0, most: 0.0 };
        for corner in corners {
            let height = view.height - view.away.dot(*corner - eye);
            if height.abs() > rounding(*corner, eye) {
                heights = Self { least: heights.least.min(height), most: heights.most.max(height) };
            }
        }
        heights
    }

    pub(super) fn are_in_front(self) -> bool {
        self.least >= 0.0
    }

    pub(super) fn are_beyond(self) -> bool {
        self.most <= 0.0
    }
}
