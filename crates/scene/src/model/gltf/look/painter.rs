//! Which textures do materials take, each once however many take it?
//!
//! glTF's texture coordinates begin at the upper left corner of a picture and v grows downwards; here they begin at the lower left
//! and v grows upwards. Meshes come in with 1 − v, and transforms of coordinates are turned to match.

use std::collections::HashMap;

use catoptra_core::glam::DVec2;
use catoptra_core::part::make;
use catoptra_core::texture::{Channel, Encoding, ImageTexture, VertexColorTexture};
use catoptra_core::{ImageSource, Rgb, Texture, TextureId, TextureUse, Value, Values};

use super::pictures::{Pictures, name_of};
use crate::model::gltf::json::{Sampler, TextureInfo, TextureTransform, Whole, entry};
use crate::model::gltf::names::unique;
use crate::model::gltf::refusal::{Refusal, Within};
use crate::model::gltf::source::Source;
use crate::model::names::Names;

/// The textures of a file.
pub(super) struct Painter<'a, 's> {
    pub(super) source: &'s Source<'a>,
    pictures: Pictures<'a, 's>,
    textures: Vec<(String, Texture)>,
    known: HashMap<Key, TextureId>,
    corner_colors: Option<TextureId>,
    names: Names,
}

/// Two textures with the same key are the same.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Key {
    image: Whole,
    laid: Laid,
    is_light: bool,
}

/// How a picture is laid onto a surface, by the bits of its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Laid {
    wrap: [&'static str; 2],
    filter: &'static str,
    scale: [u64; 2],
    offset: [u64; 2],
    turn: u64,
}

impl<'a, 's> Painter<'a, 's> {
    pub(super) fn new(source: &'s Source<'a>) -> Self {
        Self {
            source,
            pictures: Pictures::new(source),
            textures: Vec::new(),
            known: HashMap::new(),
            corner_colors: None,
            names: Names::default(),
        }
    }

    pub(super) fn into_textures(self) -> Vec<(String, Texture)> {
        self.textures
    }

    /// A reflectance, times a texture in sRGB.
    pub(super) fn color(&mut self, factor: [f64; 3], by: Option<&TextureInfo>) -> Result<Value, Refusal> {
        let color = factor.map(|v| v.clamp(0.0, 1.0));
        self.painted(Value::Color(Rgb::new(color[0], color[1], color[2])), by, Encoding::Srgb, None)
    }

    /// A fraction, times one channel of a texture.
    pub(super) fn fraction(
        &mut self,
        factor: f64,
        by: Option<&TextureInfo>,
        channel: Channel,
    ) -> Result<Value, Refusal> {
        // What alpha stands for is the same in every encoding; what else is in its picture is a colour mostly.
        let encoding = if channel == Channel::Alpha { Encoding::Srgb } else { Encoding::Linear };
        self.painted(Value::Number(factor.clamp(0.0, 1.0)), by, encoding, Some(channel))
    }

    /// A value, times a texture where its picture can be shown.
    pub(super) fn painted(
        &mut self,
        value: Value,
        by: Option<&TextureInfo>,
        encoding: Encoding,
        channel: Option<Channel>,
    ) -> Result<Value, Refusal> {
        let Some(by) = by else { return Ok(value) };
        let texture = self.texture(by, encoding)?;
        Ok(match texture {
            Some(texture) => value.textured(TextureUse { texture, channel }),
            None => value,
        })
    }

    /// The texture of a picture as a material uses it; `None` for a picture that cannot be shown.
    pub(super) fn texture(
        &mut self,
        by: &TextureInfo,
        encoding: Encoding,
    ) -> Result<Option<TextureId>, Refusal> {
        let Some((image, laid)) = self.laid(by)? else { return Ok(None) };
        let key = Key { image, laid, is_light: encoding == Encoding::Srgb };
        if let Some(&known) = self.known.get(&key) {
            return Ok(Some(known));
        }
        let Some(source) = self.pictures.get(image) else { return Ok(None) };
        let document = self.source.document;
        let own = document.textures.get(by.index.index()).and_then(|texture| texture.name.clone());
        let name = own.or_else(|| document.images.get(image.index()).and_then(name_of));
        let texture = self.add(name.as_deref(), source, laid, encoding)?;
        self.known.insert(key, texture);
        Ok(Some(texture))
    }

    /// The picture behind a texture.
    pub(super) fn picture(&mut self, by: &TextureInfo) -> Result<Option<ImageSource>, Refusal> {
        let laid = self.laid(by)?;
        Ok(laid.and_then(|(image, _)| self.pictures.get(image)))
    }

    /// The texture of the colours that corners have.
    pub(super) fn corner_colors(&mut self) -> Result<TextureId, Refusal> {
        if let Some(known) = self.corner_colors {
            return Ok(known);
        }
        let texture = self.keep(Some("colours of corners"), VertexColorTexture.into())?;
        self.corner_colors = Some(texture);
        Ok(texture)
    }

    /// Adds a picture as a texture.
    pub(super) fn add(
        &mut self,
        name: Option<&str>,
        source: ImageSource,
        laid: Laid,
        encoding: Encoding,
    ) -> Result<TextureId, Refusal> {
        let texture = make::<ImageTexture>(&laid.values(source, encoding))?;
        self.keep(name, texture.into())
    }

    fn keep(&mut self, name: Option<&str>, texture: Texture) -> Result<TextureId, Refusal> {
        self.textures.push((unique(&mut self.names, name, "texture"), texture));
        let number = u32::try_from(self.textures.len()).ok();
        number.and_then(TextureId::from_index).ok_or_else(|| Refusal::new("the file has too many textures"))
    }

    /// Which picture a material uses, and how; `None` where the texture has none.
    pub(super) fn laid(&self, by: &TextureInfo) -> Result<Option<(Whole, Laid)>, Refusal> {
        let document = self.source.document;
        let texture = entry(&document.textures, by.index, "textures")?;
        let image = texture.extensions.webp.as_ref().and_then(|webp| webp.source).or(texture.source);
        let Some(image) = image else {
            let message = format!("textures[{}] is left out: it names no picture that can be read", by.index);
            self.source.warnings.add_of_file(message);
            return Ok(None);
        };
        let sampler = match texture.sampler {
            Some(index) => Some(
                entry(&document.samplers, index, "samplers").within(|| format!("textures[{}]", by.index))?,
            ),
            None => None,
        };
        Ok(Some((image, Laid::new(sampler, by.extensions.transform.as_ref()))))
    }
}

impl Laid {
    fn new(sampler: Option<&Sampler>, transform: Option<&TextureTransform>) -> Self {
        let number = |get: fn(&Sampler) -> Option<Whole>| sampler.and_then(get).map(|number| number.0);
        let wrap = |number| match number {
            Some(33071) => "clamp",
            Some(33648) => "mirror",
            _ => "repeat",
        };
        let filter = if number(|s| s.mag_filter) == Some(9728) { "nearest" } else { "ewa" };
        let [scale, offset] = transform.map_or([DVec2::ONE, DVec2::ZERO], upright);
        Self {
            wrap: [wrap(number(|s| s.wrap_s)), wrap(number(|s| s.wrap_t))],
            filter,
            scale: scale.to_array().map(f64::to_bits),
            offset: offset.to_array().map(f64::to_bits),
            turn: transform.map_or(0.0, |transform| transform.rotation).to_bits(),
        }
    }

    /// As those of an `image-texture`.
    fn values(&self, source: ImageSource, encoding: Encoding) -> Values {
        let word = |word: &str| Value::Word(word.to_owned());
        let pair = |bits: [u64; 2]| Value::Pair(DVec2::from(bits.map(f64::from_bits)));
        let [along, up] = self.wrap;
        let mut values = Values::new().with("file", Value::Image(source)).with("wrap", word(along));
        if up != along {
            values.set("wrap-v", word(up));
        }
        let space = match encoding {
            Encoding::Srgb => "srgb",
            Encoding::Linear => "linear",
        };
        values
            .with("filter", word(self.filter))
            .with("color-space", word(space))
            .with("scale", pair(self.scale))
            .with("offset", pair(self.offset))
            .with("turn", Value::Number(f64::from_bits(self.turn)))
    }
}

/// Scale and offset of a transform with v upwards; the angle stays the same.
///
/// `KHR_texture_transform` turns coordinates anticlockwise as seen with v downwards (its shader code turns them the other way,
/// against its own words, its examples and every viewer: github.com/KhronosGroup/glTF/issues/1563): u′ = c·su·u + s·sv·v + ou,
/// v′ = −s·su·u + c·sv·v + ov. With v = 1 − w and v′ = 1 − w′ that is a turn by the same angle the usual way round, and
/// another offset.
fn upright(transform: &TextureTransform) -> [DVec2; 2] {
    /// Stands for a scale of 0, which no texture takes.
    const ALL_BUT_ZERO: f64 = 1e-30;
    let [x, y] = transform.scale.unwrap_or([1.0; 2]);
    let (sine, cosine) = transform.rotation.sin_cos();
    let [right, down] = transform.offset.unwrap_or([0.0; 2]);
    let offset = DVec2::new(right + sine * y, 1.0 - down - cosine * y);
    let scale = [x, y].map(|v| if v == 0.0 { ALL_BUT_ZERO } else { v });
    [DVec2::from(scale), offset]
}
