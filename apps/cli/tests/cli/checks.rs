//! Do `catoptra check` and `catoptra fmt` find what they are for, and end as scripts expect?

use std::fs;

use serde_json::Value;

use crate::program::{assert_refused, catoptra, folder};

#[test]
fn a_scene_in_order_has_nothing_to_tell() {
    let folder = folder();
    let ran = catoptra(folder.path(), &["check", "scene.kdl"]);
    assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "", ""));
    assert_eq!(catoptra(folder.path(), &["check", "scene.kdl", "--json", "--threads", "1"]).out, "[]\n");
}

#[test]
fn what_is_odd_is_told_with_its_line_and_ends_with_1() {
    let folder = folder();
    let text = "camera \"c\" { eye 0 2 5; target 0 0 0 }\nmatte \"m\" { color 1 }\nmatte \"spare\" { color 1 }\n\
                plane \"floor\" material=\"m\"\ndisk \"rug\" material=\"m\" { center 0 0 0; normal 0 1 0; radius 1 }\n\
                sphere \"behind\" material=\"m\" { center 0 1 9; radius 1 }\n\
                spot-light \"up\" { position 0 1 0; direction 0 1 0; intensity 9; inner 10; outer 20 }\n";
    fs::write(folder.path().join("odd.kdl"), text).unwrap();
    let ran = catoptra(folder.path(), &["check", "scene.kdl", "odd.kdl"]);
    assert_eq!((ran.code, ran.err.as_str()), (1, ""));
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines[0], "odd.kdl:3: material \"spare\" is used by nothing [unused]");
    assert_eq!(
        lines[1],
        "odd.kdl:5: \"rug\" is met by no ray of 320x240: it is behind others, or too small [unseen]"
    );
    assert_eq!(lines[2], "odd.kdl:6: \"behind\" lies outside what the cameras see [unseen]");
    assert_eq!(lines[3], "odd.kdl:7: light \"up\" reaches nothing [dark]");
    assert!(lines[4].starts_with("odd.kdl:5: \"rug\" lies in the surface of \"floor\", at "), "{}", ran.out);
    assert_eq!(lines.len(), 5);
    let ran = catoptra(folder.path(), &["check", "odd.kdl", "--json", "--size", "64x48"]);
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((ran.code, &found[0]["lint"], &found[0]["line"]), (1, &"unused".into(), &3.into()));
}

#[test]
fn a_scene_that_is_none_is_refused() {
    let folder = folder();
    fs::write(folder.path().join("bad.kdl"), "sphre \"a\"\n").unwrap();
    assert_refused(folder.path(), &["check", "bad.kdl"], &["bad.kdl:1:1", "sphere"]);
    assert_refused(folder.path(), &["check"], &["SCENE"]);
    assert_refused(folder.path(), &["fmt", "bad.kdl", "none.kdl"], &["none.kdl cannot be read"]);
    fs::write(folder.path().join("open.kdl"), "group \"a\" {\n").unwrap();
    assert_refused(folder.path(), &["fmt", "open.kdl"], &["open.kdl:1"]);
}

#[test]
fn formatting_changes_blanks_and_nothing_else() {
    let folder = folder();
    let path = folder.path().join("a.kdl");
    let (loose, tidy) = (
        "// a ball\n\n\n\nsphere   \"a\"   material=\"m\" {radius 1;  center 0 1.50 0 }   // here\nmatte \"m\" {\n color 1 }\n",
        "// a ball\n\nsphere \"a\" material=\"m\" { radius 1; center 0 1.50 0 }  // here\nmatte \"m\" {\n    color 1\n}\n",
    );
    fs::write(&path, loose).unwrap();
    let ran = catoptra(folder.path(), &["fmt", "--check", "a.kdl"]);
    assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (1, "a.kdl\n", ""));
    assert_eq!(fs::read_to_string(&path).unwrap(), loose);
    let ran = catoptra(folder.path(), &["fmt", "a.kdl"]);
    assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "", ""));
    assert_eq!(fs::read_to_string(&path).unwrap(), tidy);
    let ran = catoptra(folder.path(), &["fmt", "--check", "a.kdl"]);
    assert_eq!((ran.code, ran.out.as_str()), (0, ""));
}

#[cfg(unix)]
#[test]
fn standard_input_is_formatted_to_standard_output() {
    let folder = folder();
    let ran = crate::program::shell(folder.path(), "echo 'a   {b 1}' | $catoptra fmt -");
    assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "a { b 1 }\n", ""));
    let ran = crate::program::shell(folder.path(), "echo 'a   {b 1}' | $catoptra fmt --check -");
    assert_eq!((ran.code, ran.out.as_str()), (1, "<stdin>\n"));
    let ran = crate::program::shell(folder.path(), "$catoptra check - < scene.kdl");
    assert_eq!((ran.code, ran.out.as_str()), (0, ""));
}

#[test]
fn shipped_scenes_are_formatted() {
    let folder = folder();
    for kind in ["seed", "gallery"] {
        for entry in fs::read_dir(crate::program::shipped(kind)).unwrap() {
            let path = entry.unwrap().path().display().to_string();
            if path.ends_with(".kdl") {
                let ran = catoptra(folder.path(), &["fmt", "--check", &path]);
                assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{path}");
            }
        }
    }
}
