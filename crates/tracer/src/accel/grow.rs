//! How the tree over a mesh is built: top down, eight children at once, by the binned surface area heuristic.
//!
//! Wald, "On fast construction of SAH-based bounding volume hierarchies", IEEE RT 2007; Wald, Benthin and Boulos,
//! "Getting rid of packets", IEEE RT 2008, for the eight children: the largest is split until there are eight.

use catoptra_core::TriangleMesh;
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;

use super::bins::{Bins, Extent, Item, Plane, Scale, Set};
use super::wide_tree::{Block8, Node8, WIDTH, WideTree};
use super::{MAX_DEPTH, Preset};

/// Most triangles of a leaf of a node that has no room for two: a node of a few leaves costs more to visit than their blocks.
/// Measured on three meshes of 66,000 to 871,000 triangles: between 12 and 32 rays are as fast, and 32 takes least room.
const FULL_LEAF: usize = 32;
/// Stretches longer than this are shared out among threads, so many triangles at a time.
const PARALLEL: usize = 8192;
/// A leaf has at most this many triangles, and never fewer than could be split: a block is tested in one go, so two
/// smaller leaves would cost more.
const LEAF: usize = 8;
/// Depth from which on stretches are halved, which takes at most 32 levels.
const HALVE: usize = MAX_DEPTH - 32;

/// Builds the tree on the threads of the pool it is called in.
pub(super) fn grow(mesh: &TriangleMesh, preset: Preset) -> WideTree {
    dispatch!(Level::new(), s => Grower { s, preset }.grow(mesh))
}

struct Grower<S: Simd> {
    s: S,
    preset: Preset,
}

impl<S: Simd> Clone for Grower<S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Simd> Copy for Grower<S> {}

impl<S: Simd> Grower<S> {
    fn grow(self, mesh: &TriangleMesh) -> WideTree {
        let count = mesh.triangles().len();
        let mut items: Vec<Item> =
            (0..count as u32).into_par_iter().with_min_len(PARALLEL).map(|id| Item::new(mesh, id)).collect();
        let mut scratch = vec![Item::NONE; count];
        let root = self.measured(&items, 0);
        let mut nodes = Vec::with_capacity(count / 8 + 1);
        self.node((&mut items, &mut scratch), 0, root, 0, &mut nodes);
        let blocks =
            items.par_chunks(WIDTH).with_min_len(PARALLEL / WIDTH).map(|items| block(mesh, items)).collect();
        WideTree { nodes, blocks }
    }

    /// Appends the node over `items`, which stand from `base` on in the order of all, and those below it.
    fn node(
        self,
        (items, scratch): Room<'_>,
        base: usize,
        set: Set<S>,
        depth: usize,
        nodes: &mut Vec<Node8>,
    ) {
        let mut sets = [set; WIDTH];
        let children = self.children((items, scratch), &mut sets, depth);
        let sets = &mut sets[..children];
        sets.sort_unstable_by_key(|set| set.first);
        let parallel = items.len() > PARALLEL;
        let mut subtrees =
            if parallel { self.subtrees((items, scratch), base, sets, depth) } else { Vec::new() };
        let at = nodes.len();
        let mut node = Node8::EMPTY;
        nodes.push(Node8::EMPTY);
        for (child, set) in sets.iter().enumerate() {
            let bounds = set.around.bounds();
            if set.leaf {
                node.push(&bounds, (base + set.first) as u32, set.count as u8);
                continue;
            }
            node.push(&bounds, nodes.len() as u32, 0);
            if parallel {
                append(nodes, std::mem::take(&mut subtrees[child]));
            } else {
                let own = set.first..set.first + set.count;
                let part = (&mut items[own.clone()], &mut scratch[own]);
                self.node(part, base + set.first, Set { first: 0, ..*set }, depth + 1, nodes);
            }
        }
        nodes[at] = node;
    }

    /// The trees over all sets, each with links that count from its own start; empty for leaves.
    fn subtrees(
        self,
        (mut items, mut scratch): Room<'_>,
        base: usize,
        sets: &[Set<S>],
        depth: usize,
    ) -> Vec<Vec<Node8>> {
        let mut parts = Vec::with_capacity(sets.len());
        for set in sets {
            let (part, own) = (items.split_off_mut(..set.count), scratch.split_off_mut(..set.count));
            parts.extend(part.zip(own).map(|part| (part, *set)));
        }
        let grown = |(part, set): (Room<'_>, Set<S>)| {
            let mut nodes = Vec::with_capacity(set.count / WIDTH);
            if !set.leaf {
                self.node(part, base + set.first, Set { first: 0, ..set }, depth + 1, &mut nodes);
            }
            nodes
        };
        parts.into_par_iter().with_max_len(1).map(grown).collect()
    }

    /// Splits the largest of the sets until there are eight or none is worth it; how many there are. The first is
    /// given.
    fn children(self, (items, scratch): Room<'_>, sets: &mut [Set<S>; WIDTH], depth: usize) -> usize {
        let mut count = 1;
        while count < WIDTH {
            let areas = sets[..count].iter().map(|set| if set.leaf { -1.0 } else { set.around.half_area() });
            let largest = areas.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |largest| largest.0);
            if sets[largest].leaf {
                break;
            }
            match self.split((items, scratch), &sets[largest], depth) {
                Some([a, b]) => {
                    (sets[largest], sets[count]) = (a, b);
                    count += 1;
                }
                None => sets[largest].leaf = true,
            }
        }
        for set in &mut sets[..count] {
            set.leaf = set.count <= LEAF || (count == WIDTH && set.count <= FULL_LEAF);
        }
        count
    }

    /// Sorts the triangles of a set into two; `None` where a leaf is better.
    fn split(self, (items, scratch): Room<'_>, set: &Set<S>, depth: usize) -> Option<[Set<S>; 2]> {
        if set.count <= LEAF {
            return None;
        }
        let own = set.first..set.first + set.count;
        let (items, scratch) = (&mut items[own.clone()], &mut scratch[own]);
        let scale = Scale::new(self.s, set.centres, self.preset.bins(set.count));
        let plane = if depth < HALVE { self.best_plane(items, &scale) } else { None };
        let Some((plane, around)) = plane else {
            // Centres in one place, or too deep for anything else: any halves do.
            let (a, b) = items.split_at(items.len() / 2);
            return Some([self.measured(a, set.first), self.measured(b, set.first + a.len())]);
        };
        let centres = self.partition((items, scratch), &scale, &plane);
        let counts = [plane.count, set.count - plane.count];
        let firsts = [set.first, set.first + plane.count];
        Some([0, 1].map(|part| Set {
            first: firsts[part],
            count: counts[part],
            around: around[part],
            centres: centres[part],
            leaf: false,
        }))
    }

    /// The cheapest of the planes between bins, and the boxes round both parts.
    fn best_plane(self, items: &[Item], scale: &Scale<S>) -> Option<(Plane, [Extent<S>; 2])> {
        if items.len() <= PARALLEL {
            return self.s.vectorize(
                #[inline(always)]
                || Bins::of(self.s, items, scale).best_plane(self.s, scale),
            );
        }
        let bins = |items: &[Item]| {
            self.s.vectorize(
                #[inline(always)]
                || Bins::of(self.s, items, scale),
            )
        };
        let all = items.par_chunks(PARALLEL).map(bins).reduce_with(|a, b| a.with(self.s, &b))?;
        all.best_plane(self.s, scale)
    }

    /// Brings what lies before the plane to the front; the boxes round the centres of both parts.
    fn partition(self, (items, scratch): Room<'_>, scale: &Scale<S>, plane: &Plane) -> [Extent<S>; 2] {
        if items.len() <= PARALLEL {
            let (_, centres) = self.sort_into(items, scratch, scale, plane);
            items.copy_from_slice(scratch);
            return centres;
        }
        let shares = items.par_chunks(PARALLEL).zip(scratch.par_chunks_mut(PARALLEL));
        let sorted: Vec<(usize, [Extent<S>; 2])> =
            shares.map(|(items, scratch)| self.sort_into(items, scratch, scale, plane)).collect();
        let (mut below, mut above) = items.split_at_mut(plane.count);
        let mut parts = Vec::with_capacity(2 * sorted.len());
        for (share, (count, _)) in scratch.chunks(PARALLEL).zip(&sorted) {
            let (first, second) = share.split_at(*count);
            parts.extend(below.split_off_mut(..first.len()).map(|to| (to, first)));
            parts.extend(above.split_off_mut(..second.len()).map(|to| (to, second)));
        }
        parts.into_par_iter().for_each(|(to, from)| to.copy_from_slice(from));
        let nothing = [Extent::empty(self.s); 2];
        sorted.iter().fold(nothing, |a, (_, b)| [a[0].union(b[0]), a[1].union(b[1])])
    }

    /// Copies what lies before the plane to the front, the rest from the end on, without a branch that could go either way;
    /// how many lie before it, and the boxes round the centres of both.
    fn sort_into(
        self,
        items: &[Item],
        to: &mut [Item],
        scale: &Scale<S>,
        plane: &Plane,
    ) -> (usize, [Extent<S>; 2]) {
        let (mut count, mut below, mut above) = (0, Extent::empty(self.s), Extent::empty(self.s));
        let to = &mut to[..items.len()];
        self.s.vectorize(
            #[inline(always)]
            || {
                for (at, item) in items.iter().enumerate() {
                    let extent = Extent::of(self.s, item);
                    let first = scale.lies_before(extent, plane);
                    let from_end = items.len() - 1 - (at - count);
                    let place = from_end ^ ((from_end ^ count) & first.wrapping_neg());
                    to[place] = *item;
                    count += first;
                    let centre = Extent::point(extent.centre2());
                    below = below.union(centre.only_if(self.s, first == 1));
                    above = above.union(centre.only_if(self.s, first == 0));
                }
            },
        );
        (count, [below, above])
    }

    /// A set of all that stands from a place on.
    fn measured(self, items: &[Item], first: usize) -> Set<S> {
        let parts = items.par_chunks(PARALLEL).map(|items| Set::of(self.s, items, first));
        parts.reduce_with(Set::with).unwrap_or_else(|| Set::of(self.s, items, first))
    }
}

/// Triangles, and as much room to sort them.
type Room<'a> = (&'a mut [Item], &'a mut [Item]);

/// Appends a subtree whose inner links count from its own start.
fn append(nodes: &mut Vec<Node8>, subtree: Vec<Node8>) {
    let start = nodes.len() as u32;
    nodes.extend(subtree.into_iter().map(|mut node| {
        for child in 0..usize::from(node.children) {
            if node.count[child] == 0 {
                node.link[child] += start;
            }
        }
        node
    }));
}

/// A block of the triangles, the last repeated where there are fewer than eight.
fn block(mesh: &TriangleMesh, items: &[Item]) -> Block8 {
    let mut block = Block8 { corners: [[[0.0; WIDTH]; 3]; 3], facet: [0; WIDTH] };
    for lane in 0..WIDTH {
        let id = items[lane.min(items.len() - 1)].id();
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
    use crate::accel::Box32;

    /// Triangles in random places of random sizes, some without area, some in one place.
    fn crowd(count: u32) -> TriangleMesh {
        let mut seed = 0x9e37_79b9_u32;
        let mut number = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / (1 << 24) as f32
        };
        let mut positions = Vec::new();
        for id in 0..count {
            let (size, place) = (number() * number() * 0.3, [number(), number(), number() * 0.01]);
            for corner in 0..3 {
                let spread = if id % 7 == 0 { 0.0 } else { size };
                let place = if id % 11 == 0 { [0.5; 3] } else { place };
                positions
                    .push(place.map(|v| if id % 5 == 0 && corner == 2 { v } else { v + spread * number() }));
            }
        }
        let triangles = (0..count).map(|id| [3 * id, 3 * id + 1, 3 * id + 2]).collect();
        TriangleMesh::new(positions, triangles, None, None).unwrap()
    }

    /// Looks at every leaf: that its triangles lie within all boxes above, and how often each triangle stands in one.
    fn check(mesh: &TriangleMesh, tree: &WideTree) -> Vec<u32> {
        let mut seen = vec![0; mesh.triangles().len()];
        let everything = Box32 { min: [f32::NEG_INFINITY; 3], max: [f32::INFINITY; 3] };
        let mut stack = vec![(0_usize, everything, 0)];
        while let Some((at, around, depth)) = stack.pop() {
            assert!(depth < MAX_DEPTH);
            let node = &tree.nodes[at];
            for child in 0..usize::from(node.children) {
                let bounds = node.bounds_of(child);
                assert_eq!(around.union(&bounds), around, "a child lies within its parent");
                if node.count[child] == 0 {
                    stack.push((node.link[child] as usize, bounds, depth + 1));
                    continue;
                }
                for slot in node.link[child]..node.link[child] + u32::from(node.count[child]) {
                    let facet = tree.facet(slot);
                    seen[facet as usize] += 1;
                    let corners = mesh.triangles()[facet as usize].map(|i| mesh.positions()[i as usize]);
                    assert_eq!(tree.triangle(slot), corners);
                    assert!(corners.iter().all(|p| bounds.union(&Box32 { min: *p, max: *p }) == bounds));
                }
            }
        }
        seen
    }

    #[test]
    fn every_triangle_stands_in_one_leaf_within_all_boxes_above_it() {
        for count in [1, 2, 8, 9, 13, 100, 20_000] {
            let mesh = crowd(count);
            for preset in Preset::ALL {
                let seen = check(&mesh, &grow(&mesh, *preset));
                assert!(seen.iter().all(|&times| times == 1), "{count} {}", preset.name());
            }
        }
    }

    #[test]
    fn a_tree_does_not_depend_on_the_number_of_threads() {
        let mesh = crowd(30_000);
        let grown = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let tree = pool.install(|| grow(&mesh, Preset::Balanced));
            (tree.nodes.len(), tree.blocks.iter().map(|block| block.facet).collect::<Vec<_>>())
        };
        assert!(grown(1) == grown(3));
    }

    #[test]
    fn a_thousand_triangles_in_one_place_and_wild_extents_still_make_a_tree() {
        let scales = (0..200).map(|i| 2.0_f32.powi(i - 100));
        let mut positions: Vec<[f32; 3]> = scales.map(|v| [v; 3]).collect();
        positions.extend([[0.25; 3], [0.5, 0.25, 0.25], [0.25, 0.5, 0.25]]);
        let ladder = (0..197).map(|i| [i, i + 1, i + 2]);
        let same = std::iter::repeat_n([200, 201, 202], 1000);
        let triangles: Vec<[u32; 3]> = ladder.chain(same).collect();
        let mesh = TriangleMesh::new(positions, triangles, None, None).unwrap();
        for preset in Preset::ALL {
            assert!(check(&mesh, &grow(&mesh, *preset)).iter().all(|&times| times == 1));
        }
    }
}
