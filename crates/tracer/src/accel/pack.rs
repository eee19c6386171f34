//! How leaves are laid out in blocks: none begins within a block that it does not fit into, so that a ray tests no
//! more blocks than the leaf's triangles fill. Small leaves share blocks: the fullest that has room takes them (best
//! fit).

use catoptra_core::TriangleMesh;
use rayon::prelude::*;

use super::bins::Item;
use super::wide_tree::{Block8, Node8, WIDTH};

/// Blocks that are kept in mind for each number of free places. A twentieth of all places stays empty on the meshes
/// measured.
const OPEN: usize = 8;
/// Threads share out the blocks in stretches of this many.
const PARALLEL: usize = 1024;
/// Leaves of this many nodes share blocks with each other only, so that threads can lay out such groups independently.
const NODES: usize = 128;

/// Stands for no triangle.
const EMPTY: u32 = u32::MAX;

/// Blocks of the leaves' triangles, node by node; the leaves' links then say where in the blocks they are.
pub(super) fn pack(mesh: &TriangleMesh, nodes: &mut [Node8], items: &[Item]) -> Vec<Block8> {
    let stretches: Vec<Vec<u32>> = nodes.par_chunks_mut(NODES).map(|nodes| lay_out(nodes, items)).collect();
    let ids = stretches.concat();
    let starts = stretches.iter().scan(0, |next, ids| {
        let start = *next;
        *next += ids.len() as u32;
        Some(start)
    });
    let starts: Vec<u32> = starts.collect();
    nodes.par_chunks_mut(NODES).zip(starts).for_each(|(nodes, start)| {
        for (link, _) in nodes.iter_mut().flat_map(leaves) {
            *link += start;
        }
    });
    ids.par_chunks(WIDTH).with_min_len(PARALLEL).map(|ids| block(mesh, ids)).collect()
}

/// Where the leaves of a node begin, and how many triangles they have.
fn leaves(node: &mut Node8) -> impl Iterator<Item = (&mut u32, usize)> {
    let count = usize::from(node.children);
    let children = node.link.iter_mut().zip(node.count).take(count);
    children.filter(|child| child.1 != 0).map(|(link, count)| (link, usize::from(count)))
}

/// The triangles of some nodes' leaves in the order of their blocks, in which the leaves' links then are places.
fn lay_out(nodes: &mut [Node8], items: &[Item]) -> Vec<u32> {
    let mut order = Order::default();
    for (link, count) in nodes.iter_mut().flat_map(leaves) {
        let first = *link as usize;
        *link = order.add(&items[first..first + count]) as u32;
    }
    order.ids
}

/// Triangles in the order of the blocks, whole blocks of them.
#[derive(Default)]
struct Order {
    ids: Vec<u32>,
    /// Ends of the open blocks by how many free slots they have, the last one first; 0 for none.
    open: [[usize; OPEN]; WIDTH],
}

impl Order {
    /// Finds room for a leaf; where it begins.
    fn add(&mut self, items: &[Item]) -> usize {
        let count = items.len();
        let tight = (count..WIDTH).find(|&room| self.open[room][0] != 0);
        let (end, room) = match tight {
            Some(room) => (self.take(room), room),
            None => {
                let end = (self.ids.len() + count).next_multiple_of(WIDTH);
                let room = end - self.ids.len();
                self.ids.resize(end, EMPTY);
                (end, room)
            }
        };
        self.leave_open(end, room - count);
        let first = end - room;
        for (id, item) in self.ids[first..].iter_mut().zip(items) {
            *id = item.id();
        }
        first
    }

    /// The last block with `room` free slots.
    fn take(&mut self, room: usize) -> usize {
        let open = &mut self.open[room];
        let end = open[0];
        open.copy_within(1.., 0);
        open[OPEN - 1] = 0;
        end
    }

    /// Remembers a block that has free slots, in place of the oldest with as many.
    fn leave_open(&mut self, end: usize, room: usize) {
        if room != 0 {
            let open = &mut self.open[room];
            open.copy_within(..OPEN - 1, 1);
            open[0] = end;
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

    /// Triangles in a row, and a node for every eight leaves; `counts` is how many triangles each leaf has.
    fn rows(counts: &[u8]) -> (TriangleMesh, Vec<Node8>, Vec<Item>) {
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
        (0..4000_u32).map(|i| (i * i * 7 % 24 + 1) as u8).collect()
    }

    #[test]
    fn a_leaf_takes_no_more_blocks_than_its_triangles_fill() {
        let (mesh, mut nodes, items) = rows(&counts());
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
        let (mesh, mut nodes, items) = rows(&counts());
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
        let (mesh, mut nodes, items) = rows(&[3; 64]);
        assert!(pack(&mesh, &mut nodes, &items).len() <= 33);
    }
}
