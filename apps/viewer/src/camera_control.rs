//! Where does the camera go when it is orbited, panned, moved or zoomed? Pure functions from a camera to a camera.
//! What a camera refuses (a view along its own up, an infinite eye) leaves it as it was.

use std::f64::consts::PI;

use catoptra_core::glam::{DQuat, DVec3};
use catoptra_core::{Aabb, Camera, Extent};

/// How close a view may come to the vertical while orbiting, radians.
const POLE: f64 = 0.02;

/// The share of the way to the target that one notch of the wheel covers.
pub(crate) const NOTCH: f64 = 0.1;

/// Radians that the camera orbits per pixel dragged: half a turn in 600 pixels.
pub(crate) const ORBIT_PER_PIXEL: f64 = std::f64::consts::PI / 600.0;

/// How much of the free picture is left round a framed thing, as a factor on the distance.
const FRAME_MARGIN: f64 = 1.08;

/// Metres to the target of a camera that names none.
const USUAL_FOCUS: f64 = 10.0;

/// Metres from the eye to what is looked at.
pub(crate) fn focus(camera: &Camera) -> f64 {
    camera.target_distance().unwrap_or(USUAL_FOCUS)
}

/// The same view with its target at that distance in metres.
pub(crate) fn aimed(camera: &Camera, distance: f64) -> Camera {
    looking(camera, camera.eye(), camera.eye() + camera.forward() * distance, camera.up_hint())
}

fn target(camera: &Camera) -> DVec3 {
    camera.eye() + camera.forward() * focus(camera)
}

fn looking(camera: &Camera, eye: DVec3, target: DVec3, up: DVec3) -> Camera {
    Camera::look_at(eye, target, up, PI / 2.0)
        .and_then(|moved| moved.with_extent(camera.extent()))
        .and_then(|moved| moved.with_lens(camera.lens_radius(), camera.given_focus()))
        .unwrap_or_else(|_| camera.clone())
}

/// The same camera, where that is orthographic with a picture of so many times its height: coming nearer changes nothing in it
/// but this.
fn magnified(camera: Camera, factor: f64) -> Camera {
    match camera.extent() {
        Extent::Angle(_) => camera,
        Extent::Height(height) => {
            camera.clone().with_extent(Extent::Height(height * factor)).unwrap_or(camera)
        }
    }
}

fn moved(camera: &Camera, by: DVec3) -> Camera {
    looking(camera, camera.eye() + by, target(camera) + by, camera.up_hint())
}

/// The same target from the same distance, along that direction, which need not be of length 1.
pub(crate) fn seen_along(camera: &Camera, direction: DVec3, up: DVec3) -> Camera {
    let target = target(camera);
    looking(camera, target - direction.normalize_or(camera.forward()) * focus(camera), target, up)
}

/// Goes round the target: `yaw` about the direction given as up (radians, seen from there anticlockwise), then
/// `pitch` upwards. The view never passes a pole.
pub(crate) fn orbit(camera: &Camera, yaw: f64, pitch: f64) -> Camera {
    let vertical = camera.up_hint().normalize_or(DVec3::Y);
    let target = target(camera);
    let arm = DQuat::from_axis_angle(vertical, yaw) * (camera.eye() - target);
    let from_vertical = arm.angle_between(vertical);
    let wanted = (from_vertical - pitch).clamp(POLE, std::f64::consts::PI - POLE);
    let axis = vertical.cross(arm).normalize_or(camera.right());
    let eye = target + DQuat::from_axis_angle(axis, wanted - from_vertical) * arm;
    looking(camera, eye, target, vertical)
}

/// Metres that a pixel of a picture `height` pixels high covers at that distance along the view.
pub(crate) fn metres_per_pixel(camera: &Camera, height: f64, distance: f64) -> f64 {
    let seen = match camera.extent() {
        Extent::Angle(fov) => 2.0 * distance * (0.5 * fov).tan(),
        Extent::Height(metres) => metres,
    };
    seen / height.max(1.0)
}

/// Moves in the picture's plane so that what lies at the target's distance follows the pointer by that many pixels
/// (y down) in a picture `height` pixels high.
pub(crate) fn pan(camera: &Camera, by: (f64, f64), height: f64) -> Camera {
    let scale = metres_per_pixel(camera, height, focus(camera));
    moved(camera, (camera.up() * by.1 - camera.right() * by.0) * scale)
}

/// Moves along the view by `metres`. The target stays until it is nearer than `nearest`, then it is pushed ahead. An orthographic
/// picture grows as a perspective one would at the target.
pub(crate) fn dolly(camera: &Camera, metres: f64, nearest: f64) -> Camera {
    let eye = camera.eye() + camera.forward() * metres;
    let (before, after) = (focus(camera), (focus(camera) - metres).max(nearest));
    magnified(looking(camera, eye, eye + camera.forward() * after, camera.up_hint()), after / before)
}

/// Comes nearer to `point` (or goes away from it) without turning, so that it stays under the pointer: its
/// distance becomes `factor` times what it was.
pub(crate) fn zoom_to(camera: &Camera, point: DVec3, factor: f64) -> Camera {
    let eye = point + (camera.eye() - point) * factor;
    let target = eye + camera.forward() * (focus(camera) * factor);
    magnified(looking(camera, eye, target, camera.up_hint()), factor)
}

/// Steps sideways and upwards by shares of the distance to the target.
pub(crate) fn step(camera: &Camera, right: f64, up: f64) -> Camera {
    moved(camera, (camera.right() * right + camera.up() * up) * focus(camera))
}

/// Moves without turning so that all of `bounds` is seen in a picture of that width to height.
pub(crate) fn frame(camera: &Camera, bounds: Aabb, aspect: f64) -> Camera {
    if bounds.is_empty() {
        return camera.clone();
    }
    let radius = (0.5 * bounds.size().length()).max(1e-6);
    let centre = bounds.centre();
    if let Extent::Height(height) = camera.extent() {
        let wanted = 2.0 * FRAME_MARGIN * radius / aspect.clamp(1e-3, 1.0);
        // Behind all of it.
        let eye = centre - camera.forward() * (2.0 * FRAME_MARGIN * radius);
        return magnified(looking(camera, eye, centre, camera.up_hint()), wanted / height);
    }
    let half_height = 0.5 * camera.fov();
    let half = half_height.min((half_height.tan() * aspect.max(1e-3)).atan());
    let distance = FRAME_MARGIN * radius / half.sin();
    looking(camera, centre - camera.forward() * distance, centre, camera.up_hint())
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEIGHT: f64 = 720.0;
    const WIDTH: f64 = 1280.0;

    fn camera() -> Camera {
        Camera::look_at(DVec3::new(1.0, 3.0, 8.0), DVec3::new(0.0, 1.0, -2.0), DVec3::Y, 0.9).unwrap()
    }

    /// Where a point is seen, in pixels.
    fn seen(camera: &Camera, point: DVec3) -> (f64, f64) {
        let d = point - camera.eye();
        let depth = d.dot(camera.forward());
        let scale = 0.5 * HEIGHT / (0.5 * camera.fov()).tan() / depth;
        (0.5 * WIDTH + d.dot(camera.right()) * scale, 0.5 * HEIGHT - d.dot(camera.up()) * scale)
    }

    #[test]
    fn orbiting_keeps_the_target_and_its_distance() {
        let (before, after) = (camera(), orbit(&camera(), 0.7, -0.3));
        assert!((target(&before) - target(&after)).length() < 1e-12);
        assert!((focus(&before) - focus(&after)).abs() < 1e-12);
        assert!((before.eye() - after.eye()).length() > 1.0);
    }

    #[test]
    fn orbiting_up_raises_the_eye() {
        assert!(orbit(&camera(), 0.0, 0.2).eye().y > camera().eye().y);
    }

    #[test]
    fn orbiting_never_passes_the_pole() {
        let mut c = camera();
        for _ in 0..100 {
            c = orbit(&c, 0.01, 0.2);
        }
        assert!(c.up().y > 0.0, "still upright");
        assert!(c.forward().y < -0.99, "looks down");
    }

    #[test]
    fn panning_carries_the_target_with_the_pointer() {
        let before = camera();
        let after = pan(&before, (30.0, -12.0), HEIGHT);
        let (was, is) = (seen(&before, target(&before)), seen(&after, target(&before)));
        assert!((is.0 - was.0 - 30.0).abs() < 1e-9 && (is.1 - was.1 + 12.0).abs() < 1e-9);
    }

    #[test]
    fn zooming_leaves_the_point_under_the_pointer() {
        let point = DVec3::new(2.0, 0.5, -3.0);
        let (was, is) = (seen(&camera(), point), seen(&zoom_to(&camera(), point, 0.6), point));
        assert!((was.0 - is.0).abs() < 1e-9 && (was.1 - is.1).abs() < 1e-9);
    }

    #[test]
    fn a_dolly_goes_along_the_view_and_through_the_target() {
        let before = camera();
        let mut c = before.clone();
        for _ in 0..50 {
            c = dolly(&c, 1.0, 0.5);
        }
        assert!((c.eye() - before.eye() - before.forward() * 50.0).length() < 1e-9);
        assert!((c.forward() - before.forward()).length() < 1e-9);
    }

    #[test]
    fn framing_shows_every_corner_in_wide_and_tall_pictures() {
        let bounds = Aabb { min: DVec3::new(-3.0, 0.0, -9.0), max: DVec3::new(5.0, 2.0, 4.0) };
        for aspect in [WIDTH / HEIGHT, 0.4] {
            let c = frame(&camera(), bounds, aspect);
            for i in 0..8 {
                let pick = |bit: i32, a: f64, b: f64| if i & bit == 0 { a } else { b };
                let (min, max) = (bounds.min, bounds.max);
                let corner = DVec3::new(pick(1, min.x, max.x), pick(2, min.y, max.y), pick(4, min.z, max.z));
                let d = corner - c.eye();
                let half = (0.5 * c.fov()).tan() * d.dot(c.forward());
                assert!(d.dot(c.up()).abs() <= half && d.dot(c.right()).abs() <= half * aspect, "corner {i}");
            }
        }
    }

    #[test]
    fn aiming_changes_the_target_and_nothing_that_is_seen() {
        let aimed = aimed(&camera(), 3.0);
        assert!((focus(&aimed) - 3.0).abs() < 1e-12);
        assert!((aimed.forward() - camera().forward()).length() < 1e-12);
        assert_eq!(aimed.eye(), camera().eye());
    }

    /// As [`camera`], with parallel rays.
    fn parallel() -> Camera {
        camera().with_extent(Extent::Height(6.0)).unwrap()
    }

    /// Where a point is seen by parallel rays, in pixels from the middle.
    fn seen_by_parallel(camera: &Camera, point: DVec3) -> DVec3 {
        let Extent::Height(height) = camera.extent() else { panic!("{camera:?}") };
        let d = (point - camera.eye()) * (HEIGHT / height);
        DVec3::new(d.dot(camera.right()), -d.dot(camera.up()), 0.0)
    }

    #[test]
    fn an_orthographic_camera_is_steered_alike() {
        let (before, point) = (parallel(), DVec3::new(2.0, 0.5, -3.0));
        let zoomed = zoom_to(&before, point, 0.6);
        let apart = seen_by_parallel(&before, point) - seen_by_parallel(&zoomed, point);
        assert!(apart.length() < 1e-9 && zoomed.extent() == Extent::Height(6.0 * 0.6), "{zoomed:?}");
        let panned = pan(&before, (30.0, -12.0), HEIGHT);
        let moved = seen_by_parallel(&panned, point) - seen_by_parallel(&before, point);
        assert!((moved - DVec3::new(30.0, -12.0, 0.0)).length() < 1e-9, "{moved}");
        assert_eq!(orbit(&before, 0.7, -0.3).extent(), before.extent());
        let half = dolly(&before, focus(&before) / 2.0, 0.1);
        assert_eq!(half.extent(), Extent::Height(3.0));
        let bounds = Aabb { min: DVec3::new(-3.0, 0.0, -9.0), max: DVec3::new(5.0, 2.0, 4.0) };
        let framed = frame(&before, bounds, 0.4);
        for corner in bounds.corners() {
            let seen = seen_by_parallel(&framed, corner).abs();
            assert!(seen.x <= 0.2 * HEIGHT && seen.y <= 0.5 * HEIGHT, "{corner} at {seen}");
            assert!((corner - framed.eye()).dot(framed.forward()) > 0.0);
        }
    }

    #[test]
    fn framing_nothing_changes_nothing() {
        assert_eq!(frame(&camera(), Aabb::EMPTY, 1.0).eye(), camera().eye());
    }
}
