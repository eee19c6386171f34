//! What is the selected shape made of, and how is that changed? A picture of its material, which one it is and of what kind,
//! its fields, and how it finishes.

use catoptra_core::scene::{Edit, EntityId, MaterialId, Scene, TextureId};
use catoptra_core::{Field, FieldKind, Finish, InvalidPart, Material, Part as _, Value};
use egui::{CollapsingHeader, ComboBox, Ui};

use super::fields::{self, Changed, Offers, step_key};
use super::inspector::put;
use super::spoken;
use crate::ball::{SIDE, Sample};
use crate::making;
use crate::retype;
use crate::viewer::Viewer;

/// Kinds of glass, and their index of refraction at the yellow sodium line; diamond and ice as handbooks give them.
const GLASSES: &[(&str, f64)] = &[("window glass", 1.52), ("water", 1.333), ("diamond", 2.42), ("ice", 1.31)];

/// Shows the material of a shape.
pub(super) fn show(ui: &mut Ui, viewer: &mut Viewer, id: EntityId) {
    let Some(worn) = viewer.document.scene().material_of(id) else { return };
    CollapsingHeader::new("Material").default_open(true).show(ui, |ui| {
        let Some(material) = viewer.document.scene().find_material(worn).cloned() else { return };
        ui.horizontal(|ui| {
            ball(ui, viewer, worn);
            ui.vertical(|ui| {
                choose_material(ui, viewer, id, worn);
                choose_kind(ui, viewer, worn, &material);
                choose_glass(ui, viewer, worn, &material);
                let wearers = viewer.document.scene().wearers(worn).len();
                if wearers > 1 {
                    ui.weak(format!("shared by {wearers} shapes"));
                    let single = ui.small_button("Make single");
                    if single.on_hover_text("A copy for what is selected alone.").clicked() {
                        making::make_single(viewer, worn);
                    }
                }
            });
        });
        let textures = names(viewer.document.scene());
        own_fields(ui, viewer, (worn, &material), &textures);
        finish(ui, viewer, worn, &textures);
    });
}

/// The textures of a scene with their names.
fn names(scene: &Scene) -> Vec<(TextureId, String)> {
    scene.textures().map(|(id, name, _)| (id, name.to_owned())).collect()
}

/// A picture of a ball of the material, as it was last traced.
fn ball(ui: &mut Ui, viewer: &mut Viewer, worn: MaterialId) {
    if let Some(sample) = Sample::of(viewer.document.scene(), worn) {
        viewer.preview.want(sample);
    }
    let side = SIDE as f32;
    match viewer.preview.picture(ui.ctx()) {
        Some(picture) => {
            let picture = egui::load::SizedTexture::new(picture, [side, side]);
            ui.add(egui::Image::from_texture(picture).corner_radius(4));
        }
        None => {
            ui.allocate_space(egui::vec2(side, side));
        }
    }
}

fn choose_material(ui: &mut Ui, viewer: &mut Viewer, id: EntityId, worn: MaterialId) {
    let scene = viewer.document.scene();
    let mut chosen = None;
    let now = scene.material_name(worn);
    let shown = ComboBox::from_id_salt("material").selected_text(now).show_ui(ui, |ui| {
        for (other, name, _) in scene.materials() {
            if ui.selectable_label(other == worn, name).clicked() {
                chosen = Some(other);
            }
        }
    });
    spoken::next(ui, "material");
    spoken::name(ui, &shown.response);
    if let Some(other) = chosen.filter(|other| *other != worn) {
        let scene = viewer.document.scene();
        let shapes =
            viewer.selection.ids().iter().chain([&id]).filter(|id| scene.material_of(**id).is_some());
        let worn = shapes.map(|shape| Edit::MaterialOf(*shape, other)).collect();
        viewer.edit(Edit::Batch(worn));
    }
}

fn choose_kind(ui: &mut Ui, viewer: &mut Viewer, worn: MaterialId, material: &Material) {
    let now = material.kind_name();
    let mut chosen = None;
    let shown = ComboBox::from_id_salt("kind").selected_text(now).show_ui(ui, |ui| {
        for kind in Material::KINDS {
            if ui.selectable_label(kind.name == now, kind.name).on_hover_text(kind.doc).clicked() {
                chosen = Some(kind);
            }
        }
    });
    spoken::next(ui, "kind of material");
    spoken::name(ui, &shown.response);
    if let Some(kind) = chosen.filter(|kind| kind.name != now) {
        let key = step_key("kind", worn.index(), "");
        put(viewer, retype::of_kind(material, kind), key, |material| Edit::Material(worn, material));
        viewer.document.end_step();
    }
}

/// What glass it is, by its index of refraction.
fn choose_glass(ui: &mut Ui, viewer: &mut Viewer, worn: MaterialId, material: &Material) {
    let (Material::Glass(_), Some(Value::Number(ior))) = (material, material.values().get("ior").cloned())
    else {
        return;
    };
    let mut chosen = None;
    let is_it = |of: f64| of.total_cmp(&ior).is_eq();
    let now = GLASSES.iter().find(|(_, of)| is_it(*of)).map_or("preset", |(name, _)| name);
    let shown = ComboBox::from_id_salt("glass").selected_text(now).show_ui(ui, |ui| {
        for (name, ior) in GLASSES {
            if ui.selectable_label(is_it(*ior), *name).clicked() {
                chosen = Some(*ior);
            }
        }
    });
    spoken::next(ui, "glass");
    spoken::name(ui, &shown.response);
    if let Some(ior) = chosen.filter(|ior| !is_it(*ior)) {
        let key = step_key("glass", worn.index(), "");
        put(viewer, material.with("ior", Value::Number(ior)), key, |glass| Edit::Material(worn, glass));
        viewer.document.end_step();
    }
}

fn own_fields(
    ui: &mut Ui,
    viewer: &mut Viewer,
    (worn, material): (MaterialId, &Material),
    textures: &[(TextureId, String)],
) {
    let key = |field| step_key("material", worn.index(), field);
    let offers = Offers {
        textures,
        takes: &|field, value| material.with(field, value).is_ok(),
        equivalent: &first_of_its_kind,
        note: "",
        optional: true,
    };
    let (kind, values) = (material.kind(), material.values());
    if let Some(changed) = fields::show(ui, key(""), kind.fields, &values, &offers) {
        put(viewer, changed.make(kind, values), key(changed.field), |made| Edit::Material(worn, made));
    }
}

/// What a field is at first that takes another's place.
fn first_of_its_kind(field: &Field) -> Option<Value> {
    match (field.default, field.kind) {
        (Some(make), _) => Some(make()),
        (None, FieldKind::Choice(words)) => words.first().map(|word| Value::Word((*word).to_owned())),
        _ => None,
    }
}

/// What is beside its lobes: opened where it is something special.
fn finish(ui: &mut Ui, viewer: &mut Viewer, worn: MaterialId, textures: &[(TextureId, String)]) {
    let now = viewer.document.scene().finish(worn);
    CollapsingHeader::new("Finish").default_open(!now.is_plain()).show(ui, |ui| {
        let key = |field| step_key("finish", worn.index(), field);
        let takes = |field, value| now.with(field, value).is_ok();
        let offers = Offers { textures, takes: &takes, optional: true, ..Offers::NONE };
        if let Some(changed) = fields::show(ui, key(""), finish_fields(&now), &now.values(), &offers) {
            put(viewer, finished(&now, &changed), key(changed.field), |finish| Edit::Finish(worn, finish));
        }
    });
}

/// The field that stands only beside a normal map.
const STRENGTH: &str = "normal-strength";

/// The fields that mean something.
fn finish_fields(now: &Finish) -> impl Iterator<Item = &'static Field> {
    let has_map = now.normal_map().is_some();
    Finish::KIND.fields.iter().filter(move |field| has_map || field.name != STRENGTH)
}

/// With that change; a strength goes with its map.
fn finished(now: &Finish, changed: &Changed) -> Result<Finish, InvalidPart> {
    let values = changed.apply(Finish::KIND.fields, now.values());
    let has_map = values.get("normal-map").is_some();
    (Finish::KIND.make)(&if has_map { values } else { values.without(STRENGTH) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(finish: &Finish, field: &'static str, value: Option<Value>) -> Finish {
        finished(finish, &Changed { field, value }).unwrap()
    }

    #[test]
    fn a_finish_is_given_and_taken_away_whole() {
        let (plain, map) = (Finish::default(), TextureId::from_index(1).map(Value::Texture));
        let cut = change(&plain, "alpha-cutoff", Some(Value::Number(0.5)));
        assert_eq!(cut.alpha_cutoff(), Some(0.5));
        let bumpy = change(&cut, "normal-map", map);
        let bumpy = change(&bumpy, STRENGTH, Some(Value::Number(0.3)));
        assert_eq!(bumpy.normal_map().unwrap().strength, 0.3);
        assert!(finish_fields(&bumpy).any(|field| field.name == STRENGTH));
        let smooth = change(&bumpy, "normal-map", None);
        assert_eq!(smooth, cut);
        assert!(!finish_fields(&smooth).any(|field| field.name == STRENGTH));
        assert_eq!(change(&smooth, "alpha-cutoff", None), plain);
    }
}
