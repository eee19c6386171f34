//! How do the corners of faces, which name places in several tables, become the vertices of a mesh?

use std::collections::HashMap;

use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, TriangleMesh};

use super::Positions;

/// Stands for "none" in a corner.
pub(in crate::model) const NONE: u32 = u32::MAX;

/// A corner of a face: its row of each table, or [`NONE`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::model) struct Corner {
    pub(in crate::model) position: u32,
    pub(in crate::model) normal: u32,
    pub(in crate::model) uv: u32,
    pub(in crate::model) color: u32,
}

/// What the corners of faces name.
#[derive(Debug, Clone, Copy)]
pub(in crate::model) struct Tables<'a> {
    pub(in crate::model) positions: &'a Positions,
    /// From where positions are counted in the mesh.
    pub(in crate::model) origin: DVec3,
    pub(in crate::model) normals: &'a [[f32; 3]],
    pub(in crate::model) uvs: &'a [[f32; 2]],
    pub(in crate::model) colors: &'a [[f32; 3]],
}

/// A mesh in which corners that name the same are one vertex. It has normals, texture coordinates and colours if any corner
/// has one; a corner without has then a normal of no length (the triangle's own is taken if all three are such), the
/// coordinates 0 0, and white.
///
/// # Errors
/// No triangles, or tables with numbers that are none.
pub(in crate::model) fn weld(
    tables: &Tables<'_>,
    triangles: &[[Corner; 3]],
) -> Result<TriangleMesh, InvalidPart> {
    let any = |row: fn(&Corner) -> u32| triangles.iter().flatten().any(|corner| row(corner) != NONE);
    let mut normals = any(|corner| corner.normal).then(Vec::new);
    let mut uvs = any(|corner| corner.uv).then(Vec::new);
    let mut colors = any(|corner| corner.color).then(Vec::new);
    let mut positions = Vec::new();
    let mut vertices: HashMap<Corner, u32, foldhash::fast::RandomState> = HashMap::default();
    let mut vertex = |corner: &Corner| {
        *vertices.entry(*corner).or_insert_with(|| {
            positions.push(tables.positions.from(tables.origin, corner.position));
            if let Some(normals) = &mut normals {
                normals.push(row(tables.normals, corner.normal, [0.0; 3]));
            }
            if let Some(uvs) = &mut uvs {
                uvs.push(row(tables.uvs, corner.uv, [0.0; 2]));
            }
            if let Some(colors) = &mut colors {
                colors.push(row(tables.colors, corner.color, [1.0; 3]));
            }
            positions.len() as u32 - 1
        })
    };
    let triangles = triangles.iter().map(|triangle| triangle.each_ref().map(&mut vertex)).collect();
    let mesh = TriangleMesh::new(positions, triangles, normals, uvs)?.with_offset(tables.origin);
    match colors {
        Some(colors) => mesh.with_colors(colors),
        None => Ok(mesh),
    }
}

fn row<T: Copy>(table: &[T], index: u32, none: T) -> T {
    table.get(index as usize).copied().unwrap_or(none)
}
