//! How does one look from the front, from a side, from above, without perspective, and without going through the floor?
//! Pure functions from a camera to a camera.

use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_4;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Role, Scene};
use catoptra_core::{Camera, Extent, Shape};

use crate::camera_control::{self, focus};

/// From where a thing is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    /// Across, with right to the right.
    Front,
    /// The other way round.
    Back,
    /// From the right.
    Right,
    /// From the left.
    Left,
    /// From above, with what is at the back at the top.
    Top,
    /// From below.
    Bottom,
}

/// How far, in radians, a view from above is from the vertical: so it has a top, and can be orbited on. What stands up a
/// metre is seen a tenth of a millimetre aside.
const OFF_VERTICAL: f64 = 1e-4;

/// The same target at the same distance, seen from there. Up is what it was; right is x where that can be.
pub(crate) fn from_side(camera: &Camera, side: Side) -> Camera {
    let up = camera.up_hint().normalize_or(DVec3::Y);
    let across = DVec3::X - up * up.x;
    let right = across.try_normalize().filter(|_| across.length() > 0.1).unwrap_or(DVec3::Z);
    let front = right.cross(up);
    let arm = match side {
        Side::Front => front,
        Side::Back => -front,
        Side::Right => right,
        Side::Left => -right,
        Side::Top => up + front * OFF_VERTICAL,
        Side::Bottom => -up + front * OFF_VERTICAL,
    };
    camera_control::seen_along(camera, -arm, up)
}

/// The same view with parallel rays, or with perspective again: what is at the target keeps its size. A view with
/// parallel rays has no lens.
pub(crate) fn other_projection(camera: &Camera) -> Camera {
    let distance = focus(camera);
    let (extent, bare) = match camera.extent() {
        Extent::Angle(fov) => {
            (Extent::Height(2.0 * distance * (0.5 * fov).tan()), camera.clone().with_lens(0.0, None))
        }
        Extent::Height(height) => {
            let fov = 2.0 * (0.5 * height / distance).atan();
            (Extent::Angle(if fov > 0.0 { fov } else { FRAC_PI_4 }), Ok(camera.clone()))
        }
    };
    bare.and_then(|bare| bare.with_extent(extent)).unwrap_or_else(|_| camera.clone())
}

/// Where an orbit to `after` ends: on the side of every floor (a plane without end) where `before` is, as far as it goes
/// round and not up or down.
pub(crate) fn above_floors(
    scene: &Scene,
    before: &Camera,
    after: Camera,
    level: impl Fn() -> Camera,
) -> Camera {
    let goes_through = scene.entities_of(Role::Shape).any(|id| {
        let is_plane = matches!(scene.shape(id), Some(Shape::Plane(_))) && !scene.is_hidden(id);
        let Some(Shape::Plane(plane)) = scene.world_shape(id).filter(|_| is_plane) else { return false };
        let (from, to) = (plane.side_of(before.eye()), plane.side_of(after.eye()));
        from != Ordering::Equal && from != to
    });
    if goes_through { level() } else { after }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(up: DVec3) -> Camera {
        Camera::look_at(DVec3::new(3.0, 4.0, 5.0), DVec3::new(1.0, 1.0, 1.0), up, 0.7).unwrap()
    }

    #[test]
    fn sides_look_along_the_axes_with_up_up() {
        let sides = [
            (Side::Front, DVec3::NEG_Z, DVec3::X),
            (Side::Back, DVec3::Z, DVec3::NEG_X),
            (Side::Right, DVec3::NEG_X, DVec3::NEG_Z),
            (Side::Left, DVec3::X, DVec3::Z),
            (Side::Top, DVec3::NEG_Y, DVec3::X),
            (Side::Bottom, DVec3::Y, DVec3::X),
        ];
        for (side, forward, right) in sides {
            let seen = from_side(&camera(DVec3::Y), side);
            assert!((seen.forward() - forward).length() < 2e-4, "{side:?} {}", seen.forward());
            assert!((seen.right() - right).length() < 2e-4, "{side:?} {}", seen.right());
            let target = seen.eye() + seen.forward() * focus(&seen);
            assert!((target - DVec3::ONE).length() < 1e-9, "{side:?} {target}");
        }
        let seen = from_side(&camera(DVec3::Z), Side::Front);
        assert!((seen.forward() - DVec3::Y).length() < 1e-9, "z up: the front is at -y");
    }

    #[test]
    fn a_view_from_above_is_orbited_on_about_the_same_up() {
        let top = from_side(&camera(DVec3::Y), Side::Top);
        let orbited = camera_control::orbit(&top, 0.3, -0.5);
        assert!(orbited.up().y > 0.3 && orbited.eye().y < top.eye().y);
    }

    #[test]
    fn another_projection_keeps_the_size_at_the_target_and_comes_back() {
        let before = camera(DVec3::Y);
        let parallel = other_projection(&before);
        let Extent::Height(height) = parallel.extent() else { panic!("{parallel:?}") };
        assert!((height - 2.0 * focus(&before) * 0.35_f64.tan()).abs() < 1e-12);
        let back = other_projection(&parallel);
        assert!((back.fov() - before.fov()).abs() < 1e-12 && back.eye() == before.eye());
    }

    #[test]
    fn an_orbit_does_not_go_through_a_floor_but_may_stay_below() {
        let text = "matte \"m\" { color 0.5 }\nplane \"floor\" material=\"m\"\n";
        let (scene, _) = catoptra_scene::parse(text, "text", None).unwrap();
        let orbited = |camera: &Camera, scene: &Scene| {
            let after = camera_control::orbit(camera, 0.2, -1.4);
            above_floors(scene, camera, after, || camera_control::orbit(camera, 0.2, 0.0))
        };
        let above = camera(DVec3::Y);
        assert!(orbited(&above, &Scene::new()).eye().y < 0.0, "without a floor it goes there");
        let held = orbited(&above, &scene);
        assert!((held.eye().y - above.eye().y).abs() < 1e-9 && held.eye().distance(above.eye()) > 0.1);
        let below = from_side(&above, Side::Bottom);
        assert!(orbited(&below, &scene).eye().y < 0.0);
    }
}
