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
