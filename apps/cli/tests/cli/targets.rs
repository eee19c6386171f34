//! Are pictures sampled until they are sure enough, and is it said how sure they are?

use serde_json::Value;

use crate::program::{assert_refused, catoptra, folder};

#[test]
fn what_a_target_has_come_to_is_told_and_written() {
    let folder = folder();
    let line =
        "render scene.kdl --size 16x12 -o a.exr --integrator occlusion --max-error 0.05 --stats s.json";
    let ran = catoptra(folder.path(), &line.split(' ').collect::<Vec<_>>());
    assert!(ran.code == 0 && ran.err.contains("samples a pixel"), "{}", ran.err);
    let text = std::fs::read_to_string(folder.path().join("s.json")).unwrap();
    let stats: Value = serde_json::from_str(&text).unwrap();
    let reached = &stats["reached"];
    let number = |value: &Value| value.as_f64().unwrap();
    assert!(number(&reached["error"]) <= 0.05 && number(&reached["max_error"]) == 0.05, "{reached}");
    assert!(number(&reached["samples"]["min"]) >= 64.0 && reached["pixels_above"] == 0, "{reached}");
}

#[test]
fn a_scene_sets_samples_and_a_target_and_options_count_before_it() {
    let folder = folder();
    let scene = std::fs::read_to_string(folder.path().join("scene.kdl")).unwrap();
    let write = |name: &str, settings: &str| {
        std::fs::write(folder.path().join(name), format!("settings {{ {settings} }}\n{scene}")).unwrap();
    };
    write("own.kdl", "samples 3; exposure 1");
    write("target.kdl", "max-error 0.1");
    let picture = |line: &str| {
        let reproducible = if line.contains("a.exr") { " --reproducible" } else { "" };
        let line = format!("render {line} --size 8x8{reproducible}");
        let ran = catoptra(folder.path(), &line.split(' ').collect::<Vec<_>>());
        assert_eq!(ran.code, 0, "{line} {}", ran.err);
        let name = if line.contains("a.png") { "a.png" } else { "a.exr" };
        (std::fs::read(folder.path().join(name)).unwrap(), ran.err)
    };
    assert_eq!(picture("own.kdl -o a.exr"), picture("scene.kdl -o a.exr --samples 3"));
    assert_eq!(picture("own.kdl -o a.exr --samples 1"), picture("scene.kdl -o a.exr"));
    assert_eq!(picture("own.kdl -o a.png"), picture("scene.kdl -o a.png --samples 3 --exposure 1"));
    assert_ne!(picture("own.kdl -o a.png"), picture("own.kdl -o a.png --exposure -1"));
    assert!(picture("target.kdl -o a.png").1.contains("samples a pixel"));
    assert!(picture("scene.kdl -o a.png --time 0.01").1.contains("samples a pixel"));
}

#[test]
fn targets_that_cannot_be_judged_are_refused() {
    let folder = folder();
    let with = |options: &[&'static str]| [&["render", "scene.kdl", "-o", "a.png"], options].concat();
    assert_refused(folder.path(), &with(&["--max-error", "0"]), &["greater than 0"]);
    assert_refused(folder.path(), &with(&["--time", "0"]), &["greater than 0"]);
    assert_refused(folder.path(), &with(&["--exposure", "auto"]), &["stops"]);
    assert_refused(folder.path(), &with(&["--max-error", "0.1", "--samples", "16"]), &["64 samples or more"]);
    assert_refused(folder.path(), &with(&["--max-error", "0.1", "--pattern", "sobol"]), &["owen"]);
}
