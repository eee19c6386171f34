//! Does `catoptra lab` answer, and refuse files that are none?

use std::path::Path;

use crate::program::{assert_refused, catoptra, folder};

const TRIANGLE: &str = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";

/// Writes a ray file of two rays, one that meets the triangle at 2 and one that passes it.
fn write_rays(path: &Path) {
    let rays: [[f32; 8]; 2] =
        [[0.0, 0.0, 2.0, 0.0, 0.0, 0.0, -1.0, 9.0], [5.0, 0.0, 2.0, 0.0, 0.0, 0.0, -1.0, 9.0]];
    let mut bytes = 2_u32.to_le_bytes().to_vec();
    bytes.extend(rays.as_flattened().iter().flat_map(|v| v.to_le_bytes()));
    std::fs::write(path, bytes).expect("a ray file is written");
}

#[test]
fn rays_of_a_file_are_traced_and_summed_up() {
    let folder = folder();
    std::fs::write(folder.path().join("one.obj"), TRIANGLE).expect("a mesh is written");
    write_rays(&folder.path().join("two.bin"));
    for (more, figures) in
        [(&[][..], "rays 2 hits 1 sum_t 2.000000000e0"), (&["--any"], "rays 2 hits 1 sum_t 0.000000000e0")]
    {
        let arguments =
            [&["lab", "trace", "one.obj", "two.bin", "--repeat", "2", "--threads", "1"], more].concat();
        let ran = catoptra(folder.path(), &arguments);
        assert_eq!(ran.code, 0, "{}", ran.err);
        assert!(ran.out.contains(figures) && ran.out.lines().count() == 1, "{}", ran.out);
    }
}

/// A floor from 3 m above, a ball that throws a shadow on it, and a lamp.
const LIT: &str = "camera \"c\" { eye 0 3 0; target 0 0 0; up 0 0 -1; fov 60 }\nmatte \"m\" { color 0.7 }\n\
    box \"floor\" material=\"m\" { min -9 -1 -9; max 9 0 9 }\n\
    sphere \"ball\" material=\"m\" { center 0.8 0.5 0; radius 0.3 }\n\
    point-light \"lamp\" { position 1 4 0; intensity 9 }\n";

#[test]
fn the_rays_of_a_picture_meet_what_it_shows() {
    let folder = folder();
    std::fs::write(folder.path().join("lit.kdl"), LIT).expect("a scene is written");
    let written =
        catoptra(folder.path(), &["lab", "rays", "lit.kdl", "seen.bin", "shadow.bin", "--size", "37x21"]);
    assert_eq!(
        (written.code, written.out.as_str()),
        (0, "777 camera rays, 777 shadow rays\n"),
        "{}",
        written.err
    );
    let traced = |rays: &str, more: &[&str]| {
        let ran =
            catoptra(folder.path(), &[&["lab", "trace", "lit.kdl", rays, "--repeat", "1"], more].concat());
        assert_eq!(ran.code, 0, "{}", ran.err);
        let hits = ran.out.split(" hits ").nth(1).and_then(|rest| rest.split(' ').next());
        hits.and_then(|hits| hits.parse::<u32>().ok()).expect("how many have met something")
    };
    assert_eq!(traced("seen.bin", &[]), 777);
    // As many pixels of the floor lie in the shadow beside the ball that hides most of it, by the formula of a ball.
    assert_eq!(traced("shadow.bin", &["--any"]), 3);
    assert_refused(folder.path(), &["lab", "rays", "lit.kdl", "lit.kdl"], &["lit.kdl"]);
}

#[test]
fn files_that_are_none_are_refused() {
    let folder = folder();
    std::fs::write(folder.path().join("one.obj"), TRIANGLE).expect("a mesh is written");
    std::fs::write(folder.path().join("short.bin"), [1, 0, 0, 0, 7]).expect("a file is written");
    assert_refused(folder.path(), &["lab", "trace", "one.obj", "short.bin"], &["short.bin", "36 bytes"]);
    assert_refused(folder.path(), &["lab", "trace", "one.obj", "none.bin"], &["none.bin"]);
    write_rays(&folder.path().join("two.bin"));
    assert_refused(folder.path(), &["lab", "trace", "none.obj", "two.bin"], &["none.obj"]);
}

const CASES: &str = "STRESS 1\nS 7 2 open\n\
    P 00000000 00000000 00000000 00000000 3f800000 00000000\n\
    O 00000000 40000000 00000000 3f800000\n\
    R 1 down 7 00000000 40a00000 00000000 00000000 bf800000 00000000 00000000 7f800000\n\
    W 2 shade 7 00000000 3f000000 40a00000 00000000 00000000 c0a00000 00000000 40a00000 00000000\n\
    C 3 mirrors 7 00000000 3f000000 00000000 00000000 bf800000 00000000 2\n";

const ANSWERS: &str = "STRESS-ANSWERS 1\nA 1 down R H 1:2.0\nA 2 shade W V\nA 3 mirrors C 1 0 1 0 1.5 1.0\n";

#[test]
fn hard_cases_are_answered_and_scored() {
    let folder = folder();
    std::fs::write(folder.path().join("some.cases"), CASES).expect("cases are written");
    std::fs::write(folder.path().join("some.answers"), ANSWERS).expect("answers are written");
    for backend in ["wide", "scalar", "oracle"] {
        let ran = catoptra(folder.path(), &["lab", "answer", "some.cases", "out", "--backend", backend]);
        assert_eq!(ran.code, 0, "{}", ran.err);
        let results = std::fs::read_to_string(folder.path().join("out")).expect("results");
        assert_eq!(results.lines().next(), Some("1 1 1 2e0"), "{backend}: {results}");
        let ran = catoptra(folder.path(), &["lab", "score", "some.cases", "some.answers", "out"]);
        assert_eq!(
            ran.code, 1,
            "the ray of case 2 meets nothing, so that no light reaches what it meets: {}",
            ran.out
        );
        assert!(ran.out.contains("shade                         1      1  such as 2"), "{}", ran.out);
        assert!(ran.out.contains("mirrors                       1      0\n"), "{}", ran.out);
    }
}

#[test]
fn case_files_that_are_none_are_refused_by_line() {
    let folder = folder();
    std::fs::write(folder.path().join("bad.cases"), "STRESS 1\nS 0 1 open\nO 0 1\n").expect("a file");
    assert_refused(
        folder.path(),
        &["lab", "answer", "bad.cases", "out"],
        &["bad.cases", "line 3", "eight hex"],
    );
    assert_refused(folder.path(), &["lab", "answer", "none.cases", "out"], &["none.cases"]);
    assert!(!folder.path().join("out").exists());
}

/// A floor, seen from above, and three lights: in the floor's own plane, below it, above it.
const LIGHT_IN_A_PLANE: &str = "STRESS 1\nS 1 1 open\n\
    P 00000000 00000000 00000000 00000000 3f800000 00000000\n\
    W 1 in 1 00000000 3f800000 00000000 3f000000 bf800000 00000000 40400000 00000000 3f800000\n\
    W 2 below 1 00000000 3f800000 00000000 3f000000 bf800000 00000000 40400000 bf800000 3f800000\n\
    W 3 above 1 00000000 3f800000 00000000 3f000000 bf800000 00000000 40400000 3f800000 3f800000\n";

#[test]
fn a_segment_within_a_plane_does_not_hit_it() {
    let folder = folder();
    std::fs::write(folder.path().join("some.cases"), LIGHT_IN_A_PLANE).expect("cases are written");
    for backend in ["wide", "scalar", "oracle"] {
        let ran = catoptra(folder.path(), &["lab", "answer", "some.cases", "out", "--backend", backend]);
        assert_eq!(ran.code, 0, "{}", ran.err);
        let answers = std::fs::read_to_string(folder.path().join("out")).expect("answers");
        let answers: Vec<&str> = answers.lines().filter(|line| line.starts_with(char::is_numeric)).collect();
        assert_eq!(answers, ["1 0", "2 1", "3 0"], "{backend}");
    }
}
