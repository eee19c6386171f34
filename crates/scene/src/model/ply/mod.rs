//! What a PLY file holds (G. Turk, The PLY polygon file format, 1994), and what MeshLab and others write into it.
//!
//! Why not a library: serde-ply 0.2 is fast, but its errors name no line,
//! byte or value, its ascii reader takes numbers one by one so that a row with one too many silently shifts all
//! that follow, and an element of 10¹⁸ rows without properties keeps it busy for ever.

mod body;
mod faces;
mod header;
mod parts;
mod vertices;

use super::error::{Fault, Place};
use super::warnings::Warnings;
use super::{Folder, Model};
use body::{Ascii, Binary, Body};
use faces::Faces;
use header::{Encoding, Header};
use vertices::Found;

pub(super) fn read(bytes: &[u8], folder: &Folder) -> Result<Model, Fault> {
    let warnings = Warnings::default();
    let header = header::read(bytes, &warnings)?;
    let body = &bytes[header.body..];
    let (found, faces) = match header.encoding {
        Encoding::Ascii => read_ascii(&header, body, &warnings)?,
        Encoding::Little => read_body(&header, &mut Binary::<false>::new(body, header.body), &warnings)?,
        Encoding::Big => read_body(&header, &mut Binary::<true>::new(body, header.body), &warnings)?,
    };
    parts::model_of(&header, found, faces, folder, warnings)
}

/// Rows stand on lines of their own, and where that cannot be, numbers follow each other as they come, to the last.
fn read_ascii(header: &Header, bytes: &[u8], warnings: &Warnings) -> Result<(Found, Faces), Fault> {
    let found = Warnings::default();
    let mut rows = Ascii::new(bytes, header.lines, true);
    let refused = match read_body(header, &mut rows, &found) {
        Ok(read) => {
            if let Some(line) = rows.left_over() {
                let message = "numbers that the header does not announce are passed over at the ends of rows";
                found.add(Place::Line(line), message);
            }
            warnings.append(found);
            return Ok(read);
        }
        Err(refused) => refused,
    };
    let mut stream = Ascii::new(bytes, header.lines, false);
    match read_body(header, &mut stream, warnings) {
        Ok(read) if stream.is_at_end() => Ok(read),
        _ => Err(refused),
    }
}

fn read_body<B: Body>(header: &Header, body: &mut B, warnings: &Warnings) -> Result<(Found, Faces), Fault> {
    let count = header.elements.iter().find(|e| e.name == "vertex").map_or(0, |e| e.count);
    let (mut found, mut faces) = (None, Faces::default());
    for element in &header.elements {
        if element.properties.is_empty() {
            continue;
        }
        body.expect_room_for(element)?;
        match element.name.as_str() {
            "vertex" => found = Some(vertices::read(element, body)?),
            "face" => faces.read(element, body, found.as_ref(), count, warnings)?,
            "tristrips" => faces.read_strips(element, body, found.as_ref(), count)?,
            _ => {
                for _ in 0..element.count {
                    body.begin_row()?;
                    element.properties.iter().try_for_each(|property| body.pass(property))?;
                }
            }
        }
    }
    let found =
        found.ok_or_else(|| Fault::new(Place::Line(header.lines), "the vertices have no properties"))?;
    Ok((found, faces))
}
