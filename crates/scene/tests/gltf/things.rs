//! Lights and cameras.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use catoptra_core::glam::{DQuat, DVec3};
use catoptra_core::scene::Content;
use catoptra_core::{Camera, Extent, Light, Rgb, Triple, Value};
use catoptra_scene::model::Model;
use serde_json::{Value as Json, json};

use crate::builder::{Builder, warnings};

#[allow(clippy::needless_pass_by_value, reason = "values are made where they are given")]
fn lights(lights: Json) -> Builder {
    let mut file = Builder::new();
    let count = lights.as_array().unwrap().len();
    file.extension("KHR_lights_punctual", json!({ "lights": lights }));
    for i in 0..count {
        file.push("nodes", json!({ "extensions": { "KHR_lights_punctual": { "light": i } } }));
    }
    file
}

/// The light of a node in the world.
fn light(model: &Model, i: usize) -> Light {
    match &model.nodes[i].content {
        Content::Light(light) => light.placed(&model.nodes[i].placement),
        other => panic!("{other:?}"),
    }
}

#[test]
fn lights_shine_along_minus_z_in_the_units_of_the_file() {
    let mut file = lights(json!([
        { "type": "directional", "color": [1.0, 0.5, 0.25], "intensity": 4.0, "name": "sun" },
        { "type": "point", "intensity": 10.0, "range": 5.0 },
        { "type": "spot", "spot": { "innerConeAngle": 0.2, "outerConeAngle": 0.4 }, "intensity": 3.0 },
        { "type": "spot" },
    ]));
    // −z turned onto −y; scales do not count.
    let down = DQuat::from_rotation_x(-FRAC_PI_2).to_array();
    file.json["nodes"][0]["rotation"] = json!(down);
    file.json["nodes"][1]["translation"] = json!([1.0, 2.0, 3.0]);
    file.json["nodes"][2]["rotation"] = json!(down);
    file.json["nodes"][2]["scale"] = json!([2.0, 1.0, 5.0]);
    let model = file.read();
    assert_eq!(model.nodes[0].name, "sun");
    let sun = light(&model, 0);
    assert!((sun.direction().unwrap() + DVec3::Y).length() < 1e-12);
    assert_eq!(sun.color().rgb(), Rgb::new(4.0, 2.0, 1.0));
    let point = light(&model, 1);
    assert_eq!((point.position(), point.color().rgb()), (Some(DVec3::new(1.0, 2.0, 3.0)), Rgb::grey(10.0)));
    assert!(warnings(&model)[0].contains("range"));
    let spot = light(&model, 2);
    assert!((spot.direction().unwrap() + DVec3::Y).length() < 1e-12);
    // The formula of the extension: squared, linear in the cosine of the angle.
    for angle in [0.1_f64, 0.25, 0.39, 0.41] {
        let at = DVec3::new(angle.sin(), -angle.cos(), 0.0);
        let arrival = spot.arriving(Triple::new(at.x, at.y, at.z));
        let share = ((angle.cos() - 0.4_f64.cos()) / (0.2_f64.cos() - 0.4_f64.cos())).clamp(0.0, 1.0);
        let found = if arrival.lit { spot.irradiance(&arrival).x } else { 0.0 };
        assert!((found - 3.0 * share * share).abs() < 1e-9, "{angle}: {found}");
    }
    let Light::SpotLight(default) = light(&model, 3) else { panic!() };
    assert_eq!((default.inner(), default.outer()), (0.0, 2.0 * FRAC_PI_4));
}

/// The camera of a node in the world.
fn camera(model: &Model, i: usize) -> Camera {
    match &model.nodes[i].content {
        Content::Camera(camera) => camera.placed(&model.nodes[i].placement).unwrap(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn cameras_look_along_minus_z_with_y_upwards() {
    let mut file = Builder::new();
    file.push("cameras", json!({ "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } }));
    let turn = DQuat::from_rotation_y(FRAC_PI_2).to_array();
    file.push(
        "nodes",
        json!({ "name": "eye", "camera": 0, "rotation": turn, "translation": [1.0, 2.0, 3.0] }),
    );
    // As if seen in a mirror: the picture is not mirrored, but looks the other way.
    file.push("nodes", json!({ "camera": 0, "scale": [1.0, 1.0, -1.0] }));
    let model = file.read();
    let found = camera(&model, 0);
    assert_eq!((&*model.nodes[0].name, found.fov(), found.eye()), ("eye", 0.8, DVec3::new(1.0, 2.0, 3.0)));
    assert!((found.forward() + DVec3::X).length() < 1e-12 && (found.up() - DVec3::Y).length() < 1e-12);
    assert!((camera(&model, 1).forward() - DVec3::Z).length() < 1e-12);
}

#[test]
fn orthographic_cameras_see_twice_their_magnification_whatever_they_stand_in() {
    let mut file = Builder::new();
    let parallel = json!({ "xmag": 9.0, "ymag": 1.5, "znear": 0.0, "zfar": 10.0 });
    file.push("cameras", json!({ "type": "orthographic", "orthographic": parallel, "name": "plan" }));
    file.push("nodes", json!({ "scale": [4.0, 4.0, 4.0], "children": [1, 2] }));
    file.push("nodes", json!({ "camera": 0, "scale": [0.5, 0.5, 0.5], "translation": [0.0, 0.0, 2.0] }));
    file.push("nodes", json!({}));
    let model = file.read();
    let group = &model.nodes[0];
    let node = &group.members()[0];
    let Content::Camera(camera) = &node.content else { panic!("{node:?}") };
    let placed = camera.placed(&node.placement.then(&group.placement)).unwrap();
    assert_eq!((&*node.name, placed.extent(), placed.eye()), ("plan", Extent::Height(3.0), DVec3::Z * 8.0));
    file.json["cameras"][0]["orthographic"]["ymag"] = json!(0.0);
    assert!(
        file.refusal().contains("nodes[1].cameras[0].orthographic.ymag: height must be"),
        "{}",
        file.refusal()
    );
}

#[test]
fn lights_and_cameras_that_are_none_are_refused() {
    for (light, said) in [
        (json!({ "type": "area" }), "the type \"area\" is not known"),
        (json!({ "type": 3 }), "invalid type"),
    ] {
        let refused = lights(json!([light])).refusal();
        assert!(refused.contains("KHR_lights_punctual.lights[0]") && refused.contains(said), "{refused}");
    }
    let mut file = lights(json!([{ "type": "point" }]));
    file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = json!(1);
    assert!(file.refusal().contains("nodes[0]: names KHR_lights_punctual.lights[1]"), "{}", file.refusal());
    let mut file = Builder::new();
    file.push("cameras", json!({ "type": "perspective", "perspective": { "yfov": 3.2 } }));
    file.push("nodes", json!({ "camera": 0 }));
    assert!(
        file.refusal().contains("nodes[0].cameras[0].perspective.yfov: must lie between"),
        "{}",
        file.refusal()
    );
}

/// Light of any brightness and colour is taken as near as it can be.
#[test]
fn impossible_amounts_of_light_are_cut() {
    let model = lights(json!([{ "type": "point", "color": [-1.0, 2.0, 1e30], "intensity": 1e30 }])).read();
    let Value::Color(found) = light(&model, 0).values().get("intensity").unwrap().clone() else { panic!() };
    assert!(found.r == 0.0 && found.g == 2e30 && found.b < 3.5e38, "{found:?}");
}
