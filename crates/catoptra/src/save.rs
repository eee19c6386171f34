//! How does a film become a picture file in one call?

use std::io;
use std::path::{Path, PathBuf};

use catoptra_scene::image::{ImageError, write_exr, write_png_rows};
use catoptra_tracer::{Display, Film, Tone};

/// Why a film was not saved: which file, and what the system or the picture's format says.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct SaveFilmError(Cause);

#[derive(Debug, thiserror::Error)]
enum Cause {
    #[error(transparent)]
    Png(ImageError),
    #[error("{}: cannot be written: {error}", path.display())]
    Exr { path: PathBuf, error: io::Error },
}

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
/// film.save_exr("light.exr")?;
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

    /// Writes the light itself as an OpenEXR: linear red, green and blue of 32-bit floating point, bit for bit. The
    /// file appears whole or not at all, and takes the place of one that is there. For other channels, such as depths,
    /// there is [`ChannelPicture`](catoptra_scene::image::ChannelPicture).
    ///
    /// # Errors
    /// As of [`save_png`](Self::save_png).
    fn save_exr(&self, path: impl AsRef<Path>) -> Result<(), SaveFilmError>;
}

impl SaveFilm for Film {
    fn save_png_with(&self, path: impl AsRef<Path>, tone: Tone) -> Result<(), SaveFilmError> {
        let size = self.size();
        let fill = |y: u32, row: &mut [u8]| tone.rgb8_row(self, y, row);
        let written = write_png_rows(path.as_ref(), size.width, size.height, fill);
        written.map_err(|error| SaveFilmError(Cause::Png(error)))
    }

    fn save_exr(&self, path: impl AsRef<Path>) -> Result<(), SaveFilmError> {
        let (path, size) = (path.as_ref(), self.size());
        let written = write_exr(path, [size.width, size.height], |x, y| self.radiance(x, y));
        written.map_err(|error| SaveFilmError(Cause::Exr { path: path.to_owned(), error }))
    }
}

#[cfg(test)]
mod tests {
    use std::error::Error;

    use super::*;
    use crate::prelude::*;

    #[test]
    fn an_exr_holds_the_light_bit_for_bit() -> Result<(), Box<dyn Error>> {
        let mut scene = Scene::new();
        let clay = scene.add_material("clay", Matte::new(Rgb::new(0.8, 0.5, 0.3))?)?;
        scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0)?, clay, None)?;
        scene.add_light("lamp", PointLight::new(DVec3::splat(3.0), Rgb::grey(900.0))?, None)?;
        let camera = Camera::look_at(DVec3::Z * 4.0, DVec3::ZERO, DVec3::Y, 0.8)?;
        let film = Render::new(&scene).camera(camera).size(7, 5).run()?;
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("light.exr");
        film.save_exr(&path)?;
        let read = catoptra_scene::image::load(&path)?;
        assert_eq!([read.width(), read.height()], [7, 5]);
        for (x, y) in (0..5).flat_map(|y| (0..7).map(move |x| (x, y))) {
            assert_eq!(read.plain_pixel(x, y).to_array(), film.radiance(x, y).map(f64::from), "{x} {y}");
        }
        assert!(film.radiance(3, 2)[0] > 1.0, "brighter than a display shows");
        Ok(())
    }

    #[test]
    fn what_is_no_picture_is_refused_by_its_name() -> Result<(), Box<dyn Error>> {
        let (folder, film) = (tempfile::tempdir()?, Film::new(Size::new(0, 3)));
        let path = folder.path().join("nothing");
        for saved in [film.save_png(&path), film.save_exr(&path)] {
            let error = saved.err().ok_or("no picture was written")?.to_string();
            assert!(error.contains("nothing: "), "{error}");
            assert!(!path.exists(), "{error}");
        }
        Ok(())
    }
}
