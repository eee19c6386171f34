//! The matte surface: light leaves alike in all directions (Lambert 1760).

use super::{REFLECTIVENESS, ShadingPoint, Surface};
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Coefficient, Field, FieldKind, InvalidPart, Lane, Part, Rgb, Triple, Value, Values};

/// Lambert surface with the BRDF `color / π`.
#[derive(Debug, Clone, PartialEq)]
pub struct Matte {
    color: Constant3,
    reflectiveness: Coefficient,
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
        REFLECTIVENESS,
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

impl Surface for Matte {
    #[inline(always)]
    fn albedo<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        Triple::of(at.distance, &self.color)
    }

    fn reflectiveness(&self) -> Coefficient {
        self.reflectiveness
    }
}
