//! How pictures come in for textures and for what surrounds a scene: PNG, JPEG, WebP, OpenEXR and Radiance, told apart by
//! what the file holds and not by its name.
//!
//! A size is checked against the limits and against the length of the file before memory is taken for it, so that a few bytes
//! cannot ask for gigabytes.

use std::collections::HashMap;
use std::fs::{File, Metadata};
use std::io::{BufRead, BufReader, Cursor, Read, Seek};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::SystemTime;

use catoptra_core::Image;
use catoptra_core::texture::MOST_PIXELS;

use super::{ImageError, jpeg, openexr, png_texture, radiance, webp};

/// Where a picture is read from.
pub(super) trait Input: BufRead + Seek {}

impl<T: BufRead + Seek> Input for T {}

/// Why a picture is refused, before it is known which file it is.
pub(super) type Fault = String;

/// Reads a picture. One that has been read before, is in use still, and whose file has not changed since (by its length and
/// time), is shared.
///
/// # Errors
/// A file that cannot be read, or that is no valid picture of at most 2²⁸ pixels.
pub fn load(path: &Path) -> Result<Arc<Image>, ImageError> {
    let fail = |message: &dyn std::fmt::Display| ImageError::new(path, format!("cannot be read: {message}"));
    let file = File::open(path).map_err(|e| fail(&e))?;
    let found = file.metadata().map_err(|e| fail(&e))?;
    if !found.is_file() {
        return Err(ImageError::new(path, "is no file with a picture"));
    }
    let key = key(path, &found);
    if let Some(known) = key.as_ref().and_then(known) {
        return Ok(known);
    }
    let image = read(BufReader::with_capacity(1 << 16, file), found.len());
    let image = image.map(Arc::new).map_err(|fault| ImageError::new(path, fault))?;
    if let Some(key) = key {
        remember(key, &image);
    }
    Ok(image)
}

/// Reads a picture from the bytes of a file.
///
/// # Errors
/// As for [`load`]; `name` stands for the file in messages.
pub fn load_bytes(bytes: &[u8], name: &Path) -> Result<Image, ImageError> {
    read(Cursor::new(bytes), bytes.len() as u64).map_err(|fault| ImageError::new(name, fault))
}

/// A file as it was at one time.
type Key = (PathBuf, u64, SystemTime);

fn key(path: &Path, found: &Metadata) -> Option<Key> {
    Some((path.canonicalize().ok()?, found.len(), found.modified().ok()?))
}

/// The pictures that are in use.
static KNOWN: Mutex<Option<HashMap<Key, Weak<Image>>>> = Mutex::new(None);

fn known(key: &Key) -> Option<Arc<Image>> {
    let known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    known.as_ref()?.get(key)?.upgrade()
}

fn remember(key: Key, image: &Arc<Image>) {
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let known = known.get_or_insert_default();
    known.retain(|_, image| image.strong_count() > 0);
    known.insert(key, Arc::downgrade(image));
}

/// The first bytes of files that hold pictures of another sort, and what they are called.
const FOREIGN: &[(&[u8], &str)] = &[
    (b"GIF8", "GIF"),
    (b"BM", "BMP"),
    (b"II*\0", "TIFF"),
    (b"MM\0*", "TIFF"),
    (b"DDS ", "DDS"),
    (b"8BPS", "Photoshop"),
    (b"\xabKTX", "KTX"),
    (b"\0\0\0\x0cjP", "JPEG 2000"),
    (b"\xff\x0a", "JPEG XL"),
    (b"P3", "PPM"),
    (b"P6", "PPM"),
    (b"PF", "PFM"),
];

fn read(mut input: impl Input, length: u64) -> Result<Image, Fault> {
    let mut start = Vec::with_capacity(8);
    input.by_ref().take(8).read_to_end(&mut start).map_err(|e| unreadable(&e))?;
    input.rewind().map_err(|e| unreadable(&e))?;
    match &start[..] {
        [] => Err("is empty".to_owned()),
        [0x89, b'P', b'N', b'G', ..] => png_texture::read(input, length),
        [0xff, 0xd8, 0xff, ..] => jpeg::read(input, length),
        [0x76, 0x2f, 0x31, 0x01, ..] => openexr::read(input, length),
        [b'R', b'I', b'F', b'F', ..] => webp::read(input, length),
        [b'#', b'?', ..] => radiance::read(input, length),
        start => {
            let foreign = FOREIGN.iter().find(|(magic, _)| start.starts_with(magic));
            let is = foreign.map_or_else(|| "no picture".to_owned(), |(_, name)| format!("a {name} picture"));
            Err(format!("is {is}: it must be a PNG, JPEG, WebP, EXR or HDR file"))
        }
    }
}

pub(super) fn unreadable(reason: &dyn std::fmt::Display) -> Fault {
    format!("cannot be read: {reason}")
}

/// Refuses a size without pixels, with too many, or with more than a file of that length can hold if each of its bytes stands
/// for at most `most` bytes of pixels.
pub(super) fn check_size(
    [width, height]: [u64; 2],
    bits_of_pixel: u64,
    length: u64,
    most: u64,
) -> Result<[u32; 2], Fault> {
    let pixels = width.saturating_mul(height);
    let size = [u32::try_from(width), u32::try_from(height)];
    match size {
        _ if pixels == 0 => Err(format!("has no pixels: its size is {width} x {height}")),
        [Ok(width), Ok(height)] if pixels <= MOST_PIXELS => {
            let bytes = pixels.saturating_mul(bits_of_pixel) / 8;
            if bytes / most > length + SLACK / most {
                return Err(format!("is cut short: {length} bytes cannot hold {width} x {height} pixels"));
            }
            Ok([width, height])
        }
        _ => Err(format!("is too large: {width} x {height} pixels are more than 2^28")),
    }
}

/// So many bytes of pixels are taken whatever the length of the file.
const SLACK: u64 = 1 << 20;

/// Zeros for so many numbers.
pub(super) fn room<T: Clone + Default>(count: usize) -> Result<Vec<T>, Fault> {
    let mut room = Vec::new();
    if room.try_reserve_exact(count).is_err() {
        return Err(format!("needs {} bytes of memory, more than there is", count * size_of::<T>()));
    }
    room.resize(count, T::default());
    Ok(room)
}
