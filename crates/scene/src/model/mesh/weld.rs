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
    let mut vertices = Vertices {
        tables,
        positions: Vec::new(),
        normals: any(|corner| corner.normal).then(Vec::new),
        uvs: any(|corner| corner.uv).then(Vec::new),
        colors: any(|corner| corner.color).then(Vec::new),
    };
    let has_own_color = |corner: &Corner| corner.color != NONE && corner.color != corner.position;
    let is_plain = vertices.normals.is_none()
        && vertices.uvs.is_none()
        && !triangles.iter().flatten().any(has_own_color);
    let places = tables.positions.len();
    let triangles = if is_plain && places <= WORTH_A_TABLE * triangles.len() {
        // Corners differ by their positions alone, so that a table does it.
        let mut numbers = vec![NONE; places];
        let mut number = |corner: &Corner| {
            let number = &mut numbers[corner.position as usize];
            if *number == NONE {
                *number = vertices.add(corner);
            }
            *number
        };
        triangles.iter().map(|triangle| triangle.each_ref().map(&mut number)).collect()
    } else {
        let mut numbers: HashMap<Corner, u32, foldhash::fast::RandomState> =
            HashMap::with_capacity_and_hasher(triangles.len() / 2, Default::default());
        let mut number = |corner: &Corner| *numbers.entry(*corner).or_insert_with(|| vertices.add(corner));
        triangles.iter().map(|triangle| triangle.each_ref().map(&mut number)).collect()
    };
    vertices.into_mesh(triangles)
}

/// A table of all positions of a file is made for a part of it that has so few times fewer triangles.
const WORTH_A_TABLE: usize = 16;

/// Vertices of a mesh, and what those of them have that have anything.
struct Vertices<'a> {
    tables: &'a Tables<'a>,
    positions: Vec<[f32; 3]>,
    normals: Option<Vec<[f32; 3]>>,
    uvs: Option<Vec<[f32; 2]>>,
    colors: Option<Vec<[f32; 3]>>,
}

impl Vertices<'_> {
    /// Adds what a corner names, and gives its number.
    fn add(&mut self, corner: &Corner) -> u32 {
        let tables = self.tables;
        self.positions.push(tables.positions.from(tables.origin, corner.position));
        if let Some(normals) = &mut self.normals {
            normals.push(row(tables.normals, corner.normal, [0.0; 3]));
        }
        if let Some(uvs) = &mut self.uvs {
            uvs.push(row(tables.uvs, corner.uv, [0.0; 2]));
        }
        if let Some(colors) = &mut self.colors {
            colors.push(row(tables.colors, corner.color, [1.0; 3]));
        }
        self.positions.len() as u32 - 1
    }

    fn into_mesh(self, triangles: Vec<[u32; 3]>) -> Result<TriangleMesh, InvalidPart> {
        let mesh = TriangleMesh::new(self.positions, triangles, self.normals, self.uvs)?;
        let mesh = mesh.with_offset(self.tables.origin);
        match self.colors {
            Some(colors) => mesh.with_colors(colors),
            None => Ok(mesh),
        }
    }
}

fn row<T: Copy>(table: &[T], index: u32, none: T) -> T {
    table.get(index as usize).copied().unwrap_or(none)
}
