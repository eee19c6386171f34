//! What stands elsewhere than between point and lamp: does it hide what it should, and nothing else?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use catoptra_core::Shape;
use catoptra_core::contour::{Blocker, Lamp, Leaving, NoClosedForm, Scratch, may_hide, open, visible};
use catoptra_core::geometry::{Cuboid, Disk, Plane, Rectangle, Sphere, Tetrahedron};
use catoptra_core::glam::DVec3;

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A square of 2 m across the y axis, facing down.
fn square(at: DVec3) -> Shape {
    Rectangle::new(at - v(1.0, 0.0, 1.0), v(2.0, 0.0, 0.0), v(0.0, 0.0, 2.0)).unwrap().into()
}

fn ball(at: DVec3, radius: f64) -> Shape {
    Sphere::new(at, radius).unwrap().into()
}

fn disk(at: DVec3, normal: DVec3, radius: f64) -> Shape {
    Disk::new(at, normal, radius).unwrap().into()
}

fn cuboid(min: DVec3, max: DVec3) -> Shape {
    Cuboid::new(min, max).unwrap().into()
}

fn plane(point: DVec3, normal: DVec3) -> Shape {
    Plane::new(point, normal).unwrap().into()
}

fn upright(corner: DVec3) -> Shape {
    Rectangle::new(corner, v(0.0, 2.0, 0.0), v(0.0, 0.0, 2.0)).unwrap().into()
}

/// From the origin, looking up.
fn past(lamp: &Lamp, shape: &Shape) -> Result<f64, NoClosedForm> {
    leaving(lamp, DVec3::Y, shape, Leaving::Nothing)
}

fn leaving(lamp: &Lamp, normal: DVec3, shape: &Shape, leaving: Leaving) -> Result<f64, NoClosedForm> {
    let blocker = Blocker::of(shape).unwrap();
    visible(DVec3::ZERO, normal, lamp, &[(&blocker, leaving)], &mut Scratch::default())
}

/// A square, a disk and a ball 4 m above the origin.
fn lamps() -> [Lamp; 3] {
    [
        Lamp::of(&square(v(0.0, 4.0, 0.0)), 0).unwrap(),
        Lamp::disk(v(0.0, 4.0, 0.0), DVec3::NEG_Y, 1.0).unwrap(),
        Lamp::sphere(v(0.0, 4.0, 0.0), 1.0).unwrap(),
    ]
}

#[track_caller]
fn is_open(lamp: &Lamp, shape: &Shape) {
    let whole = open(DVec3::ZERO, DVec3::Y, lamp);
    assert!(whole > 0.0);
    assert_eq!(past(lamp, shape), Ok(whole), "{lamp:?} {shape:?}");
}

#[track_caller]
fn is_dark(lamp: &Lamp, shape: &Shape) {
    let value = past(lamp, shape);
    assert!(value.is_ok_and(|value| value < 1e-15), "{value:?} {lamp:?} {shape:?}");
}

#[track_caller]
fn is_part(lamp: &Lamp, shape: &Shape) {
    let (value, whole) = (past(lamp, shape).unwrap(), open(DVec3::ZERO, DVec3::Y, lamp));
    assert!(0.05 * whole < value && value < 0.95 * whole, "{value} of {whole}: {lamp:?} {shape:?}");
}

#[test]
fn what_is_behind_the_point_hides_nothing() {
    for lamp in lamps() {
        for y in [-0.5, -2.0, -4.0] {
            is_open(&lamp, &ball(v(0.0, y, 0.0), 0.4));
            is_open(&lamp, &disk(v(0.0, y, 0.0), DVec3::Y, 1.0));
            is_open(&lamp, &square(v(0.0, y, 0.0)));
            is_open(&lamp, &cuboid(v(-1.0, y - 0.2, -1.0), v(1.0, y + 0.2, 1.0)));
            is_open(&lamp, &plane(v(0.0, y, 0.0), DVec3::Y));
        }
    }
}

#[test]
fn what_is_beyond_the_lamp_hides_nothing() {
    for lamp in lamps() {
        is_open(&lamp, &ball(v(0.0, 7.0, 0.0), 1.5));
        is_open(&lamp, &disk(v(0.0, 6.0, 0.0), DVec3::Y, 3.0));
        is_open(&lamp, &square(v(0.0, 6.0, 0.0)));
        is_open(&lamp, &cuboid(v(-2.0, 5.5, -2.0), v(2.0, 6.0, 2.0)));
        is_open(&lamp, &plane(v(0.0, 5.5, 0.0), v(0.0, 1.0, 0.1)));
    }
}

#[test]
fn what_is_aside_changes_no_bit() {
    for lamp in lamps() {
        for shape in [
            ball(v(3.0, 2.0, 0.0), 0.9),
            disk(v(3.0, 2.0, 0.0), v(1.0, 1.0, 0.0), 1.0),
            square(v(2.0, 2.0, 0.5)),
            cuboid(v(0.8, 1.0, 0.8), v(1.0, 1.5, 1.0)),
        ] {
            is_open(&lamp, &shape);
        }
        assert!(!may_hide(DVec3::ZERO, DVec3::Y, &lamp, &Blocker::of(&ball(v(3.0, 2.0, 0.0), 0.9)).unwrap()));
    }
}

#[test]
fn what_is_between_hides_it_all() {
    for lamp in lamps() {
        is_dark(&lamp, &ball(v(0.0, 1.7, 0.0), 1.2));
        is_dark(&lamp, &disk(v(0.0, 2.0, 0.0), v(0.1, 1.0, 0.0), 1.2));
        is_dark(&lamp, &square(v(0.0, 2.0, 0.0)));
        is_dark(&lamp, &cuboid(v(-1.0, 1.0, -1.0), v(1.0, 2.0, 1.0)));
        is_dark(&lamp, &plane(v(0.0, 2.0, 0.0), v(0.1, 1.0, 0.0)));
    }
}

#[test]
fn only_what_of_a_flat_blocker_is_before_the_lamps_plane_hides() {
    let [flat, round, _] = lamps();
    // From above the lamp down to a third of the way: what lies above the plane would hide half of the lamp.
    let tilted = |length: f64| -> Shape {
        let along = v(0.0, 1.0, 0.05).normalize() * length;
        Rectangle::new(v(-2.0, 3.9, 0.1), v(4.0, 0.0, 0.0), along).unwrap().into()
    };
    for lamp in [flat, round] {
        assert_eq!(past(&lamp, &tilted(0.5)), past(&lamp, &tilted(3.0)));
    }
}

#[test]
fn what_lies_in_the_lamps_plane_hides_nothing() {
    let [flat, round, _] = lamps();
    for lamp in [flat, round] {
        for at in [v(0.0, 4.0, 0.0), v(1.0, 4.0, 0.5), v(2.0, 4.0, 0.0)] {
            is_open(&lamp, &square(at));
            is_open(&lamp, &disk(at, DVec3::Y, 1.0));
        }
        is_open(&lamp, &plane(v(3.0, 4.0, 0.0), DVec3::Y));
        is_open(&lamp, &cuboid(v(-1.0, 4.0, -1.0), v(1.0, 5.0, 1.0)));
    }
}

#[test]
fn a_box_through_the_lamps_plane_hides_with_what_is_before_it() {
    let [flat, round, _] = lamps();
    for lamp in [flat, round] {
        is_part(&lamp, &cuboid(v(0.1, 3.0, -2.0), v(2.0, 5.0, 2.0)));
        is_open(&lamp, &cuboid(v(1.1, 3.9, -2.0), v(2.0, 8.0, 2.0)));
    }
}

#[test]
fn a_ball_through_the_lamps_plane_is_before_the_lamp_or_beyond_by_the_plane_between() {
    let [flat, round, _] = lamps();
    for lamp in [flat, round] {
        // Beside the lamp and lower than it, so that from under it hides a part, and from above nothing.
        let shape = ball(v(1.3, 3.5, 0.0), 0.55);
        let blocker = Blocker::of(&shape).unwrap();
        let at = v(2.4, 3.2, 0.0);
        let whole = open(at, DVec3::NEG_X, &lamp);
        let value =
            visible(at, DVec3::NEG_X, &lamp, &[(&blocker, Leaving::Nothing)], &mut Scratch::default());
        assert!(value.unwrap() < 0.9 * whole, "{value:?} {whole}");
        // Behind the lamp's edge as seen from under it.
        is_open(&lamp, &ball(v(1.8, 4.2, 0.0), 0.8));
    }
}

#[test]
fn what_touches_or_cuts_the_lamp_has_no_closed_form_where_it_overlaps() {
    let [flat, round, sphere] = lamps();
    for lamp in [&flat, &round] {
        assert_eq!(past(lamp, &ball(v(0.5, 4.0, 0.0), 0.3)), Err(NoClosedForm::Touches));
        assert_eq!(past(lamp, &disk(v(0.5, 4.0, 0.0), v(1.0, 0.5, 0.0), 0.3)), Err(NoClosedForm::Touches));
    }
    assert_eq!(past(&sphere, &ball(v(0.0, 3.0, 0.2), 0.3)), Err(NoClosedForm::Touches));
    assert_eq!(past(&sphere, &disk(v(0.5, 3.5, 0.0), DVec3::Y, 0.5)), Err(NoClosedForm::Touches));
    assert_eq!(past(&sphere, &square(v(0.5, 3.5, 0.0))), Err(NoClosedForm::Touches));
    assert_eq!(past(&sphere, &cuboid(v(0.0, 3.2, 0.0), v(0.5, 3.5, 0.5))), Err(NoClosedForm::Touches));
    assert_eq!(past(&sphere, &plane(v(0.0, 3.5, 0.0), DVec3::Y)), Err(NoClosedForm::CutsSphere));
    // On the far side of the lamp they touch it unseen.
    is_open(&flat, &ball(v(1.5, 4.0, 0.0), 0.3));
    is_open(&sphere, &disk(v(2.5, 3.5, 0.0), DVec3::Y, 0.5));
}

#[test]
fn a_plane_cuts_a_disk_straight() {
    let disk = Lamp::disk(v(0.0, 4.0, 0.0), DVec3::NEG_Y, 1.0).unwrap();
    let value = past(&disk, &plane(v(0.0, 4.0, 0.0), v(1.0, -1e-300, 0.0))).unwrap();
    // The point lies in it: it hides nothing. A little aside it hides one half.
    assert_eq!(value, open(DVec3::ZERO, DVec3::Y, &disk));
    let aside = past(&disk, &plane(v(1e-9, 0.0, 0.0), v(1.0, 0.0, 0.0))).unwrap();
    assert!((aside / value - 0.5).abs() < 1e-9);
}

#[test]
fn spheres_that_shine_are_parted_from_flat_blockers_by_their_own_plane_or_one_between() {
    let sphere = Lamp::sphere(v(0.0, 4.0, 0.0), 1.0).unwrap();
    is_part(&sphere, &square(v(1.0, 2.9, 0.0)));
    // Its plane cuts the lamp, a plane between does not.
    is_part(&sphere, &upright(v(-0.4, 0.9, -1.0)));
    is_part(&sphere, &disk(v(0.2, 2.0, 0.0), DVec3::X, 0.8));
    is_open(&sphere, &upright(v(-0.1, 5.5, -1.0)));
}

#[test]
fn within_a_ball_the_lamp_within_is_seen_and_that_outside_is_not() {
    let [flat, round, sphere] = lamps();
    for lamp in [flat, round, sphere] {
        is_open(&lamp, &ball(DVec3::ZERO, 6.0));
        is_dark(&lamp, &ball(DVec3::ZERO, 2.0));
        assert_eq!(past(&lamp, &ball(DVec3::ZERO, 4.1)), Err(NoClosedForm::PartlyWithin));
        // Round the lamp and not the point.
        is_dark(&lamp, &ball(v(0.0, 4.0, 0.0), 2.0));
    }
}

#[test]
fn a_point_on_a_ball_sees_outwards_and_inwards_what_it_should() {
    let own = ball(v(0.0, -3.0, 0.0), 3.0);
    let round_all = ball(v(0.0, 5.0, 0.0), 5.0);
    let between = ball(v(0.0, 1.0, 0.0), 1.0);
    for lamp in lamps() {
        let whole = open(DVec3::ZERO, DVec3::Y, &lamp);
        assert_eq!(leaving(&lamp, DVec3::Y, &own, Leaving::Facet(0)), Ok(whole));
        assert_eq!(leaving(&lamp, DVec3::Y, &round_all, Leaving::Facet(0)), Ok(whole));
        assert_eq!(leaving(&lamp, DVec3::Y, &between, Leaving::Facet(0)), Ok(0.0));
    }
}

#[test]
fn a_point_on_a_solid_sees_outwards_all_and_inwards_what_is_within() {
    let under = cuboid(v(-1.0, -1.0, -1.0), v(1.0, 0.0, 1.0));
    let room = cuboid(v(-3.0, 0.0, -3.0), v(3.0, 6.0, 3.0));
    let low = cuboid(v(-3.0, 0.0, -3.0), v(3.0, 2.0, 3.0));
    let hill = Tetrahedron::new(DVec3::Y * -1.0, v(3.0, 0.0, 0.0), v(-2.0, 0.0, 2.0), v(-2.0, 0.0, -2.0));
    let hill: Shape = hill.unwrap().into();
    for lamp in lamps() {
        let whole = open(DVec3::ZERO, DVec3::Y, &lamp);
        for on in [Leaving::Facet(3), Leaving::Nothing] {
            assert_eq!(leaving(&lamp, DVec3::Y, &under, on), Ok(whole));
        }
        assert_eq!(leaving(&lamp, DVec3::Y, &hill, Leaving::Facet(0)), Ok(whole));
        for on in [Leaving::Facet(2), Leaving::Nothing] {
            assert_eq!(leaving(&lamp, DVec3::Y, &room, on), Ok(whole));
            assert_eq!(leaving(&lamp, DVec3::Y, &low, on), Ok(0.0));
        }
    }
}

#[test]
fn flat_shapes_that_hold_the_point_hide_nothing() {
    for lamp in lamps() {
        let whole = open(DVec3::ZERO, DVec3::Y, &lamp);
        for shape in [square(DVec3::ZERO), disk(DVec3::ZERO, DVec3::Y, 1.0), plane(DVec3::ZERO, DVec3::Y)] {
            for on in [Leaving::Facet(0), Leaving::Nothing] {
                assert_eq!(leaving(&lamp, DVec3::Y, &shape, on), Ok(whole));
            }
        }
    }
}

#[test]
fn a_flat_box_hides_as_its_rectangle_does() {
    for lamp in lamps() {
        let flat = cuboid(v(0.1, 2.0, -1.0), v(1.0, 2.0, 1.0));
        let same = Rectangle::new(v(0.1, 2.0, -1.0), v(0.9, 0.0, 0.0), v(0.0, 0.0, 2.0)).unwrap().into();
        let (a, b) = (past(&lamp, &flat).unwrap(), past(&lamp, &same).unwrap());
        assert!((a - b).abs() < 1e-15);
        is_open(&lamp, &cuboid(v(0.0, 2.0, 0.0), v(0.0, 2.0, 1.0)));
    }
}

#[test]
fn a_lamp_in_a_body_of_its_own_is_seen_from_outside() {
    // The faces of a box that shines, and the box itself in the way of its other faces.
    let body = cuboid(v(-1.0, 4.0, -1.0), v(1.0, 5.0, 1.0));
    let sum: f64 = (0..6).map(|facet| past(&Lamp::of(&body, facet).unwrap(), &body).unwrap()).sum();
    assert!((sum - open(DVec3::ZERO, DVec3::Y, &lamps()[0])).abs() < 1e-15);
}
