//! Two matte colours in squares, by position.

use super::{LAMBERT, REFLECTIVENESS, ShadingPoint, Surface};
use crate::lane::Constant3;
use crate::numeric::PATTERN_SHIFT;
use crate::part::Given;
use crate::{Coefficient, Field, FieldKind, InvalidPart, Lane, Part, Rgb, Triple, Value, Values};

/// Matte; `color` where `|⌊x·scale⌋ + ⌊z·scale⌋|` is odd, `other` where it is even. On any shape, by position.
#[derive(Debug, Clone, PartialEq)]
pub struct Checker {
    color: Constant3,
    other: Constant3,
    scale: Coefficient,
    reflectiveness: Coefficient,
}

impl Checker {
    /// With two albedos and the number of squares per metre.
    ///
    /// # Errors
    /// A channel outside 0..=1, a scale that is not positive.
    pub fn new(color: Rgb, other: Rgb, scale: f64) -> Result<Self, InvalidPart> {
        crate::part::make(
            &Values::new()
                .with("color", Value::Color(color))
                .with("other", Value::Color(other))
                .with("scale", Value::Number(scale)),
        )
    }

    #[inline(always)]
    fn albedo<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        let scale = at.distance.of(self.scale);
        let shift = at.distance.number(PATTERN_SHIFT);
        let cell = at.position.x.mul_add(scale, shift).floor() + at.position.z.mul_add(scale, shift).floor();
        let half = cell * cell.number(0.5);
        let odd = cell.number(0.25).less(half - half.floor());
        Triple::select(odd, Triple::of(cell, &self.color), Triple::of(cell, &self.other))
    }
}

impl Part for Checker {
    const NAME: &'static str = "checker";
    const DOC: &'static str = "Two matte colours in squares, by position over the ground.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "Albedo of the odd squares.")
            .or(|| Value::Color(Rgb::WHITE)),
        Field::required("other", FieldKind::Color, "", "Albedo of the even squares.")
            .or(|| Value::Color(Rgb::BLACK)),
        Field::required("scale", FieldKind::Length, "1/m", "Squares per metre.").or(|| Value::Number(1.0)),
        REFLECTIVENESS,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self {
            color: given.color("color")?.into(),
            other: given.color("other")?.into(),
            scale: Coefficient::new(given.positive("scale")?),
            reflectiveness: Coefficient::new(given.fraction("reflectiveness")?),
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("color", Value::Color(self.color.rgb()))
            .with("other", Value::Color(self.other.rgb()))
            .with("scale", Value::Number(self.scale.wide))
            .with("reflectiveness", Value::Number(self.reflectiveness.wide))
    }
}

impl Surface for Checker {
    #[inline(always)]
    fn under_ambient<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        self.albedo(at)
    }

    #[inline(always)]
    fn under_light<L: Lane>(&self, at: &ShadingPoint<L>, _towards: Triple<L>, cosine: L) -> Triple<L> {
        self.albedo(at).scale(cosine * cosine.of(LAMBERT))
    }

    fn reflectiveness(&self) -> Coefficient {
        self.reflectiveness
    }
}
