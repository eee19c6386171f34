//! How pictures go out to PNG files and come in from them.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

use crate::{atomic, printable};

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
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{}: {}", printable(&path.to_string_lossy()), printable(message))]
#[diagnostic(code(catoptra::image))]
pub struct ImageError {
    path: PathBuf,
    message: String,
}

impl ImageError {
    fn new(path: &Path, message: impl std::fmt::Display) -> Self {
        Self { path: path.to_owned(), message: message.to_string() }
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
    let needed = 3 * u64::from(width) * u64::from(height);
    if needed == 0 || needed != rgb8.len() as u64 {
        let message = format!("{width} x {height} pixels do not fit {} bytes", rgb8.len());
        return Err(ImageError::new(path, message));
    }
    let written = atomic::write(path, |out| {
        let mut encoder = png::Encoder::new(out, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(rgb8)?;
        writer.finish().map_err(io::Error::from)
    });
    written.map_err(|e| ImageError::new(path, format!("cannot be written: {e}")))
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
    let mut buffer = vec![0; size];
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
