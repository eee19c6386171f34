//! What stands in a picture file that is to be compared?

use std::path::Path;

use catoptra_core::srgb_decoded;
use catoptra_lab::Picture;
use catoptra_scene::image::read_png;
use exr::prelude::{ReadChannels, ReadLayers};
use miette::{Report, Result, miette};

use crate::output::Format;

/// The values of a picture file as they are stored, bytes as 0 to 1.
pub(crate) struct Stored {
    pub(crate) values: Picture,
    format: Format,
}

impl Stored {
    /// Whether the values are encoded for a display (PNG) and not linear (EXR).
    pub(crate) fn is_encoded(&self) -> bool {
        self.format == Format::Png
    }

    /// The linear light that an sRGB display emits for the picture.
    pub(crate) fn light(&self) -> Picture {
        if !self.is_encoded() {
            return self.values.clone();
        }
        let decoded = |x: u32, y: u32| {
            let at = y as usize * self.values.width() as usize + x as usize;
            self.values.pixels()[at].map(|encoded| srgb_decoded(f64::from(encoded)) as f32)
        };
        Picture::painted(self.values.width(), self.values.height(), decoded)
            .unwrap_or_else(|_| self.values.clone())
    }
}

/// Reads a PNG or an EXR; the ending of the name decides.
pub(crate) fn read_picture(path: &Path) -> Result<Stored> {
    if std::fs::metadata(path).map_err(|error| unreadable(path, &error))?.is_dir() {
        return Err(miette!("{} is a folder, not a picture", path.display()));
    }
    let format = Format::of(path)?;
    let values = match format {
        Format::Png => png_values(path)?,
        Format::Exr => exr_values(path)?,
    };
    Ok(Stored { values, format })
}

fn png_values(path: &Path) -> Result<Picture> {
    let image = read_png(path)?;
    let pixels =
        image.bytes().chunks_exact(3).map(|rgb| [0, 1, 2].map(|i| f32::from(rgb[i]) / 255.0)).collect();
    Picture::new(image.width(), image.height(), pixels).map_err(|error| unreadable(path, &error))
}

fn exr_values(path: &Path) -> Result<Picture> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| (size.width(), vec![[0.0f32; 3]; size.area()]),
            |(width, pixels), place, (r, g, b): (f32, f32, f32)| {
                pixels[place.y() * *width + place.x()] = [r, g, b];
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .map_err(|error| unreadable(path, &error))?;
    let size = image.layer_data.size;
    let (_, pixels) = image.layer_data.channel_data.pixels;
    Picture::new(size.width() as u32, size.height() as u32, pixels).map_err(|error| unreadable(path, &error))
}

fn unreadable(path: &Path, reason: &dyn std::fmt::Display) -> Report {
    miette!("{} cannot be read: {reason}", path.display())
}
