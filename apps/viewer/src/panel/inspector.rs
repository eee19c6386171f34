//! What is the selected thing made of, and how is it changed? Its name, its part's fields as their own list
//! tells, its placement and its material.

use catoptra_core::scene::{Edit, EntityId};
use catoptra_core::{Camera, Field, InvalidPart, Light, Part as _, Shape, Value, Values};
use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditOutput;
use egui::{TextEdit, Ui};

use super::fields::{self, Changed, Offers, step_key};
use super::{kind, material, placement, spoken};
use crate::fly;
use crate::naming::Named;
use crate::viewer::Viewer;

/// Shows what is selected.
pub(super) fn show(ui: &mut Ui, viewer: &mut Viewer) {
    let Some(id) = viewer.selection.active() else {
        ui.weak("Click something to select it; with Shift or Ctrl, several things.");
        return;
    };
    let count = viewer.selection.ids().len();
    if count > 1 {
        ui.weak(format!("{count} selected: the fields are those of the last"));
    }
    heading(ui, viewer, id);
    shape(ui, viewer, id);
    light(ui, viewer, id);
    camera(ui, viewer, id);
    placed(ui, viewer, id);
    material::show(ui, viewer, id);
}

/// The name, to be changed, and the word for what it is.
fn heading(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    ui.horizontal(|ui| {
        name(ui, viewer, Named::Entity(id));
        kind::choose(ui, viewer, id);
    });
    let flags = viewer.document.scene().flags(id);
    let mut now = flags;
    ui.horizontal(|ui| {
        ui.checkbox(&mut now.hidden, "hidden").on_hover_text("It takes no part in the picture (H).");
        ui.checkbox(&mut now.locked, "locked").on_hover_text("It is not picked or moved by hand (Ctrl+L).");
    });
    if now != flags {
        viewer.edit(Edit::Flags(id, now));
    }
}

/// A name, to be changed.
pub(super) fn name(ui: &mut Ui, viewer: &mut Viewer, owner: Named) {
    let name = owner.name(viewer.document.scene()).unwrap_or_default();
    let typed = viewer.typed_name.as_ref().filter(|(typing, _)| *typing == owner);
    let is_typed = typed.is_some();
    let mut text = typed.map_or(name, |(_, typed)| typed.clone());
    let field = TextEdit::singleline(&mut text).id_salt(owner).desired_width(130.0);
    if std::mem::take(&mut viewer.names_next) && is_typed {
        let response = field.show(ui);
        select_whole(ui, response, &text);
        return;
    }
    let response = ui.add(field);
    spoken::next(ui, "name");
    spoken::name(ui, &response);
    if response.has_focus() || response.lost_focus() {
        if !is_typed {
            viewer.finish_name();
        }
        viewer.typed_name = Some((owner, text));
    }
    if !response.has_focus() && viewer.typed_name.as_ref().is_some_and(|(typing, _)| *typing == owner) {
        viewer.finish_name();
    }
}

/// Gives a field the keys, with all that is written there selected.
fn select_whole(ui: &Ui, mut field: TextEditOutput, text: &str) {
    let (start, end) = (CCursor::new(0), CCursor::new(text.chars().count()));
    field.state.cursor.set_char_range(Some(CCursorRange::two(start, end)));
    field.state.store(ui.ctx(), field.response.id);
    field.response.request_focus();
}

/// Makes an edit of a changed part, or tells why it was refused.
pub(super) fn put<T>(
    viewer: &mut Viewer,
    part: Result<T, InvalidPart>,
    key: u64,
    edit: impl FnOnce(T) -> Edit,
) {
    match part {
        Ok(part) => viewer.edit_on(edit(part), key),
        Err(refusal) => viewer.notify(refusal.to_string()),
    }
}

fn shape(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let Some(shape): Option<Shape> = viewer.document.scene().shape(id) else { return };
    let key = |field| step_key("shape", id.index(), field);
    let (kind, values) = (shape.kind(), shape.values());
    if let Some(changed) = fields::show(ui, key(""), kind.fields, &values, &Offers::NONE) {
        put(viewer, changed.make(kind, values), key(changed.field), |shape| Edit::Shape(id, shape));
    }
}

fn light(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let Some(light): Option<Light> = viewer.document.scene().light(id) else { return };
    let key = |field| step_key("light", id.index(), field);
    let shown = viewer.document.scene().world_light(id);
    let equivalent = |field: &Field| shown.as_ref()?.equivalent(field.name);
    let offers = Offers { equivalent: &equivalent, note: "The light stays as it is.", ..Offers::NONE };
    let (kind, values) = (light.kind(), light.values());
    if let Some(changed) = fields::show(ui, key(""), kind.fields, &values, &offers) {
        let values = with_room(values, &changed);
        put(viewer, changed.make(kind, values), key(changed.field), |light| Edit::Light(id, light));
    }
    let flown = viewer.flown.as_ref().is_some_and(|flown| flown.id == id);
    if ui.button(if flown { "Leave it here" } else { "Look through" }).clicked() {
        if flown { fly::end(viewer) } else { fly::begin(viewer, id) }
    }
}

/// Values in which the other angle of a cone makes room for the one that is changed.
fn with_room(values: Values, changed: &Changed) -> Values {
    let Some(Value::Number(angle)) = changed.value else { return values };
    let (other, is_passed): (&'static str, fn(f64, f64) -> bool) = match changed.field {
        "inner" => ("outer", |inner, outer| inner > outer),
        "outer" => ("inner", |outer, inner| outer < inner),
        _ => return values,
    };
    match values.get(other) {
        Some(Value::Number(now)) if is_passed(angle, *now) => values.with(other, Value::Number(angle)),
        _ => values,
    }
}

fn camera(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let Some(camera): Option<Camera> = viewer.document.scene().camera(id) else { return };
    let key = |field| step_key("camera", id.index(), field);
    let values = camera.values();
    if let Some(changed) = fields::show(ui, key(""), Camera::KIND.fields, &values, &Offers::NONE) {
        let camera = changed.make(Camera::KIND, values);
        put(viewer, camera, key(changed.field), |camera| Edit::Camera(id, camera));
    }
    ui.horizontal(|ui| {
        if ui.button("Look through").clicked() {
            viewer.adopt(Some(id));
        }
        if ui.button("Fly").on_hover_text("Look through it, and take it along.").clicked() {
            fly::begin(viewer, id);
        }
        if ui.button("Set to this view").clicked() {
            let outer = viewer.document.scene().world_placement(id).unwrap_or_default();
            put(viewer, fly::tidy_view(viewer, &camera, &outer), key("view"), |camera| {
                Edit::Camera(id, camera)
            });
            viewer.document.end_step();
        }
    });
}

fn placed(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let Some(now) = viewer.document.scene().placement(id) else { return };
    let key = step_key("placement", id.index(), "");
    egui::CollapsingHeader::new("Placement").default_open(true).show(ui, |ui| {
        ui.weak("where it goes after its own fields").on_hover_text(
            "The fields above say where it is by itself. After that it is scaled, then turned, then moved, as the lines \
             scale, turn and move of the file say.",
        );
        if let Some(placement) = placement::show(ui, key, &now) {
            viewer.edit_on(Edit::Placement(id, placement), key);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_of_a_cone_pushes_the_other() {
        let values = || Values::new().with("inner", Value::Number(0.4)).with("outer", Value::Number(0.8));
        let pushed = |field, to| {
            let changed = Changed { field, value: Some(Value::Number(to)) };
            let values = with_room(values(), &changed);
            ["inner", "outer"].map(|name| values.get(name).cloned())
        };
        let angles = |inner, outer| [Some(Value::Number(inner)), Some(Value::Number(outer))];
        assert_eq!(pushed("inner", 1.0), angles(0.4, 1.0));
        assert_eq!(pushed("outer", 0.2), angles(0.2, 0.8));
        assert_eq!(pushed("inner", 0.5), angles(0.4, 0.8));
        assert_eq!(pushed("falloff", 9.0), angles(0.4, 0.8));
    }
}
