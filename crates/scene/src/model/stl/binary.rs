//! What does a binary STL file hold?

use std::collections::HashMap;

use catoptra_core::TriangleMesh;
use catoptra_core::glam::DVec3;

use super::Merged;
use crate::model::colors::linear;
use crate::model::error::{Fault, Place};
use crate::model::mesh::{Corner, NONE, Positions, Tables, Vertices, is_place, weld};
use crate::model::warnings::Warnings;

/// Bytes before the count of facets, and before the first facet.
const HEADER: usize = 80;
const START: usize = 84;

/// Bytes of a facet: a normal, three corners, and two of whatever a program wants to say.
const FACET: usize = 50;

/// How many facets a file announces.
pub(super) fn count(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER..START)?;
    count.first_chunk().map(|&bytes| u32::from_le_bytes(bytes))
}

/// How many bytes a file of so many facets has.
pub(super) fn length(count: u32) -> u64 {
    START as u64 + FACET as u64 * u64::from(count)
}

pub(super) fn read(bytes: &[u8], warnings: &Warnings) -> Result<TriangleMesh, Fault> {
    let Some(announced) = count(bytes) else {
        let message = format!("is no STL file: a binary one has at least {START} bytes");
        return Err(Fault::new(Place::File, message));
    };
    let facets = bytes[START..].as_chunks::<FACET>().0;
    let count = match announced {
        0 if !facets.is_empty() => {
            warnings.add(Place::Byte(HEADER), "the header announces no facets: all that follow are read");
            facets.len()
        }
        announced => announced as usize,
    };
    let Some(facets) = facets.get(..count) else {
        let most = facets.len();
        let message = format!("the header announces {count} facets, the file has room for at most {most}");
        return Err(Fault::new(Place::Byte(HEADER), message));
    };
    if facets.is_empty() {
        return Err(Fault::new(Place::File, "holds no facets"));
    }
    if START + FACET * count < bytes.len() {
        let place = Place::Byte(START + FACET * count);
        warnings.add(place, "what follows the last facet is passed over");
    }
    mesh_of(facets, &bytes[..HEADER])
}

fn mesh_of(facets: &[[u8; FACET]], header: &[u8]) -> Result<TriangleMesh, Fault> {
    let mut corners = Merged::with_room(facets.len() / 2 + 3);
    let mut triangles = Vec::with_capacity(facets.len());
    for (number, facet) in facets.iter().enumerate() {
        let mut triangle = [0; 3];
        for (slot, bytes) in triangle.iter_mut().zip(facet[12..48].as_chunks::<12>().0) {
            let [x, y, z] = [0, 4, 8]
                .map(|at| f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]));
            if !is_place(DVec3::new(x.into(), y.into(), z.into())) {
                let place = Place::Byte(START + FACET * number);
                return Err(Fault::new(place, "coordinates must be finite numbers"));
            }
            *slot = corners.row([x, y, z]);
        }
        triangles.push(triangle);
    }
    let positions = Positions::Narrow(corners.list);
    let colors = Colors::of(facets, header);
    let mesh = if colors.table.is_empty() {
        Vertices { positions, normals: None, uvs: None, colors: None }.mesh(triangles)
    } else {
        let tables = Tables {
            positions: &positions,
            origin: DVec3::ZERO,
            normals: &[],
            uvs: &[],
            colors: &colors.table,
        };
        let painted: Vec<[Corner; 3]> = triangles
            .iter()
            .zip(colors.rows)
            .map(|(triangle, color)| {
                triangle.map(|position| Corner { position, normal: NONE, uv: NONE, color })
            })
            .collect();
        weld(&tables, &painted)
    };
    mesh.map_err(|e| Fault::new(Place::File, e))
}

/// Colours of facets: a table, and the row of each facet. No table where facets have none.
#[derive(Default)]
struct Colors {
    table: Vec<[f32; 3]>,
    rows: Vec<u32>,
}

impl Colors {
    /// As Magics writes them, whose header names the colour of all that have none of their own (then bit 15 is set); or as
    /// VisCAM and SolidView do, where bit 15 says that there is one. Five bits a channel, in opposite orders.
    fn of(facets: &[[u8; FACET]], header: &[u8]) -> Self {
        let magics = header.windows(10).find_map(|window| window.strip_prefix(b"COLOR="));
        let said = |facet: &[u8; FACET]| u16::from_le_bytes([facet[48], facet[49]]);
        let has_own = |said: u16| (said >> 15 == 0) == magics.is_some();
        if magics.is_none() && !facets.iter().any(|facet| has_own(said(facet))) {
            return Self::default();
        }
        let default = magics.map_or([1.0; 3], |rgba| [0, 1, 2].map(|k| f32::from(rgba[k]) / 255.0));
        let (mut colors, mut known) = (Self::default(), HashMap::new());
        for facet in facets {
            let said = said(facet);
            let key = has_own(said).then_some(said);
            let next = known.len() as u32;
            let row = *known.entry(key).or_insert(next);
            if row == next {
                let [low, middle, high] = [said, said >> 5, said >> 10].map(|v| f32::from(v & 31) / 31.0);
                let own = if magics.is_some() { [low, middle, high] } else { [high, middle, low] };
                colors.table.push(if key.is_some() { own } else { default });
            }
            colors.rows.push(row);
        }
        colors.table = linear(colors.table);
        colors
    }
}
