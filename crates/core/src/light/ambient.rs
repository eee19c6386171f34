//! Light that arrives from everywhere alike.

use super::{Arrival, Emitter};
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// The same radiance from every direction; a matte surface shows it times its albedo. Never shadowed.
#[derive(Debug, Clone, PartialEq)]
pub struct AmbientLight {
    radiance: Rgb,
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
        Ok(Self { radiance: given.quantity("radiance")? })
    }

    fn values(&self) -> Values {
        Values::new().with("radiance", Value::Color(self.radiance))
    }
}

impl Emitter for AmbientLight {
    /// Nothing arrives from any one direction.
    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        let zero = Triple::splat(point.x.number(0.0));
        Arrival { towards: zero, distance: zero.x, irradiance: zero, lit: zero.x.less(zero.x) }
    }

    fn placed(&self, _: &Placement) -> Self {
        self.clone()
    }

    fn ambient(&self) -> Rgb {
        self.radiance
    }

    fn shadow(&self) -> bool {
        false
    }
}
