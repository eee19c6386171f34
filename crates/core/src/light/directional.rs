//! Parallel light from infinity.

use glam::DVec3;

use super::{Arrival, Emitter, SHADOW};
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// Light that travels along one direction everywhere and does not fall off.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectionalLight {
    direction: DVec3,
    to_light: Constant3,
    irradiance: Constant3,
    shadow: bool,
}

impl DirectionalLight {
    /// Travelling along `direction` (any length), with an irradiance in W/m² per channel at normal incidence.
    ///
    /// # Errors
    /// A direction that is zero or not finite, a channel that is negative or not finite.
    pub fn new(direction: DVec3, irradiance: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(
            &Values::new()
                .with("direction", Value::Vector(direction))
                .with("irradiance", Value::Color(irradiance)),
        )
    }
}

impl Part for DirectionalLight {
    const NAME: &'static str = "directional-light";
    const DOC: &'static str = "Parallel light from infinity, such as the sun's.";
    const FIELDS: &'static [Field] = &[
        Field::required("direction", FieldKind::Direction, "", "The way the light travels."),
        Field::required(
            "irradiance",
            FieldKind::Quantity,
            "W/m²",
            "Irradiance on a surface that faces the light.",
        ),
        SHADOW,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let direction = given.direction("direction")?;
        Ok(Self {
            direction,
            to_light: (-direction.normalize()).into(),
            irradiance: given.quantity("irradiance")?.into(),
            shadow: given.flag("shadow")?,
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("direction", Value::Vector(self.direction))
            .with("irradiance", Value::Color(self.irradiance.rgb()))
            .with("shadow", Value::Flag(self.shadow))
    }
}

impl Emitter for DirectionalLight {
    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        let like = point.x;
        let to_light = Triple::of(like, &self.to_light);
        Arrival {
            direction: to_light,
            to_light,
            inverse_distance: like.number(1.0),
            distance: like.number(f64::INFINITY),
            strength: like.number(1.0),
            lit: like.number(0.0).less(like.number(1.0)),
        }
    }

    fn color(&self) -> &Constant3 {
        &self.irradiance
    }

    fn placed(&self, placement: &Placement) -> Self {
        let direction = placement.direction(self.direction);
        Self { direction, to_light: (-direction.normalize()).into(), ..self.clone() }
    }

    fn direction(&self) -> Option<DVec3> {
        Some(-self.to_light.vector())
    }

    fn shadow(&self) -> bool {
        self.shadow
    }
}
