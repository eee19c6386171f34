//! How is a number shown, dragged and typed? A box that takes arithmetic, steps by the size of the scene, and keeps what was
//! there when Esc is pressed.

use egui::{DragValue, Id, Response, Ui};

use crate::arithmetic;

/// The share of a number's size that one pixel of dragging changes, and of the scene's.
const DRAG_SPEED: f64 = 0.005;
const SCENE_SPEED: f64 = 0.001;

/// Digits that are shown.
const DIGITS: usize = 5;

/// By what steps a number is dragged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pace {
    /// By its own size: what is large changes fast.
    Value,
    /// By the size of the scene: places and lengths.
    Scene,
    /// A few tenths of a degree.
    Angle,
}

/// Tells all boxes how large the scene is, metres.
pub(super) fn set_scene_size(ui: &Ui, metres: f64) {
    ui.data_mut(|data| data.insert_temp(Id::new("scene size"), metres));
}

/// What a pixel of dragging changes.
fn speed(ui: &Ui, pace: Pace, value: f64) -> f64 {
    match pace {
        Pace::Value => (value.abs() * DRAG_SPEED).max(1e-3),
        Pace::Angle => 0.25,
        Pace::Scene => {
            let size: Option<f64> = ui.data(|data| data.get_temp(Id::new("scene size")));
            (size.filter(|size| *size > 0.0).unwrap_or(10.0) * SCENE_SPEED).max(1e-9)
        }
    }
}

/// A few digits of a number, in powers of ten where it is huge or tiny.
pub(crate) fn short(v: f64) -> String {
    digits(v, 4)
}

/// So many digits of a number.
fn digits(v: f64, count: usize) -> String {
    let scientific = format!("{v:.*e}", count - 1);
    let rounded: f64 = scientific.parse().unwrap_or(v);
    if v != 0.0 && !(1e-4..1e6).contains(&v.abs()) { scientific } else { (rounded + 0.0).to_string() }
}

/// A box with a number. Returns another one that was dragged to or typed.
pub(super) fn edit(
    ui: &mut Ui,
    value: f64,
    pace: Pace,
    shape: impl FnOnce(&mut Ui, DragValue<'_>) -> Response,
) -> Option<f64> {
    let mut v = value;
    let widget = DragValue::new(&mut v)
        .speed(speed(ui, pace, value))
        .custom_formatter(|v, _| digits(v, DIGITS))
        .custom_parser(arithmetic::value)
        .update_while_editing(false);
    let response = shape(ui, widget).on_hover_text(format!("{value}"));
    // A box that is left as it was entered changes nothing, though it shows but a few digits.
    let is_new = response.dragged() || digits(v, DIGITS) != digits(value, DIGITS);
    (v.total_cmp(&value).is_ne() && is_new).then_some(v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (v, told) in [
            (0.0, "0"),
            (-0.0, "0"),
            (12.566_370_6, "12.57"),
            (100.0, "100"),
            (2.5e-7, "2.500e-7"),
            (0.0777, "0.0777"),
            (1e9, "1.000e9"),
        ] {
            assert_eq!(short(v), told);
        }
        assert_eq!(digits(1e30, DIGITS), "1.0000e30");
    }
}
