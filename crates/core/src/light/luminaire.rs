//! How does a light with an intensity profile hang, and what does it send towards a point?

use glam::DVec3;

use super::{Arrival, Pole};
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Lane, Placement, ProfileSource, Rgb, Triple, Value, Values};

/// The intensity profile of a light, and how it is turned.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Luminaire {
    source: ProfileSource,
    /// Where the photometric horizontal points; by default as [`hanging`] says.
    horizontal: Option<DVec3>,
    /// Unit vectors: the axis of the polar angles, and the directions of azimuth 0 and 90° at right angles to it.
    pole: Constant3,
    zero: Constant3,
    quarter: Constant3,
}

pub(super) const PROFILE: Field = Field::required(
    "profile",
    FieldKind::Profile,
    "",
    "IES file of the luminaire, relative to the scene's folder: candela by direction, which intensity scales.",
)
.optional();

pub(super) const HORIZONTAL: Field = Field::required(
    "horizontal",
    FieldKind::Direction,
    "",
    "Where horizontal angle 0 of the profile points, as near as it can at right angles to the direction.",
)
.optional();

impl Luminaire {
    /// Reads the fields of a light whose nadir points along `nadir`.
    ///
    /// # Errors
    /// A horizontal along the nadir, or without a profile.
    pub(super) fn given(given: &Given<'_>, nadir: DVec3) -> Result<Option<Self>, InvalidPart> {
        let horizontal = match given.has("horizontal") {
            true => Some(given.direction("horizontal")?),
            false => None,
        };
        if !given.has("profile") {
            return match horizontal {
                Some(_) => Err(alone("horizontal")),
                None => Ok(None),
            };
        }
        Self::new(given.profile("profile")?, nadir, horizontal).map(Some)
    }

    fn new(source: ProfileSource, nadir: DVec3, horizontal: Option<DVec3>) -> Result<Self, InvalidPart> {
        let nadir = nadir.normalize();
        let towards = horizontal.map_or_else(|| hanging(nadir), DVec3::normalize);
        let Some(zero) = (towards - nadir * nadir.dot(towards)).try_normalize() else {
            return Err(InvalidPart::new("horizontal", "must not lie along the direction", towards));
        };
        // Counterclockwise from the horizontal, seen from above.
        let quarter = zero.cross(nadir);
        let (pole, zero, quarter) = match source.profile.pole() {
            Pole::Nadir => (nadir, zero, quarter),
            Pole::Across => (-quarter, nadir, zero),
        };
        let [pole, zero, quarter] = [pole, zero, quarter].map(Constant3::from);
        Ok(Self { source, horizontal, pole, zero, quarter })
    }

    /// Adds the values of its fields.
    pub(super) fn values(&self, values: Values) -> Values {
        let values = values.with("profile", Value::Profile(self.source.clone()));
        match self.horizontal {
            Some(horizontal) => values.with("horizontal", Value::Vector(horizontal)),
            None => values,
        }
    }

    /// The same, turned with a light.
    pub(super) fn placed(&self, placement: &Placement) -> Self {
        let turn = |axis: &Constant3| Constant3::from(placement.direction(axis.vector()).normalize());
        let zero = match self.source.profile.pole() {
            Pole::Nadir => &self.zero,
            Pole::Across => &self.quarter,
        };
        let horizontal = self.horizontal.unwrap_or_else(|| zero.vector());
        Self {
            source: self.source.clone(),
            horizontal: Some(placement.direction(horizontal)),
            pole: turn(&self.pole),
            zero: turn(&self.zero),
            quarter: turn(&self.quarter),
        }
    }

    /// What arrives of a light that would send 1 W/sr in every direction.
    #[inline(always)]
    pub(super) fn shine<L: Lane>(&self, arrival: Arrival<L>) -> Arrival<L> {
        let (like, back) = (arrival.strength, arrival.direction);
        let along = -back.dot(Triple::of(like, &self.pole));
        let zero = -back.dot(Triple::of(like, &self.zero));
        let quarter = -back.dot(Triple::of(like, &self.quarter));
        let polar = zero.mul_add(zero, quarter * quarter).sqrt().atan2(along);
        let profile = &*self.source.profile;
        let azimuth = if profile.is_round() { like.number(0.0) } else { quarter.atan2(zero) };
        let candela = polar.each(azimuth, |polar, azimuth| profile.intensity(polar, azimuth));
        Arrival { strength: arrival.strength * candela, ..arrival }
    }
}

/// The intensity of a light: with a profile the share of it that is sent out, all of it unless it says otherwise.
///
/// # Errors
/// No amount of light; missing where there is no profile.
pub(super) fn scale(given: &Given<'_>, has_profile: bool) -> Result<Rgb, InvalidPart> {
    if has_profile && !given.has("intensity") { Ok(Rgb::WHITE) } else { given.quantity("intensity") }
}

/// Refuses a field that means nothing where there is no profile.
pub(super) fn alone(field: &'static str) -> InvalidPart {
    InvalidPart::new(field, "must stand beside a profile", "alone")
        .with_hint("write profile \"file.ies\" too, or leave it away")
}

/// Where +x comes to lie when −y is turned the shortest way to a unit vector; +x itself for +y.
fn hanging(nadir: DVec3) -> DVec3 {
    let aside2 = nadir.x.mul_add(nadir.x, nadir.z * nadir.z);
    // 1 − y without cancellation.
    let rise = if nadir.y > 0.0 { aside2 / (1.0 + nadir.y) } else { 1.0 - nadir.y };
    if rise > 0.0 { DVec3::X - (nadir - DVec3::Y) * (nadir.x / rise) } else { DVec3::X }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::Light;
    use crate::light::{IntensityProfile, PointLight, SpotLight};

    /// Twice as bright towards azimuth 0 as towards 90°, four times towards 180°; dark in the upper half.
    fn lopsided(pole: Pole) -> ProfileSource {
        let azimuth = vec![0.0, 90.0, 180.0, 270.0, 360.0];
        let rows = [20.0, 10.0, 40.0, 5.0, 20.0];
        let candela = rows.iter().flat_map(|&v| [v, v]).collect();
        let profile = IntensityProfile::new(pole, vec![0.0, 90.0], azimuth, candela).unwrap();
        ProfileSource { path: "lopsided.ies".into(), profile: Arc::new(profile) }
    }

    fn lamp(values: &Values) -> Result<Light, InvalidPart> {
        crate::part::make::<PointLight>(values).map(Light::from)
    }

    fn lopsided_lamp() -> Values {
        Values::new().with("profile", Value::Profile(lopsided(Pole::Nadir)))
    }

    fn strength(light: &Light, towards: DVec3) -> f64 {
        let at = light.position().unwrap() + towards;
        light.arriving(Triple::new(at.x, at.y, at.z)).strength * towards.length_squared()
    }

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found}, not {expected}");
    }

    #[test]
    fn azimuths_turn_counterclockwise_from_x_seen_from_above() {
        let light = lamp(&lopsided_lamp()).unwrap();
        for (towards, candela) in [
            (DVec3::new(1.0, -0.1, 0.0), 20.0),
            (DVec3::new(0.0, -0.1, -1.0), 10.0),
            (DVec3::new(-1.0, -0.1, 0.0), 40.0),
            (DVec3::new(0.0, -3.0, 3.0), 5.0),
            (DVec3::new(1.0, -0.1, -1.0), 15.0),
            (DVec3::new(1.0, 0.1, 0.0), 0.0),
        ] {
            near(strength(&light, towards), candela);
        }
    }

    #[test]
    fn a_profile_about_the_axis_across_turns_from_nadir_to_the_horizontal() {
        let values = Values::new().with("profile", Value::Profile(lopsided(Pole::Across)));
        let light = lamp(&values).unwrap();
        // The pole is clockwise of +x: +z. Azimuth 0 is nadir, 90° is +x, 180° is up.
        for (towards, candela) in [
            (DVec3::new(0.0, -1.0, 0.1), 20.0),
            (DVec3::new(1.0, 0.0, 0.1), 10.0),
            (DVec3::new(0.0, 1.0, 0.1), 40.0),
            (DVec3::new(-1.0, 0.0, 0.1), 5.0),
            (DVec3::new(0.0, -1.0, -0.1), 0.0),
        ] {
            near(strength(&light, towards), candela);
        }
    }

    #[test]
    fn direction_and_horizontal_turn_the_profile() {
        let values = Values::new()
            .with("profile", Value::Profile(lopsided(Pole::Nadir)))
            .with("direction", Value::Vector(DVec3::X * 3.0))
            .with("horizontal", Value::Vector(DVec3::new(5.0, 0.0, 2.0)));
        let light = lamp(&values).unwrap();
        near(strength(&light, DVec3::new(0.1, 0.0, 1.0)), 20.0);
        near(strength(&light, DVec3::new(0.1, -1.0, 0.0)), 5.0);
        // Without a horizontal, -y is turned to +x and so +x to +y.
        let hung = lopsided_lamp().with("direction", Value::Vector(DVec3::X));
        near(strength(&lamp(&hung).unwrap(), DVec3::new(0.1, 1.0, 0.0)), 20.0);
        let up = lopsided_lamp().with("direction", Value::Vector(DVec3::Y));
        near(strength(&lamp(&up).unwrap(), DVec3::new(1.0, 0.1, 0.0)), 20.0);
    }

    #[test]
    fn near_the_ceiling_no_horizontal_is_lost() {
        for exponent in 1..200 {
            let nadir = DVec3::new(2.0_f64.powi(-exponent), 1.0, 2.0_f64.powi(-exponent)).normalize();
            let zero = hanging(nadir);
            assert!((zero.length() - 1.0).abs() < 1e-8 && zero.dot(nadir).abs() < 1e-8, "{exponent} {zero}");
        }
    }

    #[test]
    fn a_placement_turns_the_whole_profile() {
        for pole in [Pole::Nadir, Pole::Across] {
            let light = lamp(&Values::new().with("profile", Value::Profile(lopsided(pole)))).unwrap();
            let turned = Placement::IDENTITY
                .turned(DVec3::ONE, DVec3::new(1.0, -2.0, 0.5), 2.0)
                .and_then(|placement| placement.moved(DVec3::new(3.0, 0.0, 1.0)))
                .unwrap();
            let placed = light.placed(&turned);
            let again = (light.kind().make)(&placed.values()).unwrap();
            for towards in [DVec3::new(1.0, -0.3, 0.2), DVec3::new(-0.4, -0.3, 0.7)] {
                let expected = strength(&light, towards);
                near(strength(&placed, turned.direction(towards)), expected);
                near(strength(&again, turned.direction(towards)), expected);
            }
        }
    }

    #[test]
    fn intensity_scales_the_profile_and_is_one_when_left_out() {
        let plain = lamp(&lopsided_lamp()).unwrap();
        assert_eq!(plain.color().rgb(), Rgb::WHITE);
        let tinted = lamp(&lopsided_lamp().with("intensity", Value::Color(Rgb::new(0.5, 0.0, 2.0)))).unwrap();
        let arrival = tinted.arriving(Triple::new(2.0, -0.1, 0.0));
        let irradiance = tinted.irradiance(&arrival);
        let candela = 20.0 / 4.01;
        near(irradiance.x, candela / 2.0);
        near(irradiance.z, candela * 2.0);
    }

    #[test]
    fn the_cone_of_a_spot_cuts_its_profile() {
        let values = lopsided_lamp()
            .with("direction", Value::Vector(-DVec3::Y))
            .with("inner", Value::Number(1.0))
            .with("outer", Value::Number(1.0));
        let light: Light = crate::part::make::<SpotLight>(&values).unwrap().into();
        assert_eq!(light.color().rgb(), Rgb::WHITE);
        near(strength(&light, DVec3::new(0.3, -1.0, 0.0)), 20.0);
        near(strength(&light, DVec3::new(-0.3, -1.0, 0.0)), 40.0);
        assert!(!light.arriving(Triple::new(1.0, -1.0, 0.0)).lit);
    }

    #[test]
    fn what_only_a_profile_needs_is_refused_without_one() {
        let bare = Values::new().with("intensity", Value::Color(Rgb::WHITE));
        let refused = |values: Values| lamp(&values).unwrap_err().to_string();
        let down = Value::Vector(-DVec3::Y);
        assert_eq!(
            refused(bare.clone().with("direction", down.clone())),
            "direction must stand beside a profile, not alone"
        );
        assert_eq!(
            refused(bare.with("horizontal", down.clone())),
            "horizontal must stand beside a profile, not alone"
        );
        assert_eq!(refused(Values::new()), "intensity must be given, not missing");
        let along = refused(lopsided_lamp().with("horizontal", down));
        assert!(along.starts_with("horizontal must not lie along the direction"), "{along}");
    }

    #[test]
    fn at_the_lamp_itself_nothing_arrives() {
        let light = lamp(&lopsided_lamp()).unwrap();
        assert!(!light.arriving(Triple::splat(0.0)).lit);
    }
}
