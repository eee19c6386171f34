//! How the rows of a PLY file are read, number by number, as text or as bytes.

use super::header::{Element, Property, Sort};
use crate::model::error::{Fault, Place};
use crate::model::text::number;

/// A source of numbers in rows that knows where it stands.
pub(super) trait Body {
    /// Goes to the next row and says where it is.
    fn begin_row(&mut self) -> Result<Place, Fault>;

    /// The next number of the row.
    fn scalar(&mut self, sort: Sort) -> Result<f64, Fault>;

    /// Passes over the next numbers of the row, whatever they are.
    fn skip(&mut self, sort: Sort, count: usize) -> Result<(), Fault>;

    /// Where it stands.
    fn place(&self) -> Place;

    /// How many numbers of a sort the rest of the file can hold at most.
    fn room_for(&self, sort: Sort) -> usize;

    /// How many rows of an element the rest of the file can hold at most.
    fn room_for_rows(&self, element: &Element) -> usize;

    /// The numbers of the next row that have a column, each to its column, where all rows are equally long.
    fn row(&mut self, element: &Element, columns: &[Option<usize>], row: &mut [f64]) -> Result<Place, Fault> {
        let place = self.begin_row()?;
        for (property, column) in element.properties.iter().zip(columns) {
            match (column, property.list) {
                (Some(column), None) => row[*column] = self.scalar(property.sort)?,
                _ => self.pass(property)?,
            }
        }
        Ok(place)
    }

    /// Refuses an element whose count the rest of the file cannot hold, before memory is reserved for it.
    fn expect_room_for(&self, element: &Element) -> Result<(), Fault> {
        let most = self.room_for_rows(element);
        if element.count <= most {
            return Ok(());
        }
        let (count, name) = (element.count, &element.name);
        let message =
            format!("the header announces {count} rows of {name}, the file has room for at most {most}");
        Err(Fault::new(Place::Line(element.line), message))
    }

    /// How many items the list that comes next has.
    fn items(&mut self, count: Sort, item: Sort) -> Result<usize, Fault> {
        let items = self.scalar(count)?;
        // Casts saturate, so only whole numbers of at least 0 come back as they were.
        let whole = items as usize;
        if whole as f64 != items {
            return Err(Fault::new(self.place(), format!("a list cannot have {items} items")));
        }
        if whole > self.room_for(item) {
            let message = format!("a list announces {items} items, more than the rest of the file can hold");
            return Err(Fault::new(self.place(), message));
        }
        Ok(whole)
    }

    /// Passes over a property, list or not.
    fn pass(&mut self, property: &Property) -> Result<(), Fault> {
        let count = match property.list {
            Some(count) => self.items(count, property.sort)?,
            None => 1,
        };
        self.skip(property.sort, count)
    }

    /// Adds the items of a list to `out`, which is emptied first.
    fn list(&mut self, count: Sort, item: Sort, out: &mut Vec<f64>) -> Result<(), Fault> {
        let items = self.items(count, item)?;
        out.clear();
        for _ in 0..items {
            out.push(self.scalar(item)?);
        }
        Ok(())
    }
}

/// Numbers as words. A row begins on a line of its own and goes on over as many as it needs; what stands behind its last
/// number on the line is passed over. Or else all is one stream.
pub(super) struct Ascii<'a> {
    rest: &'a [u8],
    row: &'a [u8],
    line: usize,
    by_rows: bool,
    /// The first row that goes on over another line.
    wrapped: Option<usize>,
    /// The first row with too many numbers.
    left_over: Option<usize>,
}

impl<'a> Ascii<'a> {
    pub(super) fn new(rest: &'a [u8], header_lines: usize, by_rows: bool) -> Self {
        Self { rest, row: &[], line: header_lines, by_rows, wrapped: None, left_over: None }
    }

    /// The first row with more numbers than announced.
    pub(super) fn left_over(&self) -> Option<usize> {
        self.left_over
    }

    /// Whether nothing follows.
    pub(super) fn is_at_end(&self) -> bool {
        self.row.is_empty() && self.rest.trim_ascii().is_empty()
    }

    fn fault(&self, message: impl std::fmt::Display) -> Fault {
        Fault::new(self.place(), message)
    }

    /// Goes to the next line that is not empty.
    fn next_line(&mut self) -> Result<(), Fault> {
        loop {
            self.line += 1;
            if self.rest.is_empty() {
                let Some(line) = self.wrapped else {
                    return Err(self.fault("the file ends before the last announced row"));
                };
                let message = "the row has too few numbers, and the file ends before the last announced row";
                return Err(Fault::new(Place::Line(line), message));
            }
            let end = self.rest.iter().position(|&byte| byte == b'\n' || byte == b'\r');
            let (row, rest) = match end {
                Some(end) if self.rest[end..].starts_with(b"\r\n") => {
                    (&self.rest[..end], &self.rest[end + 2..])
                }
                Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
                None => (self.rest, &self.rest[self.rest.len()..]),
            };
            self.rest = rest;
            self.row = row.trim_ascii();
            if !self.row.is_empty() {
                return Ok(());
            }
        }
    }

    fn word(&mut self) -> Result<&'a [u8], Fault> {
        if self.row.is_empty() {
            self.wrapped.get_or_insert(self.line);
            self.next_line()?;
        }
        let end = self.row.iter().position(u8::is_ascii_whitespace).unwrap_or(self.row.len());
        let (word, rest) = self.row.split_at(end);
        self.row = rest.trim_ascii_start();
        Ok(word)
    }
}

impl Body for Ascii<'_> {
    fn begin_row(&mut self) -> Result<Place, Fault> {
        if self.by_rows {
            if !self.row.is_empty() {
                self.left_over.get_or_insert(self.line);
            }
            self.next_line()?;
        } else if self.row.is_empty() {
            self.next_line()?;
        }
        Ok(self.place())
    }

    fn scalar(&mut self, sort: Sort) -> Result<f64, Fault> {
        let word = self.word()?;
        let value = number(word).map_err(|message| self.fault(message))?;
        match sort.range() {
            Some((min, max)) if !(value >= min && value <= max && value.fract() == 0.0) => {
                Err(self.fault(format!("{value} is no whole number in {min}..{max}")))
            }
            _ => Ok(value),
        }
    }

    fn skip(&mut self, _: Sort, count: usize) -> Result<(), Fault> {
        (0..count).try_for_each(|_| self.word().map(|_| ()))
    }

    fn place(&self) -> Place {
        Place::Line(self.line)
    }

    fn room_for(&self, _: Sort) -> usize {
        self.row.len().div_ceil(2) + self.rest.len().div_ceil(2)
    }

    fn room_for_rows(&self, element: &Element) -> usize {
        (self.row.len() + self.rest.len()).div_ceil(2 * element.properties.len().max(1))
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

    #[inline]
    fn take(&mut self, count: usize) -> Result<&'a [u8], Fault> {
        match self.bytes[self.at..].get(..count) {
            Some(bytes) => {
                self.at += count;
                Ok(bytes)
            }
            None => Err(Fault::new(self.place(), "the file ends in the middle of a row")),
        }
    }
}

/// The number that the first bytes stand for; 0 where there are too few.
#[inline(always)]
fn decoded<const BIG: bool>(sort: Sort, bytes: &[u8]) -> f64 {
    #[inline(always)]
    fn first<const N: usize, const BIG: bool>(bytes: &[u8]) -> [u8; N] {
        let mut first = bytes.first_chunk::<N>().copied().unwrap_or([0; N]);
        if BIG {
            first.reverse();
        }
        first
    }
    match sort {
        Sort::I8 => f64::from(i8::from_le_bytes(first::<1, BIG>(bytes))),
        Sort::U8 => f64::from(u8::from_le_bytes(first::<1, BIG>(bytes))),
        Sort::I16 => f64::from(i16::from_le_bytes(first::<2, BIG>(bytes))),
        Sort::U16 => f64::from(u16::from_le_bytes(first::<2, BIG>(bytes))),
        Sort::I32 => f64::from(i32::from_le_bytes(first::<4, BIG>(bytes))),
        Sort::U32 => f64::from(u32::from_le_bytes(first::<4, BIG>(bytes))),
        Sort::I64 => i64::from_le_bytes(first::<8, BIG>(bytes)) as f64,
        Sort::U64 => u64::from_le_bytes(first::<8, BIG>(bytes)) as f64,
        Sort::F32 => f64::from(f32::from_le_bytes(first::<4, BIG>(bytes))),
        Sort::F64 => f64::from_le_bytes(first::<8, BIG>(bytes)),
    }
}

impl<const BIG: bool> Body for Binary<'_, BIG> {
    fn begin_row(&mut self) -> Result<Place, Fault> {
        Ok(self.place())
    }

    #[inline]
    fn scalar(&mut self, sort: Sort) -> Result<f64, Fault> {
        self.take(sort.bytes()).map(|bytes| decoded::<BIG>(sort, bytes))
    }

    fn skip(&mut self, sort: Sort, count: usize) -> Result<(), Fault> {
        self.take(sort.bytes().saturating_mul(count)).map(|_| ())
    }

    fn place(&self) -> Place {
        Place::Byte(self.offset + self.at)
    }

    fn room_for(&self, sort: Sort) -> usize {
        self.rest() / sort.bytes()
    }

    fn room_for_rows(&self, element: &Element) -> usize {
        let row: usize = element.properties.iter().map(|p| p.list.unwrap_or(p.sort).bytes()).sum();
        self.rest() / row.max(1)
    }

    #[inline]
    fn list(&mut self, count: Sort, item: Sort, out: &mut Vec<f64>) -> Result<(), Fault> {
        let items = self.items(count, item)?;
        let bytes = self.take(items * item.bytes())?;
        out.clear();
        out.extend(bytes.chunks_exact(item.bytes()).map(|bytes| decoded::<BIG>(item, bytes)));
        Ok(())
    }
}
