//! What is a colour or a fraction of a material, where a texture may multiply it?

use super::{Channel, Texel, Texture, TexturePoint};
use crate::lane::Constant3;
use crate::{Rgb, TextureId, Value};

/// By which texture a value is multiplied.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct TextureUse {
    /// Which texture of the scene.
    pub texture: TextureId,
    /// Which number of its texels multiplies a fraction; `None` for the first one, and for colours.
    pub channel: Option<Channel>,
}

impl TextureUse {
    /// All of a texture's colour, or its red for a fraction.
    #[must_use]
    pub const fn of(texture: TextureId) -> Self {
        Self { texture, channel: None }
    }
}

/// Where textures are found by their ids.
pub trait TextureSource {
    /// A texture; `None` where there is none of that id.
    fn texture(&self, id: TextureId) -> Option<&Texture>;

    /// What a texture answers at a point; white where there is none.
    fn texel(&self, id: TextureId, at: &TexturePoint) -> Texel {
        self.texture(id).map_or(Texel::WHITE, |texture| texture.texel(at))
    }
}

/// Every texture is half grey: under it a material has all the lobes that it can have.
pub(crate) struct HalfGrey;

impl TextureSource for HalfGrey {
    fn texture(&self, _: TextureId) -> Option<&Texture> {
        None
    }

    fn texel(&self, _: TextureId, _: &TexturePoint) -> Texel {
        Texel { color: Rgb::grey(0.5), alpha: 0.5 }
    }
}

/// A colour or an amount of light, times a texture if there is one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint {
    base: Constant3,
    texture: Option<TextureUse>,
}

impl From<Rgb> for Paint {
    fn from(color: Rgb) -> Self {
        Self::new(color, None)
    }
}

/// The texture as it is: white times it.
impl From<TextureId> for Paint {
    fn from(texture: TextureId) -> Self {
        Self::new(Rgb::WHITE, Some(TextureUse::of(texture)))
    }
}

impl From<Paint> for Value {
    fn from(paint: Paint) -> Self {
        paint.value()
    }
}

impl Paint {
    /// A colour, times a texture.
    #[must_use]
    pub fn new(color: Rgb, texture: Option<TextureUse>) -> Self {
        Self { base: color.into(), texture }
    }

    /// The colour that the texture multiplies, in both precisions.
    #[inline(always)]
    #[must_use]
    pub const fn base(&self) -> &Constant3 {
        &self.base
    }

    /// The colour that the texture multiplies.
    #[must_use]
    pub fn rgb(&self) -> Rgb {
        self.base.rgb()
    }

    /// The texture, if there is one.
    #[must_use]
    pub const fn texture(&self) -> Option<TextureUse> {
        self.texture
    }

    /// Whether it differs from point to point.
    #[must_use]
    pub const fn is_textured(&self) -> bool {
        self.texture.is_some()
    }

    /// As a material's value.
    #[must_use]
    pub fn value(&self) -> Value {
        textured(Value::Color(self.rgb()), self.texture)
    }

    /// The reflectance at a point, each channel in 0..=1 whatever the texture holds.
    #[must_use]
    pub fn at(&self, textures: &impl TextureSource, point: &TexturePoint) -> Rgb {
        self.light_at(textures, point).map(|v| v.min(1.0))
    }

    /// The amount of light at a point, at least 0.
    #[must_use]
    pub fn light_at(&self, textures: &impl TextureSource, point: &TexturePoint) -> Rgb {
        match self.texture {
            Some(by) => (self.rgb() * textures.texel(by.texture, point).color).map(|v| v.max(0.0)),
            None => self.rgb(),
        }
    }

    /// The same without a texture: with the reflectance at a point.
    #[must_use]
    pub fn resolved(&self, textures: &impl TextureSource, point: &TexturePoint) -> Self {
        if self.is_textured() { self.at(textures, point).into() } else { *self }
    }

    /// The same without a texture: with the amount of light at a point.
    #[must_use]
    pub fn resolved_light(&self, textures: &impl TextureSource, point: &TexturePoint) -> Self {
        if self.is_textured() { self.light_at(textures, point).into() } else { *self }
    }
}

/// A fraction, times one channel of a texture if there is one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    base: f64,
    texture: Option<TextureUse>,
}

impl From<f64> for Level {
    fn from(base: f64) -> Self {
        Self::new(base, None)
    }
}

/// The first number of a texture as it is.
impl From<TextureId> for Level {
    fn from(texture: TextureId) -> Self {
        Self::new(1.0, Some(TextureUse::of(texture)))
    }
}

impl From<Level> for Value {
    fn from(level: Level) -> Self {
        level.value()
    }
}

impl Level {
    /// A fraction in 0..=1, times a texture.
    #[must_use]
    pub const fn new(base: f64, texture: Option<TextureUse>) -> Self {
        Self { base, texture }
    }

    /// The fraction that the texture multiplies.
    #[must_use]
    pub const fn base(&self) -> f64 {
        self.base
    }

    /// The texture, if there is one.
    #[must_use]
    pub const fn texture(&self) -> Option<TextureUse> {
        self.texture
    }

    /// Whether it differs from point to point.
    #[must_use]
    pub const fn is_textured(&self) -> bool {
        self.texture.is_some()
    }

    /// As a material's value.
    #[must_use]
    pub fn value(&self) -> Value {
        textured(Value::Number(self.base), self.texture)
    }

    /// The fraction at a point, in 0..=1 whatever the texture holds.
    #[must_use]
    pub fn at(&self, textures: &impl TextureSource, point: &TexturePoint) -> f64 {
        match self.texture {
            Some(by) => {
                let factor = by.channel.unwrap_or_default().of(textures.texel(by.texture, point));
                (self.base * factor).clamp(0.0, 1.0)
            }
            None => self.base,
        }
    }

    /// The same without a texture: with the fraction at a point.
    #[must_use]
    pub fn resolved(&self, textures: &impl TextureSource, point: &TexturePoint) -> Self {
        if self.is_textured() { self.at(textures, point).into() } else { *self }
    }
}

fn textured(value: Value, texture: Option<TextureUse>) -> Value {
    match texture {
        Some(by) => value.textured(by),
        None => value,
    }
}
