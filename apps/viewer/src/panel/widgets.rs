//! By what is one value shown and changed? Sliders, numbers, amounts of light, boxes and lists.

use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Rgb, Rows};
use egui::{ComboBox, DragValue, Response, Slider, SliderClamping, Ui};

use super::color::Typed;
use super::number::{self, Pace};
use super::{color, spoken};
use crate::arithmetic;

/// A number within a range.
pub(super) fn slider(
    ui: &mut Ui,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    unit: &str,
) -> Option<f64> {
    let widest = if *range.end() > 1.0 { 1 } else { 3 };
    slide(ui, value, range, unit, widest)
}

/// A slider to that many decimals, and its number beside it, which may lie outside until it is changed.
pub(super) fn slide(
    ui: &mut Ui,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    unit: &str,
    decimals: usize,
) -> Option<f64> {
    let (mut slid, mut typed) = (value, value);
    ui.horizontal(|ui| {
        let slider = Slider::new(&mut slid, range.clone()).max_decimals(decimals).show_value(false);
        let slider = ui.add(slider.clamping(SliderClamping::Edits));
        spoken::name(ui, &slider);
        let number = DragValue::new(&mut typed)
            .speed((range.end() - range.start()) / f64::from(ui.spacing().slider_width))
            .suffix(unit)
            .max_decimals(decimals)
            .range(range)
            .clamp_existing_to_range(false)
            .custom_parser(arithmetic::value)
            .update_while_editing(false);
        if named(ui, number, "as a number").changed() {
            Some(typed)
        } else {
            slider.changed().then_some(slid)
        }
    })
    .inner
}

/// A whole number.
pub(super) fn count(ui: &mut Ui, value: f64) -> Option<f64> {
    let mut v = value;
    let widget = DragValue::new(&mut v)
        .speed(0.05)
        .fixed_decimals(0)
        .range(0.0..=f64::from(u32::MAX))
        .clamp_existing_to_range(false)
        .custom_parser(arithmetic::value)
        .update_while_editing(false);
    let response = ui.add(widget);
    spoken::name(ui, &response);
    response.changed().then_some(v.round())
}

/// Any number; what the part does not take, it refuses.
pub(super) fn number(ui: &mut Ui, value: f64, unit: &str, pace: Pace) -> Option<f64> {
    let suffix = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    number::edit(ui, value, pace, |ui, widget| named(ui, widget.suffix(suffix), ""))
}

/// Three numbers in a row.
pub(super) fn vector(ui: &mut Ui, value: DVec3, pace: Pace) -> Option<DVec3> {
    numbers(ui, value.to_array(), pace).map(DVec3::from_array)
}

/// Two numbers in a row.
pub(super) fn pair(ui: &mut Ui, value: DVec2) -> Option<DVec2> {
    numbers(ui, value.to_array(), Pace::Value).map(DVec2::from_array)
}

/// Rows of numbers, one below the other.
pub(super) fn rows(ui: &mut Ui, value: &Rows) -> Option<Rows> {
    let mut rows: Vec<Vec<f64>> = value.iter().map(<[f64]>::to_vec).collect();
    let mut changed = false;
    ui.vertical(|ui| rows.iter_mut().for_each(|row| changed |= drag_all(ui, row, Pace::Scene)));
    changed.then(|| rows.iter().fold(Rows::default(), |all, row| all.with(row)))
}

fn numbers<const N: usize>(ui: &mut Ui, value: [f64; N], pace: Pace) -> Option<[f64; N]> {
    let mut v = value;
    drag_all(ui, &mut v, pace).then_some(v)
}

/// Numbers side by side; whether one was changed.
fn drag_all(ui: &mut Ui, numbers: &mut [f64], pace: Pace) -> bool {
    let mut changed = false;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for (part, name) in numbers.iter_mut().zip(["x", "y", "z"].into_iter().chain(std::iter::repeat(""))) {
            let size = [49.0, ui.spacing().interact_size.y];
            let shape = |ui: &mut Ui, widget: DragValue<'_>| {
                let response = ui.add_sized(size, widget);
                spoken::name_part(ui, &response, name);
                response
            };
            if let Some(new) = number::edit(ui, *part, pace, shape) {
                *part = new;
                changed = true;
            }
        }
    });
    changed
}

/// An amount of light: its strongest channel as a number, and its colour relative to that.
pub(super) fn quantity(ui: &mut Ui, value: Rgb) -> Option<Rgb> {
    let strength = value.max_channel();
    let tint = if strength > 0.0 { value * (1.0 / strength) } else { Rgb::BLACK };
    // Of no light one picks a colour as strong as it is shown.
    let of_tint = |tint: Rgb| color::short(tint * if strength > 0.0 { strength } else { 1.0 });
    ui.horizontal(|ui| {
        let swatch = color::swatch(ui, tint).map(of_tint);
        let tip = "The tint in sRGB digits such as #ffd080, or the amount in three linear numbers as in the file, such as 8 6.5 4.";
        let picked = color::digits(ui, tint, tip).map(|typed| match typed {
            Typed::Digits(tint) => of_tint(tint),
            Typed::Numbers(amount) => amount,
        });
        let picked = picked.or(swatch);
        let typed = number::edit(ui, strength, Pace::Value, |ui, widget| named(ui, widget, "strength"));
        let tint = if strength > 0.0 { tint } else { Rgb::WHITE };
        typed.filter(|typed| *typed >= 0.0).map(|typed| tint * typed).or(picked)
    })
    .inner
}

/// Yes or no.
pub(super) fn flag(ui: &mut Ui, value: bool) -> Option<bool> {
    let mut on = value;
    let response = ui.checkbox(&mut on, "");
    spoken::name(ui, &response);
    response.changed().then_some(on)
}

/// Adds a number that is called as a part of what the last label says.
fn named(ui: &mut Ui, widget: DragValue<'_>, part: &str) -> Response {
    let response = ui.add(widget);
    spoken::name_part(ui, &response, part);
    response
}

/// One of a list of words; the new one, if another is picked.
pub(super) fn choice(ui: &mut Ui, name: &str, words: &[&str], now: &str) -> Option<String> {
    let mut picked = None;
    let shown = ComboBox::from_id_salt(name).selected_text(now).show_ui(ui, |ui| {
        for word in words {
            if ui.selectable_label(*word == now, *word).clicked() {
                picked = Some((*word).to_owned());
            }
        }
    });
    spoken::name(ui, &shown.response);
    picked.filter(|word| word != now)
}
