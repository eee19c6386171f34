//! Builds a tree over shapes: top down, by the binned surface area heuristic.
//!
//! Wald, "On fast construction of SAH-based bounding volume hierarchies", IEEE RT 2007.

use super::tree::{Box32, MAX_DEPTH, Node, Tree};
use crate::Pool;

/// Bins along the longest axis of the centres.
const BINS: usize = 16;
/// A leaf holds at most this many items where a split is worth less.
const LEAF: usize = 4;
/// Cost of visiting a node relative to testing an item.
const VISIT: f32 = 1.0;
/// Stretches longer than this are built by two threads.
const PARALLEL: usize = 4096;

impl Tree {
    /// Over items with the given boxes, on the threads of `pool`.
    pub(crate) fn build(boxes: &[Box32], pool: &Pool) -> Self {
        let mut items: Vec<Item> = boxes.iter().zip(0..).map(|(b, id)| Item { bounds: *b, id }).collect();
        if items.is_empty() {
            return Self::default();
        }
        let mut nodes = Vec::new();
        pool.run(|| grow(&mut items, 0, 0, &mut nodes));
        Self { nodes, order: items.iter().map(|item| item.id).collect() }
    }
}

#[derive(Clone, Copy)]
struct Item {
    bounds: Box32,
    id: u32,
}

impl Item {
    /// Twice the centre; the order of centres is all that counts.
    fn centre2(&self, axis: usize) -> f32 {
        self.bounds.min[axis] + self.bounds.max[axis]
    }
}

/// Appends the subtree over `items`, which stand from `base` on in the order of all.
fn grow(items: &mut [Item], base: u32, depth: usize, nodes: &mut Vec<Node>) {
    let bounds = items.iter().fold(Box32::EMPTY, |b, item| b.union(&item.bounds));
    let at = nodes.len();
    nodes.push(Node { bounds, link: base, count: items.len() as u16, axis: 0 });
    let Some((middle, axis)) = split(items, &bounds, depth) else { return };
    (nodes[at].count, nodes[at].axis) = (0, axis as u16);
    let (left, right) = items.split_at_mut(middle);
    let right_base = base + middle as u32;
    if left.len() + right.len() < PARALLEL {
        grow(left, base, depth + 1, nodes);
        nodes[at].link = nodes.len() as u32;
        grow(right, right_base, depth + 1, nodes);
        return;
    }
    let (mut a, mut b) = (Vec::new(), Vec::new());
    rayon::join(|| grow(left, base, depth + 1, &mut a), || grow(right, right_base, depth + 1, &mut b));
    append(nodes, a);
    nodes[at].link = nodes.len() as u32;
    append(nodes, b);
}

/// Appends a subtree whose inner links count from its own start.
fn append(nodes: &mut Vec<Node>, subtree: Vec<Node>) {
    let start = nodes.len() as u32;
    nodes.extend(
        subtree.into_iter().map(|n| if n.count == 0 { Node { link: n.link + start, ..n } } else { n }),
    );
}

/// Sorts `items` into two parts along an axis and says where the second begins; `None` where a leaf is better.
fn split(items: &mut [Item], bounds: &Box32, depth: usize) -> Option<(usize, usize)> {
    if items.len() <= 1 {
        return None;
    }
    let halves = Some((items.len() / 2, 0));
    if depth + usize::BITS as usize - items.len().leading_zeros() as usize >= MAX_DEPTH {
        // Halving from here on stays within the deepest tree.
        return halves;
    }
    match best_plane(items) {
        None if items.len() <= LEAF => None,
        // Centres in one place: any halves do.
        None => halves,
        Some(plane) => {
            let leaf_cost = items.len() as f32 * bounds.half_area();
            let split_cost = VISIT * bounds.half_area() + plane.cost;
            if items.len() <= LEAF && leaf_cost <= split_cost {
                return None;
            }
            let middle = partition(items, |item| plane.bin_of(item) < plane.bin);
            if middle > 0 && middle < items.len() { Some((middle, plane.axis)) } else { halves }
        }
    }
}

struct Plane {
    axis: usize,
    low: f32,
    scale: f32,
    bin: usize,
    cost: f32,
}

impl Plane {
    fn bin_of(&self, item: &Item) -> usize {
        (((item.centre2(self.axis) - self.low) * self.scale) as usize).min(BINS - 1)
    }
}

/// The cheapest of the planes between bins on the longest axis of the centres.
fn best_plane(items: &[Item]) -> Option<Plane> {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for item in items {
        for axis in 0..3 {
            low[axis] = low[axis].min(item.centre2(axis));
            high[axis] = high[axis].max(item.centre2(axis));
        }
    }
    let axis = (0..3).max_by(|&a, &b| (high[a] - low[a]).total_cmp(&(high[b] - low[b])))?;
    let extent = high[axis] - low[axis];
    if !(extent > 0.0 && extent.is_finite()) {
        return None;
    }
    let mut plane = Plane { axis, low: low[axis], scale: BINS as f32 / extent, bin: 0, cost: f32::INFINITY };
    if !plane.scale.is_finite() {
        return None;
    }
    let mut bins = [(Box32::EMPTY, 0_u32); BINS];
    for item in items {
        let bin = &mut bins[plane.bin_of(item)];
        *bin = (bin.0.union(&item.bounds), bin.1 + 1);
    }
    choose_bin(&bins, &mut plane);
    Some(plane)
}

/// Sweeps the bins from both ends.
fn choose_bin(bins: &[(Box32, u32); BINS], plane: &mut Plane) {
    let mut right_cost = [0.0; BINS];
    let (mut bounds, mut count) = (Box32::EMPTY, 0);
    for i in (1..BINS).rev() {
        (bounds, count) = (bounds.union(&bins[i].0), count + bins[i].1);
        right_cost[i] = bounds.half_area() * count as f32;
    }
    (bounds, count) = (Box32::EMPTY, 0);
    for i in 1..BINS {
        (bounds, count) = (bounds.union(&bins[i - 1].0), count + bins[i - 1].1);
        let cost = bounds.half_area() * count as f32 + right_cost[i];
        if cost < plane.cost {
            (plane.bin, plane.cost) = (i, cost);
        }
    }
}

/// Brings the items that `goes_left` to the front and counts them.
fn partition(items: &mut [Item], goes_left: impl Fn(&Item) -> bool) -> usize {
    let mut middle = 0;
    for i in 0..items.len() {
        if goes_left(&items[i]) {
            items.swap(i, middle);
            middle += 1;
        }
    }
    middle
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pool::one_thread;

    fn grid(n: u32) -> Vec<Box32> {
        let at = |i: u32, k: u32| (i / n.pow(k) % n) as f32;
        (0..n * n * n)
            .map(|i| [at(i, 0), at(i, 1), at(i, 2)])
            .map(|p| Box32 { min: p, max: p.map(|v| v + 0.5) })
            .collect()
    }

    #[test]
    fn every_item_stands_in_one_leaf_within_its_ancestors() {
        let boxes = grid(20);
        let tree = Tree::build(&boxes, one_thread());
        let mut seen = vec![0; boxes.len()];
        let mut stack = vec![(0_usize, tree.nodes[0].bounds)];
        while let Some((at, around)) = stack.pop() {
            let node = &tree.nodes[at];
            assert_eq!(around.union(&node.bounds), around, "node {at} lies within its parent");
            if node.count == 0 {
                stack.extend([(at + 1, node.bounds), (node.link as usize, node.bounds)]);
            } else {
                for &item in &tree.order[node.link as usize..node.link as usize + node.count as usize] {
                    assert_eq!(node.bounds.union(&boxes[item as usize]), node.bounds);
                    seen[item as usize] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&n| n == 1));
    }

    #[test]
    fn boxes_in_one_place_still_make_a_tree() {
        let same = vec![Box32 { min: [1.0; 3], max: [2.0; 3] }; 10_000];
        assert_eq!(Tree::build(&same, one_thread()).order.len(), 10_000);
    }

    #[test]
    fn wild_extents_stay_within_the_deepest_tree() {
        let boxes: Vec<Box32> =
            (0..2000).map(|i| [2.0_f32.powi(i / 10 - 100); 3]).map(|p| Box32 { min: p, max: p }).collect();
        let tree = Tree::build(&boxes, one_thread());
        let mut stack = vec![(0_usize, 0)];
        while let Some((at, depth)) = stack.pop() {
            assert!(depth < MAX_DEPTH);
            if tree.nodes[at].count == 0 {
                stack.extend([(at + 1, depth + 1), (tree.nodes[at].link as usize, depth + 1)]);
            }
        }
    }
}
