//! Which triangles of a mesh lie in the same place as an earlier one?
//!
//! Files that were put together from parts repeat them. A ray meets the first of such triangles and no other, and one that leaves
//! it leaves all of them.

use std::hash::{BuildHasher, RandomState};

use super::TriangleMesh;
use super::derived::Derived;
use super::triangle_mesh::place;

/// The first triangle in each one's place, found out when first asked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Doubles(Derived<Option<Box<[u32]>>>);

impl Doubles {
    /// For each triangle the first with the same corners, in whatever order; `None` where all differ.
    pub(super) fn firsts(&self, mesh: &TriangleMesh) -> Option<&[u32]> {
        self.0.get_or_make(|| firsts(mesh)).as_deref()
    }
}

/// No triangle.
const NONE: u32 = u32::MAX;

fn firsts(mesh: &TriangleMesh) -> Option<Box<[u32]>> {
    let triangles = mesh.triangles();
    let state = RandomState::new();
    let hashes: Vec<u64> = mesh.positions().iter().map(|p| state.hash_one(place(*p))).collect();
    // A sum, so that the order of the corners does not count.
    let hash_of = |corners: &[u32; 3]| {
        corners.iter().fold(0_u64, |sum, &corner| sum.wrapping_add(hashes[corner as usize]))
    };
    // The first triangle of each place, where its hash says or after that: half of it stays empty.
    let mut found = vec![NONE; (2 * triangles.len()).next_power_of_two()];
    let mut firsts: Option<Box<[u32]>> = None;
    for (own, corners) in (0_u32..).zip(triangles) {
        let hash = hash_of(corners);
        let mut at = hash as usize;
        loop {
            at &= found.len() - 1;
            let first = found[at];
            if first == NONE {
                found[at] = own;
                break;
            }
            let others = &triangles[first as usize];
            if hash_of(others) == hash && places(mesh, others) == places(mesh, corners) {
                firsts.get_or_insert_with(|| (0..triangles.len() as u32).collect())[own as usize] = first;
                break;
            }
            at += 1;
        }
    }
    firsts
}

/// The places of a triangle's corners, in an order of their own.
fn places(mesh: &TriangleMesh, corners: &[u32; 3]) -> [[u32; 3]; 3] {
    let mut places = corners.map(|corner| place(mesh.positions()[corner as usize]));
    places.sort_unstable();
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_with_the_same_corners_are_told() {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let triangles = vec![[0, 1, 2], [0, 1, 4], [2, 3, 1], [1, 0, 2], [4, 1, 3]];
        let mesh = TriangleMesh::new(positions.clone(), triangles, None, None).unwrap();
        assert_eq!(mesh.firsts_in_place(), Some(&[0, 1, 0, 0, 1][..]));
        let mesh = TriangleMesh::new(positions, vec![[0, 1, 2], [0, 1, 4], [1, 2, 4]], None, None).unwrap();
        assert_eq!(mesh.firsts_in_place(), None);
    }

    #[test]
    fn one_of_many_is_told_and_none_wrongly() {
        let side = 300_u32;
        let positions: Vec<[f32; 3]> =
            (0..side * side).map(|i| [(i % side) as f32, (i / side) as f32, 0.5]).collect();
        let corner = |x: u32, y: u32| x + y * side;
        let cells = (0..side - 1).flat_map(|y| (0..side - 1).map(move |x| (x, y)));
        let mut triangles: Vec<[u32; 3]> = cells
            .flat_map(|(x, y)| {
                let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)];
                [[a, b, c], [b, d, c]]
            })
            .collect();
        let mesh = |triangles: &[[u32; 3]]| {
            TriangleMesh::new(positions.clone(), triangles.to_vec(), None, None).unwrap()
        };
        assert_eq!(mesh(&triangles).firsts_in_place(), None);
        let (count, again) = (triangles.len(), triangles[777]);
        triangles.push(again);
        assert_eq!(mesh(&triangles).firsts_in_place().map(|firsts| firsts[count]), Some(777));
    }
}
