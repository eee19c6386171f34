//! What a Wavefront OBJ file holds: `v`, `vt`, `vn` and `f` lines; groups, materials, lines and points are passed over.
//!
//! Why not a library: tobj 4 names neither line nor value in its errors, finds an index out of range only after the
//! last line, and lets coordinates that are not finite through.

use std::collections::HashMap;

use super::error::{Fault, Place};
use super::{Polygons, finite};

/// Keywords that say nothing about triangles.
const PASSED_OVER: &[&str] = &[
    "o",
    "g",
    "s",
    "l",
    "p",
    "vp",
    "usemtl",
    "mtllib",
    "mg",
    "usemap",
    "maplib",
    "shadow_obj",
    "trace_obj",
    "lod",
    "bevel",
    "c_interp",
    "d_interp",
];

/// Stands for "none" in a corner.
const NONE: u32 = u32::MAX;

/// Indices of a corner's position, texture coordinate and normal.
type Corner = [u32; 3];

#[derive(Default)]
struct Tables {
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    corners: Vec<[Corner; 3]>,
}

pub(super) fn read(bytes: &[u8]) -> Result<Polygons, Fault> {
    let mut tables = Tables::default();
    for (i, raw) in bytes.split(|&b| b == b'\n').enumerate() {
        let place = Place::Line(i + 1);
        let line = match std::str::from_utf8(raw) {
            Ok(line) => line.split('#').next().unwrap_or_default(),
            Err(_) if raw.trim_ascii_start().starts_with(b"#") => continue,
            Err(_) => return Err(Fault::new(place, "the line is not UTF-8 text")),
        };
        tables.read_line(line, place)?;
    }
    if tables.corners.is_empty() {
        let message = if bytes.is_empty() { "the file is empty" } else { "holds no faces" };
        return Err(Fault::new(Place::File, message));
    }
    Ok(tables.into_polygons())
}

impl Tables {
    fn read_line(&mut self, line: &str, place: Place) -> Result<(), Fault> {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            None => {}
            // After the position some programs write a weight or a colour.
            Some("v") => self.positions.push(finite(numbers(words, place, 7)?, place, "coordinates")?),
            Some("vn") => self.normals.push(finite(numbers(words, place, 3)?, place, "normals")?),
            Some("vt") => self.uvs.push(finite(numbers(words, place, 3)?, place, "texture coordinates")?),
            Some("f") => self.read_face(words, place)?,
            Some(word) if PASSED_OVER.contains(&word) => {}
            Some(word) => {
                return Err(Fault::new(
                    place,
                    format!("\"{word}\" is no keyword of an OBJ file of triangles"),
                ));
            }
        }
        Ok(())
    }

    fn read_face<'a>(&mut self, words: impl Iterator<Item = &'a str>, place: Place) -> Result<(), Fault> {
        let corners = words.map(|word| self.corner(word, place)).collect::<Result<Vec<_>, _>>()?;
        if corners.len() < 3 {
            return Err(Fault::new(
                place,
                format!("a face has {} corners, and needs at least 3", corners.len()),
            ));
        }
        self.corners.extend((1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]]));
        Ok(())
    }

    /// Reads `position`, `position/uv`, `position//normal` or `position/uv/normal`.
    fn corner(&self, word: &str, place: Place) -> Result<Corner, Fault> {
        let mut parts = word.split('/');
        let tables = [
            ("vertex", self.positions.len()),
            ("texture coordinate", self.uvs.len()),
            ("normal", self.normals.len()),
        ];
        let mut corner = [NONE; 3];
        for ((what, count), slot) in tables.into_iter().zip(&mut corner) {
            match parts.next() {
                None => break,
                Some("") if what != "vertex" => {}
                Some(text) => *slot = index(text, what, count, place)?,
            }
        }
        match parts.next() {
            None => Ok(corner),
            Some(_) => Err(Fault::new(place, format!("the corner \"{word}\" has more than three parts"))),
        }
    }

    /// Gives every different corner one vertex; normals and texture coordinates stay where every corner has them.
    fn into_polygons(self) -> Polygons {
        let all = |part: usize| self.corners.iter().flatten().all(|corner| corner[part] != NONE);
        let (has_uvs, has_normals) = (all(1), all(2));
        if !has_uvs && !has_normals {
            let triangles = self.corners.iter().map(|t| t.map(|corner| corner[0])).collect();
            return Polygons { positions: self.positions, triangles, normals: None, uvs: None };
        }
        let mut out = Polygons {
            normals: has_normals.then(Vec::new),
            uvs: has_uvs.then(Vec::new),
            ..Polygons::default()
        };
        let mut vertices: HashMap<Corner, u32> = HashMap::new();
        for triangle in &self.corners {
            let triangle = triangle.map(|[position, uv, normal]| {
                let key =
                    [position, if has_uvs { uv } else { NONE }, if has_normals { normal } else { NONE }];
                *vertices.entry(key).or_insert_with(|| {
                    out.positions.push(self.positions[position as usize]);
                    if let Some(uvs) = &mut out.uvs {
                        uvs.push(self.uvs[uv as usize]);
                    }
                    if let Some(normals) = &mut out.normals {
                        normals.push(self.normals[normal as usize]);
                    }
                    out.positions.len() as u32 - 1
                })
            });
            out.triangles.push(triangle);
        }
        out
    }
}

/// The first `N` of between `N` and `most` numbers; `vt` may leave its second out.
fn numbers<'a, const N: usize>(
    words: impl Iterator<Item = &'a str>,
    place: Place,
    most: usize,
) -> Result<[f64; N], Fault> {
    let mut out = [0.0; N];
    let mut count = 0;
    for word in words {
        let Ok(value) = word.parse::<f64>() else {
            return Err(Fault::new(place, format!("\"{word}\" is no number")));
        };
        if let Some(slot) = out.get_mut(count) {
            *slot = value;
        }
        count += 1;
    }
    let least = if N == 2 { 1 } else { N };
    if (least..=most).contains(&count) {
        Ok(out)
    } else {
        Err(Fault::new(place, format!("the line has {count} numbers where {least} are needed")))
    }
}

/// Turns an index of the file (from 1, or negative from the end) into one from 0.
fn index(text: &str, what: &str, count: usize, place: Place) -> Result<u32, Fault> {
    let Ok(given) = text.parse::<i64>() else {
        return Err(Fault::new(place, format!("\"{text}\" is no index of a {what}")));
    };
    let from_zero = if given < 0 { given.saturating_add(count as i64) } else { given - 1 };
    match u32::try_from(from_zero) {
        Ok(index) if (index as usize) < count && index != NONE => Ok(index),
        _ => Err(Fault::new(
            place,
            format!("a face refers to {what} {given}, but only {count} stand above it"),
        )),
    }
}
