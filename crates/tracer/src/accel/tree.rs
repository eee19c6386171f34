//! The tree of boxes itself, and how one `f64` ray walks it.

use catoptra_core::glam::DVec3;
use catoptra_core::numeric::gamma_f64;
use catoptra_core::{Aabb, Ray, Span};

use crate::numeric::BOUNDS_ERROR;

/// An axis-aligned box in `f32`, rounded outwards: never smaller than the `f64` box it was made from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Box32 {
    pub(crate) min: [f32; 3],
    pub(crate) max: [f32; 3],
}

impl Box32 {
    pub(crate) const EMPTY: Self = Self { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };

    pub(crate) fn union(&self, o: &Self) -> Self {
        Self {
            min: std::array::from_fn(|i| self.min[i].min(o.min[i])),
            max: std::array::from_fn(|i| self.max[i].max(o.max[i])),
        }
    }

    /// What lies in both; may be empty.
    pub(crate) fn intersection(&self, o: &Self) -> Self {
        Self {
            min: std::array::from_fn(|i| self.min[i].max(o.min[i])),
            max: std::array::from_fn(|i| self.max[i].min(o.max[i])),
        }
    }

    /// Whether it holds no point.
    pub(crate) fn is_empty(&self) -> bool {
        (0..3).any(|i| self.min[i] > self.max[i])
    }

    /// Half the surface area: what the surface area heuristic weighs by; 0 when empty.
    pub(crate) fn half_area(&self) -> f32 {
        let [x, y, z] = std::array::from_fn(|i| (self.max[i] - self.min[i]).max(0.0));
        x * y + y * z + z * x
    }

    /// Where a ray may enter the box, if it may do so up to `far`; never a false no.
    ///
    /// Slabs with the far side stretched by 1 + 2γ₃ in `f64` (Ize 2013), and one more rounding for the pad; NaN, from a
    /// ray within a face, counts as inside. `far` is stretched too, and the box is wider by what a ray is off by that
    /// was carried over from elsewhere.
    pub(crate) fn entered_by(&self, ray: &Ray, far: f64) -> Option<f64> {
        let stretch = 1.0 + 2.0 * gamma_f64(4);
        let (mut enter, mut leave) = (0.0_f64, far * stretch);
        let pad = BOUNDS_ERROR * ray.origin.abs().max_element();
        for i in 0..3 {
            let inverse = 1.0 / ray.direction[i];
            let t0 = (f64::from(self.min[i]) - pad - ray.origin[i]) * inverse;
            let t1 = (f64::from(self.max[i]) + pad - ray.origin[i]) * inverse;
            let (near, away) = if inverse.is_sign_negative() { (t1, t0) } else { (t0, t1) };
            // `max` and `min` ignore NaN.
            enter = enter.max(near);
            leave = leave.min(away * stretch);
        }
        (enter <= leave).then_some(enter)
    }
}

impl Box32 {
    /// Its largest coordinate.
    pub(crate) fn largest(&self) -> f64 {
        self.min.iter().chain(&self.max).map(|v| f64::from(v.abs())).fold(0.0, f64::max)
    }

    /// Whether a point lies in the box, or at most `reach` beside it along each axis.
    pub(crate) fn is_near(&self, point: DVec3, reach: f64) -> bool {
        (0..3)
            .all(|i| point[i] >= f64::from(self.min[i]) - reach && point[i] <= f64::from(self.max[i]) + reach)
    }
}

impl From<Aabb> for Box32 {
    /// Rounded outwards.
    fn from(b: Aabb) -> Self {
        let down = |v: f64| if f64::from(v as f32) > v { (v as f32).next_down() } else { v as f32 };
        let up = |v: f64| if f64::from(v as f32) < v { (v as f32).next_up() } else { v as f32 };
        Self { min: b.min.to_array().map(down), max: b.max.to_array().map(up) }
    }
}

/// One box of a tree: a leaf with some items, or an inner node whose first child follows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Node {
    pub(crate) bounds: Box32,
    /// A leaf's first index in the order of items; an inner node's second child.
    pub(crate) link: u32,
    /// How many items a leaf has; 0 for an inner node.
    pub(crate) count: u16,
    /// Along which axis an inner node's first child lies below its second.
    pub(crate) axis: u16,
}

impl Node {
    /// The two children of the inner node at `at`, the one met first by a ray of that direction's sign ahead.
    #[inline(always)]
    pub(crate) fn children(&self, at: u32, backwards: [bool; 3]) -> [u32; 2] {
        if backwards[self.axis as usize] { [self.link, at + 1] } else { [at + 1, self.link] }
    }
}

/// A binary tree of boxes over numbered items.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
    /// Items, leaf by leaf.
    pub(crate) order: Vec<u32>,
}

/// Deepest tree that is built; a walk keeps at most one node a level.
pub(crate) const MAX_DEPTH: usize = 64;

impl Tree {
    /// Calls `visit` with the items whose boxes hold a point, or are at most `reach` beside it.
    pub(crate) fn around(&self, point: DVec3, reach: f64, mut visit: impl FnMut(u32)) {
        let mut stack: Vec<u32> = (!self.nodes.is_empty()).then_some(0).into_iter().collect();
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at as usize];
            if !node.bounds.is_near(point, reach) {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.link, at + 1]);
            } else {
                let first = node.link as usize;
                self.order[first..first + node.count as usize].iter().for_each(|item| visit(*item));
            }
        }
    }

    /// Calls `visit` with the items whose boxes the ray may meet on the stretch that is left; `visit` answers how
    /// far it is still worth looking.
    pub(crate) fn walk(&self, ray: &Ray, span: Span, mut visit: impl FnMut(u32) -> f64) {
        if self.nodes.is_empty() {
            return;
        }
        let mut far = span.max;
        let backwards = ray.direction.to_array().map(|d| d < 0.0);
        let mut stack = [0_u32; MAX_DEPTH];
        let mut depth = 0;
        let mut at = 0_u32;
        loop {
            let node = &self.nodes[at as usize];
            if node.bounds.entered_by(ray, far).is_some() {
                if node.count == 0 {
                    let [near, away] = node.children(at, backwards);
                    stack[depth] = away;
                    depth += 1;
                    at = near;
                    continue;
                }
                let first = node.link as usize;
                for &item in &self.order[first..first + node.count as usize] {
                    far = far.min(visit(item));
                }
            }
            if depth == 0 {
                return;
            }
            depth -= 1;
            at = stack[depth];
        }
    }
}
