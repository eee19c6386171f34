//! Where does a picture go, and how is it written so that no half of it is ever seen?

use std::io::{Cursor, ErrorKind, Write};
use std::path::{Path, PathBuf};

use catoptra_scene::atomic;
use catoptra_scene::image::write_png;
use catoptra_tracer::{Display, Film};
use exr::prelude::WritableImage;
use miette::{IntoDiagnostic, Report, Result, WrapErr, miette};

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
                "{} does not say which picture format to write",
                path.display()
            )),
        }
    }
}

/// Refuses a path that cannot be written, before time is spent on rendering.
pub(crate) fn check_folder(path: &Path) -> Result<()> {
    let folder = folder_of(path);
    if !folder.is_dir() {
        return Err(miette!(
            help = "make it first, or write somewhere else",
            "the folder {} of {} does not exist",
            folder.display(),
            path.display()
        ));
    }
    if path.is_dir() {
        return Err(miette!("{} is a folder, not a file", path.display()));
    }
    Ok(())
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Writes a film as the picture that the name asks for.
pub(crate) fn write_film(path: &Path, film: &Film, display: Display) -> Result<()> {
    match Format::of(path)? {
        Format::Png => {
            write_png(path, film.size().width, film.size().height, &display.rgb8(film)).into_diagnostic()
        }
        Format::Exr => write_file(path, &exr_bytes(film).map_err(|error| unwritable(path, &error))?),
    }
}

fn exr_bytes(film: &Film) -> exr::error::Result<Vec<u8>> {
    let size = film.size();
    let pixel = |place: exr::math::Vec2<usize>| {
        let [r, g, b] = film.radiance(place.x() as u32, place.y() as u32);
        (r, g, b)
    };
    let channels = exr::image::SpecificChannels::rgb(pixel);
    let image = exr::image::Image::from_channels((size.width as usize, size.height as usize), channels);
    let mut bytes = Cursor::new(Vec::new());
    image.write().non_parallel().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

/// Prints to standard output; a reader that has gone away, such as `head`, wants no more and is no error.
pub(crate) fn print(text: &str) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).into_diagnostic().wrap_err("standard output cannot be written")
        }
        _ => Ok(()),
    }
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
