//! The mirror: shows what it reflects and nothing of its own.

use super::Surface;
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Coefficient, Field, FieldKind, InvalidPart, Part, Rgb, Value, Values};

/// Perfect mirror, tinted by a colour.
#[derive(Debug, Clone, PartialEq)]
pub struct Mirror {
    color: Constant3,
    reflectiveness: Coefficient,
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
        Field::required(
            "reflectiveness",
            FieldKind::Fraction,
            "",
            "Share of what is seen; the rest is black.",
        )
        .or(|| Value::Number(1.0)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let reflectiveness = Coefficient::new(given.fraction("reflectiveness")?);
        Ok(Self { color: given.color("color")?.into(), reflectiveness })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("color", Value::Color(self.color.rgb()))
            .with("reflectiveness", Value::Number(self.reflectiveness.wide))
    }
}

impl Surface for Mirror {
    fn answers_light(&self) -> bool {
        false
    }

    fn reflectiveness(&self) -> Coefficient {
        self.reflectiveness
    }

    fn reflection_color(&self) -> Constant3 {
        self.color
    }
}
