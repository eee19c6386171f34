//! Light that arrives from everywhere alike.

use super::{Arrival, Emitter, LightVisitor, nothing_arrives};
use crate::part::Given;
use crate::{Constant3, Field, FieldKind, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// The same radiance from every direction; a matte surface shows it times its albedo. Never shadowed.
#[derive(Debug, Clone, PartialEq)]
pub struct AmbientLight {
    radiance: Constant3,
}

impl AmbientLight {
    /// With a radiance in W/(m²·sr) per channel.
    ///
    /// # Errors
    /// A channel that is negative or not finite.
    pub fn new(radiance: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("radiance", Value::Color(radiance)))
    }
}

impl Part for AmbientLight {
    const NAME: &'static str = "ambient-light";
    const DOC: &'static str = "Light that arrives from everywhere alike and throws no shadow.";
    const FIELDS: &'static [Field] = &[Field::required(
        "radiance",
        FieldKind::Quantity,
        "W/(m²·sr)",
        "Radiance from every direction; a matte surface shows it times its colour.",
    )];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self { radiance: given.quantity("radiance")?.into() })
    }

    fn values(&self) -> Values {
        Values::new().with("radiance", Value::Color(self.radiance.rgb()))
    }
}

impl Emitter for AmbientLight {
    /// Nothing arrives from any one direction.
    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        nothing_arrives(point)
    }

    #[inline(always)]
    fn accept(&self, _: impl LightVisitor) {}

    fn color(&self) -> &Constant3 {
        &self.radiance
    }

    fn placed(&self, _: &Placement) -> Self {
        self.clone()
    }

    fn ambient(&self) -> Rgb {
        self.radiance.rgb()
    }

    fn shadow(&self) -> bool {
        false
    }
}
