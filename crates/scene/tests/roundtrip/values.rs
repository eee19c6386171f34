//! Does a changed value, placement or setting change its own spelling and no other?

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, Integrator, Settings};
use catoptra_core::{Camera, Extent, Placement, Rgb, Value};
use catoptra_scene::parse;

use super::{difference, edited, id, place, set_shape, start};

#[test]
fn a_changed_number_leaves_its_neighbours_spelled_as_they_were() {
    let text = edited(|scene| {
        set_shape(scene, "left", "center", Value::Vector(DVec3::new(-1.0, 0.75, 0.0)));
    });
    let (new, old) = difference(&text);
    assert_eq!(new, [r#"sphere "left" material="white" { center -1 0.75 0; radius 5e-1 }"#]);
    assert_eq!(old.len(), 1);
}

#[test]
fn a_changed_material_value_keeps_the_comment_behind_it() {
    let text = edited(|scene| {
        let red = scene.material_named("red").unwrap();
        let material = scene.material(red).with("diffuse", Value::Color(Rgb::new(0.9, 0.2, 0.1))).unwrap();
        scene.apply(Edit::Material(red, material)).unwrap();
    });
    assert_eq!(difference(&text).0, ["diffuse 0.9 0.2 0.1   // strong"]);
}

#[test]
fn a_value_that_was_left_out_is_added_in_its_place() {
    let text = edited(|scene| {
        let lamp = id(scene, "lamp");
        let light = scene.light(lamp).unwrap().with("falloff", Value::Number(2.0)).unwrap();
        scene.apply(Edit::Light(lamp, light)).unwrap();
    });
    let (new, old) = difference(&text);
    assert_eq!((new, old), (vec!["falloff 2"], vec![]));
}

#[test]
fn grey_light_becomes_coloured_and_angles_are_degrees() {
    let text = edited(|scene| {
        let lamp = id(scene, "lamp");
        let light = scene.light(lamp).unwrap();
        let light = light.with("intensity", Value::Color(Rgb::new(10.0, 5.0, 0.0))).unwrap();
        let light = light.with("inner", Value::Number(25.5_f64.to_radians())).unwrap();
        scene.apply(Edit::Light(lamp, light)).unwrap();
    });
    assert_eq!(difference(&text).0, ["intensity 10 5 0", "inner 25.5; outer 40.0"]);
}

#[test]
fn a_property_changes_where_it_stands() {
    let text = edited(|scene| {
        let lamp = id(scene, "lamp");
        let light = scene.light(lamp).unwrap().with("shadow", Value::Flag(true)).unwrap();
        scene.apply(Edit::Light(lamp, light)).unwrap();
    });
    assert_eq!(difference(&text).0, [r#"spot-light "lamp" shadow=#true {"#]);
}

#[test]
fn a_node_without_a_block_gets_one() {
    let text = edited(|scene| {
        set_shape(scene, "floor", "point", Value::Vector(DVec3::new(0.0, -1.0, 0.0)));
    });
    assert!(text.contains("plane \"floor\" material=\"white\" {\n    point 0 -1 0\n}\nspot-light"), "{text}");
}

#[test]
fn a_move_changes_the_move_that_is_there() {
    let text = edited(|scene| place(scene, "balls", |p| p.moved(DVec3::new(0.0, 2.0, 0.0)).unwrap()));
    assert_eq!(difference(&text).0, ["move 1 2 0    // to the right"]);
}

#[test]
fn a_move_is_added_where_there_was_none() {
    let text = edited(|scene| place(scene, "right", |p| p.moved(DVec3::new(0.25, 0.0, 0.0)).unwrap()));
    assert_eq!(difference(&text), (vec!["move 0.25 0 0"], vec![]));
}

#[test]
fn a_turn_is_spelled_as_steps_and_reads_back_to_within_rounding() {
    let (mut scene, mut file) = start();
    place(&mut scene, "balls", |p| {
        p.turned(DVec3::new(1.0, 0.0, 3.0), DVec3::new(1.0, 2.0, 0.5), 0.7).unwrap()
    });
    place(&mut scene, "right", |p| p.scaled(1.5).unwrap().turned(DVec3::ZERO, DVec3::Y, 1.0).unwrap());
    file.update(&scene);
    let (again, _) = parse(&file.text(), "again.kdl", None).unwrap();
    for name in ["balls", "right"] {
        let (new, old) =
            (again.placement(id(&again, name)).unwrap(), scene.placement(id(&scene, name)).unwrap());
        assert!((new.rotation() - old.rotation()).length() < 1e-15, "{name}");
        assert_eq!((new.translation(), new.scale()), (old.translation(), old.scale()), "{name}");
    }
    assert!(file.text().contains("// the other one"));
}

#[test]
fn turning_by_round_degrees_is_written_round() {
    let text = edited(|scene| {
        place(scene, "lamp", |p| p.turned(DVec3::ZERO, DVec3::Y, 30_f64.to_radians()).unwrap());
    });
    assert_eq!(difference(&text).0, ["turn 30 0 1 0"]);
}

#[test]
fn unmoved_again_the_step_goes() {
    let text = edited(|scene| place(scene, "balls", |_| Placement::IDENTITY));
    let (new, old) = difference(&text);
    assert_eq!((new, old), (vec![], vec!["move 1 0 0    // to the right"]));
}

#[test]
fn settings_change_or_appear() {
    let text = edited(|scene| {
        scene.apply(Edit::Settings(Settings::new(Rgb::new(0.0, 0.0, 0.1), 4).unwrap())).unwrap();
    });
    assert!(text.contains("settings { max-depth 4; background 0 0 0.1 } // three are enough"), "{text}");
    let (mut scene, mut file) = parse("// nothing yet\n", "empty.kdl", None).unwrap();
    scene.apply(Edit::Settings(Settings::default().with_max_depth(9).unwrap())).unwrap();
    file.update(&scene);
    assert_eq!(file.text(), "// nothing yet\nsettings {\n    max-depth 9\n}\n");
}

#[test]
fn an_occlusion_distance_comes_and_goes() {
    let text = "settings { integrator \"occlusion\"; occlusion-distance 2.50 } // near things alone\n";
    let (mut scene, mut file) = parse(text, "near.kdl", None).unwrap();
    let now = *scene.settings();
    assert_eq!((now.integrator(), now.occlusion_distance()), (Integrator::Occlusion, Some(2.5)));
    let unlimited = now.with_occlusion_distance(None).unwrap();
    scene.apply(Edit::Settings(unlimited)).unwrap();
    file.update(&scene);
    assert!(
        !file.text().contains("distance") && file.text().contains("// near things alone"),
        "{}",
        file.text()
    );
    assert_eq!(parse(&file.text(), "near.kdl", None).unwrap().0.settings(), &unlimited);
    scene.apply(Edit::Settings(now.with_integrator(Integrator::Whitted))).unwrap();
    file.update(&scene);
    assert!(file.text().contains("integrator \"whitted\"") && file.text().contains("occlusion-distance 2.5"));
}

#[test]
fn a_camera_that_becomes_orthographic_has_a_height_for_its_angle() {
    let text = edited(|scene| {
        let main = id(scene, "main");
        let camera = scene.camera(main).unwrap().with_extent(Extent::Height(4.0)).unwrap();
        scene.apply(Edit::Camera(main, camera)).unwrap();
    });
    let has = |words: &str| text.contains(words);
    assert!(has("projection \"orthographic\"") && has("height 4") && !has("fov"), "{text}");
}

#[test]
fn a_camera_that_aims_elsewhere_keeps_the_other_numbers() {
    let text = edited(|scene| {
        let main = id(scene, "main");
        let old = scene.camera(main).unwrap();
        let camera = Camera::looking(old.eye(), DVec3::NEG_Z, old.up_hint(), old.fov()).unwrap();
        scene.apply(Edit::Camera(main, camera)).unwrap();
    });
    assert!(text.contains("eye 0 1 5; ") && text.contains("fov 60") && !text.contains("target"), "{text}");
}
