//! Does `catoptra explain` say what a scene needs and what was skipped?

use crate::program::{assert_refused, catoptra, folder};
use serde_json::Value;

#[test]
fn parts_are_counted_by_kind_and_skipped_work_by_reason() {
    let folder = folder();
    let ran = catoptra(folder.path(), &["explain", "scene.kdl", "--size", "64x48"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    for words in
        ["1 plane", "1 sphere", "1 matte", "1 phong", "1 spot-light", "primary rays of 3,072 possible", "%"]
    {
        assert!(ran.out.contains(words), "no `{words}` in\n{}", ran.out);
    }
}

#[test]
fn what_takes_how_long_is_told_with_names_and_advice() {
    let folder = folder();
    let text = std::fs::read_to_string(folder.path().join("scene.kdl")).unwrap();
    let glass =
        "glass \"crystal\" { ior 1.5 }\nsphere \"lens\" material=\"crystal\" { center 1 1 2; radius 0.5 }\n";
    std::fs::write(folder.path().join("glass.kdl"), text + glass).unwrap();
    let ran = catoptra(folder.path(), &["explain", "glass.kdl", "--size", "96x64"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    for words in [
        " ms  reading the scene",
        " ms  making the snapshot",
        " ms  tracing the frame",
        "of that where \"lens\" is seen",
        "What would help",
        "materials such as \"crystal\" make every point be shaded by itself",
    ] {
        assert!(ran.out.contains(words), "no `{words}` in\n{}", ran.out);
    }
    assert!(!ran.out.contains("before"), "{}", ran.out);
    let ran = catoptra(folder.path(), &["explain", "scene.kdl", "--size", "96x64", "--json"]);
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    let pixels: u64 =
        found["slow"].as_array().unwrap().iter().map(|thing| thing["pixels"].as_u64().unwrap()).sum();
    assert_eq!((pixels, &found["advice"][0]), (96 * 64, &"nothing stands out".into()));
    assert!(found["stages_ms"]["trace"].as_f64().unwrap() > 0.0);
}

#[test]
fn json_has_the_same_counts() {
    let folder = folder();
    let ran = catoptra(folder.path(), &["explain", "scene.kdl", "--size", "64x48", "--json"]);
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(found["shapes"]["sphere"], 1);
    assert_eq!(found["lights"]["spot-light"], 1);
    assert_eq!(found["materials"]["phong"], 1);
    let count = |kind: &str, name: &str| found["counts"][kind][name].as_u64().unwrap();
    assert_eq!(count("rays", "primary") + count("skipped", "nothing_seen"), 64 * 48);
    assert!(count("skipped", "nothing_seen") > 0 && count("skipped", "out_of_cone") > 0);
}

#[test]
fn rays_to_the_sky_are_counted() {
    let folder = folder();
    let arguments = ["explain", "scene.kdl", "--size", "64x48", "--integrator", "occlusion"];
    let ran = catoptra(folder.path(), &arguments);
    assert!(ran.out.contains("integrator occlusion: one direction a sample, however far"), "{}", ran.out);
    let ran = catoptra(folder.path(), &[&arguments[..], &["--json"]].concat());
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    let rays = &found["counts"]["rays"];
    assert_eq!((&found["integrator"], &rays["primary"]), (&"occlusion".into(), &(64 * 48).into()));
    assert!(rays["occlusion"].as_u64().unwrap() > 0 && rays["shadow"] == 0, "{rays}");
}

#[test]
fn a_scene_that_is_not_there_is_refused() {
    let folder = folder();
    assert_refused(folder.path(), &["explain", "nowhere.kdl"], &["nowhere.kdl"]);
}

#[test]
fn light_from_surfaces_is_told_by_how_it_was_found() {
    let folder = folder();
    let scene = r#"
camera "c" { eye 0 3 8; target 0 1 0 }
matte "grey" { color 0.5 }
emissive "glow" { radiance 1 }
plane "floor" material="grey"
sphere "ball" material="grey" { center 0 1 0; radius 1 }
box "ember" material="glow" { min 3 0 0; max 4 1 1 }
rectangle-light "lamp" { corner -1 5 -1; edge-u 2 0 0; edge-v 0 0 2; radiance 5 }
"#;
    std::fs::write(folder.path().join("area.kdl"), scene).unwrap();
    let arguments = ["explain", "area.kdl", "--size", "64x48"];
    let ran = catoptra(folder.path(), &arguments);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    for words in [
        "1 light: 1 rectangle-light; shadows are thrown by 1",
        "1 shape of a material that shines: 1 box",
        "2 materials: 1 emissive, 1 matte",
        "Light from surfaces",
        "asked each of 7 lamps and faces of lamps",
        "see all of it: closed form",
        "past one ball: closed form",
        "0 rays to points of lamps",
    ] {
        assert!(ran.out.contains(words), "no `{words}` in\n{}", ran.out);
    }
    let ran = catoptra(folder.path(), &[&arguments[..], &["--json"]].concat());
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(
        (&found["lights"]["rectangle-light"], &found["shining_shapes"]["box"]),
        (&1.into(), &1.into())
    );
    assert_eq!((&found["lamp_outlines"], &found["materials"]["emissive"]), (&7.into(), &1.into()));
    assert!(found["counts"]["lamps"]["open"].as_u64().unwrap() > 0);
}
