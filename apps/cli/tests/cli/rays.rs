//! Do `catoptra pick` and `catoptra cast` say what rays meet, and what is wrong with the question?

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{assert_refused, catoptra, folder};

/// Rays down the middle of the small scene's ball, beside it, upwards, and through it in a stretch.
const RAYS: &str = "# down\n0 9 0 0 -1 0\n\n3 9 0 0 -2 0\n3 9 0 0 1 0\n0 9 0 0 -1 0 7.5 8.5\n";

#[test]
fn a_pixel_is_a_thing_of_a_material_at_a_place() {
    let folder = folder();
    let ran = catoptra(folder.path(), &["pick", "scene.kdl", "30", "20", "--size", "61x41"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines[..2], ["entity   \"ball\" (sphere)", "material \"shiny\" (phong)"]);
    assert_eq!((lines[4], lines[5], lines.len()), ("depth    3", "facet    0", 7));
    for (line, name, wanted) in [(2, "point", [0.0, 1.0, 1.0]), (3, "normal", [0.0, 0.0, 1.0])] {
        let (found, numbers) = lines[line].split_once(' ').unwrap();
        let near = |(number, wanted): (&str, f64)| (number.parse::<f64>().unwrap() - wanted).abs() < 1e-12;
        assert!(found == name && numbers.split_whitespace().zip(wanted).all(near), "{}", ran.out);
    }
    let arguments = ["pick", "scene.kdl", "0", "0", "--size", "61x41", "--camera", "above", "--json"];
    let found: Value = serde_json::from_str(&catoptra(folder.path(), &arguments).out).unwrap();
    assert_eq!(
        (&found["entity"], &found["kind"], &found["material"]),
        (&"floor".into(), &"plane".into(), &"grey".into())
    );
    assert_eq!((&found["normal"][1], &found["point"][1]), (&1.0.into(), &0.0.into()));
    assert!(found["depth"].as_f64().unwrap() > 6.0);
    assert_eq!(catoptra(folder.path(), &["pick", "scene.kdl", "0", "0"]).out, "nothing\n");
    assert_eq!(catoptra(folder.path(), &["pick", "scene.kdl", "0", "0", "--json"]).out, "null\n");
}

#[test]
fn pixels_that_are_none_are_refused() {
    let folder = folder();
    let refused = |line: &str, words: &[&str]| {
        assert_refused(folder.path(), &format!("pick {line}").split(' ').collect::<Vec<_>>(), words);
    };
    refused("scene.kdl 640 0", &["640 0 lies outside", "0 to 639"]);
    refused("scene.kdl 0 -1", &["-1"]);
    refused("scene.kdl 0", &["<Y>"]);
    refused("scene.kdl 0 0 --camera frnt", &["did you mean `front`?"]);
}

/// What is answered about the rays in a folder.
fn cast(folder: &Path, more: &[&str]) -> String {
    let ran = catoptra(folder, &[&["cast", "scene.kdl", "rays"], more].concat());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{more:?}");
    ran.out
}

#[test]
fn rays_are_answered_line_by_line() {
    let folder = folder();
    fs::write(folder.path().join("rays"), RAYS).unwrap();
    let cast = |more: &[&str]| cast(folder.path(), more);
    let nearest = "# down\n7 ball 0 0 2 0 0 1 0\n\n4.5 floor 0 3 0 0 0 1 0\nmiss\nmiss\n";
    for more in [&[][..], &["--backend", "oracle"], &["--threads", "1"]] {
        assert_eq!(cast(more), nearest);
    }
    assert_eq!(cast(&["--any"]), "# down\n1\n\n1\n0\n0\n");
    let all = "# down\n1 7 ball 0 0 2 0 0 1 0\n1 9 floor 0 0 0 0 0 1 0\n1 9 ball 0 0 0 0 0 -1 0\n\n\
               2 4.5 floor 0 3 0 0 0 1 0\n3 miss\n4 miss\n";
    assert_eq!(cast(&["--all"]), all);
}

#[test]
fn one_thing_can_be_left_out() {
    let folder = folder();
    fs::write(folder.path().join("rays"), RAYS).unwrap();
    let cast = |more: &[&str]| cast(folder.path(), more);
    assert_eq!(
        cast(&["--without", "ball"]),
        "# down\n9 floor 0 0 0 0 0 1 0\n\n4.5 floor 0 3 0 0 0 1 0\nmiss\nmiss\n"
    );
    assert_eq!(cast(&["--any", "--without", "floor"]), "# down\n1\n\n0\n0\n0\n");
    let all = "# down\n1 7 ball 0 0 2 0 0 1 0\n1 9 ball 0 0 0 0 0 -1 0\n\n2 miss\n3 miss\n4 miss\n";
    assert_eq!(cast(&["--all", "--without", "floor"]), all);
    let refused = |more: &[&str], words: &[&str]| {
        assert_refused(folder.path(), &[&["cast", "scene.kdl", "rays", "--without"], more].concat(), words);
    };
    refused(&["bal"], &["no thing that rays can meet is named `bal`", "did you mean `ball`?"]);
    refused(&["front"], &["is named `front`"]);
    refused(&["ball", "--backend", "scalar"], &["cannot be used with"]);
}

#[test]
fn meshes_tell_their_triangles() {
    let folder = folder();
    let corners = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 4 4 0\n";
    fs::write(folder.path().join("m.obj"), format!("{corners}f 1 2 3\nf 2 4 3\n")).unwrap();
    let text = "matte \"w\" { color 1 }\nmesh \"a b\" material=\"w\" { file \"m.obj\" }\n\
                mesh \"c\" material=\"w\" { file \"m.obj\"; move 0 0 -1 }\n";
    fs::write(folder.path().join("mesh.kdl"), text).unwrap();
    fs::write(folder.path().join("rays"), "1 1 5 0 0 -1\n3 3 5 0 0 -1\n2 2 5 0 0 -1\n").unwrap();
    let ran = catoptra(folder.path(), &["cast", "mesh.kdl", "rays", "--all"]);
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines.len(), 8, "at an edge both triangles are told\n{}", ran.out);
    assert_eq!(lines[..2], ["1 5 \"a b\" 0 1 1 0 0 0 1", "1 6 c 0 1 1 -1 0 0 1"]);
    assert_eq!(lines[2], "2 5 \"a b\" 1 3 3 0 0 0 1");
}

#[cfg(unix)]
#[test]
fn rays_and_scenes_come_from_standard_input() {
    let folder = folder();
    fs::write(folder.path().join("rays"), "0 9 0 0 -1 0\n").unwrap();
    for line in ["$catoptra cast scene.kdl - < rays", "$catoptra cast - rays < scene.kdl"] {
        let ran = crate::program::shell(folder.path(), line);
        assert_eq!(
            (ran.code, ran.out.as_str(), ran.err.as_str()),
            (0, "7 ball 0 0 2 0 0 1 0\n", ""),
            "{line}"
        );
    }
    assert_refused(folder.path(), &["cast", "-", "-"], &["both", "standard input"]);
}

#[test]
fn slips_in_rays_are_told_with_their_place() {
    let folder = folder();
    fs::write(folder.path().join("rays"), "0 9 0 0 -1 0\n0 9 0 0 0 0\n").unwrap();
    assert_refused(
        folder.path(),
        &["cast", "scene.kdl", "rays"],
        &["rays:2:7: the direction", "x y z dx dy dz"],
    );
    assert_refused(folder.path(), &["cast", "scene.kdl", "rays", "--any", "--all"], &["cannot be used with"]);
    assert_refused(folder.path(), &["cast", "scene.kdl", "nowhere"], &["nowhere cannot be read"]);
    assert_refused(
        folder.path(),
        &["cast", "scene.kdl", "rays", "--backend", "wied"],
        &["did you mean `wide`?"],
    );
}
