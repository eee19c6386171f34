//! The search structures of a snapshot: the kernels' columns, the tree over all bounded shapes, the trees over meshes.

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Placement, Shape, TriangleMesh};

use super::{Columns, Prim, Snapshot};
use crate::accel::{Box32, MeshTree, Preset, Tree};
use crate::numeric::BOUNDS_ERROR;
use crate::{Cancelled, Control, Pool};

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
    let mut firsts = HashMap::new();
    let mut doubles = Vec::new();
    for (prim, number) in prims.iter().zip(0_u32..) {
        let (Some(tree), None, Some(mesh)) = (prim.mesh, &prim.member, prim.shape.as_mesh()) else {
            continue;
        };
        let first = *firsts.entry((tree, bits_of(mesh.placement()))).or_insert(number);
        if first != number {
            doubles.push([number, first]);
        }
    }
    doubles
}

/// A placement as bits that are equal where it is.
fn bits_of(placement: &Placement) -> [[u64; 4]; 2] {
    let (turned, moved) = (placement.rotation(), placement.translation());
    let numbers = [turned.to_array(), moved.extend(placement.scale()).to_array()];
    // Adding 0 makes both zeros one.
    numbers.map(|row| row.map(|v| (v + 0.0).to_bits()))
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
    control: &'a Control,
    meshes: Vec<Arc<MeshTree>>,
    places: HashMap<*const TriangleMesh, u32>,
}

impl<'a> MeshTrees<'a> {
    /// All built anew.
    pub(super) fn new(preset: Preset, pool: &'a Pool, control: &'a Control) -> Self {
        let (earlier, places) = (HashMap::new(), HashMap::new());
        Self { earlier, preset, pool, control, meshes: Vec::new(), places }
    }

    /// Those of a snapshot are taken over, and others built as they were.
    pub(super) fn after(earlier: &'a Snapshot, pool: &'a Pool, control: &'a Control) -> Self {
        let trees = earlier.index.meshes.iter().map(|tree| (Arc::as_ptr(tree.mesh()), tree)).collect();
        Self { earlier: trees, ..Self::new(earlier.preset, pool, control) }
    }

    /// How trees are built.
    pub(super) fn preset(&self) -> Preset {
        self.preset
    }

    /// Tells whoever watches of how many triangles there are to be trees.
    pub(super) fn announce<'s>(&self, shapes: impl Iterator<Item = &'s Shape>) {
        let meshes = shapes.filter_map(|shape| Some(shape.as_mesh()?.triangles()));
        let anew: HashMap<_, usize> = meshes
            .map(|mesh| (Arc::as_ptr(mesh), mesh.triangles().len()))
            .filter(|(mesh, _)| !self.earlier.contains_key(mesh))
            .collect();
        self.control.start(anew.into_values().sum());
    }

    /// The index of a shape's mesh tree; `None` for shapes that are not meshes.
    ///
    /// # Errors
    /// [`Cancelled`] when whoever watches said so.
    pub(super) fn of(&mut self, shape: &Shape) -> Result<Option<u32>, Cancelled> {
        let Some(mesh) = shape.as_mesh().map(Mesh::triangles) else { return Ok(None) };
        let address = Arc::as_ptr(mesh);
        if let Some(place) = self.places.get(&address) {
            return Ok(Some(*place));
        }
        let tree = match self.earlier.get(&address) {
            Some(known) => Arc::clone(known),
            None => {
                let built = MeshTree::build_unless_cancelled(mesh, self.preset, self.pool, self.control);
                self.control.check()?;
                Arc::new(built)
            }
        };
        let place = self.meshes.len() as u32;
        self.meshes.push(tree);
        self.places.insert(address, place);
        Ok(Some(place))
    }
}
