//! How the tree over a mesh is built: top down, eight children at once, by the binned surface area heuristic.
//!
//! Wald, "On fast construction of SAH-based bounding volume hierarchies", IEEE RT 2007; Wald, Benthin and Boulos,
//! "Getting rid of packets", IEEE RT 2008, for the eight children: the largest is split until there are eight.

use catoptra_core::TriangleMesh;
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;

use super::bins::{Bins, Extent, Item, Plane, Scale, Set, weight};
use super::pack::pack;
use super::planes::AskedPlanes;
use super::spatial::cheapest_cut;
use super::wide_tree::{Node8, WIDTH, WideTree};
use super::{MAX_DEPTH, Preset};
use crate::{Control, Pool};

/// Most triangles of a leaf of a node that has no room for two: a node of a few leaves costs more to visit than their
/// blocks. Measured on three meshes of 66,000 to 871,000 triangles: single rays test an eighth to a quarter fewer
/// blocks than with 32 and visit a twentieth more nodes; 16 was not faster beyond the noise and takes 3 bytes a
/// triangle more.
const FULL_LEAF: usize = 24;
/// Stretches longer than this are shared out among threads, this many triangles at a time.
const PARALLEL: usize = 8192;
/// A leaf has at most this many triangles, and never fewer than could be split: a block is tested in one go, so two
/// smaller leaves would cost more.
const LEAF: usize = 8;
/// Share of the surface of the box round a mesh that two parts must have in common for space to be cut (α in Stich et al.
/// 2009). Measured on a scan and a building of 870,000 and 66,000 triangles: from here to 10⁻⁵ rays gain nothing more,
/// while the tree takes up to seven times as long to build and grows by 5 %; at 10⁻¹ they have gained nothing yet.
const OVERLAP: f32 = 1e-2;
/// Depth from which on stretches are halved, which takes at most 32 levels.
const HALVE: usize = MAX_DEPTH - 32;

/// Builds the tree on the threads of `pool`. Once `control` is cancelled no more nodes are split, and what comes of it is no
/// tree of the mesh.
pub(super) fn grow(mesh: &TriangleMesh, preset: Preset, pool: &Pool, control: &Control) -> WideTree {
    let overlap = f32::INFINITY;
    pool.run(|| dispatch!(Level::new(), s => Grower { s, preset, mesh, overlap, control }.grow()))
}

struct Grower<'a, S: Simd> {
    s: S,
    preset: Preset,
    mesh: &'a TriangleMesh,
    /// Half the surface of what two parts have in common from which on space is cut.
    overlap: f32,
    /// Told of every triangle that has found its leaf.
    control: &'a Control,
}

impl<S: Simd> Clone for Grower<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Simd> Copy for Grower<'_, S> {}

impl<S: Simd> Grower<'_, S> {
    fn grow(mut self) -> WideTree {
        let mesh = self.mesh;
        let places = |count: usize| (0..count).into_par_iter().with_min_len(PARALLEL);
        let all = || places(mesh.triangles().len()).map(|id| Item::new(mesh, id as u32)).collect();
        let (firsts, mut items): (_, Vec<Item>) = rayon::join(|| mesh.firsts_in_place(), all);
        if let Some(firsts) = firsts {
            // Of triangles in one place rays meet the first alone.
            items.retain(|item| firsts[item.id() as usize] == item.id());
        }
        let count = items.len();
        let room = self.preset.room(count);
        let root = self.measured(&items, Set { room, ..Set::of(self.s, &[]) });
        items.resize(count + room, Item::NONE);
        let mut scratch: Vec<Item> = places(count + room).map(|_| Item::NONE).collect();
        self.overlap = root.around.half_area() * OVERLAP;
        let mut nodes = Vec::with_capacity(count / 8 + 1);
        self.node((&mut items, &mut scratch), 0, root, 0, &mut nodes);
        if self.control.is_cancelled() {
            return WideTree { nodes: Vec::new(), blocks: Vec::new(), planes: AskedPlanes::default() };
        }
        let blocks = pack(mesh, &mut nodes, &items);
        WideTree { nodes, blocks, planes: AskedPlanes::default() }
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
        if self.control.is_cancelled() {
            return;
        }
        let mut sets = [set; WIDTH];
        let children = self.children((items, scratch), &mut sets, depth);
        let leaves = sets[..children].iter().filter(|set| set.leaf).map(|set| set.count);
        self.control.advance(leaves.sum());
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
                if !parallel {
                    bring_back((items, scratch), set.first, set);
                }
                node.push(&bounds, (base + set.first) as u32, set.count as u8);
                continue;
            }
            node.push(&bounds, nodes.len() as u32, 0);
            if parallel {
                append(nodes, std::mem::take(&mut subtrees[child]));
            } else {
                let own = set.first..set.first + set.count + set.room;
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
            let (part, own) =
                (items.split_off_mut(..set.count + set.room), scratch.split_off_mut(..set.count + set.room));
            parts.extend(part.zip(own).map(|part| (part, *set)));
        }
        let grown = |(part, set): (Room<'_>, Set<S>)| {
            let mut nodes = Vec::with_capacity(set.count / WIDTH);
            if set.leaf {
                bring_back(part, 0, &set);
            } else {
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
        let own = set.first..set.first + set.count + set.room;
        let (mut items, mut scratch) = (&mut items[own.clone()], &mut scratch[own]);
        if set.aside {
            (items, scratch) = (scratch, items);
        }
        let scale = Scale::new(self.s, set.centres, self.preset.bins(set.count));
        let plane = if depth < HALVE { self.best_plane(&items[..set.count], &scale) } else { None };
        if set.room > 0 && depth < HALVE {
            let parts = self.cut(&items[..set.count], set, plane.as_ref());
            if let Some(parts) = parts {
                return Some(self.put_back(items, set, &parts));
            }
        }
        let Some((plane, around)) = plane else {
            // Centres in one place, or too deep for anything else: any halves do.
            let sets = set.parted([set.count / 2, set.count.div_ceil(2)]);
            let second = sets[1].first - set.first;
            items.copy_within(sets[0].count..set.count, second);
            let (a, b) = (&items[..sets[0].count], &items[second..second + sets[1].count]);
            return Some([self.measured(a, sets[0]), self.measured(b, sets[1])]);
        };
        let sets = set.parted([plane.count, set.count - plane.count]);
        let second = sets[1].first - set.first;
        let (aside, centres) = if set.count <= PARALLEL {
            let to = &mut scratch[..second + sets[1].count];
            (!set.aside, self.sort_into(&items[..set.count], to, &scale, &plane).1)
        } else {
            (set.aside, self.partition((items, &mut scratch[..set.count]), &scale, &plane, second))
        };
        Some([0, 1].map(|at| Set { around: around[at], centres: centres[at], aside, ..sets[at] }))
    }

    /// The parts of a set on either side of a plane that cuts space, where such a spatial split is cheaper than sorting
    /// its triangles by an object split, by enough to be worth it; `None` elsewhere.
    fn cut(
        self,
        items: &[Item],
        set: &Set<S>,
        sorted: Option<&(Plane, [Extent<S>; 2])>,
    ) -> Option<[Vec<Item>; 2]> {
        let cost = match sorted {
            Some((plane, [a, b])) => {
                let common = a.bounds().intersection(&b.bounds());
                if common.is_empty() || common.half_area() <= self.overlap {
                    return None;
                }
                plane.cost
            }
            None => set.around.half_area() * weight(set.count),
        };
        let cut = cheapest_cut(self.mesh, items, &set.around.bounds(), set.room, PARALLEL)?;
        if !(cut.cost < cost) {
            return None;
        }
        let shares: Vec<[Vec<Item>; 2]> =
            items.par_chunks(PARALLEL).map(|items| cut.share_out(self.mesh, items)).collect();
        let parts =
            [0, 1].map(|side| shares.iter().flat_map(|share| &share[side]).copied().collect::<Vec<_>>());
        parts.iter().all(|part| !part.is_empty()).then_some(parts)
    }

    /// Replaces a set by two parts.
    fn put_back(self, items: &mut [Item], set: &Set<S>, parts: &[Vec<Item>; 2]) -> [Set<S>; 2] {
        let counts = [0, 1].map(|side: usize| parts[side].len());
        let room = set.room + set.count - counts[0] - counts[1];
        let sets = Set { room, ..*set }.parted(counts);
        [0, 1].map(|side| {
            let at = sets[side].first - set.first;
            items[at..at + counts[side]].copy_from_slice(&parts[side]);
            self.measured(&parts[side], sets[side])
        })
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

    /// Brings what lies before the plane to the front, and the rest to where the `second` part begins, on all threads;
    /// the boxes round the centres of both parts.
    fn partition(
        self,
        (items, scratch): Room<'_>,
        scale: &Scale<S>,
        plane: &Plane,
        second: usize,
    ) -> [Extent<S>; 2] {
        let shares = items[..scratch.len()].par_chunks(PARALLEL).zip(scratch.par_chunks_mut(PARALLEL));
        let sorted: Vec<(usize, [Extent<S>; 2])> =
            shares.map(|(items, scratch)| self.sort_into(items, scratch, scale, plane)).collect();
        let (mut below, mut above) = items.split_at_mut(second);
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

    /// Copies what lies before the plane to the front and the rest to the back, without a branch that is hard to predict;
    /// returns how many lie before it, and the boxes round the centres of both.
    fn sort_into(
        self,
        items: &[Item],
        to: &mut [Item],
        scale: &Scale<S>,
        plane: &Plane,
    ) -> (usize, [Extent<S>; 2]) {
        let (mut count, mut below, mut above) = (0, Extent::empty(self.s), Extent::empty(self.s));
        let last = to.len().wrapping_sub(1);
        self.s.vectorize(
            #[inline(always)]
            || {
                for (at, item) in items.iter().enumerate() {
                    let extent = Extent::of(self.s, item);
                    let first = scale.lies_before(extent, plane);
                    let from_end = last.wrapping_sub(at - count);
                    let slot = from_end ^ ((from_end ^ count) & first.wrapping_neg());
                    to[slot] = *item;
                    count += first;
                    let centre = Extent::point(extent.centre2());
                    below = below.union(centre.only_if(self.s, first == 1));
                    above = above.union(centre.only_if(self.s, first == 0));
                }
            },
        );
        (count, [below, above])
    }

    /// The set of these triangles, in the slots of a given one.
    fn measured(self, items: &[Item], slots: Set<S>) -> Set<S> {
        let parts = items.par_chunks(PARALLEL).map(|items| Set::of(self.s, items));
        let set = parts.reduce_with(Set::with).unwrap_or_else(|| Set::of(self.s, items));
        Set { first: slots.first, room: slots.room, aside: slots.aside, ..set }
    }
}

/// Triangles with free slots behind them, and as much room to sort them.
type Room<'a> = (&'a mut [Item], &'a mut [Item]);

/// Moves the triangles of a leaf that are in the buffer for sorting to where the tree expects them.
fn bring_back((items, scratch): Room<'_>, first: usize, leaf: &Set<impl Simd>) {
    if leaf.aside {
        let own = first..first + leaf.count;
        items[own.clone()].copy_from_slice(&scratch[own]);
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::Box32;
    use crate::pool::one_thread;

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

    /// Checks that every node lies within all boxes above it; returns the boxes of the leaves that hold each triangle.
    fn leaves(mesh: &TriangleMesh, tree: &WideTree) -> Vec<Vec<Box32>> {
        let mut leaves = vec![Vec::new(); mesh.triangles().len()];
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
                    let corners = mesh.triangles()[facet as usize].map(|i| mesh.positions()[i as usize]);
                    assert_eq!(tree.triangle(slot), corners);
                    leaves[facet as usize].push(bounds);
                }
            }
        }
        leaves
    }

    /// Asserts that leaves hold all of every triangle, and no more triangles than a preset may add.
    fn assert_complete(mesh: &TriangleMesh, preset: Preset) {
        let (leaves, count) =
            (leaves(mesh, &grow(mesh, preset, one_thread(), &Control::default())), mesh.triangles().len());
        let total: usize = leaves.iter().map(Vec::len).sum();
        assert!(total <= count + preset.room(count), "{total} of {count} {}", preset.name());
        let weights =
            (0..=8).flat_map(|i| (0..=8 - i).map(move |j| [i, j, 8 - i - j].map(|w| f64::from(w) / 8.0)));
        let weights: Vec<[f64; 3]> = weights.collect();
        for facet in 0..count {
            // Of triangles in one place the first stands for all.
            let first = mesh.firsts_in_place().map_or(facet, |firsts| firsts[facet] as usize);
            assert!(first == facet || leaves[facet].is_empty());
            let boxes = &leaves[first];
            let [a, b, c] = mesh.corners(facet as u32);
            for &[u, v, w] in &weights {
                let point = (a * u + b * v + c * w).to_array();
                let holds = |b: &Box32| {
                    (0..3).all(|i| f64::from(b.min[i]) <= point[i] && point[i] <= f64::from(b.max[i]))
                };
                assert!(boxes.iter().any(holds), "{point:?} of {facet} in {boxes:?} {}", preset.name());
            }
        }
    }

    /// Long thin triangles across each other.
    fn thicket(count: u32) -> TriangleMesh {
        let at = |number: u32| {
            let turn = f64::from(number) * 2.4;
            [turn.cos(), turn.sin() * 0.7, (turn * 1.7).sin()].map(|v| v as f32)
        };
        let positions = (0..count).flat_map(|id| {
            let [a, b] = [at(id), at(3 * id + 1)];
            [a, b, b.map(|v| v + 0.004)]
        });
        let triangles = (0..count).map(|id| [3 * id, 3 * id + 1, 3 * id + 2]).collect();
        TriangleMesh::new(positions.collect(), triangles, None, None).unwrap()
    }

    #[test]
    fn leaves_hold_all_of_every_triangle() {
        for count in [1, 2, 8, 9, 13, 100, 3000] {
            for preset in Preset::ALL {
                assert_complete(&crowd(count), *preset);
                assert_complete(&thicket(count), *preset);
            }
        }
    }

    #[test]
    fn a_triangle_stands_in_one_leaf_unless_space_is_cut() {
        let mesh = thicket(2000);
        let most = |preset| {
            leaves(&mesh, &grow(&mesh, preset, one_thread(), &Control::default())).iter().map(Vec::len).max()
        };
        assert_eq!([most(Preset::Fast), most(Preset::Balanced)], [Some(1); 2]);
        assert!(most(Preset::Best) > Some(1));
    }

    #[test]
    fn a_tree_does_not_depend_on_the_number_of_threads() {
        for (mesh, preset) in [(crowd(30_000), Preset::Balanced), (thicket(9000), Preset::Best)] {
            let grown = |threads: usize| {
                let tree = grow(&mesh, preset, &Pool::new(threads).unwrap(), &Control::default());
                let facets = tree.blocks.iter().map(|block| block.facet).collect::<Vec<_>>();
                (tree.nodes.iter().map(|node| (node.bounds, node.link)).collect::<Vec<_>>(), facets)
            };
            assert!(grown(1) == grown(3), "{}", preset.name());
        }
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
            assert_complete(&mesh, *preset);
        }
    }
}
