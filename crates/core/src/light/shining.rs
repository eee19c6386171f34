//! How much does a surface light shine, to which sides, and who sees it? What its three kinds have in common.

use std::f64::consts::PI;

use super::SHADOW;
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Emission, Field, FieldKind, InvalidPart, Rgb, Shape, Value, Values};

/// A surface that shines: its radiance is the same everywhere on it and in all directions.
#[derive(Debug, Clone, PartialEq)]
pub struct Lamp {
    /// The surface. Its lit side is the one that its normal points to; of a closed one the outside.
    pub shape: Shape,
    /// What it sends out.
    pub emission: Emission,
    /// Whether it is a body: seen, and in the way of other lights.
    pub visible: bool,
    /// Whether things throw shadows in its light.
    pub shadow: bool,
}

/// How much a light shines, as it was given.
#[derive(Debug, Clone, PartialEq)]
enum Output {
    /// W/(m²·sr).
    Radiance(Rgb),
    /// W in all.
    Power(Rgb),
}

/// What surface lights have in common.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shining {
    output: Output,
    /// Whether it shines to both sides; `None` for a closed surface, which has one.
    two_sided: Option<bool>,
    visible: bool,
    pub(super) shadow: bool,
    /// Radiance of the light as it is placed.
    radiance: Constant3,
}

impl Shining {
    pub(super) const RADIANCE: Field = Field::required(
        "radiance",
        FieldKind::Quantity,
        "W/(m²·sr)",
        "Radiance of its surface; give this or power.",
    )
    .instead_of("power");
    pub(super) const POWER: Field = Field::required(
        "power",
        FieldKind::Quantity,
        "W",
        "Power that it sends out in all; give this or radiance.",
    )
    .instead_of("radiance");
    pub(super) const TWO_SIDED: Field =
        Field::required("two-sided", FieldKind::Flag, "", "Whether it shines to both sides.")
            .or(|| Value::Flag(false));
    pub(super) const VISIBLE: Field = Field::required(
        "visible",
        FieldKind::Flag,
        "",
        "Whether it is a body: seen, and in the way of other lights.",
    )
    .or(|| Value::Flag(true));
    pub(super) const SHADOW: Field = SHADOW;

    /// Of a light with `area` square metres of surface on each side.
    pub(super) fn given(given: &Given<'_>, area: f64, closed: bool) -> Result<Self, InvalidPart> {
        let output = match (given.has("radiance"), given.has("power")) {
            (true, false) => Output::Radiance(given.quantity("radiance")?),
            (false, true) => Output::Power(given.quantity("power")?),
            (true, true) => {
                return Err(InvalidPart::new("power", "must be given alone", "beside radiance"));
            }
            (false, false) => {
                return Err(InvalidPart::new("radiance", "must be given, or power", "missing"));
            }
        };
        let two_sided = if closed { None } else { Some(given.flag("two-sided")?) };
        let (visible, shadow) = (given.flag("visible")?, given.flag("shadow")?);
        Self { output, two_sided, visible, shadow, radiance: Rgb::BLACK.into() }.with_area(area)
    }

    /// The same light once its surface has an area of so many square metres on each side.
    ///
    /// # Errors
    /// A power whose radiance is past every number.
    pub(super) fn with_area(self, area: f64) -> Result<Self, InvalidPart> {
        let radiance = match self.output {
            Output::Radiance(radiance) => radiance,
            Output::Power(power) => power * (1.0 / self.spread(area)),
        };
        let largest = f64::from(f32::MAX);
        if !radiance.all(|channel| (0.0..=largest).contains(&channel)) {
            let found = format!("{:e} W/(m²·sr)", radiance.max_channel());
            return Err(InvalidPart::new("power", "must give a radiance of at most 3.4e38", found));
        }
        Ok(Self { radiance: radiance.into(), ..self })
    }

    /// m²·sr that a surface of so many square metres on each side spreads its power over: π for each square metre that
    /// shines, as the cosine is integrated over a hemisphere.
    fn spread(&self, area: f64) -> f64 {
        let sides = if self.two_sided == Some(true) { 2.0 } else { 1.0 };
        PI * area * sides
    }

    /// What the field would be, were it given in place of the one that is, for a light with `area` square metres of
    /// surface on each side; `None` for fields that are no output.
    pub(super) fn equivalent(&self, field: &str, area: f64) -> Option<Value> {
        let radiance = self.radiance.rgb();
        match (field, &self.output) {
            ("radiance", _) => Some(Value::Color(radiance)),
            ("power", Output::Power(power)) => Some(Value::Color(*power)),
            ("power", Output::Radiance(_)) => Some(Value::Color(radiance * self.spread(area))),
            _ => None,
        }
    }

    /// The values after those of the shape.
    pub(super) fn add_to(&self, values: Values) -> Values {
        let values = match self.output {
            Output::Radiance(radiance) => values.with("radiance", Value::Color(radiance)),
            Output::Power(power) => values.with("power", Value::Color(power)),
        };
        let values = match self.two_sided {
            Some(two_sided) => values.with("two-sided", Value::Flag(two_sided)),
            None => values,
        };
        values.with("visible", Value::Flag(self.visible)).with("shadow", Value::Flag(self.shadow))
    }

    /// W/(m²·sr) per channel.
    pub(super) fn radiance(&self) -> &Constant3 {
        &self.radiance
    }

    /// The surface that shines so.
    pub(super) fn on(&self, shape: impl Into<Shape>) -> Lamp {
        Lamp {
            shape: shape.into(),
            emission: Emission { radiance: self.radiance.rgb(), two_sided: self.two_sided == Some(true) },
            visible: self.visible,
            shadow: self.shadow,
        }
    }
}
