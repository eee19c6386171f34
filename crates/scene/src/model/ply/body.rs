//! How the rows of a PLY file are read, number by number, as text or as bytes.

use super::header::{Element, Sort};
use crate::model::error::{Fault, Place};

/// A source of numbers in rows that knows where it stands.
pub(super) trait Body {
    /// Goes to the next row and says where it is.
    fn begin_row(&mut self) -> Result<Place, Fault>;
    /// The next number of the row.
    fn scalar(&mut self, sort: Sort) -> Result<f64, Fault>;
    /// Ends the row; text must hold nothing more on the line.
    fn end_row(&mut self) -> Result<(), Fault>;
    /// Where it stands.
    fn place(&self) -> Place;
    /// How many numbers of a sort the rest of the file can hold at most.
    fn room_for(&self, sort: Sort) -> usize;
    /// Refuses an element whose count the rest of the file cannot hold, before memory is reserved for it.
    fn expect_room_for(&self, element: &Element) -> Result<(), Fault>;
}

fn too_many(element: &Element, most: usize) -> Fault {
    let (count, name) = (element.count, &element.name);
    let message =
        format!("the header announces {count} rows of {name}, the file has room for at most {most}");
    Fault::new(Place::Line(element.line), message)
}

/// One row a line, numbers separated by white space.
pub(super) struct Ascii<'a> {
    rest: &'a [u8],
    row: &'a [u8],
    line: usize,
}

impl<'a> Ascii<'a> {
    pub(super) fn new(rest: &'a [u8], header_lines: usize) -> Self {
        Self { rest, row: &[], line: header_lines }
    }

    fn fault(&self, message: impl std::fmt::Display) -> Fault {
        Fault::new(self.place(), message)
    }
}

impl Body for Ascii<'_> {
    fn begin_row(&mut self) -> Result<Place, Fault> {
        loop {
            self.line += 1;
            if self.rest.is_empty() {
                return Err(self.fault("the file ends before the last announced row"));
            }
            let end = self.rest.iter().position(|&b| b == b'\n');
            let (row, rest) = match end {
                Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
                None => (self.rest, &self.rest[self.rest.len()..]),
            };
            self.rest = rest;
            self.row = row.trim_ascii();
            if !self.row.is_empty() {
                return Ok(self.place());
            }
        }
    }

    fn scalar(&mut self, sort: Sort) -> Result<f64, Fault> {
        let end = self.row.iter().position(u8::is_ascii_whitespace).unwrap_or(self.row.len());
        let (word, rest) = self.row.split_at(end);
        if word.is_empty() {
            return Err(self.fault("the row has too few numbers"));
        }
        self.row = rest.trim_ascii_start();
        let text = String::from_utf8_lossy(word);
        let Ok(value) = text.parse::<f64>() else {
            return Err(self.fault(format!("\"{text}\" is no number")));
        };
        match sort.range() {
            Some((min, max)) if !(value >= min && value <= max && value.fract() == 0.0) => {
                Err(self.fault(format!("{text} is no whole number in {min}..{max}")))
            }
            _ => Ok(value),
        }
    }

    fn end_row(&mut self) -> Result<(), Fault> {
        if self.row.is_empty() { Ok(()) } else { Err(self.fault("the row has more numbers than announced")) }
    }

    fn place(&self) -> Place {
        Place::Line(self.line)
    }

    fn room_for(&self, _sort: Sort) -> usize {
        self.row.len().div_ceil(2)
    }

    fn expect_room_for(&self, element: &Element) -> Result<(), Fault> {
        let most = self.rest.len().div_ceil(2 * element.properties.len().max(1));
        if element.count > most { Err(too_many(element, most)) } else { Ok(()) }
    }
}

/// Numbers byte by byte, without gaps; `BIG` where the highest byte comes first.
pub(super) struct Binary<'a, const BIG: bool> {
    bytes: &'a [u8],
    at: usize,
    /// Byte of the file at which the body begins.
    offset: usize,
}

impl<'a, const BIG: bool> Binary<'a, BIG> {
    pub(super) fn new(bytes: &'a [u8], offset: usize) -> Self {
        Self { bytes, at: 0, offset }
    }

    fn rest(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The next `N` bytes, lowest first.
    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let Some(bytes) = self.bytes[self.at..].first_chunk::<N>() else {
            return Err(Fault::new(self.place(), "the file ends in the middle of a row"));
        };
        self.at += N;
        let mut bytes = *bytes;
        if BIG {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl<const BIG: bool> Body for Binary<'_, BIG> {
    fn begin_row(&mut self) -> Result<Place, Fault> {
        Ok(self.place())
    }

    #[inline]
    fn scalar(&mut self, sort: Sort) -> Result<f64, Fault> {
        Ok(match sort {
            Sort::I8 => f64::from(i8::from_le_bytes(self.take()?)),
            Sort::U8 => f64::from(u8::from_le_bytes(self.take()?)),
            Sort::I16 => f64::from(i16::from_le_bytes(self.take()?)),
            Sort::U16 => f64::from(u16::from_le_bytes(self.take()?)),
            Sort::I32 => f64::from(i32::from_le_bytes(self.take()?)),
            Sort::U32 => f64::from(u32::from_le_bytes(self.take()?)),
            Sort::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Sort::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn end_row(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn place(&self) -> Place {
        Place::Byte(self.offset + self.at)
    }

    fn room_for(&self, sort: Sort) -> usize {
        self.rest() / sort.bytes()
    }

    fn expect_room_for(&self, element: &Element) -> Result<(), Fault> {
        let row: usize = element.properties.iter().map(|p| p.list.unwrap_or(p.sort).bytes()).sum();
        let most = self.rest() / row.max(1);
        if element.count > most { Err(too_many(element, most)) } else { Ok(()) }
    }
}
