//! Which triangles of a mesh lie in the same place as an earlier one?
//!
//! Files that were put together from parts repeat them. A ray meets the first of such triangles and no other, and one that leaves
//! it leaves all of them.

use std::collections::HashMap;

use super::TriangleMesh;
use super::derived::Derived;

/// The first triangle in each one's place, found out when first asked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Doubles(Derived<Option<Box<[u32]>>>);

impl Doubles {
    /// For each triangle the first with the same corners, in whatever order; `None` where all differ.
    pub(super) fn firsts(&self, mesh: &TriangleMesh) -> Option<&[u32]> {
        self.0.get_or_make(|| firsts(mesh)).as_deref()
    }
}

/// Bits of a filter for each triangle: few of them are suspected without reason.
const BITS_EACH: usize = 16;

fn firsts(mesh: &TriangleMesh) -> Option<Box<[u32]>> {
    let count = mesh.triangles().len();
    let hashes: Vec<u64> = mesh.positions().iter().map(|p| hash(place(p))).collect();
    // A sum, so that the order of the corners does not count.
    let hash_of = |corners: &[u32; 3]| {
        corners.iter().fold(0_u64, |sum, &corner| sum.wrapping_add(hashes[corner as usize]))
    };
    let (mut seen, mut suspects) = (Filter::new(count * BITS_EACH), Filter::new(count * BITS_EACH));
    let mut any = false;
    for triangle in mesh.triangles() {
        let hash = hash_of(triangle);
        if !seen.insert(hash) {
            suspects.insert(hash);
            any = true;
        }
    }
    if !any {
        return None;
    }
    let mut first_at = HashMap::new();
    let mut firsts: Box<[u32]> = (0..count as u32).collect();
    for (triangle, first) in mesh.triangles().iter().zip(&mut firsts) {
        if suspects.contains(hash_of(triangle)) {
            let mut corners = triangle.map(|corner| place(&mesh.positions()[corner as usize]));
            corners.sort_unstable();
            *first = *first_at.entry(corners).or_insert(*first);
        }
    }
    firsts.iter().zip(0_u32..).any(|(first, own)| *first != own).then_some(firsts)
}

/// A position, so that equal ones are the same bit by bit.
fn place(position: &[f32; 3]) -> [u32; 3] {
    // Adding 0 makes both zeros one.
    position.map(|c| (c + 0.0).to_bits())
}

/// A number that differs for nearly all places (finalisation of `SplitMix64`: Steele, Lea and Flood, OOPSLA 2014).
fn hash([x, y, z]: [u32; 3]) -> u64 {
    let mix = |v: u64| {
        let v = (v ^ v >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let v = (v ^ v >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        v ^ v >> 31
    };
    mix(mix(u64::from(x) | u64::from(y) << 32).wrapping_add(u64::from(z)))
}

/// A set of hashes that may hold some that were never put in (Bloom, Communications of the ACM 13(7), 1970, with one hash).
struct Filter {
    words: Vec<u64>,
}

impl Filter {
    fn new(bits: usize) -> Self {
        Self { words: vec![0; (bits / 64).next_power_of_two()] }
    }

    fn at(&self, hash: u64) -> (usize, u64) {
        ((hash >> 6) as usize & (self.words.len() - 1), 1 << (hash & 63))
    }

    fn contains(&self, hash: u64) -> bool {
        let (word, bit) = self.at(hash);
        self.words[word] & bit != 0
    }

    /// Whether it was not there.
    fn insert(&mut self, hash: u64) -> bool {
        let (word, bit) = self.at(hash);
        let new = self.words[word] & bit == 0;
        self.words[word] |= bit;
        new
    }
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
    fn few_of_many_are_suspected_and_none_is_told_wrongly() {
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
