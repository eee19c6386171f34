//! How few things a ray is tested against: trees of boxes.

mod build;
mod mesh_tree;
mod tree;

pub use mesh_tree::MeshTree;
pub(crate) use tree::{Box32, MAX_DEPTH, Node, Tree};
