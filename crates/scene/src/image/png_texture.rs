//! What does a PNG file hold, for a texture? Bytes stay bytes; 16 bits become floating-point numbers.

use catoptra_core::Image;
use catoptra_core::texture::Encoding;

use super::load::{Fault, Input, check_size, room, unreadable};

/// Deflate makes at most 1,032 bytes of one (its longest match, 258 bytes, in 2 bits).
const MOST: u64 = 1032;

pub(super) fn read(input: impl Input, length: u64) -> Result<Image, Fault> {
    let mut decoder = png::Decoder::new(input);
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(|e| unreadable(&e))?;
    let info = reader.info();
    let (width, height) = info.size();
    let bits = info.color_type.samples() as u64 * info.bit_depth as u64;
    let size = check_size([width, height].map(u64::from), bits, length, MOST)?;
    let bytes = reader.output_buffer_size().ok_or_else(|| "is too large".to_owned())?;
    let mut buffer: Vec<u8> = room(bytes)?;
    let frame = reader.next_frame(&mut buffer).map_err(|e| unreadable(&e))?;
    buffer.truncate(frame.buffer_size());
    let channels = frame.color_type.samples() as u8;
    let image = if frame.bit_depth == png::BitDepth::Sixteen {
        let share = |pair: &[u8]| f32::from(u16::from_be_bytes([pair[0], pair[1]])) / f32::from(u16::MAX);
        Image::from_floats(size, channels, buffer.chunks_exact(2).map(share).collect(), Encoding::Srgb)
    } else {
        Image::from_bytes(size, channels, buffer)
    };
    image.map_err(|e| e.to_string())
}
