//! About which point, and along which axes, are things moved, turned and scaled?

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::{EntityId, Scene};
use catoptra_raster::{Manipulator, Tool};

use crate::viewer::Viewer;

/// The handles of what is selected; `None` where nothing is.
pub(crate) fn manipulator(viewer: &Viewer, tool: Tool) -> Option<Manipulator> {
    let scene = viewer.document.scene();
    let places: Vec<DVec3> =
        viewer.selection.tops(scene).iter().filter_map(|id| place_of(scene, *id)).collect();
    let bounds = places.iter().fold(Aabb::EMPTY, |all, at| all.union(Aabb { min: *at, max: *at }));
    let axes = axes(viewer)[usize::from(viewer.settings.local_axes)];
    (!bounds.is_empty()).then(|| Manipulator { tool, pivot: bounds.centre(), axes })
}

/// The axes of the world, and those of the active thing.
pub(super) fn axes(viewer: &Viewer) -> [[DVec3; 3]; 2] {
    let active = viewer.selection.active().and_then(|id| viewer.document.scene().world_placement(id));
    let own = active.map_or(Manipulator::WORLD, |at| Manipulator::WORLD.map(|axis| at.direction(axis)));
    [Manipulator::WORLD, own]
}

/// Where a thing is taken to stand in the world: at its middle, if it has one.
pub(super) fn place_of(scene: &Scene, id: EntityId) -> Option<DVec3> {
    let light = scene.world_light(id).and_then(|light| light.position());
    let camera = scene.world_camera(id).map(|camera| camera.eye());
    light
        .or(camera)
        .or_else(|| scene.world_bounds(id).map(|bounds| bounds.centre()))
        .or_else(|| middle_of_members(scene, id))
        .or_else(|| scene.world_placement(id).map(|at| at.translation()))
}

/// The middle of the places of a group's members.
fn middle_of_members(scene: &Scene, id: EntityId) -> Option<DVec3> {
    let members = scene.children(Some(id));
    let places: Vec<DVec3> = members.into_iter().filter_map(|member| place_of(scene, member)).collect();
    (!places.is_empty()).then(|| places.iter().sum::<DVec3>() / places.len() as f64)
}
