//! To what are numbers rounded that come of a drag? To what can be seen, so that files hold `46.52` and not
//! `46.517315624356776`; numbers that did not change stay to the bit.

use catoptra_core::glam::{DQuat, DVec3};
use catoptra_core::{Camera, Field, FieldKind, InvalidPart, Light, Part as _, Placement, Value, Values};

/// Digits of numbers that have no size in the picture: of directions, lengths and factors.
const DIGITS: i32 = 5;

/// Angles are rounded to this, in degrees, and axes of turns to this share of their longest part.
const DEGREES: f64 = 0.01;
const AXIS: f64 = 1e-4;

/// The power of ten at or below a number of metres, such as those that a pixel spans; 0, which rounds nothing, for none.
fn step(pixel: f64) -> f64 {
    if pixel > 0.0 && pixel.is_finite() { 10_f64.powi(pixel.log10().floor() as i32) } else { 0.0 }
}

/// The same for numbers in the space of something that is placed so in the world.
pub(crate) fn step_within(pixel: f64, outer: &Placement) -> f64 {
    step(pixel / outer.scale())
}

/// A light that was changed by hand, with what differs from before rounded to a step in metres; one that refuses round numbers
/// keeps its own.
///
/// # Errors
/// What the light refuses.
pub(crate) fn light(before: &Light, after: &Light, step: f64) -> Result<Light, InvalidPart> {
    let (kind, values) = (after.kind(), after.values());
    let round = rounded(kind.fields, &before.values(), &values, step);
    (kind.make)(&round).or_else(|_| (kind.make)(&values))
}

/// The same of a camera.
///
/// # Errors
/// What the camera refuses.
pub(crate) fn camera(before: &Camera, after: &Camera, step: f64) -> Result<Camera, InvalidPart> {
    (Camera::KIND.make)(&rounded(Camera::FIELDS, &before.values(), &after.values(), step))
}

/// The nearest of 1, 2 and 5 times a power of ten below a number of metres: a step that people like.
pub(super) fn round_step(metres: f64) -> f64 {
    let ten = step(metres);
    [5.0, 2.0, 1.0].into_iter().map(|digit| digit * ten).find(|step| *step <= metres).unwrap_or(ten)
}

/// The multiple of a step that is nearest, without a tail of digits.
fn whole(value: f64, step: f64) -> f64 {
    if !(step > 0.0) {
        return value;
    }
    // A power of ten below 1 is no number of its own, but what it is one part of is.
    let parts = (1.0 / step).round();
    let rounded = if step < 1.0 { (value * parts).round() / parts } else { (value / step).round() * step };
    // Without the sign of a 0.
    if rounded.is_finite() { rounded + 0.0 } else { value }
}

/// To so many digits.
fn to_digits(value: f64, digits: i32) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    whole(value, 10_f64.powi(value.abs().log10().floor() as i32 + 1 - digits))
}

/// A vector with the parts that changed rounded to a step.
fn whole_parts(before: Option<DVec3>, after: DVec3, step: f64) -> DVec3 {
    let part = |i: usize| {
        // What moved by less than rounding tells did not move.
        let kept = before.map(|before| before[i]).filter(|old| (old - after[i]).abs() < 1e-3 * step);
        kept.unwrap_or_else(|| whole(after[i], step))
    };
    DVec3::new(part(0), part(1), part(2))
}

/// Values of a part with those that changed rounded: points to a step in metres, others to a few digits.
pub(super) fn rounded(fields: &[Field], before: &Values, after: &Values, step: f64) -> Values {
    let mut values = after.clone();
    for field in fields {
        let (old, Some(new)) = (before.get(field.name), after.get(field.name)) else { continue };
        if old == Some(new) {
            continue;
        }
        let old_vector = match old {
            Some(Value::Vector(v)) => Some(*v),
            _ => None,
        };
        let tidy = match (field.kind, new) {
            (FieldKind::Point, Value::Vector(v)) => Value::Vector(whole_parts(old_vector, *v, step)),
            (_, Value::Vector(v)) => {
                let longest = v.abs().max_element();
                let step = if longest > 0.0 { to_step(longest) } else { 0.0 };
                Value::Vector(whole_parts(old_vector, *v, step))
            }
            (FieldKind::Angle, Value::Number(v)) => {
                Value::Number(whole(v.to_degrees(), DEGREES).to_radians())
            }
            (_, Value::Number(v)) => Value::Number(to_digits(*v, DIGITS)),
            _ => continue,
        };
        values.set(field.name, tidy);
    }
    values
}

/// The step that leaves a number so many digits.
fn to_step(number: f64) -> f64 {
    10_f64.powi(number.log10().floor() as i32 + 1 - DIGITS)
}

/// A placement with what changed rounded.
pub(super) fn placement(before: &Placement, after: &Placement, step: f64) -> Result<Placement, InvalidPart> {
    let scale =
        if before.scale() == after.scale() { after.scale() } else { to_digits(after.scale(), DIGITS) };
    let same = before.rotation().dot(after.rotation()).abs() > 1.0 - 1e-15;
    let rotation = if same { before.rotation() } else { turn(after.rotation()) };
    Placement::new(rotation, whole_parts(Some(before.translation()), after.translation(), step), scale)
}

/// A placement that was turned, rounded.
///
/// # Errors
/// None that a placement could bring about.
pub(crate) fn turned(after: &Placement, step: f64) -> Result<Placement, InvalidPart> {
    Placement::new(turn(after.rotation()), whole_parts(None, after.translation(), step), after.scale())
}

/// A turn by a round angle about a round axis.
fn turn(rotation: DQuat) -> DQuat {
    let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
    let axis = rotation.xyz();
    let longest = axis.abs().max_element();
    let angle = whole((2.0 * axis.length().atan2(rotation.w)).to_degrees(), DEGREES);
    let axis = (axis / longest).map(|part| whole(part, AXIS)).try_normalize();
    axis.map_or(DQuat::IDENTITY, |axis| DQuat::from_axis_angle(axis, angle.to_radians()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_what_a_pixel_can_tell() {
        for (pixel, wanted) in [(0.013, 0.01), (0.99, 0.1), (1.0, 1.0), (37.0, 10.0), (0.0, 0.0)] {
            assert!((step(pixel) - wanted).abs() < 1e-12, "{pixel}: {}", step(pixel));
        }
        assert_eq!([0.3, 0.7, 4.9].map(round_step).map(|s| (s * 100.0).round()), [20.0, 50.0, 200.0]);
    }

    #[test]
    fn rounded_numbers_have_no_tails() {
        for (value, step, told) in [
            (46.517_315_624_356_776, 0.01, "46.52"),
            (0.300_000_000_000_000_04, 0.1, "0.3"),
            (-8.000_000_000_000_087, 0.001, "-8"),
            (5.3e-15, 0.01, "0"),
            (-1e-9, 0.01, "0"),
            (1234.6, 10.0, "1230"),
        ] {
            assert_eq!(whole(value, step).to_string(), told);
        }
        assert_eq!(to_digits(0.123_456_789, 5).to_string(), "0.12346");
        assert_eq!(to_digits(-98_765.432, 3).to_string(), "-98800");
    }

    #[test]
    fn what_did_not_change_stays_to_the_bit() {
        let before = DVec3::new(0.123_456_789, 1.0, 2.0);
        let after = DVec3::new(0.123_456_789, 1.000_000_001, 2.234_567);
        assert_eq!(whole_parts(Some(before), after, 0.01), DVec3::new(0.123_456_789, 1.0, 2.23));
        let old = Placement::new(DQuat::from_rotation_y(0.123_456_7), before, 1.5).unwrap();
        let new = placement(&old, &old.moved(DVec3::X).unwrap(), 0.01).unwrap();
        assert_eq!((new.rotation(), new.scale()), (old.rotation(), 1.5));
        assert_eq!(new.translation(), DVec3::new(1.12, 1.0, 2.0));
    }

    #[test]
    fn turns_are_round_and_near() {
        let axis = DVec3::new(0.099_977, 1.0, 0.002_617_999_859).normalize();
        let before = DQuat::from_axis_angle(axis, 30.149_592_7_f64.to_radians());
        let after = turn(before);
        assert!(before.angle_between(after) < 3e-4, "{}", before.angle_between(after));
        let angle = (2.0 * after.xyz().length().atan2(after.w)).to_degrees();
        assert!((angle - 30.15).abs() < 1e-9, "{angle}");
        assert_eq!(turn(DQuat::from_rotation_x(1e-9)), DQuat::IDENTITY);
    }
}
