//! What is in the scene? A tree of groups, shapes, lights and cameras; a click selects, with Shift all up to there, with Ctrl
//! one more; a drag puts rows elsewhere. A field above it leaves those that are searched; what is picked elsewhere comes in sight.

use std::collections::HashSet;
use std::ops::Range;

use catoptra_core::scene::{EntityId, Flags, Role, Scene};
use egui::{Button, Id, Rect, ScrollArea, Sense, TextEdit, Ui};

use super::{menus, spoken, theme, tree_drag};
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
    ui.scope(|ui| {
        ui.spacing_mut().scroll = egui::style::ScrollStyle::solid();
        show_rows(ui, viewer, height);
    });
}

fn show_rows(ui: &mut Ui, viewer: &mut Viewer, height: f32) {
    let search = search_field(ui);
    let picked = newly_picked(ui, viewer);
    let mut rows = Vec::new();
    collect(ui, viewer.document.scene(), None, 0, &mut rows);
    if !search.trim().is_empty() {
        rows = found(viewer.document.scene(), &search);
    }
    let row_height = ui.spacing().interact_size.y;
    let step = row_height + ui.spacing().item_spacing.y;
    let mut area = ScrollArea::vertical().id_salt("tree").auto_shrink([false, false]).max_height(height);
    let seen_id = Id::new("rows in sight");
    let seen: Range<usize> = ui.data(|data| data.get_temp(seen_id)).unwrap_or_default();
    let picked = picked.and_then(|id| rows.iter().position(|row| row.id == id));
    if let Some(offset) = picked.and_then(|row| scrolled_to(row, &seen)) {
        area = area.vertical_scroll_offset(offset as f32 * step);
    }
    area.show_rows(ui, row_height, rows.len(), |ui, seen| {
        ui.data_mut(|data| data.insert_temp(seen_id, seen.clone()));
        for row in &rows[seen.clone()] {
            show_row(ui, viewer, &rows, row);
        }
        if seen.end == rows.len() {
            let rest = Rect::from_min_max(ui.cursor().min, ui.clip_rect().max);
            tree_drag::below(ui, viewer, rest);
        }
        tree_drag::scroll(ui);
    });
    tree_drag::ghost(ui, viewer);
}

/// The field for the words of a name or a kind; what stands in it.
fn search_field(ui: &mut Ui) -> String {
    let id = Id::new("search of the tree");
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_default();
    let field =
        TextEdit::singleline(&mut text).hint_text("filter by name or kind").desired_width(f32::INFINITY);
    let field = ui.add(field);
    spoken::next(ui, "filter of the tree");
    spoken::name(ui, &field);
    if field.changed() {
        ui.data_mut(|data| data.insert_temp(id, text.clone()));
    }
    text
}

/// The active thing, where it is another than the last time; the groups that it lies in are opened.
fn newly_picked(ui: &Ui, viewer: &Viewer) -> Option<EntityId> {
    let (id, active) = (Id::new("picked"), viewer.selection.active());
    let before: Option<EntityId> = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    ui.data_mut(|data| data.insert_temp(id, active));
    let picked = active.filter(|_| before != active)?;
    for group in viewer.document.scene().ancestors(picked) {
        ui.data_mut(|data| data.insert_temp(open_id(group), true));
    }
    Some(picked)
}

/// The first row to be shown, so that a row stands in the middle of as many as are in sight; `None` where it is in sight.
fn scrolled_to(row: usize, seen: &Range<usize>) -> Option<usize> {
    // The last row may be cut off.
    let whole = seen.start..seen.end.saturating_sub(1);
    (!whole.contains(&row)).then(|| row.saturating_sub(whole.len() / 2))
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

/// Everything whose name and kind hold all the words that are searched, with the groups that it lies in, all open.
fn found(scene: &Scene, search: &str) -> Vec<Row> {
    let search = search.to_lowercase();
    let fits = |id: EntityId| {
        let line = format!("{} {}", scene.name(id).unwrap_or_default(), kind_name(scene, id)).to_lowercase();
        search.split_whitespace().all(|word| line.contains(word))
    };
    let all = scene.walk();
    let mut shown: HashSet<EntityId> = all.iter().copied().filter(|id| fits(*id)).collect();
    shown.extend(shown.clone().into_iter().flat_map(|id| scene.ancestors(id)));
    let row = |id: EntityId| {
        Some(Row { id, level: scene.ancestors(id).count(), role: scene.role(id)?, open: true })
    };
    all.into_iter().filter(|id| shown.contains(id)).filter_map(row).collect()
}

fn open_id(id: EntityId) -> Id {
    Id::new(("open", id.index()))
}

fn is_open(ui: &Ui, id: EntityId) -> bool {
    ui.data(|data| data.get_temp(open_id(id)).unwrap_or(true))
}

fn show_row(ui: &mut Ui, viewer: &mut Viewer, rows: &[Row], row: &Row) {
    let shown = ui.horizontal(|ui| {
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
        let label = Button::selectable(selected, text).sense(Sense::click_and_drag());
        let label = ui.add(label).on_hover_text(kind);
        tree_drag::begin(viewer, row.id, &label);
        flags(ui, viewer.document.scene().flags(row.id));
        if label.secondary_clicked() && !selected {
            viewer.select(Some(row.id));
        }
        label.context_menu(|ui| menus::selected(ui, viewer));
        if label.double_clicked() {
            making::rename(viewer);
        } else if label.clicked() {
            let held = ui.input(|input| input.modifiers);
            match () {
                () if held.shift => viewer.select_all(viewer.selection.with(range(viewer, rows, row.id))),
                () if held.command || held.ctrl => viewer.click_on(Some(row.id), Picking::Toggle),
                () => viewer.select(Some(row.id)),
            }
        }
        if lighting::shines(viewer.document.scene(), row.id) {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| lights(ui, viewer, row.id));
        }
    });
    let gap = 0.5 * ui.spacing().item_spacing.y;
    let whole = Rect::from_x_y_ranges(ui.max_rect().x_range(), shown.response.rect.y_range());
    tree_drag::over(ui, viewer, (row.id, row.role), whole.expand2(egui::vec2(0.0, gap)));
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_out_of_sight_comes_into_the_middle() {
        assert_eq!(scrolled_to(3, &(2..8)), None);
        assert_eq!(scrolled_to(40, &(2..13)), Some(35));
        assert_eq!(scrolled_to(7, &(2..8)), Some(5), "the last one may be cut off");
        assert_eq!(scrolled_to(1, &(20..31)), Some(0));
    }

    #[test]
    fn a_search_leaves_what_fits_and_the_groups_round_it() {
        let text = "matte \"m\" { color 0.5 }\nsphere \"plum ball\" material=\"m\" { radius 1 }\n\
            group \"table\" { sphere \"Apple\" material=\"m\" { radius 1 } }\n\
            point-light \"bulb\" { position 0 1 0; intensity 1 }\n";
        let (scene, _) = catoptra_scene::parse(text, "text", None).unwrap();
        let names = |search: &str| -> Vec<(String, usize)> {
            let rows = found(&scene, search);
            rows.iter().map(|row| (scene.name(row.id).unwrap_or_default().to_owned(), row.level)).collect()
        };
        let row = |name: &str, level| (name.to_owned(), level);
        assert_eq!(names("apple"), [row("table", 0), row("Apple", 1)]);
        assert_eq!(names("LIGHT"), [row("bulb", 0)]);
        assert_eq!(names("sphere ball"), [row("plum ball", 0)]);
        assert!(names("nothing").is_empty());
    }
}
