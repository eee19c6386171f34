//! Does the closed form stay in its bounds where the input is degenerate, tiny or huge, and does it agree with itself?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[allow(dead_code, reason = "other tests of contours use the rest")]
mod quadrature;

use std::f64::consts::PI;

use catoptra_core::contour::{Blocker, Lamp, Leaving, NoClosedForm, Scratch, open, visible};
use catoptra_core::geometry::{Cuboid, Disk, Plane, Rectangle, Sphere, Triangle};
use catoptra_core::glam::DVec3;
use catoptra_core::{Placement, Shape};
use quadrature::{Random, Rule, Swept};

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn past(at: DVec3, normal: DVec3, lamp: &Lamp, shapes: &[Shape]) -> Result<f64, NoClosedForm> {
    let blockers: Vec<_> = shapes.iter().map(|shape| Blocker::of(shape).unwrap()).collect();
    let list: Vec<_> = blockers.iter().map(|blocker| (blocker, Leaving::Nothing)).collect();
    visible(at, normal, lamp, &list, &mut Scratch::default())
}

fn rectangle(corner: DVec3, u: DVec3, v: DVec3) -> Shape {
    Rectangle::new(corner, u, v).unwrap().into()
}

/// A lamp, a point that looks at it, and things between, not too many.
struct Room {
    point: DVec3,
    normal: DVec3,
    lamp: Shape,
    shapes: Vec<Shape>,
}

impl Room {
    fn new(seed: u64, most: u32) -> Self {
        let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 77);
        random.share();
        let (lamp, point) = (random.lamp(), random.vector() * 0.5);
        let normal = if random.below(2) == 0 { DVec3::Y } else { random.unit() };
        let shapes = (0..=random.below(most)).map(|_| random.blocker(point, &lamp)).collect();
        Self { point, normal, lamp, shapes }
    }

    fn lamp(&self) -> Lamp {
        Lamp::of(&self.lamp, 0).unwrap().with_two_sides(true)
    }

    fn value(&self) -> Option<f64> {
        past(self.point, self.normal, &self.lamp(), &self.shapes).ok()
    }
}

/// Rooms with a closed form and light.
fn rooms(count: u64, most: u32) -> impl Iterator<Item = (Room, f64)> {
    let all = (0..count).map(move |seed| Room::new(seed, most));
    all.filter_map(|room| room.value().filter(|&value| value > 0.0).map(|value| (room, value)))
}

#[track_caller]
fn close(given: f64, truth: f64, off: f64) {
    assert!((given - truth).abs() <= off, "{given} is not {truth}: {:e}", (given - truth).abs());
}

#[test]
fn values_are_exact_to_1e_12() {
    let mut tried = 0;
    for (room, value) in rooms(100, 3) {
        let swept = Swept::of(&room.lamp, true);
        let rule = Rule::new(room.point, room.normal, &swept, &room.shapes);
        // Kinks that the rule finds with difficulty show by its own two answers.
        let (truth, again) = (rule.value(1e-13, 16), rule.value(1e-13, 23));
        if (truth - again).abs() < 1e-13 {
            close(value, truth, 1e-12);
            tried += 1;
        }
    }
    assert!(tried > 20, "{tried}");
}

#[test]
fn the_order_of_blockers_does_not_matter() {
    for (mut room, value) in rooms(400, 8) {
        room.shapes.reverse();
        close(room.value().unwrap(), value, 1e-12);
    }
}

#[test]
fn one_more_blocker_never_makes_it_brighter() {
    for (mut room, value) in rooms(400, 8) {
        room.shapes.pop();
        let Some(less) = room.value() else { continue };
        assert!(value <= less + 1e-13, "{value} {less}");
        assert!(less <= open(room.point, room.normal, &room.lamp()));
    }
}

#[test]
fn a_blocker_twice_is_as_once() {
    for (mut room, value) in rooms(400, 4) {
        room.shapes.extend(room.shapes.clone());
        close(room.value().unwrap(), value, 1e-12);
    }
}

#[test]
fn turning_moving_and_scaling_the_world_changes_nothing() {
    for (i, (room, value)) in rooms(300, 6).enumerate() {
        let mut random = Random(i as u64 + 9);
        random.share();
        let turned = Placement::IDENTITY.turned(DVec3::ZERO, random.unit(), random.within(0.0, 6.0)).unwrap();
        let placement = turned.scaled(10.0_f64.powf(random.within(-3.0, 3.0))).unwrap();
        let placement = placement.moved(random.vector() * placement.scale() * 3.0).unwrap();
        let moved = Room {
            point: placement.point(room.point),
            normal: placement.direction(room.normal),
            lamp: room.lamp.placed(&placement),
            shapes: room.shapes.iter().map(|shape| shape.placed(&placement)).collect(),
        };
        let Some(again) = moved.value() else { continue };
        close(again, value, 1e-10);
    }
}

#[test]
fn two_halves_of_a_lamp_give_the_whole() {
    let mut tried = 0;
    for (room, value) in rooms(600, 6) {
        let Shape::Rectangle(whole) = &room.lamp else { continue };
        let (corner, [u, w]) = (whole.corner(), whole.edges());
        let share = 0.37;
        let parts = [rectangle(corner, u * share, w), rectangle(corner + u * share, u * (1.0 - share), w)];
        let sum: Option<f64> =
            parts.into_iter().map(|lamp| Room { lamp, shapes: room.shapes.clone(), ..room }.value()).sum();
        let Some(sum) = sum else { continue };
        close(sum, value, 1e-10);
        tried += 1;
    }
    assert!(tried > 30, "{tried}");
}

#[test]
fn two_halves_of_a_blocker_hide_what_the_whole_hides() {
    let mut tried = 0;
    for (mut room, value) in rooms(600, 5) {
        let Some(at) = room.shapes.iter().position(|shape| matches!(shape, Shape::Rectangle(_))) else {
            continue;
        };
        let Shape::Rectangle(whole) = room.shapes.remove(at) else { continue };
        let (corner, [u, w]) = (whole.corner(), whole.edges());
        for [a, b, c] in [[corner, corner + u, corner + u + w], [corner, corner + u + w, corner + w]] {
            room.shapes.push(Triangle::new(a, b, c).unwrap().into());
        }
        let Some(again) = room.value() else { continue };
        close(again, value, 1e-10);
        tried += 1;
    }
    assert!(tried > 50, "{tried}");
}

#[test]
fn nothing_is_negative_more_than_open_or_not_a_number_in_degenerate_places() {
    let lamps: [Shape; 5] = [
        rectangle(v(-1.0, 2.0, -1.0), v(2.0, 0.0, 0.0), v(0.0, 0.0, 2.0)),
        Triangle::new(v(-1.0, 2.0, 0.0), v(1.0, 2.0, 0.0), v(0.0, 3.0, 0.0)).unwrap().into(),
        Disk::new(v(0.0, 2.0, 0.0), DVec3::NEG_Y, 1.0).unwrap().into(),
        Sphere::new(v(0.0, 2.0, 0.0), 1.0).unwrap().into(),
        Disk::new(v(0.0, 1.0, 0.0), DVec3::X, 1.0).unwrap().into(),
    ];
    let shapes: [Shape; 8] = [
        Plane::new(v(0.0, 1.0, 0.0), DVec3::Y).unwrap().into(),
        Plane::new(v(0.0, 1.0, 0.0), DVec3::X).unwrap().into(),
        Sphere::new(v(0.0, 1.0, 0.0), 1.0).unwrap().into(),
        Sphere::new(v(0.0, 1.0, 0.0), 0.5).unwrap().into(),
        Disk::new(v(0.0, 1.0, 0.0), DVec3::Y, 1.0).unwrap().into(),
        Disk::new(v(0.0, 1.0, 0.0), DVec3::X, 1.0).unwrap().into(),
        Cuboid::new(v(-1.0, 1.0, -1.0), v(0.0, 2.0, 0.0)).unwrap().into(),
        rectangle(v(0.0, 1.0, 0.0), v(0.0, 1.0, 0.0), v(0.0, 0.0, 1.0)),
    ];
    // Corners, edges, centres, planes and rims of all of them are among these.
    let steps = [-1.0, -0.5, 0.0, 1e-16, 0.5, 1.0, 1.0 + 1e-16];
    let mut scratch = Scratch::default();
    let blockers: Vec<_> = shapes.iter().map(|shape| Blocker::of(shape).unwrap()).collect();
    for scale in [1.0, 1e-12, 1e12, 1e60] {
        let placement = Placement::IDENTITY.scaled(scale).unwrap();
        let blockers: Vec<_> = match scale {
            1.0 => blockers.clone(),
            _ => shapes.iter().map(|shape| Blocker::of(&shape.placed(&placement)).unwrap()).collect(),
        };
        for shape in &lamps {
            for two_sided in [false, true] {
                let lamp = Lamp::of(&shape.placed(&placement), 0).unwrap().with_two_sides(two_sided);
                for i in 0..343 {
                    let at = v(steps[i % 7], 1.0 + steps[i / 7 % 7], steps[i / 49]) * scale;
                    for normal in [DVec3::Y, DVec3::X, v(0.6, 0.8, 0.0), DVec3::NEG_Y] {
                        let whole = open(at, normal, &lamp);
                        assert!((0.0..=PI).contains(&whole), "{whole} {at} {normal} {lamp:?}");
                        for k in 0..=blockers.len() {
                            let list: Vec<_> = match blockers.get(k) {
                                Some(blocker) => vec![(blocker, Leaving::Nothing)],
                                None => blockers.iter().map(|blocker| (blocker, Leaving::Nothing)).collect(),
                            };
                            if let Ok(value) = visible(at, normal, &lamp, &list, &mut scratch) {
                                assert!(
                                    (0.0..=whole).contains(&value),
                                    "{value} of {whole} {at} {lamp:?} {k}"
                                );
                            }
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn random_numbers_of_any_size_stay_in_bounds() {
    let mut random = Random(5);
    let mut scratch = Scratch::default();
    for _ in 0..3000 {
        let mut anywhere = || {
            let size = 10.0_f64.powf(random.within(-37.0, 37.0));
            random.vector() * size
        };
        let corners = [anywhere(), anywhere(), anywhere()];
        let (at, center, middle) = (anywhere(), anywhere(), anywhere());
        let radius = anywhere().length();
        let (Some(lamp), normal) = (Lamp::polygon(&corners), random.unit()) else { continue };
        let round = Lamp::disk(middle, normal, radius).unwrap();
        let ball: Shape = Sphere::new(center, radius).unwrap().into();
        let blocker = Blocker::of(&ball).unwrap();
        for lamp in [lamp, round, Lamp::sphere(middle, radius).unwrap()] {
            let whole = open(at, normal, &lamp);
            assert!((0.0..=PI).contains(&whole), "{whole}");
            if let Ok(value) = visible(at, normal, &lamp, &[(&blocker, Leaving::Nothing)], &mut scratch) {
                assert!((0.0..=whole).contains(&value), "{value} of {whole}");
            }
        }
    }
}

#[test]
fn small_lamps_keep_their_relative_precision() {
    for k in 1..=6 {
        // At 1 m a square and a disk of this size, aside and turned.
        let size = 10.0_f64.powi(-k);
        let (at, u) = (v(0.3, 0.9, 0.2), v(0.0, 0.6, 0.8));
        let w = u.cross(v(1.0, 0.0, 0.0)).normalize();
        let square = Lamp::of(&rectangle(at, u * size, w * size), 0).unwrap().with_two_sides(true);
        let swept = Swept::Flat { corner: at, edges: [u * size, w * size, DVec3::ZERO], two_sided: true };
        let truth = Rule::new(DVec3::ZERO, DVec3::Y, &swept, &[]).value(1e-16 * size * size, 2);
        close(open(DVec3::ZERO, DVec3::Y, &square) / truth, 1.0, 1e-15 / size);
        let disk = Lamp::disk(at, u.cross(w), size).unwrap().with_two_sides(true);
        let swept = Swept::Disk { center: at, axes: [u * size, w * size], two_sided: true };
        let truth = Rule::new(DVec3::ZERO, DVec3::Y, &swept, &[]).value(1e-16 * size * size, 2);
        close(open(DVec3::ZERO, DVec3::Y, &disk) / truth, 1.0, 1e-14);
    }
}

#[test]
fn values_are_continuous_where_outlines_touch() {
    let lamp = Lamp::of(&rectangle(v(-1.0, 4.0, -1.0), v(2.0, 0.0, 0.0), v(0.0, 0.0, 2.0)), 0).unwrap();
    // A ball that comes in over an edge of the lamp, then one that comes in over another ball's outline.
    let touching = |shift: f64, with: Option<Shape>| {
        // Tangent to the plane through the eye and the edge x = −1.
        let out = v(-4.0, -1.0, 0.0) / 17.0_f64.sqrt();
        let ball: Shape = Sphere::new(v(-0.5, 2.0, 0.0) + out * (0.3 - shift), 0.3).unwrap().into();
        let mut shapes = vec![ball];
        shapes.extend(with);
        past(DVec3::ZERO, DVec3::Y, &lamp, &shapes).unwrap()
    };
    let aside: Shape = Sphere::new(v(0.0, 2.0, 0.0), 0.3).unwrap().into();
    for with in [None, Some(aside)] {
        for k in 0..40 {
            let shift = 2.0_f64.powi(-14 - k);
            let (out, on, within) =
                (touching(-shift, with.clone()), touching(0.0, with.clone()), touching(shift, with.clone()));
            // The lens grows with the power 3/2 of its depth.
            close(out, on, 1e-15);
            close(within, on, shift.powf(1.5) + 1e-15);
        }
    }
}

#[test]
fn a_lamps_flux_is_its_area_times_pi() {
    // The walls of a closed box receive all that a lamp in it sends: by the midpoint rule.
    let walls: Shape = Cuboid::new(v(0.0, 0.0, 0.0), v(3.0, 2.0, 4.0)).unwrap().into();
    let lamps = [
        Lamp::of(&rectangle(v(1.0, 1.0, 1.5), v(0.8, 0.0, 0.0), v(0.0, 0.0, 1.2)), 0).unwrap(),
        Lamp::disk(v(1.5, 1.0, 2.0), v(1.0, 2.0, 0.5), 0.5).unwrap(),
        Lamp::sphere(v(1.5, 1.0, 2.0), 0.4).unwrap(),
    ];
    let (blocker, size, n) = (Blocker::of(&walls).unwrap(), v(3.0, 2.0, 4.0), 60);
    let mut scratch = Scratch::default();
    for lamp in lamps.iter().flat_map(|lamp| [lamp.clone(), lamp.clone().with_two_sides(true)]) {
        let mut sum = 0.0;
        for facet in 0..6_u32 {
            let axis = (facet / 2) as usize;
            let (u, w) = ((axis + 1) % 3, (axis + 2) % 3);
            let inwards = if facet % 2 == 0 { DVec3::AXES[axis] } else { -DVec3::AXES[axis] };
            for i in 0..n * n {
                let mut at = if facet % 2 == 0 { DVec3::ZERO } else { size };
                at[u] = size[u] * (f64::from(i % n) + 0.5) / f64::from(n);
                at[w] = size[w] * (f64::from(i / n) + 0.5) / f64::from(n);
                let on = [(&blocker, Leaving::Facet(facet))];
                let value = visible(at, inwards, &lamp, &on, &mut scratch).unwrap();
                sum += value * size[u] * size[w] / f64::from(n * n);
            }
        }
        close(sum / (PI * lamp.area()), 1.0, 1e-3);
    }
}
