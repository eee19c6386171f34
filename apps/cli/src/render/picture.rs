//! What does a picture file hold, and how is it written?

use std::path::Path;

use catoptra_scene::image::{ChannelPicture, Compression, write_png_rows};
use catoptra_tracer::{Control, Display, Film, Size, Tone};
use miette::{IntoDiagnostic, Result, miette};
use serde_json::json;

use super::command_line;
use crate::args::{PictureArgs, STDOUT};
use crate::film::digest;
use crate::job::Job;
use crate::layers::{Layer, Need, Seen, bytes_of, find_layers, need};
use crate::output::{Format, unwritable};
use crate::suggest::unknown;

/// How pictures are written.
pub(super) struct Looks {
    pub(super) display: Display,
    pub(super) layers: Vec<&'static Layer>,
    /// Whether layers were asked for.
    named: bool,
    format: Option<Format>,
    compression: Compression,
    reproducible: bool,
}

impl Looks {
    /// Looks up all names.
    pub(super) fn of(args: &PictureArgs) -> Result<Self> {
        let looks = Self {
            display: args.display.as_deref().map(find_display).transpose()?.unwrap_or_default(),
            layers: find_layers(&args.layers)?,
            named: !args.layers.is_empty(),
            format: args.format.as_deref().map(Format::named).transpose()?,
            compression: args.compression.as_deref().map(find_compression).transpose()?.unwrap_or_default(),
            reproducible: args.reproducible,
        };
        let format =
            args.output.as_deref().map_or_else(|| Ok(looks.usual()), |path| looks.format_of(path))?;
        if looks.named && format == Format::Png {
            return Err(miette!(
                help = "give the picture the ending .exr, or --format exr",
                "--layers are channels of an .exr, which a .png does not have"
            ));
        }
        Ok(looks)
    }

    /// The format of a picture without a name.
    pub(super) fn usual(&self) -> Format {
        self.format.unwrap_or(if self.named { Format::Exr } else { Format::Png })
    }

    /// The format of a picture of that name.
    pub(super) fn format_of(&self, path: &Path) -> Result<Format> {
        match self.format {
            Some(format) => Ok(format),
            None if path == Path::new(STDOUT) => Ok(self.usual()),
            None => Format::of(path),
        }
    }

    /// Bytes that are needed beside the film.
    pub(super) fn bytes_of(&self, size: Size) -> u64 {
        bytes_of(&self.layers, size)
    }

    /// Whether the film is to tell how sure its pixels are.
    pub(super) fn tells_errors(&self) -> bool {
        need(&self.layers, Need::Errors)
    }
}

fn find_display(name: &str) -> Result<Display> {
    let names: Vec<&str> = Display::ALL.iter().map(|display| display.name()).collect();
    Display::named(name).ok_or_else(|| unknown("display transform", name, &names))
}

fn find_compression(name: &str) -> Result<Compression> {
    let names: Vec<&str> = Compression::ALL.iter().map(|way| way.name()).collect();
    Compression::named(name).ok_or_else(|| unknown("compression", name, &names))
}

/// A picture that has been traced and is to be written.
pub(super) struct Picture<'a> {
    pub(super) job: &'a Job,
    pub(super) film: &'a Film,
    pub(super) looks: &'a Looks,
    /// What its layers show, for a file that has layers.
    pub(super) seen: Option<Seen<'a>>,
    pub(super) tone: Tone,
    /// How long tracing took.
    pub(super) milliseconds: f64,
}

impl<'a> Picture<'a> {
    /// Asks for what the layers of a file of that name need; `None` where that was interrupted.
    pub(super) fn of(
        (job, film): (&'a Job, &'a Film),
        looks: &'a Looks,
        path: &Path,
        (tone, milliseconds): (Tone, f64),
        control: &Control,
    ) -> Result<Option<Self>> {
        let seen = match looks.format_of(path)? {
            Format::Png => None,
            Format::Exr => {
                let Some(seen) = Seen::of(job, film, &looks.layers, control)? else { return Ok(None) };
                Some(seen)
            }
        };
        Ok(Some(Self { job, film, looks, seen, tone, milliseconds }))
    }

    /// Writes it, whole or not at all.
    pub(super) fn write(&self, path: &Path) -> Result<()> {
        let Size { width, height } = self.film.size();
        let Some(seen) = &self.seen else {
            let row = |y, row: &mut [u8]| self.tone.rgb8_row(self.film, y, row);
            return write_png_rows(path, width, height, row).into_diagnostic();
        };
        let (region, whole) = (self.film.region(), self.job.view.size);
        let picture = ChannelPicture {
            whole: [whole.width, whole.height],
            corner: [region.x, region.y],
            size: [width, height],
            channels: self.looks.layers.iter().flat_map(|layer| (layer.channels)(seen)).collect(),
            software: concat!("catoptra ", env!("CARGO_PKG_VERSION")).to_owned(),
            about: self.about()?.map(|about| ("catoptra".to_owned(), about)),
            manifest: seen.manifest().map(|names| ("manifest".to_owned(), names.to_string())),
            compression: self.looks.compression,
        };
        picture.write(path).map_err(|error| unwritable(path, &error))
    }

    /// How it was made, as a JSON object; nothing where files are to tell of the picture alone.
    fn about(&self) -> Result<Option<String>> {
        if self.looks.reproducible {
            return Ok(None);
        }
        let job = self.job;
        let about = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "scene": job.scene_name,
            "scene_hash": digest(job)?,
            "camera": job.camera_name,
            "turned": job.turned,
            "command": command_line(),
            "seconds": self.milliseconds / 1e3,
        });
        Ok(Some(about.to_string()))
    }
}
