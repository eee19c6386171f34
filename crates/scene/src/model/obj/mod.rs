//! What a Wavefront OBJ file holds (Wavefront, "Object files", Advanced Visualizer Manual, appendix B1), and the MTL files that
//! it names: polygons. Lines, points and free-form surfaces are passed over.
//!
//! Why not a library: tobj 4 names neither line nor value in its errors, cuts polygons into fans, and knows neither smoothing
//! groups nor lines that go on.

mod material;
mod mtl;
mod parts;
mod pictures;
mod tables;

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::scene::Node;
use catoptra_core::{InvalidPart, MaterialId, MeshSource};

use super::error::{Fault, Place};
use super::names::{Names, name_of, text_of};
use super::text::{decoded, words};
use super::warnings::Warnings;
use super::{Folder, Model, ModelMaterial, paint};
use material::Maker;
use mtl::Library;
use parts::{Named, Part, parts_of};
use pictures::Pictures;
use tables::Tables;

pub(super) fn read(bytes: &[u8], folder: &Folder) -> Result<Model, Fault> {
    let bytes = decoded(bytes);
    let warnings = Warnings::default();
    let mut tables = Tables::read(&bytes, &warnings)?;
    let mut library = Library::new();
    if folder.wants_materials() {
        for (line, names) in &tables.libraries {
            read_libraries(names, Place::Line(*line), folder, &mut library, &warnings);
        }
    }
    let parts = parts_of(&mut tables, &bytes, &warnings)?;
    let mut model = Model::default();
    let materials = Materials { names: &tables.materials.names, library: &library, folder }
        .add_to(&mut model, &parts, &warnings)
        .map_err(|e| Fault::new(Place::File, e))?;
    add_nodes(parts, &tables, &materials, &mut model);
    model.warnings = warnings.into_list();
    Ok(model)
}

/// Reads the files that a line names: one whose name may have spaces, or else several.
fn read_libraries(names: &[u8], place: Place, folder: &Folder, library: &mut Library, warnings: &Warnings) {
    let whole = text_of(names);
    let names = if folder.find(&whole).is_ok() { vec![whole] } else { words(names).map(text_of).collect() };
    for name in names {
        let bytes = folder
            .find(&name)
            .and_then(|path| std::fs::read(path).map_err(|cause| format!("{name} cannot be read: {cause}")));
        match bytes {
            Ok(bytes) => mtl::read(&bytes, &name, place, library, warnings),
            Err(cause) => warnings.add(place, format!("materials are missing: {cause}")),
        }
    }
}

/// What materials are made from.
struct Materials<'a> {
    names: &'a [Vec<u8>],
    library: &'a Library,
    folder: &'a Folder,
}

impl Materials<'_> {
    /// Adds the materials of all parts to a model, each once, by their rows.
    fn add_to(
        &self,
        model: &mut Model,
        parts: &[Part],
        warnings: &Warnings,
    ) -> Result<HashMap<u32, MaterialId>, InvalidPart> {
        let has_colors = parts.iter().any(|part| part.mesh.colors().is_some());
        let colors = if has_colors { paint::vertex_colors(model) } else { None };
        let (mut ids, mut names) = (HashMap::new(), Names::default());
        let mut maker = Maker { model, pictures: Pictures::new(self.folder), warnings, colors };
        for part in parts {
            if ids.contains_key(&part.material) {
                continue;
            }
            let given = self.names.get(part.material as usize).map(Vec::as_slice).unwrap_or_default();
            let plain = paint::plain(colors)?;
            let name = if given.is_empty() { plain.name.clone() } else { name_of(given) };
            let name = names.unique(&name);
            let made = match self.library.get(given) {
                Some(described) => maker.make(name.clone(), described),
                None => {
                    if !given.is_empty() && self.folder.wants_materials() {
                        let message = format!("the material {name} is not described: it is grey");
                        maker.warnings.add(Place::File, message);
                    }
                    Ok(ModelMaterial { name: name.clone(), ..plain.clone() })
                }
            };
            let material = made.unwrap_or_else(|refused| {
                let message = format!("the material {name} is grey: {refused}");
                maker.warnings.add(Place::File, message);
                ModelMaterial { name, ..plain }
            });
            let id = maker.model.add_material(material);
            ids.insert(part.material, id);
        }
        Ok(ids)
    }
}

/// Adds the shapes, each called as its object or group; where that has several materials, by theirs too.
fn add_nodes(parts: Vec<Part>, tables: &Tables, materials: &HashMap<u32, MaterialId>, model: &mut Model) {
    let mut counts: HashMap<Option<(Named, u32)>, u32> = HashMap::new();
    for part in &parts {
        *counts.entry(part.name).or_default() += 1;
    }
    let mut names = Names::default();
    for part in parts {
        let Some(&material) = materials.get(&part.material) else { continue };
        let named = part.name.and_then(|(named, row)| match named {
            Named::Object => tables.objects.names.get(row as usize),
            Named::Group => tables.groups.names.get(row as usize),
        });
        let own = name_of(named.map(Vec::as_slice).unwrap_or_default());
        let worn = name_of(
            tables.materials.names.get(part.material as usize).map(Vec::as_slice).unwrap_or_default(),
        );
        let is_alone = counts.get(&part.name) == Some(&1);
        let words: Vec<&str> = match (is_alone, own.is_empty()) {
            (true, false) => vec![&own],
            _ => [own.as_str(), worn.as_str()].into_iter().filter(|word| !word.is_empty()).collect(),
        };
        let name = if words.is_empty() { "mesh".to_owned() } else { words.join(" ") };
        let source = MeshSource { path: String::new(), mesh: Arc::new(part.mesh) };
        model.nodes.push(Node::shape(names.unique(&name), Mesh::new(source), material));
    }
}
