//! How is an edit checked, done, written down and inverted?

use super::component::{Members, Name, Parent, Touched};
use super::painting::Worn;
use super::{
    Change, ChangeKind, Content, Edit, EntityId, Flags, MaterialId, Node, Role, Scene, SceneError, Subject,
    Subtree, new_revision,
};
use crate::{Camera, Finish, Light, Operation, Placement, Shape};

impl Scene {
    /// Does an edit, writes it into the log, and answers with the edit that takes it back: ids, names, order and
    /// members included. The inverse of an insertion is [`Edit::Remove`] with the id of what was
    /// inserted; the inverse of a new material likewise holds its id.
    ///
    /// # Errors
    /// What the edit names is not there, or the scene would no longer hold together; the scene is then as it was.
    pub fn apply(&mut self, edit: Edit) -> Result<Edit, SceneError> {
        let written = self.log.len();
        let ids = (self.ids, self.materials.ids, self.textures.ids);
        let before = std::mem::replace(&mut self.revision, new_revision());
        let outcome = self.perform(edit);
        if outcome.is_err() {
            self.log.truncate(written);
            (self.ids, self.materials.ids, self.textures.ids) = ids;
        }
        if self.log.len() == written {
            self.revision = before;
        }
        outcome
    }

    fn perform(&mut self, edit: Edit) -> Result<Edit, SceneError> {
        match edit {
            Edit::Insert(subtree) => self.insert(*subtree),
            Edit::Remove(id) => self.remove(id),
            Edit::Shape(id, shape) => {
                self.check_part_of_solid(id, &shape)?;
                Ok(Edit::Shape(id, self.exchange(id, shape)?))
            }
            Edit::Operation(id, operation) => Ok(Edit::Operation(id, self.exchange(id, operation)?)),
            Edit::Light(id, light) => Ok(Edit::Light(id, self.exchange(id, light)?)),
            Edit::Camera(id, camera) => Ok(Edit::Camera(id, self.exchange(id, camera)?)),
            Edit::Placement(id, placement) => Ok(Edit::Placement(id, self.exchange(id, placement)?)),
            Edit::Flags(id, flags) => Ok(Edit::Flags(id, self.exchange(id, flags)?)),
            Edit::MaterialOf(id, material) => {
                self.check_material(material)?;
                Ok(Edit::MaterialOf(id, self.exchange(id, material)?))
            }
            Edit::Parent(id, parent) => self.join(id, parent),
            Edit::Order(id, index) => self.order(id, index),
            Edit::Name(id, name) => self.rename(id, name),
            Edit::Material(id, material) => {
                self.check_textures(&material.values())?;
                let old = std::mem::replace(&mut self.materials.get_mut(id)?.material, material);
                self.record(Subject::Material(id), ChangeKind::Value);
                Ok(Edit::Material(id, old))
            }
            Edit::AddMaterial { name, material, id } => {
                self.check_textures(&material.values())?;
                let id = self.materials.add(name, Worn { material, finish: Finish::default() }, id)?;
                self.record(Subject::Material(id), ChangeKind::Added);
                Ok(Edit::RemoveMaterial(id))
            }
            Edit::RemoveMaterial(id) => self.remove_material(id),
            Edit::RenameMaterial(id, name) => {
                let old = self.materials.rename(id, name)?;
                self.record(Subject::Material(id), ChangeKind::Name);
                Ok(Edit::RenameMaterial(id, old))
            }
            Edit::Finish(id, finish) => self.set_finish(id, finish),
            Edit::Texture(id, texture) => self.set_texture(id, texture),
            Edit::AddTexture { name, texture, id } => self.put_texture(name, texture, id),
            Edit::RemoveTexture(id) => self.remove_texture(id),
            Edit::RenameTexture(id, name) => self.rename_texture(id, name),
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

    pub(super) fn record(&mut self, subject: Subject, what: ChangeKind) {
        self.log.push(Change { revision: self.revision, subject, what });
    }

    /// Notes that an entity or its placement in its group has changed in this revision.
    fn touch(&mut self, entity: hecs::Entity) {
        if let Ok(touched) = self.world.query_one_mut::<&mut Touched>(entity) {
            touched.0 = self.revision;
        }
    }

    /// Notes that a solid has other members, or in another order: its other members look different then.
    fn touch_solid(&mut self, group: Option<EntityId>) {
        if let Some(group) = group
            && self.operation(group).is_some()
            && let Some(entity) = self.entity(group)
        {
            self.touch(entity);
        }
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
        if T::CHANGE != ChangeKind::Name {
            self.touch(entity);
        }
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
        self.touch_solid(subtree.parent);
        Ok(Edit::Remove(id))
    }

    /// Puts a checked node into the world, but not into its parent's list of members.
    pub(super) fn spawn(&mut self, node: Node, parent: Option<EntityId>) -> EntityId {
        let id = node.id.unwrap_or_else(|| self.ids.take_entity());
        self.by_name.insert(node.name.clone(), id);
        self.record(Subject::Entity(id), ChangeKind::Added);
        let common = (id, Name(node.name), node.placement, node.flags, Touched(self.revision));
        let entity = match node.content {
            Content::Shape(shape, material) => self.world.spawn((shape, material)),
            Content::Light(light) => self.world.spawn((light,)),
            Content::Camera(camera) => self.world.spawn((camera,)),
            Content::Group(members) => {
                let members = self.spawn_all(members, id);
                self.world.spawn((members,))
            }
            Content::Solid(operation, members) => {
                let members = self.spawn_all(members, id);
                self.world.spawn((members, operation))
            }
        };
        self.world.insert(entity, common).expect("the entity was spawned above");
        self.set_parent(entity, parent);
        self.entities.insert(id, entity);
        id
    }

    fn spawn_all(&mut self, members: Vec<Node>, group: EntityId) -> Members {
        Members(members.into_iter().map(|member| self.spawn(member, Some(group))).collect())
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
        self.touch_solid(parent);
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
        self.touch(entity);
        self.touch_solid(old);
        self.touch_solid(parent);
        self.record(Subject::Entity(id), ChangeKind::Parent);
        Ok(Edit::Batch(vec![Edit::Parent(id, old), Edit::Order(id, index)]))
    }

    fn order(&mut self, id: EntityId, index: usize) -> Result<Edit, SceneError> {
        if !self.contains(id) {
            return Err(SceneError::UnknownEntity(id));
        }
        let old = self.unlist(id);
        self.list(id, self.parent(id), Some(index));
        self.touch_solid(self.parent(id));
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
        let (name, Worn { material, finish }) = self.materials.remove(id)?;
        self.record(Subject::Material(id), ChangeKind::Removed);
        let back = Edit::AddMaterial { name, material, id: Some(id) };
        if finish == Finish::default() {
            return Ok(back);
        }
        Ok(Edit::Batch(vec![back, Edit::Finish(id, finish)]))
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
    Operation: Group, Operation;
    Placement: Group, Placement;
    Flags: Group, Flags;
    Name: Group, Name;
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{Room, camera, light, matte, moved, sphere};
    use super::*;
    use crate::Rgb;
    use crate::scene::Settings;

    fn subjects(scene: &Scene, since: u64) -> Vec<(Subject, ChangeKind)> {
        scene.changes_since(since).iter().map(|change| (change.subject, change.what)).collect()
    }

    #[test]
    fn an_undone_removal_restores_ids_names_order_and_members() {
        let r = Room::new();
        let without = r.there_and_back(Edit::Remove(r.things));
        assert_eq!(without.walk(), [r.floor, r.eye]);
        assert_eq!(without.entity_named("lamp"), None);
    }

    #[test]
    fn a_removal_logs_each_member() {
        let mut r = Room::new();
        let before = r.scene.revision();
        r.scene.apply(Edit::Remove(r.things)).unwrap();
        let gone = [r.things, r.ball, r.lamps, r.lamp].map(|id| (Subject::Entity(id), ChangeKind::Removed));
        assert_eq!(subjects(&r.scene, before), gone);
    }

    #[test]
    fn ids_of_what_is_gone_are_not_given_again() {
        let mut r = Room::new();
        let next = r.scene.next_entity_id();
        r.scene.apply(Edit::Remove(r.eye)).unwrap();
        assert_eq!(r.scene.add_group("new", None).unwrap(), next);
        assert!(next > r.eye);
    }

    #[test]
    fn a_whole_subtree_is_inserted_where_it_was_asked_for() {
        let r = Room::new();
        let inner = Node::group("inner", vec![Node::shape("pearl", sphere(0.1), r.grey)]);
        let outer = Node::group("outer", vec![Node::light("star", light(1.0)), inner]);
        let scene = r.there_and_back(Edit::insert(Subtree::new(outer).under(r.things).at(1)));
        let names: Vec<_> = scene.walk().into_iter().filter_map(|id| scene.name(id)).collect();
        assert_eq!(
            names,
            ["floor", "things", "ball", "outer", "star", "inner", "pearl", "lamps", "lamp", "eye"]
        );
    }

    #[test]
    fn each_value_is_set_logged_and_taken_back() {
        let r = Room::new();
        let settings = Settings::new(Rgb::WHITE, 2).unwrap();
        let entity = |id| Subject::Entity(id);
        for (edit, subject, what) in [
            (Edit::Shape(r.ball, sphere(2.0)), entity(r.ball), ChangeKind::Shape),
            (Edit::Light(r.lamp, light(9.0)), entity(r.lamp), ChangeKind::Light),
            (Edit::Camera(r.eye, camera(0.3)), entity(r.eye), ChangeKind::Camera),
            (Edit::Placement(r.things, moved(1.0, 2.0, 3.0)), entity(r.things), ChangeKind::Placement),
            (Edit::Flags(r.lamps, Flags { hidden: true, locked: false }), entity(r.lamps), ChangeKind::Flags),
            (Edit::MaterialOf(r.ball, r.grey), entity(r.ball), ChangeKind::Material),
            (Edit::Parent(r.ball, None), entity(r.ball), ChangeKind::Parent),
            (Edit::Order(r.eye, 0), entity(r.eye), ChangeKind::Order),
            (Edit::Name(r.ball, "globe".into()), entity(r.ball), ChangeKind::Name),
            (Edit::Material(r.grey, matte(0.1)), Subject::Material(r.grey), ChangeKind::Value),
            (Edit::RemoveMaterial(r.grey), Subject::Material(r.grey), ChangeKind::Removed),
            (Edit::RenameMaterial(r.grey, "ash".into()), Subject::Material(r.grey), ChangeKind::Name),
            (Edit::Settings(settings), Subject::Settings, ChangeKind::Value),
        ] {
            let scene = r.there_and_back(edit.clone());
            assert_ne!(scene, r.scene, "{edit:?}");
            assert_eq!(subjects(&scene, r.scene.revision()), [(subject, what)], "{edit:?}");
        }
    }

    #[test]
    fn a_moved_member_stands_last_and_returns_to_its_place() {
        let r = Room::new();
        let scene = r.there_and_back(Edit::Parent(r.floor, Some(r.things)));
        assert_eq!(scene.children(Some(r.things)), [r.ball, r.lamps, r.floor]);
        assert_eq!(scene.children(None), [r.things, r.eye]);
        assert_eq!(scene.parent(r.floor), Some(r.things));
        let again = r.there_and_back(Edit::Parent(r.floor, None));
        assert_eq!(again.children(None), [r.things, r.eye, r.floor]);
    }

    #[test]
    fn a_place_past_the_end_is_the_last() {
        let r = Room::new();
        let scene = r.there_and_back(Edit::Order(r.floor, 99));
        assert_eq!(scene.children(None), [r.things, r.eye, r.floor]);
    }

    #[test]
    fn a_group_cannot_join_itself_or_its_members() {
        let r = Room::new();
        let error = r.refusal(Edit::Parent(r.things, Some(r.lamps)));
        assert_eq!(error.to_string(), "\"things\" cannot become a member of \"lamps\", which is inside it");
        let error = r.refusal(Edit::Parent(r.things, Some(r.things)));
        assert_eq!(error.to_string(), "\"things\" cannot become a member of \"things\", which is itself");
    }

    #[test]
    fn only_a_group_takes_members() {
        let r = Room::new();
        let error = r.refusal(Edit::Parent(r.floor, Some(r.ball)));
        assert_eq!(error.to_string(), "\"ball\" is a shape and cannot have members; only a group can");
        let new = Subtree::new(Node::group("new", vec![])).under(r.lamp);
        assert!(matches!(r.refusal(Edit::insert(new)), SceneError::NotAGroup { is: Role::Light, .. }));
    }

    #[test]
    fn names_are_not_empty_and_not_shared() {
        let r = Room::new();
        assert_eq!(r.refusal(Edit::Name(r.ball, " \t".into())), SceneError::EmptyName);
        assert_eq!(r.refusal(Edit::Name(r.ball, "lamp".into())), SceneError::NameTaken("lamp".into()));
        let twins = vec![Node::group("twin", vec![]), Node::group("twin", vec![])];
        let error = r.refusal(Edit::insert(Node::group("new", twins)));
        assert_eq!(error, SceneError::NameTaken("twin".into()));
        assert_eq!(
            r.refusal(Edit::RenameMaterial(r.grey, "white".into())),
            SceneError::MaterialNameTaken("white".into())
        );
        let add = Edit::AddMaterial { name: String::new(), material: matte(0.0), id: None };
        assert_eq!(r.refusal(add), SceneError::EmptyName);
    }

    #[test]
    fn a_name_may_be_set_again_or_be_that_of_a_material() {
        let r = Room::new();
        r.there_and_back(Edit::Name(r.ball, "ball".into()));
        r.there_and_back(Edit::Name(r.ball, "white".into()));
        r.there_and_back(Edit::RenameMaterial(r.grey, "grey".into()));
    }

    #[test]
    fn an_id_in_use_is_refused() {
        let r = Room::new();
        let same = Node::group("new", vec![Node::light("star", light(1.0)).with_id(r.ball)]);
        assert_eq!(r.refusal(Edit::insert(same)), SceneError::IdTaken(r.ball));
        let id = EntityId::from_index(70).unwrap();
        let twice = Node::group("new", vec![Node::group("inner", vec![]).with_id(id)]).with_id(id);
        assert_eq!(r.refusal(Edit::insert(twice)), SceneError::IdTaken(id));
        let add = Edit::AddMaterial { name: "new".into(), material: matte(0.0), id: Some(r.white) };
        assert_eq!(r.refusal(add), SceneError::MaterialIdTaken(r.white));
    }

    #[test]
    fn new_ids_stay_clear_of_chosen_ones() {
        let mut r = Room::new();
        let chosen = r.scene.next_entity_id();
        let members = vec![Node::group("chosen", vec![]).with_id(chosen)];
        r.scene.apply(Edit::insert(Node::group("new", members))).unwrap();
        assert_eq!(r.scene.entity_named("chosen"), Some(chosen));
        assert!(r.scene.entity_named("new") > Some(chosen));
    }

    #[test]
    fn a_scene_without_numbers_left_refuses_new_parts() {
        let mut r = Room::new();
        let last = Node::group("last", vec![]).with_id(EntityId::from_index(u32::MAX).unwrap());
        r.scene.apply(Edit::insert(last)).unwrap();
        assert_eq!(r.refusal(Edit::insert(Node::group("one more", vec![]))), SceneError::IdsExhausted);
        let id = MaterialId::from_index(u32::MAX);
        r.scene.apply(Edit::AddMaterial { name: "last".into(), material: matte(0.0), id }).unwrap();
        let more = Edit::AddMaterial { name: "one more".into(), material: matte(0.0), id: None };
        assert_eq!(r.refusal(more), SceneError::IdsExhausted);
    }

    #[test]
    fn what_is_not_there_is_named() {
        let mut r = Room::new();
        let gone = r.scene.add_group("gone", None).unwrap();
        let red = r.scene.add_material("red", matte(0.0)).unwrap();
        r.scene.apply(Edit::Remove(gone)).unwrap();
        r.scene.apply(Edit::RemoveMaterial(red)).unwrap();
        let new = || Node::light("new", light(1.0));
        for edit in [
            Edit::Remove(gone),
            Edit::Shape(gone, sphere(1.0)),
            Edit::Placement(gone, moved(0.0, 0.0, 0.0)),
            Edit::Parent(gone, None),
            Edit::Parent(r.ball, Some(gone)),
            Edit::Order(gone, 0),
            Edit::Name(gone, "back".into()),
            Edit::insert(Subtree::new(new()).under(gone)),
        ] {
            assert_eq!(r.refusal(edit), SceneError::UnknownEntity(gone));
        }
        for edit in [
            Edit::MaterialOf(r.ball, red),
            Edit::Material(red, matte(0.2)),
            Edit::RemoveMaterial(red),
            Edit::RenameMaterial(red, "back".into()),
            Edit::insert(Node::shape("new", sphere(1.0), red)),
        ] {
            assert_eq!(r.refusal(edit), SceneError::UnknownMaterial(red));
        }
        assert_eq!(SceneError::UnknownMaterial(red).to_string(), "there is no material 3 in this scene");
    }

    #[test]
    fn an_entity_cannot_get_what_its_role_has_not() {
        let r = Room::new();
        let error = r.refusal(Edit::Light(r.ball, light(1.0)));
        assert_eq!(error.to_string(), "\"ball\" is a shape, not a light");
        assert!(matches!(r.refusal(Edit::MaterialOf(r.lamp, r.white)), SceneError::WrongRole { .. }));
        assert!(matches!(r.refusal(Edit::Shape(r.things, sphere(1.0))), SceneError::WrongRole { .. }));
        assert!(matches!(r.refusal(Edit::Camera(r.floor, camera(1.0))), SceneError::WrongRole { .. }));
    }

    #[test]
    fn a_material_in_use_stays() {
        let r = Room::new();
        let error = r.refusal(Edit::RemoveMaterial(r.white));
        assert_eq!(error.to_string(), "the material \"white\" is in use by \"floor\" and 1 other shape");
    }

    #[test]
    fn groups_nest_as_far_as_stated_and_no_further() {
        let nested = |levels: usize| {
            let innermost = Node::group(format!("level {levels}"), vec![]);
            (0..levels).rev().fold(innermost, |node, i| Node::group(format!("level {i}"), vec![node]))
        };
        let r = Room::new();
        r.there_and_back(Edit::insert(nested(Scene::MAX_DEPTH)));
        let error = r.refusal(Edit::insert(nested(Scene::MAX_DEPTH + 1)));
        assert_eq!(error, SceneError::TooDeep(format!("level {}", Scene::MAX_DEPTH + 1)));
        let mut r = r;
        r.scene.apply(Edit::insert(nested(Scene::MAX_DEPTH))).unwrap();
        let top = r.scene.entity_named("level 0").unwrap();
        assert_eq!(r.refusal(Edit::Parent(top, Some(r.things))), SceneError::TooDeep("level 0".into()));
    }

    #[test]
    fn a_refused_batch_leaves_nothing_of_its_first_edits() {
        let r = Room::new();
        let error = r.refusal(Edit::Batch(vec![
            Edit::AddMaterial { name: "red".into(), material: matte(0.0), id: None },
            Edit::MaterialOf(r.ball, r.scene.next_material_id()),
            Edit::Remove(r.lamps),
            Edit::Parent(r.ball, None),
            Edit::Batch(vec![Edit::Name(r.ball, "lamp".into()), Edit::insert(Node::group("new", vec![]))]),
            Edit::Name(r.floor, "new".into()),
        ]));
        assert_eq!(error, SceneError::NameTaken("new".into()));
    }

    #[test]
    fn a_batch_is_one_revision_and_is_taken_back_whole() {
        let r = Room::new();
        let (material, group) = (r.scene.next_material_id(), r.scene.next_entity_id());
        let scene = r.there_and_back(Edit::Batch(vec![
            Edit::AddMaterial { name: "red".into(), material: matte(0.0), id: None },
            Edit::insert(Node::group("new", vec![])),
            Edit::Parent(r.ball, Some(group)),
            Edit::MaterialOf(r.ball, material),
        ]));
        assert_eq!(scene.material_name(scene.material_of(r.ball).unwrap()), "red");
        let revisions: Vec<_> = scene.changes_since(r.scene.revision()).iter().map(|c| c.revision).collect();
        assert_eq!(revisions, [scene.revision(); 4]);
        assert!(scene.revision() > r.scene.revision());
    }

    #[test]
    fn an_empty_batch_is_no_edit() {
        let mut r = Room::new();
        let before = r.scene.revision();
        r.scene.apply(Edit::Batch(vec![])).unwrap();
        assert_eq!(r.scene.revision(), before);
    }

    #[test]
    fn a_forgotten_part_of_the_log_leaves_the_rest() {
        let mut r = Room::new();
        let before = r.scene.revision();
        r.scene.apply(Edit::Order(r.eye, 0)).unwrap();
        let after = r.scene.revision();
        r.scene.forget_changes(before);
        assert_eq!(subjects(&r.scene, 0), [(Subject::Entity(r.eye), ChangeKind::Order)]);
        r.scene.forget_changes(u64::MAX);
        assert_eq!(r.scene.changes_since(0), []);
        assert_eq!(r.scene.revision(), after);
    }
}
