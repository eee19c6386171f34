//! The mirror: shows what it reflects and nothing of its own.

use super::{MirrorShare, Surface};
use crate::part::Given;
use crate::texture::{TexturePoint, TextureSource};
use crate::{Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, Value, Values};

/// Perfect mirror, tinted by a colour.
#[derive(Debug, Clone, PartialEq)]
pub struct Mirror {
    mirror: MirrorShare,
}

impl Mirror {
    /// With a reflectance in 0..=1 per channel.
    ///
    /// # Errors
    /// A channel outside 0..=1.
    pub fn new(color: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("color", Value::Color(color)))
    }
}

impl Part for Mirror {
    const NAME: &'static str = "mirror";
    const DOC: &'static str = "A surface that shows what it reflects and nothing of its own.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "Share of light that is reflected, by channel.")
            .or(|| Value::Color(Rgb::WHITE)),
        Field { doc: "Share of what is seen; the rest is black.", ..MirrorShare::FIELD }
            .or(|| Value::Number(1.0)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self { mirror: MirrorShare::given(given, given.paint("color")?)? })
    }

    fn values(&self) -> Values {
        Values::new().with("color", self.mirror.color().value()).with("reflectiveness", self.mirror.value())
    }
}

impl Surface for Mirror {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        self.mirror.over(Lobes::none(at.distance))
    }

    fn is_textured(&self) -> bool {
        self.mirror.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self { mirror: self.mirror.resolved(textures, at) }
    }
}
