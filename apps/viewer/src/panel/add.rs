//! How is chosen what is to be added? A list in sections, with a field to find one by its name.

use egui::{Frame, Id, Key, Modal, Rect, RichText, ScrollArea, TextEdit, Ui};

use super::spoken;
use crate::making::add::{self, Adding};
use crate::making::starters::Addable;
use crate::viewer::Viewer;

/// Width of a section in points.
const SECTION: f32 = 118.0;

/// Height of the sections in points, where the window has room.
const HEIGHT: f32 = 330.0;

/// Shows the list while something is being chosen. All keys and clicks are for it.
pub(super) fn show(ui: &Ui, viewer: &mut Viewer, window: Rect) {
    let Some(mut adding) = viewer.adding.take() else { return };
    let frame = Frame::window(ui.style()).inner_margin(12);
    let modal = Modal::new(Id::new("adding")).frame(frame).show(ui.ctx(), |ui| {
        ui.set_width((window.width() - 40.0).clamp(60.0, 4.2 * SECTION));
        ui.label(RichText::new("Add").strong().size(15.0));
        let field = ui.add(TextEdit::singleline(&mut adding.typed).hint_text("find").desired_width(160.0));
        spoken::next(ui, "find something to add");
        spoken::name(ui, &field);
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        if ui.memory(|memory| memory.focused().is_none()) {
            field.request_focus();
        }
        let height = (window.height() - 130.0).clamp(40.0, HEIGHT);
        let mut chosen = None;
        ScrollArea::both()
            .auto_shrink([false, false])
            .max_height(height)
            .show(ui, |ui| chosen = sections(ui, &adding));
        let first =
            Addable::sections().into_iter().flat_map(|(_, all)| all).find(|what| fits(*what, &adding));
        chosen.or_else(|| first.filter(|_| entered))
    });
    match modal.inner {
        Some(what) => add::add(viewer, what, adding.at),
        None if modal.backdrop_response.clicked() => {}
        None => viewer.adding = Some(adding),
    }
}

fn sections(ui: &mut Ui, adding: &Adding) -> Option<Addable> {
    let mut chosen = None;
    ui.horizontal_top(|ui| {
        for (title, all) in Addable::sections() {
            ui.vertical(|ui| {
                ui.set_width(SECTION);
                ui.weak(title);
                for what in all.into_iter().filter(|what| fits(*what, adding)) {
                    if ui.selectable_label(false, what.name()).on_hover_text(what.doc()).clicked() {
                        chosen = Some(what);
                    }
                }
            });
        }
    });
    chosen
}

fn fits(what: Addable, adding: &Adding) -> bool {
    what.name().contains(&adding.typed.trim().to_lowercase())
}
