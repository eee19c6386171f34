//! Where does a picture go, and how is it written so that no half of it is ever seen?

use std::io::Write;
use std::path::Path;

use catoptra_scene::atomic;
use catoptra_scene::image::write_png;
use miette::{IntoDiagnostic, Report, Result, miette};

use crate::probe::Map;
use crate::suggest::unknown;

/// Kinds of picture files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// 8 bits a channel, encoded for a display.
    Png,
    /// 32-bit floating point, linear light.
    Exr,
}

impl Format {
    /// The format of that name on the command line.
    pub(crate) fn named(name: &str) -> Result<Self> {
        match name {
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            other => Err(unknown("picture format", other, &["png", "exr"])),
        }
    }

    /// What names of its files end in.
    pub(crate) fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }

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

/// Writes a drawn picture as a PNG.
pub(crate) fn write_map(path: &Path, map: &Map) -> Result<()> {
    write_png(path, map.width as u32, map.height as u32, &map.bytes).into_diagnostic()
}

/// Writes a whole file, or leaves what stood there; the error names it.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<()> {
    atomic::write(path, |out| out.write_all(bytes)).map_err(|error| unwritable(path, &error))
}

pub(crate) fn unwritable(path: &Path, reason: &dyn std::fmt::Display) -> Report {
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
        for format in [Format::Png, Format::Exr] {
            assert_eq!(Format::named(format.ending()).unwrap(), format);
        }
    }
}
