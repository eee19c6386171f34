//! Colour that fades to black with distance, tinted by the normal; needs no light.

use super::{MirrorShare, Surface};
use crate::part::Given;
use crate::texture::{Paint, TexturePoint, TextureSource};
use crate::{
    Coefficient, Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, Triple, Value, Values,
};

/// Shows `color * (10 n + 255 − min(distance * 255 / range, 255)) / 255` per channel, at least 0, where `n` is the
/// unit normal on the viewer's side.
#[derive(Debug, Clone, PartialEq)]
pub struct Depth {
    color: Paint,
    range: f64,
    inverse_range: Coefficient,
    mirror: MirrorShare,
}

/// How much of a unit normal shows: 10 of 255.
const TINT: Coefficient = Coefficient::new(10.0 / 255.0);

impl Part for Depth {
    const NAME: &'static str = "depth";
    const DOC: &'static str =
        "Colour that fades to black with distance, tinted by the normal; needs no light.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "What is seen close by."),
        Field::required("range", FieldKind::Length, "m", "Distance at which it has faded to black.")
            .or(|| Value::Number(30.0)),
        MirrorShare::FIELD,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let range = given.positive("range")?;
        Ok(Self {
            color: given.paint("color")?,
            range,
            inverse_range: Coefficient::new(1.0 / range),
            mirror: MirrorShare::given(given, Rgb::WHITE.into())?,
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("color", self.color.value())
            .with("range", Value::Number(self.range))
            .with("reflectiveness", self.mirror.value())
    }
}

impl Depth {
    /// With what is seen close by, and the distance at which it has faded to black.
    ///
    /// # Errors
    /// A channel outside 0..=1, a range that is not positive.
    pub fn new(color: Rgb, range: f64) -> Result<Self, InvalidPart> {
        crate::part::make(
            &Values::new().with("color", Value::Color(color)).with("range", Value::Number(range)),
        )
    }
}

impl Surface for Depth {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        let (zero, one) = (at.distance.number(0.0), at.distance.number(1.0));
        let near = one - (at.distance * at.distance.of(self.inverse_range)).min(one);
        let shown = at.normal.scale_add(at.distance.of(TINT), Triple::splat(near));
        let shown = Triple::new(shown.x.max(zero), shown.y.max(zero), shown.z.max(zero));
        let emission = shown.times(Triple::of(at.distance, self.color.base()));
        self.mirror.over(Lobes { emission, ..Lobes::none(at.distance) })
    }

    fn is_textured(&self) -> bool {
        self.color.is_textured() || self.mirror.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self {
            color: self.color.resolved(textures, at),
            mirror: self.mirror.resolved(textures, at),
            range: self.range,
            inverse_range: self.inverse_range,
        }
    }
}
