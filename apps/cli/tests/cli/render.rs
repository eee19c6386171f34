//! Does `catoptra render` write what it is asked for, whole, and refuse what it cannot do?

use crate::program::{assert_refused, catoptra, files, folder, shipped};
use serde_json::Value;

#[test]
fn a_picture_of_the_asked_size_is_written_and_nothing_else() {
    let folder = folder();
    let ran = catoptra(folder.path(), &["render", "scene.kdl", "-o", "a.png", "--size", "37x21"]);
    assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "", ""));
    let image = catoptra_scene::image::read_png(&folder.path().join("a.png")).unwrap();
    assert_eq!((image.width(), image.height()), (37, 21));
    assert_eq!(files(folder.path()), ["a.png", "scene.kdl"]);
}

#[test]
fn a_picture_shows_the_scene() {
    let folder = folder();
    let ran = catoptra(
        folder.path(),
        &[
            "render",
            "scene.kdl",
            "-o",
            "a.png",
            "--size",
            "64x64",
            "--camera",
            "above",
            "--display",
            "linear",
        ],
    );
    assert_eq!(ran.code, 0, "{}", ran.err);
    let image = catoptra_scene::image::read_png(&folder.path().join("a.png")).unwrap();
    let [red, green, _] = image.pixel(32, 32).unwrap();
    assert!(red > green, "the ball in the middle is red");
    let [red, green, blue] = image.pixel(0, 0).unwrap();
    assert!(red == green && green == blue && red > 0, "the floor in the corner is grey");
}

#[test]
fn cameras_backends_and_displays_are_chosen_by_name() {
    let folder = folder();
    let mut pictures = Vec::new();
    for options in
        [["--camera", "above"], ["--display", "linear"], ["--display", "filmic"], ["--max-depth", "0"]]
    {
        let mut arguments = vec!["render", "scene.kdl", "-o", "a.png", "--size", "32x32"];
        arguments.extend(options);
        assert_eq!(catoptra(folder.path(), &arguments).code, 0, "{options:?}");
        pictures.push(std::fs::read(folder.path().join("a.png")).unwrap());
    }
    for backend in ["wide", "oracle"] {
        let arguments = ["render", "scene.kdl", "-o", "a.png", "--size", "32x32", "--backend", backend];
        assert_eq!(catoptra(folder.path(), &arguments).code, 0, "{backend}");
    }
    let distinct: std::collections::HashSet<_> = pictures.iter().collect();
    assert_eq!(distinct.len(), 4, "each option changes the picture");
}

#[test]
fn integrators_are_chosen_by_name_or_by_the_scene_and_seeds_repeat() {
    let folder = folder();
    let scene = std::fs::read_to_string(folder.path().join("scene.kdl")).unwrap();
    std::fs::write(
        folder.path().join("own.kdl"),
        format!("settings {{ integrator \"occlusion\" }}\n{scene}"),
    )
    .unwrap();
    let picture = |scene: &str, options: &[&str]| {
        let arguments = [
            &["render", scene, "-o", "a.exr", "--size", "32x32", "--samples", "3"],
            &["--pattern", "sobol", "--reproducible"][..],
            options,
        ]
        .concat();
        let ran = catoptra(folder.path(), &arguments);
        assert_eq!(ran.code, 0, "{options:?} {}", ran.err);
        std::fs::read(folder.path().join("a.exr")).unwrap()
    };
    let occlusion = picture("scene.kdl", &["--integrator", "occlusion"]);
    assert_eq!(occlusion, picture("own.kdl", &["--seed", "0"]));
    assert_ne!(occlusion, picture("own.kdl", &["--seed", "1"]));
    assert_ne!(occlusion, picture("own.kdl", &["--integrator", "whitted"]));
    assert_eq!(picture("scene.kdl", &[]), picture("own.kdl", &["--integrator", "whitted", "--seed", "9"]));
}

#[test]
fn an_exr_holds_the_linear_light_of_the_film() {
    let folder = folder();
    for name in ["a.exr", "b.exr"] {
        let ran = catoptra(folder.path(), &["render", "scene.kdl", "-o", name, "--size", "24x16"]);
        assert_eq!(ran.code, 0, "{}", ran.err);
    }
    let ran = catoptra(folder.path(), &["compare", "a.exr", "b.exr", "--json"]);
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((ran.code, &found["size"]["width"], &found["differing"]), (0, &24.into(), &0.0.into()));
}

#[test]
fn repeat_prints_one_line_and_writes_nothing() {
    let folder = folder();
    let arguments = ["render", "scene.kdl", "--size", "40x30", "--repeat", "3", "--threads", "1"];
    let ran = catoptra(folder.path(), &arguments);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.starts_with("scene.kdl 40x30 threads 1 wide "), "{}", ran.out);
    assert!(ran.out.contains(" ms median ") && ran.out.trim_end().ends_with("over 3 frames"), "{}", ran.out);
    assert_eq!(ran.out.lines().count(), 1);
    assert_eq!(files(folder.path()), ["scene.kdl"]);
}

#[test]
fn stats_are_one_json_object() {
    let folder = folder();
    let arguments =
        ["render", "scene.kdl", "--size", "40x30", "--stats", "s.json", "--threads", "2", "--repeat", "2"];
    let ran = catoptra(folder.path(), &arguments);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let stats: Value = serde_json::from_slice(&std::fs::read(folder.path().join("s.json")).unwrap()).unwrap();
    assert_eq!((&stats["size"]["width"], &stats["size"]["height"]), (&40.into(), &30.into()));
    assert_eq!(
        (&stats["threads"], &stats["backend"], &stats["frames"]),
        (&2.into(), &"wide".into(), &2.into())
    );
    assert_eq!(stats["rays"]["primary"], 1200);
    assert!(stats["rays"]["shadow"].as_u64().unwrap() > 0);
    assert!(stats["rays"]["reflection"].as_u64().unwrap() > 0);
    assert!(stats["frame_ms"]["min"].as_f64().unwrap() <= stats["frame_ms"]["median"].as_f64().unwrap());
    let stages = &stats["stages_ms"];
    assert_eq!(stages["trace"], stats["frame_ms"]["median"]);
    assert!(stages["load"].as_f64().unwrap() > 0.0 && stages["snapshot"] == stats["build_ms"], "{stages}");
    assert_eq!(stats["version"], env!("CARGO_PKG_VERSION"));
    assert!(stats["processor"]["threads"].as_u64().unwrap() > 0);
    for key in ["simd", "build_ms", "tests", "skipped", "settled", "exact", "peak_memory_bytes"] {
        assert!(!stats[key].is_null() || key == "peak_memory_bytes", "{key} in {stats}");
    }
}

#[test]
fn an_old_file_is_replaced_only_by_a_whole_new_one() {
    let folder = folder();
    std::fs::write(folder.path().join("a.png"), "old").unwrap();
    std::fs::write(folder.path().join("broken.kdl"), "sphere {").unwrap();
    assert_refused(folder.path(), &["render", "broken.kdl", "-o", "a.png"], &["broken.kdl"]);
    assert_eq!(std::fs::read(folder.path().join("a.png")).unwrap(), b"old");
    assert_eq!(catoptra(folder.path(), &["render", "scene.kdl", "-o", "a.png", "--size", "8x8"]).code, 0);
    assert_eq!(&std::fs::read(folder.path().join("a.png")).unwrap()[1..4], b"PNG");
}

#[test]
fn a_shipped_scene_renders() {
    let folder = folder();
    let scene = shipped("seed/directional.kdl");
    assert_eq!(catoptra(folder.path(), &["render", &scene, "-o", "a.png", "--size", "45x45"]).code, 0);
}

/// The first block of scene text in the README.
fn readme_scene() -> &'static str {
    let readme = include_str!("../../../../README.md");
    let (_, rest) = readme.split_once("```kdl\n").expect("a scene in the README");
    rest.split_once("```").expect("the end of the scene").0
}

#[test]
fn the_scene_of_the_readme_renders() {
    let folder = folder();
    std::fs::write(folder.path().join("readme.kdl"), readme_scene()).unwrap();
    let ran = catoptra(folder.path(), &["render", "readme.kdl", "-o", "a.png", "--size", "45x45"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
}

#[test]
fn unknown_names_are_refused_with_the_one_that_was_probably_meant() {
    let folder = folder();
    let with =
        |option: &'static str, value: &'static str| ["render", "scene.kdl", "-o", "a.png", option, value];
    assert_refused(folder.path(), &with("--backend", "orcale"), &["orcale", "did you mean `oracle`?"]);
    assert_refused(folder.path(), &with("--camera", "frnt"), &["frnt", "did you mean `front`?"]);
    assert_refused(folder.path(), &with("--display", "sgrb"), &["sgrb", "did you mean `srgb`?"]);
    assert_refused(folder.path(), &with("--pattern", "sobl"), &["did you mean `sobol`?"]);
    assert_refused(folder.path(), &with("--integrator", "oclusion"), &["did you mean `occlusion`?"]);
    assert_refused(folder.path(), &with("--display", "zzz"), &["linear"]);
}

#[test]
fn bad_numbers_are_refused() {
    let folder = folder();
    let with =
        |option: &'static str, value: &'static str| ["render", "scene.kdl", "-o", "a.png", option, value];
    assert_refused(folder.path(), &with("--size", "640"), &["640", "WIDTHxHEIGHT"]);
    assert_refused(folder.path(), &with("--size", "0x4"), &["1 to"]);
    assert_refused(folder.path(), &with("--samples", "0"), &["whole number from 1 to 65536"]);
    let grid = [&with("--samples", "3")[..], &["--pattern", "grid"]].concat();
    assert_refused(folder.path(), &grid, &["square", "1 or 4"]);
    assert_refused(folder.path(), &with("--threads", "0"), &["0"]);
    assert_refused(folder.path(), &with("--repeat", "0"), &["0"]);
    assert_refused(folder.path(), &with("--max-depth", "x"), &["max-depth"]);
    assert_refused(folder.path(), &with("--seed", "4294967296"), &["seed"]);
}

#[test]
fn bad_outputs_are_refused_before_anything_is_rendered() {
    let folder = folder();
    let to = |name: &'static str| ["render", "scene.kdl", "-o", name];
    assert_refused(folder.path(), &to("a.jpg"), &["a.jpg", ".png", ".exr"]);
    assert_refused(folder.path(), &to("a"), &[".png"]);
    assert_refused(folder.path(), &to("none/a.png"), &["none", "does not exist"]);
    assert_refused(
        folder.path(),
        &["render", "scene.kdl", "--stats", "none/s.json"],
        &["none", "does not exist"],
    );
}

#[test]
fn a_scene_that_is_not_there_is_named() {
    let folder = folder();
    assert_refused(folder.path(), &["render", "nowhere.kdl", "-o", "a.png"], &["nowhere.kdl"]);
}

#[test]
fn a_mistake_in_a_scene_is_told_with_line_column_and_hint() {
    let folder = folder();
    let text = "camera \"eye\" { eye 0 0 5; target 0 0 0 }\nmatte \"grey\" { color 1 1 1 }\nsphre \"ball\" material=\"grey\"\n";
    std::fs::write(folder.path().join("bad.kdl"), text).unwrap();
    assert_refused(folder.path(), &["render", "bad.kdl", "-o", "a.png"], &["bad.kdl:3:1", "sphre", "sphere"]);
}

#[test]
fn a_scene_without_a_camera_is_refused() {
    let folder = folder();
    std::fs::write(folder.path().join("blind.kdl"), "matte \"grey\" { color 1 1 1 }\n").unwrap();
    assert_refused(folder.path(), &["render", "blind.kdl", "-o", "a.png"], &["camera"]);
}

#[test]
fn a_crop_is_a_part_of_the_whole_picture() {
    let folder = folder();
    let whole = ["render", "scene.kdl", "-o", "whole.png", "--size", "60x40"];
    let part =
        ["render", "scene.kdl", "-o", "part.png", "--size", "60x40", "--crop", "13,7,20,15", "--tile", "8"];
    for arguments in [&whole[..], &part] {
        assert_eq!(catoptra(folder.path(), arguments).code, 0, "{arguments:?}");
    }
    let read = |name: &str| catoptra_scene::image::read_png(&folder.path().join(name)).unwrap();
    let (whole, part) = (read("whole.png"), read("part.png"));
    assert_eq!((part.width(), part.height()), (20, 15));
    for (x, y) in (0..15).flat_map(|y| (0..20).map(move |x| (x, y))) {
        assert_eq!(part.pixel(x, y), whole.pixel(x + 13, y + 7), "{x},{y}");
    }
}

#[test]
fn every_kind_of_instructions_writes_the_same_file() {
    let folder = folder();
    let mut files = Vec::new();
    for instructions in catoptra_tracer::Instructions::all() {
        let simd = instructions.name();
        let ran = catoptra(
            folder.path(),
            &[
                "render",
                "scene.kdl",
                "-o",
                "a.exr",
                "--size",
                "40x30",
                "--simd",
                simd,
                "--repeat",
                "1",
                "--reproducible",
            ],
        );
        assert!(ran.code == 0 && ran.out.contains(&format!(" wide {simd}:")), "{}{}", ran.out, ran.err);
        files.push(std::fs::read(folder.path().join("a.exr")).unwrap());
    }
    assert!(files.iter().all(|file| *file == files[0]));
}

#[test]
fn crops_tiles_and_instructions_that_cannot_be_are_refused() {
    let folder = folder();
    let with =
        |option: &'static str, value: &'static str| ["render", "scene.kdl", "-o", "a.png", option, value];
    assert_refused(folder.path(), &with("--crop", "630,0,20,20"), &["beyond the picture", "640 columns"]);
    assert_refused(folder.path(), &with("--crop", "1,2,3"), &["X,Y,WIDTH,HEIGHT"]);
    assert_refused(folder.path(), &with("--tile", "7"), &["multiple of 4"]);
    assert_refused(folder.path(), &with("--simd", "avx3"), &["avx3"]);
    let foreign = if cfg!(target_arch = "x86_64") { "neon" } else { "avx2" };
    assert_refused(folder.path(), &with("--simd", foreign), &["this CPU has no", "it has:"]);
}
