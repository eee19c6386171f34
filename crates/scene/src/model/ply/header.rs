//! What a PLY header announces: how numbers are written, which elements follow, with which properties.

use crate::model::error::{Fault, Place};

/// How the body writes numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Little,
    Big,
}

/// Sort of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sort {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Sort {
    fn named(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes it takes in a binary body.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// Whole numbers have a range, the others none.
    pub(super) fn range(self) -> Option<(f64, f64)> {
        match self {
            Self::I8 => Some((-128.0, 127.0)),
            Self::U8 => Some((0.0, 255.0)),
            Self::I16 => Some((-32_768.0, 32_767.0)),
            Self::U16 => Some((0.0, 65_535.0)),
            Self::I32 => Some((f64::from(i32::MIN), f64::from(i32::MAX))),
            Self::U32 => Some((0.0, f64::from(u32::MAX))),
            Self::F32 | Self::F64 => None,
        }
    }
}

/// One property of a row: a number, or a list where `list` gives the sort of its count.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) sort: Sort,
    pub(super) list: Option<Sort>,
}

/// A table of the file.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
    /// Line of the header that announces it.
    pub(super) line: usize,
}

/// What the header says.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Byte at which the body begins.
    pub(super) body: usize,
    /// Lines of the header.
    pub(super) lines: usize,
}

/// A header longer than this is none.
const LONGEST_HEADER: usize = 1 << 16;

pub(super) fn read(bytes: &[u8]) -> Result<Header, Fault> {
    let mut lines = bytes[..bytes.len().min(LONGEST_HEADER)].split_inclusive(|&b| b == b'\n');
    let mut body = 0;
    let mut line = 0;
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        line += 1;
        let Some(raw) = lines.next() else {
            return Err(Fault::new(Place::Line(line), ended(bytes)));
        };
        body += raw.len();
        if body == LONGEST_HEADER && bytes.len() > LONGEST_HEADER {
            return Err(Fault::new(Place::Line(line), ended(bytes)));
        }
        let text = String::from_utf8_lossy(raw);
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        let wrong = |message: String| Err(Fault::new(Place::Line(line), message));
        match words.as_slice() {
            ["ply"] if line == 1 => {}
            _ if line == 1 => return wrong("is no PLY file: the first line must be \"ply\"".into()),
            ["end_header"] => break,
            ["format", name, "1.0"] => encoding = Some(encoding_named(name, line)?),
            ["format", ..] => return wrong(format!("\"{}\" must be \"format NAME 1.0\"", text.trim())),
            ["comment" | "obj_info", ..] | [] => {}
            ["element", name, count] => elements.push(element(name, count, line, &elements)?),
            ["property", rest @ ..] => match elements.last_mut() {
                Some(element) => element.properties.push(property(rest, line, &element.properties)?),
                None => return wrong("a property stands before the first element".into()),
            },
            _ => return wrong(format!("\"{}\" is no line of a PLY header", text.trim())),
        }
    }
    let Some(encoding) = encoding else {
        return Err(Fault::new(Place::Line(line), "the header lacks its \"format\" line"));
    };
    let header = Header { encoding, elements, body, lines: line };
    check_order(&header)?;
    Ok(header)
}

fn ended(bytes: &[u8]) -> &'static str {
    match bytes {
        [] => "the file is empty",
        _ if bytes.len() > LONGEST_HEADER => "the header has no \"end_header\" within its first 65536 bytes",
        _ => "the file ends before \"end_header\"",
    }
}

fn encoding_named(name: &str, line: usize) -> Result<Encoding, Fault> {
    match name {
        "ascii" => Ok(Encoding::Ascii),
        "binary_little_endian" => Ok(Encoding::Little),
        "binary_big_endian" => Ok(Encoding::Big),
        _ => {
            let known = "ascii, binary_little_endian, binary_big_endian";
            Err(Fault::new(
                Place::Line(line),
                format!("unknown format \"{name}\": it must be one of {known}"),
            ))
        }
    }
}

fn element(name: &str, count: &str, line: usize, before: &[Element]) -> Result<Element, Fault> {
    let wrong = |message: String| Err(Fault::new(Place::Line(line), message));
    let Ok(count) = count.parse::<usize>() else {
        return wrong(format!("element {name} needs a count of at least 0, not \"{count}\""));
    };
    if before.iter().any(|e| e.name == name) {
        return wrong(format!("element {name} is announced twice"));
    }
    Ok(Element { name: name.to_owned(), count, properties: Vec::new(), line })
}

fn property(words: &[&str], line: usize, before: &[Property]) -> Result<Property, Fault> {
    let sort = |word: &str| {
        Sort::named(word)
            .ok_or_else(|| Fault::new(Place::Line(line), format!("unknown number type \"{word}\"")))
    };
    let property = match words {
        ["list", count, item, name] => {
            let count = sort(count)?;
            if count.range().is_none() {
                return Err(Fault::new(
                    Place::Line(line),
                    "the count of a list must be of a whole number type",
                ));
            }
            Property { name: (*name).to_owned(), sort: sort(item)?, list: Some(count) }
        }
        [item, name] => Property { name: (*name).to_owned(), sort: sort(item)?, list: None },
        _ => return Err(Fault::new(Place::Line(line), "a property needs a type and a name")),
    };
    if before.iter().any(|p| p.name == property.name) {
        return Err(Fault::new(Place::Line(line), format!("property {} is announced twice", property.name)));
    }
    Ok(property)
}

/// Faces are checked against the vertices while they are read, so the vertices come first.
fn check_order(header: &Header) -> Result<(), Fault> {
    let place = |name: &str| header.elements.iter().position(|e| e.name == name);
    let line = Place::Line(header.lines);
    match (place("vertex"), place("face")) {
        (None, _) => Err(Fault::new(line, "the header announces no element vertex")),
        (_, None) => Err(Fault::new(line, "the header announces no element face")),
        (Some(vertex), Some(face)) if face < vertex => {
            Err(Fault::new(line, "the faces stand before the vertices"))
        }
        _ => match header.elements.iter().find(|e| e.count > 0 && e.properties.is_empty()) {
            Some(e) => Err(Fault::new(Place::Line(e.line), format!("element {} has no properties", e.name))),
            None => Ok(()),
        },
    }
}
