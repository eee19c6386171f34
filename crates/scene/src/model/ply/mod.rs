//! What a PLY file holds (G. Turk, The PLY polygon file format, 1994).
//!
//! Why not a library: serde-ply 0.2 is fast, but its errors name no line,
//! byte or value, its ascii reader takes numbers one by one so that a row with one too many silently shifts all
//! that follow, and an element of 10¹⁸ rows without properties keeps it busy for ever.

mod body;
mod header;

use super::error::{Fault, Place};
use super::{Polygons, finite};
use body::{Ascii, Binary, Body};
use header::{Element, Encoding, Header, Property};

pub(super) fn read(bytes: &[u8]) -> Result<Polygons, Fault> {
    let header = header::read(bytes)?;
    let body = &bytes[header.body..];
    match header.encoding {
        Encoding::Ascii => read_body(&header, Ascii::new(body, header.lines)),
        Encoding::Little => read_body(&header, Binary::<false>::new(body, header.body)),
        Encoding::Big => read_body(&header, Binary::<true>::new(body, header.body)),
    }
}

fn read_body<B: Body>(header: &Header, mut body: B) -> Result<Polygons, Fault> {
    let mut found = Polygons::default();
    for element in &header.elements {
        body.expect_room_for(element)?;
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut body, &mut found)?,
            "face" => read_faces(element, &mut body, &mut found)?,
            _ => skip(element, &mut body)?,
        }
    }
    if found.triangles.is_empty() {
        return Err(Fault::new(Place::File, "holds no faces"));
    }
    Ok(found)
}

/// Names of the vertex properties in use; a texture coordinate has several spellings.
const COLUMNS: [&[&str]; 8] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["u", "s", "texture_u", "texture_s"],
    &["v", "t", "texture_v", "texture_t"],
];

fn read_vertices<B: Body>(element: &Element, body: &mut B, found: &mut Polygons) -> Result<(), Fault> {
    let column =
        |property: &Property| COLUMNS.iter().position(|names| names.contains(&property.name.as_str()));
    let columns: Vec<Option<usize>> = element.properties.iter().map(column).collect();
    let has = |wanted: std::ops::Range<usize>| wanted.clone().all(|c| columns.contains(&Some(c)));
    if !has(0..3) {
        let place = Place::Line(element.line);
        return Err(Fault::new(place, "the vertices lack a property x, y or z"));
    }
    let (has_normals, has_uvs) = (has(3..6), has(6..8));
    let mut normals = Vec::new();
    let mut uvs = Vec::new();
    found.positions.reserve_exact(element.count);
    for _ in 0..element.count {
        let place = body.begin_row()?;
        let mut row = [0.0; COLUMNS.len()];
        for (property, column) in element.properties.iter().zip(&columns) {
            let value = read_property(body, property, |_| ())?;
            if let (Some(column), Some(value)) = (column, value) {
                row[*column] = value;
            }
        }
        body.end_row()?;
        let [x, y, z, nx, ny, nz, u, v] = row;
        found.positions.push(finite([x, y, z], place, "coordinates")?);
        if has_normals {
            normals.push(finite([nx, ny, nz], place, "normals")?);
        }
        if has_uvs {
            uvs.push(finite([u, v], place, "texture coordinates")?);
        }
    }
    found.normals = has_normals.then_some(normals);
    found.uvs = has_uvs.then_some(uvs);
    Ok(())
}

fn read_faces<B: Body>(element: &Element, body: &mut B, found: &mut Polygons) -> Result<(), Fault> {
    let named = |p: &Property| matches!(p.name.as_str(), "vertex_indices" | "vertex_index");
    let Some(corners) = element.properties.iter().position(|p| p.list.is_some() && named(p)) else {
        return Err(Fault::new(Place::Line(element.line), "the faces lack a list property vertex_indices"));
    };
    let vertices = found.positions.len();
    found.triangles.reserve(element.count);
    let mut polygon: Vec<f64> = Vec::new();
    for _ in 0..element.count {
        let place = body.begin_row()?;
        polygon.clear();
        for (i, property) in element.properties.iter().enumerate() {
            let keep = i == corners;
            read_property(body, property, |item| {
                if keep {
                    polygon.push(item);
                }
            })?;
        }
        body.end_row()?;
        fan(&polygon, vertices, place, &mut found.triangles)?;
    }
    Ok(())
}

fn fan(polygon: &[f64], vertices: usize, place: Place, out: &mut Vec<[u32; 3]>) -> Result<(), Fault> {
    if polygon.len() < 3 {
        return Err(Fault::new(place, format!("a face has {} corners, and needs at least 3", polygon.len())));
    }
    if let Some(bad) = polygon.iter().find(|&&v| !(v >= 0.0 && v < vertices as f64 && v.fract() == 0.0)) {
        return Err(Fault::new(
            place,
            format!("a face refers to vertex {bad}, but there are {vertices} (from 0)"),
        ));
    }
    let index = |i: usize| polygon[i] as u32;
    out.extend((1..polygon.len() - 1).map(|i| [index(0), index(i), index(i + 1)]));
    Ok(())
}

fn skip<B: Body>(element: &Element, body: &mut B) -> Result<(), Fault> {
    for _ in 0..element.count {
        body.begin_row()?;
        for property in &element.properties {
            read_property(body, property, |_| ())?;
        }
        body.end_row()?;
    }
    Ok(())
}

/// Reads one property of a row: its value, or, item by item, its list.
fn read_property<B: Body>(
    body: &mut B,
    property: &Property,
    mut item: impl FnMut(f64),
) -> Result<Option<f64>, Fault> {
    let Some(count) = property.list else {
        return body.scalar(property.sort).map(Some);
    };
    let items = body.scalar(count)?;
    if !(items >= 0.0 && items.fract() == 0.0) {
        return Err(Fault::new(body.place(), format!("a list cannot have {items} items")));
    }
    let items = items as usize;
    if items > body.room_for(property.sort) {
        let message = format!("a list announces {items} items, more than the rest of the file can hold");
        return Err(Fault::new(body.place(), message));
    }
    for _ in 0..items {
        item(body.scalar(property.sort)?);
    }
    Ok(None)
}
