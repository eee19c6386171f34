//! What does an OpenEXR file hold? Its first layer with red, green and blue, or with luminance alone; linear. And how is one
//! written?

use std::io::{self, Cursor, Seek, Write};
use std::path::Path;

use catoptra_core::Image;
use catoptra_core::texture::Encoding;
use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, Vec2, WritableImage};

use super::load::{Fault, Input, check_size, room, unreadable};
use crate::atomic;

/// Deflate makes at most 1,032 bytes of one; of the wavelets with their runs of 255 less.
const MOST: u64 = 1032;

/// Writes linear light as an OpenEXR of 32-bit floating point, `size` pixels across and down. The file appears whole or not at
/// all. `pixel` is asked for red, green and blue by column and row from the top left.
///
/// # Errors
/// A file that cannot be written; a size without pixels.
pub fn write_exr(path: &Path, size: [u32; 2], pixel: impl Fn(u32, u32) -> [f32; 3] + Sync) -> io::Result<()> {
    if size.contains(&0) {
        let [width, height] = size;
        let message = format!("{width} x {height} pixels are no picture");
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    // It is written with jumps back to its start. Where bytes go straight out, it is made in memory first.
    if !atomic::is_straight(path) {
        return atomic::write(path, |out| encode(size, pixel, out));
    }
    let mut bytes = Vec::new();
    bytes.try_reserve(LARGEST_PIXEL * size[0] as usize * size[1] as usize)?;
    let mut out = Cursor::new(bytes);
    encode(size, pixel, &mut out)?;
    atomic::write(path, |file| file.write_all(out.get_ref()))
}

/// Bytes of a pixel that nothing can be saved of, and its share of what stands between rows.
const LARGEST_PIXEL: usize = 13;

fn encode(
    [width, height]: [u32; 2],
    pixel: impl Fn(u32, u32) -> [f32; 3] + Sync,
    out: impl Write + Seek,
) -> io::Result<()> {
    let colors = |place: Vec2<usize>| {
        let [r, g, b] = pixel(place.x() as u32, place.y() as u32);
        (r, g, b)
    };
    let channels = exr::image::SpecificChannels::rgb(colors);
    let image = exr::image::Image::from_channels((width as usize, height as usize), channels);
    image.write().non_parallel().to_buffered(out).map_err(|error| match error {
        exr::error::Error::Io(error) => error,
        other => io::Error::other(other.to_string()),
    })
}

pub(super) fn read(mut input: impl Input, length: u64) -> Result<Image, Fault> {
    let meta = MetaData::read_from_buffered(&mut input, false).map_err(|e| unreadable(&e))?;
    input.rewind().map_err(|e| unreadable(&e))?;
    for header in &meta.headers {
        check(header, length)?;
    }
    let has = |header: &Header, name: &str| header.channels.find_index_of_channel(&name.into()).is_some();
    let find = |names: &[&str]| meta.headers.iter().find(|header| names.iter().all(|name| has(header, name)));
    if let Some(header) = find(&["R", "G", "B"]) {
        read_colors(input, has(header, "A"))
    } else if let Some(header) = find(&["Y"]) {
        read_luminance(input, has(header, "A"))
    } else {
        let channels = meta.headers.iter().flat_map(|header| &header.channels.list);
        let names: Vec<String> = channels.take(8).map(|channel| channel.name.to_string()).collect();
        Err(format!("has no channels R, G and B, nor Y, but {}", names.join(", ")))
    }
}

fn check(header: &Header, length: u64) -> Result<(), Fault> {
    if header.deep {
        return Err("holds deep pixels, which have no colour of their own".to_owned());
    }
    let size = [header.layer_size.width() as u64, header.layer_size.height() as u64];
    let bits = header.channels.list.iter().map(|c| 8 * c.sample_type.bytes_per_sample() as u64).sum();
    check_size(size, bits, length, MOST).map(|_| ())
}

/// Numbers of a layer, as they come in; none if there is no memory for them.
struct Grid {
    size: Vec2<usize>,
    channels: usize,
    values: Vec<f32>,
}

impl Grid {
    fn new(size: Vec2<usize>, channels: usize) -> Self {
        Self { size, channels, values: room(size.area() * channels).unwrap_or_default() }
    }

    fn set<const N: usize>(&mut self, at: Vec2<usize>, pixel: [f32; N]) {
        let start = (at.y() * self.size.width() + at.x()) * self.channels;
        if let Some(values) = self.values.get_mut(start..start + self.channels) {
            values.copy_from_slice(&pixel[..self.channels]);
        }
    }
}

fn read_colors(input: impl Input, has_alpha: bool) -> Result<Image, Fault> {
    let found = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |size, _| Grid::new(size, 3 + usize::from(has_alpha)),
            |grid, at, (r, g, b, a): (f32, f32, f32, f32)| grid.set(at, [r, g, b, a]),
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(input)
        .map_err(|e| unreadable(&e))?;
    finish(found.layer_data.channel_data.pixels)
}

fn read_luminance(input: impl Input, has_alpha: bool) -> Result<Image, Fault> {
    let found = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required("Y")
        .optional("A", 1.0)
        .collect_pixels(
            |size, _| Grid::new(size, 1 + usize::from(has_alpha)),
            |grid: &mut Grid, at, (y, a): (f32, f32)| grid.set(at, [y, a]),
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(input)
        .map_err(|e| unreadable(&e))?;
    finish(found.layer_data.channel_data.pixels)
}

/// Colours in the file are multiplied by alpha; what is below black is black.
fn finish(Grid { size: Vec2(width, height), channels, mut values }: Grid) -> Result<Image, Fault> {
    if values.is_empty() {
        return Err("needs more memory than there is".to_owned());
    }
    if let Some(at) = values.iter().position(|v| !v.is_finite()) {
        let (row, column) = (at / channels / width, at / channels % width);
        return Err(format!("holds {} in column {column} of row {row}; it must be finite", values[at]));
    }
    for v in &mut values {
        *v = v.max(0.0);
    }
    if channels.is_multiple_of(2) {
        for pixel in values.chunks_exact_mut(channels) {
            let alpha = pixel[channels - 1].min(1.0);
            pixel[channels - 1] = alpha;
            if alpha > 0.0 {
                pixel[..channels - 1].iter_mut().for_each(|v| *v = (*v / alpha).min(f32::MAX));
            }
        }
    }
    Image::from_floats([width as u32, height as u32], channels as u8, values, Encoding::Linear)
        .map_err(|e| e.to_string())
}
