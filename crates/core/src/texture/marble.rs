//! Veins: waves along x that turbulence bends.

use std::f64::consts::{PI, TAU};

use super::fractal::{MEAN_MAGNITUDE, octaves};
use super::transform::Transform;
use super::{Pattern, Texel, TexturePoint, mixed};
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Part, Rgb, Value, Values};

/// Octaves of the turbulence.
const OCTAVES: u32 = 6;

/// A cosine of x + turbulence · t, where t is the sum of the magnitudes of octaves of noise (Perlin, "An Image Synthesizer",
/// SIGGRAPH 1985). `other` lies in the veins.
#[derive(Debug, Clone, PartialEq)]
pub struct MarbleTexture {
    color: Rgb,
    other: Rgb,
    frequency: f64,
    turbulence: f64,
    transform: Transform,
}

impl MarbleTexture {
    /// Stone of one colour with veins of another, so many in a metre along x; [`with`](Part::with) sets its
    /// `turbulence`, `mapping`, `scale`, `offset` and `turn`.
    ///
    /// # Errors
    /// A channel outside 0..=1, a frequency that is not positive.
    pub fn new(color: Rgb, other: Rgb, frequency: f64) -> Result<Self, InvalidPart> {
        let colors = Values::new().with("color", Value::Color(color)).with("other", Value::Color(other));
        crate::part::make(&colors.with("frequency", Value::Number(frequency)))
    }
}

impl Part for MarbleTexture {
    const NAME: &'static str = "marble-texture";
    const DOC: &'static str = "Veins across x, bent by turbulence.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "Colour of the stone.")
            .or(|| Value::Color(Rgb::grey(0.9))),
        Field::required("other", FieldKind::Color, "", "Colour of the veins.")
            .or(|| Value::Color(Rgb::new(0.12, 0.13, 0.16))),
        Field::required("frequency", FieldKind::Length, "", "Veins in a unit.").or(|| Value::Number(1.0)),
        Field::required("turbulence", FieldKind::Number, "", "How far veins are bent, in veins, at least 0.")
            .or(|| Value::Number(4.0)),
        Transform::SOLID_MAPPING,
        Transform::SCALE,
        Transform::OFFSET,
        Transform::TURN,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self {
            color: given.color("color")?,
            other: given.color("other")?,
            frequency: given.positive("frequency")?,
            turbulence: given.not_negative("turbulence")?,
            transform: Transform::given_solid(given)?,
        })
    }

    fn values(&self) -> Values {
        let own = Values::new()
            .with("color", Value::Color(self.color))
            .with("other", Value::Color(self.other))
            .with("frequency", Value::Number(self.frequency))
            .with("turbulence", Value::Number(self.turbulence));
        self.transform.values(own)
    }
}

impl Pattern for MarbleTexture {
    fn texel(&self, at: &TexturePoint) -> Texel {
        let place = self.transform.solid(at).times(self.frequency);
        let turbulence = octaves(&place, OCTAVES, MEAN_MAGNITUDE, f64::abs);
        let across = place.position.x + self.turbulence * turbulence;
        let width = place.spread[0].x.abs() + place.spread[1].x.abs();
        let wave = (TAU * across).cos() * box_filter(width);
        let wave = if wave.is_finite() { wave } else { 0.0 };
        Texel::opaque(mixed(self.other, self.color, 0.5 - 0.5 * wave))
    }
}

/// How much is left of a wave of length 1 on average over a stretch of that width.
fn box_filter(width: f64) -> f64 {
    if width > 1e-9 { (PI * width).sin() / (PI * width) } else { 1.0 }
}
