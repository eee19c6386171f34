//! What are the JSON and the bytes of a glTF file? Text as it is, or chunks of a binary file (GLB, section 4 of the
//! specification).

use crate::model::error::{Fault, Place};

/// What a file holds before its JSON is understood.
#[derive(Debug)]
pub(super) struct Container<'a> {
    /// The text, in UTF-8 if the file is right.
    pub(super) json: &'a [u8],
    /// Where the text begins in a binary file; `None` in one that is text.
    pub(super) start: Option<usize>,
    /// The bytes of the first buffer, where the file has them.
    pub(super) binary: Option<&'a [u8]>,
}

const MAGIC: &[u8] = b"glTF";
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;
const JSON: u32 = 0x4e4f_534a;
const BINARY: u32 = 0x004e_4942;

/// What some editors begin a text file with.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Takes a file apart.
///
/// # Errors
/// An empty file, a binary file of another version, or one that is cut short.
pub(super) fn open(bytes: &[u8]) -> Result<Container<'_>, Fault> {
    if bytes.is_empty() {
        return Err(Fault::new(Place::File, "the file is empty"));
    }
    if !bytes.starts_with(MAGIC) {
        let json = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
        return Ok(Container { json, start: None, binary: None });
    }
    let number = |at: usize| number(bytes, at);
    let version = number(4)?;
    if version != 2 {
        let message = format!("is a binary glTF file of version {version}: only version 2 can be read");
        return Err(Fault::new(Place::Byte(4), message));
    }
    let length = number(8)? as usize;
    if length > bytes.len() {
        let message = format!("is cut short: {length} bytes are announced, {} are there", bytes.len());
        return Err(Fault::new(Place::Byte(8), message));
    }
    let whole = &bytes[..length];
    let (kind, json, mut next) = chunk(whole, HEADER)?;
    if kind != JSON {
        return Err(Fault::new(Place::Byte(HEADER), "the first chunk must be the JSON"));
    }
    let mut binary = None;
    while binary.is_none() && next < length {
        let (kind, found, end) = chunk(whole, next)?;
        binary = (kind == BINARY).then_some(found);
        next = end;
    }
    Ok(Container { json, start: Some(HEADER + CHUNK_HEADER), binary })
}

/// The chunk at a byte: its kind, what is in it, and where it ends.
fn chunk(bytes: &[u8], at: usize) -> Result<(u32, &[u8], usize), Fault> {
    let (length, kind) = (number(bytes, at)? as usize, number(bytes, at + 4)?);
    let start = at + CHUNK_HEADER;
    match bytes[start..].get(..length) {
        Some(found) => Ok((kind, found, start + length)),
        None => {
            let left = bytes.len() - start;
            Err(Fault::new(
                Place::Byte(at),
                format!("a chunk of {length} bytes is announced, {left} are left"),
            ))
        }
    }
}

fn number(bytes: &[u8], at: usize) -> Result<u32, Fault> {
    let found = bytes.get(at..).and_then(|rest| rest.first_chunk());
    let cut = || Fault::new(Place::Byte(bytes.len()), "is cut short: a binary glTF file goes on here");
    found.copied().map(u32::from_le_bytes).ok_or_else(cut)
}
