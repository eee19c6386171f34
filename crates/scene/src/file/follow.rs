//! How the text follows its scene.

use std::collections::HashSet;

use catoptra_core::scene::{EntityId, Scene};

use super::SceneFile;
use crate::build::Id;
use crate::instance::{self, Instance};
use crate::outline::Sort;
use crate::read;
use crate::repeated::Repeated;
use crate::report::Complaints;
use crate::write::{self, Brought, Splice};

impl SceneFile {
    /// A changed text is read again, but the files that it names are not.
    pub(super) fn know_files(&mut self, scene: &Scene) {
        for id in scene.entities() {
            let values = match (scene.shape(id), scene.light(id)) {
                (Some(shape), _) if shape.as_mesh().is_some() => shape.values(),
                (_, Some(light)) => light.values(),
                _ => continue,
            };
            values.iter().for_each(|(_, value)| self.files.know(value));
        }
        for (_, _, texture) in scene.textures() {
            texture.values().iter().for_each(|(_, value)| self.files.know(value));
        }
    }

    /// Writes out in full those models and repeats of which their nodes cannot tell any more.
    pub(super) fn write_out(&mut self, scene: &Scene) {
        let mut models = std::mem::take(&mut self.now.models);
        models.append(&mut self.now.resting);
        self.now.repeats.retain(|repeat| repeat.is_intact(scene, &models));
        let repeats = &self.now.repeats;
        let (kept, resting) = models.into_iter().partition(|model| match model.root() {
            Some(root) => model.now(scene).is_some() && !self.is_other_node(root),
            None => repeats.iter().any(|repeat| repeat.holds(model.name())),
        });
        (self.now.models, self.now.resting) = (kept, resting);
        let kept: HashSet<EntityId> = self
            .now
            .models
            .iter()
            .filter_map(Instance::root)
            .chain(repeats.iter().map(Repeated::root))
            .collect();
        let mut splices: Vec<Splice> = Vec::new();
        for (place, (item, id)) in self.now.outline.items.iter().zip(&self.now.ids).enumerate() {
            let Id::Entity(root) = *id else { continue };
            let inside = splices.last().is_some_and(|s| s.range.contains(&item.span.start));
            let is_such = matches!(item.sort, Sort::Model | Sort::Repeat);
            if is_such && !inside && !kept.contains(&root) && scene.contains(root) {
                let whole = (place, root);
                let models = (scene, self.now.models.as_slice());
                splices.push(write::in_full(&self.now.text, &self.now.outline, &self.now.ids, models, whole));
            }
        }
        let _ = self.splice(scene, splices);
        self.forget_repeats_without_node();
    }

    /// Whether the text has a node for a group which is not that of a model.
    fn is_other_node(&self, root: EntityId) -> bool {
        let place = self.now.ids.iter().position(|id| *id == Id::Entity(root));
        place.is_some_and(|place| !matches!(self.now.outline.items[place].sort, Sort::Model))
    }

    /// A repeat whose node is gone with one that was written out is written out with it.
    fn forget_repeats_without_node(&mut self) {
        let nodes = self.now.outline.items.iter().zip(&self.now.ids);
        let nodes = nodes.filter(|(item, _)| matches!(item.sort, Sort::Repeat));
        let there: HashSet<Id> = nodes.map(|(_, id)| *id).collect();
        self.now.repeats.retain(|repeat| there.contains(&Id::Entity(repeat.root())));
        let repeats = &self.now.repeats;
        let stays = |model: &mut Instance| {
            model.root().is_some() || repeats.iter().any(|repeat| repeat.holds(model.name()))
        };
        self.now.models.retain_mut(stays);
    }

    pub(super) fn follow(&mut self, scene: &Scene) -> Option<()> {
        self.splice(scene, write::edit(&self.now.text, &self.now.outline, &self.now.ids, scene))?;
        let is_new =
            self.now.models.iter().any(|model| model.root().is_some() && self.place_of(model).is_none());
        self.follow_parts(scene)?;
        self.arrange(scene)?;
        if is_new {
            // Now there are nodes of models to be filled.
            self.follow_parts(scene)?;
            self.arrange(scene)?;
        }
        self.splice(scene, write::remove(&self.now.text, &self.now.outline, &self.now.ids, scene))?;
        self.remove_parts(scene)
    }

    fn arrange(&mut self, scene: &Scene) -> Option<()> {
        let hidden = self.hidden(scene);
        // Every call settles at least one node.
        for _ in 0..=self.now.ids.len() + scene.entities().len() + 2 {
            let brought = Brought { models: &self.now.models, hidden: &hidden };
            let splices = write::arrange(&self.now.text, &self.now.outline, &self.now.ids, scene, brought);
            if splices.is_empty() {
                break;
            }
            self.splice(scene, splices)?;
        }
        Some(())
    }

    /// What nodes of the text need not stand for, because models and repeats bring it with them.
    fn hidden(&self, scene: &Scene) -> HashSet<Id> {
        let mut hidden = HashSet::new();
        self.now.models.iter().for_each(|model| model.hide(scene, &mut hidden));
        self.now.repeats.iter().for_each(|repeat| repeat.hide(&mut hidden));
        instance::show_shared_textures(&mut hidden, scene);
        hidden
    }

    /// Where the node of a model stands.
    fn place_of(&self, model: &Instance) -> Option<usize> {
        let root = model.root().map(Id::Entity)?;
        self.now.ids.iter().position(|id| *id == root)
    }

    /// Makes the nodes of parts of models say what has become of these.
    fn follow_parts(&mut self, scene: &Scene) -> Option<()> {
        for i in 0..self.now.models.len() {
            let model = &self.now.models[i];
            let Some(place) = self.place_of(model) else { continue };
            let mut written = Vec::new();
            let node = (place, model);
            let splices = write::edit_parts(
                &self.now.text,
                &self.now.outline,
                &self.now.ids,
                scene,
                node,
                &mut written,
            );
            self.now.models[i].written.extend(written);
            self.splice(scene, splices)?;
        }
        for (item, id) in self.now.outline.items.iter().zip(&mut self.now.ids) {
            if let Id::Part(_, material) = id {
                *material = item.material.as_ref().and_then(|word| scene.material_named(&word.value));
            }
        }
        Some(())
    }

    fn remove_parts(&mut self, scene: &Scene) -> Option<()> {
        for i in 0..self.now.models.len() {
            let Some(place) = self.place_of(&self.now.models[i]) else { continue };
            let splices =
                write::remove_parts(&self.now.text, &self.now.outline, scene, (place, &self.now.models[i]));
            self.splice(scene, splices)?;
        }
        Some(())
    }

    /// Changes the text and reads it again; `None` if it does not say then what it should.
    fn splice(&mut self, scene: &Scene, splices: Vec<Splice>) -> Option<()> {
        if splices.is_empty() {
            return Some(());
        }
        let starts: Vec<usize> = self.now.outline.items.iter().map(|item| item.span.start).collect();
        let (text, moved, new) = write::apply(&self.now.text, splices, &starts);
        let mut complaints = Complaints::new();
        let names = scene.textures().map(|(id, name, _)| (name.to_owned(), id)).collect();
        let outline = read::read(&text, Some(names), &mut self.files, &mut complaints);
        if complaints.count() > 0 {
            return None;
        }
        let mut kept =
            moved.iter().zip(&self.now.ids).filter_map(|(at, id)| at.map(|at| (at, *id))).peekable();
        let mut new = new.into_iter();
        let mut ids = Vec::with_capacity(outline.items.len());
        for item in &outline.items {
            ids.push(match kept.next_if(|(at, _)| *at == item.span.start) {
                Some((_, id)) => id,
                None => new.next()?,
            });
        }
        if kept.next().is_some() || new.next().is_some() {
            return None;
        }
        (self.now.text, self.now.outline, self.now.ids) = (text, outline, ids);
        Some(())
    }
}
