//! How is a file chosen? A list of what lies in a folder, over all else.

use std::path::{Path, PathBuf};

use egui::{Frame, Id, Key, Modal, Rect, RichText, ScrollArea, TextEdit, Ui};

use super::{pictures, spoken, theme};
use crate::browse::{Browser, Purpose};
use crate::desktop_dialog;
use crate::viewer::{Viewer, Wanted};

/// Width of the box in points, where the window has room.
const WIDTH: f32 = 440.0;

/// What a person does to the way to a file.
enum Step {
    Stay,
    Cancel,
    /// The desktop's own dialog is to ask.
    Desktop,
    Chosen(PathBuf),
}

/// Shows the folder, if a file is wanted. All keys and clicks are for the box while it stands there.
pub(super) fn show(ui: &Ui, viewer: &mut Viewer, window: Rect) {
    let Some(mut browser) = viewer.browser.take() else { return };
    let frame = Frame::window(ui.style()).inner_margin(14);
    let modal = Modal::new(Id::new("files")).frame(frame).show(ui.ctx(), |ui| {
        ui.set_width((window.width() - 40.0).clamp(60.0, WIDTH));
        let height = (window.height() - 190.0).clamp(40.0, 320.0);
        contents(ui, &mut browser, height)
    });
    match modal.inner {
        Step::Stay => viewer.browser = Some(browser),
        Step::Cancel => {}
        Step::Desktop => {
            browser.waits = true;
            viewer.wanted = Some(Wanted::DesktopDialog);
            viewer.browser = Some(browser);
        }
        Step::Chosen(path) => viewer.chosen(browser.purpose, path),
    }
}

fn contents(ui: &mut Ui, browser: &mut Browser, height: f32) -> Step {
    let word = match browser.purpose {
        Purpose::Open => "Open",
        Purpose::Save(_) => "Save",
        Purpose::Model => "Put in",
        Purpose::Picture(_) => "Write",
    };
    ui.label(RichText::new(browser.purpose.title()).strong().size(15.0));
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        if ui.button("Up").on_hover_text("The folder that this one lies in.").clicked() {
            browser.go_up();
        }
        ui.add(egui::Label::new(browser.folder.display().to_string()).truncate());
    });
    let opened = list(ui, browser, height);
    let mut step = opened.map_or(Step::Stay, |name| {
        browser.typed = name;
        browser.choose().map_or(Step::Stay, Step::Chosen)
    });
    let field = ui
        .add(TextEdit::singleline(&mut browser.typed).hint_text("name or path").desired_width(f32::INFINITY));
    spoken::next(ui, "name or path");
    spoken::name(ui, &field);
    if field.changed() {
        (browser.problem, browser.replaces) = (None, None);
    }
    // To be asked before it gets the keys back.
    let field_left = field.lost_focus();
    if ui.memory(|memory| memory.focused().is_none()) {
        field.request_focus();
    }
    let spec_left = match &mut browser.purpose {
        Purpose::Picture(spec) => pictures::spec(ui, spec),
        _ => false,
    };
    let entered = (field_left || spec_left) && ui.input(|input| input.key_pressed(Key::Enter));
    if let Some(problem) = &browser.problem {
        ui.label(RichText::new(problem).color(theme::ACCENT));
    }
    ui.add_space(6.0);
    ui.horizontal(|ui| {
        let word = if browser.replaces.is_some() { "Replace" } else { word };
        let button = |word| egui::Button::new(word).min_size(egui::vec2(72.0, 24.0));
        if ui.add(button(word)).clicked() || entered {
            match browser.choose() {
                Some(path) => step = Step::Chosen(path),
                // The next Enter chooses again.
                None => field.request_focus(),
            }
        }
        if ui.add(button("Cancel")).clicked() {
            step = Step::Cancel;
        }
        let own = egui::Button::new("Desktop’s dialog…");
        if desktop_dialog::is_there() && ui.add_enabled(!browser.waits, own).clicked() {
            step = Step::Desktop;
        }
    });
    step
}

/// What lies in the folder; a click takes a name, a double click opens it. Returns what was opened.
fn list(ui: &mut Ui, browser: &mut Browser, height: f32) -> Option<String> {
    let mut opened = None;
    let row = ui.spacing().interact_size.y;
    let area = ScrollArea::vertical().id_salt("files").auto_shrink([false, false]).max_height(height);
    area.show_rows(ui, row, browser.entries.len(), |ui, seen| {
        for entry in &browser.entries[seen] {
            let shown = if entry.is_folder { format!("{}/", entry.name) } else { entry.name.clone() };
            let label = ui.selectable_label(Path::new(&browser.typed) == Path::new(&entry.name), shown);
            if label.double_clicked() || (label.clicked() && entry.is_folder) {
                opened = Some(entry.name.clone());
            } else if label.clicked() {
                browser.typed.clone_from(&entry.name);
                (browser.problem, browser.replaces) = (None, None);
            }
        }
    });
    opened
}
