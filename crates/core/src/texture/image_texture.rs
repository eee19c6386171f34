//! A picture as a texture.

use super::image::{Encoding, Filter, Wrap};
use super::transform::Transform;
use super::{Pattern, Texel, TexturePoint};
use crate::part::Given;
use crate::{Field, FieldKind, ImageSource, InvalidPart, Part, Value, Values};

/// A picture whose lower left corner lies at uv 0 0 and its upper right corner at 1 1.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageTexture {
    source: ImageSource,
    wrap: Wrap,
    /// Below and above, where that is another.
    wrap_v: Option<Wrap>,
    filter: Filter,
    /// Index in the list of words.
    color_space: usize,
    encoding: Encoding,
    transform: Transform,
}

const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];
const WRAP_WORDS: &[&str] = &["repeat", "mirror", "clamp"];
const FILTERS: [Filter; 3] = [Filter::Nearest, Filter::Linear, Filter::Ewa];
const FILTER_WORDS: &[&str] = &["nearest", "linear", "ewa"];
const SPACES: [Option<Encoding>; 3] = [None, Some(Encoding::Srgb), Some(Encoding::Linear)];
const SPACE_WORDS: &[&str] = &["auto", "srgb", "linear"];

impl ImageTexture {
    /// A picture over texture coordinates 0 to 1, repeated beyond; [`with`](Part::with) sets its `wrap`, `wrap-v`,
    /// `filter`, `color-space`, `mapping`, `scale`, `offset` and `turn`. Builds the picture's smaller copies, if that
    /// has not been done yet.
    ///
    /// ```
    /// use std::sync::Arc;
    ///
    /// use catoptra_core::{ImageSource, texture::{Image, ImageTexture}};
    ///
    /// let image = Image::from_bytes([2, 1], 3, vec![255, 0, 0, 0, 0, 255])?;
    /// // The path is what scene text names when the scene is saved; the crate `catoptra_scene` reads files.
    /// let texture = ImageTexture::new(ImageSource { path: "two.png".to_owned(), image: Arc::new(image) })?;
    /// assert_eq!(texture.source().image.width(), 2);
    /// # Ok::<(), catoptra_core::InvalidPart>(())
    /// ```
    ///
    /// # Errors
    /// None as long as every picture can be a texture: what is no picture, [`Image`](super::Image) has refused.
    pub fn new(source: ImageSource) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("file", Value::Image(source)))
    }

    /// The picture and the file it came from.
    #[must_use]
    pub fn source(&self) -> &ImageSource {
        &self.source
    }

    /// How its numbers stand for light.
    #[must_use]
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }
}

impl Part for ImageTexture {
    const NAME: &'static str = "image-texture";
    const DOC: &'static str = "A picture from a file.";
    const FIELDS: &'static [Field] = &[
        Field::required(
            "file",
            FieldKind::Image,
            "",
            "PNG, JPEG, WebP, EXR or HDR file, relative to the scene's folder.",
        ),
        Field::required("wrap", FieldKind::Choice(WRAP_WORDS), "", "What lies beyond the picture.")
            .or(|| Value::Word("repeat".to_owned())),
        Field::required(
            "wrap-v",
            FieldKind::Choice(WRAP_WORDS),
            "",
            "What lies below and above it, if not the same as beside it.",
        )
        .optional(),
        Field::required("filter", FieldKind::Choice(FILTER_WORDS), "", "How it is averaged over a pixel.")
            .or(|| Value::Word("ewa".to_owned())),
        Field::required(
            "color-space",
            FieldKind::Choice(SPACE_WORDS),
            "",
            "How its numbers stand for light.",
        )
        .or(|| Value::Word("auto".to_owned())),
        Transform::MAPPING,
        Transform::SCALE,
        Transform::OFFSET,
        Transform::TURN,
    ];

    /// Builds the picture's smaller copies, if that has not been done yet.
    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let source = given.image("file")?;
        let color_space = given.choice("color-space")?;
        let encoding = SPACES[color_space].unwrap_or(source.image.natural_encoding());
        let filter = FILTERS[given.choice("filter")?];
        let (wrap, transform) = (WRAPS[given.choice("wrap")?], Transform::given(given)?);
        let has_wrap_v = given.has("wrap-v");
        let wrap_v = if has_wrap_v { Some(WRAPS[given.choice("wrap-v")?]) } else { None };
        source.image.prepare(encoding);
        Ok(Self { source, wrap, wrap_v, filter, color_space, encoding, transform })
    }

    fn values(&self) -> Values {
        let word = |words: &[&str], i: usize| Value::Word(words[i].to_owned());
        let mut own = Values::new()
            .with("file", Value::Image(self.source.clone()))
            .with("wrap", word(WRAP_WORDS, self.wrap as usize));
        if let Some(wrap) = self.wrap_v {
            own.set("wrap-v", word(WRAP_WORDS, wrap as usize));
        }
        own.set("filter", word(FILTER_WORDS, self.filter as usize));
        own.set("color-space", word(SPACE_WORDS, self.color_space));
        self.transform.values(own)
    }
}

impl Pattern for ImageTexture {
    fn texel(&self, at: &TexturePoint) -> Texel {
        let place = self.transform.flat(at);
        let levels = self.source.image.levels(self.encoding);
        let wrap = [self.wrap, self.wrap_v.unwrap_or(self.wrap)];
        levels.filtered(wrap, self.filter, place.uv, place.footprint, at.stochastic)
    }
}
