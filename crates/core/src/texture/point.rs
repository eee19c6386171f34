//! Where is a texture asked, over what is it averaged, and what does it answer?

use glam::{DVec2, DVec3};

use crate::Rgb;

/// Where on a surface a texture is looked up. Numbers that are not finite give some value of the texture, never NaN.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TexturePoint {
    /// Texture coordinates of the surface; u to the right, v upwards.
    pub uv: DVec2,
    /// The point, metres, in the shape's own space (before its placement), so that patterns move with the shape.
    pub position: DVec3,
    /// Unit normal in the shape's own space; only box mapping asks for it.
    pub normal: DVec3,
    /// What the shape itself has of colour there, linear Rec. 709; `None` where it has none.
    pub color: Option<Rgb>,
    /// How far `uv` moves over one pixel to the right and one down. `None` asks for the point alone.
    pub footprint: Option<[DVec2; 2]>,
    /// How far `position` moves over one pixel to the right and one down: what `footprint` is to `uv`, for what is mapped by
    /// position.
    pub spread: Option<[DVec3; 2]>,
    /// Two numbers in 0..1: of a picture one texel is chosen by them, each as often as it weighs in the filter.
    pub stochastic: Option<[f64; 2]>,
}

impl TexturePoint {
    /// A point by its texture coordinates alone.
    #[must_use]
    pub fn at_uv(uv: DVec2) -> Self {
        Self { uv, ..Self::default() }
    }

    /// A point by its position alone.
    #[must_use]
    pub fn at_position(position: DVec3) -> Self {
        Self { position, ..Self::default() }
    }
}

/// What a texture answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Texel {
    /// Linear Rec. 709; not multiplied by `alpha`.
    pub color: Rgb,
    /// How opaque, 0..=1; 1 where the texture does not say.
    pub alpha: f64,
}

impl Texel {
    /// What changes nothing.
    pub const WHITE: Self = Self::opaque(Rgb::WHITE);

    /// A colour without transparency.
    #[must_use]
    pub const fn opaque(color: Rgb) -> Self {
        Self { color, alpha: 1.0 }
    }
}

/// Which number of a texel a fraction is multiplied by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Channel {
    /// Red.
    #[default]
    Red,
    /// Green; roughness in glTF.
    Green,
    /// Blue; metalness in glTF.
    Blue,
    /// Alpha.
    Alpha,
    /// Luminance (ITU-R BT.709).
    Luminance,
}

impl Channel {
    /// Every channel.
    pub const ALL: [Self; 5] = [Self::Red, Self::Green, Self::Blue, Self::Alpha, Self::Luminance];

    /// Its word in scene text.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Red => "r",
            Self::Green => "g",
            Self::Blue => "b",
            Self::Alpha => "a",
            Self::Luminance => "luminance",
        }
    }

    /// The channel of that word.
    #[must_use]
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|channel| channel.word() == word)
    }

    /// That number of a texel.
    #[must_use]
    pub fn of(self, texel: Texel) -> f64 {
        match self {
            Self::Red => texel.color.r,
            Self::Green => texel.color.g,
            Self::Blue => texel.color.b,
            Self::Alpha => texel.alpha,
            Self::Luminance => texel.color.luminance(),
        }
    }
}
