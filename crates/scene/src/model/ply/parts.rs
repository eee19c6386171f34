//! Which shapes do the faces of a PLY file make up, and what do they wear?

use std::collections::BTreeMap;
use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::scene::Node;
use catoptra_core::texture::TextureUse;
use catoptra_core::{InvalidPart, MeshSource, TriangleMesh, Values};

use super::faces::{Faces, Whole, cut};
use super::header::Header;
use super::vertices::Found;
use crate::model::colors::linear;
use crate::model::error::{Fault, Place};
use crate::model::mesh::{Corner, Cutter, NONE, Tables, weld};
use crate::model::names::Names;
use crate::model::warnings::Warnings;
use crate::model::{Folder, Model, ModelMaterial, paint};

pub(super) fn model_of(
    header: &Header,
    found: Found,
    faces: Faces,
    folder: &Folder,
    warnings: Warnings,
) -> Result<Model, Fault> {
    let refused = |e: InvalidPart| Fault::new(Place::File, e);
    let has_whole = !faces.whole.ends.is_empty();
    if faces.triangles.is_empty() && !has_whole {
        return Err(Fault::new(Place::File, "holds no faces"));
    }
    // The pictures of the shapes, each with its mesh.
    let meshes = if has_whole {
        meshes_of(&found, &faces)?
    } else {
        let mesh = found.vertices.mesh(faces.triangles).map_err(refused)?;
        vec![(0, mesh)]
    };
    let mut model = Model::default();
    let (mut shapes, mut names) = (Names::default(), Names::default());
    for (picture, mesh) in meshes {
        let texture = match header.pictures.get(picture as usize) {
            Some(name) if mesh.uvs().is_some() && folder.wants_materials() => {
                picture_of(&mut model, name, folder, &warnings)
            }
            _ => None,
        };
        let colors = mesh.colors().is_some();
        let texture = texture.or_else(|| colors.then(|| paint::vertex_colors(&mut model)).flatten());
        let plain = paint::plain(texture).map_err(refused)?;
        let material = model.add_material(ModelMaterial { name: names.unique(&plain.name), ..plain });
        let name = shapes.unique("mesh");
        let source = MeshSource { path: String::new(), mesh: Arc::new(mesh) };
        model.nodes.push(Node::shape(name, Mesh::new(source), material));
    }
    model.warnings = warnings.into_list();
    Ok(model)
}

fn picture_of(model: &mut Model, name: &str, folder: &Folder, warnings: &Warnings) -> Option<TextureUse> {
    let image = folder.find(name).and_then(|path| crate::image::load(&path).map_err(|e| e.to_string()));
    let texture =
        image.and_then(|image| paint::image_texture(name, image, Values::new()).map_err(|e| e.to_string()));
    match texture {
        Ok(texture) => paint::add_texture(model, name.to_owned(), texture).map(TextureUse::of),
        Err(cause) => {
            warnings.add(Place::File, format!("the picture {name} is not shown: {cause}"));
            None
        }
    }
}

/// The shapes of faces that have more than corners: one for each picture.
fn meshes_of(found: &Found, faces: &Faces) -> Result<Vec<(i64, TriangleMesh)>, Fault> {
    let Whole { corners, ends, uvs, colors, pictures } = &faces.whole;
    let vertices = &found.vertices;
    let face_colors = linear(colors.clone());
    let has = |list: bool, row: u32| if list { row } else { NONE };
    let by_vertex = |vertex: u32| Corner {
        position: vertex,
        normal: has(vertices.normals.is_some(), vertex),
        uv: has(vertices.uvs.is_some(), vertex),
        color: has(vertices.colors.is_some(), vertex),
    };
    let mut shapes: BTreeMap<i64, Vec<[Corner; 3]>> = BTreeMap::new();
    let (mut cutter, mut pieces) = (Cutter::default(), Vec::new());
    let mut start = 0;
    for (face, &end) in ends.iter().enumerate() {
        let outline = &corners[start..end];
        found.check(outline)?;
        let corner = |i: u32| {
            let row = start + i as usize;
            let mut corner = by_vertex(outline[i as usize]);
            if !uvs.is_empty() {
                let is_some = uvs.get(row).is_some_and(|uv| uv.iter().all(|v| v.is_finite()));
                corner.uv = has(is_some, row as u32);
            }
            if vertices.colors.is_none() && !colors.is_empty() {
                corner.color = face as u32;
            }
            corner
        };
        let triangles = shapes.entry(pictures.get(face).copied().unwrap_or(0)).or_default();
        triangles.extend(cut(&mut cutter, &mut pieces, outline, found).iter().map(|piece| piece.map(corner)));
        start = end;
    }
    shapes.entry(0).or_default().extend(faces.triangles.iter().map(|triangle| triangle.map(by_vertex)));
    let used = shapes.values().flatten().flatten().map(|corner| corner.position);
    let tables = Tables {
        positions: &vertices.positions,
        origin: vertices.positions.origin(used),
        normals: vertices.normals.as_deref().unwrap_or_default(),
        uvs: if uvs.is_empty() { vertices.uvs.as_deref().unwrap_or_default() } else { uvs },
        colors: vertices.colors.as_deref().unwrap_or(&face_colors),
    };
    let shapes = shapes.iter().filter(|(_, triangles)| !triangles.is_empty());
    let meshes = shapes.map(|(&picture, triangles)| Ok((picture, weld(&tables, triangles)?)));
    meshes.collect::<Result<_, InvalidPart>>().map_err(|e| Fault::new(Place::File, e))
}
