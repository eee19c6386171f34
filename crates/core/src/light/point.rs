//! Light from a point: alike in all directions, or as a luminaire's profile has it.

use glam::DVec3;

use super::luminaire::{HORIZONTAL, Luminaire, PROFILE, alone, scale};
use super::{Arrival, Emitter, LightVisitor, SHADOW, from_point};
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// Light from a point: irradiance falls with the square of the distance.
#[derive(Debug, Clone, PartialEq)]
pub struct PointLight {
    bare: Bare,
    /// Apart, since few lights have one.
    luminaire: Option<Box<Hung>>,
}

/// The same light in all directions.
#[derive(Debug, Clone, PartialEq)]
struct Bare {
    position: Constant3,
    intensity: Constant3,
    shadow: bool,
}

/// A luminaire and the way its nadir points.
#[derive(Debug, Clone, PartialEq)]
struct Hung {
    luminaire: Luminaire,
    direction: Option<DVec3>,
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
    const DOC: &'static str = "Light from a point, alike in all directions or by a profile.";
    const FIELDS: &'static [Field] = &[
        Field::required("position", FieldKind::Point, "m", "Where the light stands.")
            .or(|| Value::Vector(DVec3::ZERO)),
        Field::required("direction", FieldKind::Direction, "", "Where the nadir of the profile points.")
            .optional(),
        Field::required("intensity", FieldKind::Quantity, "W/sr", "Power per solid angle."),
        PROFILE,
        HORIZONTAL,
        SHADOW,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let direction = match given.has("direction") {
            true => Some(given.direction("direction")?),
            false => None,
        };
        let luminaire = Luminaire::given(given, direction.unwrap_or(-DVec3::Y))?;
        let luminaire = match (luminaire, direction) {
            (Some(luminaire), direction) => Some(Box::new(Hung { luminaire, direction })),
            (None, Some(_)) => return Err(alone("direction")),
            (None, None) => None,
        };
        let intensity = scale(given, luminaire.is_some())?;
        let bare = Bare {
            position: given.point("position")?.into(),
            intensity: intensity.into(),
            shadow: given.flag("shadow")?,
        };
        Ok(Self { bare, luminaire })
    }

    fn values(&self) -> Values {
        let mut values = Values::new().with("position", Value::Vector(self.bare.position.vector()));
        if let Some(direction) = self.luminaire.as_ref().and_then(|hung| hung.direction) {
            values.set("direction", Value::Vector(direction));
        }
        values.set("intensity", Value::Color(self.bare.intensity.rgb()));
        if let Some(hung) = &self.luminaire {
            values = hung.luminaire.values(values);
        }
        values.with("shadow", Value::Flag(self.bare.shadow))
    }
}

impl Emitter for PointLight {
    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        let arrival = self.bare.arriving(point);
        match &self.luminaire {
            Some(hung) => hung.luminaire.shine(arrival),
            None => arrival,
        }
    }

    #[inline(always)]
    fn accept(&self, visitor: impl LightVisitor) {
        match &self.luminaire {
            Some(_) => visitor.visit(self),
            None => visitor.visit(&self.bare),
        }
    }

    fn color(&self) -> &Constant3 {
        &self.bare.intensity
    }

    fn placed(&self, placement: &Placement) -> Self {
        let luminaire = self.luminaire.as_ref().map(|hung| {
            let direction = placement.direction(hung.direction.unwrap_or(-DVec3::Y));
            Box::new(Hung { luminaire: hung.luminaire.placed(placement), direction: Some(direction) })
        });
        Self { bare: self.bare.placed(placement), luminaire }
    }

    fn position(&self) -> Option<DVec3> {
        self.bare.position()
    }

    fn shadow(&self) -> bool {
        self.bare.shadow
    }
}

impl Emitter for Bare {
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
