//! How do things become members of a group, and how do they leave it? They stay where they stand in the world.

use catoptra_core::scene::{Edit, EntityId, Node, Role, Scene, Subtree};
use catoptra_core::{Operation, Placement};

use crate::viewer::Viewer;

/// Makes a group of what is selected, or a solid where an operation is given, as one step to undo: in the place of the
/// active thing.
pub(crate) fn group(viewer: &mut Viewer, solid: Option<Operation>) {
    let scene = viewer.document.scene();
    let members = viewer.selection.tops(scene);
    let word = solid.map_or("group", Operation::word);
    let parent = members.last().and_then(|id| scene.parent(*id)).filter(|id| !members.contains(id));
    let (id, name) = (scene.next_entity_id(), scene.free_name(word));
    let node = match solid {
        Some(operation) => Node::solid(name, operation, Vec::new()),
        None => Node::group(name, Vec::new()),
    };
    let index = members.last().and_then(|id| place_of(scene, *id));
    let mut edits = vec![Edit::Insert(Box::new(Subtree { node: node.with_id(id), parent, index }))];
    let at = parent.and_then(|parent| scene.world_placement(parent)).unwrap_or_default();
    for member in in_order(scene, &members) {
        edits.push(Edit::Parent(member, Some(id)));
        edits.extend(kept_in_place(scene, member, &at));
    }
    if viewer.edit(Edit::Batch(edits)) {
        viewer.select(Some(id));
    }
}

/// Takes the members of the selected groups out and removes these, as one step to undo.
pub(crate) fn ungroup(viewer: &mut Viewer) {
    let scene = viewer.document.scene();
    let is_group = |id: &EntityId| scene.role(*id) == Some(Role::Group);
    let groups: Vec<EntityId> = viewer.selection.tops(scene).into_iter().filter(is_group).collect();
    if groups.is_empty() {
        return viewer.notify("select a group first");
    }
    let (mut edits, mut freed) = (Vec::new(), Vec::new());
    for &group in &groups {
        let outer = scene.parent(group);
        let at = outer.and_then(|outer| scene.world_placement(outer)).unwrap_or_default();
        let index = place_of(scene, group).unwrap_or(0);
        for (number, member) in scene.children(Some(group)).into_iter().enumerate() {
            edits.push(Edit::Parent(member, outer));
            edits.push(Edit::Order(member, index + 1 + number));
            edits.extend(kept_in_place(scene, member, &at));
            freed.push(member);
        }
        edits.push(Edit::Remove(group));
    }
    if viewer.edit(Edit::Batch(edits)) {
        viewer.select_all(freed.into_iter().collect());
    }
}

/// The edit that lets a thing stand where it stands, in a group of that placement in the world.
pub(super) fn kept_in_place(scene: &Scene, id: EntityId, group: &Placement) -> Option<Edit> {
    let now = scene.parent(id).and_then(|parent| scene.world_placement(parent)).unwrap_or_default();
    let own = scene.placement(id)?;
    (now != *group).then(|| Edit::Placement(id, own.then(&now).then(&group.inverse())))
}

/// The place of a thing among its siblings.
fn place_of(scene: &Scene, id: EntityId) -> Option<usize> {
    scene.children(scene.parent(id)).iter().position(|sibling| *sibling == id)
}

/// In the order of the tree.
pub(super) fn in_order(scene: &Scene, ids: &[EntityId]) -> Vec<EntityId> {
    scene.walk().into_iter().filter(|id| ids.contains(id)).collect()
}
