//! Light from a point into a cone.

use std::f64::consts::PI;

use glam::DVec3;

use super::{Arrival, Emitter, SHADOW, from_point};
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Coefficient, Field, FieldKind, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// A point light within a cone: full strength up to the inner cone, none beyond the outer, and between them
/// `((cos α − cos(outer/2)) / (cos(inner/2) − cos(outer/2)))^falloff` at an angle α from the axis.
#[derive(Debug, Clone, PartialEq)]
pub struct SpotLight {
    position: Constant3,
    axis: Constant3,
    direction: DVec3,
    intensity: Constant3,
    inner: f64,
    outer: f64,
    falloff: Coefficient,
    /// 1 − cos(outer/2).
    outer_depth: Coefficient,
    /// 1 / (cos(inner/2) − cos(outer/2)); the largest `f32` where the cones coincide, so that the edge is hard.
    slope: Coefficient,
    shadow: bool,
}

impl SpotLight {
    /// Full angle of the inner cone, radians.
    #[must_use]
    pub fn inner(&self) -> f64 {
        self.inner
    }

    /// Full angle of the outer cone, radians.
    #[must_use]
    pub fn outer(&self) -> f64 {
        self.outer
    }

    /// Exponent of the falloff between the cones.
    #[must_use]
    pub fn falloff(&self) -> f64 {
        self.falloff.wide
    }

    /// Intensity on the axis, W/sr per channel.
    #[must_use]
    pub fn intensity(&self) -> Rgb {
        self.intensity.rgb()
    }
}

impl Part for SpotLight {
    const NAME: &'static str = "spot-light";
    const DOC: &'static str = "Light from a point into a cone.";
    const FIELDS: &'static [Field] = &[
        Field::required("position", FieldKind::Point, "m", "Where the light stands.")
            .or(|| Value::Vector(DVec3::ZERO)),
        Field::required("direction", FieldKind::Direction, "", "The way the axis of the cone points."),
        Field::required(
            "intensity",
            FieldKind::Quantity,
            "W/sr",
            "Power per solid angle within the inner cone.",
        ),
        Field::required(
            "inner",
            FieldKind::Angle,
            "°",
            "Full angle of the cone that is lit at full strength.",
        ),
        Field::required(
            "outer",
            FieldKind::Angle,
            "°",
            "Full angle of the cone beyond which nothing is lit.",
        ),
        Field::required(
            "falloff",
            FieldKind::Number,
            "",
            "Exponent of the falloff between the cones, at least 0.",
        )
        .or(|| Value::Number(1.0)),
        SHADOW,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (inner, outer) = (given.not_negative("inner")?, given.positive("outer")?);
        if outer < inner {
            let requirement = format!("must not be under inner, {}°", round(inner.to_degrees()));
            return Err(InvalidPart::new("outer", requirement, format!("{}°", round(outer.to_degrees()))));
        }
        if outer > 2.0 * PI {
            return Err(InvalidPart::new(
                "outer",
                "must be at most 360°",
                format!("{}°", round(outer.to_degrees())),
            ));
        }
        // 1 − cos(angle / 2) without cancellation.
        let depth = |angle: f64| 2.0 * (angle / 4.0).sin().powi(2);
        let direction = given.direction("direction")?;
        Ok(Self {
            position: given.point("position")?.into(),
            axis: direction.normalize().into(),
            direction,
            intensity: given.quantity("intensity")?.into(),
            inner,
            outer,
            falloff: Coefficient::new(given.not_negative("falloff")?),
            outer_depth: Coefficient::new(depth(outer)),
            slope: Coefficient::new((1.0 / (depth(outer) - depth(inner))).min(f64::from(f32::MAX))),
            shadow: given.flag("shadow")?,
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("position", Value::Vector(self.position.vector()))
            .with("direction", Value::Vector(self.direction))
            .with("intensity", Value::Color(self.intensity.rgb()))
            .with("inner", Value::Number(self.inner))
            .with("outer", Value::Number(self.outer))
            .with("falloff", Value::Number(self.falloff.wide))
            .with("shadow", Value::Flag(self.shadow))
    }
}

impl Emitter for SpotLight {
    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        let like = point.x;
        let arrival = from_point(Triple::of(like, &self.position), point);
        // 1 − cos α is half the square of the difference of the two unit vectors, which keeps its digits near the axis.
        let aside = arrival.towards + Triple::of(like, &self.axis);
        let above_outer = like.of(self.outer_depth) - aside.dot(aside) * like.number(0.5);
        let (zero, one) = (like.number(0.0), like.number(1.0));
        let share = (above_outer * like.of(self.slope)).max(zero).min(one).power(self.falloff);
        Arrival { strength: arrival.strength * share, lit: arrival.lit & zero.less(above_outer), ..arrival }
    }

    fn color(&self) -> &Constant3 {
        &self.intensity
    }

    fn placed(&self, placement: &Placement) -> Self {
        let direction = placement.direction(self.direction);
        Self {
            position: placement.point(self.position.vector()).into(),
            axis: direction.normalize().into(),
            direction,
            ..self.clone()
        }
    }

    fn position(&self) -> Option<DVec3> {
        Some(self.position.vector())
    }

    fn direction(&self) -> Option<DVec3> {
        Some(self.axis.vector())
    }

    fn shadow(&self) -> bool {
        self.shadow
    }
}

/// Degrees as a person writes them: without the noise of the conversion from radians.
fn round(degrees: f64) -> f64 {
    (degrees * 1e6).round() / 1e6
}
