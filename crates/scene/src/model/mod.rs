//! How models come in from files, whatever the format: told apart by how the file begins, or else by its ending.
//!
//! A file is read whole and checked while it is read: counts against the bytes that are there before anything is
//! reserved, every index against its table, every coordinate in use for being finite. A refusal says where: the line of
//! a text file, the byte of a binary one. What a file holds that is not shown as it means it, is a [`Warning`].
//!
//! A new format is one file or folder here and one line in [`FORMATS`].

mod beginning;
mod colors;
mod contents;
mod error;
mod folder;
mod gltf;
mod merged;
mod mesh;
mod names;
mod obj;
mod paint;
mod ply;
mod stl;
mod text;
mod warnings;

use std::io::Read;
use std::path::{Path, PathBuf};

use catoptra_core::TriangleMesh;

pub use contents::{Model, ModelMaterial, Warning};
use error::Fault;
pub use error::{ModelError, Place};
pub use folder::Folder;

/// A kind of model file.
#[derive(Debug, Clone, Copy)]
pub struct Format {
    /// Its name, such as `OBJ`.
    pub name: &'static str,
    /// Endings of its files, in lower case.
    pub endings: &'static [&'static str],
    /// What comes along beside triangles.
    pub doc: &'static str,
    /// Whether a file that begins so is one, and can be nothing else.
    is_so: fn(&[u8]) -> bool,
    read: fn(&[u8], &Folder) -> Result<Model, Fault>,
}

/// All kinds of model files that can be read.
pub const FORMATS: &[Format] = &[
    Format {
        name: "PLY",
        endings: &["ply"],
        doc: "normals, texture coordinates, colours, pictures",
        is_so: beginning::is_ply,
        read: ply::read,
    },
    Format {
        name: "OBJ",
        endings: &["obj"],
        doc: "objects and groups, normals, texture coordinates, colours, materials from MTL files",
        is_so: beginning::is_obj,
        read: obj::read,
    },
    Format {
        name: "STL",
        endings: &["stl"],
        doc: "solids, colours of VisCAM and Magics",
        is_so: beginning::is_stl,
        read: stl::read,
    },
    Format {
        name: "glTF",
        endings: &["gltf", "glb"],
        doc: "normals, texture coordinates, colours, materials, textures, groups, lights, cameras",
        is_so: beginning::is_gltf,
        read: gltf::read,
    },
];

/// Endings of all files that [`read`] understands.
pub fn endings() -> impl Iterator<Item = &'static str> {
    FORMATS.iter().flat_map(|format| format.endings).copied()
}

/// Reads a model and the files that it names.
///
/// # Errors
/// A file that cannot be read, has an ending that no [format](FORMATS) has, or is no valid model.
pub fn read(path: &Path) -> Result<Model, ModelError> {
    read_in(path, &Folder::of(path))
}

fn read_in(path: &Path, folder: &Folder) -> Result<Model, ModelError> {
    if let (Err(fault), false) = (format_of(path), begins_as_one(path)) {
        return Err(ModelError::new(path, fault));
    }
    let bytes = std::fs::read(path).map_err(|e| ModelError::unreadable(path, &e))?;
    read_bytes(&bytes, path, folder)
}

/// Reads a model from the bytes of a file. How they begin tells the format, or else the file's name.
///
/// # Errors
/// As for [`read`]; `name` stands for the file in messages.
pub fn read_bytes(bytes: &[u8], name: &Path, folder: &Folder) -> Result<Model, ModelError> {
    let format = of_content(bytes).map_or_else(|| format_of(name), Ok);
    let read = format.and_then(|format| (format.read)(bytes, folder));
    let read = read.map(|model| Model { files: folder.asked(), ..model });
    read.map_err(|fault| ModelError::new(name, fault))
}

/// The same as [`read_mesh`], with what of the file is not shown as the file means it.
///
/// # Errors
/// As for [`read_mesh`].
pub fn read_mesh_with_warnings(path: &Path) -> Result<(TriangleMesh, Vec<Warning>), ModelError> {
    read_mesh_and_more(path).map(|(mesh, warnings, _)| (mesh, warnings))
}

/// The same, and where the other files lie that it names.
pub(crate) fn read_mesh_and_more(
    path: &Path,
) -> Result<(TriangleMesh, Vec<Warning>, Vec<PathBuf>), ModelError> {
    let mut model = read_in(path, &Folder::of(path).for_shapes_alone())?;
    let (warnings, files) = (std::mem::take(&mut model.warnings), std::mem::take(&mut model.files));
    merged::mesh_of(model).map(|mesh| (mesh, warnings, files)).map_err(|fault| ModelError::new(path, fault))
}

/// Reads all triangles of a model as one mesh: shapes where the file places them, without lights and materials.
///
/// Positions are kept as `f32` round an [offset](TriangleMesh::offset) in `f64`, with which
/// `catoptra_tracer::Caster::from_mesh` takes them. Takes memory of about twice the file's size while reading.
///
/// # Errors
/// As for [`read`], and a model without triangles.
pub fn read_mesh(path: &Path) -> Result<TriangleMesh, ModelError> {
    read_mesh_with_warnings(path).map(|(mesh, _)| mesh)
}

/// Reads all triangles of a model as one mesh from the bytes of a file whose name tells the format.
///
/// # Errors
/// As for [`read_mesh`]; `name` stands for the file in messages.
pub fn read_mesh_bytes(bytes: &[u8], name: &Path) -> Result<TriangleMesh, ModelError> {
    let model = read_bytes(bytes, name, &Folder::none().for_shapes_alone())?;
    merged::mesh_of(model).map_err(|fault| ModelError::new(name, fault))
}

/// Whether a file has an ending of models.
#[must_use]
pub fn is_named_so(path: &Path) -> bool {
    format_of(path).is_ok()
}

/// Whether a file begins as models of one [format](FORMATS) alone do, whatever it is called.
#[must_use]
pub fn begins_as_one(path: &Path) -> bool {
    let mut start = Vec::new();
    let is_file = path.is_file();
    let mut read =
        || std::fs::File::open(path)?.take(beginning::LOOKED_THROUGH as u64).read_to_end(&mut start);
    is_file && read().is_ok() && of_content(&start).is_some()
}

/// The format of a file that begins so, where it can be no other.
#[must_use]
pub fn of_content(bytes: &[u8]) -> Option<&'static Format> {
    FORMATS.iter().find(|format| (format.is_so)(bytes))
}

fn format_of(path: &Path) -> Result<&'static Format, Fault> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    FORMATS.iter().find(|format| format.endings.contains(&ending.as_str())).ok_or_else(|| {
        let known: Vec<String> = endings().map(|ending| format!(".{ending}")).collect();
        let known = known.join(", ");
        Fault::new(Place::File, format!("is no model file: its name must end in one of {known}"))
    })
}
