//! How is more made of what is there? Duplicates beside the originals, and text on the clipboard.

use std::collections::HashSet;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, EntityId, Node, Scene, Subtree};
use catoptra_core::{Aabb, Placement};
use catoptra_scene::fragment;

use super::place;
use crate::viewer::{Viewer, Wanted};

/// Duplicates what is selected, as one step to undo: beside the originals, to the right of them as one looks.
pub(crate) fn duplicate(viewer: &mut Viewer) {
    let scene = viewer.document.scene();
    let originals = viewer.selection.tops(scene);
    let by = aside(viewer, scene, &originals);
    let (mut taken, mut edits, mut copies) = (HashSet::new(), Vec::new(), Vec::new());
    let mut next = scene.next_entity_id();
    for &id in &originals {
        let Some(mut node) = scene.node(id) else { continue };
        node = scene.fresh(node, &mut taken);
        number(&mut node, &mut next);
        copies.extend(node.id);
        let group = scene.parent(id);
        node.placement = moved(scene, &node.placement, group, by);
        let index = scene.children(group).iter().position(|sibling| *sibling == id);
        let index = index.map(|index| index + 1 + edits.len());
        edits.push(Edit::Insert(Box::new(Subtree { node, parent: group, index })));
    }
    if edits.is_empty() {
        return viewer.notify("select something first");
    }
    let told = match copies.len() {
        1 => "duplicated".to_owned(),
        many => format!("{many} things were duplicated"),
    };
    if viewer.edit(Edit::Batch(edits)) {
        viewer.select_all(copies.into_iter().collect());
        viewer.notify(told);
    }
}

/// Gives a node and all that lies in it the ids from `next` on.
fn number(node: &mut Node, next: &mut EntityId) {
    node.each_mut(&mut |node| {
        node.id = Some(*next);
        if let Some(after) = EntityId::from_index(next.index() + 1) {
            *next = after;
        }
    });
}

/// How far copies in a scene are moved so that they stand beside the originals: along the axis that leads most to the right.
fn aside(viewer: &Viewer, scene: &Scene, ids: &[EntityId]) -> DVec3 {
    let bounds = ids.iter().filter_map(|id| scene.world_bounds(*id)).reduce(Aabb::union);
    let right = viewer.camera.right();
    let is_x = right.x.abs() >= right.z.abs();
    let axis = if is_x { DVec3::X * right.x.signum() } else { DVec3::Z * right.z.signum() };
    let wide = match bounds {
        Some(bounds) => 1.1 * bounds.size().dot(axis.abs()),
        None => place::spot(viewer, None).size,
    };
    let tidy = format!("{wide:.3}").parse().ok().filter(|tidy| *tidy > 0.0).unwrap_or(wide);
    axis * tidy
}

/// A placement in that group, moved in the world.
fn moved(scene: &Scene, own: &Placement, group: Option<EntityId>, by: DVec3) -> Placement {
    let outer = group.and_then(|group| scene.world_placement(group)).unwrap_or_default();
    let inner = outer.inverse();
    own.moved(inner.direction(by) * inner.scale()).unwrap_or(*own)
}

/// Puts what is selected on the clipboard, as scene text.
pub(crate) fn copy(viewer: &mut Viewer) -> bool {
    let ids = viewer.selection.tops(viewer.document.scene());
    if ids.is_empty() {
        viewer.notify("select something first");
        return false;
    }
    match fragment::text_of(viewer.document.scene(), &ids, &viewer.document.folder()) {
        Ok(text) => {
            viewer.wanted = Some(Wanted::Copy(text));
            viewer.notify(match ids.len() {
                1 => "copied, as scene text".to_owned(),
                many => format!("{many} things were copied, as scene text"),
            });
            true
        }
        Err(why) => {
            viewer.notify(why.to_string());
            false
        }
    }
}

/// Puts the things that a text tells of into the scene, as one step to undo; beside their originals, where these are there.
pub(crate) fn paste(viewer: &mut Viewer, text: &str) {
    if viewer.guard.question().is_some() {
        return;
    }
    viewer.finish_name();
    if text.trim().is_empty() {
        return viewer.notify("there is no text on the clipboard");
    }
    let pasted = match fragment::paste(viewer.document.scene(), text, &viewer.document.folder()) {
        Ok(pasted) => pasted,
        Err(why) => return viewer.notify(format!("nothing was pasted: {why}")),
    };
    let mut copy = viewer.document.scene().clone();
    if let Err(why) = copy.apply(pasted.edit.clone()) {
        return viewer.notify(why.to_string());
    }
    let mut edits = vec![pasted.edit];
    edits.extend(apart(viewer, &copy, &pasted.ids));
    if viewer.edit(Edit::Batch(edits)) {
        viewer.select_all(pasted.ids.iter().copied().collect());
        viewer.notify("pasted");
    }
}

/// The edits that set new things apart from others which stand in the same place.
fn apart(viewer: &Viewer, scene: &Scene, new: &[EntityId]) -> Vec<Edit> {
    let place = |id: EntityId| (scene.shape(id), scene.light(id), scene.world_placement(id));
    let others: Vec<EntityId> = viewer.document.scene().entities().collect();
    let stands_there = |id: EntityId| {
        let bounds = scene.world_bounds(id);
        others.iter().any(|other| match bounds {
            Some(bounds) => scene.world_bounds(*other) == Some(bounds),
            None => scene.role(*other) == scene.role(id) && place(*other) == place(id),
        })
    };
    if !new.iter().any(|id| stands_there(*id)) {
        return Vec::new();
    }
    let by = aside(viewer, scene, new);
    let moved = |id: &EntityId| Some(Edit::Placement(*id, scene.placement(*id)?.moved(by).ok()?));
    new.iter().filter_map(moved).collect()
}
