//! What has a repeat become in a scene, and is it still so?

use std::collections::HashSet;

use catoptra_core::scene::{EntityId, MaterialId, Scene};

use crate::build::Id;
use crate::instance::Instance;
use crate::state::State;

/// A repeat and its copies.
#[derive(Debug, Clone)]
pub(crate) struct Repeated {
    root: EntityId,
    name: String,
    /// Names of the models that stand in it.
    models: Vec<String>,
    members: Vec<EntityId>,
    copies: Vec<Copied>,
}

/// One entity of a copy, as the text has it.
#[derive(Debug, Clone)]
struct Copied {
    id: EntityId,
    /// But for the name of the material, which may change.
    state: State,
    material: Option<MaterialId>,
    members: Vec<EntityId>,
}

impl Copied {
    fn of(scene: &Scene, id: EntityId) -> Option<Self> {
        let state = State { material: None, ..State::of(scene, Id::Entity(id))? };
        Some(Self { id, state, material: scene.material_of(id), members: scene.children(Some(id)) })
    }

    fn is_so(&self, scene: &Scene) -> bool {
        Self::of(scene, self.id).is_some_and(|now| {
            now.state == self.state && now.material == self.material && now.members == self.members
        })
    }
}

impl Repeated {
    /// What stands in the group of a repeat now.
    pub(crate) fn new(scene: &Scene, root: EntityId, models: Vec<String>) -> Self {
        let members = scene.children(Some(root));
        let mut copies = Vec::new();
        let mut rest = members.clone();
        while let Some(id) = rest.pop() {
            if let Some(copied) = Copied::of(scene, id) {
                rest.extend(&copied.members);
                copies.push(copied);
            }
        }
        Self { root, name: scene.name(root).unwrap_or_default(), models, members, copies }
    }

    /// The group that it is in the scene.
    pub(crate) fn root(&self) -> EntityId {
        self.root
    }

    /// Whether a model of that name stands in it.
    pub(crate) fn holds(&self, model: &str) -> bool {
        self.models.iter().any(|name| name == model)
    }

    /// Whether the text's node still says what the scene holds. Where the repeat stands as a whole, its node can say.
    pub(crate) fn is_intact(&self, scene: &Scene, models: &[Instance]) -> bool {
        let has_its_looks =
            |name: &String| models.iter().any(|model| model.name() == name && model.has_its_looks(scene));
        scene.name(self.root).as_ref() == Some(&self.name)
            && scene.children(Some(self.root)) == self.members
            && self.models.iter().all(has_its_looks)
            && self.copies.iter().all(|copied| copied.is_so(scene))
    }

    /// Adds what no node need stand for.
    pub(crate) fn hide(&self, hidden: &mut HashSet<Id>) {
        hidden.extend(self.copies.iter().map(|copied| Id::Entity(copied.id)));
    }
}
