//! Which triangles of a mesh may a line meet?
//!
//! A tree of boxes, halved at the middle triangle along the longest side. A whole line passes by a box where some axis across
//! both the line and a side of the box tells them apart (Gottschalk, Lin and Manocha, "OBBTree", SIGGRAPH 1996).

use glam::DVec3;

use super::TriangleMesh;
use super::derived::Derived;
use crate::numeric::UNIT_ROUNDOFF_F64;
use crate::{Aabb, Ray};

/// The tree of a mesh, built when first asked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct LineTree(Derived<Nodes>);

#[derive(Debug, Clone, Default)]
struct Nodes {
    /// A node's first part stands behind it.
    nodes: Vec<Node>,
    /// Numbers of triangles, those of one leaf side by side.
    triangles: Vec<u32>,
}

#[derive(Debug, Clone)]
struct Node {
    bounds: Aabb,
    /// Where the node stands that follows all its parts.
    next: u32,
    /// Its triangles, from one place in the list to another; none unless it is a leaf.
    triangles: [u32; 2],
}

/// So many triangles are no longer parted.
const LEAF: usize = 4;

impl LineTree {
    /// Shows `visit` each triangle that the line of a ray in the mesh's own space may meet, until an error.
    pub(super) fn along<E>(
        &self,
        mesh: &TriangleMesh,
        ray: &Ray,
        mut visit: impl FnMut(u32) -> Result<(), E>,
    ) -> Result<(), E> {
        let tree = self.0.get_or_make(|| Nodes::of(mesh));
        let mut at = 0;
        while let Some(node) = tree.nodes.get(at as usize) {
            if passes_by(&node.bounds, ray) {
                at = node.next;
                continue;
            }
            let [first, end] = node.triangles;
            tree.triangles[first as usize..end as usize].iter().try_for_each(|&triangle| visit(triangle))?;
            at += 1;
        }
        Ok(())
    }
}

impl Nodes {
    fn of(mesh: &TriangleMesh) -> Self {
        let boxes: Vec<Aabb> =
            (0..mesh.triangles().len() as u32).map(|triangle| Aabb::of(mesh.corners(triangle))).collect();
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut tree = Self::default();
        tree.add(&boxes, &mut order);
        tree
    }

    fn add(&mut self, boxes: &[Aabb], part: &mut [u32]) {
        let of = |triangle: u32| boxes[triangle as usize];
        let bounds = part.iter().fold(Aabb::EMPTY, |all, &triangle| all.union(of(triangle)));
        let (place, first) = (self.nodes.len(), self.triangles.len() as u32);
        self.nodes.push(Node { bounds, next: 0, triangles: [first; 2] });
        if part.len() <= LEAF {
            self.triangles.extend_from_slice(part);
            self.nodes[place].triangles[1] = self.triangles.len() as u32;
        } else {
            let size = bounds.size();
            let longest = (0..3).max_by(|&i, &j| size[i].total_cmp(&size[j])).unwrap_or(0);
            let middle = |triangle: u32| of(triangle).centre()[longest];
            let half = part.len() / 2;
            part.select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
            let (low, high) = part.split_at_mut(half);
            self.add(boxes, low);
            self.add(boxes, high);
        }
        self.nodes[place].next = self.nodes.len() as u32;
    }
}

/// Whether the line of a ray certainly does not meet a box.
fn passes_by(bounds: &Aabb, ray: &Ray) -> bool {
    // Half the box is rounded up by more than its middle was rounded.
    let middle = bounds.centre();
    let half = (bounds.max - middle).max(middle - bounds.min);
    let (to, along) = (middle - ray.origin, ray.direction);
    let moment = to.cross(along);
    let size = along.abs();
    let reach = DVec3::new(
        half.y * size.z + half.z * size.y,
        half.z * size.x + half.x * size.z,
        half.x * size.y + half.y * size.x,
    );
    // One rounding in each coordinate, two more in each product and difference, as many in the reach.
    let coordinates = middle.abs() + ray.origin.abs() + half;
    let error = 8.0 * UNIT_ROUNDOFF_F64 * coordinates.element_sum() * size.element_sum() + f64::MIN_POSITIVE;
    (moment.abs() - reach).cmpgt(DVec3::splat(error)).any()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles here and there, of many sizes.
    fn strewn(count: u32) -> TriangleMesh {
        let at = |i: u32, k: u32| (f64::from(i * 16 + k) * 1.618).sin();
        let positions = (0..3 * count).map(|i| {
            let (triangle, size) = (i / 3, 0.3 * at(i / 3, 9).abs());
            [0, 1, 2].map(|k| (at(triangle, k) + size * at(i + 5000, k)) as f32)
        });
        let triangles = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        TriangleMesh::new(positions.collect(), triangles, None, None).unwrap()
    }

    #[test]
    fn no_triangle_that_a_line_meets_is_left_out_and_most_others_are() {
        let (mesh, tree) = (strewn(2000), LineTree::default());
        let (mut met, mut shown) = (0, 0);
        for i in 0..400_u32 {
            let at = |k: u32| f64::from(i * 8 + k).sin() * 1.5;
            // Every fourth runs along an axis, from a corner of a triangle.
            let corner = mesh.corners(i)[0];
            let ray = if i % 4 == 0 {
                Ray::new(corner, DVec3::AXES[(i / 4 % 3) as usize])
            } else {
                Ray::new(DVec3::new(at(0), at(1), at(2)), DVec3::new(at(3), at(4), at(5)))
            };
            let mut seen = Vec::new();
            let visit = |triangle: u32| {
                seen.push(triangle);
                Ok::<(), ()>(())
            };
            tree.along(&mesh, &ray, visit).unwrap();
            for triangle in 0..2000 {
                if !super::super::triangle::passes_by(&mesh.corners(triangle), &ray) {
                    met += 1;
                    assert!(seen.contains(&triangle), "{triangle} of {ray:?}");
                }
            }
            shown += seen.len();
            seen.sort_unstable();
            assert!(seen.windows(2).all(|pair| pair[0] != pair[1]), "none is shown twice");
        }
        assert!(met > 500 && shown < 20 * met, "{met} {shown}");
    }

    #[test]
    fn a_line_beside_a_box_passes_by() {
        let unit = Aabb { min: DVec3::ZERO, max: DVec3::ONE };
        let by = |origin: [f64; 3], direction: [f64; 3]| {
            passes_by(&unit, &Ray::new(origin.into(), direction.into()))
        };
        assert!(!by([-3.0, 0.5, 0.5], [-1.0, 0.0, 0.0]), "behind the origin as well");
        assert!(!by([1.0, 1.0, -5.0], [0.0, 0.0, 2.0]), "along an edge");
        assert!(by([1.0 + 1e-12, 1.0, -5.0], [0.0, 0.0, 2.0]));
        assert!(by([0.0, 2.0 + 1e-12, 0.5], [1.0, -1.0, 0.0]));
        assert!(!by([0.0, 2.0, 0.5], [1.0, -1.0, 0.0]), "through an edge");
    }
}
