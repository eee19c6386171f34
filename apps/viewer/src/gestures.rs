//! What does each gesture of the pointer do to the viewer?

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, EntityId, Role};
use catoptra_core::{Camera, InvalidPart, Light, Placement};
use catoptra_raster::{Constraint, Grip, Handle, Projection, Tool};

use crate::camera_control::{self, NOTCH, ORBIT_PER_PIXEL};
use crate::input::{Drag, Gesture, Hold, Mode};
use crate::selection::Picking;
use crate::transform::{self, Ends};
use crate::viewer::Viewer;
use crate::views;

/// How far a turntable drag turns the objects, in degrees per pixel.
const TURN_PER_PIXEL: f64 = 0.3;

/// The target is pushed ahead when the camera comes nearer than this share of the scene's size.
const NEAREST: f64 = 0.02;

/// The share by which a drag that zooms comes nearer, per pixel upwards.
const ZOOM_PER_PIXEL: f64 = 0.005;

/// The step keys of drags; panels use keys with this bit clear.
const DRAG_KEY: u64 = 1 << 63;

/// Does what the pointer asks for.
pub(crate) fn gesture(viewer: &mut Viewer, gesture: Gesture) {
    match gesture {
        Gesture::None => {}
        Gesture::Click { at: (x, y), picking } => click(viewer, (x, y), picking),
        Gesture::Dragged { drag, by, to } => drag_by(viewer, drag, by, to),
        Gesture::Ended(drag) => {
            if drag == Drag::Turn {
                round_turns(viewer);
            }
            transform::keep(viewer);
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
            let target =
                viewer.camera.eye() + viewer.camera.forward() * camera_control::focus(&viewer.camera);
            let factor = (by.1 * ZOOM_PER_PIXEL).exp();
            viewer.look(camera_control::zoom_to(&viewer.camera, target, factor));
        }
        Drag::Pan => viewer.look(camera_control::pan(&viewer.camera, by, f64::from(viewer.size.1))),
        Drag::Turn => turn_objects(viewer, by),
        Drag::Hold(Hold::Grip(grip)) => drag_grip(viewer, grip, to),
        Drag::Hold(hold) => drag_things(viewer, hold, by, to),
    }
}

/// Turns all objects about the origin: shapes and groups with shapes at the top of the scene. Lights and cameras
/// stay, those in such a group excepted.
fn turn_objects(viewer: &mut Viewer, by: (f64, f64)) {
    let (about_y, about_x) = ((by.0 * TURN_PER_PIXEL).to_radians(), (by.1 * TURN_PER_PIXEL).to_radians());
    place_objects(viewer, |at| at.seed_turned(about_y, about_x));
}

/// Rounds how objects were turned to what a pixel can tell: at the end, so that nothing adds up.
fn round_turns(viewer: &mut Viewer) {
    let view = Projection::new(&viewer.camera, viewer.size.0, viewer.size.1);
    let step =
        transform::step_within(view.metres_per_pixel(DVec3::ZERO).unwrap_or(0.0), &Placement::IDENTITY);
    place_objects(viewer, |at| transform::turned(&at, step));
}

/// Places all objects otherwise, as a part of the drag's step.
fn place_objects(viewer: &mut Viewer, placed: impl Fn(Placement) -> Result<Placement, InvalidPart>) {
    let scene = viewer.document.scene();
    let edit = |id: EntityId| Some(Edit::Placement(id, placed(scene.placement(id)?).ok()?));
    let objects = scene.children(None).into_iter().filter(|id| is_object(viewer, *id));
    let edits: Vec<Edit> = objects.filter_map(edit).collect();
    viewer.edit_on(Edit::Batch(edits), DRAG_KEY);
}

pub(crate) fn is_object(viewer: &Viewer, id: EntityId) -> bool {
    let scene = viewer.document.scene();
    match scene.role(id) {
        Some(Role::Shape) => true,
        Some(Role::Group) => scene.children(Some(id)).into_iter().any(|member| is_object(viewer, member)),
        _ => false,
    }
}

/// Moves, turns or scales what is selected, or the light or camera whose mark is dragged.
fn drag_things(viewer: &mut Viewer, hold: Hold, by: (f64, f64), to: (f64, f64)) {
    if viewer.transform.is_none() {
        let (tool, constraint) = match hold {
            Hold::Handle(constraint) => (viewer.settings.tool.unwrap_or(Tool::Move), constraint),
            Hold::Mark(id) if !viewer.selection.contains(id) => {
                viewer.select(Some(id));
                (Tool::Move, Constraint::Free)
            }
            Hold::Mark(_) | Hold::Grip(_) => (Tool::Move, Constraint::Free),
        };
        transform::begin(viewer, tool, constraint, Ends::ByRelease, (to.0 - by.0, to.1 - by.1));
    }
    transform::pull(viewer, to, viewer.pointer.held.ctrl);
}

/// What stands under the pointer that can be dragged.
pub(crate) fn hold_at(viewer: &Viewer, (x, y): (f64, f64)) -> Option<Hold> {
    let overlay = viewer.overlay(&viewer.camera);
    let handle = || overlay.manipulator_at(x, y).map(Hold::Handle);
    let grip = || overlay.grip_at(x, y).map(Hold::Grip);
    let mark = || overlay.mark_at(x, y).map(Hold::Mark);
    handle().or_else(grip).or_else(mark)
}

/// The light whose handle is dragged to a pixel.
fn gripped(viewer: &Viewer, grip: Grip, to: (f64, f64)) -> Option<Result<Light, InvalidPart>> {
    let overlay = viewer.overlay(&viewer.camera);
    if grip.handle != Handle::Target {
        return overlay.drag(grip, to.0, to.1);
    }
    let [from, target] = overlay.aim_line(grip.light)?;
    let distance = target.distance(viewer.camera.eye());
    let at = transform::aimed_at(viewer, grip.light, to, distance);
    let pixel = Projection::new(&viewer.camera, viewer.size.0, viewer.size.1).metres_per_pixel(from)?;
    let scene = viewer.document.scene();
    let step = transform::step_within(pixel, &scene.world_placement(grip.light)?);
    let before = scene.light(grip.light)?;
    Some(overlay.aim(grip.light, at)?.and_then(|aimed| transform::tidy_light(&before, &aimed, step)))
}

fn drag_grip(viewer: &mut Viewer, grip: Grip, to: (f64, f64)) {
    let Some(light) = gripped(viewer, grip, to) else { return };
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
    let camera = if to_pointer {
        let (x, y) = viewer.pointer.at;
        let hit = viewer.pick(x, y).map(|hit| hit.point);
        let ray = viewer.camera.ray(x, y, viewer.size.0.max(1), viewer.size.1.max(1));
        let point = hit.unwrap_or_else(|| ray.at(camera_control::focus(&viewer.camera)));
        camera_control::zoom_to(&viewer.camera, point, (1.0 - NOTCH).powf(notches))
    } else {
        ahead(viewer, notches * NOTCH)
    };
    viewer.look(camera);
}

/// The camera nearer to what it looks at by a share of the distance, and on past that.
pub(crate) fn ahead(viewer: &Viewer, share: f64) -> Camera {
    let nearest = NEAREST * viewer.everything().size().length().max(0.1);
    let focus = camera_control::focus(&viewer.camera);
    camera_control::dolly(&viewer.camera, share * focus.max(nearest), nearest)
}
