//! How is a field of any part shown and changed? One widget for each kind of field, so that a new part needs none.

use std::hash::{Hash as _, Hasher as _};

use catoptra_core::glam::DVec3;
use catoptra_core::{Field, FieldKind, Rgb, Value, Values};
use egui::{ComboBox, DragValue, Slider, SliderClamping, Ui};

/// The share of a number's size that one pixel of dragging changes.
const DRAG_SPEED: f64 = 0.005;

/// Shows fields with their values in two columns. Returns the field that was changed and its new value.
pub(super) fn show(
    ui: &mut Ui,
    salt: u64,
    fields: &'static [Field],
    values: &Values,
) -> Option<(&'static str, Value)> {
    show_offering(ui, salt, fields, (values, |_: &str| None))
}

/// Shows fields as [`show`] does. A field that stands instead of one that is given is offered, where `equivalent` knows
/// what it would be.
pub(super) fn show_offering(
    ui: &mut Ui,
    salt: u64,
    fields: &'static [Field],
    (values, equivalent): (&Values, impl Fn(&str) -> Option<Value>),
) -> Option<(&'static str, Value)> {
    let mut changed = None;
    egui::Grid::new(("fields", salt)).num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
        for field in fields {
            let given = values.get(field.name).cloned().or_else(|| field.default.map(|make| make()));
            let new = match (given, field.instead_of) {
                (Some(value), _) => {
                    ui.label(field.name).on_hover_text(field.doc);
                    edit(ui, field, &value)
                }
                (None, Some(other)) => {
                    let Some(value) = equivalent(field.name) else { continue };
                    ui.weak(field.name).on_hover_text(field.doc);
                    offer(ui, field, other, value)
                }
                (None, None) => continue,
            };
            if let Some(value) = new {
                changed = Some((field.name, value));
            }
            ui.end_row();
        }
    });
    changed
}

/// A key for the steps of one field of one thing.
pub(super) fn step_key(what: &str, index: u32, field: &str) -> u64 {
    let mut hasher = std::hash::DefaultHasher::new();
    (what, index, field).hash(&mut hasher);
    hasher.finish() >> 1
}

fn edit(ui: &mut Ui, field: &Field, value: &Value) -> Option<Value> {
    match (field.kind, value) {
        (FieldKind::Fraction, Value::Number(v)) => slider(ui, *v, 0.0..=1.0, "").map(Value::Number),
        (FieldKind::Angle, Value::Number(v)) => {
            slider(ui, v.to_degrees(), 0.0..=180.0, "°").map(|degrees| Value::Number(degrees.to_radians()))
        }
        (FieldKind::Count, Value::Number(v)) => count(ui, *v).map(Value::Number),
        (kind, Value::Number(v)) => number(ui, *v, field.unit, kind == FieldKind::Length).map(Value::Number),
        (_, Value::Vector(v)) => vector(ui, *v).map(Value::Vector),
        (FieldKind::Color, Value::Color(c)) => color(ui, *c).map(Value::Color),
        (_, Value::Color(c)) => quantity(ui, *c).map(Value::Color),
        (_, Value::Flag(on)) => flag(ui, *on).map(Value::Flag),
        (FieldKind::Choice(words), Value::Word(word)) => choice(ui, field.name, words, word).map(Value::Word),
        (_, Value::Word(word)) => {
            ui.label(word);
            None
        }
        (_, Value::Mesh(source)) => {
            let triangles = source.mesh.triangles().len();
            ui.label(&source.path).on_hover_text(format!("{triangles} triangles"));
            None
        }
        (_, Value::Profile(source)) => {
            let (flux, peak) = (source.profile.flux(), source.profile.peak());
            ui.label(&source.path).on_hover_text(format!("{flux:.0} lm, at most {peak:.0} cd"));
            None
        }
        (_, Value::Pair(v)) => {
            ui.label(format!("{} {}", short(v.x), short(v.y)));
            None
        }
        (_, Value::Image(source)) => {
            let (width, height) = (source.image.width(), source.image.height());
            ui.label(&source.path).on_hover_text(format!("{width} x {height} pixels"));
            None
        }
        (_, Value::Texture(texture)) => {
            ui.label(texture.to_string());
            None
        }
        (_, Value::Textured(textured)) => {
            let base = edit(ui, field, &textured.base);
            ui.label("×").on_hover_text(textured.by.texture.to_string());
            base.map(|base| base.textured(textured.by))
        }
    }
}

/// A button that tells what the field would be, and gives it in place of the other.
fn offer(ui: &mut Ui, field: &Field, other: &str, value: Value) -> Option<Value> {
    let size = match &value {
        Value::Color(c) => c.max_channel(),
        Value::Number(v) => *v,
        _ => return None,
    };
    let text = format!("{} {}", short(size), field.unit);
    let tip = format!("Give the {} instead of the {other}; the light stays as it is.", field.name);
    ui.button(text).on_hover_text(tip).clicked().then_some(value)
}

/// Four digits of a number, in powers of ten where it is huge or tiny.
fn short(v: f64) -> String {
    let digits = format!("{v:.3e}");
    let rounded: f64 = digits.parse().unwrap_or(v);
    if v != 0.0 && !(1e-3..1e6).contains(&v.abs()) { digits } else { rounded.to_string() }
}

fn slider(ui: &mut Ui, value: f64, range: std::ops::RangeInclusive<f64>, unit: &str) -> Option<f64> {
    let mut v = value;
    let widest = if *range.end() > 1.0 { 1 } else { 3 };
    let clamping = SliderClamping::Edits;
    ui.add(Slider::new(&mut v, range).suffix(unit).max_decimals(widest).clamping(clamping))
        .changed()
        .then_some(v)
}

fn count(ui: &mut Ui, value: f64) -> Option<f64> {
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

fn number(ui: &mut Ui, value: f64, unit: &str, positive: bool) -> Option<f64> {
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
    let mut v = value;
    let mut changed = false;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for part in [&mut v.x, &mut v.y, &mut v.z] {
            let speed = speed(*part);
            let widget = DragValue::new(part).speed(speed).max_decimals(3);
            changed |= ui.add_sized([49.0, ui.spacing().interact_size.y], widget).changed();
        }
    });
    changed.then_some(v)
}

fn color(ui: &mut Ui, value: Rgb) -> Option<Rgb> {
    let mut rgb = [value.r as f32, value.g as f32, value.b as f32];
    let changed = ui.color_edit_button_rgb(&mut rgb).changed();
    let channel = |v: f32| f64::from(v.clamp(0.0, 1.0));
    changed.then(|| Rgb::new(channel(rgb[0]), channel(rgb[1]), channel(rgb[2])))
}

/// An amount of light: its strongest channel as a number, and its colour relative to that.
fn quantity(ui: &mut Ui, value: Rgb) -> Option<Rgb> {
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

fn flag(ui: &mut Ui, value: bool) -> Option<bool> {
    let mut on = value;
    ui.checkbox(&mut on, "").changed().then_some(on)
}

fn choice(ui: &mut Ui, name: &str, words: &[&str], now: &str) -> Option<String> {
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
