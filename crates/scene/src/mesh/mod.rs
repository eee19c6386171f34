//! How triangle meshes come in from files: PLY (ascii, binary of either byte order) and OBJ, told apart by the
//! file's ending.
//!
//! A file is read whole and checked while it is read: counts against the bytes that are there before anything is
//! reserved, every index against the vertices, every coordinate for being finite. A refusal says where: the line of
//! a text file, the byte of a binary one.

mod error;
mod obj;
mod ply;

use std::path::Path;

use catoptra_core::TriangleMesh;

use error::Fault;
pub use error::{MeshError, Place};

/// Endings of the files that [`read`] understands.
pub const ENDINGS: &[&str] = &["ply", "obj"];

/// Reads a triangle mesh; polygons are cut into fans, in file order.
///
/// Positions are kept as `f32` in the file's own units. Normals and texture coordinates come along where every
/// vertex (PLY) or every corner (OBJ) has them. Takes memory of about twice the file's size while reading.
///
/// # Errors
/// A file that cannot be read, has an ending not in [`ENDINGS`], or is no valid mesh.
pub fn read(path: &Path) -> Result<TriangleMesh, MeshError> {
    let format = format_of(path).map_err(|fault| MeshError::new(path, fault))?;
    let bytes = std::fs::read(path).map_err(|e| MeshError::unreadable(path, &e))?;
    parse(&bytes, format).map_err(|fault| MeshError::new(path, fault))
}

/// Reads a triangle mesh from the bytes of a file whose name tells the format.
///
/// # Errors
/// As for [`read`]; `name` stands for the file in messages.
pub fn read_bytes(bytes: &[u8], name: &Path) -> Result<TriangleMesh, MeshError> {
    format_of(name).and_then(|format| parse(bytes, format)).map_err(|fault| MeshError::new(name, fault))
}

type Format = fn(&[u8]) -> Result<Polygons, Fault>;

fn format_of(path: &Path) -> Result<Format, Fault> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("ply") => Ok(ply::read),
        Some("obj") => Ok(obj::read),
        _ => Err(Fault::new(Place::File, "is no mesh file: its name must end in .ply or .obj")),
    }
}

fn parse(bytes: &[u8], format: Format) -> Result<TriangleMesh, Fault> {
    let found = format(bytes)?;
    TriangleMesh::new(found.positions, found.triangles, found.normals, found.uvs)
        .map_err(|e| Fault::new(Place::File, e.to_string()))
}

/// What a file holds, before the mesh is made.
#[derive(Default)]
struct Polygons {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Vec<[f32; 3]>>,
    uvs: Option<Vec<[f32; 2]>>,
}

/// Narrows to `f32`, refusing what is not finite there.
fn finite<const N: usize>(values: [f64; N], place: Place, what: &str) -> Result<[f32; N], Fault> {
    let narrow = values.map(|v| v as f32);
    match narrow.iter().position(|v| !v.is_finite()) {
        None => Ok(narrow),
        Some(i) => Err(Fault::new(place, format!("{what} must be finite numbers, not {}", values[i]))),
    }
}
