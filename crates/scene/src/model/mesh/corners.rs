//! Which corners of a polygon lie in a triangle? A k-d tree over them, from which corners can be taken.

use catoptra_core::glam::DVec2;

use super::turn::is_right_of;

/// So many corners are looked at one by one.
const LEAF: usize = 8;

/// Corners by place. All leaves are equally deep; the children of node i are 2 i + 1 and 2 i + 2.
#[derive(Debug, Default)]
pub(super) struct Corners {
    points: Vec<DVec2>,
    is_there: Vec<bool>,
    /// Corners, leaf by leaf.
    order: Vec<u32>,
    /// Where in that order each corner stands.
    slot: Vec<u32>,
    nodes: Vec<Node>,
    depth: u32,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: [DVec2; 2],
    /// Corners below it that have not been taken.
    left: u32,
}

/// A node and its stretch of the order.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    node: usize,
    start: usize,
    length: usize,
    depth: u32,
}

impl Stretch {
    fn halves(self) -> [Self; 2] {
        let first = self.length / 2;
        let (node, depth) = (2 * self.node, self.depth + 1);
        [
            Self { node: node + 1, length: first, depth, ..self },
            Self { node: node + 2, start: self.start + first, length: self.length - first, depth },
        ]
    }
}

impl Corners {
    /// Holds these corners from now on, and no others.
    pub(super) fn fill(&mut self, points: &[DVec2]) {
        self.points.clear();
        self.points.extend_from_slice(points);
        self.is_there.clear();
        self.is_there.resize(points.len(), true);
        self.order.clear();
        self.order.extend(0..points.len() as u32);
        self.depth = points.len().div_ceil(LEAF).next_power_of_two().ilog2();
        self.nodes.clear();
        let nowhere = Node { bounds: [DVec2::INFINITY, DVec2::NEG_INFINITY], left: 0 };
        self.nodes.resize((2 << self.depth) - 1, nowhere);
        self.build(self.root());
        self.slot.clear();
        self.slot.resize(points.len(), 0);
        for (at, &corner) in self.order.iter().enumerate() {
            self.slot[corner as usize] = at as u32;
        }
    }

    fn root(&self) -> Stretch {
        Stretch { node: 0, start: 0, length: self.points.len(), depth: 0 }
    }

    fn build(&mut self, at: Stretch) {
        let corners = &mut self.order[at.start..at.start + at.length];
        let mut bounds = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        for &corner in corners.iter() {
            let point = self.points[corner as usize];
            bounds = [bounds[0].min(point), bounds[1].max(point)];
        }
        self.nodes[at.node] = Node { bounds, left: at.length as u32 };
        if at.depth == self.depth {
            return;
        }
        let size = bounds[1] - bounds[0];
        let along = |corner: &u32| {
            let point = self.points[*corner as usize];
            if size.x > size.y { point.x } else { point.y }
        };
        if at.length > 1 {
            corners.select_nth_unstable_by(at.length / 2, |a, b| along(a).total_cmp(&along(b)));
        }
        for half in at.halves() {
            self.build(half);
        }
    }

    /// Takes a corner away.
    pub(super) fn take(&mut self, corner: u32) {
        if !std::mem::replace(&mut self.is_there[corner as usize], false) {
            return;
        }
        let slot = self.slot[corner as usize] as usize;
        let mut at = self.root();
        loop {
            self.nodes[at.node].left -= 1;
            if at.depth == self.depth {
                return;
            }
            let [first, second] = at.halves();
            at = if slot < second.start { first } else { second };
        }
    }

    /// Whether `found` holds for any corner that lies in a triangle (anticlockwise) or on its border, or near it.
    pub(super) fn any_near(&self, triangle: [DVec2; 3], found: impl Fn(u32) -> bool) -> bool {
        let [a, b, c] = triangle;
        let (min, max) = (a.min(b).min(c), a.max(b).max(c));
        // Of each node on the way down at most one half waits.
        let mut open = [self.root(); u32::BITS as usize];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let at = open[waiting];
            let Node { bounds, left } = self.nodes[at.node];
            let apart = left == 0 || bounds[0].cmpgt(max).any() || bounds[1].cmplt(min).any();
            if apart || [(a, b), (b, c), (c, a)].into_iter().any(|(a, b)| is_right_of(a, b, bounds)) {
                continue;
            }
            if at.depth < self.depth {
                open[waiting..waiting + 2].copy_from_slice(&at.halves());
                waiting += 2;
                continue;
            }
            let here = self.order[at.start..at.start + at.length].iter();
            if here.copied().any(|corner| self.is_there[corner as usize] && found(corner)) {
                return true;
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_is_not_found_again() {
        let points: Vec<DVec2> =
            (0..1000).map(|i| DVec2::new(f64::from(i * 37 % 101), f64::from(i * 53 % 97))).collect();
        let triangle = [DVec2::new(10.0, 10.0), DVec2::new(60.0, 20.0), DVec2::new(30.0, 80.0)];
        let is_inside = |corner: u32| {
            let edge = |k: usize| {
                let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                (b - a).perp_dot(points[corner as usize] - a) >= 0.0
            };
            (0..3).all(edge)
        };
        let mut expected: Vec<u32> = (0..1000).filter(|&corner| is_inside(corner)).collect();
        assert!(expected.len() > 100);
        let mut corners = Corners::default();
        corners.fill(&points);
        while let Some(last) = expected.pop() {
            let met = std::cell::RefCell::new(Vec::new());
            corners.any_near(triangle, |corner| {
                if is_inside(corner) {
                    met.borrow_mut().push(corner);
                }
                false
            });
            let mut met = met.into_inner();
            met.sort_unstable();
            assert_eq!(met, [&expected[..], &[last]].concat());
            corners.take(last);
            corners.take(last);
        }
        assert!(!corners.any_near(triangle, is_inside));
    }
}
