//! What does it do to look through a light or a camera and to move the view? The light or the camera goes along.

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, EntityId, Scene};
use catoptra_core::{Camera, InvalidPart, Light, Placement, Value};
use catoptra_raster::Projection;

use crate::camera_control;
use crate::transform::{step_within, tidy_camera, tidy_light};
use crate::viewer::Viewer;

/// The key of the steps that this makes.
const STEP_KEY: u64 = 1 << 63 | 1 << 61;

/// How much is seen through a light that has no cone, radians from the lower to the upper edge, and the least and the most
/// of one that has.
const USUAL: f64 = 1.0;
const ANGLES: [f64; 2] = [0.2, 2.4];

/// A lamp's surface is looked away from this far in front of it, in lengths of the view's distance.
const IN_FRONT: f64 = 1e-3;

/// What is flown.
#[derive(Debug, Clone)]
pub(crate) struct Flown {
    /// The light or the camera.
    pub(crate) id: EntityId,
    /// Where one looked from before.
    home: Camera,
}

/// Looks through a light or a camera that then goes along with the view.
pub(crate) fn begin(viewer: &mut Viewer, id: EntityId) {
    end(viewer);
    let scene = viewer.document.scene();
    if scene.is_locked(id) {
        return viewer.notify("it is locked");
    }
    let home = viewer.camera.clone();
    if scene.camera(id).is_some() {
        viewer.adopt(Some(id));
    } else {
        let Some(camera) = seen_from(scene, id, camera_control::focus(&home)) else {
            return viewer.notify("this light has no place and direction to look from");
        };
        viewer.look(camera);
    }
    viewer.document.end_step();
    viewer.flown = Some(Flown { id, home });
    viewer.stale.panel = true;
}

/// Leaves what is flown where it is. From a light one goes back to where one looked from before.
pub(crate) fn end(viewer: &mut Viewer) {
    if let Some(Flown { id, home }) = viewer.flown.take() {
        viewer.document.end_step();
        if viewer.document.scene().light(id).is_some() {
            viewer.look(home);
        }
        viewer.stale.panel = true;
    }
}

/// Takes what is flown along with the view.
pub(crate) fn follow(viewer: &mut Viewer) {
    let Some(id) = viewer.flown.as_ref().map(|flown| flown.id) else { return };
    match edit(viewer, id) {
        Some(Ok(edit)) => viewer.edit_on(edit, STEP_KEY),
        Some(Err(refusal)) => viewer.notify(refusal.to_string()),
        None => viewer.flown = None,
    }
}

fn edit(viewer: &Viewer, id: EntityId) -> Option<Result<Edit, InvalidPart>> {
    let scene = viewer.document.scene();
    let outer = scene.world_placement(id)?;
    if let Some(own) = scene.camera(id) {
        return Some(tidy_view(viewer, &own, &outer).map(|camera| Edit::Camera(id, camera)));
    }
    let own = scene.light(id)?;
    let tidy = |now: Light| Ok(Edit::Light(id, tidy_light(&own, &now, step_of_view(viewer, &outer))?));
    Some(moved_to(&own, &outer, &viewer.camera).and_then(tidy))
}

/// Metres, in the space of a thing that is placed so, to which numbers are rounded that come of a view: what a pixel of it
/// shows where it looks.
fn step_of_view(viewer: &Viewer, outer: &Placement) -> f64 {
    let view = Projection::new(&viewer.camera, viewer.size.0, viewer.size.1);
    let far = viewer.camera.eye() + viewer.camera.forward() * camera_control::focus(&viewer.camera);
    step_within(view.metres_per_pixel(far).unwrap_or(0.0), outer)
}

/// The camera that sees the view, in the space of one that is placed so, with round numbers where they differ from its own.
///
/// # Errors
/// A view that has no place there.
pub(crate) fn tidy_view(viewer: &Viewer, own: &Camera, outer: &Placement) -> Result<Camera, InvalidPart> {
    let now = viewer.camera.placed(&outer.inverse())?;
    tidy_camera(own, &now, step_of_view(viewer, outer))
}

/// A light, in its own space, that shines from where a camera looks.
fn moved_to(own: &Light, outer: &Placement, camera: &Camera) -> Result<Light, InvalidPart> {
    let (inner, eye, forward) = (outer.inverse(), camera.eye(), camera.forward());
    if own.direction().is_some() {
        let aimed = own.with("direction", Value::Vector(inner.direction(forward)))?;
        return match own.position() {
            Some(_) => aimed.with("position", Value::Vector(inner.point(eye))),
            None => Ok(aimed),
        };
    }
    let Some((at, normal)) = surface(&own.placed(outer)) else { return Ok(own.clone()) };
    let across = normal.cross(forward).try_normalize().unwrap_or(normal.any_orthonormal_vector());
    let turned = Placement::IDENTITY.turned(at, across, normal.angle_between(forward))?;
    let moved = turned.moved(eye - at)?;
    Ok(own.placed(&outer.then(&moved).then(&inner)))
}

/// The view from a light, to something `distance` metres away.
fn seen_from(scene: &Scene, id: EntityId, distance: f64) -> Option<Camera> {
    let light = scene.world_light(id)?;
    let (eye, forward) = match (light.position(), light.direction()) {
        (Some(position), Some(direction)) => (position, direction),
        _ => surface(&light).map(|(middle, normal)| (middle + normal * (IN_FRONT * distance), normal))?,
    };
    let angle = match light.values().get("outer") {
        Some(Value::Number(outer)) => outer.clamp(ANGLES[0], ANGLES[1]),
        _ => USUAL,
    };
    let up = if forward.cross(DVec3::Y).length() > 1e-3 { DVec3::Y } else { DVec3::NEG_Z };
    Camera::look_at(eye, eye + forward * distance, up, angle).ok()
}

/// The middle of a flat lamp, and the way it shines.
fn surface(light: &Light) -> Option<(DVec3, DVec3)> {
    match light.lamp()?.shape {
        catoptra_core::Shape::Rectangle(shape) => {
            let [u, v] = shape.edges();
            Some((shape.corner() + (u + v) * 0.5, u.cross(v).try_normalize()?))
        }
        catoptra_core::Shape::Disk(disk) => Some((disk.center(), disk.normal().try_normalize()?)),
        _ => None,
    }
}
