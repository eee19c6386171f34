//! What a glTF 2.0 file holds: text with files beside it (`.gltf`), or all in one (`.glb`).
//!
//! Shapes, materials, textures, lights and cameras come in as the file nests them; skins and morph targets in the pose in
//! which the file stands. What is not shown as the file means it, is a warning.
//!
//! Everything is checked against the bytes that are there. What a file may name many times is bounded beside that: 2²⁰ shapes
//! and groups, nodes 128 deep, meshes of 1 GiB and 64 bytes for each byte of the file, 4 GiB of buffers; see `limits.rs`.
//!
//! Why not a library: the gltf crate (1.4) asserts where a file contradicts itself, and reserves what a count asks for.

mod accessor;
mod buffers;
mod container;
mod extensions;
mod geometry;
mod json;
mod limits;
mod look;
mod names;
mod refusal;
mod source;
mod tree;
mod uri;

use super::error::Fault;
use super::{Folder, Model};
use json::Document;
use look::Looks;
use source::Source;
use tree::Tree;

/// Reads a file, and the files that it names.
pub(super) fn read(bytes: &[u8], folder: &Folder) -> Result<Model, Fault> {
    let container = container::open(bytes)?;
    let document = Document::read(container.json, container.start)?;
    let source = Source::new(&document, container.binary, folder, bytes.len());
    extensions::check(&document, &source.warnings)?;
    if !document.animations.is_empty() {
        source.warnings.add_of_file("animations are left out: things stand as the file has them");
    }
    let tree = Tree::new(&source, Looks::new(&source))?;
    let (nodes, looks) = tree.build()?;
    let model = looks.into_model();
    Ok(Model { nodes, warnings: source.warnings.into_list(), ..model })
}
