//! Is the user told of options that change nothing, and of names that are unknown whatever else is asked for?

use crate::program::{assert_refused, catoptra, folder};

#[test]
fn options_without_effect_are_told_and_no_error() {
    let folder = folder();
    for (line, word) in [
        ("-o a.exr --display srgb", "--display"),
        ("--repeat 1 --display filmic", "--display"),
        ("--stats s.json --display srgb", "--display"),
        ("-o a.png --compression zip", "--compression"),
        ("-o a.png --reproducible", "--reproducible"),
        ("-o a.png --force", "--force"),
        ("--stats s.json --keep-partial", "--keep-partial"),
        ("--stats s.json --layers color,id", "--layers"),
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
fn surfaces_that_light_nothing_or_are_picked_at_random_are_told() {
    let folder = folder();
    let camera = "camera \"c\" { eye 0 2 6; target 0 0 0 }\nemissive \"glow\" { radiance 1 }\n";
    let plane = "plane \"ground\" material=\"glow\"\nsphere \"ball\" material=\"glow\" { radius 1 }\n";
    let lamp = |i: u32| format!("sphere-light \"l{i}\" {{ center {i} 0 0; radius 0.1; radiance 1 }}\n");
    let many: String = (0..1001).map(lamp).collect();
    for (text, told) in [
        (format!("{camera}{plane}"), "warning: \"ground\" shines but lights nothing: it has no end\n"),
        (
            format!("{camera}torus \"ring\" material=\"glow\" {{ major 1; minor 0.2 }}\n"),
            "warning: \"ring\" shines, but only paths (--integrator path) find its light\n",
        ),
        (format!("{camera}{many}"), "warning: 1,001 surfaces shine, too many to ask each: "),
    ] {
        std::fs::write(folder.path().join("lamps.kdl"), text).unwrap();
        for command in ["render", "explain"] {
            let mut line = vec![command, "lamps.kdl", "--size", "4x4"];
            line.extend(if command == "render" { vec!["-o", "a.png"] } else { vec![] });
            let ran = catoptra(folder.path(), &line);
            assert!(
                ran.code == 0 && ran.err.starts_with(told) && ran.err.lines().count() == 1,
                "{}",
                ran.err
            );
        }
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
