//! Where does a picture go, and how is it written so that no half of it is ever seen?

use std::io::Write;
use std::path::Path;

use catoptra_scene::atomic;
use catoptra_scene::image::{write_exr, write_png, write_png_rows};
use catoptra_tracer::{Film, Size, Tone};
use miette::{IntoDiagnostic, Report, Result, miette};

use crate::probe::Map;

/// Kinds of picture files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// 8 bits a channel, encoded for a display.
    Png,
    /// 32-bit floating point, linear light.
    Exr,
}

impl Format {
    /// The format that the ending of a file's name says.
    pub(crate) fn of(path: &Path) -> Result<Self> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            Some(other) => Err(miette!(
                help = "pictures are .png (8 bits, as displayed) or .exr (linear, 32 bits)",
                "{} ends in .{other}, which is no picture format known here",
                path.display()
            )),
            None => Err(miette!(
                help = "give the name an ending: .png (8 bits, as displayed) or .exr (linear, 32 bits)",
                "{} does not end in .png or .exr: its picture format is not known",
                path.display()
            )),
        }
    }
}

/// Writes a film as the picture that the name asks for.
pub(crate) fn write_film(path: &Path, film: &Film, tone: Tone) -> Result<()> {
    let Size { width, height } = film.size();
    match Format::of(path)? {
        Format::Png => {
            write_png_rows(path, width, height, |y, row| tone.rgb8_row(film, y, row)).into_diagnostic()
        }
        Format::Exr => write_exr(path, [width, height], |x, y| film.radiance(x, y))
            .map_err(|error| unwritable(path, &error)),
    }
}

/// Writes a drawn picture as a PNG.
pub(crate) fn write_map(path: &Path, map: &Map) -> Result<()> {
    write_png(path, map.width as u32, map.height as u32, &map.bytes).into_diagnostic()
}

/// Writes a whole file, or leaves what stood there; the error names it.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<()> {
    atomic::write(path, |out| out.write_all(bytes)).map_err(|error| unwritable(path, &error))
}

fn unwritable(path: &Path, reason: &dyn std::fmt::Display) -> Report {
    miette!("{} cannot be written: {reason}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides_whatever_its_case() {
        assert_eq!(Format::of(Path::new("a.PNG")).unwrap(), Format::Png);
        assert_eq!(Format::of(Path::new("b/c.exr")).unwrap(), Format::Exr);
        assert!(Format::of(Path::new("a.jpg")).is_err());
        assert!(Format::of(Path::new("png")).is_err());
    }
}
