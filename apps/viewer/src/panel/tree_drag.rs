//! How are rows of the tree dragged to another place? Between rows, onto a group, below all; the other selected things go along.

use catoptra_core::scene::{EntityId, Role};
use egui::{DragAndDrop, Id, LayerId, Order, Rect, Response, Stroke, Ui};

use super::theme;
use crate::making::{self, Slot};
use crate::viewer::Viewer;

/// So near to the edge of the tree, in points, it scrolls while something is dragged, and so far each time.
const EDGE: f32 = 18.0;
const SCROLL: f32 = 6.0;

/// What is being dragged.
struct Dragged(Vec<EntityId>);

/// Begins to drag a row, with all that is selected where it is one of these.
pub(super) fn begin(viewer: &Viewer, id: EntityId, row: &Response) {
    if row.drag_started() {
        let selected = viewer.selection.tops(viewer.document.scene());
        let ids = if selected.contains(&id) { selected } else { vec![id] };
        row.dnd_set_drag_payload(Dragged(ids));
    }
}

/// Shows whether what is dragged would go before, after or into a row, and puts it there when it is let go over that.
pub(super) fn over(ui: &Ui, viewer: &mut Viewer, (id, role): (EntityId, Role), row: Rect) {
    let Some(share) = pointed(ui, row) else { return };
    // A group takes things in by the middle half of its row.
    let edge = if role == Role::Group { 0.25 } else { 0.5 };
    let (slot, line) = match share {
        share if share < edge => (Slot::Before(id), Some(row.top())),
        share if share < 1.0 - edge => (Slot::In(Some(id)), None),
        _ => (Slot::After(id), Some(row.bottom())),
    };
    let stroke = Stroke::new(2.0, theme::ACCENT);
    match line {
        Some(y) => ui.painter().hline(row.x_range(), y, stroke),
        None => ui.painter().rect_stroke(row, 3.0, stroke, egui::StrokeKind::Inside),
    };
    let_go(ui, viewer, slot);
}

/// The same below all rows: there things go to the end of the scene.
pub(super) fn below(ui: &Ui, viewer: &mut Viewer, rest: Rect) {
    if pointed(ui, rest).is_some() {
        ui.painter().hline(rest.x_range(), rest.top(), Stroke::new(2.0, theme::ACCENT));
        let_go(ui, viewer, Slot::In(None));
    }
}

/// Scrolls where something is dragged to the upper or lower edge of the tree.
pub(super) fn scroll(ui: &Ui) {
    let tree = ui.clip_rect();
    let Some(at) = ui.ctx().pointer_interact_pos().filter(|_| is_dragging(ui)) else { return };
    if !tree.x_range().contains(at.x) {
        return;
    }
    let by = match at.y {
        y if y < tree.top() + EDGE => SCROLL,
        y if y > tree.bottom() - EDGE => -SCROLL,
        _ => return,
    };
    ui.scroll_with_delta(egui::vec2(0.0, by));
    ui.ctx().request_repaint();
}

/// The name of what is dragged, beside the pointer.
pub(super) fn ghost(ui: &Ui, viewer: &Viewer) {
    let Some(dragged) = DragAndDrop::payload::<Dragged>(ui.ctx()) else { return };
    let Some(at) = ui.ctx().pointer_interact_pos() else { return };
    let text = match dragged.0.as_slice() {
        [id] => viewer.document.scene().name(*id).unwrap_or_default(),
        many => format!("{} things", many.len()),
    };
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Tooltip, Id::new("dragged row")));
    let (place, font) = (at + egui::vec2(14.0, 4.0), egui::TextStyle::Body.resolve(ui.style()));
    painter.text(place, egui::Align2::LEFT_TOP, text, font, theme::ACCENT);
}

fn is_dragging(ui: &Ui) -> bool {
    DragAndDrop::has_payload_of_type::<Dragged>(ui.ctx())
}

/// How far down in a row the pointer is, from 0 to 1, where something is dragged there.
fn pointed(ui: &Ui, row: Rect) -> Option<f32> {
    let seen = row.intersect(ui.clip_rect());
    let at = ui.ctx().pointer_interact_pos().filter(|at| is_dragging(ui) && seen.contains(*at))?;
    Some((at.y - row.top()) / row.height().max(1.0))
}

fn let_go(ui: &Ui, viewer: &mut Viewer, slot: Slot) {
    if ui.input(|input| input.pointer.any_released())
        && let Some(dragged) = DragAndDrop::take_payload::<Dragged>(ui.ctx())
    {
        making::put(viewer, &dragged.0, slot);
    }
}
