//! How do models come into a scene, changed as the text says?

use catoptra_core::scene::{Content, Role};

use super::{Builder, Id};
use crate::instance::{self, Instance, Override, Overrides};
use crate::model::Model;
use crate::outline::{Outline, Sort, Word};
use crate::words;

impl Builder<'_> {
    /// Adds the textures of all models: materials may be painted with them wherever these stand.
    pub(super) fn add_textures_of_models(&mut self, outline: &Outline) {
        for item in &outline.items {
            let (Some(source), Some(name)) = (&item.model, &item.name) else { continue };
            match Instance::add_textures(&mut self.scene, &name.value, source, &outline.textures) {
                Ok(instance) => self.models.push(instance),
                Err(error) => self.refused_in_model(name, error),
            }
        }
    }

    /// Adds the materials of all models: shapes may wear them wherever they stand.
    pub(super) fn add_materials_of_models(&mut self, outline: &Outline) {
        for item in &outline.items {
            let (Some(source), Some(name)) = (&item.model, &item.name) else { continue };
            let Some(model) = self.models.iter_mut().find(|model| model.name() == name.value) else {
                continue;
            };
            match model.add_materials(&mut self.scene, source) {
                Ok(()) => self.names.extend(model.material_names(source)),
                Err(error) => self.refused_in_model(name, error),
            }
        }
    }

    /// Passes on what the scene refuses, unless the text was complained about already.
    fn refused_in_model(&mut self, name: &Word, error: String) {
        if self.complaints.count() == 0 {
            self.complaints.add(name.span.clone(), error);
        }
    }

    /// Adds what a model holds, as the parts in its block change it.
    pub(super) fn add_model(&mut self, place: usize, outline: &Outline) {
        let item = &outline.items[place];
        let (Some(source), Some(name)) = (&item.model, &item.name) else { return };
        let Some(at) = self.models.iter().position(|model| model.name() == name.value) else { return };
        let parts = self.overrides(place, outline, &source.model);
        let content = match self.models[at].members(source, &parts) {
            Ok(members) => Content::Group(members),
            Err(error) => return self.complaints.add(name.span.clone(), error.to_string()),
        };
        self.insert(place, item, content);
        let Some(Id::Entity(root)) = self.ids[place] else { return };
        self.models[at].settle(&self.scene, source, root);
        for (i, part) in outline.items.iter().enumerate() {
            if let (Sort::Part, Some(named), true) = (part.sort, &part.name, part.parent == Some(place)) {
                let id = self.models[at].entity(&named.value);
                let named = part.material.as_ref();
                let material = named.and_then(|word| self.scene.material_named(&word.value));
                self.ids[i] = Some(Id::Part(id, material));
                if id.is_none_or(|id| self.scene.role(id) != Some(Role::Group)) {
                    self.refuse_members(i, outline);
                }
            }
        }
    }

    /// A part that is no group has no members.
    pub(super) fn refuse_members(&mut self, part: usize, outline: &Outline) {
        if let Some(member) = outline.items.iter().find(|item| item.parent == Some(part)) {
            self.complaints.add(member.word.clone(), "this part cannot have members; only a group can");
        }
    }

    /// What the text says of the parts of a model, by their names.
    pub(super) fn overrides(&mut self, place: usize, outline: &Outline, model: &Model) -> Overrides {
        let mut parts = Overrides::new();
        let known = instance::names(model);
        for item in outline.items.iter().filter(|item| item.parent == Some(place)) {
            let (Sort::Part, Some(name)) = (item.sort, &item.name) else { continue };
            let Some(node) = instance::find(model, &name.value) else {
                let help = self.complaints.hint(|| words::hint(&name.value, &known, "parts"));
                let message = format!("the model has no part \"{}\"", name.value);
                self.complaints.add_with(name.span.clone(), message, help);
                continue;
            };
            if item.material.is_some() && node.role() != Role::Shape {
                self.complaints.add(item.word.clone(), "only a part that is a shape has a material");
            }
            if item.removed && (item.material.is_some() || !item.steps.is_empty()) {
                let help = "leave out remove, or everything else";
                self.complaints.add_with(item.word.clone(), "this part is removed and changed", help);
            }
            let change = Override {
                placement: (!item.steps.is_empty()).then_some(item.placement),
                material: self.check_material(item),
                removed: item.removed,
                flags: item.flags,
            };
            if parts.insert(name.value.clone(), change).is_some() {
                let message = format!("the part \"{}\" is given twice", name.value);
                self.complaints.add(name.span.clone(), message);
            }
        }
        parts
    }
}
