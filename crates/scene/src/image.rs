//! How pictures go out to PNG and OpenEXR files and come in from them, and from JPEG, WebP and Radiance files.

mod channels;
pub mod false_color;
mod jpeg;
mod load;
mod openexr;
mod png_texture;
mod radiance;
mod webp;

use std::fs::File;
use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};

use crate::{atomic, printable};
pub use channels::{Channel, ChannelPicture, Compression, Numbers, Samples};
pub use load::{load, load_bytes};
pub use openexr::write_exr;

/// A picture of 8-bit red, green, blue: row-major from the top left, `3 * width * height` bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rgb8Image {
    width: u32,
    height: u32,
    bytes: Vec<u8>,
}

impl Rgb8Image {
    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Red, green and blue of every pixel.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Red, green and blue of one pixel; `None` outside.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let at = 3 * (y as usize * self.width as usize + x as usize);
        self.bytes.get(at..at + 3).and_then(|rgb| rgb.try_into().ok())
    }
}

/// A picture file that cannot be written or read.
#[derive(Debug, thiserror::Error)]
#[cfg_attr(feature = "text", derive(miette::Diagnostic), diagnostic(code(catoptra::image)))]
#[error("{}: {}", printable(&path.to_string_lossy()), printable(message))]
pub struct ImageError {
    path: PathBuf,
    message: String,
}

impl ImageError {
    fn new(path: &Path, message: impl std::fmt::Display) -> Self {
        Self { path: path.to_owned(), message: message.to_string() }
    }

    /// The file.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.path
    }

    /// What is wrong, without the file; as the file spells it, controls included.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }
}

/// Pictures of more pixels are refused on reading, before memory is taken for them.
const MOST_PIXELS: u64 = 1 << 28;

/// Writes an sRGB PNG. The file appears whole or not at all.
///
/// `rgb8` is row-major from the top left, three bytes a pixel.
///
/// # Errors
/// A size without pixels, a number of bytes that does not fit the size, or a file that cannot be written.
pub fn write_png(path: &Path, width: u32, height: u32, rgb8: &[u8]) -> Result<(), ImageError> {
    if 3 * u64::from(width) * u64::from(height) != rgb8.len() as u64 {
        let message = format!("{width} x {height} pixels do not fit {} bytes", rgb8.len());
        return Err(ImageError::new(path, message));
    }
    let mut rows = rgb8.chunks_exact(3 * width.max(1) as usize);
    write_png_rows(path, width, height, |_, row| {
        if let Some(given) = rows.next() {
            row.copy_from_slice(given);
        }
    })
}

/// Writes an sRGB PNG without holding all of it in memory. The file appears whole or not at all.
///
/// `fill` is called for each row from the top, with its number and the `3 * width` bytes of its pixels to be set.
///
/// # Errors
/// A size without pixels, or a file that cannot be written.
pub fn write_png_rows(
    path: &Path,
    width: u32,
    height: u32,
    mut fill: impl FnMut(u32, &mut [u8]),
) -> Result<(), ImageError> {
    if width == 0 || height == 0 {
        return Err(ImageError::new(path, format!("{width} x {height} pixels are no picture")));
    }
    let written = atomic::write(path, |out| {
        let mut out = Checked { out, failed: None };
        let encoded = encode(&mut out, width, height, &mut fill);
        // The first refusal of the system says more than what the encoder makes of it, or does not make of it.
        out.failed.map_or(encoded, Err)
    });
    written.map_err(|e| ImageError::new(path, format!("cannot be written: {e}")))
}

fn encode(out: impl Write, width: u32, height: u32, fill: &mut dyn FnMut(u32, &mut [u8])) -> io::Result<()> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    let mut stream = writer.stream_writer_with_size(CHUNK)?;
    let mut row = vec![0; 3 * width as usize];
    for y in 0..height {
        fill(y, &mut row);
        stream.write_all(&row)?;
    }
    stream.finish()?;
    writer.finish().map_err(io::Error::from)
}

/// Bytes of compressed data that are written at a time.
const CHUNK: usize = 1 << 16;

/// Remembers that a write has failed, since the encoder passes over that of its last chunk.
struct Checked<W> {
    out: W,
    failed: Option<io::Error>,
}

impl<W: Write> Write for Checked<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write(bytes).inspect_err(|e| {
            if e.kind() != io::ErrorKind::Interrupted {
                self.failed.get_or_insert(copy_of(e));
            }
        })
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush().inspect_err(|e| {
            self.failed.get_or_insert(copy_of(e));
        })
    }
}

fn copy_of(error: &io::Error) -> io::Error {
    error
        .raw_os_error()
        .map_or_else(|| io::Error::new(error.kind(), error.to_string()), io::Error::from_raw_os_error)
}

/// Reads a PNG of any colour type as 8-bit red, green, blue; transparency is dropped.
///
/// # Errors
/// A file that cannot be read, is no PNG, or has more than 2²⁸ pixels.
pub fn read_png(path: &Path) -> Result<Rgb8Image, ImageError> {
    let fail = |e: &dyn std::fmt::Display| ImageError::new(path, format!("cannot be read: {e}"));
    let file = File::open(path).map_err(|e| fail(&e))?;
    let mut decoder = png::Decoder::new(BufReader::new(file));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|e| fail(&e))?;
    let (width, height) = reader.info().size();
    let size = reader.output_buffer_size().filter(|_| u64::from(width) * u64::from(height) <= MOST_PIXELS);
    let Some(size) = size else {
        return Err(fail(&format!("{width} x {height} pixels are more than 2^28")));
    };
    let mut buffer = Vec::new();
    if buffer.try_reserve_exact(size).is_err() {
        return Err(fail(&format!(
            "{width} x {height} pixels need {size} bytes of memory, more than there is"
        )));
    }
    buffer.resize(size, 0);
    let frame = reader.next_frame(&mut buffer).map_err(|e| fail(&e))?;
    buffer.truncate(frame.buffer_size());
    let bytes = match frame.color_type {
        png::ColorType::Grayscale => buffer.iter().flat_map(|&v| [v; 3]).collect(),
        png::ColorType::GrayscaleAlpha => buffer.chunks_exact(2).flat_map(|p| [p[0]; 3]).collect(),
        png::ColorType::Rgba => buffer.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect(),
        png::ColorType::Rgb | png::ColorType::Indexed => buffer,
    };
    Ok(Rgb8Image { width, height, bytes })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_written_picture_reads_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let bytes: Vec<u8> = (0..3 * 5 * 4).collect();
        write_png(&path, 5, 4, &bytes).unwrap();
        let image = read_png(&path).unwrap();
        assert_eq!((image.width(), image.height(), image.bytes()), (5, 4, &bytes[..]));
        assert_eq!(image.pixel(1, 2), Some([33, 34, 35]));
        assert_eq!(image.pixel(5, 0), None);
    }

    #[test]
    fn a_size_that_does_not_fit_is_refused_before_a_file_appears() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        assert!(write_png(&path, 2, 2, &[0; 11]).is_err());
        assert!(write_png(&path, 0, 2, &[]).is_err());
        assert!(!path.exists());
    }

    #[test]
    fn what_is_no_png_is_refused_with_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        std::fs::write(&path, "not a picture").unwrap();
        assert!(read_png(&path).unwrap_err().to_string().contains("a.png"));
    }
}
