//! How is a scene made in the window? New things, more of what is there, groups, and what is set aside for a while.

pub(crate) mod add;
mod copying;
mod grouping;
mod place;
mod reordering;
pub(crate) mod sizing;
pub(crate) mod starters;
#[cfg(test)]
mod tests;

use catoptra_core::scene::{Edit, EntityId, Flags, MaterialId};

use crate::naming::Named;
use crate::viewer::{Viewer, Wanted};

pub(crate) use copying::{copy, duplicate, paste};
pub(crate) use grouping::ungroup;
pub(crate) use reordering::{Slot, put};

/// Makes a group of what is selected.
pub(crate) fn group(viewer: &mut Viewer) {
    if viewer.selection.is_empty() {
        return viewer.notify("select something first");
    }
    grouping::group(viewer, None);
}

/// Begins to choose what is to be added, at the point of the picture where the pointer is.
pub(crate) fn choose(viewer: &mut Viewer) {
    let (x, y) = viewer.pointer.at;
    let inside = x >= 0.0 && y >= 0.0 && x < f64::from(viewer.size.0) && y < f64::from(viewer.size.1);
    viewer.adding = Some(add::Adding { at: inside.then_some((x, y)), typed: String::new() });
}

/// Takes what is selected out of the scene, as one step to undo.
pub(crate) fn delete(viewer: &mut Viewer) {
    let selected = viewer.selection.tops(viewer.document.scene());
    if !selected.is_empty() {
        viewer.edit(Edit::Batch(selected.into_iter().map(Edit::Remove).collect()));
    }
}

/// Copies what is selected and takes it out.
pub(crate) fn cut(viewer: &mut Viewer) {
    if copy(viewer) {
        delete(viewer);
    }
}

/// Asks for what is on the clipboard, to be pasted.
pub(crate) fn ask_to_paste(viewer: &mut Viewer) {
    viewer.wanted = Some(Wanted::Paste);
}

/// Lets the name of the active thing be typed.
pub(crate) fn rename(viewer: &mut Viewer) {
    let Some(id) = viewer.selection.active() else { return viewer.notify("select something first") };
    let name = viewer.document.scene().name(id).unwrap_or_default();
    viewer.finish_name();
    viewer.typed_name = Some((Named::Entity(id), name));
    viewer.names_next = true;
    viewer.shown.panel = true;
}

/// Hides what is selected, or shows it where all of that is hidden already.
pub(crate) fn hide(viewer: &mut Viewer) {
    set_aside(viewer, |flags| flags.hidden, |flags, hidden| Flags { hidden, ..flags });
}

/// Locks what is selected, or unlocks it where all of that is locked already.
pub(crate) fn lock(viewer: &mut Viewer) {
    set_aside(viewer, |flags| flags.locked, |flags, locked| Flags { locked, ..flags });
}

fn set_aside(viewer: &mut Viewer, is_set: fn(Flags) -> bool, with: fn(Flags, bool) -> Flags) {
    let scene = viewer.document.scene();
    let selected = viewer.selection.tops(scene);
    if selected.is_empty() {
        return viewer.notify("select something first");
    }
    let all = selected.iter().all(|id| is_set(scene.flags(*id)));
    let edits = selected.iter().map(|id| Edit::Flags(*id, with(scene.flags(*id), !all)));
    let edits = edits.collect();
    viewer.edit(Edit::Batch(edits));
}

/// Shows all that is hidden, as one step to undo.
pub(crate) fn show_all(viewer: &mut Viewer) {
    let scene = viewer.document.scene();
    let hidden: Vec<EntityId> = scene.entities().filter(|id| scene.flags(*id).hidden).collect();
    if hidden.is_empty() {
        return viewer.notify("nothing is hidden");
    }
    let shown = |id: &EntityId| Edit::Flags(*id, Flags { hidden: false, ..scene.flags(*id) });
    let edits = hidden.iter().map(shown).collect();
    if viewer.edit(Edit::Batch(edits)) {
        viewer.select_all(hidden.into_iter().collect());
    }
}

/// Gives the selected shapes that share a material with others a copy of it for themselves, as one step to undo.
pub(crate) fn make_single(viewer: &mut Viewer, worn: MaterialId) {
    let scene = viewer.document.scene();
    let Some(material) = scene.find_material(worn).cloned() else { return };
    let wears = |id: &EntityId| scene.material_of(*id) == Some(worn);
    let shapes: Vec<EntityId> = viewer.selection.ids().iter().copied().filter(wears).collect();
    let id = scene.next_material_id();
    let name = scene.free_material_name(scene.material_name(worn));
    let mut edits = vec![Edit::AddMaterial { name, material, id: Some(id) }];
    edits.push(Edit::Finish(id, scene.finish(worn)));
    edits.extend(shapes.into_iter().map(|shape| Edit::MaterialOf(shape, id)));
    viewer.edit(Edit::Batch(edits));
}
