//! Which vertices does a PLY file have?

use std::ops::Range;

use super::body::Body;
use super::header::{Element, Property, Sort};
use crate::model::colors::linear;
use crate::model::error::{Fault, Place};
use crate::model::mesh::{Positions, Vertices, is_place};

/// Names of the properties in use; some have several spellings.
const COLUMNS: [&[&str]; 11] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx", "normal_x"],
    &["ny", "normal_y"],
    &["nz", "normal_z"],
    &["u", "s", "texture_u", "texture_s", "tex_u", "texcoord_u", "u0", "s0", "u1"],
    &["v", "t", "texture_v", "texture_t", "tex_v", "texcoord_v", "v0", "t0", "v1"],
    RED,
    GREEN,
    BLUE,
];

pub(super) const RED: &[&str] = &["red", "r", "diffuse_red"];
pub(super) const GREEN: &[&str] = &["green", "g", "diffuse_green"];
pub(super) const BLUE: &[&str] = &["blue", "b", "diffuse_blue"];

const PLACE: Range<usize> = 0..3;
const NORMAL: Range<usize> = 3..6;
const UV: Range<usize> = 6..8;
const COLOR: Range<usize> = 8..11;

/// Vertices, and which of them are nowhere.
pub(super) struct Found {
    pub(super) vertices: Vertices,
    /// Those whose coordinates are no place, in order, and where they stand in the file.
    nowhere: Vec<(u32, Place)>,
}

impl Found {
    /// Refuses corners that are nowhere.
    pub(super) fn check(&self, corners: &[u32]) -> Result<(), Fault> {
        if self.nowhere.is_empty() {
            return Ok(());
        }
        let place = |corner| self.nowhere.binary_search_by_key(corner, |(vertex, _)| *vertex).ok();
        match corners.iter().find_map(place) {
            Some(row) => Err(Fault::new(
                self.nowhere[row].1,
                "coordinates must be finite numbers where a face uses them",
            )),
            None => Ok(()),
        }
    }
}

pub(super) fn read<B: Body>(element: &Element, body: &mut B) -> Result<Found, Fault> {
    let columns = columns_of(element)?;
    let has = |wanted: Range<usize>| wanted.clone().all(|column| columns.contains(&Some(column)));
    let sorts = || element.properties.iter().zip(&columns);
    let is_narrow = sorts()
        .filter(|(_, column)| column.is_some_and(|column| PLACE.contains(&column)))
        .all(|(property, _)| property.sort.is_narrow());
    let red = sorts().find(|(_, column)| **column == Some(COLOR.start)).map(|(property, _)| property.sort);
    let color_unit = red.map_or(1.0, unit_of);
    let (mut narrow, mut wide) = (Vec::new(), Vec::new());
    if is_narrow {
        narrow.reserve_exact(element.count);
    } else {
        wide.reserve_exact(element.count);
    }
    let (mut normals, mut uvs, mut colors) = (Vec::new(), Vec::new(), Vec::new());
    let [has_normals, has_uvs, has_colors] = [NORMAL, UV, COLOR].map(has);
    let mut nowhere = Vec::new();
    let mut row = [0.0; COLUMNS.len()];
    for number in 0..element.count {
        let place = body.row(element, &columns, &mut row)?;
        let [x, y, z, nx, ny, nz, u, v, r, g, b] = row;
        if !is_place([x, y, z].into()) {
            nowhere.push((number as u32, place));
        }
        if is_narrow {
            narrow.push([x, y, z].map(|v| v as f32));
        } else {
            wide.push([x, y, z]);
        }
        if has_normals {
            normals.push(finite([nx, ny, nz]));
        }
        if has_uvs {
            uvs.push(finite([u, v]));
        }
        if has_colors {
            colors.push([r, g, b].map(|v| (v / color_unit) as f32));
        }
    }
    let vertices = Vertices {
        positions: if is_narrow { Positions::Narrow(narrow) } else { Positions::Wide(wide) },
        normals: has_normals.then_some(normals),
        uvs: has_uvs.then_some(uvs),
        colors: has_colors.then(|| linear(colors)),
    };
    Ok(Found { vertices, nowhere })
}

/// What stands for all of a colour's channel.
pub(super) fn unit_of(sort: Sort) -> f64 {
    match sort {
        Sort::U8 => 255.0,
        Sort::U16 => 65_535.0,
        _ => 1.0,
    }
}

/// Which column each property goes to. Of several of one meaning the first counts.
fn columns_of(element: &Element) -> Result<Vec<Option<usize>>, Fault> {
    let mut columns: Vec<Option<usize>> = Vec::with_capacity(element.properties.len());
    for property in &element.properties {
        let found = column_of(property);
        let is_taken = found.is_some() && columns.contains(&found);
        if is_taken && found.is_some_and(|column| PLACE.contains(&column)) {
            let message = format!("property {} is announced twice", property.name);
            return Err(Fault::new(Place::Line(property.line), message));
        }
        columns.push(found.filter(|_| !is_taken));
    }
    if PLACE.clone().all(|column| columns.contains(&Some(column))) {
        Ok(columns)
    } else {
        Err(Fault::new(Place::Line(element.line), "the vertices lack a property x, y or z"))
    }
}

fn column_of(property: &Property) -> Option<usize> {
    let name = property.name.as_str();
    COLUMNS.iter().position(|names| names.contains(&name)).filter(|_| property.list.is_none())
}

/// As `f32`; none at all where one is not finite.
fn finite<const N: usize>(values: [f64; N]) -> [f32; N] {
    let narrow = values.map(|v| v as f32);
    if narrow.iter().all(|v| v.is_finite()) { narrow } else { [0.0; N] }
}
