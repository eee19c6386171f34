//! The tree over a mesh's triangles: eight boxes a node, triangles in blocks of eight, and how one `f64` ray walks it.

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Span};

use super::planes::AskedPlanes;
use super::{Box32, MAX_DEPTH};
use crate::lanes::prefetch;

/// Children of a node, and triangles of a block: as many as one register of AVX2 or half a register of AVX-512 holds.
pub(crate) const WIDTH: usize = 8;

/// Eight boxes side by side.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(crate) struct Node8 {
    /// Lower and upper ends of every child's box along x, y and z.
    pub(crate) bounds: [[[f32; WIDTH]; 2]; 3],
    /// Which node an inner child is, or where the triangles of a leaf begin.
    pub(crate) link: [u32; WIDTH],
    /// How many triangles a leaf has; 0 for an inner child.
    pub(crate) count: [u8; WIDTH],
    /// How many children there are; they come first.
    pub(crate) children: u8,
}

impl Node8 {
    pub(crate) const EMPTY: Self =
        Self { bounds: [[[0.0; WIDTH]; 2]; 3], link: [0; WIDTH], count: [0; WIDTH], children: 0 };

    /// Adds a child.
    pub(crate) fn push(&mut self, bounds: &Box32, link: u32, count: u8) {
        let at = usize::from(self.children);
        for axis in 0..3 {
            self.bounds[axis][0][at] = bounds.min[axis];
            self.bounds[axis][1][at] = bounds.max[axis];
        }
        (self.link[at], self.count[at]) = (link, count);
        self.children += 1;
    }

    /// The box of a child.
    pub(crate) fn bounds_of(&self, child: usize) -> Box32 {
        let [x, y, z] = &self.bounds;
        Box32 { min: [x[0][child], y[0][child], z[0][child]], max: [x[1][child], y[1][child], z[1][child]] }
    }
}

/// Eight triangles side by side. Small leaves share a block, and of large ones only the last is not full.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(crate) struct Block8 {
    /// Corner by corner: x, y and z of every triangle.
    pub(crate) corners: [[[f32; WIDTH]; 3]; 3],
    /// Numbers of the triangles in their mesh.
    pub(crate) facet: [u32; WIDTH],
}

impl Block8 {
    /// The corners of a triangle.
    #[inline(always)]
    pub(crate) fn triangle(&self, at: usize) -> [[f32; 3]; 3] {
        let (at, [a, b, c]) = (at % WIDTH, &self.corners);
        [[a[0][at], a[1][at], a[2][at]], [b[0][at], b[1][at], b[2][at]], [c[0][at], c[1][at], c[2][at]]]
    }
}

/// Nodes and blocks. Where a block holds no leaf's triangle it repeats its first, so that all of it may be tested.
#[derive(Debug)]
pub(crate) struct WideTree {
    pub(crate) nodes: Vec<Node8>,
    pub(crate) blocks: Vec<Block8>,
    pub(crate) planes: AskedPlanes,
}

impl WideTree {
    /// The number in its mesh of the triangle at a slot of the blocks.
    #[inline(always)]
    pub(crate) fn facet(&self, slot: u32) -> u32 {
        self.blocks[slot as usize / WIDTH].facet[slot as usize % WIDTH]
    }

    /// The corners of the triangle at a slot of the blocks.
    #[inline(always)]
    pub(crate) fn triangle(&self, slot: u32) -> [[f32; 3]; 3] {
        self.blocks[slot as usize / WIDTH].triangle(slot as usize)
    }

    /// Asks memory for a node, or for the first block of a leaf, before it is visited. Where a tree is larger than the
    /// caches, what waits has arrived by the time it is visited, which otherwise takes as long as the visit itself.
    #[inline(always)]
    pub(crate) fn prefetch(&self, link: u32, count: u32) {
        if count == 0 {
            let Some(first) = self.nodes.first() else { return };
            prefetch::<Node8, f32>(&first.bounds[0][0], link as usize);
        } else {
            let Some(first) = self.blocks.first() else { return };
            prefetch::<Block8, f32>(&first.corners[0][0], link as usize / WIDTH);
        }
    }

    /// Bytes of nodes and blocks.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.blocks[..])
    }

    /// Calls `visit` with the triangles whose boxes hold a point, or are at most `reach` beside it, perhaps more than once.
    pub(crate) fn around(&self, point: DVec3, reach: f64, mut visit: impl FnMut(u32)) {
        let mut stack = vec![0_u32];
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at as usize];
            for child in 0..usize::from(node.children) {
                if !node.bounds_of(child).is_near(point, reach) {
                    continue;
                }
                let first = node.link[child];
                if node.count[child] == 0 {
                    stack.push(first);
                } else {
                    (first..first + u32::from(node.count[child])).for_each(|slot| visit(self.facet(slot)));
                }
            }
        }
    }

    /// Calls `visit` with the triangles whose boxes the ray may meet on the stretch that is left; `visit` answers how
    /// far it is still worth looking.
    pub(crate) fn walk(&self, ray: &Ray, span: Span, mut visit: impl FnMut(u32) -> f64) {
        let mut far = span.max;
        let mut stack: Vec<(f64, u32)> = Vec::with_capacity(MAX_DEPTH);
        stack.push((0.0, 0));
        while let Some((enter, at)) = stack.pop() {
            if enter > far {
                continue;
            }
            let node = &self.nodes[at as usize];
            let first = stack.len();
            for child in 0..usize::from(node.children) {
                let Some(enter) = node.bounds_of(child).entered_by(ray, far) else { continue };
                if node.count[child] == 0 {
                    stack.push((enter, node.link[child]));
                    continue;
                }
                let triangles =
                    node.link[child] as usize..node.link[child] as usize + usize::from(node.count[child]);
                for at in triangles {
                    far = far.min(visit(self.blocks[at / WIDTH].facet[at % WIDTH]));
                }
            }
            stack[first..].sort_by(|a, b| b.0.total_cmp(&a.0));
        }
    }
}
