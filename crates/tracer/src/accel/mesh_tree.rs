//! A mesh with its tree: built once, shared by all instances of the mesh.

use std::sync::Arc;

use catoptra_core::TriangleMesh;

use super::grow::grow;
use super::{Preset, WideTree};
use crate::numeric::magnitude_of;
use crate::{Control, Pool};

/// A triangle mesh and a tree of boxes over its triangles, in the mesh's own space.
#[derive(Debug)]
pub struct MeshTree {
    mesh: Arc<TriangleMesh>,
    pub(crate) tree: WideTree,
    /// At least the sum of any corner's coordinates' magnitudes.
    pub(crate) reach: f32,
}

impl MeshTree {
    /// Builds the tree on the threads of `pool`; it does not depend on how many there are.
    #[must_use]
    pub fn build(mesh: &Arc<TriangleMesh>, preset: Preset, pool: &Pool) -> Self {
        Self::build_unless_cancelled(mesh, preset, pool, &Control::default())
    }

    /// As [`build`](Self::build), telling `control` of each triangle; what comes of it once that is cancelled holds none.
    pub(crate) fn build_unless_cancelled(
        mesh: &Arc<TriangleMesh>,
        preset: Preset,
        pool: &Pool,
        control: &Control,
    ) -> Self {
        let reach = mesh.bounds().corners().map(magnitude_of).into_iter().fold(0.0, f32::max);
        Self { mesh: Arc::clone(mesh), tree: grow(mesh, preset, pool, control), reach }
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &Arc<TriangleMesh> {
        &self.mesh
    }

    /// The tree, to be walked by rays.
    #[inline(always)]
    pub(crate) fn to_walk(&self) -> &WideTree {
        self.tree.planes.number_where_it_pays(&self.mesh, &self.tree.blocks);
        &self.tree
    }

    /// Bytes of the tree with its copies of the triangles, without the mesh.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.tree.bytes()
    }
}
