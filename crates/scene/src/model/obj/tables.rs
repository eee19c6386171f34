//! What do the statements of an OBJ file say? Tables of corners, and faces over them, before indices are looked up.

use std::collections::HashMap;

use crate::model::error::{Fault, Place};
use crate::model::mesh::NONE;
use crate::model::names::name_of;
use crate::model::text::{Lines, number, split_word, words};
use crate::model::warnings::Warnings;

/// A corner of a face: rows of positions, texture coordinates and normals, from 0, or [`NONE`].
pub(super) type Corner = [u32; 3];

/// A face: its corners are those from where the one before ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face {
    pub(super) end: usize,
    pub(super) line: usize,
}

/// What holds for the faces that follow, each a row of its table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct State {
    pub(super) object: u32,
    pub(super) group: u32,
    pub(super) material: u32,
    /// 0 for none.
    pub(super) smoothing: u32,
}

/// Faces of one state: those from where the run before ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    pub(super) end: usize,
    pub(super) state: State,
}

/// Names in the order in which they came; the first is that of what has none.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) names: Vec<Vec<u8>>,
    rows: HashMap<Vec<u8>, u32>,
}

impl Default for Table {
    fn default() -> Self {
        Self { names: vec![Vec::new()], rows: HashMap::from([(Vec::new(), 0)]) }
    }
}

impl Table {
    fn row(&mut self, name: &[u8]) -> u32 {
        if let Some(&row) = self.rows.get(name) {
            return row;
        }
        let row = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.rows.insert(name.to_owned(), row);
        row
    }
}

/// All that a file says.
#[derive(Debug, Default)]
pub(super) struct Tables {
    pub(super) positions: Vec<[f64; 3]>,
    /// As many as positions, or none; NaN where a corner has none.
    pub(super) colors: Vec<[f32; 3]>,
    /// May be no numbers.
    pub(super) uvs: Vec<[f32; 2]>,
    /// May be no numbers.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<Face>,
    pub(super) runs: Vec<Run>,
    pub(super) objects: Table,
    pub(super) groups: Table,
    pub(super) materials: Table,
    smoothing: Table,
    /// Files of materials, and the lines that name them.
    pub(super) libraries: Vec<(usize, Vec<u8>)>,
    state: State,
    /// The first word that no OBJ file has.
    unknown: Option<(usize, String)>,
    has_curves: bool,
}

/// Statements that say nothing about how surfaces look.
const SILENT: &[&[u8]] = &[
    b"vp",
    b"mg",
    b"lod",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"shadow_obj",
    b"trace_obj",
    b"usemap",
    b"maplib",
    b"ctech",
    b"stech",
];

/// Statements of free-form curves and surfaces.
const CURVES: &[&[u8]] = &[
    b"cstype", b"deg", b"bmat", b"step", b"curv", b"curv2", b"surf", b"parm", b"trim", b"hole", b"scrv",
    b"sp", b"end", b"con", b"bsp", b"bzp", b"cdc", b"cdp", b"res",
];

impl Tables {
    /// Reads all statements of a file.
    ///
    /// # Errors
    /// A statement that cannot be meant, or no faces.
    pub(super) fn read(bytes: &[u8], warnings: &Warnings) -> Result<Self, Fault> {
        let mut tables = Self::default();
        let mut lines = Lines::new(bytes);
        while let Some((line, statement)) = lines.next() {
            tables.read_statement(statement, line, warnings)?;
        }
        tables.end_run();
        if !tables.colors.is_empty() {
            tables.colors.resize(tables.positions.len(), [f32::NAN; 3]);
        }
        if tables.faces.is_empty() {
            return Err(Fault::new(Place::File, tables.without_faces(bytes)));
        }
        Ok(tables)
    }

    fn without_faces(&self, bytes: &[u8]) -> String {
        if bytes.is_empty() {
            return "the file is empty".to_owned();
        }
        match &self.unknown {
            _ if self.has_curves => "holds no faces: free-form curves and surfaces are not drawn".to_owned(),
            Some((line, word)) => {
                format!("holds no faces: \"{word}\" in line {line} is no word of an OBJ file")
            }
            None => "holds no faces".to_owned(),
        }
    }

    fn read_statement(&mut self, statement: &[u8], line: usize, warnings: &Warnings) -> Result<(), Fault> {
        let place = Place::Line(line);
        let (word, rest) = split_word(statement);
        match word {
            b"v" => self.read_position(rest, place)?,
            b"vn" => self.normals.push(numbers(rest, 3, place)?.map(|v| v as f32)),
            b"vt" => {
                let [u, v, _] = numbers(rest, 1, place)?;
                self.uvs.push([u as f32, v as f32]);
            }
            b"f" | b"fo" => self.read_face(rest, line, warnings)?,
            b"o" => self.set(rest, |tables| (&mut tables.state.object, &mut tables.objects)),
            b"g" => self.set(rest, |tables| (&mut tables.state.group, &mut tables.groups)),
            b"usemtl" => self.set(rest, |tables| (&mut tables.state.material, &mut tables.materials)),
            b"s" => {
                let group = words(rest).next().unwrap_or_default();
                let is_off = group == b"off" || group.iter().all(|&digit| digit == b'0');
                let name = if is_off { &[] } else { group };
                self.set(name, |tables| (&mut tables.state.smoothing, &mut tables.smoothing));
            }
            b"mtllib" => self.libraries.push((line, rest.to_owned())),
            b"l" | b"p" => warnings.add(place, "lines and points are not drawn"),
            _ if SILENT.contains(&word) => {}
            _ if CURVES.contains(&word) => {
                self.has_curves = true;
                warnings.add(place, "free-form curves and surfaces are not drawn");
            }
            _ => {
                let word = name_of(word);
                warnings.add(place, format!("\"{word}\" is no word of an OBJ file: passed over"));
                self.unknown.get_or_insert((line, word));
            }
        }
        Ok(())
    }

    /// Sets what holds from the next face on.
    fn set(&mut self, name: &[u8], part: impl Fn(&mut Self) -> (&mut u32, &mut Table)) {
        self.end_run();
        let (row, table) = part(self);
        *row = table.row(name);
    }

    fn end_run(&mut self) {
        let start = self.runs.last().map_or(0, |run| run.end);
        if self.faces.len() > start {
            self.runs.push(Run { end: self.faces.len(), state: self.state });
        }
    }

    /// Reads `x y z`, behind which may stand a weight, a colour, or both.
    fn read_position(&mut self, rest: &[u8], place: Place) -> Result<(), Fault> {
        let mut row = [f64::NAN; 7];
        let count = fill(rest, &mut row, place)?;
        expect(count, 3, place)?;
        let [x, y, z, a, b, c, d] = row;
        let color = match count {
            // Some write a weight before a colour, others an opacity behind it.
            7 if a == 1.0 && d != 1.0 => Some([b, c, d]),
            6 | 7 => Some([a, b, c]),
            _ => None,
        };
        if let Some(color) = color {
            self.colors.resize(self.positions.len(), [f32::NAN; 3]);
            self.colors.push(color.map(|v| v as f32));
        }
        self.positions.push([x, y, z]);
        Ok(())
    }

    fn read_face(&mut self, rest: &[u8], line: usize, warnings: &Warnings) -> Result<(), Fault> {
        let start = self.corners.len();
        for word in words(rest) {
            let corner = self.corner(word, Place::Line(line))?;
            self.corners.push(corner);
        }
        if self.corners.len() - start < 3 {
            self.corners.truncate(start);
            warnings.add(Place::Line(line), "faces of fewer than three corners are left out");
            return Ok(());
        }
        self.faces.push(Face { end: self.corners.len(), line });
        Ok(())
    }

    /// Reads `position`, `position/uv`, `position//normal` or `position/uv/normal`. Rows that are named forwards may not be
    /// there yet.
    fn corner(&self, word: &[u8], place: Place) -> Result<Corner, Fault> {
        let mut parts = word.split(|&byte| byte == b'/');
        let mut corner = [NONE; 3];
        let tables = [
            ("vertex", self.positions.len()),
            ("texture coordinate", self.uvs.len()),
            ("normal", self.normals.len()),
        ];
        for (slot, (what, count)) in corner.iter_mut().zip(tables) {
            match parts.next() {
                Some(part) if what == "vertex" || !part.is_empty() => {
                    *slot = row(part, what, count, place)?;
                }
                _ => {}
            }
        }
        match parts.next() {
            None => Ok(corner),
            Some(_) => {
                let word = name_of(word);
                Err(Fault::new(place, format!("the corner \"{word}\" has more than three parts")))
            }
        }
    }
}

/// The row that an index names: from 1, or negative from the end of what is there. Of texture coordinates and normals what is
/// no row is none.
fn row(text: &[u8], what: &str, count: usize, place: Place) -> Result<u32, Fault> {
    // Most are a few digits.
    let digits = |sum: i64, digit: &u8| sum * 10 + i64::from(digit - b'0');
    let given = if text.len() < 18 && !text.is_empty() && text.iter().all(u8::is_ascii_digit) {
        Some(text.iter().fold(0, digits))
    } else {
        std::str::from_utf8(text).ok().and_then(|text| text.parse::<i64>().ok())
    };
    let Some(given) = given else {
        return Err(Fault::new(place, format!("\"{}\" is no index of a {what}", name_of(text))));
    };
    let row = if given < 0 { given.saturating_add(count as i64) } else { given - 1 };
    match u32::try_from(row) {
        Ok(row) if row != NONE => Ok(row),
        _ if what != "vertex" => Ok(NONE),
        _ if given == 0 => Err(Fault::new(place, "a face refers to vertex 0, but the first is number 1")),
        _ => {
            Err(Fault::new(place, format!("a face refers to vertex {given}, but there are {count} above it")))
        }
    }
}

/// Three numbers, of which some may be left out and are 0 then; what follows them is passed over.
fn numbers(rest: &[u8], least: usize, place: Place) -> Result<[f64; 3], Fault> {
    let mut row = [0.0; 3];
    let count = fill(rest, &mut row, place)?;
    expect(count, least, place)?;
    Ok(row)
}

/// Fills a row with numbers and says how many there are.
fn fill(rest: &[u8], row: &mut [f64], place: Place) -> Result<usize, Fault> {
    let mut count = 0;
    for (slot, word) in row.iter_mut().zip(words(rest)) {
        *slot = number(word).map_err(|message| Fault::new(place, message))?;
        count += 1;
    }
    Ok(count)
}

fn expect(count: usize, least: usize, place: Place) -> Result<(), Fault> {
    if count >= least {
        return Ok(());
    }
    Err(Fault::new(place, format!("the line has {count} numbers where {least} are needed")))
}

/// The line of the vertex of that row.
pub(super) fn line_of_vertex(bytes: &[u8], row: u32) -> Place {
    let mut lines = Lines::new(bytes);
    let mut left = row;
    while let Some((line, statement)) = lines.next() {
        if split_word(statement).0 == b"v" {
            if left == 0 {
                return Place::Line(line);
            }
            left -= 1;
        }
    }
    Place::File
}
