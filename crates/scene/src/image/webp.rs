//! What does a WebP file hold, for a texture? Bytes, with alpha where it has some; of an animation the first picture.

use catoptra_core::Image;
use image_webp::WebPDecoder;

use super::load::{Fault, Input, check_size, room, unreadable};

/// A picture of one colour takes no bit a pixel at all: the largest, of 1 GiB, still has to be a KiB long.
const MOST: u64 = 1 << 20;

pub(super) fn read(input: impl Input, length: u64) -> Result<Image, Fault> {
    let mut decoder = WebPDecoder::new(input).map_err(|e| unreadable(&e))?;
    let (width, height) = decoder.dimensions();
    let channels = if decoder.has_alpha() { 4 } else { 3 };
    let size = check_size([width, height].map(u64::from), 8 * u64::from(channels), length, MOST)?;
    let bytes = decoder.output_buffer_size().ok_or_else(|| "is too large".to_owned())?;
    decoder.set_memory_limit(bytes.saturating_mul(2).saturating_add(1 << 20));
    let mut pixels: Vec<u8> = room(bytes)?;
    decoder.read_image(&mut pixels).map_err(|e| unreadable(&e))?;
    Image::from_bytes(size, channels, pixels).map_err(|e| e.to_string())
}
