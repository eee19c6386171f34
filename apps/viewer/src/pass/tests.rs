use std::sync::Arc;

use catoptra_core::scene::{Content, Edit};
use catoptra_core::{Rgb, Value};
use catoptra_tracer::{Backend, Control, Pool, Size, Snapshot, View, backends, render};

use super::*;
use crate::lighting::Lighting;

/// A floor under a point light two metres above its middle, seen from above, and a ball beside it.
const TEXT: &str = "camera \"c\" { eye 0 4 0.001; target 0 0 0 }\nmatte \"grey\" { color 0.5 }\n\
    matte \"red\" { color 0.8 0.1 0.1 }\npoint-light \"lamp\" { position 0 2 0; intensity 80 }\n\
    rectangle \"floor\" material=\"red\" { corner -5 0 5; edge-u 10 0 0; edge-v 0 0 -10 }\n\
    sphere \"ball\" material=\"grey\" { center 1 0 0; radius 0.3 }\n";

const SIZE: Size = Size::new(65, 49);
const MIDDLE: usize = 24 * 65 + 32;

/// What a pass paints of the scene.
fn painted(pass: &Pass) -> Painted {
    painted_by(pass, |_| LightParts::default())
}

/// The same, with these lights told apart.
fn painted_by(pass: &Pass, lights: impl Fn(&Scene) -> LightParts) -> Painted {
    let (scene, _) = catoptra_scene::parse(TEXT, "text", None).unwrap();
    let pool = Pool::new(2).unwrap();
    let snapshot = Snapshot::extract(&scene, &pool);
    let camera = scene.world_camera(scene.main_camera().unwrap()).unwrap();
    let view = View::new(camera, SIZE);
    let (mut film, control) = (Film::new(SIZE), Control::default());
    let backend: &'static dyn Backend = backends()[0];
    render(backend, &snapshot, &view, &mut film, &pool, &control).unwrap();
    let (own, lights) = (own_shapes(&scene), lights(&scene));
    let seen = Seen {
        film: &film,
        snapshot: &snapshot,
        view: &view,
        backend,
        own: &own,
        lights: &lights,
        pool: &pool,
        control: &control,
    };
    (pass.paint.unwrap())(&seen).unwrap()
}

fn numbers(pass: &Pass) -> Vec<f32> {
    painted(pass).numbers.unwrap().values
}

#[test]
fn every_pass_has_a_name_of_its_own_and_paints_all_pixels() {
    let names: std::collections::HashSet<&str> = PASSES.iter().map(|pass| pass.name).collect();
    assert_eq!(names.len(), PASSES.len());
    for pass in PASSES.iter().filter(|pass| pass.paint.is_some()) {
        let painted = painted(pass);
        assert_eq!(painted.colors.len(), SIZE.pixels(), "{}", pass.name);
        assert!(painted.numbers.is_none_or(|numbers| numbers.values.len() == SIZE.pixels()));
    }
}

#[test]
fn irradiance_under_a_point_light_is_intensity_over_the_square_of_the_distance() {
    let values = numbers(&irradiance::PASS);
    assert!((values[MIDDLE] - 20.0).abs() < 0.1, "{}", values[MIDDLE]);
    assert!(values[MIDDLE + 65 * 12] < 19.0);
}

#[test]
fn the_share_of_each_light_is_told_and_can_be_shown_alone() {
    let parts = |scene: &Scene, alone: bool| {
        let mut two = scene.clone();
        let lamp = two.entity_named("lamp").unwrap();
        let mut second = two.node(lamp).unwrap();
        second.name = "second".to_owned();
        let dim = two.light(lamp).unwrap().with("intensity", Value::Color(Rgb::grey(20.0))).unwrap();
        second.content = Content::Light(dim);
        second.id = None;
        two.apply(Edit::insert(second)).unwrap();
        let second = two.entity_named("second").unwrap();
        Arc::into_inner(LightParts::of(&two, &Lighting::default(), &[second], alone)).unwrap()
    };
    let both = painted_by(&irradiance::PASS, |scene| parts(scene, false)).numbers.unwrap();
    assert!((both.values[MIDDLE] - 25.0).abs() < 0.15, "{}", both.values[MIDDLE]);
    let words = both.words(MIDDLE, "floor");
    let lines: Vec<&str> = words.lines().collect();
    assert!(lines[0].ends_with("floor") && lines[1].starts_with("lamp: ") && lines[1].ends_with("(80 %)"));
    assert!(lines[2].starts_with("second: ") && lines[2].ends_with("(20 %)"), "{words}");
    let alone = painted_by(&irradiance::PASS, |scene| parts(scene, true)).numbers.unwrap();
    assert!((alone.values[MIDDLE] - 5.0).abs() < 0.05, "{}", alone.values[MIDDLE]);
    assert_eq!(alone.shares.len(), 2);
}

#[test]
fn a_floor_looks_upwards_and_lies_four_metres_below() {
    assert_eq!(painted(&normal::PASS).colors[MIDDLE], packed([0.5, 1.0, 0.5]));
    assert!((numbers(&depth::PASS)[MIDDLE] - 4.0).abs() < 1e-3);
}

#[test]
fn texture_coordinates_grow_along_the_edges() {
    let colors = painted(&uv::PASS).colors;
    let at = |i: usize, shift: u32| (colors[i] >> shift) & 0xff;
    // Apart by a few tenths, so that checks do not matter.
    assert!(at(MIDDLE - 20, 16) < at(MIDDLE, 16) && at(MIDDLE + 65 * 20, 8) < at(MIDDLE, 8));
}

#[test]
fn things_differ_in_colour_and_things_cost_work() {
    let colors = painted(&entity::PASS).colors;
    let different: std::collections::HashSet<u32> = colors.iter().copied().collect();
    assert_eq!(different.len(), 2);
    assert!(numbers(&work::TESTS).iter().sum::<f32>() > 0.0);
    assert!(numbers(&work::TIME).iter().all(|nanoseconds| *nanoseconds > 0.0));
    assert!(numbers(&work::SETTLED).iter().all(|settled| *settled >= 0.0));
}

#[test]
fn a_pass_that_nobody_waits_for_gives_up() {
    let (scene, _) = catoptra_scene::parse(TEXT, "text", None).unwrap();
    let pool = Pool::new(1).unwrap();
    let snapshot = Snapshot::extract(&scene, &pool);
    let view = View::new(scene.world_camera(scene.main_camera().unwrap()).unwrap(), SIZE);
    let (film, control) = (Film::new(SIZE), Control::default());
    control.cancel();
    let (backend, own): (&'static dyn Backend, OwnShapes) = (backends()[0], Arc::default());
    let lights = LightParts::default();
    let seen = Seen {
        film: &film,
        snapshot: &snapshot,
        view: &view,
        backend,
        own: &own,
        lights: &lights,
        pool: &pool,
        control: &control,
    };
    for pass in [normal::PASS, uv::PASS, irradiance::PASS, work::TESTS] {
        assert!((pass.paint.unwrap())(&seen).is_none(), "{}", pass.name);
    }
}
