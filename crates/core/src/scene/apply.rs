//! How is an edit checked, done, written down and inverted?

use super::{
    Change, ChangeKind, Content, Edit, EntityId, MaterialId, Members, Name, Node, Parent, Role, Scene,
    SceneError, Subject, Subtree,
};
use crate::{Camera, Light, Placement, Shape};

impl Scene {
    /// Does an edit, writes it into the log, and answers with the edit that takes it back: ids, names, order and
    /// members included. The inverse of an insertion is [`Edit::Remove`], which tells the id of what was
    /// inserted; the inverse of a new material tells its id alike.
    ///
    /// # Errors
    /// What the edit names is not there, or the scene would no longer hold together; the scene is then as it was.
    pub fn apply(&mut self, edit: Edit) -> Result<Edit, SceneError> {
        let written = self.log.len();
        let (ids, material_ids) = (self.ids, self.materials.ids);
        self.revision += 1;
        let outcome = self.perform(edit);
        if outcome.is_err() {
            self.log.truncate(written);
            (self.ids, self.materials.ids) = (ids, material_ids);
        }
        if self.log.len() == written {
            self.revision -= 1;
        }
        outcome
    }

    fn perform(&mut self, edit: Edit) -> Result<Edit, SceneError> {
        match edit {
            Edit::Insert(subtree) => self.insert(*subtree),
            Edit::Remove(id) => self.remove(id),
            Edit::Shape(id, shape) => Ok(Edit::Shape(id, self.exchange(id, shape)?)),
            Edit::Light(id, light) => Ok(Edit::Light(id, self.exchange(id, light)?)),
            Edit::Camera(id, camera) => Ok(Edit::Camera(id, self.exchange(id, camera)?)),
            Edit::Placement(id, placement) => Ok(Edit::Placement(id, self.exchange(id, placement)?)),
            Edit::MaterialOf(id, material) => {
                self.check_material(material)?;
                Ok(Edit::MaterialOf(id, self.exchange(id, material)?))
            }
            Edit::Parent(id, parent) => self.join(id, parent),
            Edit::Order(id, index) => self.order(id, index),
            Edit::Name(id, name) => self.rename(id, name),
            Edit::Material(id, material) => {
                let old = self.materials.replace(id, material)?;
                self.record(Subject::Material(id), ChangeKind::Value);
                Ok(Edit::Material(id, old))
            }
            Edit::AddMaterial { name, material, id } => {
                let id = self.materials.add(name, material, id)?;
                self.record(Subject::Material(id), ChangeKind::Added);
                Ok(Edit::RemoveMaterial(id))
            }
            Edit::RemoveMaterial(id) => self.remove_material(id),
            Edit::RenameMaterial(id, name) => {
                let old = self.materials.rename(id, name)?;
                self.record(Subject::Material(id), ChangeKind::Name);
                Ok(Edit::RenameMaterial(id, old))
            }
            Edit::Settings(settings) => {
                self.record(Subject::Settings, ChangeKind::Value);
                Ok(Edit::Settings(std::mem::replace(&mut self.settings, settings)))
            }
            Edit::Batch(edits) => self.batch(edits),
        }
    }

    /// All or none; [`Self::apply`] takes back what the refused ones left in the log.
    fn batch(&mut self, edits: Vec<Edit>) -> Result<Edit, SceneError> {
        let mut inverses = Vec::with_capacity(edits.len());
        for edit in edits {
            match self.perform(edit) {
                Ok(inverse) => inverses.push(inverse),
                Err(error) => {
                    for inverse in inverses.into_iter().rev() {
                        let undone = self.perform(inverse);
                        debug_assert!(undone.is_ok(), "an inverse was refused: {undone:?}");
                    }
                    return Err(error);
                }
            }
        }
        inverses.reverse();
        Ok(Edit::Batch(inverses))
    }

    fn record(&mut self, subject: Subject, what: ChangeKind) {
        self.log.push(Change { revision: self.revision, subject, what });
    }

    /// Puts `value` in the place of the component of its type and gives back what was there.
    fn exchange<T: Slot>(&mut self, id: EntityId, value: T) -> Result<T, SceneError> {
        let entity = self.entity(id).ok_or(SceneError::UnknownEntity(id))?;
        let Ok(slot) = self.world.query_one_mut::<&mut T>(entity) else {
            return Err(SceneError::WrongRole {
                name: self.name_or_id(id),
                is: self.role(id).unwrap_or(Role::Group),
                needs: T::ROLE,
            });
        };
        let old = std::mem::replace(slot, value);
        self.record(Subject::Entity(id), T::CHANGE);
        Ok(old)
    }

    fn insert(&mut self, subtree: Subtree) -> Result<Edit, SceneError> {
        self.check_insertion(&subtree)?;
        for id in subtree.node.walk().filter_map(|(node, _)| node.id) {
            self.ids.skip_past(id.index());
        }
        let id = self.spawn(subtree.node, subtree.parent);
        self.list(id, subtree.parent, subtree.index);
        Ok(Edit::Remove(id))
    }

    /// Puts a checked node into the world, but not into its parent's list of members.
    pub(super) fn spawn(&mut self, node: Node, parent: Option<EntityId>) -> EntityId {
        let id = node.id.unwrap_or_else(|| self.ids.take_entity());
        self.by_name.insert(node.name.clone(), id);
        self.record(Subject::Entity(id), ChangeKind::Added);
        let common = (id, Name(node.name), node.placement);
        let entity = match node.content {
            Content::Shape(shape, material) => self.world.spawn((shape, material)),
            Content::Light(light) => self.world.spawn((light,)),
            Content::Camera(camera) => self.world.spawn((camera,)),
            Content::Group(members) => {
                let members = members.into_iter().map(|member| self.spawn(member, Some(id))).collect();
                self.world.spawn((Members(members),))
            }
        };
        self.world.insert(entity, common).expect("the entity was spawned above");
        self.set_parent(entity, parent);
        self.entities.insert(id, entity);
        id
    }

    fn set_parent(&mut self, entity: hecs::Entity, parent: Option<EntityId>) {
        if let Some(group) = parent {
            let stored = self.world.insert_one(entity, Parent(group));
            debug_assert!(stored.is_ok(), "the member is not in the world");
        } else {
            // An error says that it was at the top already.
            let _ = self.world.remove_one::<Parent>(entity);
        }
    }

    fn remove(&mut self, id: EntityId) -> Result<Edit, SceneError> {
        let node = self.node(id).ok_or(SceneError::UnknownEntity(id))?;
        let parent = self.parent(id);
        let index = Some(self.unlist(id));
        for (gone, _) in node.walk() {
            self.by_name.remove(&gone.name);
            if let Some(id) = gone.id
                && let Some(entity) = self.entities.remove(&id)
            {
                let despawned = self.world.despawn(entity);
                debug_assert!(despawned.is_ok(), "{id} was not in the world");
                self.record(Subject::Entity(id), ChangeKind::Removed);
            }
        }
        Ok(Edit::insert(Subtree { node, parent, index }))
    }

    fn join(&mut self, id: EntityId, parent: Option<EntityId>) -> Result<Edit, SceneError> {
        let entity = self.entity(id).ok_or(SceneError::UnknownEntity(id))?;
        self.check_membership(id, parent)?;
        let old = self.parent(id);
        let index = self.unlist(id);
        self.set_parent(entity, parent);
        self.list(id, parent, None);
        self.record(Subject::Entity(id), ChangeKind::Parent);
        Ok(Edit::Batch(vec![Edit::Parent(id, old), Edit::Order(id, index)]))
    }

    fn order(&mut self, id: EntityId, index: usize) -> Result<Edit, SceneError> {
        if !self.contains(id) {
            return Err(SceneError::UnknownEntity(id));
        }
        let old = self.unlist(id);
        self.list(id, self.parent(id), Some(index));
        self.record(Subject::Entity(id), ChangeKind::Order);
        Ok(Edit::Order(id, old))
    }

    fn rename(&mut self, id: EntityId, name: String) -> Result<Edit, SceneError> {
        let old = self.name(id).ok_or(SceneError::UnknownEntity(id))?;
        if name != old {
            self.check_name(&name)?;
            self.by_name.remove(&old);
            self.by_name.insert(name.clone(), id);
        }
        let Name(old) = self.exchange(id, Name(name))?;
        Ok(Edit::Name(id, old))
    }

    fn remove_material(&mut self, id: MaterialId) -> Result<Edit, SceneError> {
        let wearers = self.wearers(id);
        if let Some(&first) = wearers.first() {
            return Err(SceneError::MaterialInUse {
                material: self.material_name(id).to_owned(),
                shape: self.name_or_id(first),
                others: wearers.len() - 1,
            });
        }
        let (name, material) = self.materials.remove(id)?;
        self.record(Subject::Material(id), ChangeKind::Removed);
        Ok(Edit::AddMaterial { name, material, id: Some(id) })
    }
}

/// A component that an edit can exchange.
trait Slot: hecs::Component {
    /// What entities have it; for what all have, any.
    const ROLE: Role;
    /// What the log says of it.
    const CHANGE: ChangeKind;
}

macro_rules! slots {
    ($($component:ty: $role:ident, $change:ident;)+) => {
        $(impl Slot for $component {
            const ROLE: Role = Role::$role;
            const CHANGE: ChangeKind = ChangeKind::$change;
        })+
    };
}

slots! {
    Shape: Shape, Shape;
    MaterialId: Shape, Material;
    Light: Light, Light;
    Camera: Camera, Camera;
    Placement: Group, Placement;
    Name: Group, Name;
}
