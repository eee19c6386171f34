//! Acceleration structures: bounding volume hierarchies over shapes and over the triangles of meshes.

mod bins;
mod build;
mod clip;
mod grow;
mod mesh_tree;
mod pack;
mod planes;
mod preset;
mod spatial;
mod tree;
mod wide_tree;

pub use mesh_tree::MeshTree;
pub(crate) use planes::Planes;
pub use preset::Preset;
pub(crate) use tree::{Box32, MAX_DEPTH, Node, Tree};
pub(crate) use wide_tree::{Block8, Node8, WIDTH, WideTree};
