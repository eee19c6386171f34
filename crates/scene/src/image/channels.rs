//! How are channels of numbers written as one OpenEXR file? In one part, with a window of the whole picture and one of what
//! there is of it.

use std::io::{self, Cursor, Seek, Write};
use std::path::Path;

use exr::block::lines::LineRefMut;
use exr::image::write::samples::{SamplesWriter, WritableSamples};
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, Image, Layer};
use exr::math::{RoundingMode, Vec2};
use exr::meta::attribute::{AttributeValue, IntegerBounds, LevelMode, LineOrder, SampleType, Text};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use exr::prelude::WritableImage;

use crate::atomic;

/// How the numbers of a file are packed; all ways keep every bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Compression {
    /// As they are.
    None,
    /// Runs of equal bytes: fast.
    Rle,
    /// Deflate, over 16 rows at a time: small, and read by every program.
    #[default]
    Zip,
    /// Wavelets: smaller where there is noise.
    Piz,
}

impl Compression {
    /// Every way there is.
    pub const ALL: &'static [Self] = &[Self::None, Self::Rle, Self::Zip, Self::Piz];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Rle => "rle",
            Self::Zip => "zip",
            Self::Piz => "piz",
        }
    }

    /// The way of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|way| way.name() == name)
    }

    fn of_file(self) -> exr::compression::Compression {
        match self {
            Self::None => exr::compression::Compression::Uncompressed,
            Self::Rle => exr::compression::Compression::RLE,
            Self::Zip => exr::compression::Compression::ZIP16,
            Self::Piz => exr::compression::Compression::PIZ,
        }
    }
}

/// The number of a channel at a column and a row, counted from the upper left corner of what is written.
pub type Numbers<'a, T> = Box<dyn Fn(u32, u32) -> T + Sync + 'a>;

/// The numbers of a channel.
pub enum Samples<'a> {
    /// Floating point, 32 bits.
    Float(Numbers<'a, f32>),
    /// Whole, 32 bits, without a sign.
    Whole(Numbers<'a, u32>),
}

/// A channel of a file.
pub struct Channel<'a> {
    /// Its name, such as `R` or `normal.X`.
    pub name: String,
    /// Its numbers.
    pub samples: Samples<'a>,
}

/// A picture of any number of channels.
pub struct ChannelPicture<'a> {
    /// Width and height of the whole picture, pixels: the display window.
    pub whole: [u32; 2],
    /// Columns left of what is written of it, and rows above.
    pub corner: [u32; 2],
    /// Width and height of what is written, pixels: with the corner, the data window.
    pub size: [u32; 2],
    /// At least one, in any order.
    pub channels: Vec<Channel<'a>>,
    /// What the program that made it is called.
    pub software: String,
    /// A text about the whole picture: a name, and what it says.
    pub about: Option<(String, String)>,
    /// A text about the channels: a name, and what it says.
    pub manifest: Option<(String, String)>,
    /// How numbers are packed.
    pub compression: Compression,
}

/// Bytes that a number takes at most, with its share of what stands between rows.
const LARGEST_SAMPLE: usize = 5;

impl ChannelPicture<'_> {
    /// Writes the file, whole or not at all. Where bytes go straight out, as to a pipe, it is made in memory first: a file is
    /// written with jumps back to its start.
    ///
    /// # Errors
    /// No channel or no pixel, two channels of one name, a file that cannot be written, and memory that is not there.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        if !atomic::is_straight(path) {
            return atomic::write(path, |out| self.encode(out));
        }
        let mut bytes = Vec::new();
        let pixels = self.size[0] as usize * self.size[1] as usize;
        bytes.try_reserve(LARGEST_SAMPLE * self.channels.len() * pixels)?;
        let mut out = Cursor::new(bytes);
        self.encode(&mut out)?;
        atomic::write(path, |file| file.write_all(out.get_ref()))
    }

    fn encode(&self, out: impl Write + Seek) -> io::Result<()> {
        if self.channels.is_empty() || self.size.contains(&0) {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "there is nothing to write"));
        }
        let list = self.channels.iter().map(|channel| AnyChannel::new(text(&channel.name), &channel.samples));
        let channels = AnyChannels::sort(list.collect());
        let encoding = Encoding {
            compression: self.compression.of_file(),
            blocks: Blocks::ScanLines,
            line_order: LineOrder::Increasing,
        };
        let pair = |[x, y]: [u32; 2]| Vec2(x as usize, y as usize);
        let own = |about: &Option<(String, String)>| {
            about.iter().map(|(name, says)| (text(name), AttributeValue::Text(text(says)))).collect()
        };
        let of_part = LayerAttributes {
            layer_position: Vec2(self.corner[0] as i32, self.corner[1] as i32),
            software_name: Some(text(&self.software)),
            // One text here and one there: several in one place would be written in an order that changes from run to run.
            other: own(&self.manifest),
            ..LayerAttributes::default()
        };
        let window = IntegerBounds::new(Vec2(0, 0), pair(self.whole));
        let of_picture = ImageAttributes { other: own(&self.about), ..ImageAttributes::new(window) };
        let image = Image::new(of_picture, Layer::new(pair(self.size), of_part, encoding, channels));
        image.write().non_parallel().to_buffered(out).map_err(|error| match error {
            exr::error::Error::Io(error) => error,
            other => io::Error::other(other.to_string()),
        })
    }
}

/// As UTF-8, which readers take it for.
fn text(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}

impl<'slf> WritableSamples<'slf> for &Samples<'_> {
    type Writer = &'slf Samples<'slf>;

    fn sample_type(&self) -> SampleType {
        match self {
            Samples::Float(_) => SampleType::F32,
            Samples::Whole(_) => SampleType::U32,
        }
    }

    fn infer_level_modes(&self) -> (LevelMode, RoundingMode) {
        (LevelMode::Singular, RoundingMode::Down)
    }

    fn create_samples_writer(&'slf self, _: &Header) -> Self::Writer {
        self
    }
}

impl SamplesWriter for &Samples<'_> {
    fn extract_line(&self, line: LineRefMut<'_>) {
        let Vec2(left, y) = line.location.position;
        let at = |i: usize| ((left + i) as u32, y as u32);
        let filled = match self {
            Samples::Float(number) => line.write_samples(|i| number(at(i).0, at(i).1)),
            Samples::Whole(number) => line.write_samples(|i| number(at(i).0, at(i).1)),
        };
        debug_assert!(filled.is_ok(), "a line has room for its numbers");
    }
}

#[cfg(test)]
mod tests {
    use exr::prelude::{ReadChannels, ReadLayers};

    use super::*;

    fn picture<'a>(corner: [u32; 2], size: [u32; 2], compression: Compression) -> ChannelPicture<'a> {
        let float =
            Samples::Float(Box::new(move |x, y| (x + corner[0]) as f32 + (y + corner[1]) as f32 / 64.0));
        let whole = Samples::Whole(Box::new(move |x, y| (x + corner[0]) << 16 | (y + corner[1])));
        let channel = |name: &str, samples| Channel { name: name.to_owned(), samples };
        ChannelPicture {
            whole: [50, 40],
            corner,
            size,
            channels: vec![channel("id.entity", whole), channel("Z", float)],
            software: "test".to_owned(),
            about: Some(("made".to_owned(), "größer".to_owned())),
            manifest: Some(("manifest".to_owned(), "{}".to_owned())),
            compression,
        }
    }

    #[test]
    fn channels_windows_and_texts_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        for &compression in Compression::ALL {
            picture([7, 9], [33, 21], compression).write(&path).unwrap();
            let read = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels();
            let image = read.first_valid_layer().all_attributes().from_file(&path).unwrap();
            let (layer, window) = (&image.layer_data, image.attributes.display_window);
            assert_eq!((window.position, window.size), (Vec2(0, 0), Vec2(50, 40)));
            assert_eq!((layer.attributes.layer_position, layer.size), (Vec2(7, 9), Vec2(33, 21)));
            let names: Vec<String> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
            assert_eq!(names, ["Z", "id.entity"]);
            let exr::image::FlatSamples::U32(numbers) = &layer.channel_data.list[1].sample_data else {
                panic!("ids are whole");
            };
            assert_eq!((numbers[0], numbers[33 * 21 - 1]), (7 << 16 | 9, 39 << 16 | 29));
            let made = &layer.attributes.other[&text("made")];
            assert_eq!(*made, AttributeValue::Text(text("größer")), "{compression:?}");
        }
    }

    #[test]
    fn the_same_picture_is_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let written = |name: &str| {
            let path = folder.path().join(name);
            picture([0, 0], [50, 40], Compression::Zip).write(&path).unwrap();
            std::fs::read(path).unwrap()
        };
        assert_eq!(written("a.exr"), written("b.exr"));
    }

    #[test]
    fn nothing_is_no_picture() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        assert!(picture([0, 0], [0, 4], Compression::Zip).write(&path).is_err());
        assert!(
            ChannelPicture { channels: Vec::new(), ..picture([0, 0], [5, 4], Compression::Zip) }
                .write(&path)
                .is_err()
        );
        assert!(!path.exists());
    }
}
