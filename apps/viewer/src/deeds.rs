//! What did a step do, in a few words? Told by what the scene says was changed when it is taken back or done again.

use std::collections::{HashMap, HashSet};

use catoptra_core::scene::{Change, ChangeKind, EntityId, Flags, Role, Scene, Subject};

/// Whether a step was taken back or done again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    Back,
    Again,
}

/// What must be known of a scene before a step to tell afterwards what the step did.
pub(crate) struct Before {
    entities: HashMap<EntityId, Known>,
    names: HashMap<Subject, String>,
    revision: u64,
}

struct Known {
    name: String,
    parent: Option<EntityId>,
    role: Role,
    flags: Flags,
}

/// What a step did.
pub(crate) struct Deed {
    /// In a few words.
    pub(crate) words: String,
    /// What it has brought into the scene, without what lies in that.
    pub(crate) brought: Vec<EntityId>,
}

impl Before {
    /// Of a scene as it is now.
    pub(crate) fn of(scene: &Scene) -> Self {
        let known = |id: EntityId| {
            let (name, parent, role) = (scene.name(id)?, scene.parent(id), scene.role(id)?);
            Some((id, Known { name, parent, role, flags: scene.flags(id) }))
        };
        let materials = scene.materials().map(|(id, name, _)| (Subject::Material(id), name.to_owned()));
        let textures = scene.textures().map(|(id, name, _)| (Subject::Texture(id), name.to_owned()));
        Self {
            entities: scene.entities().filter_map(known).collect(),
            names: materials.chain(textures).collect(),
            revision: scene.revision(),
        }
    }

    /// What the steps since then did.
    pub(crate) fn deed(&self, scene: &Scene, direction: Direction) -> Deed {
        let changes = scene.changes_since(self.revision);
        let is_member = |id: &EntityId, of: &HashSet<EntityId>, parent: Option<EntityId>| {
            of.contains(id) && !parent.is_some_and(|parent| of.contains(&parent))
        };
        let come = entities_with(changes, ChangeKind::Added);
        let gone = entities_with(changes, ChangeKind::Removed);
        let in_order = |set: &HashSet<EntityId>, parent: &dyn Fn(EntityId) -> Option<EntityId>| {
            let subjects = changes.iter().filter_map(entity);
            let mut seen = HashSet::new();
            let tops = subjects.filter(|id| is_member(id, set, parent(*id)) && seen.insert(*id));
            tops.collect::<Vec<_>>()
        };
        let brought = in_order(&come, &|id| scene.parent(id));
        let taken = in_order(&gone, &|id| self.entities.get(&id).and_then(|known| known.parent));
        let (made, deleted) = match direction {
            Direction::Back => (&taken, &brought),
            Direction::Again => (&brought, &taken),
        };
        let regrouped = entities_with(changes, ChangeKind::Parent);
        let words = match (made.as_slice(), deleted.as_slice()) {
            ([group], []) if !regrouped.is_empty() && self.is_group(scene, *group) => {
                format!("group {}", self.names_of(scene, regrouped.iter().copied()))
            }
            ([], [group]) if !regrouped.is_empty() => format!("ungroup {}", self.name(scene, *group)),
            ([], []) => self.change(scene, changes, direction),
            ([], deleted) => format!("delete {}", self.names_of(scene, deleted.iter().copied())),
            (made, []) => format!("add {}", self.names_of(scene, made.iter().copied())),
            (made, _) => format!("replace {}", self.names_of(scene, made.iter().copied())),
        };
        Deed { words, brought }
    }

    /// What was done to things that were there before and after.
    fn change(&self, scene: &Scene, changes: &[Change], direction: Direction) -> String {
        let Some(first) = changes.iter().min_by_key(|change| rank(change.what)) else {
            return "nothing".to_owned();
        };
        let alike = changes.iter().filter(|change| change.what == first.what);
        let mut seen = HashSet::new();
        let subjects: Vec<Subject> = alike.map(|c| c.subject).filter(|s| seen.insert(*s)).collect();
        let verb = match (first.what, first.subject) {
            (ChangeKind::Flags, Subject::Entity(id)) => self.flagged(scene, id, direction),
            (ChangeKind::Added, _) if direction == Direction::Back => "remove",
            (ChangeKind::Removed, _) if direction == Direction::Again => "remove",
            (what, _) => verb(what),
        };
        let names = subjects.iter().map(|subject| match subject {
            Subject::Entity(id) => self.name(scene, *id),
            Subject::Material(id) if scene.find_material(*id).is_some() => {
                format!("material {}", scene.material_name(*id))
            }
            Subject::Texture(id) if scene.find_texture(*id).is_some() => {
                format!("texture {}", scene.texture_name(*id).unwrap_or_default())
            }
            Subject::Settings => "settings".to_owned(),
            gone => self.names.get(gone).cloned().unwrap_or_default(),
        });
        format!("{verb} {}", list(&names.collect::<Vec<_>>()))
    }

    /// What was done with flags, before the step was taken back or by it.
    fn flagged(&self, scene: &Scene, id: EntityId, direction: Direction) -> &'static str {
        let (earlier, now) =
            (self.entities.get(&id).map(|known| known.flags).unwrap_or_default(), scene.flags(id));
        let (from, to) = match direction {
            Direction::Back => (now, earlier),
            Direction::Again => (earlier, now),
        };
        match () {
            () if to.hidden != from.hidden => {
                if to.hidden {
                    "hide"
                } else {
                    "show"
                }
            }
            () if to.locked => "lock",
            () => "unlock",
        }
    }

    fn is_group(&self, scene: &Scene, id: EntityId) -> bool {
        scene.role(id).or_else(|| Some(self.entities.get(&id)?.role)) == Some(Role::Group)
    }

    fn name(&self, scene: &Scene, id: EntityId) -> String {
        scene.name(id).or_else(|| Some(self.entities.get(&id)?.name.clone())).unwrap_or_default()
    }

    fn names_of(&self, scene: &Scene, ids: impl Iterator<Item = EntityId>) -> String {
        list(&ids.map(|id| self.name(scene, id)).collect::<Vec<_>>())
    }
}

fn entity(change: &Change) -> Option<EntityId> {
    match change.subject {
        Subject::Entity(id) => Some(id),
        _ => None,
    }
}

fn entities_with(changes: &[Change], what: ChangeKind) -> HashSet<EntityId> {
    changes.iter().filter(|change| change.what == what).filter_map(entity).collect()
}

/// One name, or the number of things.
fn list(names: &[String]) -> String {
    match names {
        [name] => name.clone(),
        names => format!("{} things", names.len()),
    }
}

/// Of several changes in one step the one with the lowest rank is told.
fn rank(what: ChangeKind) -> u8 {
    match what {
        ChangeKind::Parent => 0,
        ChangeKind::Placement => 1,
        ChangeKind::Name => 3,
        ChangeKind::Order => 4,
        _ => 2,
    }
}

fn verb(what: ChangeKind) -> &'static str {
    match what {
        ChangeKind::Added => "add",
        ChangeKind::Removed => "delete",
        ChangeKind::Placement => "move",
        ChangeKind::Material => "change the material of",
        ChangeKind::Parent => "regroup",
        ChangeKind::Order => "reorder",
        ChangeKind::Name => "rename",
        ChangeKind::Finish => "change the finish of",
        _ => "change",
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::glam::DVec3;
    use catoptra_core::scene::Edit;
    use catoptra_core::{Node, Placement};

    use super::*;
    use crate::document::Document;

    /// What is told of an edit when it is taken back, what that brings back, and what is told when it is done again.
    fn told(edit: impl FnOnce(&Scene) -> Edit) -> (String, Vec<String>, String) {
        let mut document = Document::welcome().unwrap();
        let edit = edit(document.scene());
        document.edit(edit).unwrap();
        let back = document.undo().unwrap();
        let names = back.brought.iter().filter_map(|id| document.scene().name(*id)).collect();
        (back.words, names, document.redo().unwrap().words)
    }

    fn id(scene: &Scene, name: &str) -> EntityId {
        scene.entity_named(name).unwrap()
    }

    #[test]
    fn steps_are_told_alike_back_and_again() {
        let both = |edit: &dyn Fn(&Scene) -> Edit| {
            let (back, _, again) = told(edit);
            assert_eq!(back, again);
            back
        };
        let moved = Placement::IDENTITY.moved(DVec3::X).unwrap();
        assert_eq!(both(&|s| Edit::Placement(id(s, "floor"), moved)), "move floor");
        assert_eq!(both(&|s| Edit::Remove(id(s, "floor"))), "delete floor");
        assert_eq!(both(&|_| Edit::insert(Node::group("new", Vec::new()))), "add new");
        assert_eq!(
            both(&|s| Edit::Flags(id(s, "floor"), Flags { hidden: true, locked: false })),
            "hide floor"
        );
        assert_eq!(
            both(&|s| Edit::Flags(id(s, "floor"), Flags { hidden: false, locked: true })),
            "lock floor"
        );
        assert_eq!(both(&|s| Edit::Settings(*s.settings())), "change settings");
        let all = |s: &Scene| s.children(None).into_iter().map(Edit::Remove).collect();
        assert!(both(&|s| Edit::Batch(all(s))).ends_with(" things"));
    }

    #[test]
    fn what_was_deleted_is_brought_back() {
        let (_, brought, _) = told(|scene| Edit::Remove(id(scene, "floor")));
        assert_eq!(brought, ["floor"]);
    }

    #[test]
    fn grouping_is_called_so() {
        let group = |scene: &Scene| {
            let new = scene.next_entity_id();
            let member = Edit::Parent(id(scene, "floor"), Some(new));
            Edit::Batch(vec![Edit::insert(Node::group("set", Vec::new())), member])
        };
        let (back, _, again) = told(group);
        assert_eq!((back.as_str(), again.as_str()), ("group floor", "group floor"));
    }
}
