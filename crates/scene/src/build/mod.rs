//! How a scene is built from what its text says: textures and materials first, then entities group by group.

mod models;
mod repeats;

use std::collections::HashMap;

use catoptra_core::scene::{Content, Edit, EntityId, MaterialId, Node, Scene, Subtree, TextureId};

use crate::instance::Instance;
use crate::outline::{Item, Outline, Part, Sort, Word};
use crate::repeated::Repeated;
use crate::report::Complaints;
use crate::words;

/// The part of a scene that a node stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Id {
    Settings,
    Texture(TextureId),
    Material(MaterialId),
    Entity(EntityId),
    /// What the text says of a part of a model, and the material that it gives it. No entity where it is left out.
    Part(Option<EntityId>, Option<MaterialId>),
    /// What stands in a repeat, and the material that it wears: it is there many times, or a part of what is.
    Repeated(Option<MaterialId>),
}

impl Id {
    /// The material that the node names, where the node is not that of one entity.
    pub(crate) fn named_material(self) -> Option<MaterialId> {
        match self {
            Self::Part(_, material) | Self::Repeated(material) => material,
            _ => None,
        }
    }
}

/// What has come of a text.
pub(crate) struct Built {
    pub(crate) scene: Scene,
    /// What each item of the outline has become.
    pub(crate) ids: Vec<Id>,
    pub(crate) models: Vec<Instance>,
    pub(crate) repeats: Vec<Repeated>,
}

/// Builds the scene. If anything is wrong it goes to `complaints`, and the scene is not whole.
pub(crate) fn build(outline: &Outline, complaints: &mut Complaints) -> Built {
    let mut builder = Builder {
        scene: Scene::new(),
        complaints,
        first: HashMap::new(),
        names: Vec::new(),
        models: Vec::new(),
        repeats: Vec::new(),
        copied: 0,
        ids: vec![None; outline.items.len()],
    };
    builder.check_names(outline);
    builder.add_textures(outline);
    builder.add_textures_of_models(outline);
    builder.add_materials(outline);
    builder.add_materials_of_models(outline);
    builder.add_entities(outline);
    let scene = &builder.scene;
    builder.models.iter_mut().for_each(|model| model.note(scene));
    let ids = builder.ids.into_iter().map(|id| id.unwrap_or(Id::Settings)).collect();
    Built { scene: builder.scene, ids, models: builder.models, repeats: builder.repeats }
}

struct Builder<'a> {
    scene: Scene,
    complaints: &'a mut Complaints,
    /// Where every name was first given, by what shares a list of names: the text, or a repeat by its place in the outline.
    first: HashMap<(Option<usize>, &'static str, &'a str), usize>,
    models: Vec<Instance>,
    repeats: Vec<Repeated>,
    /// How many entities repeats have made so far.
    copied: u64,
    /// Names of all materials, those that could not be made too.
    names: Vec<String>,
    ids: Vec<Option<Id>>,
}

impl<'a> Builder<'a> {
    fn check_names(&mut self, outline: &'a Outline) {
        let mut settings: Option<usize> = None;
        for item in &outline.items {
            match &item.name {
                Some(name) if !name.value.trim().is_empty() => self.check_name(outline, item, name),
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

    fn check_name(&mut self, outline: &Outline, item: &Item, name: &'a Word) {
        let whose = match item.sort {
            Sort::Texture(_) => "texture",
            Sort::Material(_) => "material",
            // The name of a part is one that its file gives.
            Sort::Part => return,
            _ => "shape, light, camera or group",
        };
        let repeat = outline.repeat_round(item);
        let is_free = self.check_free(repeat, whose, name);
        if matches!(item.sort, Sort::Model) && is_free {
            // Its materials and textures have its name before theirs, wherever it stands.
            self.check_free(None, "model", name);
        }
        if matches!(item.sort, Sort::Material(_)) {
            self.names.push(name.value.clone());
        }
    }

    fn check_free(&mut self, repeat: Option<usize>, whose: &'static str, name: &'a Word) -> bool {
        let key = (repeat, whose, name.value.as_str());
        let Some(&first) = self.first.get(&key) else {
            self.first.insert(key, name.span.start);
            return true;
        };
        let message = format!("the name \"{}\" is taken by another {whose}", name.value);
        self.again(name.span.clone(), message, first);
        false
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
            if self.ids[i].is_some() || outline.repeat_round(item).is_some() {
                // Of what stands in a repeat, the repeat has made copies.
                continue;
            }
            let Some(part) = &item.part else {
                self.check_material(item);
                continue;
            };
            match (item.sort, part) {
                (Sort::Part, _) => {}
                (Sort::Model, _) => self.add_model(i, outline),
                (Sort::Repeat, _) => self.add_repeat(i, outline),
                (_, Part::Settings(settings)) => {
                    if let Err(error) = self.scene.apply(Edit::Settings(*settings)) {
                        self.refused(item, &error);
                    }
                    self.ids[i] = Some(Id::Settings);
                }
                _ => {
                    if let Some(content) = self.content(item, Vec::new()) {
                        self.insert(i, item, content);
                    }
                }
            }
        }
    }

    /// What an item is as an entity, with its members.
    fn content(&mut self, item: &Item, members: Vec<Node>) -> Option<Content> {
        Some(match item.part.as_ref()? {
            Part::Texture(_) | Part::Material(..) | Part::Settings(_) => return None,
            Part::Shape(shape) => Content::Shape(shape.clone(), self.check_material(item)?),
            Part::Light(light) => Content::Light(light.clone()),
            Part::Camera(camera) => Content::Camera(camera.clone()),
            Part::Group => Content::Group(members),
            Part::Solid(operation) => Content::Solid(*operation, members),
        })
    }

    fn insert(&mut self, place: usize, item: &Item, content: Content) {
        // The members of a group that was refused are left out: the group has been complained about.
        let parent = match item.parent.map(|parent| self.ids[parent]) {
            None => None,
            Some(Some(Id::Entity(parent) | Id::Part(Some(parent), _))) => Some(parent),
            Some(_) => return,
        };
        let name = item.name.as_ref().map(|name| name.value.clone()).unwrap_or_default();
        let node = Node::new(name, content).placed(item.placement).flagged(item.flags);
        let id = self.scene.next_entity_id();
        match self.scene.apply(Edit::insert(Subtree { node, parent, index: None })) {
            Ok(_) => self.ids[place] = Some(Id::Entity(id)),
            Err(error) => self.refused(item, &error),
        }
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
            match error.hint() {
                Some(hint) => self.complaints.add_with(span, error.to_string(), hint),
                None => self.complaints.add(span, error.to_string()),
            }
        }
    }
}
