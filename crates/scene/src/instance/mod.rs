//! How does a model file become part of a scene, and what must its node say for the scene to be as it is now?

mod find;
mod looks;
mod making;
mod parts;

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use catoptra_core::scene::{EntityId, Flags, MaterialId, Node, Scene, TextureId};
use catoptra_core::{InvalidPart, Placement};

use crate::build::Id;
use crate::model::Model;
use crate::state::State;
pub(crate) use find::{find, find_mut, image_named, mesh_named, names};
pub(crate) use looks::repainted;
use making::Making;
use parts::FilePart;
pub(crate) use parts::{PartNow, Wish};

/// A model and the path that the text names it by.
#[derive(Debug, Clone)]
pub(crate) struct ModelSource {
    pub(crate) path: String,
    pub(crate) model: Arc<Model>,
}

/// What the text says of one part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Override {
    /// In place of its own, relative to the group that it lies in.
    pub(crate) placement: Option<Placement>,
    pub(crate) material: Option<MaterialId>,
    pub(crate) removed: bool,
    pub(crate) flags: Flags,
}

/// What the text says of parts, by their names in the file.
pub(crate) type Overrides = HashMap<String, Override>;

/// What a model has become in a scene.
#[derive(Debug, Clone, Default)]
pub(crate) struct Instance {
    name: String,
    /// By which the text names its file.
    path: String,
    /// The group that it is in the scene; none where its node stands in a repeat, whose copies have groups of their own.
    root: Option<EntityId>,
    /// By their place in the model.
    materials: Vec<MaterialId>,
    textures: Vec<TextureId>,
    /// Textures and materials that no node of the text stands for.
    own_looks: Vec<Id>,
    /// What those are by the file.
    looks: Vec<(Id, State)>,
    /// All that lies in the file, groups before their members.
    parts: Vec<FilePart>,
    /// Names of parts of which nodes tell that were written when the scene was edited, and not by a person.
    pub(crate) written: HashSet<String>,
}

/// The name in the scene of something in a model.
pub(crate) fn full_name(model: &str, name: &str) -> String {
    format!("{model}/{name}")
}

impl Instance {
    /// The name of the model's node.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The path by which the text names its file.
    pub(crate) fn path(&self) -> &str {
        &self.path
    }

    /// Its textures and materials that no node of the text stands for.
    pub(crate) fn own_looks(&self) -> &[Id] {
        &self.own_looks
    }

    /// The group that it is in the scene.
    pub(crate) fn root(&self) -> Option<EntityId> {
        self.root
    }

    /// What it holds, to be inserted into the scene.
    ///
    /// # Errors
    /// A shape that the core refuses.
    pub(crate) fn members(&self, source: &ModelSource, parts: &Overrides) -> Result<Vec<Node>, InvalidPart> {
        Making::new(self, source, parts).nodes(&source.model.nodes)
    }

    /// The material of the scene for one of the model.
    fn material(&self, of_model: MaterialId) -> MaterialId {
        self.materials.get(of_model.index() as usize - 1).copied().unwrap_or(of_model)
    }

    /// Notes what the scene holds of its textures and materials, once the scene is whole.
    pub(crate) fn note(&mut self, scene: &Scene) {
        let state = |&id: &Id| Some((id, State::of(scene, id)?));
        self.looks = self.own_looks.iter().filter_map(state).collect();
    }

    /// Whether its textures and materials are all there under their names. What else they are, nodes of their own can say.
    pub(crate) fn has_its_looks(&self, scene: &Scene) -> bool {
        self.looks.iter().all(|(id, before)| State::of(scene, *id).is_some_and(|now| now.name == before.name))
    }

    /// Names of its materials.
    pub(crate) fn material_names<'a>(&'a self, source: &'a ModelSource) -> impl Iterator<Item = String> + 'a {
        source.model.materials.iter().map(|material| full_name(&self.name, &material.name))
    }

    /// Adds what no node need stand for, because this model brings it with it: its parts, and of its looks those that are as
    /// they were.
    pub(crate) fn hide(&self, scene: &Scene, hidden: &mut HashSet<Id>) {
        hidden.extend(self.parts.iter().filter_map(|part| part.entity).map(Id::Entity));
        let same = |(id, before): &&(Id, State)| State::of(scene, *id).as_ref() == Some(before);
        hidden.extend(self.looks.iter().filter(same).map(|(id, _)| *id));
    }
}

/// Shows textures that another material is painted with than one which is hidden itself.
pub(crate) fn show_shared_textures(hidden: &mut HashSet<Id>, scene: &Scene) {
    let is_ours = |id: &Id| match id {
        Id::Texture(id) => scene.painted_with(*id).iter().all(|by| hidden.contains(&Id::Material(*by))),
        _ => true,
    };
    let shown: Vec<Id> = hidden.iter().filter(|id| !is_ours(id)).copied().collect();
    shown.iter().for_each(|id| {
        hidden.remove(id);
    });
}
