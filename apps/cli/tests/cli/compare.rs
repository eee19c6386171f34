//! Does `catoptra compare` tell equal pictures from different ones, by its exit code too?

use std::path::Path;

use crate::program::{Ran, assert_refused, catoptra, folder};
use catoptra_scene::image::write_png;
use serde_json::Value;

/// Writes a 4x4 picture of one grey, with one pixel of another.
fn write(folder: &Path, name: &str, grey: u8, odd: u8) {
    let mut bytes = [grey; 48];
    bytes[..3].fill(odd);
    write_png(&folder.join(name), 4, 4, &bytes).expect("a picture is written");
}

/// Compares a grey picture with one in which one pixel is 51 bytes, a fifth of the range, brighter.
fn compared(options: &[&str]) -> Ran {
    let folder = folder();
    write(folder.path(), "a.png", 100, 100);
    write(folder.path(), "b.png", 100, 151);
    let mut arguments = vec!["compare", "a.png", "b.png"];
    arguments.extend(options);
    catoptra(folder.path(), &arguments)
}

#[test]
fn without_limits_any_difference_is_only_told() {
    let ran = compared(&[]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    assert!(ran.out.contains("rmse") && ran.out.contains("flip"), "{}", ran.out);
}

#[test]
fn json_has_every_metric() {
    let ran = compared(&["--json"]);
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((&found["differing"], &found["within_limits"]), (&1.0.into(), &true.into()));
    assert!((found["max_difference"].as_f64().unwrap() - 0.2).abs() < 1e-6);
    assert!((found["rmse"].as_f64().unwrap() - 0.05).abs() < 1e-6);
    for key in ["mse", "relmse", "max_ulps", "flip"] {
        assert!(found[key].as_f64().unwrap() > 0.0, "{key}");
    }
}

#[test]
fn each_limit_ends_with_1_when_passed_and_0_when_kept() {
    let limits = [
        ("--max-rmse", "0.04", "0.06"),
        ("--max-difference", "0.19", "0.21"),
        ("--max-differing", "0", "1"),
        ("--max-flip", "0.001", "1"),
        ("--max-relmse", "0.001", "0.5"),
    ];
    for (option, tight, loose) in limits {
        assert_eq!(compared(&[option, tight]).code, 1, "{option} {tight}");
        assert_eq!(compared(&[option, loose]).code, 0, "{option} {loose}");
        let json = compared(&[option, tight, "--json"]);
        assert_eq!((json.code, json.out.contains("\"within_limits\":false")), (1, true), "{option}");
    }
}

#[test]
fn the_threshold_forgives_small_differences() {
    assert_eq!(compared(&["--threshold", "0.21", "--max-differing", "0"]).code, 0);
    assert_eq!(compared(&["--threshold", "0.19", "--max-differing", "0"]).code, 1);
}

#[test]
fn a_picture_of_the_differences_is_bright_where_they_are() {
    let folder = folder();
    write(folder.path(), "a.png", 100, 100);
    write(folder.path(), "b.png", 100, 151);
    let ran = catoptra(folder.path(), &["compare", "a.png", "b.png", "--diff", "d.png"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let image = catoptra_scene::image::read_png(&folder.path().join("d.png")).unwrap();
    let light = |x, y| image.pixel(x, y).unwrap().map(u32::from).iter().sum::<u32>();
    assert!(light(0, 0) > 2 * light(1, 0) && light(1, 0) == light(3, 3));
    let refused = |name: &str, words: &[&str]| {
        assert_refused(folder.path(), &["compare", "a.png", "b.png", "--diff", name], words);
    };
    refused("d.exr", &[".png"]);
    refused("b.png", &["--diff would overwrite the test"]);
    refused("no/d.png", &["no does not exist"]);
}

#[test]
fn pictures_of_different_sizes_are_refused() {
    let folder = folder();
    write(folder.path(), "a.png", 1, 1);
    write_png(&folder.path().join("b.png"), 2, 2, &[0; 12]).unwrap();
    assert_refused(folder.path(), &["compare", "a.png", "b.png"], &["4x4", "2x2"]);
}

#[test]
fn what_is_no_picture_is_refused() {
    let folder = folder();
    write(folder.path(), "a.png", 1, 1);
    std::fs::write(folder.path().join("b.png"), "no picture").unwrap();
    std::fs::write(folder.path().join("b.exr"), "no picture").unwrap();
    assert_refused(folder.path(), &["compare", "a.png", "b.png"], &["b.png"]);
    assert_refused(folder.path(), &["compare", "b.exr", "b.exr"], &["b.exr"]);
    assert_refused(folder.path(), &["compare", "a.png", "none.png"], &["none.png"]);
    assert_refused(folder.path(), &["compare", "a.png", "scene.kdl"], &[".kdl", ".png"]);
}

#[test]
fn limits_that_nothing_can_pass_are_refused() {
    let folder = folder();
    assert_refused(folder.path(), &["compare", "a.png", "b.png", "--max-rmse", "NaN"], &["from 0 up"]);
}
