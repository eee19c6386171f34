//! Does a mesh enclose something?
//!
//! It does where as many triangles run along each edge one way as the other. Corners in one place are one corner, whatever
//! their numbers: files repeat them where texture coordinates have a seam.

use std::collections::HashMap;
use std::fmt;

use glam::DVec3;

use super::TriangleMesh;
use super::derived::Derived;
use super::triangle_mesh::place;

/// An edge where the surface of a mesh is not closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OpenEdge {
    /// From here, where the mesh has it before it is placed.
    pub from: DVec3,
    /// To here.
    pub to: DVec3,
    /// How many triangles run along it that way.
    pub forwards: u32,
    /// How many run along it the other way.
    pub backwards: u32,
    /// How many edges of the mesh are open.
    pub of: u32,
}

/// For messages: `as 3 of its edges are open: that from 0 0 0 to 1 0 0 belongs to one triangle alone`.
impl fmt::Display for OpenEdge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [from, to] = [self.from, self.to].map(|p| format!("{} {} {}", p.x, p.y, p.z));
        match self.of {
            1 => write!(f, "as one of its edges is open: ")?,
            of => write!(f, "as {of} of its edges are open: ")?,
        }
        write!(f, "that from {from} to {to} ")?;
        match (self.forwards, self.backwards) {
            (1, 0) | (0, 1) => write!(f, "belongs to one triangle alone"),
            (count, 0) | (0, count) => {
                write!(f, "belongs to {count} triangles that run along it the same way")
            }
            (one, other) => {
                write!(f, "belongs to {one} triangles that run along it one way and {other} the other way")
            }
        }
    }
}

/// Whether a mesh is closed, found out when first asked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Watertight(Derived<Option<OpenEdge>>);

impl Watertight {
    /// An edge where the mesh is open; `None` where it is closed.
    pub(super) fn open_edge(&self, mesh: &TriangleMesh) -> Option<OpenEdge> {
        *self.0.get_or_make(|| open_edge(mesh))
    }
}

/// The first of the open edges.
fn open_edge(mesh: &TriangleMesh) -> Option<OpenEdge> {
    let corners = merged(mesh.positions());
    let mut edges: Vec<([u32; 2], bool)> = Vec::with_capacity(3 * mesh.triangles().len());
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|corner| corners[corner as usize]);
        let own = [[a, b], [b, c], [c, a]].into_iter().filter(|[from, to]| from != to);
        edges.extend(own.map(|[from, to]| ([from.min(to), from.max(to)], from < to)));
    }
    edges.sort_unstable();
    let mut open: Option<OpenEdge> = None;
    for same in edges.chunk_by(|a, b| a.0 == b.0) {
        let forwards = same.iter().filter(|(_, forwards)| *forwards).count() as u32;
        let backwards = same.len() as u32 - forwards;
        if forwards == backwards {
            continue;
        }
        let [from, to] =
            same[0].0.map(|i| DVec3::from(mesh.positions()[i as usize].map(f64::from)) + mesh.offset());
        let first = open.get_or_insert(OpenEdge { from, to, forwards, backwards, of: 0 });
        first.of += 1;
    }
    open
}

/// For each corner the number of the first that lies in the same place.
fn merged(positions: &[[f32; 3]]) -> Vec<u32> {
    let mut first = HashMap::with_capacity(positions.len());
    let places = positions.iter().map(|p| place(*p)).zip(0_u32..);
    places.map(|(place, number)| *first.entry(place).or_insert(number)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// The faces of a tetrahedron, outwards.
    const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    fn mesh(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> TriangleMesh {
        TriangleMesh::new(positions.to_vec(), triangles.to_vec(), None, None).unwrap()
    }

    #[test]
    fn a_hole_is_told_with_its_edge() {
        assert_eq!(mesh(&CORNERS, &FACES).open_edge(), None);
        let open = mesh(&CORNERS, &FACES[..3]).open_edge().unwrap();
        assert_eq!(
            open.to_string(),
            "as 3 of its edges are open: that from 0 0 0 to 0 1 0 belongs to one triangle alone"
        );
    }

    #[test]
    fn a_face_that_looks_inwards_is_told() {
        let turned = [FACES[0], FACES[1], FACES[2], [0, 2, 3]];
        let open = mesh(&CORNERS, &turned).open_edge().unwrap();
        assert_eq!(
            open.to_string(),
            "as 3 of its edges are open: that from 0 0 0 to 0 1 0 belongs to 2 triangles that run along it the same way"
        );
    }

    #[test]
    fn corners_in_one_place_are_one() {
        // Each face with corners of its own, zeros with either sign.
        let sign = |face: usize, c: f32| if c == 0.0 && face % 2 == 1 { -0.0 } else { c };
        let places = FACES.iter().enumerate().flat_map(|(face, corners)| {
            corners.map(|corner| CORNERS[corner as usize].map(|c| sign(face, c)))
        });
        let own: Vec<[f32; 3]> = places.collect();
        let triangles: Vec<[u32; 3]> = (0..4).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
        assert_eq!(mesh(&own, &triangles).open_edge(), None);
        // A triangle that is none closes nothing and opens nothing.
        assert_eq!(mesh(&CORNERS, &[&FACES[..], &[[1, 1, 2]]].concat()).open_edge(), None);
    }
}
