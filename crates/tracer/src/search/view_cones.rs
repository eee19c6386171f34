//! Which points may a mesh hide some of a lamp from? Walks the mesh's tree with the cones of directions in which points see the
//! lamp, one in every lane.

use catoptra_core::{Lane, LaneMask};
use fearless_simd::Simd;

use super::Searcher;
use crate::accel::{Node8, WIDTH};
use crate::lanes::{D3, F, F3, M, magnitude, narrow3, widen3};
use crate::numeric::VIEW_MARGIN;

/// Planes of a cone: four edges of a lamp, the horizon, and the surface.
const MOST_PLANES: usize = 6;

/// Cones with their tips at points, one in every lane: what lies on the inner side of some planes.
pub(crate) struct ViewCones<S: Simd> {
    /// Relative to the snapshot's origin.
    pub(crate) tip: D3<S>,
    /// Inward normals of the planes; 0 for none.
    pub(crate) planes: [F3<S>; MOST_PLANES],
    /// Which lanes are asked about.
    pub(crate) lanes: M<S>,
}

impl<S: Simd> Searcher<'_, S> {
    /// The lanes whose cones may hold something of a mesh, which is a shape of that number. Never a false no; a yes may be false.
    #[inline(always)]
    pub(crate) fn reaches_into(&mut self, prim: u32, cones: &ViewCones<S>) -> M<S> {
        let s = self.s;
        let Some(instance) = self.snapshot.columns().instance(prim) else { return cones.lanes };
        let tip = narrow3(instance.own_points(s, cones.tip));
        let planes = cones.planes.map(|plane| narrow3(instance.own_vectors(s, widen3(plane))));
        let tree = &instance.tree.tree;
        let mut met = M::splat(s, false);
        let (mut stack, mut depth, mut visited) = ([0_u32; STACK], 1, 0);
        while depth > 0 {
            depth -= 1;
            let node = &tree.nodes[stack[depth] as usize];
            visited += 1;
            for child in 0..usize::from(node.children) {
                let open = cones.lanes & !met;
                if !open.any() {
                    break;
                }
                let reached = open & !is_outside(s, node, child, tip, &planes);
                if !reached.any() {
                    continue;
                }
                if node.count[child] > 0 || depth == STACK {
                    met = met | reached;
                } else {
                    stack[depth] = node.link[child];
                    depth += 1;
                }
            }
        }
        self.stats.tests.boxes += visited as u64 * WIDTH as u64;
        met
    }
}

/// Nodes that wait, at most: up to seven a level, of which a tree has no more than this allows.
const STACK: usize = 512;

/// The lanes in which a child's box lies outside one of the planes.
#[inline(always)]
fn is_outside<S: Simd>(s: S, node: &Node8, child: usize, tip: F3<S>, planes: &[F3<S>; MOST_PLANES]) -> M<S> {
    let end = |axis: usize, side: usize| F::splat(s, node.bounds[axis][side][child]);
    let [x, y, z] = [0, 1, 2].map(|axis| [end(axis, 0), end(axis, 1)]);
    let size = |[low, high]: [F<S>; 2]| low.abs().max(high.abs());
    let margin = (size(x) + size(y) + size(z) + magnitude(tip)) * F::splat(s, VIEW_MARGIN);
    let from = |ends: [F<S>; 2], tip: F<S>| [ends[0] - tip, ends[1] - tip];
    let (x, y, z) = (from(x, tip.x), from(y, tip.y), from(z, tip.z));
    let farthest = |slope: F<S>, [low, high]: [F<S>; 2]| (slope * low).max(slope * high);
    let mut outside = M::splat(s, false);
    for plane in planes {
        let most = farthest(plane.x, x) + farthest(plane.y, y) + farthest(plane.z, z);
        outside = outside | most.less(-(margin * magnitude(*plane)));
    }
    outside
}
