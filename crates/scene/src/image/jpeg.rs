//! What does a JPEG file hold? Baseline and progressive; grey stays grey, everything else becomes red, green, blue.

use std::io::Read;

use catoptra_core::Image;
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

use super::load::{Fault, Input, check_size, unreadable};

/// A block of 64 pixels in three colours takes at least two codes of a bit for each colour, or less where progressive scans
/// skip runs of blocks: 192 bytes of pixels in some bits, taken eight times over.
const MOST: u64 = 4096;

/// Longer files are refused: they are read whole.
const LONGEST: u64 = 1 << 30;

pub(super) fn read(input: impl Input, length: u64) -> Result<Image, Fault> {
    let mut bytes = Vec::new();
    input.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|e| unreadable(&e))?;
    if bytes.len() as u64 > LONGEST {
        return Err(format!("is longer than {} MiB", LONGEST >> 20));
    }
    // Strict: what is cut short is an error, not grey.
    let options =
        DecoderOptions::default().set_strict_mode(true).set_max_width(1 << 16).set_max_height(1 << 16);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(&bytes), options);
    decoder.decode_headers().map_err(|e| unreadable(&e))?;
    let Some(info) = decoder.info() else { return Err(unreadable(&"it has no size")) };
    let is_grey = info.components == 1;
    let size = [u64::from(info.width), u64::from(info.height)];
    let size = check_size(size, if is_grey { 8 } else { 24 }, length, MOST)?;
    let space = if is_grey { ColorSpace::Luma } else { ColorSpace::RGB };
    let mut decoder =
        JpegDecoder::new_with_options(ZCursor::new(&bytes), options.jpeg_set_out_colorspace(space));
    let pixels = decoder.decode().map_err(|e| unreadable(&e))?;
    Image::from_bytes(size, if is_grey { 1 } else { 3 }, pixels).map_err(|e| e.to_string())
}
