use super::*;
use crate::{Value, Values};

fn seed() -> Camera {
    Camera::looking(DVec3::new(0.0, 10.0, 10.0), -DVec3::Z, DVec3::Y, PI / 2.0).unwrap()
}

#[test]
fn the_middle_ray_looks_forward_and_corners_span_the_field_of_view() {
    let middle = seed().ray(225.0, 225.0, 450, 450);
    assert!((middle.direction + DVec3::Z).length() < 1e-12);
    let corner = seed().ray(0.0, 0.0, 450, 450);
    assert!((corner.direction - DVec3::new(-1.0, 1.0, -1.0)).length() < 1e-12);
}

#[test]
fn a_wide_picture_keeps_its_vertical_field_of_view() {
    let top = seed().ray(800.0, 0.0, 1600, 900);
    assert!((top.direction - DVec3::new(0.0, 1.0, -1.0)).length() < 1e-12);
}

#[test]
fn straight_down_the_far_side_is_at_the_top() {
    let seen = |direction: DVec3| Camera::looking(DVec3::ZERO, direction, DVec3::Y, 1.0).unwrap();
    let down = seen(-DVec3::Y * 3.0);
    assert_eq!((down.up(), down.right(), down.up_hint()), (-DVec3::Z, DVec3::X, DVec3::Y));
    assert_eq!((seen(DVec3::Y).up(), seen(DVec3::Y).right()), (DVec3::Z, DVec3::X));
    // What turns with a group keeps it.
    let turned = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::X, 0.3).unwrap();
    let up = down.placed(&turned).unwrap().up();
    assert!((up - turned.direction(-DVec3::Z)).length() < 1e-12, "{up}");
}

#[test]
fn rays_from_all_over_a_lens_meet_where_things_are_sharp() {
    let camera = seed().with_lens(0.25, Some(3.0)).unwrap();
    let raster = camera.raster(40, 30);
    for (x, y) in [(20.0, 15.0), (0.5, 29.5), (33.0, 2.25)] {
        let sharp = raster.ray(x, y).at(3.0);
        for (right, up) in [(0.0, 0.0), (1.0, 0.0), (0.0, -1.0), (-0.6, 0.8)] {
            let ray = raster.ray_from(x, y, [right, up]);
            assert!((ray.at(3.0) - sharp).length() < 1e-12, "{x} {y} {right} {up}");
            let from = ray.origin - camera.eye();
            assert!((from - (camera.right() * right + camera.up() * up) * 0.25).length() < 1e-12);
        }
    }
}

#[test]
fn a_lens_is_sharp_at_the_target_unless_told_otherwise() {
    let camera = Camera::look_at(DVec3::ZERO, DVec3::X * 4.0, DVec3::Y, 1.0).unwrap();
    let lens = |radius, focus| camera.clone().with_lens(radius, focus);
    assert_eq!(lens(0.1, None).unwrap().focus(), Some(4.0));
    assert_eq!(lens(0.1, Some(2.0)).unwrap().focus(), Some(2.0));
    assert_eq!(lens(0.0, None).unwrap().raster(8, 8).start, RayStart::Eye);
    let placement = Placement::IDENTITY.scaled(2.0).unwrap();
    let placed = lens(0.1, Some(2.0)).unwrap().placed(&placement).unwrap();
    assert_eq!((placed.lens_radius(), placed.focus()), (0.2, Some(4.0)));
    for (radius, focus, field) in [
        (-0.1, None, "lens-radius"),
        (f64::NAN, None, "lens-radius"),
        (f64::INFINITY, None, "lens-radius"),
        (0.1, Some(0.0), "focus"),
        (0.1, Some(f64::NAN), "focus"),
    ] {
        assert_eq!(lens(radius, focus).unwrap_err().field(), field, "{radius} {focus:?}");
    }
    assert_eq!(seed().with_lens(0.1, None).unwrap_err().field(), "focus");
    assert!(seed().with_lens(0.0, None).is_ok());
}

#[test]
fn values_make_an_equal_camera() {
    for camera in [seed(), seed().with_lens(0.1, Some(2.0)).unwrap(), parallel(3.0)] {
        assert_eq!((Camera::KIND.make)(&Part::values(&camera)).unwrap(), camera);
    }
}

#[test]
fn impossible_views_are_refused() {
    let refused = |aim, up, fov| Camera::new(DVec3::ZERO, aim, up, fov).unwrap_err().field();
    assert_eq!(refused(Aim::Target(DVec3::ZERO), DVec3::Y, 1.0), "target");
    assert_eq!(refused(Aim::Direction(DVec3::Z), DVec3::Z, 1.0), "up");
    assert_eq!(refused(Aim::Direction(DVec3::Y), -DVec3::Y, 1.0), "up");
    assert_eq!(refused(Aim::Direction(DVec3::X), DVec3::Y, PI), "fov");
    assert_eq!(refused(Aim::Direction(DVec3::X), DVec3::Y, f64::NAN), "fov");
}

/// As the seed's, three metres high.
fn parallel(height: f64) -> Camera {
    seed().with_extent(Extent::Height(height)).unwrap()
}

#[test]
fn parallel_rays_start_all_over_a_window_of_that_height() {
    let ray = |x, y| parallel(3.0).ray(x, y, 400, 200);
    for (x, y, wanted) in [
        (200.0, 100.0, DVec3::new(0.0, 10.0, 10.0)),
        (200.0, 0.0, DVec3::new(0.0, 11.5, 10.0)),
        (0.0, 200.0, DVec3::new(-3.0, 8.5, 10.0)),
    ] {
        let ray = ray(x, y);
        assert!((ray.origin - wanted).length() < 1e-12, "{ray:?}");
        assert_eq!(ray.direction, -DVec3::Z);
        assert_eq!(parallel(3.0).raster(400, 200).ray_from(x, y, [0.5, 0.5]), ray);
    }
    // With its group it grows.
    let placement = Placement::IDENTITY.scaled(2.0).unwrap();
    assert_eq!(parallel(3.0).placed(&placement).unwrap().extent(), Extent::Height(6.0));
}

#[test]
fn an_orthographic_camera_has_the_angle_of_one_that_sees_as_much_at_the_target() {
    let camera = Camera::look_at(DVec3::ZERO, DVec3::X * 4.0, DVec3::Y, 1.0).unwrap();
    let parallel = camera.clone().with_extent(Extent::Height(3.0)).unwrap();
    let pixel = |camera: &Camera| camera.ray(0.0, 0.0, 10, 10).at(4.0);
    let perspective = camera.with_extent(Extent::Angle(parallel.fov())).unwrap();
    assert!((pixel(&parallel) - pixel(&perspective)).length() < 1e-12);
}

#[test]
fn projections_take_what_is_theirs() {
    let values = |extra: &[(&'static str, Value)]| {
        let eye = Values::new().with("eye", Value::Vector(DVec3::ZERO));
        let values = eye.with("direction", Value::Vector(DVec3::X));
        extra.iter().fold(values, |values, (name, value)| values.with(name, value.clone()))
    };
    let refused = |extra: &[_]| (Camera::KIND.make)(&values(extra)).unwrap_err().field();
    let orthographic = ("projection", Value::Word("orthographic".to_owned()));
    let height = ("height", Value::Number(2.0));
    let camera = (Camera::KIND.make)(&values(&[orthographic.clone(), height.clone()])).unwrap();
    assert_eq!(camera.extent(), Extent::Height(2.0));
    assert_eq!(refused(std::slice::from_ref(&orthographic)), "height");
    assert_eq!(refused(std::slice::from_ref(&height)), "height");
    assert_eq!(refused(&[orthographic.clone(), ("height", Value::Number(0.0))]), "height");
    assert_eq!(refused(&[orthographic.clone(), height.clone(), ("fov", Value::Number(1.0))]), "fov");
    let lens = [("lens-radius", Value::Number(0.1)), ("focus", Value::Number(1.0))];
    assert_eq!(refused(&[&[orthographic, height], &lens[..]].concat()), "lens-radius");
    assert_eq!(parallel(2.0).with_lens(0.1, Some(1.0)).unwrap_err().field(), "lens-radius");
    let blurred = seed().with_lens(0.1, Some(1.0)).unwrap();
    assert_eq!(blurred.with_extent(Extent::Height(1.0)).unwrap_err().field(), "lens-radius");
    for height in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
        assert_eq!(seed().with_extent(Extent::Height(height)).unwrap_err().field(), "height");
    }
}
