//! What does an STL file hold that is text? Solids of facets, told by the words for corners and ends of loops alone.

use catoptra_core::TriangleMesh;
use catoptra_core::glam::DVec3;

use super::Merged;
use crate::model::error::{Fault, Place};
use crate::model::mesh::{Corner, Cutter, NONE, Positions, Tables, is_place, weld};
use crate::model::names::name_of;
use crate::model::text::{Lines, number, split_word, words};
use crate::model::warnings::Warnings;

/// Words that only lead from one to the next.
const SILENT: &[&[u8]] = &[b"facet", b"normal", b"outer", b"loop", b"endfacet"];

/// A solid: its name, and its triangles over the corners of all.
type Solid = (String, Vec<[u32; 3]>);

struct Reader {
    corners: Merged<f64>,
    solids: Vec<Solid>,
    /// Corners of the facet that is being read.
    outline: Vec<u32>,
    cutter: Cutter,
    pieces: Vec<[u32; 3]>,
}

pub(super) fn read(bytes: &[u8], warnings: &Warnings) -> Result<Vec<(String, TriangleMesh)>, Fault> {
    let mut reader = Reader {
        corners: Merged::with_room(bytes.len() / 500),
        solids: Vec::new(),
        outline: Vec::new(),
        cutter: Cutter::default(),
        pieces: Vec::new(),
    };
    let mut lines = Lines::new(bytes);
    let mut last = 0;
    while let Some((line, statement)) = lines.next() {
        reader.read_line(statement, Place::Line(line), warnings)?;
        last = line;
    }
    if !reader.outline.is_empty() {
        return Err(Fault::new(Place::Line(last), "the file ends in the middle of a facet"));
    }
    reader.into_solids()
}

impl Reader {
    fn read_line(&mut self, statement: &[u8], place: Place, warnings: &Warnings) -> Result<(), Fault> {
        let (word, rest) = split_word(statement);
        if word.eq_ignore_ascii_case(b"solid") {
            self.solids.push((name_of(rest), Vec::new()));
            return Ok(());
        }
        let mut words = words(statement);
        while let Some(word) = words.next() {
            let is = |other: &[u8]| word.eq_ignore_ascii_case(other);
            if is(b"endsolid") {
                break;
            } else if is(b"vertex") {
                self.add_corner([words.next(), words.next(), words.next()], place)?;
            } else if is(b"endloop") {
                self.end_facet(place, warnings);
            } else if !SILENT.iter().any(|silent| is(silent)) && number(word).is_err() {
                let word = name_of(word);
                warnings.add(place, format!("\"{word}\" is no word of an STL file: passed over"));
            }
        }
        Ok(())
    }

    fn add_corner(&mut self, given: [Option<&[u8]>; 3], place: Place) -> Result<(), Fault> {
        let mut corner = [0.0; 3];
        for (slot, word) in corner.iter_mut().zip(given) {
            let word = word.ok_or_else(|| Fault::new(place, "a vertex needs three numbers"))?;
            *slot = number(word).map_err(|message| Fault::new(place, message))?;
        }
        if !is_place(corner.into()) {
            return Err(Fault::new(place, "coordinates must be finite numbers"));
        }
        self.outline.push(self.corners.row(corner));
        Ok(())
    }

    fn end_facet(&mut self, place: Place, warnings: &Warnings) {
        if self.outline.len() < 3 {
            warnings.add(place, "facets of fewer than three corners are left out");
        } else {
            let outline: Vec<DVec3> =
                self.outline.iter().map(|&corner| self.corners.list[corner as usize].into()).collect();
            self.pieces.clear();
            self.cutter.cut(&outline, &mut self.pieces);
            if self.solids.is_empty() {
                self.solids.push(Solid::default());
            }
            if let Some((_, triangles)) = self.solids.last_mut() {
                triangles.extend(self.pieces.iter().map(|piece| piece.map(|i| self.outline[i as usize])));
            }
        }
        self.outline.clear();
    }

    fn into_solids(self) -> Result<Vec<(String, TriangleMesh)>, Fault> {
        let positions = Positions::Wide(self.corners.list);
        let origin = positions.origin(0..positions.len() as u32);
        let tables = Tables { positions: &positions, origin, normals: &[], uvs: &[], colors: &[] };
        let plain = |position| Corner { position, normal: NONE, uv: NONE, color: NONE };
        let mut meshes = Vec::new();
        for (name, triangles) in self.solids.into_iter().filter(|(_, triangles)| !triangles.is_empty()) {
            let triangles: Vec<[Corner; 3]> = triangles.iter().map(|triangle| triangle.map(plain)).collect();
            meshes.push((name, weld(&tables, &triangles).map_err(|e| Fault::new(Place::File, e))?));
        }
        if meshes.is_empty() { Err(Fault::new(Place::File, "holds no facets")) } else { Ok(meshes) }
    }
}
