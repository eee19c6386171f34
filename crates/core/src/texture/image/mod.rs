//! How is a picture kept, and how is it read at a place?
//!
//! Pixels stay as small as the file has them: bytes, or `f32`. Each way of reading them as light has a chain of smaller copies,
//! built once, when it is asked for first.

mod filter;
mod levels;
mod pyramid;

use std::fmt;
use std::sync::OnceLock;

pub use filter::Filter;
pub use levels::{Levels, Wrap};
use pyramid::{Pyramid, linear_copy};

use super::Texel;
use crate::{InvalidPart, Rgb};

/// How the numbers of a picture stand for light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// By the sRGB transfer function.
    Srgb,
    /// As they are.
    Linear,
}

/// The most pixels of a picture: 16,384 x 16,384.
pub const MOST_PIXELS: u64 = 1 << 28;

/// Numbers of pixels, channel by channel.
#[derive(Debug, Clone, PartialEq)]
enum Samples {
    /// Of 0..=255.
    Bytes(Vec<u8>),
    /// Finite.
    Floats(Vec<f32>),
}

impl Samples {
    fn len(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            Self::Floats(floats) => floats.len(),
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            Self::Floats(floats) => size_of_val(&floats[..]),
        }
    }
}

/// A grid of pixels: row-major from the top left, channels side by side.
#[derive(Debug, Clone, PartialEq)]
struct Plane {
    width: u32,
    height: u32,
    /// 1: grey, 2: grey and alpha, 3: red, green, blue, 4: with alpha, which is not multiplied into them.
    channels: u8,
    samples: Samples,
}

impl Plane {
    fn has_alpha(&self) -> bool {
        self.channels.is_multiple_of(2)
    }
}

/// A picture: for textures, and for what surrounds a scene.
pub struct Image {
    plane: Plane,
    natural: Encoding,
    srgb: OnceLock<Pyramid>,
    linear: OnceLock<Pyramid>,
}

impl Image {
    /// From bytes: row-major from the top left, `channels` (1: grey, 2: grey and alpha, 3: red, green, blue, 4: with alpha)
    /// side by side, alpha not multiplied into the others. They are taken for sRGB unless a texture says otherwise.
    ///
    /// # Errors
    /// A size of no pixels or of more than 2²⁸, other channels, or bytes that do not fit the size.
    pub fn from_bytes(size: [u32; 2], channels: u8, bytes: Vec<u8>) -> Result<Self, InvalidPart> {
        Self::new(size, channels, Samples::Bytes(bytes), Encoding::Srgb)
    }

    /// From floating-point numbers, as for [`from_bytes`](Self::from_bytes), and what they stand for.
    ///
    /// # Errors
    /// As there, and numbers that are not finite or negative.
    pub fn from_floats(
        size: [u32; 2],
        channels: u8,
        floats: Vec<f32>,
        natural: Encoding,
    ) -> Result<Self, InvalidPart> {
        if let Some(found) = floats.iter().find(|v| !(v.is_finite() && **v >= 0.0)) {
            return Err(InvalidPart::new("pixels", "must be finite and at least 0", found));
        }
        Self::new(size, channels, Samples::Floats(floats), natural)
    }

    fn new(
        [width, height]: [u32; 2],
        channels: u8,
        samples: Samples,
        natural: Encoding,
    ) -> Result<Self, InvalidPart> {
        let pixels = u64::from(width) * u64::from(height);
        let size = || format!("{width} x {height}");
        if pixels == 0 || pixels > MOST_PIXELS {
            return Err(InvalidPart::new("size", "must be 1 to 2^28 pixels", size()));
        }
        if !(1..=4).contains(&channels) {
            return Err(InvalidPart::new("channels", "must be 1 to 4", channels));
        }
        if samples.len() as u64 != pixels * u64::from(channels) {
            let requirement = format!("must be those of {} pixels", size());
            return Err(InvalidPart::new("pixels", requirement, format!("{} numbers", samples.len())));
        }
        let plane = Plane { width, height, channels, samples };
        Ok(Self { plane, natural, srgb: OnceLock::new(), linear: OnceLock::new() })
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.plane.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.plane.height
    }

    /// 1: grey, 2: grey and alpha, 3: red, green, blue, 4: with alpha.
    #[must_use]
    pub fn channels(&self) -> u8 {
        self.plane.channels
    }

    /// What its numbers stand for unless a texture says otherwise: sRGB for whole numbers, linear for floating-point ones.
    #[must_use]
    pub fn natural_encoding(&self) -> Encoding {
        self.natural
    }

    /// The pixel in column `x` from the left and row `y` from the top, linear by its natural encoding; the last one beyond
    /// the border.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Texel {
        let (x, y) = (x.min(self.width() - 1), y.min(self.height() - 1));
        levels::light_of(&self.plane, self.natural, x, y).texel()
    }

    /// The pixel in column `x` from the left and row `y` from the top, its numbers as they are (whole ones as shares of the
    /// largest); the last one beyond the border.
    #[must_use]
    pub fn plain_pixel(&self, x: u32, y: u32) -> Rgb {
        let (x, y) = (x.min(self.width() - 1), y.min(self.height() - 1));
        levels::light_of(&self.plane, Encoding::Linear, x, y).texel().color
    }

    /// The picture as light, with its smaller copies.
    #[must_use]
    pub fn levels(&self, encoding: Encoding) -> Levels<'_> {
        Levels::new(&self.plane, self.pyramid(encoding), encoding)
    }

    /// Builds the smaller copies now, if that has not been done: later reads do not wait then.
    pub(in crate::texture) fn prepare(&self, encoding: Encoding) {
        self.pyramid(encoding);
    }

    fn pyramid(&self, encoding: Encoding) -> &Pyramid {
        match encoding {
            Encoding::Srgb => {
                self.srgb.get_or_init(|| Pyramid::of(&self.plane, linear_copy(&self.plane), encoding))
            }
            Encoding::Linear => self.linear.get_or_init(|| Pyramid::of(&self.plane, None, encoding)),
        }
    }

    /// The memory that its pixels and those of the smaller copies take now.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let copies = [&self.srgb, &self.linear].map(|copies| copies.get().map_or(0, Pyramid::bytes));
        self.plane.samples.bytes() + copies.iter().sum::<usize>()
    }
}

impl PartialEq for Image {
    fn eq(&self, other: &Self) -> bool {
        self.natural == other.natural && self.plane == other.plane
    }
}

impl fmt::Debug for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Image")
            .field("size", &[self.width(), self.height()])
            .field("channels", &self.channels())
            .field("natural", &self.natural)
            .finish_non_exhaustive()
    }
}
