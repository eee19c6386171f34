//! How is a field of any part shown and changed? One row for each field, as its kind asks, so that a new part needs none.

use std::hash::{Hash as _, Hasher as _};

use catoptra_core::{Field, FieldKind, InvalidPart, Kind, TextureId, Value, Values};
use egui::Ui;

use super::number::Pace;
use super::{color, paint, spoken, widgets};

/// Points between names and values.
const GAP: f32 = 8.0;

/// Points beside a slider: its number and two small buttons.
const BESIDE_SLIDER: f32 = 92.0;

/// Points beside a list: a second, narrow one.
const BESIDE_LIST: f32 = 46.0;

/// The narrowest that a slider or a list becomes, in points.
const NARROWEST: f32 = 32.0;

/// The most rows of numbers that are shown one by one.
const MOST_ROWS: usize = 32;

/// What is done to a field.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Changed {
    /// Its name.
    pub(super) field: &'static str,
    /// Its new value; `None` where it is taken away.
    pub(super) value: Option<Value>,
}

impl Changed {
    /// The values of a part with this change: a field that stands instead of another takes its place.
    pub(super) fn apply(&self, fields: &[Field], values: Values) -> Values {
        let Some(value) = self.value.clone() else { return values.without(self.field) };
        let other = fields.iter().find(|field| field.name == self.field).and_then(|field| field.instead_of);
        let values = match other {
            Some(other) => values.without(other),
            None => values,
        };
        values.with(self.field, value)
    }

    /// A part of that kind and those values, with this change.
    ///
    /// # Errors
    /// A value that the part refuses.
    pub(super) fn make<T>(&self, kind: &Kind<T>, values: Values) -> Result<T, InvalidPart> {
        (kind.make)(&self.apply(kind.fields, values))
    }
}

/// What can be done to fields beside changing the values that they have.
#[derive(Clone, Copy)]
pub(super) struct Offers<'a> {
    /// The textures to choose from, with their names.
    pub(super) textures: &'a [(TextureId, String)],
    /// Whether a field takes that value.
    pub(super) takes: &'a dyn Fn(&'static str, Value) -> bool,
    /// What a field would be if it stood instead of the one that is given.
    pub(super) equivalent: &'a dyn Fn(&Field) -> Option<Value>,
    /// What is said of that.
    pub(super) note: &'a str,
    /// Whether fields that need not be given can be given and taken away.
    pub(super) optional: bool,
}

impl Offers<'_> {
    /// Nothing but the values.
    pub(super) const NONE: Offers<'static> =
        Offers { textures: &[], takes: &|_, _| false, equivalent: &|_| None, note: "", optional: false };
}

/// Shows fields with their values in two columns. Returns what a person does to one of them.
pub(super) fn show(
    ui: &mut Ui,
    salt: u64,
    fields: impl IntoIterator<Item = &'static Field>,
    values: &Values,
    offers: &Offers<'_>,
) -> Option<Changed> {
    let fields: Vec<&'static Field> = fields.into_iter().collect();
    let room = ui.available_width() - widest_name(ui, &fields) - GAP;
    let mut changed = None;
    egui::Grid::new(("fields", salt)).num_columns(2).spacing([GAP, 4.0]).show(ui, |ui| {
        ui.spacing_mut().slider_width = (room - BESIDE_SLIDER).clamp(NARROWEST, ui.spacing().slider_width);
        ui.spacing_mut().combo_width = (room - BESIDE_LIST).clamp(NARROWEST, ui.spacing().combo_width);
        for field in fields {
            if let Some(value) = row(ui, (salt, field), values, offers) {
                changed = Some(Changed { field: field.name, value });
            }
        }
    });
    changed
}

/// Points that the widest of the names takes.
fn widest_name(ui: &Ui, fields: &[&'static Field]) -> f32 {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let width = |field: &&Field| {
        ui.painter().layout_no_wrap(field.name.to_owned(), font.clone(), egui::Color32::WHITE).size().x
    };
    fields.iter().map(width).fold(0.0, f32::max)
}

/// A key for the steps of one field of one thing.
pub(super) fn step_key(what: &str, index: u32, field: &str) -> u64 {
    let mut hasher = std::hash::DefaultHasher::new();
    (what, index, field).hash(&mut hasher);
    hasher.finish() >> 1
}

/// Shows one field, if there is anything to show. Returns its new value, which may be none.
fn row(
    ui: &mut Ui,
    (salt, field): (u64, &'static Field),
    values: &Values,
    offers: &Offers<'_>,
) -> Option<Option<Value>> {
    let replaced = field.instead_of.filter(|other| values.get(other).is_some());
    let default = || field.default.filter(|_| replaced.is_none()).map(|make| make());
    let new = match (values.get(field.name).cloned().or_else(default), replaced) {
        (Some(value), _) => return given(ui, (salt, field), &value, offers),
        (None, Some(other)) => {
            let value = (offers.equivalent)(field)?;
            ui.weak(field.name).on_hover_text(field.doc);
            offer(
                ui,
                field,
                value,
                &format!("Give the {} instead of the {other}. {}", field.name, offers.note),
            )
        }
        (None, None) => {
            let value = first_value(field, offers).filter(|_| offers.optional)?;
            ui.weak(field.name).on_hover_text(field.doc);
            ui.button("give").clicked().then_some(value)
        }
    };
    ui.end_row();
    new.map(Some)
}

/// A field that has a value, and below it the texture that multiplies it.
fn given(
    ui: &mut Ui,
    (salt, field): (u64, &'static Field),
    value: &Value,
    offers: &Offers<'_>,
) -> Option<Option<Value>> {
    spoken::label(ui, field.name).on_hover_text(field.doc);
    let can_be_taken =
        offers.optional && field.may_be_missing && field.default.is_none() && field.instead_of.is_none();
    let cell = |ui: &mut Ui| {
        let mut new = edit(ui, field, value, offers).map(Some);
        if let Some(value) = paint::add(ui, field, value, offers) {
            new = Some(Some(value));
        }
        if can_be_taken && ui.small_button("×").on_hover_text("Take it away.").clicked() {
            new = Some(None);
        }
        new
    };
    let mut new = ui.push_id((salt, field.name), |ui| ui.horizontal(cell).inner).inner;
    ui.end_row();
    if let Value::Textured(textured) = value {
        ui.weak("  × texture").on_hover_text("What multiplies it.");
        spoken::next(ui, &format!("texture of {}", field.name));
        let chosen =
            ui.push_id((salt, field.name, "texture"), |ui| paint::choose(ui, field, textured, offers));
        new = chosen.inner.map(Some).or(new);
        ui.end_row();
    }
    new
}

/// What a field is at first that need not be given; `None` where there is no such value.
fn first_value(field: &Field, offers: &Offers<'_>) -> Option<Value> {
    match field.kind {
        FieldKind::Fraction => Some(Value::Number(0.5)),
        FieldKind::Choice(words) => words.first().map(|word| Value::Word((*word).to_owned())),
        FieldKind::Texture => offers.textures.first().map(|(id, _)| Value::Texture(*id)),
        _ => None,
    }
}

fn edit(ui: &mut Ui, field: &Field, value: &Value, offers: &Offers<'_>) -> Option<Value> {
    match (field.kind, value) {
        (FieldKind::Fraction, Value::Number(v)) => widgets::slider(ui, *v, 0.0..=1.0, "").map(Value::Number),
        (FieldKind::Angle, Value::Number(v)) => widgets::slider(ui, v.to_degrees(), 0.0..=180.0, "°")
            .map(|degrees| Value::Number(degrees.to_radians())),
        (FieldKind::Count, Value::Number(v)) => widgets::count(ui, *v).map(Value::Number),
        (kind, Value::Number(v)) => {
            let pace = if kind == FieldKind::Length { Pace::Scene } else { Pace::Value };
            widgets::number(ui, *v, field.unit, pace).map(Value::Number)
        }
        (_, Value::Vector(v)) => {
            let pace = if field.unit == "m" { Pace::Scene } else { Pace::Value };
            widgets::vector(ui, *v, pace).map(Value::Vector)
        }
        (_, Value::Pair(v)) => widgets::pair(ui, *v).map(Value::Pair),
        (FieldKind::Color, Value::Color(c)) => color::edit(ui, *c).map(Value::Color),
        (_, Value::Color(c)) => widgets::quantity(ui, *c).map(Value::Color),
        (_, Value::Flag(on)) => widgets::flag(ui, *on).map(Value::Flag),
        (FieldKind::Choice(words), Value::Word(word)) => {
            widgets::choice(ui, field.name, words, word).map(Value::Word)
        }
        (_, Value::Texture(texture)) => paint::pick(ui, Some(*texture), offers.textures).map(Value::Texture),
        (_, Value::Textured(textured)) => {
            edit(ui, field, &textured.base, offers).map(|base| base.textured(textured.by))
        }
        (_, Value::Rows(rows)) if rows.iter().len() <= MOST_ROWS => widgets::rows(ui, rows).map(Value::Rows),
        (_, Value::Rows(rows)) => told(ui, &format!("{} rows", rows.iter().len()), || {
            format!("More than {MOST_ROWS} are edited in the file.")
        }),
        (_, Value::Word(word)) => told(ui, word, String::new),
        (_, Value::Mesh(source)) => {
            told(ui, &source.path, || format!("{} triangles", source.mesh.triangles().len()))
        }
        (_, Value::Profile(source)) => told(ui, &source.path, || {
            format!("{:.0} lm, at most {:.0} cd", source.profile.flux(), source.profile.peak())
        }),
        (_, Value::Image(source)) => told(ui, &source.path, || {
            format!("{}: {} x {} pixels", source.path, source.image.width(), source.image.height())
        }),
    }
}

/// What cannot be changed here, with more about it under the pointer.
fn told(ui: &mut Ui, text: &str, more: impl Fn() -> String) -> Option<Value> {
    ui.add(egui::Label::new(text).truncate()).on_hover_ui(|ui| {
        ui.label(more());
    });
    None
}

/// A button that tells what the field would be, or a list of words, to give it in place of the other.
fn offer(ui: &mut Ui, field: &Field, value: Value, tip: &str) -> Option<Value> {
    let size = match (field.kind, &value) {
        (FieldKind::Choice(words), _) => {
            return widgets::choice(ui, field.name, words, "–").map(Value::Word);
        }
        (_, Value::Color(c)) => c.max_channel(),
        (_, Value::Number(v)) => *v,
        _ => return None,
    };
    let text = format!("{} {}", super::short(size), field.unit);
    ui.button(text.trim_end()).on_hover_text(tip).clicked().then_some(value)
}
