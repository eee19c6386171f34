//! By what is one value shown and changed? Sliders, numbers, colours, boxes and lists.

use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Rgb, Rows};
use egui::{ComboBox, DragValue, Slider, SliderClamping, Ui};

/// The share of a number's size that one pixel of dragging changes.
const DRAG_SPEED: f64 = 0.005;

/// Four digits of a number, in powers of ten where it is huge or tiny.
pub(super) fn short(v: f64) -> String {
    let digits = format!("{v:.3e}");
    let rounded: f64 = digits.parse().unwrap_or(v);
    if v != 0.0 && !(1e-3..1e6).contains(&v.abs()) { digits } else { rounded.to_string() }
}

/// A number within a range.
pub(super) fn slider(
    ui: &mut Ui,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    unit: &str,
) -> Option<f64> {
    let mut v = value;
    let widest = if *range.end() > 1.0 { 1 } else { 3 };
    let clamping = SliderClamping::Edits;
    ui.add(Slider::new(&mut v, range).suffix(unit).max_decimals(widest).clamping(clamping))
        .changed()
        .then_some(v)
}

/// A whole number.
pub(super) fn count(ui: &mut Ui, value: f64) -> Option<f64> {
    let mut v = value;
    ui.add(
        DragValue::new(&mut v)
            .speed(0.05)
            .fixed_decimals(0)
            .range(0.0..=f64::from(u32::MAX))
            .clamp_existing_to_range(false),
    )
    .changed()
    .then_some(v.round())
}

fn speed(value: f64) -> f64 {
    (value.abs() * DRAG_SPEED).max(0.01)
}

/// Any number, or any above 0.
pub(super) fn number(ui: &mut Ui, value: f64, unit: &str, positive: bool) -> Option<f64> {
    let mut v = value;
    let suffix = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let mut widget = DragValue::new(&mut v).speed(speed(value)).max_decimals(4).suffix(suffix);
    if positive {
        widget = widget.range(1e-6..=f64::MAX).clamp_existing_to_range(false);
    }
    ui.add(widget).changed().then_some(v)
}

/// Three numbers in a row.
pub(super) fn vector(ui: &mut Ui, value: DVec3) -> Option<DVec3> {
    numbers(ui, value.to_array()).map(DVec3::from_array)
}

/// Two numbers in a row.
pub(super) fn pair(ui: &mut Ui, value: DVec2) -> Option<DVec2> {
    numbers(ui, value.to_array()).map(DVec2::from_array)
}

/// Rows of numbers, one below the other.
pub(super) fn rows(ui: &mut Ui, value: &Rows) -> Option<Rows> {
    let mut rows: Vec<Vec<f64>> = value.iter().map(<[f64]>::to_vec).collect();
    let mut changed = false;
    ui.vertical(|ui| rows.iter_mut().for_each(|row| changed |= drag_all(ui, row)));
    changed.then(|| rows.iter().fold(Rows::default(), |all, row| all.with(row)))
}

fn numbers<const N: usize>(ui: &mut Ui, value: [f64; N]) -> Option<[f64; N]> {
    let mut v = value;
    drag_all(ui, &mut v).then_some(v)
}

/// Numbers side by side; whether one was changed.
fn drag_all(ui: &mut Ui, numbers: &mut [f64]) -> bool {
    let mut changed = false;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for part in numbers {
            let speed = speed(*part);
            let widget = DragValue::new(part).speed(speed).max_decimals(3);
            changed |= ui.add_sized([49.0, ui.spacing().interact_size.y], widget).changed();
        }
    });
    changed
}

/// A reflectance.
pub(super) fn color(ui: &mut Ui, value: Rgb) -> Option<Rgb> {
    let mut rgb = [value.r as f32, value.g as f32, value.b as f32];
    let changed = ui.color_edit_button_rgb(&mut rgb).changed();
    let channel = |v: f32| f64::from(v.clamp(0.0, 1.0));
    changed.then(|| Rgb::new(channel(rgb[0]), channel(rgb[1]), channel(rgb[2])))
}

/// An amount of light: its strongest channel as a number, and its colour relative to that.
pub(super) fn quantity(ui: &mut Ui, value: Rgb) -> Option<Rgb> {
    let strength = value.r.max(value.g).max(value.b);
    let tint = if strength > 0.0 { value * (1.0 / strength) } else { Rgb::WHITE };
    ui.horizontal(|ui| {
        let tint = color(ui, tint).map(|tint| (tint, strength));
        let mut s = strength;
        let widget = DragValue::new(&mut s)
            .speed(speed(strength))
            .max_decimals(4)
            .range(0.0..=f64::MAX)
            .clamp_existing_to_range(false);
        let strong = ui.add(widget).changed();
        tint.map(|(tint, strength)| tint * strength).or_else(|| {
            let tint = if strength > 0.0 { value * (1.0 / strength) } else { Rgb::WHITE };
            strong.then(|| tint * s)
        })
    })
    .inner
}

/// Yes or no.
pub(super) fn flag(ui: &mut Ui, value: bool) -> Option<bool> {
    let mut on = value;
    ui.checkbox(&mut on, "").changed().then_some(on)
}

/// One of a list of words; the new one, if another is picked.
pub(super) fn choice(ui: &mut Ui, name: &str, words: &[&str], now: &str) -> Option<String> {
    let mut picked = None;
    ComboBox::from_id_salt(name).selected_text(now).show_ui(ui, |ui| {
        for word in words {
            if ui.selectable_label(*word == now, *word).clicked() {
                picked = Some((*word).to_owned());
            }
        }
    });
    picked.filter(|word| word != now)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (v, told) in
            [(0.0, "0"), (12.566_370_6, "12.57"), (100.0, "100"), (2.5e-7, "2.500e-7"), (1e9, "1.000e9")]
        {
            assert_eq!(short(v), told);
        }
    }
}
