//! What is to be seen when a thing, or everything, is framed? Shapes and lamps by their bounds, lights and cameras by where
//! they stand.

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{EntityId, Role, Scene};
use catoptra_core::{Aabb, Light};

use crate::viewer::Viewer;

/// The room round what is but a point, as a share of the size of the scene.
const ROOM: f64 = 0.1;

/// That room in metres, where the scene has no size.
const ROOM_ALONE: f64 = 1.0;

/// Moves the camera so that everything is seen, lights too.
pub(crate) fn frame_all(viewer: &mut Viewer) {
    let everything = everything(viewer.document.scene(), viewer.everything());
    if everything.is_empty() {
        viewer.notify("nothing here has an end: back to the scene's camera");
        viewer.adopt(viewer.document.scene().main_camera());
    } else {
        viewer.frame(everything);
    }
}

/// Moves the camera so that what is selected is seen.
pub(crate) fn frame_selected(viewer: &mut Viewer) {
    if viewer.selection.is_empty() {
        return viewer.notify("select something first, then F shows it");
    }
    let (scene, shapes) = (viewer.document.scene(), viewer.everything());
    let selected = viewer.selection.ids().iter().filter_map(|id| bounds(scene, *id, room(shapes)));
    match selected.reduce(Aabb::union) {
        Some(bounds) => viewer.frame(bounds),
        None => viewer.notify("that is everywhere, so it cannot be shown as a whole"),
    }
}

/// The box round all shapes that have ends, `shapes`, and round all lights that stand somewhere.
fn everything(scene: &Scene, shapes: Aabb) -> Aabb {
    let lights = scene.entities_of(Role::Light).filter(|id| !scene.is_hidden(*id));
    let bounds = lights.filter_map(|id| scene.world_bounds(id).or_else(|| point(place(scene, id)?)));
    let all = bounds.fold(shapes, Aabb::union);
    if all.size().length() > 0.0 { all } else { padded(all, ROOM_ALONE) }
}

/// The box round a thing, or round the members of a group; with `room` round what is but a point.
fn bounds(scene: &Scene, id: EntityId, room: f64) -> Option<Aabb> {
    if scene.role(id) == Some(Role::Group) {
        let members = scene.children(Some(id)).into_iter().filter_map(|member| bounds(scene, member, room));
        return members.reduce(Aabb::union);
    }
    scene.world_bounds(id).or_else(|| Some(padded(point(place(scene, id)?)?, room)))
}

/// Where a light or a camera stands; `None` for what is everywhere.
fn place(scene: &Scene, id: EntityId) -> Option<DVec3> {
    let light = scene.world_light(id).as_ref().and_then(Light::position);
    light.or_else(|| scene.world_camera(id).map(|camera| camera.eye()))
}

fn point(at: DVec3) -> Option<Aabb> {
    at.is_finite().then_some(Aabb { min: at, max: at })
}

fn padded(bounds: Aabb, by: f64) -> Aabb {
    if bounds.is_empty() { bounds } else { Aabb { min: bounds.min - by, max: bounds.max + by } }
}

/// Metres round what is but a point.
fn room(shapes: Aabb) -> f64 {
    let size = if shapes.is_empty() { 0.0 } else { shapes.size().length() };
    if size > 0.0 { ROOM * size } else { ROOM_ALONE }
}

#[cfg(test)]
mod tests {
    use catoptra_raster::Projection;
    use catoptra_tracer::Pool;

    use super::*;
    use crate::document::Document;
    use crate::loader::Opened;

    const TEXT: &str = "camera \"main\" { eye 0 1 9; target 0 0 0; fov 40 }\nmatte \"m\" { color 0.5 }\n\
        sphere \"ball\" material=\"m\" { radius 1 }\nambient-light \"sky\" { radiance 1 }\n\
        group \"g\" { move 0 20 0; point-light \"bulb\" { position 5 0 0; intensity 3 } }\n";

    fn viewer(folder: &std::path::Path, text: &str) -> Viewer {
        let path = folder.join("s.kdl");
        std::fs::write(&path, text).unwrap();
        let mut viewer = Viewer::new(Opened::new(Document::open(&path).unwrap(), &Pool::new(1).unwrap()));
        viewer.size = (640, 360);
        viewer
    }

    fn is_seen(viewer: &Viewer, point: DVec3) -> bool {
        let seen = Projection::new(&viewer.camera, 640, 360).project(point);
        seen.is_some_and(|at| (0.0..640.0).contains(&at.x) && (0.0..360.0).contains(&at.y))
    }

    #[test]
    fn all_shows_lights_too() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = viewer(folder.path(), TEXT);
        let (ball, bulb) = (DVec3::ZERO, DVec3::new(5.0, 20.0, 0.0));
        assert!(is_seen(&viewer, ball) && !is_seen(&viewer, bulb));
        frame_all(&mut viewer);
        assert!(is_seen(&viewer, ball) && is_seen(&viewer, bulb));
    }

    #[test]
    fn a_light_or_its_group_is_framed_from_near_by() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["bulb", "g"] {
            let mut viewer = viewer(folder.path(), TEXT);
            viewer.select(viewer.document.scene().entity_named(name));
            frame_selected(&mut viewer);
            let bulb = DVec3::new(5.0, 20.0, 0.0);
            assert!(is_seen(&viewer, bulb), "{name}");
            let distance = viewer.camera.eye().distance(bulb);
            assert!((0.2..5.0).contains(&distance), "{name} from {distance}");
        }
    }

    #[test]
    fn what_is_everywhere_is_told_and_a_light_alone_has_room() {
        let folder = tempfile::tempdir().unwrap();
        let mut everywhere = viewer(folder.path(), TEXT);
        everywhere.select(everywhere.document.scene().entity_named("sky"));
        let before = everywhere.camera.clone();
        frame_selected(&mut everywhere);
        assert!(everywhere.notice.is_some() && everywhere.camera == before);
        let mut alone = viewer(folder.path(), "point-light \"bulb\" { position 5 0 0; intensity 3 }\n");
        frame_all(&mut alone);
        assert!(is_seen(&alone, DVec3::new(5.0, 0.0, 0.0)));
        assert!(alone.camera.eye().distance(DVec3::new(5.0, 0.0, 0.0)) > 1.0);
    }
}
