//! What a PLY header announces: how numbers are written, which elements follow, with which properties.

use crate::model::error::{Fault, Place};
use crate::model::names::{name_of, text_of};
use crate::model::warnings::Warnings;

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
    I64,
    U64,
    F32,
    F64,
}

/// Names of number types, for messages.
const SORTS: &str = "char, uchar, short, ushort, int, uint, int64, uint64, float, double";

impl Sort {
    fn named(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "long" | "int64" => Self::I64,
            "ulong" | "uint64" => Self::U64,
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
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// Whether every number of it is one of `f32`.
    pub(super) fn is_narrow(self) -> bool {
        matches!(self, Self::I8 | Self::U8 | Self::I16 | Self::U16 | Self::F32)
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
            Self::I64 => Some((i64::MIN as f64, i64::MAX as f64)),
            Self::U64 => Some((0.0, u64::MAX as f64)),
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
    /// Line of the header that announces it.
    pub(super) line: usize,
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
    /// Pictures that comments name, as MeshLab writes them.
    pub(super) pictures: Vec<String>,
    /// Byte at which the body begins.
    pub(super) body: usize,
    /// Lines of the header.
    pub(super) lines: usize,
}

/// A header longer than this is none.
const LONGEST_HEADER: usize = 1 << 16;

pub(super) fn read(bytes: &[u8], warnings: &Warnings) -> Result<Header, Fault> {
    let start = &bytes[..bytes.len().min(LONGEST_HEADER)];
    // Lines end with LF, with CR LF or, in old files, with CR alone.
    let end = match start.iter().position(|&byte| byte == b'\n' || byte == b'\r') {
        Some(at) if start[at] == b'\r' && start.get(at + 1) != Some(&b'\n') => b'\r',
        _ => b'\n',
    };
    let mut lines = start.split_inclusive(|&byte| byte == end);
    let (mut body, mut line) = (0, 0);
    let mut encoding = None;
    let (mut elements, mut pictures): (Vec<Element>, _) = (Vec::new(), Vec::new());
    loop {
        line += 1;
        let Some(raw) = lines.next() else {
            return Err(Fault::new(Place::Line(line), ended(bytes)));
        };
        body += raw.len();
        if body == LONGEST_HEADER && bytes.len() > LONGEST_HEADER {
            return Err(Fault::new(Place::Line(line), ended(bytes)));
        }
        let text = text_of(raw.strip_prefix(b"\xef\xbb\xbf").unwrap_or(raw));
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        let wrong = |message: String| Err(Fault::new(Place::Line(line), message));
        match words.as_slice() {
            ["ply"] if line == 1 => {}
            _ if line == 1 => return wrong("is no PLY file: the first line must be \"ply\"".into()),
            ["end_header"] => break,
            ["format", name, "1.0"] => encoding = Some(encoding_named(name, line)?),
            ["format", ..] => return wrong(format!("\"{text}\" must be \"format NAME 1.0\"")),
            ["comment", "TextureFile", ..] => {
                pictures.extend(text.split_once("TextureFile").map(|(_, name)| name.trim().to_owned()));
            }
            ["comment" | "obj_info", ..] | [] => {}
            ["element", name, count] => elements.push(element(name, count, line, &elements)?),
            ["property", rest @ ..] => match elements.last_mut() {
                Some(element) => element.properties.push(property(rest, line)?),
                None => return wrong("a property stands before the first element".into()),
            },
            ["element", ..] => return wrong(format!("\"{text}\" must be \"element NAME COUNT\"")),
            _ => {
                let text = name_of(text.as_bytes());
                warnings
                    .add(Place::Line(line), format!("\"{text}\" is no line of a PLY header: passed over"));
            }
        }
    }
    let Some(encoding) = encoding else {
        return Err(Fault::new(Place::Line(line), "the header lacks its \"format\" line"));
    };
    let has = |name: &str| elements.iter().any(|element| element.name == name);
    let missing = match (has("vertex"), has("face") || has("tristrips")) {
        (true, true) => return Ok(Header { encoding, elements, pictures, body, lines: line }),
        (false, _) => "the header announces no element vertex",
        _ => "the header announces no element face or tristrips, and points alone are not drawn",
    };
    Err(Fault::new(Place::Line(line), missing))
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

fn property(words: &[&str], line: usize) -> Result<Property, Fault> {
    let sort = |word: &str| {
        let unknown = || format!("unknown number type \"{word}\": it must be one of {SORTS}");
        Sort::named(word).ok_or_else(|| Fault::new(Place::Line(line), unknown()))
    };
    match words {
        ["list", count, item, name] => {
            let count = sort(count)?;
            if count.range().is_none() {
                return Err(Fault::new(
                    Place::Line(line),
                    "the count of a list must be of a whole number type",
                ));
            }
            Ok(Property { name: (*name).to_owned(), sort: sort(item)?, list: Some(count), line })
        }
        [item, name] => Ok(Property { name: (*name).to_owned(), sort: sort(item)?, list: None, line }),
        _ => Err(Fault::new(Place::Line(line), "a property needs a type and a name")),
    }
}
