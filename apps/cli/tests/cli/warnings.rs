//! Is the user told of options that change nothing, and of names that are unknown whatever else is asked for?

use crate::program::{assert_refused, catoptra, folder};

#[test]
fn options_without_effect_are_told_and_no_error() {
    let folder = folder();
    for (line, word) in [
        ("-o a.exr --display srgb", "--display"),
        ("--repeat 1 --display filmic", "--display"),
        ("--stats s.json --display srgb", "--display"),
        ("-o a.png --pattern sobol", "--pattern"),
        ("-o a.png --filter tent", "--filter"),
        ("-o a.png --simd LEVEL --backend scalar", "--simd"),
        ("-o a.png --simd LEVEL --backend oracle", "--simd"),
    ] {
        let level = catoptra_tracer::Instructions::all()[0].name();
        let line = format!("render scene.kdl --size 8x8 {line}").replace("LEVEL", level);
        let ran = catoptra(folder.path(), &line.split(' ').collect::<Vec<_>>());
        let told = format!("warning: {word} changes nothing");
        assert!(ran.code == 0 && ran.err.starts_with(&told) && ran.err.lines().count() == 1, "{}", ran.err);
    }
}

#[test]
fn options_with_effect_are_not_told() {
    let folder = folder();
    for line in [
        "-o a.png --display srgb",
        "-o a.png --display filmic --repeat 2 --stats s.json --tile 8",
        "-o a.exr --pattern grid --samples 4",
        "-o a.exr --pattern owen --filter tent --samples 5",
    ] {
        let line = format!("render scene.kdl --size 8x8 {line}");
        let ran = catoptra(folder.path(), &line.split(' ').collect::<Vec<_>>());
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{line}");
    }
}

#[test]
fn unknown_names_are_errors_without_a_picture_and_without_a_scene() {
    let folder = folder();
    for (option, name, meant) in [
        ("--display", "sgrb", "did you mean `srgb`?"),
        ("--backend", "wied", "did you mean `wide`?"),
        ("--pattern", "sobl", "did you mean `sobol`?"),
        ("--filter", "tnet", "did you mean `tent`?"),
        ("--simd", "avx3", "avx3"),
    ] {
        assert_refused(folder.path(), &["render", "scene.kdl", option, name], &[name, meant]);
        assert_refused(folder.path(), &["render", "none.kdl", option, name, "--repeat", "1"], &[name, meant]);
    }
    let camera = ["render", "scene.kdl", "--camera", "frnt", "--repeat", "1"];
    assert_refused(folder.path(), &camera, &["did you mean `front`?"]);
}
