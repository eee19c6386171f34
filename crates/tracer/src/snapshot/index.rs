//! The search structures of a snapshot: the kernels' columns, the tree over all bounded shapes, the trees over meshes.

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Shape, TriangleMesh};

use super::{Columns, Prim, Snapshot};
use crate::Pool;
use crate::accel::{Box32, MeshTree, Preset, Tree};
use crate::numeric::BOUNDS_ERROR;

/// What depends on the shapes alone, not on lights or materials.
#[derive(Debug)]
pub(super) struct Index {
    /// Unbounded shapes.
    pub(super) unbounded: Vec<u32>,
    /// Shapes that have one, in the order of the tree's items.
    pub(super) bounded: Vec<u32>,
    pub(super) tree: Tree,
    /// Each once.
    pub(super) meshes: Vec<Arc<MeshTree>>,
    pub(super) columns: Columns,
    /// For each mesh that stands where an earlier one of the same triangles does, in order: its number and that one's. Rays meet
    /// the earlier one alone.
    pub(super) doubles: Vec<[u32; 2]>,
}

impl Index {
    /// Relative to an origin.
    pub(super) fn build(prims: &[Prim], trees: MeshTrees<'_>, origin: DVec3) -> Self {
        let doubles = doubles(prims);
        let met = |prim: &u32| doubles.binary_search_by_key(prim, |[double, _]| *double).is_err();
        let (bounded, unbounded): (Vec<u32>, Vec<u32>) =
            (0..prims.len() as u32).filter(met).partition(|&i| prims[i as usize].bounds().is_some());
        let boxes = bounded.iter().filter_map(|&i| prims[i as usize].bounds());
        let boxes: Vec<Box32> = boxes.map(|b| around(b, origin)).collect();
        let MeshTrees { meshes, pool, .. } = trees;
        let columns = Columns::of(prims, &bounded, &meshes, origin);
        Self { unbounded, bounded, tree: Tree::build(&boxes, pool), meshes, columns, doubles }
    }
}

/// The meshes that stand where earlier ones of the same triangles do, each with the first of those.
fn doubles(prims: &[Prim]) -> Vec<[u32; 2]> {
    let mut places: HashMap<u32, Vec<u32>> = HashMap::new();
    let mut doubles = Vec::new();
    for (prim, number) in prims.iter().zip(0_u32..) {
        let (Some(tree), None, Some(mesh)) = (prim.mesh, &prim.member, prim.shape.as_mesh()) else {
            continue;
        };
        let firsts = places.entry(tree).or_default();
        let stands_there = |first: &&u32| {
            prims[**first as usize].shape.as_mesh().is_some_and(|other| other.placement() == mesh.placement())
        };
        match firsts.iter().find(stands_there) {
            Some(&first) => doubles.push([number, first]),
            None => firsts.push(number),
        }
    }
    doubles
}

/// A box, relative to an origin, and widened by the rounding of its corners and of rays.
fn around(bounds: Aabb, origin: DVec3) -> Box32 {
    let largest = bounds.min.abs().max(bounds.max.abs()).max(origin.abs()).max_element();
    let slack = DVec3::splat(BOUNDS_ERROR * largest + f64::MIN_POSITIVE);
    Aabb { min: bounds.min - origin - slack, max: bounds.max - origin + slack }.into()
}

/// The trees over the meshes of a scene, each built once.
pub(super) struct MeshTrees<'a> {
    earlier: HashMap<*const TriangleMesh, &'a Arc<MeshTree>>,
    preset: Preset,
    pool: &'a Pool,
    meshes: Vec<Arc<MeshTree>>,
    places: HashMap<*const TriangleMesh, u32>,
}

impl<'a> MeshTrees<'a> {
    /// All built anew.
    pub(super) fn new(preset: Preset, pool: &'a Pool) -> Self {
        Self { earlier: HashMap::new(), preset, pool, meshes: Vec::new(), places: HashMap::new() }
    }

    /// Those of a snapshot are taken over, and others built as they were.
    pub(super) fn after(earlier: &'a Snapshot, pool: &'a Pool) -> Self {
        let trees = earlier.index.meshes.iter().map(|tree| (Arc::as_ptr(tree.mesh()), tree)).collect();
        Self { earlier: trees, ..Self::new(earlier.preset, pool) }
    }

    /// How trees are built.
    pub(super) fn preset(&self) -> Preset {
        self.preset
    }

    /// The index of a shape's mesh tree; `None` for shapes that are not meshes.
    pub(super) fn of(&mut self, shape: &Shape) -> Option<u32> {
        let mesh = shape.as_mesh()?.triangles();
        Some(*self.places.entry(Arc::as_ptr(mesh)).or_insert_with(|| {
            let known = self.earlier.get(&Arc::as_ptr(mesh)).map(|tree| Arc::clone(tree));
            let tree = known.unwrap_or_else(|| Arc::new(MeshTree::build(mesh, self.preset, self.pool)));
            self.meshes.push(tree);
            self.meshes.len() as u32 - 1
        }))
    }
}
