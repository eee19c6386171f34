//! Two colours in squares, over texture coordinates; on average over what a pixel shows.

use super::transform::{Flat, Transform};
use super::{Pattern, Texel, TexturePoint, mixed};
use crate::material::{Coordinate, mean_sign};
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Part, Rgb, Value, Values};

/// `color` where `⌊u⌋ + ⌊v⌋` is odd, `other` where it is even.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckerTexture {
    color: Rgb,
    other: Rgb,
    pub(super) transform: Transform,
}

impl CheckerTexture {
    /// Squares of two colours, 1 wide in texture coordinates; [`with`](Part::with) sets its `mapping`, `scale`,
    /// `offset` and `turn`.
    ///
    /// # Errors
    /// A channel outside 0..=1.
    pub fn new(color: Rgb, other: Rgb) -> Result<Self, InvalidPart> {
        let colors = Values::new().with("color", Value::Color(color)).with("other", Value::Color(other));
        crate::part::make(&colors)
    }
}

impl Part for CheckerTexture {
    const NAME: &'static str = "checker-texture";
    const DOC: &'static str = "Two colours in squares.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "Colour of the odd squares.")
            .or(|| Value::Color(Rgb::WHITE)),
        Field::required("other", FieldKind::Color, "", "Colour of the even squares.")
            .or(|| Value::Color(Rgb::BLACK)),
        Transform::MAPPING,
        Transform::SCALE,
        Transform::OFFSET,
        Transform::TURN,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self {
            color: given.color("color")?,
            other: given.color("other")?,
            transform: Transform::given(given)?,
        })
    }

    fn values(&self) -> Values {
        let colors =
            Values::new().with("color", Value::Color(self.color)).with("other", Value::Color(self.other));
        self.transform.values(colors)
    }
}

impl Pattern for CheckerTexture {
    fn texel(&self, at: &TexturePoint) -> Texel {
        let Flat { uv, footprint } = self.transform.flat(at);
        let [across, down] = footprint.unwrap_or_default();
        let coordinate = |at: f64, slopes: [f64; 2]| Coordinate { at, slopes, bends: [0.0; 2] };
        let (u, v) = (coordinate(uv.x, [across.x, down.x]), coordinate(uv.y, [across.y, down.y]));
        let odd = match footprint {
            Some(_) => 0.5 - 0.5 * mean_sign(&u, &v),
            None => (uv.x.floor() + uv.y.floor()).rem_euclid(2.0),
        };
        let odd = if odd.is_finite() { odd } else { 0.5 };
        Texel::opaque(mixed(self.other, self.color, odd))
    }
}
