//! A surface that shines by itself.

use super::{Emission, Surface};
use crate::part::Given;
use crate::texture::{Paint, TexturePoint, TextureSource};
use crate::{Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, Triple, Value, Values};

/// Shines with the same radiance everywhere and in all directions: to the side that its shape's normal points to (of a
/// closed shape the outside), or to both. It reflects nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Emissive {
    radiance: Paint,
    two_sided: bool,
}

impl Emissive {
    /// With a radiance in W/(m²·sr) per channel, to one side.
    ///
    /// # Errors
    /// A channel that is negative or not finite.
    pub fn new(radiance: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("radiance", Value::Color(radiance)))
    }
}

impl From<Emission> for Emissive {
    fn from(emission: Emission) -> Self {
        Self { radiance: emission.radiance.into(), two_sided: emission.two_sided }
    }
}

impl Part for Emissive {
    const NAME: &'static str = "emissive";
    const DOC: &'static str = "A surface that shines, and lights others.";
    const FIELDS: &'static [Field] = &[
        Field::required(
            "radiance",
            FieldKind::Quantity,
            "W/(m²·sr)",
            "Radiance that is seen, and that lights others.",
        ),
        Field::required("two-sided", FieldKind::Flag, "", "Whether it shines to both sides.")
            .or(|| Value::Flag(false)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self { radiance: given.light("radiance")?, two_sided: given.flag("two-sided")? })
    }

    fn values(&self) -> Values {
        Values::new().with("radiance", self.radiance.value()).with("two-sided", Value::Flag(self.two_sided))
    }
}

impl Surface for Emissive {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        let radiance = Triple::of(at.distance, self.radiance.base());
        let dark = Triple::splat(at.distance.number(0.0));
        let emission = if self.two_sided { radiance } else { Triple::select(at.front, radiance, dark) };
        Lobes { emission, ..Lobes::none(at.distance) }
    }

    fn emission(&self) -> Option<Emission> {
        Some(Emission { radiance: self.radiance.rgb(), two_sided: self.two_sided })
    }

    fn emission_is_textured(&self) -> bool {
        self.radiance.is_textured()
    }

    fn is_textured(&self) -> bool {
        self.radiance.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self { radiance: self.radiance.resolved_light(textures, at), two_sided: self.two_sided }
    }
}
