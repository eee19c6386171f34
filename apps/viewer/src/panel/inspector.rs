//! What is the selected thing made of, and how is it changed? Its name, its part's fields, its placement and its
//! material, as their own lists of fields tell.

use catoptra_core::scene::{Edit, EntityId, MaterialId};
use catoptra_core::{Camera, InvalidPart, Light, Material, Part as _, Shape};
use egui::{ComboBox, TextEdit, Ui};

use super::fields::{self, step_key};
use super::{placement, tree};
use crate::viewer::Viewer;

/// Shows what is selected.
pub(super) fn show(ui: &mut Ui, viewer: &mut Viewer) {
    let Some(id) = viewer.selection else {
        ui.weak("Click something to select it.");
        return;
    };
    heading(ui, viewer, id);
    shape(ui, viewer, id);
    light(ui, viewer, id);
    camera(ui, viewer, id);
    placed(ui, viewer, id);
    material(ui, viewer, id);
}

/// The name, to be changed, and the word for what it is.
fn heading(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let name = viewer.document.scene().name(id).unwrap_or_default();
    let typed = viewer.typed_name.as_ref().filter(|(owner, _)| *owner == id);
    let mut text = typed.map_or(name, |(_, typed)| typed.clone());
    ui.horizontal(|ui| {
        let response = ui.add(TextEdit::singleline(&mut text).desired_width(140.0));
        if response.has_focus() || response.lost_focus() {
            viewer.typed_name = Some((id, text));
        }
        if !response.has_focus() {
            viewer.finish_name();
        }
        ui.weak(tree::kind_name(viewer.document.scene(), id));
    });
}

/// Makes an edit of a changed part, or tells why it was refused.
fn put<T>(viewer: &mut Viewer, part: Result<T, InvalidPart>, key: u64, edit: impl FnOnce(T) -> Edit) {
    match part {
        Ok(part) => viewer.edit_on(edit(part), key),
        Err(refusal) => viewer.notify(refusal.to_string()),
    }
}

fn shape(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let Some(shape): Option<Shape> = viewer.document.scene().shape(id) else { return };
    let key = |field| step_key("shape", id.index(), field);
    if let Some((field, value)) = fields::show(ui, key(""), shape.kind().fields, &shape.values()) {
        put(viewer, shape.with(field, value), key(field), |shape| Edit::Shape(id, shape));
    }
}

fn light(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let Some(light): Option<Light> = viewer.document.scene().light(id) else { return };
    let key = |field| step_key("light", id.index(), field);
    let shown = viewer.document.scene().world_light(id);
    let equivalent = |field: &str| shown.as_ref()?.equivalent(field);
    let changed = fields::show_offering(ui, key(""), light.kind().fields, (&light.values(), equivalent));
    if let Some((field, value)) = changed {
        put(viewer, light.with(field, value), key(field), |light| Edit::Light(id, light));
    }
}

fn camera(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let Some(camera): Option<Camera> = viewer.document.scene().camera(id) else { return };
    let key = |field| step_key("camera", id.index(), field);
    if let Some((field, value)) = fields::show(ui, key(""), Camera::KIND.fields, &camera.values()) {
        let camera = (Camera::KIND.make)(&camera.values().with(field, value));
        put(viewer, camera, key(field), |camera| Edit::Camera(id, camera));
    }
    ui.horizontal(|ui| {
        if ui.button("Look through").clicked() {
            viewer.adopt(Some(id));
        }
        if ui.button("Set to this view").clicked() {
            let outer = viewer.document.scene().world_placement(id).unwrap_or_default();
            put(viewer, viewer.camera.placed(&outer.inverse()), key("view"), |camera| {
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
        if let Some(placement) = placement::show(ui, key, &now) {
            viewer.edit_on(Edit::Placement(id, placement), key);
        }
    });
}

fn material(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let scene = viewer.document.scene();
    let Some(worn) = scene.material_of(id) else { return };
    let wearers = scene.wearers(worn).len();
    egui::CollapsingHeader::new("Material").default_open(true).show(ui, |ui| {
        choose_material(ui, viewer, id, worn);
        if wearers > 1 {
            ui.weak(format!("shared by {wearers} shapes"));
        }
        let Some(material): Option<Material> = viewer.document.scene().find_material(worn).cloned() else {
            return;
        };
        let key = |field| step_key("material", worn.index(), field);
        if let Some((field, value)) = fields::show(ui, key(""), material.kind().fields, &material.values()) {
            put(viewer, material.with(field, value), key(field), |material| Edit::Material(worn, material));
        }
    });
}

fn choose_material(ui: &mut Ui, viewer: &mut Viewer, id: EntityId, worn: MaterialId) {
    let scene = viewer.document.scene();
    let names: Vec<(MaterialId, String)> =
        scene.materials().map(|(id, name, _)| (id, name.to_owned())).collect();
    let kind = scene.find_material(worn).map_or("", Material::kind_name);
    let now = names.iter().find(|(id, _)| *id == worn).map_or("", |(_, name)| name);
    let mut chosen = None;
    ui.horizontal(|ui| {
        ComboBox::from_id_salt("material").selected_text(now).show_ui(ui, |ui| {
            for (other, name) in &names {
                if ui.selectable_label(*other == worn, name).clicked() {
                    chosen = Some(*other);
                }
            }
        });
        ui.weak(kind);
    });
    if let Some(other) = chosen.filter(|other| *other != worn) {
        viewer.edit(Edit::MaterialOf(id, other));
    }
}
