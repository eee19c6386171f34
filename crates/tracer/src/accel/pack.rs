//! How leaves are laid out in blocks: none begins within a block that it does not fit into, so that a ray tests no
//! more blocks than the leaf's triangles fill. Small leaves share blocks: the fullest that has room takes them (best fit).

use catoptra_core::TriangleMesh;
use rayon::prelude::*;

use super::bins::Item;
use super::wide_tree::{Block8, Node8, WIDTH};

/// Blocks with room left that are looked through for a leaf. A twentieth of all places stays empty on the meshes measured.
const OPEN: usize = 16;
/// Stretches of so many blocks are shared out among threads.
const PARALLEL: usize = 1024;

/// Stands for no triangle.
const EMPTY: u32 = u32::MAX;

/// Blocks of the leaves' triangles, node by node; the leaves' links then say where in the blocks they are.
pub(super) fn pack(mesh: &TriangleMesh, nodes: &mut [Node8], items: &[Item]) -> Vec<Block8> {
    let mut order =
        Order { ids: Vec::with_capacity(items.len() + items.len() / WIDTH), open: [(0, 0); OPEN] };
    for node in nodes {
        for child in 0..usize::from(node.children) {
            let count = usize::from(node.count[child]);
            if count != 0 {
                let first = node.link[child] as usize;
                node.link[child] = order.add(&items[first..first + count]) as u32;
            }
        }
    }
    order.ids.par_chunks(WIDTH).with_min_len(PARALLEL).map(|ids| block(mesh, ids)).collect()
}

/// Triangles in the order of the blocks, whole blocks of them.
struct Order {
    ids: Vec<u32>,
    /// Blocks' ends and how many places before them are free.
    open: [(usize, usize); OPEN],
}

impl Order {
    /// Finds room for a leaf; where it begins.
    fn add(&mut self, items: &[Item]) -> usize {
        let count = items.len();
        let tight = (0..OPEN).filter(|&at| self.open[at].1 >= count).min_by_key(|&at| self.open[at].1);
        let first = if let Some(at) = tight {
            let (end, room) = self.open[at];
            self.open[at].1 -= count;
            end - room
        } else {
            let first = self.ids.len();
            let end = (first + count).next_multiple_of(WIDTH);
            self.ids.resize(end, EMPTY);
            self.leave_open(end, end - first - count);
            first
        };
        for (id, item) in self.ids[first..].iter_mut().zip(items) {
            *id = item.id();
        }
        first
    }

    /// Keeps a block in mind, in place of the one with least room.
    fn leave_open(&mut self, end: usize, room: usize) {
        let fullest = self.open.iter_mut().min_by_key(|open| open.1);
        if let Some(open) = fullest.filter(|open| open.1 < room) {
            *open = (end, room);
        }
    }
}

/// A block of the triangles; its first, which there always is, where there are fewer than eight.
fn block(mesh: &TriangleMesh, ids: &[u32]) -> Block8 {
    let mut block = Block8 { corners: [[[0.0; WIDTH]; 3]; 3], facet: [0; WIDTH] };
    for (lane, id) in ids.iter().enumerate() {
        let id = if *id == EMPTY { ids[0] } else { *id };
        block.facet[lane] = id;
        for (corner, place) in mesh.triangles()[id as usize].iter().enumerate() {
            for axis in 0..3 {
                block.corners[corner][axis][lane] = mesh.positions()[*place as usize][axis];
            }
        }
    }
    block
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles beside each other, and a node for every eight leaves of so many each.
    fn leaves(counts: &[u8]) -> (TriangleMesh, Vec<Node8>, Vec<Item>) {
        let all: u32 = counts.iter().map(|&count| u32::from(count)).sum();
        let corner =
            |at: u32| [(at / 3) as f32, f32::from(u8::from(at % 3 == 1)), f32::from(u8::from(at % 3 == 2))];
        let triangles = (0..all).map(|id| [3 * id, 3 * id + 1, 3 * id + 2]).collect();
        let mesh = TriangleMesh::new((0..3 * all).map(corner).collect(), triangles, None, None).unwrap();
        let items: Vec<Item> = (0..all).map(|id| Item::new(&mesh, id)).collect();
        let mut first = 0;
        let node = |counts: &[u8]| {
            let mut node = Node8::EMPTY;
            for &count in counts {
                node.push(&mesh.bounds().into(), first, count);
                first += u32::from(count);
            }
            node
        };
        let nodes = counts.chunks(WIDTH).map(node).collect();
        (mesh, nodes, items)
    }

    fn counts() -> Vec<u8> {
        (0..400_u32).map(|i| (i * i * 7 % 24 + 1) as u8).collect()
    }

    #[test]
    fn a_leaf_takes_no_more_blocks_than_its_triangles_fill() {
        let (mesh, mut nodes, items) = leaves(&counts());
        pack(&mesh, &mut nodes, &items);
        for node in &nodes {
            for child in 0..usize::from(node.children) {
                let (first, count) = (node.link[child] as usize, usize::from(node.count[child]));
                let blocks = (first + count).div_ceil(WIDTH) - first / WIDTH;
                assert_eq!(blocks, count.div_ceil(WIDTH), "{count} from {first} on");
            }
        }
    }

    #[test]
    fn leaves_keep_their_triangles_and_share_none() {
        let (mesh, mut nodes, items) = leaves(&counts());
        let blocks = pack(&mesh, &mut nodes, &items);
        let mut next = 0;
        for node in &nodes {
            for child in 0..usize::from(node.children) {
                for slot in node.link[child]..node.link[child] + u32::from(node.count[child]) {
                    assert_eq!(blocks[slot as usize / WIDTH].facet[slot as usize % WIDTH], next);
                    next += 1;
                }
            }
        }
        assert_eq!(next as usize, items.len());
    }

    #[test]
    fn small_leaves_share_blocks() {
        let (mesh, mut nodes, items) = leaves(&[3; 64]);
        assert!(pack(&mesh, &mut nodes, &items).len() <= 33);
    }
}
