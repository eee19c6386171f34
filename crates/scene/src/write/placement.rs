//! How a placement is spelled as steps, and how the steps in the text follow a changed one.

use catoptra_core::Placement;
use catoptra_core::glam::{DQuat, DVec3};

use super::layout;
use super::splice::Splice;
use super::value::{degrees, number};
use crate::outline::Item;

/// The steps that make a placement: `scale`, `turn`, `move`, those that do something. A turn reads back to within
/// rounding (an angle and an axis do not determine every quaternion to the last bit), the others exactly.
pub(super) fn steps(placement: &Placement) -> Vec<String> {
    let mut steps = Vec::new();
    if placement.scale() != 1.0 {
        steps.push(format!("scale {}", number(placement.scale())));
    }
    steps.extend(turn(placement.rotation()));
    if placement.translation() != DVec3::ZERO {
        steps.push(move_by(placement.translation()));
    }
    steps
}

fn move_by(by: DVec3) -> String {
    format!("move {}", by.to_array().map(number).join(" "))
}

fn turn(rotation: DQuat) -> Option<String> {
    // Of the two quaternions for one turn, the one of at most half a turn reads better.
    let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
    let axis = rotation.xyz();
    let longest = axis.abs().max_element();
    if longest == 0.0 {
        return None;
    }
    let angle = 2.0 * axis.length().atan2(rotation.w);
    let axis = axis / longest;
    let round = axis.map(|part| (part * AXIS_PARTS).round() / AXIS_PARTS);
    let axis = if reads_back(&tidy(angle), round, rotation) { round } else { axis };
    let (exact, near) = (degrees(angle), tidy(angle));
    let text = if exact.len() > near.len() + 3 && reads_back(&near, axis, rotation) { near } else { exact };
    Some(format!("turn {text} {}", axis.to_array().map(number).join(" ")))
}

/// Parts of an axis are written in this many parts of the longest, where that is what they were.
const AXIS_PARTS: f64 = 1e10;

/// The angle in degrees to 12 digits: what a person has probably written.
fn tidy(angle: f64) -> String {
    let text = format!("{:.10}", angle.to_degrees());
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Whether turning by `degrees` about an axis is a rotation, to within rounding.
fn reads_back(degrees: &str, axis: DVec3, rotation: DQuat) -> bool {
    let angle = degrees.parse::<f64>().map_or(f64::NAN, f64::to_radians);
    let again = DQuat::from_axis_angle(axis.normalize(), angle);
    (again - rotation).length() <= 4.0 * f64::EPSILON
}

/// Changes the steps of a node so that they make `new`; answers with the lines of steps that have to be added.
pub(super) fn edit(text: &str, item: &Item, new: &Placement, splices: &mut Vec<Splice>) -> Vec<String> {
    if item.placement == *new {
        return Vec::new();
    }
    let Some((last, others)) = item.steps.split_last() else {
        return steps(new);
    };
    if last.is_move
        && let Some(by) = move_between(&last.before, new)
    {
        if by == DVec3::ZERO {
            splices.push(Splice::new(layout::taken_out(text, &last.span), ""));
            return Vec::new();
        }
        let words = by.to_array().map(number);
        for (word, span) in words.iter().zip(&last.numbers) {
            // A number that did not change keeps its spelling.
            if text[span.clone()].parse::<f64>().ok() != word.parse::<f64>().ok() {
                splices.push(Splice::new(span.clone(), word.as_str()));
            }
        }
        return Vec::new();
    }
    if !last.is_move
        && let Some(by) = move_between(&item.placement, new)
    {
        return vec![move_by(by)];
    }
    for step in others {
        splices.push(Splice::new(layout::taken_out(text, &step.span), ""));
    }
    let steps = steps(new);
    if steps.is_empty() {
        splices.push(Splice::new(layout::taken_out(text, &last.span), ""));
        return steps;
    }
    let newline = format!("{}{}", layout::newline(text), layout::indent_at(text, last.span.start));
    let separator = if layout::begins_line(text, last.span.start) { newline.as_str() } else { "; " };
    splices.push(Splice::new(last.span.clone(), steps.join(separator)));
    Vec::new()
}

/// The move that leads from one placement to another, if a move does.
fn move_between(from: &Placement, to: &Placement) -> Option<DVec3> {
    if (from.rotation(), from.scale()) != (to.rotation(), to.scale()) {
        return None;
    }
    let by = to.translation() - from.translation();
    // Subtraction rounds: the move must lead exactly there, or it is spelled anew from the origin.
    let there = from.moved(by).ok()?;
    (there.translation() == to.translation()).then_some(by)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_about_a_round_axis_is_spelled_by_round_numbers() {
        let axis = DVec3::new(0.1, 1.0, 0.0026);
        let rotation = DQuat::from_axis_angle(axis.normalize(), 30.15_f64.to_radians());
        assert_eq!(turn(rotation).unwrap(), "turn 30.15 0.1 1 0.0026");
        let other =
            DQuat::from_axis_angle(DVec3::new(0.123_456_789_012_3, 1.0, 0.7).normalize(), 0.777_777_777_7);
        let text = turn(other).unwrap();
        let numbers: Vec<f64> = text.split(' ').skip(1).map(|word| word.parse().unwrap()).collect();
        let axis = DVec3::new(numbers[1], numbers[2], numbers[3]);
        let again = DQuat::from_axis_angle(axis.normalize(), numbers[0].to_radians());
        assert!((again - other).length() <= 4.0 * f64::EPSILON, "{text}");
    }
}
