//! How does a mesh of few triangles become as round as its normals say?
//!
//! Light and shade go by where the surface is, and a mesh that only its normals make look smooth is flat: at the edge of the
//! light, shade follows the triangles in steps. Cut into smaller triangles that bulge as the normals say, it has a surface that
//! fits them (Boubekeur and Alexa, "Phong Tessellation", ACM Transactions on Graphics 27, 2008): every point moves towards
//! where the planes across the corners' normals are, which along an edge depends on nothing but the edge. So there are no gaps,
//! if edges across which normals jump stay straight.

use std::collections::HashMap;
use std::sync::Arc;

use glam::DVec3;

use super::TriangleMesh;
use super::derived::Derived;
use super::triangle_mesh::{place, widen};

/// How often triangles can be cut into four.
pub(super) const MOST_LEVELS: u32 = 5;

/// How much of the way points move: by half of it edges leave their corners across the normals, and an arc gets its true height,
/// as far as a parabola can be one.
const SHARE: f64 = 0.5;

/// A mesh cut once, twice and so on; each made when first asked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Subdivisions([Derived<Arc<TriangleMesh>>; MOST_LEVELS as usize]);

impl Subdivisions {
    /// The mesh, cut that often; `None` where it is not cut or has no normals to go by.
    pub(super) fn of(&self, mesh: &TriangleMesh, levels: u32) -> Option<Arc<TriangleMesh>> {
        let normals = mesh.normals()?;
        let made = self.0.get(levels.checked_sub(1)? as usize)?;
        Some(Arc::clone(made.get_or_make(|| Arc::new(cut(mesh, normals, 1 << levels)))))
    }
}

/// A place and a normal: corners in which both are the same are one.
type Corner = [[u32; 3]; 2];

/// A mesh that is being cut.
struct Cut<'a> {
    mesh: &'a TriangleMesh,
    normals: &'a [[f32; 3]],
    /// Into how many pieces each edge is cut.
    steps: u32,
    /// Edges by their places: the corners at their ends, and nothing where triangles disagree about these.
    edges: HashMap<[[u32; 3]; 2], Option<[Corner; 2]>>,
    /// New corners on edges, by the corners at their ends and the number of steps from the first.
    known: HashMap<[u32; 3], u32>,
    positions: Vec<[f32; 3]>,
    /// What each corner is made of: old corners, and how much of each.
    made_of: Vec<([u32; 3], [f64; 3])>,
}

/// Every triangle in `steps`² ones; corners stay what they are.
fn cut(mesh: &TriangleMesh, normals: &[[f32; 3]], steps: u32) -> TriangleMesh {
    let mut cut = Cut {
        mesh,
        normals,
        steps,
        edges: HashMap::new(),
        known: HashMap::new(),
        positions: mesh.positions().to_vec(),
        made_of: (0..mesh.positions().len() as u32).map(|i| ([i; 3], [1.0, 0.0, 0.0])).collect(),
    };
    for triangle in mesh.triangles() {
        sides(triangle).into_iter().for_each(|side| cut.note(side));
    }
    let mut triangles = Vec::with_capacity(mesh.triangles().len() * (steps * steps) as usize);
    for triangle in mesh.triangles() {
        cut.add(triangle, &mut triangles);
    }
    mesh.remade(cut.positions, triangles, &cut.made_of)
}

/// A place and a normal as a key: corners in which both are the same are one.
fn corner_of(position: [f32; 3], normal: [f32; 3]) -> Corner {
    [position, normal].map(place)
}

/// Normals that fit the triangles, so that shade ends where the surface turns from the light: of each corner the sum of those
/// round it, of one place apart where `normals` tell it apart.
pub(super) fn fitted(positions: &[[f32; 3]], triangles: &[[u32; 3]], normals: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let key = |i: usize| corner_of(positions[i], normals[i]);
    let mut sums: HashMap<Corner, DVec3> = HashMap::new();
    for triangle in triangles {
        let [a, b, c] = triangle.map(|i| widen(positions[i as usize]));
        let flat = (b - a).cross(c - a);
        for &corner in triangle {
            *sums.entry(key(corner as usize)).or_default() += flat;
        }
    }
    let fit = |i: usize| sums.get(&key(i)).and_then(|sum| sum.try_normalize());
    (0..positions.len())
        .map(|i| fit(i).map_or(normals[i], |normal| normal.to_array().map(|v| v as f32)))
        .collect()
}

fn sides([a, b, c]: &[u32; 3]) -> [[u32; 2]; 3] {
    [[*a, *b], [*b, *c], [*c, *a]]
}

impl Cut<'_> {
    fn corner(&self, number: u32) -> Corner {
        corner_of(self.mesh.positions()[number as usize], self.normals[number as usize])
    }

    /// An edge with its ends in an order that does not depend on the triangle.
    fn ordered(&self, [a, b]: [u32; 2]) -> [u32; 2] {
        if (self.corner(b), b) < (self.corner(a), a) { [b, a] } else { [a, b] }
    }

    fn note(&mut self, edge: [u32; 2]) {
        let ends = self.ordered(edge).map(|i| self.corner(i));
        let known = self.edges.entry(ends.map(|[place, _]| place)).or_insert(Some(ends));
        if *known != Some(ends) {
            *known = None;
        }
    }

    /// How far the middle of an edge bulges, times four; not at all where normals jump across it.
    fn bulge(&self, edge: [u32; 2]) -> DVec3 {
        let ends = self.ordered(edge);
        if self.edges.get(&ends.map(|i| self.corner(i)[0])).is_none_or(Option::is_none) {
            return DVec3::ZERO;
        }
        let [a, b] = ends.map(|i| widen(self.mesh.positions()[i as usize]));
        let [m, n] = ends.map(|i| widen(self.normals[i as usize]).normalize_or_zero());
        m * (a - b).dot(m) + n * (b - a).dot(n)
    }

    /// A point of a triangle by the steps from the first corner to the second and to the third.
    fn place(&self, corners: &[u32; 3], weights: [f64; 3]) -> [f32; 3] {
        let flat: DVec3 =
            (0..3).map(|k| widen(self.mesh.positions()[corners[k] as usize]) * weights[k]).sum();
        let bulge: DVec3 = sides(corners)
            .into_iter()
            .zip([weights[0] * weights[1], weights[1] * weights[2], weights[2] * weights[0]])
            .filter(|(_, share)| *share > 0.0)
            .map(|(side, share)| self.bulge(side) * share)
            .sum();
        (flat + bulge * SHARE).to_array().map(|v| v as f32)
    }

    fn push(&mut self, corners: [u32; 3], weights: [f64; 3]) -> u32 {
        self.positions.push(self.place(&corners, weights));
        self.made_of.push((corners, weights));
        self.positions.len() as u32 - 1
    }

    /// The corner so many steps from one end of an edge.
    fn on_edge(&mut self, edge: [u32; 2], steps: u32) -> u32 {
        let ends = self.ordered(edge);
        let steps = if ends == edge { steps } else { self.steps - steps };
        let key = [ends[0], ends[1], steps];
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let share = f64::from(steps) / f64::from(self.steps);
        let made = self.push([ends[0], ends[1], ends[0]], [1.0 - share, share, 0.0]);
        self.known.insert(key, made);
        made
    }

    /// The corner at so many steps from the first corner of a triangle to the second and to the third.
    fn at(&mut self, corners: &[u32; 3], [i, j]: [u32; 2]) -> u32 {
        let n = self.steps;
        let [a, b, c] = *corners;
        match [n - i - j, i, j] {
            [rest, 0, 0] if rest == n => a,
            [_, i, 0] if i == n => b,
            [_, 0, j] if j == n => c,
            [_, i, 0] => self.on_edge([a, b], i),
            [_, 0, j] => self.on_edge([a, c], j),
            [0, _, j] => self.on_edge([b, c], j),
            weights => self.push(*corners, weights.map(|k| f64::from(k) / f64::from(n))),
        }
    }

    /// Adds what a triangle is cut into.
    fn add(&mut self, corners: &[u32; 3], triangles: &mut Vec<[u32; 3]>) {
        let n = self.steps;
        let rows: Vec<Vec<u32>> =
            (0..=n).map(|j| (0..=n - j).map(|i| self.at(corners, [i, j])).collect()).collect();
        for (row, next) in rows.iter().zip(&rows[1..]) {
            for (i, &above) in next.iter().enumerate() {
                triangles.push([row[i], row[i + 1], above]);
                if let Some(&beside) = next.get(i + 1) {
                    triangles.push([row[i + 1], beside, above]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A regular octahedron with the normals of the ball round it.
    fn octahedron(smooth: bool) -> TriangleMesh {
        let axes = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        let corners = |[a, b, c]: [usize; 3]| [axes[a], axes[b], axes[c]];
        let faces = (0..4).flat_map(|i| [corners([i, (i + 1) % 4, 4]), corners([(i + 1) % 4, i, 5])]);
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        for face in faces {
            let flat = (face[1] - face[0]).cross(face[2] - face[0]);
            for p in face {
                positions.push(p.to_array().map(|v| v as f32));
                normals.push(if smooth { p } else { flat }.to_array().map(|v| v as f32));
            }
        }
        let triangles = (0..8).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        TriangleMesh::new(positions, triangles, Some(normals), None).unwrap()
    }

    #[test]
    fn a_mesh_becomes_round_and_stays_closed() {
        let mesh = octahedron(true);
        let cut = mesh.subdivided(3).unwrap();
        assert_eq!(cut.triangles().len(), 8 * 64);
        assert_eq!(cut.open_edge(), None);
        let radius = |p: &[f32; 3]| widen(*p).length();
        let least = cut.positions().iter().map(radius).fold(f64::INFINITY, f64::min);
        // Flat faces come as near as 0.577.
        assert!(least > 0.75, "{least}");
        for triangle in 0..cut.triangles().len() as u32 {
            let [a, b, c] = cut.corners(triangle);
            let (flat, smooth) = ((b - a).cross(c - a), cut.normal_at(triangle, [1.0 / 3.0; 3]).unwrap());
            let cosine = flat.normalize().dot(smooth.normalize());
            // Faces of the octahedron are off by as much as 0.577.
            assert!(cosine > 0.9, "{triangle}: {cosine}");
        }
    }

    #[test]
    fn edges_across_which_normals_jump_stay_straight_and_closed() {
        let cut = octahedron(false).subdivided(2).unwrap();
        assert_eq!(cut.open_edge(), None);
        for p in cut.positions() {
            let sum: f32 = p.iter().map(|v| v.abs()).sum();
            assert!((sum - 1.0).abs() < 1e-6, "{p:?}");
        }
    }

    #[test]
    fn what_has_no_normals_or_is_not_cut_stays_itself() {
        let mesh = octahedron(true);
        assert!(mesh.subdivided(0).is_none() && mesh.subdivided(MOST_LEVELS + 1).is_none());
        let bare =
            TriangleMesh::new(mesh.positions().to_vec(), mesh.triangles().to_vec(), None, None).unwrap();
        assert!(bare.subdivided(2).is_none());
        assert!(Arc::ptr_eq(&mesh.subdivided(2).unwrap(), &mesh.subdivided(2).unwrap()));
    }
}
