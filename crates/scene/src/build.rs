//! How a scene is built from what its text says: textures and materials first, then entities group by group.

use std::collections::HashMap;

use catoptra_core::scene::{Content, Edit, EntityId, MaterialId, Node, Role, Scene, Subtree, TextureId};

use crate::instance::{self, Instance, Override, Overrides};
use crate::model::Model;
use crate::outline::{Item, Outline, Part, Sort, Word};
use crate::report::Complaints;
use crate::words;

/// The part of a scene that a node stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Id {
    Settings,
    Texture(TextureId),
    Material(MaterialId),
    Entity(EntityId),
    /// What the text says of a part of a model; `None` where it is left out.
    Part(Option<EntityId>),
}

/// Builds the scene, and answers with what each item of the outline has become. If anything is wrong it goes to
/// `complaints`, and the scene is not whole.
pub(crate) fn build(outline: &Outline, complaints: &mut Complaints) -> (Scene, Vec<Id>, Vec<Instance>) {
    let mut builder = Builder {
        scene: Scene::new(),
        complaints,
        first: HashMap::new(),
        names: Vec::new(),
        models: Vec::new(),
        ids: vec![None; outline.items.len()],
    };
    builder.check_names(outline);
    builder.add_textures(outline);
    builder.add_materials(outline);
    builder.add_models(outline);
    builder.add_entities(outline);
    let scene = &builder.scene;
    builder.models.iter_mut().for_each(|model| model.note(scene));
    let ids = builder.ids.into_iter().map(|id| id.unwrap_or(Id::Settings)).collect();
    (builder.scene, ids, builder.models)
}

struct Builder<'a> {
    scene: Scene,
    complaints: &'a mut Complaints,
    /// Where every name was first given, by what shares a list of names.
    first: HashMap<(&'static str, &'a str), usize>,
    models: Vec<Instance>,
    /// Names of all materials, those that could not be made too.
    names: Vec<String>,
    ids: Vec<Option<Id>>,
}

impl<'a> Builder<'a> {
    fn check_names(&mut self, outline: &'a Outline) {
        let mut settings: Option<usize> = None;
        for item in &outline.items {
            match &item.name {
                Some(name) if !name.value.trim().is_empty() => self.check_name(item, name),
                None if matches!(item.part, Some(Part::Settings(_))) => {
                    if let Some(first) = settings {
                        self.again(item.word.clone(), "settings are given twice".into(), first);
                    }
                    settings.get_or_insert(item.span.start);
                }
                _ => {}
            }
        }
    }

    fn check_name(&mut self, item: &Item, name: &'a Word) {
        let whose = match item.sort {
            Sort::Texture(_) => "texture",
            Sort::Material(_) => "material",
            // The name of a part is one that its file gives.
            Sort::Part => return,
            _ => "shape, light, camera or group",
        };
        let key = (whose, name.value.as_str());
        if let Some(&first) = self.first.get(&key) {
            let message = format!("the name \"{}\" is taken by another {whose}", name.value);
            self.again(name.span.clone(), message, first);
            return;
        }
        self.first.insert(key, item.span.start);
        if matches!(item.sort, Sort::Material(_)) {
            self.names.push(name.value.clone());
        }
    }

    fn again(&mut self, span: crate::outline::Span, message: String, first: usize) {
        self.complaints.add_again(span, message, first);
    }

    fn add_textures(&mut self, outline: &Outline) {
        for (i, item) in outline.items.iter().enumerate() {
            let (Some(Part::Texture(texture)), Some(name)) = (&item.part, &item.name) else { continue };
            let id = outline.textures.get(&name.value).copied();
            let add = Edit::AddTexture { name: name.value.clone(), texture: texture.clone(), id };
            match self.scene.apply(add) {
                Ok(_) => self.ids[i] = self.scene.texture_named(&name.value).map(Id::Texture),
                Err(error) => self.refused(item, &error),
            }
        }
    }

    fn add_materials(&mut self, outline: &Outline) {
        for (i, item) in outline.items.iter().enumerate() {
            let (Some(Part::Material(material, finish)), Some(name)) = (&item.part, &item.name) else {
                continue;
            };
            let mut added = self.scene.add_material(&name.value, material.as_ref().clone());
            if let (Ok(id), false) = (&added, finish.is_plain())
                && let Err(error) = self.scene.apply(Edit::Finish(*id, *finish))
            {
                added = Err(error);
            }
            match added {
                Ok(id) => self.ids[i] = Some(Id::Material(id)),
                Err(error) => self.refused(item, &error),
            }
        }
    }

    fn add_entities(&mut self, outline: &Outline) {
        for (i, item) in outline.items.iter().enumerate() {
            let Some(part) = &item.part else {
                self.check_material(item);
                continue;
            };
            match item.sort {
                Sort::Part => continue,
                Sort::Model => {
                    self.add_model(i, outline);
                    continue;
                }
                _ => {}
            }
            let content = match part {
                Part::Texture(_) | Part::Material(..) => continue,
                Part::Settings(settings) => {
                    if let Err(error) = self.scene.apply(Edit::Settings(*settings)) {
                        self.refused(item, &error);
                    }
                    self.ids[i] = Some(Id::Settings);
                    continue;
                }
                Part::Shape(shape) => match self.check_material(item) {
                    Some(material) => Content::Shape(shape.clone(), material),
                    None => continue,
                },
                Part::Light(light) => Content::Light(light.clone()),
                Part::Camera(camera) => Content::Camera(camera.clone()),
                Part::Group => Content::Group(Vec::new()),
                Part::Solid(operation) => Content::Solid(*operation, Vec::new()),
            };
            self.insert(i, item, content);
        }
    }

    fn insert(&mut self, place: usize, item: &Item, content: Content) {
        // The members of a group that was refused are left out: the group has been complained about.
        let parent = match item.parent.map(|parent| self.ids[parent]) {
            None => None,
            Some(Some(Id::Entity(parent) | Id::Part(Some(parent)))) => Some(parent),
            Some(_) => return,
        };
        let name = item.name.as_ref().map(|name| name.value.clone()).unwrap_or_default();
        let node = Node::new(name, content).placed(item.placement);
        let id = self.scene.next_entity_id();
        match self.scene.apply(Edit::insert(Subtree { node, parent, index: None })) {
            Ok(_) => self.ids[place] = Some(Id::Entity(id)),
            Err(error) => self.refused(item, &error),
        }
    }

    /// Adds the textures and materials of all models: shapes may wear them wherever they stand.
    fn add_models(&mut self, outline: &Outline) {
        for item in &outline.items {
            let (Some(source), Some(name)) = (&item.model, &item.name) else { continue };
            match Instance::add_looks(&mut self.scene, &name.value, source) {
                Ok(instance) => {
                    self.names.extend(instance.material_names(source));
                    self.models.push(instance);
                }
                Err(error) if self.complaints.count() == 0 => {
                    self.complaints.add(name.span.clone(), error);
                }
                Err(_) => {}
            }
        }
    }

    /// Adds what a model holds, as the parts in its block change it.
    fn add_model(&mut self, place: usize, outline: &Outline) {
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
        self.models[at].settle(&self.scene, root);
        for (i, part) in outline.items.iter().enumerate() {
            if let (Sort::Part, Some(named), true) = (part.sort, &part.name, part.parent == Some(place)) {
                let id = self.scene.entity_named(&instance::full_name(&name.value, &named.value));
                self.ids[i] = Some(Id::Part(id));
                if id.is_none_or(|id| self.scene.role(id) != Some(Role::Group)) {
                    self.refuse_members(i, outline);
                }
            }
        }
    }

    /// A part that is no group has no members.
    fn refuse_members(&mut self, part: usize, outline: &Outline) {
        if let Some(member) = outline.items.iter().find(|item| item.parent == Some(part)) {
            self.complaints.add(member.word.clone(), "this part cannot have members; only a group can");
        }
    }

    /// What the text says of the parts of a model, by their names.
    fn overrides(&mut self, place: usize, outline: &Outline, model: &Model) -> Overrides {
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
            };
            if parts.insert(name.value.clone(), change).is_some() {
                let message = format!("the part \"{}\" is given twice", name.value);
                self.complaints.add(name.span.clone(), message);
            }
        }
        parts
    }

    /// The material that a shape names, if it is there.
    fn check_material(&mut self, item: &Item) -> Option<MaterialId> {
        let word = item.material.as_ref()?;
        let found = self.scene.material_named(&word.value);
        if found.is_none() && !word.value.is_empty() && !self.names.contains(&word.value) {
            let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
            let help = self.complaints.hint(|| words::hint(&word.value, &names, "materials"));
            let message = format!("there is no material \"{}\"", word.value);
            self.complaints.add_with(word.span.clone(), message, help);
        }
        found
    }

    /// Passes on what the scene refuses, unless the text was complained about already.
    fn refused(&mut self, item: &Item, error: &catoptra_core::scene::SceneError) {
        if self.complaints.count() == 0 {
            let span = item.name.as_ref().map_or(item.word.clone(), |name| name.span.clone());
            self.complaints.add(span, error.to_string());
        }
    }
}
