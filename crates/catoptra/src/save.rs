//! How does a film become a picture file in one call?

use std::path::Path;

use catoptra_scene::image::{ImageError, write_png_rows};
use catoptra_tracer::{Display, Film, Tone};

/// Why a film was not saved: which file, and what the system or the picture's format says.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct SaveFilmError(#[from] ImageError);

/// Films as picture files.
///
/// ```no_run
/// use catoptra::prelude::*;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let scene = Scene::new();
/// let film = Render::new(&scene).run()?;
/// film.save_png("picture.png")?;
/// film.save_png_with("brighter.png", catoptra::tracer::Display::Filmic.exposed(1.0))?;
/// # Ok(())
/// # }
/// ```
pub trait SaveFilm {
    /// Writes a PNG of 8 bits a channel, sRGB as displays show it. The file appears whole or not at all, and takes the place of
    /// one that is there.
    ///
    /// # Errors
    /// A film without pixels, and a file that cannot be written.
    fn save_png(&self, path: impl AsRef<Path>) -> Result<(), SaveFilmError> {
        self.save_png_with(path, Display::Srgb.exposed(0.0))
    }

    /// The same with another display transform or exposure.
    ///
    /// # Errors
    /// As of [`save_png`](Self::save_png).
    fn save_png_with(&self, path: impl AsRef<Path>, tone: Tone) -> Result<(), SaveFilmError>;
}

impl SaveFilm for Film {
    fn save_png_with(&self, path: impl AsRef<Path>, tone: Tone) -> Result<(), SaveFilmError> {
        let size = self.size();
        let fill = |y: u32, row: &mut [u8]| tone.rgb8_row(self, y, row);
        Ok(write_png_rows(path.as_ref(), size.width, size.height, fill)?)
    }
}
