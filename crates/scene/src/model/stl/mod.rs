//! What an STL file holds, binary or as text (3D Systems, StereoLithography interface specification, 1989): facets, each with
//! corners of its own. Corners in one place become one; normals are those of the facets as they are wound, since many
//! programs write others or none.

mod ascii;
mod binary;

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::scene::Node;
use catoptra_core::{InvalidPart, MeshSource, TriangleMesh};

use super::error::{Fault, Place};
use super::names::Names;
use super::text::decoded;
use super::warnings::Warnings;
use super::{Folder, Model, ModelMaterial, paint};

pub(super) fn read(bytes: &[u8], _: &Folder) -> Result<Model, Fault> {
    let warnings = Warnings::default();
    let decoded = decoded(bytes);
    let solids = if bytes.is_empty() {
        return Err(Fault::new(Place::File, "the file is empty"));
    } else if is_text(&decoded) {
        ascii::read(&decoded, &warnings)?
    } else {
        vec![(String::new(), binary::read(bytes, &warnings)?)]
    };
    model_of(solids, warnings).map_err(|e| Fault::new(Place::File, e))
}

/// Bytes from the start that are looked through for what no text holds.
const LOOKED_THROUGH: usize = 512;

/// Whether it is text: binary files may begin with `solid` as well, but have the length that their count says, and zeros in it.
fn is_text(bytes: &[u8]) -> bool {
    if binary::count(bytes).is_some_and(|count| bytes.len() as u64 == binary::length(count)) {
        return false;
    }
    let start = bytes[..bytes.len().min(LOOKED_THROUGH)].to_ascii_lowercase();
    let has = |word: &[u8]| start.windows(word.len()).any(|window| window == word);
    !start.contains(&0) && (start.trim_ascii_start().starts_with(b"solid") || has(b"facet"))
}

fn model_of(solids: Vec<(String, TriangleMesh)>, warnings: Warnings) -> Result<Model, InvalidPart> {
    let mut model = Model { warnings: warnings.into_list(), ..Model::default() };
    let has_colors = solids.iter().any(|(_, mesh)| mesh.colors().is_some());
    let colors = if has_colors { paint::vertex_colors(&mut model) } else { None };
    let plain: ModelMaterial = paint::plain(colors)?;
    let material = model.add_material(plain);
    let mut names = Names::default();
    for (name, mesh) in solids {
        let name = names.unique(if name.is_empty() { "mesh" } else { &name });
        let source = MeshSource { path: String::new(), mesh: Arc::new(mesh) };
        model.nodes.push(Node::shape(name, Mesh::new(source), material));
    }
    Ok(model)
}

/// Corners, each place once.
struct Merged<T> {
    list: Vec<[T; 3]>,
    rows: HashMap<[u64; 3], u32, foldhash::fast::RandomState>,
}

impl<T: Copy + Into<f64>> Merged<T> {
    fn with_room(count: usize) -> Self {
        Self {
            list: Vec::with_capacity(count),
            rows: HashMap::with_capacity_and_hasher(count, Default::default()),
        }
    }

    /// The row of a corner.
    fn row(&mut self, corner: [T; 3]) -> u32 {
        // Zero has two signs and one place.
        let key = corner.map(|v| (v.into() + 0.0).to_bits());
        let next = self.list.len() as u32;
        let row = *self.rows.entry(key).or_insert(next);
        if row == next {
            self.list.push(corner);
        }
        row
    }
}
