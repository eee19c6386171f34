//! Clouds: octaves of gradient noise between two colours.

use super::fractal::octaves;
use super::transform::Transform;
use super::{Pattern, Texel, TexturePoint, mixed};
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Part, Rgb, Value, Values};

/// The most octaves: 2¹⁵ to 1 in size from the coarsest to the finest.
const MOST_OCTAVES: u32 = 16;

/// Fractional Brownian motion: octaves of gradient noise, each twice as fine and half as strong as the one before. Its mean
/// is the colour halfway between the two, from which it is off by 0.15 of their difference (root mean square, measured).
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseTexture {
    color: Rgb,
    other: Rgb,
    frequency: f64,
    octaves: u32,
    transform: Transform,
}

impl NoiseTexture {
    /// Clouds of one colour in another, the largest so many in a metre; [`with`](Part::with) sets its `octaves`,
    /// `mapping`, `scale`, `offset` and `turn`.
    ///
    /// # Errors
    /// A channel outside 0..=1, a frequency that is not positive.
    pub fn new(color: Rgb, other: Rgb, frequency: f64) -> Result<Self, InvalidPart> {
        let colors = Values::new().with("color", Value::Color(color)).with("other", Value::Color(other));
        crate::part::make(&colors.with("frequency", Value::Number(frequency)))
    }
}

impl Part for NoiseTexture {
    const NAME: &'static str = "noise-texture";
    const DOC: &'static str = "Clouds: octaves of gradient noise between two colours.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "Colour where the noise is high.")
            .or(|| Value::Color(Rgb::WHITE)),
        Field::required("other", FieldKind::Color, "", "Colour where the noise is low.")
            .or(|| Value::Color(Rgb::BLACK)),
        Field::required("frequency", FieldKind::Length, "", "Cells of the coarsest octave in a unit.")
            .or(|| Value::Number(1.0)),
        Field::required("octaves", FieldKind::Count, "", "How many sizes of clouds there are, 1 to 16.")
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
            octaves: given.count("octaves", [1, MOST_OCTAVES])?,
            transform: Transform::given_solid(given)?,
        })
    }

    fn values(&self) -> Values {
        let own = Values::new()
            .with("color", Value::Color(self.color))
            .with("other", Value::Color(self.other))
            .with("frequency", Value::Number(self.frequency))
            .with("octaves", Value::Number(f64::from(self.octaves)));
        self.transform.values(own)
    }
}

impl Pattern for NoiseTexture {
    fn texel(&self, at: &TexturePoint) -> Texel {
        let place = self.transform.solid(at).times(self.frequency);
        let noise = octaves(&place, self.octaves, 0.0, |v| v);
        Texel::opaque(mixed(self.other, self.color, (0.5 + noise).clamp(0.0, 1.0)))
    }
}
