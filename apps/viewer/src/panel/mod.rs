//! What stands beside and over the picture? The panel with tree, inspector and switches, the status line, the list of
//! keys and the report of an error.

mod dialogs;
mod fields;
mod inspector;
mod placement;
mod switches;
mod theme;
mod tree;

use egui::{Frame, Margin, Panel, Rect, Ui};

use crate::viewer::Viewer;

pub(crate) use theme::set_theme;

/// Width of the panel in points.
const WIDTH: f32 = 272.0;

/// Shows everything that egui shows; what a person changes goes to the viewer. Returns the room left for the picture,
/// in points.
pub(crate) fn show(ui: &mut Ui, viewer: &mut Viewer, status: &str) -> Rect {
    let whole = ui.max_rect();
    let mut room = whole;
    if viewer.shown.panel && whole.width() > 1.5 * WIDTH {
        room.max.x -= WIDTH;
        let frame = Frame::new().fill(theme::PANEL).inner_margin(Margin::symmetric(10, 8));
        Panel::right("panel")
            .exact_size(WIDTH)
            .resizable(false)
            .show_separator_line(false)
            .frame(frame)
            .show_inside(ui, |ui| side(ui, viewer));
    }
    dialogs::status(ui, viewer, status, room);
    dialogs::help(ui, viewer, room);
    dialogs::error(ui, viewer, room);
    if ui.input(|input| input.pointer.any_released()) {
        viewer.document.end_step();
    }
    room
}

fn side(ui: &mut Ui, viewer: &mut Viewer) {
    let saved = if viewer.document.is_saved() { "" } else { " *" };
    ui.horizontal(|ui| {
        ui.strong(format!("{}{saved}", viewer.document.name()));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.weak("F1 for keys");
        });
    });
    ui.add_space(4.0);
    let third = (0.34 * ui.available_height()).max(80.0);
    tree::show(ui, viewer, third);
    ui.separator();
    egui::ScrollArea::vertical().id_salt("inspector").auto_shrink([false, false]).show(ui, |ui| {
        inspector::show(ui, viewer);
        ui.add_space(6.0);
        switches::show(ui, viewer);
    });
}
