//! How is a colour shown and changed? A swatch, and its sRGB digits as other programs give them, or its linear numbers as the
//! file has them.

use catoptra_core::{Rgb, srgb_decoded, srgb_encoded};
use egui::{Id, TextEdit, Ui};

use super::spoken;
use crate::arithmetic;

/// Width of the digits, in points.
const WIDTH: f32 = 58.0;

/// A reflectance.
pub(super) fn edit(ui: &mut Ui, value: Rgb) -> Option<Rgb> {
    ui.horizontal(|ui| {
        let picked = swatch(ui, value);
        let tip =
            "sRGB digits such as #c86432, or three linear numbers as in the file, such as 0.58 0.13 0.03.";
        let typed = digits(ui, value, tip).map(|typed| match typed {
            Typed::Digits(color) | Typed::Numbers(color) => color,
        });
        typed.filter(|color| color.max_channel() <= 1.0).or(picked)
    })
    .inner
}

/// What was typed for a colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Typed {
    /// sRGB digits: a colour as a display shows it.
    Digits(Rgb),
    /// Linear numbers, none below zero.
    Numbers(Rgb),
}

/// A swatch that opens a palette.
pub(super) fn swatch(ui: &mut Ui, value: Rgb) -> Option<Rgb> {
    let mut rgb = [value.r as f32, value.g as f32, value.b as f32];
    let [r, g, b] = value.to_array().map(super::short);
    let response = ui.color_edit_button_rgb(&mut rgb).on_hover_text(format!("linear {r} {g} {b}"));
    spoken::name(ui, &response);
    let channel = |v: f32| f64::from(v.clamp(0.0, 1.0));
    response.changed().then(|| short(Rgb::new(channel(rgb[0]), channel(rgb[1]), channel(rgb[2]))))
}

/// With four digits in each number, more than a display can tell: a file is not to hold more.
pub(super) fn short(color: Rgb) -> Rgb {
    let [r, g, b] = color.to_array().map(|v| format!("{v:.3e}").parse().unwrap_or(v));
    Rgb::new(r, g, b)
}

/// The digits, to be typed.
pub(super) fn digits(ui: &mut Ui, value: Rgb, tip: &str) -> Option<Typed> {
    let id: Id = ui.make_persistent_id("digits");
    let now = hex(value);
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| now.clone());
    let field = TextEdit::singleline(&mut text).id(id).desired_width(WIDTH).font(egui::TextStyle::Small);
    let response = ui.add(field).on_hover_text(tip);
    spoken::name_part(ui, &response, "digits");
    if response.gained_focus() {
        // What is typed takes the place of all that stands there.
        let mut state = egui::text_edit::TextEditState::load(ui.ctx(), id).unwrap_or_default();
        let all = egui::text::CCursorRange::two(
            egui::text::CCursor::new(0),
            egui::text::CCursor::new(text.chars().count()),
        );
        state.cursor.set_char_range(Some(all));
        state.store(ui.ctx(), id);
    }
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text));
        return None;
    }
    ui.data_mut(|data| data.remove_temp::<String>(id));
    let given_up = ui.input(|input| input.key_pressed(egui::Key::Escape));
    if response.lost_focus() && !given_up && text != now { parsed(&text) } else { None }
}

/// A colour by its sRGB digits, two for each of red, green and blue.
fn hex(color: Rgb) -> String {
    let [r, g, b] = color.to_array().map(|v| (srgb_encoded(v.clamp(0.0, 1.0)) * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The colour that a text stands for: six or three sRGB digits, or three linear numbers, or one for a grey.
fn parsed(text: &str) -> Option<Typed> {
    let text = text.trim();
    let digits = text.strip_prefix('#').unwrap_or(text);
    let is_hex = digits.is_ascii() && digits.chars().all(|c| c.is_ascii_hexdigit());
    let wide: String = match digits.len() {
        6 if is_hex => digits.to_owned(),
        3 if is_hex && text.starts_with('#') => digits.chars().flat_map(|c| [c, c]).collect(),
        _ => return linear(text).map(Typed::Numbers),
    };
    let channel = |at: usize| {
        let byte = u8::from_str_radix(wide.get(at..at + 2)?, 16).ok()?;
        Some(srgb_decoded(f64::from(byte) / 255.0))
    };
    Some(Typed::Digits(short(Rgb::new(channel(0)?, channel(2)?, channel(4)?))))
}

fn linear(text: &str) -> Option<Rgb> {
    let numbers: Vec<f64> = text
        .split(|c: char| c.is_whitespace() || c == ',')
        .filter(|part| !part.is_empty())
        .map(|part| arithmetic::value(part).filter(|v| (0.0..f64::INFINITY).contains(v)))
        .collect::<Option<_>>()?;
    match numbers[..] {
        [grey] => Some(Rgb::grey(grey)),
        [r, g, b] => Some(Rgb::new(r, g, b)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn digits(color: Rgb) -> Option<Typed> {
        Some(Typed::Digits(color))
    }

    fn numbers(color: Rgb) -> Option<Typed> {
        Some(Typed::Numbers(color))
    }

    #[test]
    fn digits_come_back_as_they_were() {
        for text in ["#c86432", "#000000", "#ffffff", "#010203"] {
            let Some(Typed::Digits(color)) = parsed(text) else { panic!("{text} is in digits") };
            assert_eq!(hex(color), text);
        }
        assert_eq!(parsed("c86432"), parsed("#c86432"));
        assert_eq!(parsed("#fff"), digits(Rgb::WHITE));
        assert_eq!(parsed("#7a4a2a"), digits(Rgb::new(0.1946, 0.06848, 0.02315)), "with few digits");
    }

    #[test]
    fn linear_numbers_are_taken_as_the_file_has_them() {
        assert_eq!(parsed("0.5 0.25 1"), numbers(Rgb::new(0.5, 0.25, 1.0)));
        assert_eq!(parsed("0.5, 1/4, 1"), numbers(Rgb::new(0.5, 0.25, 1.0)));
        assert_eq!(parsed("0.5"), numbers(Rgb::grey(0.5)));
        assert_eq!(parsed("12 8 1e3"), numbers(Rgb::new(12.0, 8.0, 1000.0)));
        assert_eq!(parsed("#808080"), digits(Rgb::grey(0.2159)));
        for text in ["", "#12", "#ggg", "red", "1 -2 3", "1 2 1e999", "0.1 0.2", "#12345", "0.1 0.2 0.3 0.4"]
        {
            assert_eq!(parsed(text), None, "{text}");
        }
    }
}
