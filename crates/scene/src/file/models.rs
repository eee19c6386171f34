//! How a model is put into a scene that is open.

use std::collections::HashMap;
use std::sync::Arc;

use catoptra_core::Placement;
use catoptra_core::scene::{Edit, EntityId, Node, Scene, Subtree};

use super::SceneFile;
use crate::build::Id;
use crate::instance::{Instance, ModelSource, Overrides, full_name};
use crate::model::Model;

impl SceneFile {
    /// The edit that adds a model as a group at the top of the scene, under `wish` or a name like it that is free, and the id
    /// that the group has then. Once it is made, the text tells of it by a `model` node, with `path` for its file: what that
    /// path finds from the scene's folder should be the model that is given.
    ///
    /// # Errors
    /// What the scene refuses, for people.
    pub fn model_edit(
        &mut self,
        scene: &Scene,
        (path, model): (&str, Arc<Model>),
        wish: &str,
        placement: Placement,
    ) -> Result<(Edit, EntityId), String> {
        let name = free_name(scene, wish);
        self.files.know_model(path, Arc::clone(&model));
        let source = ModelSource { path: path.to_owned(), model };
        // Tried on a copy: the edit has the ids that everything gets there.
        let mut copy = scene.clone();
        let mut instance = Instance::add_textures(&mut copy, &name, &source, &HashMap::new())?;
        instance.add_materials(&mut copy, &source)?;
        let members = instance.members(&source, &Overrides::new()).map_err(|e| e.to_string())?;
        let root = copy.next_entity_id();
        let group = Node::group(name, members).placed(placement);
        copy.apply(Edit::insert(Subtree::new(group))).map_err(|e| e.to_string())?;
        instance.settle(&copy, &source, root);
        instance.note(&copy);
        let mut edits = Vec::new();
        for look in instance.own_looks() {
            edits.extend(added(&copy, *look));
        }
        edits.extend(copy.node(root).map(|node| Edit::insert(Subtree::new(node))));
        // Whatever becomes of the text, it can be made anew with this model.
        self.opened.resting.push(instance);
        Ok((Edit::Batch(edits), root))
    }
}

/// The edits that add a texture or a material as that scene has it.
fn added(scene: &Scene, look: Id) -> Vec<Edit> {
    match look {
        Id::Texture(id) => {
            let found = scene.find_texture(id).zip(scene.texture_name(id));
            let add = |(texture, name): (&catoptra_core::Texture, &str)| Edit::AddTexture {
                name: name.to_owned(),
                texture: texture.clone(),
                id: Some(id),
            };
            found.map(add).into_iter().collect()
        }
        Id::Material(id) => {
            let (name, material) = (scene.material_name(id).to_owned(), scene.material(id).clone());
            let add = Edit::AddMaterial { name, material, id: Some(id) };
            let finish = scene.finish(id);
            if finish.is_plain() { vec![add] } else { vec![add, Edit::Finish(id, finish)] }
        }
        _ => Vec::new(),
    }
}

/// A name that no entity has, and that stands before no name of anything.
fn free_name(scene: &Scene, wish: &str) -> String {
    let mut name = scene.free_name(wish);
    let mut number = 2_u32;
    while is_prefix(scene, &name) {
        name = scene.free_name(&format!("{wish} {number}"));
        number += 1;
    }
    name
}

fn is_prefix(scene: &Scene, name: &str) -> bool {
    let prefix = full_name(name, "");
    scene.textures().any(|(_, name, _)| name.starts_with(&prefix))
        || scene.materials().any(|(_, name, _)| name.starts_with(&prefix))
        || scene.walk().into_iter().filter_map(|id| scene.name(id)).any(|name| name.starts_with(&prefix))
}
