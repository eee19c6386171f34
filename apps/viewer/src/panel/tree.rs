//! What is in the scene? A tree of groups, shapes, lights and cameras; a click selects, with Shift all up to there, with Ctrl
//! one more.

use catoptra_core::scene::{EntityId, Flags, Role, Scene};
use egui::{Id, ScrollArea, Sense, Ui};

use super::{menus, theme};
use crate::lighting;
use crate::making;
use crate::selection::Picking;
use crate::viewer::Viewer;

/// Points that a level is set in.
const INDENT: f32 = 14.0;

struct Row {
    id: EntityId,
    level: usize,
    role: Role,
    open: bool,
}

/// Shows the tree in that height, in points; only rows in sight are laid out.
pub(super) fn show(ui: &mut Ui, viewer: &mut Viewer, height: f32) {
    let mut rows = Vec::new();
    collect(ui, viewer.document.scene(), None, 0, &mut rows);
    let row_height = ui.spacing().interact_size.y;
    let area = ScrollArea::vertical().id_salt("tree").auto_shrink([false, false]).max_height(height);
    area.show_rows(ui, row_height, rows.len(), |ui, seen| {
        for row in &rows[seen] {
            show_row(ui, viewer, &rows, row);
        }
    });
}

fn collect(ui: &Ui, scene: &Scene, group: Option<EntityId>, level: usize, rows: &mut Vec<Row>) {
    for id in scene.children(group) {
        let Some(role) = scene.role(id) else { continue };
        let open = role == Role::Group && is_open(ui, id);
        rows.push(Row { id, level, role, open });
        if open {
            collect(ui, scene, Some(id), level + 1, rows);
        }
    }
}

fn open_id(id: EntityId) -> Id {
    Id::new(("open", id.index()))
}

fn is_open(ui: &Ui, id: EntityId) -> bool {
    ui.data(|data| data.get_temp(open_id(id)).unwrap_or(true))
}

fn show_row(ui: &mut Ui, viewer: &mut Viewer, rows: &[Row], row: &Row) {
    ui.horizontal(|ui| {
        ui.add_space(INDENT * row.level as f32);
        mark(ui, row);
        let name = viewer.document.scene().name(row.id).unwrap_or_default();
        let selected = viewer.selection.contains(row.id);
        let kind = kind_name(viewer.document.scene(), row.id);
        let hidden = viewer.document.scene().is_hidden(row.id);
        let mut text = egui::RichText::new(name);
        if hidden {
            text = text.weak().italics();
        }
        let label = ui.selectable_label(selected, text).on_hover_text(kind);
        flags(ui, viewer.document.scene().flags(row.id));
        if label.secondary_clicked() && !selected {
            viewer.select(Some(row.id));
        }
        label.context_menu(|ui| menus::selected(ui, viewer));
        if label.double_clicked() {
            making::rename(viewer);
        } else if label.clicked() {
            let held = ui.input(|input| input.modifiers);
            let alone = viewer.selection.ids() == [row.id];
            match () {
                () if held.shift => viewer.select_all(viewer.selection.with(range(viewer, rows, row.id))),
                () if held.command || held.ctrl => viewer.click_on(Some(row.id), Picking::Toggle),
                () => viewer.select(if alone { None } else { Some(row.id) }),
            }
        }
        if lighting::shines(viewer.document.scene(), row.id) {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| lights(ui, viewer, row.id));
        }
    });
}

/// What is set aside about a thing.
fn flags(ui: &mut Ui, flags: Flags) {
    for (is_set, word) in [(flags.hidden, "hidden"), (flags.locked, "locked")] {
        if is_set {
            ui.weak(word);
        }
    }
}

/// The rows from the active one to that one, which comes last.
fn range(viewer: &Viewer, rows: &[Row], to: EntityId) -> Vec<EntityId> {
    let place = |id: EntityId| rows.iter().position(|row| row.id == id);
    let (Some(end), Some(start)) = (place(to), viewer.selection.active().and_then(place)) else {
        return vec![to];
    };
    let mut ids: Vec<EntityId> = rows[start.min(end)..=start.max(end)].iter().map(|row| row.id).collect();
    if end < start {
        ids.reverse();
    }
    ids
}

/// Buttons that let a light shine alone, or leave it dark.
fn lights(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let lighting = &viewer.lighting;
    let (muted, solo) = (lighting.is_muted(id), lighting.is_solo(id));
    let small = |text| egui::RichText::new(text).small();
    ui.add_space(12.0);
    let mute = ui.selectable_label(muted, small("M")).on_hover_text("Mute: leave it dark in this window.");
    if mute.clicked() {
        viewer.light(|lighting| lighting.toggle_mute(&[id]));
    }
    let alone =
        ui.selectable_label(solo, small("S")).on_hover_text("Solo: let it shine alone in this window.");
    if alone.clicked() {
        viewer.light(|lighting| lighting.toggle_solo(&[id]));
    }
}

/// The sign of a row's role; a group's is a triangle that opens and closes it.
fn mark(ui: &mut Ui, row: &Row) {
    let sense = if row.role == Role::Group { Sense::click() } else { Sense::hover() };
    let (rect, response) = ui.allocate_exact_size(egui::vec2(11.0, 11.0), sense);
    if response.clicked() {
        ui.data_mut(|data| data.insert_temp(open_id(row.id), !row.open));
    }
    let (painter, c) = (ui.painter(), rect.center());
    let dim = ui.visuals().weak_text_color();
    let p = |x: f32, y: f32| c + egui::vec2(x, y);
    match row.role {
        Role::Group => {
            let points = if row.open {
                [p(-4.0, -2.5), p(4.0, -2.5), p(0.0, 3.5)]
            } else {
                [p(-2.5, -4.0), p(3.5, 0.0), p(-2.5, 4.0)]
            };
            painter.add(egui::Shape::convex_polygon(points.to_vec(), dim, egui::Stroke::NONE));
        }
        Role::Shape => {
            painter.rect_filled(egui::Rect::from_center_size(c, egui::vec2(7.0, 7.0)), 1.5, dim);
        }
        Role::Light => {
            painter.circle_filled(c, 3.5, theme::ACCENT);
        }
        Role::Camera => {
            let stroke = egui::Stroke::new(1.2, dim);
            painter.add(egui::Shape::closed_line(vec![p(-4.0, 0.0), p(4.0, -4.0), p(4.0, 4.0)], stroke));
        }
    }
}

/// The word for what an entity is.
pub(super) fn kind_name(scene: &Scene, id: EntityId) -> &'static str {
    let shape = || scene.shape(id).map(|shape| shape.kind_name());
    let light = || scene.light(id).map(|light| light.kind_name());
    let other = || if scene.role(id) == Some(Role::Camera) { "camera" } else { "group" };
    shape().or_else(light).unwrap_or_else(other)
}
