//! Which textures does the scene have, and how are they changed? A list; a click selects one and shows its fields.

use catoptra_core::scene::{Edit, Scene, TextureId};
use catoptra_core::{Texture, Values};
use egui::{CollapsingHeader, Ui};

use super::fields::{self, Offers, step_key};
use super::inspector::{name, put};
use crate::naming::Named;
use crate::viewer::Viewer;

/// Shows the list, and the selected texture below its name.
pub(super) fn show(ui: &mut Ui, viewer: &mut Viewer) {
    CollapsingHeader::new("Textures").default_open(true).show(ui, |ui| {
        let all: Vec<(TextureId, String, Texture)> = viewer
            .document
            .scene()
            .textures()
            .map(|(id, name, texture)| (id, name.to_owned(), texture.clone()))
            .collect();
        for (id, name, texture) in &all {
            let selected = viewer.texture == Some(*id);
            let line = ui.selectable_label(selected, name).on_hover_text(texture.kind_name());
            if line.clicked() {
                viewer.finish_name();
                viewer.texture = if selected { None } else { Some(*id) };
            }
            if selected {
                ui.indent(id, |ui| one(ui, viewer, *id, texture));
            }
        }
        add(ui, viewer);
    });
}

fn one(ui: &mut Ui, viewer: &mut Viewer, id: TextureId, texture: &Texture) {
    let used = used_by(viewer.document.scene(), id);
    ui.horizontal(|ui| {
        name(ui, viewer, Named::Texture(id));
        let remove = ui.add_enabled(used.is_empty(), egui::Button::new("Remove").small());
        if remove.on_disabled_hover_text("A material is painted with it.").clicked() {
            viewer.edit(Edit::RemoveTexture(id));
        }
    });
    let told = if used.is_empty() { String::new() } else { format!(" on {used}") };
    let told = egui::RichText::new(format!("{}{told}", texture.kind_name())).weak();
    ui.add(egui::Label::new(told).truncate());
    let key = |field| step_key("texture", id.index(), field);
    let (kind, values) = (texture.kind(), texture.values());
    let offers = Offers { optional: true, ..Offers::NONE };
    if let Some(changed) = fields::show(ui, key(""), kind.fields, &values, &offers) {
        put(viewer, changed.make(kind, values), key(changed.field), |texture| Edit::Texture(id, texture));
    }
}

/// The names of the materials that are painted with it.
fn used_by(scene: &Scene, id: TextureId) -> String {
    let names: Vec<&str> = scene.painted_with(id).into_iter().map(|id| scene.material_name(id)).collect();
    names.join(", ")
}

/// A menu of the textures that need no file.
fn add(ui: &mut Ui, viewer: &mut Viewer) {
    let menu = ui.menu_button("Add", |ui| {
        let mut picked = None;
        for kind in Texture::KINDS {
            let Ok(texture) = (kind.make)(&Values::new()) else { continue };
            if ui.button(kind.name).on_hover_text(kind.doc).clicked() {
                picked = Some((kind.name, texture));
                ui.close();
            }
        }
        picked
    });
    let tip = "Add a pattern. Pictures come in when their file is dropped on the window.";
    menu.response.on_hover_text(tip);
    if let Some((name, texture)) = menu.inner.flatten() {
        let scene = viewer.document.scene();
        let (id, name) = (scene.next_texture_id(), scene.free_texture_name(name));
        viewer.edit(Edit::AddTexture { name, texture, id: None });
        viewer.texture = Some(id);
    }
}
