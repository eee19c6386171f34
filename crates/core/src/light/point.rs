//! Light from a point, alike in all directions.

use glam::DVec3;

use super::{Arrival, Emitter, SHADOW, from_point};
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// Light from a point: irradiance falls with the square of the distance.
#[derive(Debug, Clone, PartialEq)]
pub struct PointLight {
    position: Constant3,
    intensity: Constant3,
    shadow: bool,
}

impl PointLight {
    /// At `position`, with an intensity in W/sr per channel.
    ///
    /// # Errors
    /// A position that is not finite, a channel that is negative or not finite.
    pub fn new(position: DVec3, intensity: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(
            &Values::new()
                .with("position", Value::Vector(position))
                .with("intensity", Value::Color(intensity)),
        )
    }
}

impl Part for PointLight {
    const NAME: &'static str = "point-light";
    const DOC: &'static str = "Light from a point, alike in all directions.";
    const FIELDS: &'static [Field] = &[
        Field::required("position", FieldKind::Point, "m", "Where the light stands.")
            .or(|| Value::Vector(DVec3::ZERO)),
        Field::required("intensity", FieldKind::Quantity, "W/sr", "Power per solid angle."),
        SHADOW,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self {
            position: given.point("position")?.into(),
            intensity: given.quantity("intensity")?.into(),
            shadow: given.flag("shadow")?,
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("position", Value::Vector(self.position.vector()))
            .with("intensity", Value::Color(self.intensity.rgb()))
            .with("shadow", Value::Flag(self.shadow))
    }
}

impl Emitter for PointLight {
    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        from_point(Triple::of(point.x, &self.position), point)
    }

    fn color(&self) -> &Constant3 {
        &self.intensity
    }

    fn placed(&self, placement: &Placement) -> Self {
        Self { position: placement.point(self.position.vector()).into(), ..self.clone() }
    }

    fn position(&self) -> Option<DVec3> {
        Some(self.position.vector())
    }

    fn shadow(&self) -> bool {
        self.shadow
    }
}
