//! Which keys are there? A list that fits into any window, scrolls, and can be searched.

use egui::{Align2, Id, Label, Margin, Rect, RichText, ScrollArea, TextEdit, Ui, Window, vec2};

use super::spoken;
use crate::keys::{OTHERS, bindings};
use crate::viewer::Viewer;

/// The most points that the list takes.
const WIDEST: f32 = 560.0;

/// Points of the column of keys; below twice this, what they do stands under them.
const KEYS: f32 = 150.0;

/// Points of the list's title, its rim and its search field.
const AROUND: f32 = 96.0;

/// Shows the list, if it is open, within the window.
pub(super) fn show(ui: &Ui, viewer: &mut Viewer, whole: Rect) {
    if !viewer.shown.help {
        return;
    }
    let mut open = true;
    let width = (whole.width() - 28.0).clamp(60.0, WIDEST);
    let height = (whole.height() - AROUND).max(30.0);
    let shown = Window::new("Keys and mouse")
        .open(&mut open)
        .pivot(Align2::CENTER_CENTER)
        .fixed_pos(whole.center())
        .constrain_to(whole)
        .collapsible(false)
        .resizable(false)
        .frame(egui::Frame::window(ui.style()).inner_margin(Margin::same(8)))
        .show(ui.ctx(), |ui| {
            ui.set_width(width);
            let search = search(ui);
            ScrollArea::vertical()
                .max_height(height)
                .min_scrolled_height(height)
                .auto_shrink([false, true])
                .show(ui, |ui| list(ui, &search));
        });
    if let Some(shown) = shown {
        ui.ctx().move_to_top(shown.response.layer_id);
    }
    viewer.shown.help = open;
}

/// The field for what is searched; what stands in it.
fn search(ui: &mut Ui) -> String {
    let id = Id::new("search of keys");
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_default();
    let field = TextEdit::singleline(&mut text).hint_text("search").desired_width(f32::INFINITY);
    let field = ui.add(field);
    spoken::next(ui, "search");
    spoken::name(ui, &field);
    if field.changed() {
        ui.data_mut(|data| data.insert_temp(id, text.clone()));
    }
    text
}

/// All lines: what is done, and what follows.
fn lines() -> impl Iterator<Item = (&'static str, &'static str)> {
    OTHERS.iter().copied().chain(bindings().map(|binding| (binding.label, binding.doc)))
}

fn list(ui: &mut Ui, search: &str) {
    let width = ui.available_width();
    for (what, does) in lines().filter(|line| is_found(*line, search)) {
        if width < 2.0 * KEYS {
            ui.add(Label::new(RichText::new(what).strong()).wrap());
            ui.add(Label::new(does).wrap());
            ui.add_space(4.0);
            continue;
        }
        ui.horizontal_top(|ui| {
            ui.allocate_ui(vec2(KEYS, 0.0), |ui| {
                ui.set_width(KEYS);
                ui.add(Label::new(RichText::new(what).strong()).wrap());
            });
            ui.add(Label::new(does).wrap());
        });
    }
}

/// Whether a line holds all the words that are searched, in whatever case.
fn is_found((what, does): (&str, &str), search: &str) -> bool {
    let line = format!("{what} {does}").to_lowercase();
    search.to_lowercase().split_whitespace().all(|word| line.contains(word))
}

#[cfg(test)]
mod tests {
    use catoptra_tracer::Pool;

    use super::*;
    use crate::loader;

    #[test]
    fn lines_are_found_by_their_words_in_any_order_and_case() {
        let line = ("Ctrl+D", "duplicate what is selected");
        assert!(
            ["", "ctrl+d", "SELECTED dup", " what  is "].into_iter().all(|search| is_found(line, search))
        );
        assert!(!is_found(line, "duplicate nothing"));
        assert_eq!(lines().filter(|line| is_found(*line, "zoom to the pointer")).count(), 1);
        assert!(lines().any(|line| is_found(line, "ctrl text larger")), "UI zoom is listed");
    }

    #[test]
    fn the_list_lies_within_windows_of_any_size() {
        for size in [(1280.0, 720.0), (500.0, 350.0), (250.0, 175.0), (210.0, 150.0)] {
            let mut viewer = Viewer::new(loader::welcome(&Pool::new(1).unwrap()).unwrap());
            viewer.shown.help = true;
            let context = egui::Context::default();
            let screen = Rect::from_min_size(egui::Pos2::ZERO, vec2(size.0, size.1));
            for _ in 0..3 {
                let input = egui::RawInput { screen_rect: Some(screen), ..Default::default() };
                let _ = context.run_ui(input, |ui| show(ui, &mut viewer, ui.max_rect()));
            }
            let shown = context.memory(|memory| memory.area_rect(Id::new("Keys and mouse"))).unwrap();
            assert!(screen.contains_rect(shown), "{shown:?} in {screen:?}");
            assert!(shown.width() > 0.4 * size.0.min(WIDEST), "{shown:?}");
        }
    }
}
