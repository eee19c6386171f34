//! Light from a point into a cone, alike all over the inner cone or as a luminaire's profile has it.

use std::f64::consts::PI;

use glam::DVec3;

use super::luminaire::{HORIZONTAL, Luminaire, PROFILE, scale};
use super::{Arrival, Emitter, LightVisitor, SHADOW, from_point};
use crate::lane::Constant3;
use crate::part::{Given, degrees};
use crate::{Coefficient, Field, FieldKind, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// A point light within a cone: full strength up to the inner cone, none beyond the outer, and between them
/// `((cos α − cos(outer/2)) / (cos(inner/2) − cos(outer/2)))^falloff` at an angle α from the axis.
#[derive(Debug, Clone, PartialEq)]
pub struct SpotLight {
    bare: Bare,
    /// Apart, since few lights have one.
    luminaire: Option<Box<Luminaire>>,
}

/// The same light in all directions of the inner cone.
#[derive(Debug, Clone, PartialEq)]
struct Bare {
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
    /// At `position`, its axis along `direction` (of any length), with an intensity in W/sr per channel that is full within
    /// the inner cone and gone beyond the outer; `[inner, outer]` are their full angles, radians.
    ///
    /// ```
    /// use catoptra_core::{Rgb, glam::DVec3, light::SpotLight};
    ///
    /// let light = SpotLight::new(DVec3::Y * 3.0, DVec3::NEG_Y, Rgb::grey(60.0), [0.4, 0.7])?.with_falloff(2.0)?;
    /// assert_eq!(light.falloff(), 2.0);
    /// # Ok::<(), catoptra_core::InvalidPart>(())
    /// ```
    ///
    /// # Errors
    /// A position or direction that is not finite, a direction of zero, a channel that is negative or not finite, angles
    /// that are negative, not in order, or more than a full turn.
    pub fn new(
        position: DVec3,
        direction: DVec3,
        intensity: Rgb,
        [inner, outer]: [f64; 2],
    ) -> Result<Self, InvalidPart> {
        crate::part::make(
            &Values::new()
                .with("position", Value::Vector(position))
                .with("direction", Value::Vector(direction))
                .with("intensity", Value::Color(intensity))
                .with("inner", Value::Number(inner))
                .with("outer", Value::Number(outer)),
        )
    }

    /// With another exponent of the falloff between the cones.
    ///
    /// # Errors
    /// One that is negative or not finite.
    pub fn with_falloff(&self, falloff: f64) -> Result<Self, InvalidPart> {
        self.with("falloff", falloff)
    }

    /// Full angle of the inner cone, radians.
    #[must_use]
    pub fn inner(&self) -> f64 {
        self.bare.inner
    }

    /// Full angle of the outer cone, radians.
    #[must_use]
    pub fn outer(&self) -> f64 {
        self.bare.outer
    }

    /// Exponent of the falloff between the cones.
    #[must_use]
    pub fn falloff(&self) -> f64 {
        self.bare.falloff.wide
    }

    /// Intensity on the axis, W/sr per channel.
    #[must_use]
    pub fn intensity(&self) -> Rgb {
        self.bare.intensity.rgb()
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
        PROFILE,
        HORIZONTAL,
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
            let requirement = format!("must not be under inner, {}", degrees(inner));
            return Err(InvalidPart::new("outer", requirement, degrees(outer)));
        }
        if outer > 2.0 * PI {
            return Err(InvalidPart::new("outer", "must be at most 360°", degrees(outer)));
        }
        // 1 − cos(angle / 2) without cancellation.
        let depth = |angle: f64| 2.0 * (angle / 4.0).sin().powi(2);
        let direction = given.direction("direction")?;
        let luminaire = Luminaire::given(given, direction)?.map(Box::new);
        let bare = Bare {
            position: given.point("position")?.into(),
            axis: direction.normalize().into(),
            direction,
            intensity: scale(given, luminaire.is_some())?.into(),
            inner,
            outer,
            falloff: Coefficient::new(given.not_negative("falloff")?),
            outer_depth: Coefficient::new(depth(outer)),
            slope: Coefficient::new((1.0 / (depth(outer) - depth(inner))).min(f64::from(f32::MAX))),
            shadow: given.flag("shadow")?,
        };
        Ok(Self { bare, luminaire })
    }

    fn values(&self) -> Values {
        let values = Values::new()
            .with("position", Value::Vector(self.bare.position.vector()))
            .with("direction", Value::Vector(self.bare.direction))
            .with("intensity", Value::Color(self.bare.intensity.rgb()));
        let values = match &self.luminaire {
            Some(luminaire) => luminaire.values(values),
            None => values,
        };
        values
            .with("inner", Value::Number(self.bare.inner))
            .with("outer", Value::Number(self.bare.outer))
            .with("falloff", Value::Number(self.bare.falloff.wide))
            .with("shadow", Value::Flag(self.bare.shadow))
    }
}

impl Emitter for SpotLight {
    const HAS_CONE: bool = true;

    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        let arrival = self.bare.arriving(point);
        match &self.luminaire {
            Some(luminaire) => luminaire.shine(arrival),
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
        let luminaire = self.luminaire.as_ref().map(|luminaire| Box::new(luminaire.placed(placement)));
        Self { bare: self.bare.placed(placement), luminaire }
    }

    fn position(&self) -> Option<DVec3> {
        self.bare.position()
    }

    fn direction(&self) -> Option<DVec3> {
        self.bare.direction()
    }

    fn may_reach(&self, center: DVec3, radius: f64) -> bool {
        self.bare.may_reach(center, radius)
    }

    fn shadow(&self) -> bool {
        self.bare.shadow
    }
}

impl Emitter for Bare {
    const HAS_CONE: bool = true;

    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        let like = point.x;
        let arrival = from_point(Triple::of(like, &self.position), point);
        // 1 − cos α is half the square of the difference of the two unit vectors, which keeps its digits near the axis.
        let aside = arrival.direction + Triple::of(like, &self.axis);
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

    /// A ball at the distance d is seen from the apex under the angle δ with sin δ = ρ/d to either side. It stays outside
    /// a cone of half the angle θ where its centre is more than θ + δ off the axis.
    fn may_reach(&self, center: DVec3, radius: f64) -> bool {
        let way = center - self.position.vector();
        let (cosine, sine) = ((self.outer / 2.0).cos(), (self.outer / 2.0).sin());
        let distance2 = way.length_squared();
        let beyond_half_turn = cosine < 0.0 && radius * radius >= sine * sine * distance2;
        let limit = cosine * (distance2 - radius * radius).max(0.0).sqrt() - sine * radius;
        let outside = radius * radius < distance2 && !beyond_half_turn && way.dot(self.axis.vector()) < limit;
        !outside
    }

    fn shadow(&self) -> bool {
        self.shadow
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn place() -> impl Strategy<Value = DVec3> {
        [-3.0..3.0, -3.0..3.0, -3.0..3.0_f64].prop_map(DVec3::from_array)
    }

    fn spot(direction: DVec3, outer: f64) -> SpotLight {
        SpotLight::new(DVec3::ZERO, direction, Rgb::WHITE, [0.0, outer]).unwrap()
    }

    proptest! {
        #[test]
        fn what_is_lit_is_within_reach(at in place(), aside in place(), along in place(), outer in 0.01..2.0 * PI) {
            prop_assume!(along.length() > 0.1);
            let light = spot(along, outer);
            let lit = light.arriving(Triple::new(at.x, at.y, at.z)).lit;
            prop_assert!(!lit || light.may_reach(at + aside, aside.length() * (1.0 + 1e-12)));
        }
    }

    #[test]
    fn balls_beside_and_behind_are_out_of_reach() {
        let narrow = spot(DVec3::X, 60.0_f64.to_radians());
        assert!(narrow.may_reach(DVec3::X * 5.0, 0.1) && narrow.may_reach(DVec3::Y, 0.9));
        assert!(!narrow.may_reach(DVec3::Y * 5.0, 0.1) && !narrow.may_reach(DVec3::X * -5.0, 4.9));
        let wide = spot(DVec3::X, 300.0_f64.to_radians());
        assert!(wide.may_reach(DVec3::Y, 0.1) && wide.may_reach(DVec3::X * -1.0, 0.6));
        assert!(!wide.may_reach(DVec3::X * -5.0, 1.0));
    }
}
