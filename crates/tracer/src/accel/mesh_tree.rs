//! A mesh with its tree: built once, shared by every place where the mesh stands.

use std::sync::Arc;

use catoptra_core::TriangleMesh;

use super::Tree;
use super::tree::Box32;
use crate::kernel::magnitude_of;

/// A triangle mesh and a tree of boxes over its triangles, in the mesh's own space.
#[derive(Debug)]
pub struct MeshTree {
    mesh: Arc<TriangleMesh>,
    pub(crate) tree: Tree,
    /// Corners of every triangle in the order of the tree's leaves.
    pub(crate) corners: Vec<[[f32; 3]; 3]>,
    /// At least the sum of any corner's coordinates' magnitudes.
    pub(crate) reach: f32,
}

impl MeshTree {
    /// Builds the tree, on the threads of the pool it is called in.
    #[must_use]
    pub fn build(mesh: &Arc<TriangleMesh>) -> Self {
        let corners_of = |t: &[u32; 3]| t.map(|i| mesh.positions()[i as usize]);
        let boxes: Vec<Box32> = mesh.triangles().iter().map(|t| Box32::of(corners_of(t))).collect();
        let tree = Tree::build(&boxes);
        let corners = tree.order.iter().map(|&i| corners_of(&mesh.triangles()[i as usize])).collect();
        let reach = mesh.bounds().corners().map(magnitude_of).into_iter().fold(0.0, f32::max);
        Self { mesh: Arc::clone(mesh), tree, corners, reach }
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &Arc<TriangleMesh> {
        &self.mesh
    }

    /// Bytes of the tree, without the mesh.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.tree.nodes[..]) + size_of_val(&self.tree.order[..]) + size_of_val(&self.corners[..])
    }
}
