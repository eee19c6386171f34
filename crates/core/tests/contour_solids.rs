//! Does the closed form know what cylinders, cones, capsules and many-sided solids hide, and where it does not, does it say so?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[allow(dead_code, reason = "other tests of contours use the rest")]
mod quadrature;

use std::f64::consts::PI;

use catoptra_core::Shape;
use catoptra_core::contour::{Blocker, Lamp, Leaving, NoClosedForm, Scratch, facet_holds, open, visible};
use catoptra_core::geometry::{Capsule, Cone, Cylinder, Polyhedron, Prism, Rectangle, Torus};
use catoptra_core::glam::{DVec2, DVec3};
use quadrature::{Random, Rule, Swept};

/// What is seen of a lamp past shapes, all of which have outlines.
fn past(at: DVec3, normal: DVec3, lamp: &Lamp, shapes: &[Shape]) -> Result<f64, NoClosedForm> {
    let blockers: Vec<_> = shapes.iter().map(|shape| Blocker::of(shape).unwrap()).collect();
    let list: Vec<_> = blockers.iter().map(|blocker| (blocker, Leaving::Nothing)).collect();
    visible(at, normal, lamp, &list, &mut Scratch::default())
}

#[test]
fn closed_forms_are_those_of_quadrature() {
    let (mut given_up, mut hidden) = (0, 0);
    for seed in 0..200_u64 {
        let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        random.share();
        let shape = random.lamp();
        let (point, two_sided) = (random.vector() * 0.5, random.below(2) == 0);
        let normal = if random.below(2) == 0 { DVec3::Y } else { random.unit() };
        let count = 1 + random.below(4);
        let shapes: Vec<Shape> = (0..count).map(|_| random.solid(point, &shape)).collect();
        let lamp = Lamp::of(&shape, 0).unwrap().with_two_sides(two_sided);
        let whole = open(point, normal, &lamp);
        let Ok(value) = past(point, normal, &lamp, &shapes) else {
            given_up += 1;
            continue;
        };
        assert!((0.0..=whole).contains(&value), "{seed}: {value} of {whole}");
        // Few stripes may miss what is thin.
        let swept = Swept::of(&shape, two_sided);
        let rule = Rule::new(point, normal, &swept, &shapes);
        let error = |stripes: u32| (value - rule.value(1e-9, stripes)).abs();
        assert!(
            error(4) <= 1e-8 || error(1000) <= 1e-8,
            "{seed}: {value} of {whole}, off by {} {shapes:?}",
            error(1000)
        );
        hidden += u32::from(value < 0.99 * whole);
    }
    assert!(given_up < 40 && hidden > 80, "{given_up} without closed form, {hidden} hidden");
}

/// 2 x 2 m, 4 m above zero, shining down.
fn panel() -> Lamp {
    let panel = Rectangle::new(DVec3::new(-1.0, 4.0, -1.0), DVec3::X * 2.0, DVec3::Z * 2.0).unwrap();
    Lamp::of(&panel.into(), 0).unwrap().with_two_sides(true)
}

#[test]
fn a_wide_cylinder_before_a_lamp_hides_all_of_it_and_a_pillar_beside_it_nothing() {
    let see = |shape: Cylinder| past(DVec3::ZERO, DVec3::Y, &panel(), &[shape.into()]).unwrap();
    let whole = open(DVec3::ZERO, DVec3::Y, &panel());
    assert_eq!(see(Cylinder::new(DVec3::Y, DVec3::Y * 2.0, 3.0).unwrap()), 0.0);
    let beside = DVec3::X * 9.0;
    assert_eq!(see(Cylinder::new(beside, beside + DVec3::Y * 9.0, 1.0).unwrap()), whole);
    // Along its axis a cylinder hides what its near cap does.
    let narrow = see(Cylinder::new(DVec3::Y, DVec3::Y * 3.0, 0.125).unwrap());
    let cap = PI * 0.125_f64.powi(2) / (1.0 + 0.125_f64.powi(2));
    assert!((whole - narrow - cap).abs() < 1e-13, "{whole} {narrow} {cap}");
}

#[test]
fn on_its_own_surface_a_solid_hides_what_is_behind_it() {
    let shapes: [(Shape, DVec3, DVec3, u32); 4] = [
        (Cylinder::new(DVec3::NEG_Y, DVec3::Y * 0.5, 0.5).unwrap().into(), DVec3::Y * 0.5, DVec3::Y, 2),
        (Cylinder::new(DVec3::NEG_X, DVec3::X, 0.5).unwrap().into(), DVec3::Y * 0.5, DVec3::Y, 0),
        (Capsule::new(DVec3::NEG_X, DVec3::X, 0.5).unwrap().into(), DVec3::new(1.0, 0.5, 0.0), DVec3::Y, 2),
        (
            Cone::new(DVec3::ZERO, DVec3::Y, 1.0, 0.0).unwrap().into(),
            DVec3::new(0.5, 0.5, 0.0),
            DVec3::new(1.0, 1.0, 0.0).normalize(),
            0,
        ),
    ];
    for (shape, at, normal, facet) in shapes {
        assert!(facet_holds(&shape, facet, at), "{shape:?}");
        let blocker = Blocker::of(&shape).unwrap();
        let whole = open(at, normal, &panel());
        for leaving in [Leaving::Facet(facet), Leaving::Nothing] {
            let seen = visible(at, normal, &panel(), &[(&blocker, leaving)], &mut Scratch::default());
            assert_eq!(seen, Ok(whole), "{shape:?}");
        }
        let inwards =
            visible(at, -normal, &panel(), &[(&blocker, Leaving::Facet(facet))], &mut Scratch::default());
        assert!(inwards == Ok(0.0) || inwards == Err(NoClosedForm::Within), "{shape:?}: {inwards:?}");
    }
}

#[test]
fn within_a_solid_and_around_a_lamp_there_is_no_closed_form() {
    let around = |from: DVec3, to: DVec3| Cylinder::new(from, to, 5.0).unwrap().into();
    let see = |shape: Shape| past(DVec3::ZERO, DVec3::Y, &panel(), &[shape]);
    assert_eq!(see(around(DVec3::NEG_Y, DVec3::Y)), Err(NoClosedForm::Within));
    assert_eq!(see(around(DVec3::Y * 3.0, DVec3::Y * 5.0)), Err(NoClosedForm::Touches));
}

#[test]
fn what_has_no_convex_outline_is_left_to_sampling() {
    let (o, y) = (DVec3::ZERO, DVec3::Y);
    let dart = [[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]].map(DVec2::from);
    let many = (0..70).map(|i| DVec3::new(f64::from(i).cos(), f64::from(i).sin(), f64::from(i % 2)));
    let shapes: [Shape; 5] = [
        Cylinder::new(o, y, 1.0).unwrap().opened().into(),
        Cone::new(o, y, 1.0, 0.5).unwrap().opened().into(),
        Torus::new(o, y, 1.0, 0.25).unwrap().into(),
        Prism::new(dart, 1.0, o, y).unwrap().into(),
        Polyhedron::hull_of(many).unwrap().into(),
    ];
    for shape in shapes {
        assert_eq!(Blocker::of(&shape), None, "{shape:?}");
    }
}

#[test]
fn solids_with_flat_faces_shine_by_each_of_them() {
    let cube = Prism::new(
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from),
        1.0,
        DVec3::ZERO,
        DVec3::Y,
    );
    let area = |shape: &Shape| Lamp::pieces_of(shape).map(|lamp| lamp.area()).sum::<f64>();
    assert!((area(&cube.unwrap().into()) - 6.0).abs() < 1e-12);
    // 30 √3 / 2 times the square of the edge, times two: 5 √3 a², with a radius of a sin(2π/5).
    let solid = catoptra_core::geometry::Platonic::new("icosahedron", DVec3::ZERO, 1.0).unwrap();
    let edge = 1.0 / (0.4 * PI).sin();
    assert!((area(&solid.into()) - 5.0 * 3.0_f64.sqrt() * edge * edge).abs() < 1e-12);
}
