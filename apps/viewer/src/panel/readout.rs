//! What is read off the picture? Which colour stands for which number, and what the pointer points to.

use catoptra_scene::image::false_color::{Scale, color};
use egui::{Align2, Area, Color32, Frame, Id, Margin, Order, Pos2, Rect, Sense, Ui, Vec2};

use super::theme;
use crate::viewer::Viewer;

/// Width and height of the bar of colours, in points.
const BAR: Vec2 = Vec2::new(14.0, 150.0);

/// How far from the pointer its words stand, in points.
const ASIDE: Vec2 = Vec2::new(16.0, 14.0);

/// Shows both, if there are any.
pub(super) fn show(ui: &Ui, viewer: &Viewer, room: Rect) {
    if let Some((scale, unit)) = &viewer.readout.legend {
        let corner = room.right_bottom() - egui::vec2(8.0, 8.0);
        floating(ui, ("legend", Align2::RIGHT_BOTTOM), corner, room, |ui| legend(ui, scale, unit));
    }
    if let Some(text) = &viewer.readout.pointed {
        let at = viewer.pointer.at;
        let pointer = Pos2::new(at.0 as f32, at.1 as f32) / ui.ctx().pixels_per_point();
        floating(ui, ("pointed", Align2::LEFT_TOP), pointer + ASIDE, room, |ui| {
            ui.add(egui::Label::new(text).extend());
        });
    }
}

fn floating(ui: &Ui, (name, pivot): (&str, Align2), at: Pos2, room: Rect, content: impl FnOnce(&mut Ui)) {
    let frame = Frame::new().fill(theme::FLOATING).corner_radius(4).inner_margin(Margin::symmetric(8, 4));
    Area::new(Id::new(name))
        .order(Order::Middle)
        .interactable(false)
        .pivot(pivot)
        .fixed_pos(at)
        .constrain_to(room)
        .show(ui.ctx(), |ui| frame.show(ui, content));
}

fn legend(ui: &mut Ui, scale: &Scale, unit: &str) {
    ui.add(egui::Label::new(unit).extend());
    ui.add_space(6.0);
    let (space, _) = ui.allocate_exact_size(BAR + egui::vec2(64.0, 0.0), Sense::hover());
    let bar = Rect::from_min_size(space.min, BAR);
    let painter = ui.painter();
    let steps = BAR.y as u32;
    for step in 0..steps {
        let [r, g, b] = color(1.0 - f64::from(step) / f64::from(steps));
        let top = bar.top() + step as f32;
        let row = Rect::from_min_max(egui::pos2(bar.left(), top), egui::pos2(bar.right(), top + 1.0));
        painter.rect_filled(row, 0.0, Color32::from_rgb(r, g, b));
    }
    let font = egui::TextStyle::Small.resolve(ui.style());
    let lines = scale.lines();
    let told = if lines.is_empty() { vec![scale.ends()[0]] } else { lines };
    for number in told {
        let y = bar.bottom() - BAR.y * scale.share(number).clamp(0.0, 1.0) as f32;
        painter.hline(bar.x_range(), y, egui::Stroke::new(1.0, Color32::BLACK));
        let place = egui::pos2(bar.right() + 6.0, y);
        painter.text(place, Align2::LEFT_CENTER, super::short(number), font.clone(), Color32::WHITE);
    }
}
