//! Is the light that a lamp sends past blockers what theory knows?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::PI;

use catoptra_core::Shape;
use catoptra_core::contour::{Blocker, Lamp, Leaving, NoClosedForm, Scratch, open, visible};
use catoptra_core::geometry::{Cuboid, Disk, Plane, Rectangle, Sphere, Triangle};
use catoptra_core::glam::DVec3;

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A rectangle across the y axis that faces down.
fn ceiling(x: [f64; 2], y: f64, z: [f64; 2]) -> Shape {
    Rectangle::new(v(x[0], y, z[0]), v(x[1] - x[0], 0.0, 0.0), v(0.0, 0.0, z[1] - z[0])).unwrap().into()
}

fn lamp(shape: &Shape) -> Lamp {
    Lamp::of(shape, 0).unwrap()
}

fn ball(x: f64, y: f64, z: f64, radius: f64) -> Shape {
    Sphere::new(v(x, y, z), radius).unwrap().into()
}

fn past(at: DVec3, normal: DVec3, lamp: &Lamp, shapes: &[Shape]) -> Result<f64, NoClosedForm> {
    let blockers: Vec<_> = shapes.iter().map(|shape| Blocker::of(shape).unwrap()).collect();
    let list: Vec<_> = blockers.iter().map(|blocker| (blocker, Leaving::Nothing)).collect();
    visible(at, normal, lamp, &list, &mut Scratch::default())
}

#[track_caller]
fn close(given: f64, truth: f64, off: f64) {
    assert!((given - truth).abs() <= off, "{given} is not {truth}");
}

#[test]
fn a_lamp_in_a_black_room() {
    let lamp = lamp(&ceiling([1.5, 2.5], 3.0, [1.5, 2.5]));
    let wall = [(2.75, 32.676898), (2.25, 75.193925), (1.75, 81.323172), (0.25, 40.001852)];
    for (y, truth) in wall {
        close(1000.0 * open(v(2.0, y, 0.0), DVec3::Z, &lamp), truth, 1e-6);
    }
    for (z, truth) in [(0.25, 61.424099), (0.75, 79.255157), (1.25, 95.667276), (1.75, 105.778242)] {
        close(1000.0 * open(v(2.0, 0.0, z), DVec3::Y, &lamp), truth, 1e-6);
    }
}

#[test]
fn balls_under_a_lamp() {
    let lamp = lamp(&ceiling([-5.0, 5.0], 12.0, [-5.0, 5.0]));
    let one = [ball(0.0, 3.0, 0.0, 3.0)];
    let three = [one[0].clone(), ball(2.5, 6.0, 1.0, 1.5), ball(-1.0, 7.0, 2.0, 1.0)];
    let under = |x: f64, z: f64, shapes: &[Shape]| 4.0 * past(v(x, 0.0, z), DVec3::Y, &lamp, shapes).unwrap();
    close(under(4.0, 0.0, &[]), 1.952653997, 1e-9);
    close(under(4.0, 0.0, &one), 1.167855918, 1e-9);
    close(under(4.0, 4.0, &one), 1.524903322, 1e-9);
    close(under(7.0, 0.0, &one), 1.452705771, 1e-9);
    close(under(2.0, 0.0, &one), 0.0, 0.0);
    assert_eq!(under(9.0, -3.0, &one), under(9.0, -3.0, &[]));
    close(under(4.0, 4.0, &three), 1.016386177, 1e-9);
    close(under(-3.0, 3.5, &three), 1.228170730, 1e-9);
    close(under(5.0, -1.0, &three), 1.099079319, 1e-9);
    close(under(2.0, 0.0, &three), 0.0, 0.0);
}

#[test]
fn a_square_and_a_ball_under_a_lamp() {
    let lamp = lamp(&ceiling([-5.0, 5.0], 12.0, [-5.0, 5.0]));
    let shapes = [ceiling([-2.0, 2.0], 5.0, [-2.0, 2.0]), ball(1.0, 8.0, 1.0, 1.2)];
    let truths =
        [(0.0, 0.0, 0.146451544), (3.0, 0.0, 1.033660487), (3.0, 3.0, 1.340988830), (5.0, 1.0, 1.348796020)];
    for (x, z, truth) in truths {
        close(4.0 * past(v(x, 0.0, z), DVec3::Y, &lamp, &shapes).unwrap(), truth, 1e-9);
    }
}

#[test]
fn a_ball_that_shines() {
    let lamp = Lamp::sphere(v(0.0, 2.0, 0.0), 0.5).unwrap();
    for (at, truth) in [
        (v(0.0, 0.0, 0.0), PI / 16.0),
        (v(1.0, 0.0, 0.0), 0.140496295),
        (v(3.0, 0.0, 0.0), 0.033512347),
        (v(-2.0, 2.3, 0.0), 0.001166140),
    ] {
        close(open(at, DVec3::Y, &lamp), truth, 1e-9);
    }
    let before = [ball(0.4, 1.0, 0.0, 0.4)];
    for (at, truth) in [
        (v(0.0, 0.0, 0.0), 0.111456517),
        (v(-0.5, 0.0, 0.0), 0.170455819),
        (v(0.3, 0.0, 0.3), 0.051905262),
        (v(0.9, 0.0, 0.0), 0.0),
    ] {
        close(past(at, DVec3::Y, &lamp, &before).unwrap(), truth, 1e-9);
    }
}

#[test]
fn a_disk_behind_a_disk_on_one_axis() {
    let lamp = lamp(&Disk::new(v(0.0, 3.0, 0.0), DVec3::NEG_Y, 2.0).unwrap().into());
    let before = [Disk::new(v(0.0, 1.0, 0.0), DVec3::Y, 0.5).unwrap().into()];
    let sine2 = |radius: f64, height: f64| radius * radius / (radius * radius + height * height);
    let truth = PI * (sine2(2.0, 3.0) - sine2(0.5, 1.0));
    close(past(DVec3::ZERO, DVec3::Y, &lamp, &before).unwrap(), truth, 1e-15);
    let same_outline = [Disk::new(v(0.0, 1.5, 0.0), DVec3::Y, 1.0).unwrap().into()];
    close(past(DVec3::ZERO, DVec3::Y, &lamp, &same_outline).unwrap(), 0.0, 1e-15);
}

#[test]
fn a_box_stands_between_two_walls() {
    let wall = Rectangle::new(v(0.0, 0.0, 4.0), v(0.0, 3.0, 0.0), v(4.0, 0.0, 0.0)).unwrap().into();
    let solid = [Cuboid::new(v(0.0, 0.0, 2.5), v(4.0, 1.0, 2.7)).unwrap().into()];
    for (y, truth) in [(2.75, 16.070642), (2.25, 16.329677), (1.25, 13.322018), (0.25, 7.078969)] {
        let given = past(v(2.0, y, 0.0), DVec3::Z, &lamp(&wall), &solid).unwrap();
        close(100.0 / PI * given, truth, 1e-6);
    }
}

#[test]
fn a_floor_that_shines_ends_at_the_horizon_of_its_walls() {
    let floor = Rectangle::new(DVec3::ZERO, v(0.0, 0.0, 4.0), v(4.0, 0.0, 0.0)).unwrap().into();
    let walls = [
        Plane::new(DVec3::ZERO, DVec3::Z).unwrap().into(),
        Plane::new(v(0.0, 0.0, 4.0), DVec3::Z).unwrap().into(),
        Plane::new(v(4.0, 0.0, 4.0), DVec3::X).unwrap().into(),
    ];
    for (y, truth) in [(0.75, 35.900505), (1.25, 27.991624), (1.75, 21.638511), (2.75, 12.967372)] {
        close(100.0 / PI * past(v(2.0, y, 0.0), DVec3::Z, &lamp(&floor), &walls).unwrap(), truth, 1e-6);
    }
    for (z, truth) in [(0.25, 26.795188), (1.25, 33.975719), (1.75, 35.566592)] {
        close(100.0 / PI * past(v(2.0, 3.0, z), DVec3::NEG_Y, &lamp(&floor), &walls).unwrap(), truth, 1e-6);
    }
}

#[test]
fn edges_that_coincide_count_once() {
    let (at, lamp) = (v(0.3, 0.0, 0.2), lamp(&ceiling([-1.0, 1.0], 3.0, [-1.0, 1.0])));
    let over = |shapes: &[Shape]| past(at, DVec3::Y, &lamp, shapes).unwrap();
    // As the eye sees them at half the height, these end where the lamp does.
    let (low, mid, high) = ((at.x - 1.0) / 2.0, at.x / 2.0, (at.x + 1.0) / 2.0);
    let z = [(at.z - 1.0) / 2.0, (at.z + 1.0) / 2.0];
    let (left, right) = (ceiling([low, mid], 1.5, z), ceiling([mid, high], 1.5, z));
    let whole = open(at, DVec3::Y, &lamp);
    close(over(&[left.clone(), right.clone()]), 0.0, 1e-15);
    close(over(&[left.clone(), left.clone()]), over(std::slice::from_ref(&left)), 1e-15);
    close(over(&[left]) + over(&[right]), whole, 1e-15);
    close(over(&[ceiling([low, high], 1.5, z)]), 0.0, 1e-15);
    close(over(&[ceiling([high, high + 1.0], 1.5, z)]), whole, 1e-15);
    let half = Triangle::new(v(low, 1.5, z[0]), v(high, 1.5, z[0]), v(high, 1.5, z[1])).unwrap().into();
    let rest = Triangle::new(v(low, 1.5, z[0]), v(high, 1.5, z[1]), v(low, 1.5, z[1])).unwrap().into();
    close(over(&[half, rest]), 0.0, 1e-15);
}
