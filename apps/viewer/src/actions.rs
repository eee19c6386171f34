//! What does each command and each gesture do to the viewer?

use std::path::Path;

use catoptra_core::scene::{Edit, EntityId, Role};
use catoptra_raster::Grip;

use crate::browse::Purpose;
use crate::camera_control::{self, NOTCH, ORBIT_PER_PIXEL};
use crate::deeds::Deed;
use crate::framing;
use crate::guard::Next;
use crate::input::{Drag, Gesture, Mode};
use crate::keys::Command;
use crate::making;
use crate::selection::Picking;
use crate::tracing::Frame;
use crate::viewer::Viewer;
use crate::views;

/// How far a turntable drag turns the objects, in degrees per pixel.
const TURN_PER_PIXEL: f64 = 0.3;

/// The share of the distance to the target that an arrow key moves the camera.
const STEP: f64 = 0.05;

/// The target is pushed ahead when the camera comes nearer than this share of the scene's size.
const NEAREST: f64 = 0.02;

/// The share by which a drag that zooms comes nearer, per pixel upwards.
const ZOOM_PER_PIXEL: f64 = 0.005;

/// The step keys of drags; panels use keys with this bit clear.
const DRAG_KEY: u64 = 1 << 63;

/// Does what a key asks for.
pub(crate) fn run(viewer: &mut Viewer, command: Command) {
    viewer.stale.panel = true;
    match command {
        Command::Quit => viewer.leave(Next::Close),
        Command::Help => viewer.shown.help = !viewer.shown.help,
        Command::Panel => viewer.shown.panel = !viewer.shown.panel,
        Command::FrameAll => framing::frame_all(viewer),
        Command::FrameSelected => framing::frame_selected(viewer),
        Command::ResetCamera => viewer.adopt(viewer.through.or(viewer.document.scene().main_camera())),
        Command::NextCamera => next_camera(viewer),
        Command::Look(side) => viewer.look(views::from_side(&viewer.camera, side)),
        Command::OtherProjection => viewer.look(views::other_projection(&viewer.camera)),
        Command::Step(right, up) => {
            let camera = camera_control::step(&viewer.camera, f64::from(right) * STEP, f64::from(up) * STEP);
            viewer.look(camera);
        }
        Command::ToggleMode => {
            viewer.settings.mode = viewer.settings.mode.other();
            viewer.notify(format!(
                "{}: drag to {}",
                viewer.settings.mode.name(),
                dragging(viewer.settings.mode)
            ));
        }
        Command::ToggleOverlays => {
            viewer.shown.overlays = !viewer.shown.overlays;
            viewer.stale.overlay = true;
        }
        Command::Escape => escape(viewer),
        Command::Delete => making::delete(viewer),
        Command::Add => making::choose(viewer),
        Command::Duplicate => making::duplicate(viewer),
        Command::Cut => making::cut(viewer),
        Command::Copy => {
            making::copy(viewer);
        }
        Command::Paste => making::ask_to_paste(viewer),
        Command::Rename => making::rename(viewer),
        Command::Group => making::group(viewer),
        Command::Ungroup => making::ungroup(viewer),
        Command::Hide => making::hide(viewer),
        Command::ShowAll => making::show_all(viewer),
        Command::Lock => making::lock(viewer),
        Command::SelectAll => {
            let all = viewer.document.scene().children(None);
            viewer.select_all(all.into_iter().collect());
        }
        Command::Undo => undo(viewer),
        Command::Redo => redo(viewer),
        Command::Save => viewer.save(),
        Command::SaveAs => viewer.save_elsewhere(None),
        Command::New => viewer.leave(Next::New),
        Command::Open => open(viewer),
        Command::Reload => reload(viewer),
        Command::Picture => viewer.picture_wanted = true,
    }
}

fn dragging(mode: Mode) -> &'static str {
    match mode {
        Mode::Orbit => "move the camera round",
        Mode::Turntable => "turn the objects about the origin",
    }
}

fn next_camera(viewer: &mut Viewer) {
    let cameras: Vec<EntityId> = viewer.document.scene().entities_of(Role::Camera).collect();
    let now = viewer.through.and_then(|id| cameras.iter().position(|c| *c == id));
    let Some(next) = cameras.get(now.map_or(0, |i| (i + 1) % cameras.len())).copied() else {
        return viewer.notify("the scene has no camera");
    };
    viewer.adopt(Some(next));
    let name = viewer.document.scene().name(next).unwrap_or_default();
    viewer.notify(format!("camera {name}"));
}

fn escape(viewer: &mut Viewer) {
    match () {
        () if viewer.error.take().is_some() || viewer.failure.take().is_some() => {}
        () if viewer.shown.help => viewer.shown.help = false,
        () => viewer.select(None),
    }
}

fn open(viewer: &mut Viewer) {
    viewer.finish_name();
    let folder = viewer.document.folder();
    viewer.browse(Purpose::Open, &folder, String::new());
}

fn reload(viewer: &mut Viewer) {
    match viewer.error.as_ref().map(|broken| broken.source.clone()) {
        Some(broken) => viewer.leave(broken),
        None => match viewer.document.source().map(Path::to_owned) {
            Some(file) => viewer.leave(Next::Open(file)),
            None => viewer.notify("this scene has no file to be read again"),
        },
    }
}

fn undo(viewer: &mut Viewer) {
    let deed = viewer.document.undo();
    tell(viewer, deed, "undo");
}

fn redo(viewer: &mut Viewer) {
    let deed = viewer.document.redo();
    tell(viewer, deed, "redo");
}

/// Tells what a step did, and selects what came with it.
fn tell(viewer: &mut Viewer, deed: Option<Deed>, way: &str) {
    let Some(deed) = deed else { return viewer.notify(format!("nothing to {way}")) };
    if !deed.brought.is_empty() {
        viewer.select_all(deed.brought.into_iter().collect());
    }
    viewer.notify(format!("{way}: {}", deed.words));
}

/// Writes the picture as it was traced, without overlays, under a free name in the current folder.
pub(crate) fn write_picture(viewer: &mut Viewer, frame: &Frame) {
    viewer.picture_wanted = false;
    let path = crate::document::free_name(Path::new(""), &viewer.document.name(), "png");
    let rgb: Vec<u8> =
        frame.pixels.data.iter().flat_map(|p| [(p >> 16) as u8, (p >> 8) as u8, *p as u8]).collect();
    let written = catoptra_scene::image::write_png(&path, frame.pixels.width, frame.pixels.height, &rgb);
    match written {
        Ok(()) => viewer.notify(format!("wrote {}", path.display())),
        Err(problem) => viewer.notify(format!("{} was not written: {problem}", path.display())),
    }
}

/// Does what the pointer asks for.
pub(crate) fn gesture(viewer: &mut Viewer, gesture: Gesture) {
    match gesture {
        Gesture::None => {}
        Gesture::Click { at: (x, y), picking } => click(viewer, (x, y), picking),
        Gesture::Dragged { drag, by, to } => drag_by(viewer, drag, by, to),
        Gesture::Ended(_) => {
            viewer.document.end_step();
            viewer.stale.panel = true;
        }
    }
}

fn click(viewer: &mut Viewer, (x, y): (f64, f64), picking: Picking) {
    let mark = viewer.overlay(&viewer.camera).mark_at(x, y);
    let found = mark.or_else(|| viewer.pick(x, y).map(|hit| hit.entity));
    let found = found.filter(|id| !viewer.document.scene().is_locked(*id));
    viewer.click_on(found, picking);
}

fn drag_by(viewer: &mut Viewer, drag: Drag, by: (f64, f64), to: (f64, f64)) {
    match drag {
        Drag::Orbit => {
            let (yaw, pitch) = (-by.0 * ORBIT_PER_PIXEL, by.1 * ORBIT_PER_PIXEL);
            let (before, orbit) = (&viewer.camera, camera_control::orbit);
            let after = orbit(before, yaw, pitch);
            let level = || orbit(before, yaw, 0.0);
            viewer.look(views::above_floors(viewer.document.scene(), before, after, level));
        }
        Drag::Zoom => {
            let factor = (-by.1 * ZOOM_PER_PIXEL).exp();
            let target =
                viewer.camera.eye() + viewer.camera.forward() * camera_control::focus(&viewer.camera);
            viewer.look(camera_control::zoom_to(&viewer.camera, target, factor.recip()));
        }
        Drag::Pan => viewer.look(camera_control::pan(&viewer.camera, by, f64::from(viewer.size.1))),
        Drag::Turn => turn_objects(viewer, by),
        Drag::Handle(grip) => drag_handle(viewer, grip, to),
    }
}

/// Turns all objects about the origin: shapes and groups with shapes at the top of the scene. Lights and cameras
/// stay, those in such a group excepted.
fn turn_objects(viewer: &mut Viewer, by: (f64, f64)) {
    let (about_y, about_x) = ((by.0 * TURN_PER_PIXEL).to_radians(), (by.1 * TURN_PER_PIXEL).to_radians());
    let scene = viewer.document.scene();
    let turned =
        |id: EntityId| Some(Edit::Placement(id, scene.placement(id)?.seed_turned(about_y, about_x).ok()?));
    let objects = scene.children(None).into_iter().filter(|id| is_object(viewer, *id));
    let edits: Vec<Edit> = objects.filter_map(turned).collect();
    viewer.edit_on(Edit::Batch(edits), DRAG_KEY);
}

fn is_object(viewer: &Viewer, id: EntityId) -> bool {
    let scene = viewer.document.scene();
    match scene.role(id) {
        Some(Role::Shape) => true,
        Some(Role::Group) => scene.children(Some(id)).into_iter().any(|member| is_object(viewer, member)),
        _ => false,
    }
}

fn drag_handle(viewer: &mut Viewer, grip: Grip, to: (f64, f64)) {
    let Some(light) = viewer.overlay(&viewer.camera).drag(grip, to.0, to.1) else { return };
    match light {
        Ok(light) => viewer.edit_on(Edit::Light(grip.light, light), DRAG_KEY | u64::from(grip.light.index())),
        Err(refusal) => viewer.notify(refusal.to_string()),
    }
    if !viewer.selection.contains(grip.light) {
        viewer.select(Some(grip.light));
    }
}

/// The wheel was turned by that many notches, away from the person counted positive.
pub(crate) fn wheel(viewer: &mut Viewer, notches: f64, ctrl: bool) {
    let to_pointer = (viewer.settings.mode == Mode::Orbit) != ctrl;
    let focus = camera_control::focus(&viewer.camera);
    let camera = if to_pointer {
        let (x, y) = viewer.pointer.at;
        let hit = viewer.pick(x, y).map(|hit| hit.point);
        let ray = viewer.camera.ray(x, y, viewer.size.0.max(1), viewer.size.1.max(1));
        let point = hit.unwrap_or_else(|| ray.at(focus));
        camera_control::zoom_to(&viewer.camera, point, (1.0 - NOTCH).powf(notches))
    } else {
        let nearest = NEAREST * viewer.everything().size().length().max(0.1);
        camera_control::dolly(&viewer.camera, notches * NOTCH * focus.max(nearest), nearest)
    };
    viewer.look(camera);
}

#[cfg(test)]
mod tests {
    use catoptra_core::glam::DVec3;
    use catoptra_tracer::Pool;

    use super::*;
    use crate::loader;

    fn viewer() -> Viewer {
        let mut viewer = Viewer::new(loader::welcome(&Pool::new(1).unwrap()).unwrap());
        viewer.size = (640, 360);
        viewer
    }

    fn placements(viewer: &Viewer) -> Vec<DVec3> {
        let scene = viewer.document.scene();
        scene.entities().filter_map(|id| scene.placement(id)).map(|p| p.point(DVec3::X)).collect()
    }

    #[test]
    fn a_turntable_drag_turns_objects_by_three_tenths_of_a_degree_a_pixel_as_one_step() {
        let mut viewer = viewer();
        let before = placements(&viewer);
        for _ in 0..10 {
            gesture(&mut viewer, Gesture::Dragged { drag: Drag::Turn, by: (10.0, 0.0), to: (0.0, 0.0) });
        }
        gesture(&mut viewer, Gesture::Ended(Drag::Turn));
        let scene = viewer.document.scene();
        let floor = scene.entity_named("floor").unwrap();
        let turned = scene.placement(floor).unwrap().direction(DVec3::X);
        let angle = 30_f64.to_radians();
        assert!((turned - DVec3::new(angle.cos(), 0.0, -angle.sin())).length() < 1e-12, "{turned}");
        run(&mut viewer, Command::Undo);
        assert_eq!(placements(&viewer), before);
        assert!(viewer.document.is_saved());
    }

    #[test]
    fn the_turntable_leaves_lights_and_cameras_alone() {
        let mut viewer = viewer();
        gesture(&mut viewer, Gesture::Dragged { drag: Drag::Turn, by: (40.0, 9.0), to: (0.0, 0.0) });
        let scene = viewer.document.scene();
        let others = scene.children(None).into_iter().filter(|id| !is_object(&viewer, *id));
        let moved =
            others.filter(|id| scene.placement(*id) != Some(catoptra_core::Placement::IDENTITY)).count();
        assert_eq!(moved, 0);
    }

    #[test]
    fn a_dragged_ring_changes_the_angle_as_one_step() {
        let mut viewer = viewer();
        viewer.settings.style.cones = true;
        let overlay = viewer.overlay(&viewer.camera);
        let spots = (0..360).flat_map(|y| (0..640).map(move |x| (f64::from(x), f64::from(y))));
        let (grip, at) = spots.filter_map(|(x, y)| Some((overlay.grip_at(x, y)?, (x, y)))).next().unwrap();
        let light = |viewer: &Viewer| viewer.document.scene().light(grip.light).unwrap();
        let before = light(&viewer);
        for step in 1..10 {
            let to = (at.0 + f64::from(step), at.1 + f64::from(step));
            gesture(&mut viewer, Gesture::Dragged { drag: Drag::Handle(grip), by: (1.0, 1.0), to });
        }
        gesture(&mut viewer, Gesture::Ended(Drag::Handle(grip)));
        assert!(light(&viewer) != before);
        assert_eq!(viewer.selection.ids(), [grip.light]);
        run(&mut viewer, Command::Undo);
        assert_eq!(light(&viewer), before);
    }

    /// A viewer of a panel of light in a turned and scaled group, over a floor.
    fn lamp_viewer(folder: &Path) -> (Viewer, EntityId) {
        let path = folder.join("lamp.kdl");
        let text = "camera \"c\" { eye 0 2 8; target 0 2 0 }\n\
            matte \"grey\" { color 0.5 }\nplane \"floor\" material=\"grey\"\n\
            group \"g\" { turn 20 1 0.3 0; scale 1.5; move 0 1 0\n\
                rectangle-light \"lamp\" { corner -1 0 0; edge-u 2 0 0; edge-v 0 1 0; radiance 3 } }\n";
        std::fs::write(&path, text).unwrap();
        let document = crate::document::Document::open(&path).unwrap();
        let mut viewer = Viewer::new(loader::Opened::new(document, &Pool::new(1).unwrap()));
        viewer.size = (640, 360);
        let lamp = viewer.document.scene().entity_named("lamp").unwrap();
        (viewer, lamp)
    }

    #[test]
    fn a_lamp_is_selected_by_its_surface_and_dragged_by_a_side_as_one_step() {
        let folder = tempfile::tempdir().unwrap();
        let (mut viewer, lamp) = lamp_viewer(folder.path());
        let bounds = viewer.document.scene().world_bounds(lamp).unwrap();
        let seen = |viewer: &Viewer| {
            let view = catoptra_raster::Projection::new(&viewer.camera, 640, 360);
            view.project(bounds.centre()).unwrap()
        };
        // Aside of the mark in its middle.
        let (x, y) = (seen(&viewer).x + 30.0, seen(&viewer).y);
        gesture(&mut viewer, Gesture::Click { at: (x, y), picking: Picking::Only });
        assert_eq!(viewer.selection.ids(), [lamp]);
        let overlay = viewer.overlay(&viewer.camera);
        let right = (320..640).map(|x| (f64::from(x), y));
        let (grip, at) = right.filter_map(|(x, y)| Some((overlay.grip_at(x, y)?, (x, y)))).next().unwrap();
        let light = |viewer: &Viewer| viewer.document.scene().light(lamp).unwrap();
        let before = light(&viewer);
        for step in 4..20 {
            let to = (at.0 + f64::from(step), at.1);
            gesture(&mut viewer, Gesture::Dragged { drag: Drag::Handle(grip), by: (1.0, 0.0), to });
        }
        gesture(&mut viewer, Gesture::Ended(Drag::Handle(grip)));
        let edge = |light: &catoptra_core::Light| light.values().get("edge-u").cloned();
        assert!(edge(&light(&viewer)) != edge(&before));
        let same = light(&viewer).with("edge-u", edge(&before).unwrap()).unwrap();
        assert_eq!(same, before, "nothing but the edge");
        run(&mut viewer, Command::Undo);
        assert_eq!(light(&viewer), before);
        assert!(viewer.document.is_saved());
    }

    #[test]
    fn deleting_the_selected_thing_deselects_it_and_undo_brings_it_back() {
        let mut viewer = viewer();
        let floor = viewer.document.scene().entity_named("floor");
        viewer.select(floor);
        run(&mut viewer, Command::Delete);
        viewer.follow_scene();
        assert_eq!(viewer.document.scene().entity_named("floor"), None);
        assert!(viewer.selection.is_empty());
        run(&mut viewer, Command::Undo);
        assert_eq!(viewer.document.scene().entity_named("floor"), floor);
        assert_eq!(viewer.selection.active(), floor, "it is selected again");
        assert_eq!(viewer.notice.as_ref().unwrap().0, "undo: delete floor");
    }

    #[test]
    fn the_next_camera_comes_round_to_the_first() {
        let mut viewer = viewer();
        let (camera, cameras) =
            (viewer.camera.clone(), viewer.document.scene().entities_of(Role::Camera).count());
        run(&mut viewer, Command::NextCamera);
        assert!(viewer.camera != camera);
        for _ in 1..cameras {
            run(&mut viewer, Command::NextCamera);
        }
        assert_eq!(viewer.camera, camera);
    }

    #[test]
    fn the_wheel_keeps_the_view_and_comes_nearer() {
        for mode in Mode::ALL {
            let mut viewer = viewer();
            viewer.settings.mode = mode;
            viewer.pointer.at = (320.0, 180.0);
            let before = viewer.camera.clone();
            wheel(&mut viewer, 2.0, false);
            let way = viewer.camera.eye() - before.eye();
            assert!(way.dot(before.forward()) > 0.1, "{way}");
            assert!((viewer.camera.forward() - before.forward()).length() < 1e-12);
        }
    }

    #[test]
    fn moving_the_camera_reuses_the_copy_of_the_scene_and_editing_does_not() {
        let mut viewer = viewer();
        let extraction = std::sync::Arc::clone(&viewer.extraction);
        run(&mut viewer, Command::Step(1, 0));
        viewer.follow_scene();
        assert!(std::sync::Arc::ptr_eq(&extraction, &viewer.extraction));
        gesture(&mut viewer, Gesture::Dragged { drag: Drag::Turn, by: (40.0, 9.0), to: (0.0, 0.0) });
        viewer.follow_scene();
        assert!(!std::sync::Arc::ptr_eq(&extraction, &viewer.extraction));
        assert_eq!(viewer.extraction.revision(), viewer.document.scene().revision());
    }

    #[test]
    fn what_was_removed_is_not_selected_in_a_picture_that_still_shows_it() {
        let mut viewer = viewer();
        let shown = (0..640).map(|x| (f64::from(x), 350.0)).find(|&(x, y)| viewer.pick(x, y).is_some());
        let (x, y) = shown.unwrap();
        gesture(&mut viewer, Gesture::Click { at: (x, y), picking: Picking::Only });
        assert!(!viewer.selection.is_empty());
        run(&mut viewer, Command::Delete);
        viewer.follow_scene();
        gesture(&mut viewer, Gesture::Click { at: (x, y), picking: Picking::Only });
        assert!(viewer.selection.is_empty());
    }
}
