//! How do things get another place in the tree: among their siblings, into a group and out of it? They stay where they stand
//! in the world.

use catoptra_core::scene::{Edit, EntityId, Scene};

use super::grouping::{in_order, kept_in_place};
use crate::viewer::Viewer;

/// A place in the tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Slot {
    /// Before that one, beside it.
    Before(EntityId),
    /// After that one, beside it.
    After(EntityId),
    /// The last in that group; the last at the top of the scene without one.
    In(Option<EntityId>),
}

impl Slot {
    /// The group that it lies in.
    fn group(self, scene: &Scene) -> Option<EntityId> {
        match self {
            Self::Before(sibling) | Self::After(sibling) => scene.parent(sibling),
            Self::In(group) => group,
        }
    }

    /// How many of those members of its group come before it that are not put there themselves.
    fn index(self, members: &[EntityId], put: &[EntityId]) -> usize {
        let end = match self {
            Self::Before(sibling) => members.iter().position(|id| *id == sibling),
            Self::After(sibling) => members.iter().position(|id| *id == sibling).map(|at| at + 1),
            Self::In(_) => None,
        };
        members[..end.unwrap_or(members.len())].iter().filter(|id| !put.contains(id)).count()
    }
}

/// Puts things there, in the order that they have in the tree, as one step to undo.
pub(crate) fn put(viewer: &mut Viewer, ids: &[EntityId], slot: Slot) {
    let scene = viewer.document.scene();
    let group = slot.group(scene);
    if let Some(group) = group
        && ids.iter().any(|id| scene.lies_in(group, *id))
    {
        return viewer.notify("a group cannot lie in itself");
    }
    let (put, members) = (in_order(scene, ids), scene.children(group));
    let index = slot.index(&members, &put);
    let mut after: Vec<EntityId> = members.iter().copied().filter(|id| !put.contains(id)).collect();
    after.splice(index..index, put.iter().copied());
    if after == members {
        return;
    }
    let at = group.and_then(|group| scene.world_placement(group)).unwrap_or_default();
    let mut edits = Vec::new();
    // All to the end first: then each has one place to go to, whichever way it came.
    for &id in &put {
        if scene.parent(id) == group {
            edits.push(Edit::Order(id, usize::MAX));
        } else {
            edits.push(Edit::Parent(id, group));
            edits.extend(kept_in_place(scene, id, &at));
        }
    }
    edits.extend(put.iter().enumerate().map(|(number, id)| Edit::Order(*id, index + number)));
    viewer.edit(Edit::Batch(edits));
}

#[cfg(test)]
mod tests {
    use catoptra_core::Aabb;
    use catoptra_tracer::Pool;

    use super::*;
    use crate::document::Document;
    use crate::loader::Opened;

    const TEXT: &str = "matte \"m\" { color 0.5 } // shared\n\
        sphere \"a\" material=\"m\" { radius 1 } // first\n\
        group \"g\" {\n    move 1 0 0\n    turn 30 0 1 0\n    sphere \"b\" material=\"m\" { center 0 1 0; radius 1 }\n    \
        sphere \"c\" material=\"m\" { center 2 0 0; radius 1 }\n}\n\
        group \"h\" { scale 2; sphere \"d\" material=\"m\" { radius 1 } }\n";

    fn bench(folder: &tempfile::TempDir) -> Viewer {
        let path = folder.path().join("room.kdl");
        std::fs::write(&path, TEXT).unwrap();
        Viewer::new(Opened::new(Document::open(&path).unwrap(), &Pool::new(1).unwrap()))
    }

    fn id(viewer: &Viewer, name: &str) -> EntityId {
        viewer.document.scene().entity_named(name).unwrap()
    }

    /// The names in a scene, those of members in brackets.
    fn tree(scene: &Scene, group: Option<EntityId>) -> String {
        let name = |id: EntityId| {
            let members = tree(scene, Some(id));
            let name = scene.name(id).unwrap_or_default();
            if members.is_empty() { name } else { format!("{name}({members})") }
        };
        scene.children(group).into_iter().map(name).collect::<Vec<_>>().join(" ")
    }

    fn places(viewer: &Viewer) -> Vec<Aabb> {
        let scene = viewer.document.scene();
        ["a", "b", "c", "d"].map(|name| scene.world_bounds(id(viewer, name)).unwrap()).to_vec()
    }

    /// What the tree is after things were put somewhere: in the scene, in its text, and taken back in one step.
    fn after(names: &[&str], slot: impl Fn(&Viewer) -> Slot) -> String {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = bench(&folder);
        let (before, ids) = (places(&viewer), names.iter().map(|name| id(&viewer, name)).collect::<Vec<_>>());
        let slot = slot(&viewer);
        put(&mut viewer, &ids, slot);
        let now = tree(viewer.document.scene(), None);
        for (was, is) in before.iter().zip(places(&viewer)) {
            assert!(
                was.min.distance(is.min) + was.max.distance(is.max) < 1e-9,
                "{names:?} stay in the world"
            );
        }
        let (again, _) = catoptra_scene::parse(&viewer.document.text(), "text", None).unwrap();
        assert_eq!(tree(&again, None), now);
        assert!(viewer.document.undo().is_some() && viewer.document.is_saved(), "it was one step");
        let path = viewer.document.save().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), TEXT);
        now
    }

    #[test]
    fn things_go_among_their_siblings() {
        assert_eq!(after(&["a"], |v| Slot::After(id(v, "g"))), "g(b c) a h(d)");
        assert_eq!(after(&["h"], |v| Slot::Before(id(v, "a"))), "h(d) a g(b c)");
        assert_eq!(after(&["c"], |v| Slot::Before(id(v, "b"))), "a g(c b) h(d)");
        assert_eq!(after(&["a", "h"], |v| Slot::After(id(v, "g"))), "g(b c) a h(d)");
        assert_eq!(after(&["h", "a"], |_| Slot::In(None)), "g(b c) a h(d)");
    }

    #[test]
    fn things_go_into_groups_and_out_of_them() {
        assert_eq!(after(&["a"], |v| Slot::In(Some(id(v, "g")))), "g(b c a) h(d)");
        assert_eq!(after(&["a", "d"], |v| Slot::Before(id(v, "c"))), "g(b a d c) h");
        assert_eq!(after(&["b"], |v| Slot::Before(id(v, "a"))), "b a g(c) h(d)");
        assert_eq!(after(&["g"], |v| Slot::In(Some(id(v, "h")))), "a h(d g(b c))");
        assert_eq!(after(&["c"], |_| Slot::In(None)), "a g(b) h(d) c");
    }

    #[test]
    fn what_changes_nothing_is_no_step_and_no_group_lies_in_itself() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = bench(&folder);
        for (name, slot) in [("a", Slot::Before(id(&viewer, "g"))), ("c", Slot::After(id(&viewer, "b")))] {
            let thing = id(&viewer, name);
            put(&mut viewer, &[thing], slot);
        }
        let group = id(&viewer, "g");
        for slot in [Slot::In(Some(group)), Slot::Before(id(&viewer, "b"))] {
            put(&mut viewer, &[group], slot);
            assert!(viewer.notice.take().is_some());
        }
        assert!(viewer.document.is_saved() && viewer.document.undo().is_none());
    }
}
