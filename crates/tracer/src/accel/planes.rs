//! Which triangles of a mesh lie in one plane, so that a ray meets them at one point, and leaves one with all others?
//!
//! Of single triangles exact arithmetic tells. Where it is asked that often, as in decals and in masses of triangles that overlap in
//! one plane, the planes are numbered once, which takes as long as some such answers a triangle.

use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

use catoptra_core::TriangleMesh;
use catoptra_core::glam::DVec3;

use super::wide_tree::{Block8, WIDTH};
use crate::numeric::{PLANE_CELL, PLANE_THIN};

/// The planes of a mesh's triangles, each told by the number of the first triangle in it. Triangles of one number lie in one plane;
/// most in one plane have one number, but slivers and those that rounding drew apart have numbers of their own.
#[derive(Debug)]
pub(crate) struct Planes {
    of_facets: Box<[u32]>,
    /// The same in the order of a tree's blocks.
    of_blocks: Box<[[u32; WIDTH]]>,
}

impl Planes {
    /// The plane of the triangle at a slot of the tree's blocks.
    #[inline(always)]
    pub(crate) fn of_slot(&self, slot: u32) -> u32 {
        self.of_blocks[slot as usize / WIDTH][slot as usize % WIDTH]
    }

    /// The planes of a block's triangles.
    #[inline(always)]
    pub(crate) fn of_block(&self, block: usize) -> &[u32; WIDTH] {
        &self.of_blocks[block]
    }

    /// The plane of a triangle of the mesh; a number of none stays what it is.
    #[inline(always)]
    pub(crate) fn of_facet(&self, facet: u32) -> u32 {
        self.of_facets.get(facet as usize).copied().unwrap_or(facet)
    }

    /// Of the triangles of a mesh in the blocks of its tree; `None` where no two have one number.
    fn number(mesh: &TriangleMesh, blocks: &[Block8]) -> Option<Self> {
        let of_facets = first_in_planes(mesh)?;
        let of_blocks =
            blocks.iter().map(|block| block.facet.map(|facet| of_facets[facet as usize])).collect();
        Some(Self { of_facets, of_blocks })
    }
}

/// How often exact arithmetic was asked about a mesh, and its planes once that was often.
#[derive(Debug, Default)]
pub(crate) struct AskedPlanes {
    asked: AtomicU32,
    planes: OnceLock<Option<Planes>>,
}

/// Answers that are left to exact arithmetic in any case: those of ordinary meshes.
const FEW: u32 = 4096;

impl AskedPlanes {
    /// Counts answers of exact arithmetic.
    pub(crate) fn count(&self, answers: u32) {
        if answers > 0 {
            self.asked.fetch_add(answers, Ordering::Relaxed);
        }
    }

    /// The planes, if they have been numbered and any holds more than one triangle.
    #[inline(always)]
    pub(crate) fn known(&self) -> Option<&Planes> {
        self.planes.get().and_then(Option::as_ref)
    }

    /// Numbers them once that takes no longer than the answers that were asked for: some four triangles in the time of one.
    #[inline(always)]
    pub(super) fn number_where_it_pays(&self, mesh: &TriangleMesh, blocks: &[Block8]) {
        if self.asked.load(Ordering::Relaxed) > FEW + mesh.triangles().len() as u32 / 4 {
            self.number(mesh, blocks);
        }
    }

    #[cold]
    #[inline(never)]
    fn number(&self, mesh: &TriangleMesh, blocks: &[Block8]) {
        self.planes.get_or_init(|| Planes::number(mesh, blocks));
    }
}

/// No triangle.
const NONE: u32 = u32::MAX;
/// The most planes that are held against a triangle: so close together that they share a cell.
const MOST: u32 = 8;

/// For each triangle the first that lies in the same plane, as far as cells of all but equal planes show; `None` where each is its own.
fn first_in_planes(mesh: &TriangleMesh) -> Option<Box<[u32]>> {
    let count = mesh.triangles().len();
    let reach = mesh.bounds().corners().map(|p| p.abs().max_element()).into_iter().fold(0.0, f64::max);
    let hasher = BuildHasherDefault::<DefaultHasher>::new();
    // The first triangle of each plane and its hash, where that says or after that: half of it stays empty.
    let mut found = vec![(0_u64, NONE); (2 * count).next_power_of_two()];
    let mut firsts: Box<[u32]> = (0..count as u32).collect();
    let mut any = false;
    for own in 0..count as u32 {
        let Some(cell) = cell(&mesh.corners(own), reach) else { continue };
        let hash = hasher.hash_one(cell);
        let (mut at, mut tried) = (hash as usize, 0);
        loop {
            at &= found.len() - 1;
            let (of, first) = found[at];
            if first == NONE {
                found[at] = (hash, own);
                break;
            }
            if of == hash {
                if mesh.lies_in_plane(own, first) {
                    (firsts[own as usize], any) = (first, true);
                    break;
                }
                tried += 1;
                if tried == MOST {
                    break;
                }
            }
            at += 1;
        }
    }
    any.then_some(firsts)
}

/// Where the plane of a triangle lies, its normal and its distance from the origin in parts of `reach`, in whole cells; `None` of
/// triangles so thin that rounding may have turned them.
fn cell(&[a, b, c]: &[DVec3; 3], reach: f64) -> Option<[i64; 4]> {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    let most = normal.abs().max_element();
    let length = u.abs().max(v.abs()).max_element();
    if !(most > PLANE_THIN * length * length) {
        return None;
    }
    // Its sign is that of the first component that is not small; a limit that no simple number meets.
    let first = normal.to_array().into_iter().find(|n| n.abs() > 0.287_1 * most)?;
    let normal = normal / most.copysign(first);
    let cells = |value: f64| (value / PLANE_CELL).round() as i64;
    Some([normal.x, normal.y, normal.z, normal.dot(a) / reach].map(cells))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn numbers_are_those_of_planes_that_hold_the_triangles() {
        let random = &mut Random(7);
        let mut whole = |below: u64| (random.bits() % below) as i32 - below as i32 / 2;
        // Planes that `f32` holds exactly, and triangles that all but lie in one.
        let planes: Vec<[DVec3; 3]> = (0..40)
            .map(|_| [(); 3].map(|()| DVec3::new(whole(19).into(), whole(19).into(), whole(19).into())))
            .collect();
        let mut positions = Vec::new();
        for at in 0..6000 {
            let [base, u, v] = planes[at % planes.len()];
            for corner in 0..3 {
                let p = base + u * f64::from(whole(21)) + v * f64::from(whole(21));
                let off = if at % 7 == 0 && corner == 0 { 1.0 / 8192.0 } else { 0.0 };
                positions.push((p + off).as_vec3().to_array());
            }
        }
        let triangles = (0..6000).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
        let mesh = TriangleMesh::new(positions, triangles, None, None).unwrap();
        let firsts = first_in_planes(&mesh).unwrap();
        let mut shared = 0;
        for (own, first) in (0_u32..).zip(&firsts) {
            assert!(*first <= own && firsts[*first as usize] == *first);
            assert!(mesh.lies_in_plane(own, *first) && mesh.lies_in_plane(*first, own));
            shared += u32::from(*first != own);
        }
        assert!(shared > 4000, "{shared}");
    }

    #[test]
    fn a_mesh_without_common_planes_has_no_numbers() {
        let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let triangles = vec![[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
        let mesh = TriangleMesh::new(corners, triangles, None, None).unwrap();
        assert!(first_in_planes(&mesh).is_none());
    }
}
