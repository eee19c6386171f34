//! What floats over the picture? The status line, what has failed, and the report of an error.

use egui::{Align2, Area, Frame, Id, Margin, Order, Rect, RichText, Stroke, Ui, Window};

use super::theme;
use crate::viewer::Viewer;

/// The line at the lower left of the picture: figures, and what there is to tell.
pub(super) fn status(ui: &Ui, viewer: &Viewer, figures: &str, room: Rect) {
    let frame = Frame::new().fill(theme::FLOATING).corner_radius(4).inner_margin(Margin::symmetric(8, 3));
    Area::new(Id::new("status"))
        .order(Order::Middle)
        .interactable(false)
        .pivot(Align2::LEFT_BOTTOM)
        .fixed_pos(room.left_bottom() + egui::vec2(8.0, -8.0))
        .constrain_to(room)
        .show(ui.ctx(), |ui| {
            frame.show(ui, |ui| {
                ui.set_max_width((room.width() - 32.0).max(40.0));
                if let Some((notice, _)) = &viewer.notice {
                    ui.add(egui::Label::new(RichText::new(notice).color(theme::ACCENT)).wrap());
                }
                ui.add(egui::Label::new(figures).wrap());
            });
        });
}

/// What could not be done: it stands until it is done or taken away.
pub(super) fn failure(ui: &Ui, viewer: &mut Viewer, room: Rect) {
    let Some(failure) = viewer.failure.clone() else { return };
    let frame = Frame::new().fill(theme::FLOATING).stroke(Stroke::new(1.5, theme::FAILURE)).corner_radius(4);
    Area::new(Id::new("failure"))
        .order(Order::Middle)
        .pivot(Align2::CENTER_TOP)
        .fixed_pos(room.center_top() + egui::vec2(0.0, 44.0))
        .constrain_to(room)
        .show(ui.ctx(), |ui| {
            frame.inner_margin(Margin::symmetric(10, 6)).show(ui, |ui| {
                ui.set_max_width((room.width() - 40.0).clamp(40.0, 560.0));
                ui.add(egui::Label::new(RichText::new(failure).color(theme::FAILURE)).wrap());
                if ui.button("Close").clicked() {
                    viewer.failure = None;
                }
            });
        });
}

/// What is wrong with a file.
pub(super) fn error(ui: &Ui, viewer: &mut Viewer, room: Rect) {
    let Some(broken) = &viewer.error else { return };
    let mut open = true;
    let (mut closed, mut retried) = (false, false);
    let report = &broken.report;
    Window::new(RichText::new("This scene cannot be opened").color(theme::ACCENT))
        .open(&mut open)
        .default_pos(room.left_top() + egui::vec2(24.0, 24.0))
        .default_width((room.width() - 80.0).clamp(120.0, 760.0))
        .collapsible(false)
        .show(ui.ctx(), |ui| {
            egui::ScrollArea::both().max_height((room.height() - 140.0).max(60.0)).show(ui, |ui| {
                ui.add(egui::Label::new(RichText::new(report).monospace()).extend());
            });
            ui.add_space(4.0);
            ui.horizontal_wrapped(|ui| {
                retried = ui.button("Retry").on_hover_text("Read the file again.").clicked();
                closed = ui.button("Close").clicked();
                ui.weak("the last scene stays open; the file is read again when it is changed");
            });
        });
    if retried {
        viewer.leave(broken.source.clone());
    } else if !open || closed {
        viewer.error = None;
    }
}
