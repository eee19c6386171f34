//! Does `catoptra probe` measure what it is asked to, and say what is wrong with the question?

use catoptra_scene::image::read_png;
use serde_json::Value;

use crate::program::{assert_refused, catoptra, files, folder};

/// A lamp of 8 cd two metres above a black floor.
const LAMP: &str = r#"
matte "black" { color 0 }
plane "floor" material="black"
point-light "lamp" { position 0 2 0; intensity 8 }
"#;

fn with(name: &str, text: &str) -> tempfile::TempDir {
    let folder = folder();
    std::fs::write(folder.path().join("lamp.kdl"), LAMP).expect("a scene is written");
    std::fs::write(folder.path().join(name), text).expect("a file is written");
    folder
}

/// Numbers of each line that is no remark.
fn numbers(text: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    lines.map(|line| line.split(' ').map(|word| word.parse().expect("a number")).collect()).collect()
}

#[test]
fn a_line_for_each_line() {
    let folder = with("points", "# desk\n0 0 0  0 7 0\n\n  0 1 0 0 1e-9 0\r\n0 0 0 0 -1 0");
    let ran = catoptra(folder.path(), &["probe", "lamp.kdl", "points"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    assert_eq!(ran.out, "# desk\n2 2 2 0 0 0\n\n8 8 8 0 0 0\n0 0 0 0 0 0\n");
}

#[test]
fn json_has_points_and_what_was_found_there() {
    let folder = with("points", "0 0 0 0 7 0\n# no\n");
    let ran = catoptra(folder.path(), &["probe", "lamp.kdl", "points", "--json"]);
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    let point = &found["points"][0];
    assert_eq!((&point["irradiance"][1], &point["error"][1]), (&2.0.into(), &0.0.into()));
    assert_eq!((&point["normal"][1], found["points"].as_array().unwrap().len()), (&1.0.into(), 1));
}

#[cfg(unix)]
#[test]
fn points_and_scenes_come_from_standard_input() {
    let folder = with("points", "0 0 0 0 1 0\n");
    for line in ["$catoptra probe lamp.kdl - < points", "$catoptra probe - points < lamp.kdl"] {
        let ran = crate::program::shell(folder.path(), line);
        assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "2 2 2 0 0 0\n", ""), "{line}");
    }
    assert_refused(folder.path(), &["probe", "-", "-"], &["both", "standard input"]);
}

#[test]
fn slips_are_told_with_their_place() {
    for (text, words) in [
        ("0 0 0 0 1 0\n0 0 0 0 0 0\n", "points:2:7: the normal must not be zero"),
        ("0 NaN 0 0 1 0\n", "points:1:3: `NaN` is not finite"),
        ("0 0 0 0 1\n", "points:1:10: six numbers are a line, and this one has 5"),
        ("0 0 0 0 1 0 1\n", "points:1:13: six numbers are a line, and this one has 7"),
        ("0 0 0 0 one 0\n", "points:1:9: `one` is no number"),
    ] {
        let folder = with("points", text);
        assert_refused(folder.path(), &["probe", "lamp.kdl", "points"], &[words, "x y z nx ny nz"]);
    }
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let folder = with("points", "0 0 0 0 1 0\n");
    let path = folder.path();
    let ask = |more: &[&'static str], words: &[&str]| {
        assert_refused(path, &[&["probe", "lamp.kdl", "points"], more].concat(), words);
    };
    ask(&["--integrator", "occlusion"], &["occlusion does not measure irradiance", "whitted"]);
    ask(&["--integrator", "witted"], &["did you mean `whitted`?"]);
    ask(&["--max-error", "0"], &["above 0"]);
    ask(&["--samples", "0"], &["--samples"]);
    ask(&["-o", "plan.png"], &["--plane"]);
    ask(&["--plane", "0 0 0 1 0 0 0 1 0 2x2"], &["cannot be used with"]);
    assert_refused(path, &["probe", "lamp.kdl"], &["POINTS"]);
    assert_refused(path, &["probe", "lamp.kdl", "nowhere"], &["nowhere cannot be read"]);
    assert_refused(path, &["probe", "lamp.kdl", "--plane", "0 0 0 1 0 0 0 1 0"], &["nine numbers"]);
    let plane = ["--plane", "0 0 0 1 0 0 0 1 0 2x2"];
    for (name, words) in [("plan.exr", ".png"), ("no/plan.png", "cannot be written"), ("lamp.kdl", "ends in")]
    {
        assert_refused(path, &["probe", "lamp.kdl", plane[0], plane[1], "-o", name], &[words]);
    }
}

#[test]
fn a_plan_has_numbers_and_a_picture() {
    let folder = with("points", "");
    let plane = "-1 0 1, 2 0 0, 0 0 -2, 3x5";
    let arguments = ["probe", "lamp.kdl", "--plane", plane, "-o", "plan.png"];
    let ran = catoptra(folder.path(), &arguments);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let rows = numbers(&ran.out);
    assert_eq!((rows.len(), rows[0].len()), (5, 3));
    assert_eq!(rows[2][1], 2.0);
    assert_eq!(rows[0], rows[4]);
    assert!(ran.out.contains("# min ") && ran.out.contains(" uniformity 0."), "{}", ran.out);
    let picture = read_png(&folder.path().join("plan.png")).unwrap();
    assert!(picture.width() > 384 && picture.height() > 640);
    let ran = catoptra(folder.path(), &["probe", "lamp.kdl", "--plane", plane, "--json"]);
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(
        (&found["max"], &found["rows"][2][1], &found["cells"][1]),
        (&2.0.into(), &2.0.into(), &5.into())
    );
    assert_eq!(files(folder.path()), ["lamp.kdl", "plan.png", "points", "scene.kdl"]);
}

#[test]
fn where_rays_are_drawn_more_of_them_make_it_surer() {
    let area = "matte \"m\" { color 0.5 }\nsphere-light \"l\" { center 0 3 0; radius 1; radiance 1 }\nmesh \"t\" material=\"m\" { file \"t.obj\" }\n";
    let folder = with("area.kdl", area);
    std::fs::write(folder.path().join("t.obj"), "v 0 1 -9\nv 0 1 9\nv 9 1 0\nf 1 2 3\n").unwrap();
    std::fs::write(folder.path().join("points"), "0 0 0 0 1 0\n").unwrap();
    let measure = |more: &[&str]| {
        let ran = catoptra(folder.path(), &[&["probe", "area.kdl", "points"], more].concat());
        assert_eq!((ran.code, ran.err.as_str()), (0, ""));
        numbers(&ran.out)[0].clone()
    };
    let (few, sure) = (measure(&[]), measure(&["--max-error", "2e-5"]));
    let half = std::f64::consts::PI / 18.0;
    for found in [&few, &sure] {
        assert!((found[0] - half).abs() < 4.0 * found[3] && found[3] > 0.0, "{found:?}");
    }
    assert!(sure[3] <= 2e-5 && few[3] > 2e-5, "{few:?} {sure:?}");
    assert_eq!(few, measure(&["--threads", "2"]));
    assert_ne!(few, measure(&["--seed", "1"]));
}
