//! How large and how fine is a picture to be, and how far is it?

use std::time::Duration;

use egui::{Align2, Area, DragValue, Frame, Id, Margin, Order, Rect, Ui};

use super::{spoken, theme};
use crate::arithmetic;
use crate::pictures::{Colors, LARGEST_SIDE, Spec};
use crate::viewer::Viewer;

/// The most samples that can be asked for.
const MOST_SAMPLES: u32 = catoptra_core::Settings::MAX_SAMPLES;

/// How often is looked how far a picture is.
const EVERY: Duration = Duration::from_millis(150);

/// The fields for what a picture is to be like. Whether the keys have just left one of them.
pub(super) fn spec(ui: &mut Ui, spec: &mut Spec) -> bool {
    let number = |ui: &mut Ui, name: &str, value: &mut u32, most: u32| {
        spoken::label(ui, name);
        let widget = DragValue::new(value).range(1..=most).speed(1.0).custom_parser(arithmetic::value);
        let number = ui.add(widget.update_while_editing(false));
        spoken::name(ui, &number);
        number.lost_focus()
    };
    let fields = ui.horizontal_wrapped(|ui| {
        let width = number(ui, "width", &mut spec.width, LARGEST_SIDE);
        let height = number(ui, "height", &mut spec.height, LARGEST_SIDE);
        let is_light = spec.colors == Colors::Light;
        let samples = is_light && number(ui, "samples a pixel", &mut spec.samples, MOST_SAMPLES);
        width || height || samples
    });
    fields.inner
}

/// What is being made, how far it is, and a button to give it up.
pub(super) fn progress(ui: &Ui, viewer: &Viewer, room: Rect) {
    let Some(under_way) = viewer.pictures.under_way() else { return };
    ui.ctx().request_repaint_after(EVERY);
    let name = under_way.path.file_name().unwrap_or_default().to_string_lossy();
    let control = &under_way.control;
    let far = match control.reached() {
        Some(reached) => format!("{:.1} samples a pixel, error {:.1e}", reached.samples, reached.error),
        None => format!("{:.0} %", 100.0 * control.progress()),
    };
    let told = if control.is_cancelled() { format!("{name}: ending") } else { format!("{name}: {far}") };
    let frame = Frame::new().fill(theme::FLOATING).corner_radius(4).inner_margin(Margin::symmetric(10, 6));
    Area::new(Id::new("picture under way"))
        .order(Order::Middle)
        .pivot(Align2::LEFT_TOP)
        .fixed_pos(room.left_top() + egui::vec2(8.0, 8.0))
        .constrain_to(room)
        .show(ui.ctx(), |ui| {
            frame.show(ui, |ui| {
                ui.horizontal(|ui| {
                    ui.label(told);
                    if ui.button("Cancel").on_hover_text("Nothing is written then.").clicked() {
                        viewer.pictures.cancel();
                    }
                });
            });
        });
}
