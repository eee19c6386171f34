//! The matte surface: light leaves alike in all directions (Lambert 1760).

use super::{MirrorShare, Surface};
use crate::part::Given;
use crate::texture::{Paint, TexturePoint, TextureSource};
use crate::{Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, Triple, Value, Values};

/// Lambert surface with the BRDF `color / π`.
#[derive(Debug, Clone, PartialEq)]
pub struct Matte {
    color: Paint,
    mirror: MirrorShare,
}

impl Matte {
    /// With an albedo in 0..=1 per channel and no reflection.
    ///
    /// # Errors
    /// A channel outside 0..=1.
    pub fn new(color: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("color", Value::Color(color)))
    }
}

impl Part for Matte {
    const NAME: &'static str = "matte";
    const DOC: &'static str = "A surface that scatters light alike in all directions.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "Share of light that is scattered (albedo)."),
        MirrorShare::FIELD,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self { color: given.paint("color")?, mirror: MirrorShare::given(given, Rgb::WHITE.into())? })
    }

    fn values(&self) -> Values {
        Values::new().with("color", self.color.value()).with("reflectiveness", self.mirror.value())
    }
}

impl Surface for Matte {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        self.mirror.over(Lobes::matte(Triple::of(at.distance, self.color.base())))
    }

    fn is_textured(&self) -> bool {
        self.color.is_textured() || self.mirror.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self { color: self.color.resolved(textures, at), mirror: self.mirror.resolved(textures, at) }
    }
}
