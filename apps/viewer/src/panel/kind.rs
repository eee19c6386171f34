//! Of what kind is the selected thing, and how does it become one of another? It keeps what both kinds call by the same name.

use catoptra_core::scene::{Edit, EntityId};
use catoptra_core::{InvalidPart, Light, Operation, Shape};
use egui::{ComboBox, Ui};

use super::fields::step_key;
use super::inspector::put;
use super::{spoken, tree};
use crate::making::starters;
use crate::retype;
use crate::viewer::Viewer;

/// Shows the kind; of shapes, lights and solids a list to choose another from.
pub(super) fn choose(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let scene = viewer.document.scene();
    if let Some(shape) = scene.shape(id) {
        let kinds = Shape::KINDS.iter().map(|kind| kind.name).filter(|kind| starters::shape(kind).is_some());
        if let Some(kind) = list(ui, shape.kind_name(), kinds) {
            become_kind(viewer, id, retype::shape(&shape, kind), |shape| Edit::Shape(id, shape));
        }
    } else if let Some(light) = scene.light(id) {
        let kinds = Light::KINDS.iter().map(|kind| kind.name);
        if let Some(kind) = list(ui, light.kind_name(), kinds) {
            become_kind(viewer, id, retype::light(&light, kind), |light| Edit::Light(id, light));
        }
    } else if let Some(now) = scene.operation(id) {
        let chosen = list(ui, now.word(), Operation::ALL.map(Operation::word).into_iter());
        if let Some(operation) = chosen.and_then(Operation::named) {
            viewer.edit(Edit::Operation(id, operation));
        }
    } else {
        ui.weak(tree::kind_name(scene, id));
    }
}

/// The kind that is chosen, if it is another.
fn list(ui: &mut Ui, now: &'static str, kinds: impl Iterator<Item = &'static str>) -> Option<&'static str> {
    let mut chosen = None;
    let shown = ComboBox::from_id_salt("entity kind").selected_text(now).width(92.0).show_ui(ui, |ui| {
        for kind in kinds {
            if ui.selectable_label(kind == now, kind).clicked() {
                chosen = Some(kind);
            }
        }
    });
    spoken::next(ui, "kind");
    spoken::name(ui, &shown.response);
    chosen.filter(|kind| *kind != now)
}

fn become_kind<T>(
    viewer: &mut Viewer,
    id: EntityId,
    part: Result<T, InvalidPart>,
    edit: impl FnOnce(T) -> Edit,
) {
    put(viewer, part, step_key("entity kind", id.index(), ""), edit);
    viewer.document.end_step();
}
