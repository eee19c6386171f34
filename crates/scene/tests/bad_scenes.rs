//! Is every bad scene file refused with its place, what is wrong, and what to do about it?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_scene::{SceneTextError, load, load_from, parse};

/// A bad text, the line and column of the complaint, and parts of the message and of the hint.
struct Case(&'static str, (usize, usize), &'static str, &'static str);

const W: &str = "matte \"w\" { color 1 1 1 }\n";

/// Texts that follow the material `w` in line 1.
const AFTER_A_MATERIAL: &[Case] = &[
    // Words
    Case(
        "shpere \"s\" material=\"w\" { radius 1 }",
        (2, 1),
        "unknown word \"shpere\"",
        "did you mean \"sphere\"?",
    ),
    Case("teapot \"t\" material=\"w\"", (2, 1), "unknown word \"teapot\"", "known words, none of them near"),
    Case("Sphere \"s\" material=\"w\" { radius 1 }", (2, 1), "unknown word \"Sphere\"", "\"sphere\""),
    Case("spotlight \"s\"", (2, 1), "unknown word \"spotlight\"", "\"spot-light\""),
    Case(
        "sphere \"s\" material=\"w\" {\n  raduis 1\n}",
        (3, 3),
        "a sphere has no \"raduis\"",
        "did you mean \"radius\"?",
    ),
    Case("sphere \"s\" material=\"w\" raduis=1", (2, 25), "a sphere has no \"raduis\"", "\"radius\""),
    Case("sphere \"s\" matreial=\"w\" { radius 1 }", (2, 12), "no \"matreial\"", "\"material\""),
    Case(
        "sphere \"s\" material=\"W2\" { radius 1 }",
        (2, 21),
        "there is no material \"W2\"",
        "did you mean \"w\"?",
    ),
    Case("plane \"p\" material=\"velvet\"", (2, 20), "there is no material \"velvet\"", "materials: w"),
    Case(
        "phong \"p\" { diffuse 1; model \"clasic\" }",
        (2, 30),
        "classic, normalised, not \"clasic\"",
        "\"classic\"",
    ),
    Case("matte \"m\" { color 1; move 1 0 0 }", (2, 22), "a matte has no \"move\"", ""),
    Case("sphere \"s\" material=\"w\" { radius 1; movee 1 0 0 }", (2, 37), "no \"movee\"", "\"move\""),
    Case("settings { depth 3 }", (2, 12), "settings has no \"depth\"", "max-depth"),
    // Numbers and kinds of values
    Case("sphere \"s\" material=\"w\" { radius -1 }", (2, 27), "radius must be greater than 0, not -1", ""),
    Case("sphere \"s\" material=\"w\" { radius 0 }", (2, 27), "radius must be greater than 0", ""),
    Case("sphere \"s\" material=\"w\" { radius #nan }", (2, 34), "finite numbers, not #nan", ""),
    Case("sphere \"s\" material=\"w\" { radius #inf }", (2, 34), "finite numbers, not #inf", ""),
    Case("sphere \"s\" material=\"w\" { radius 1e999 }", (2, 34), "finite numbers, not 1e999", ""),
    Case("sphere \"s\" material=\"w\" { radius \"1\" }", (2, 34), "radius needs a number, not \"1\"", ""),
    Case("sphere \"s\" material=\"w\" { radius one }", (2, 34), "radius needs a number, not one", ""),
    Case("sphere \"s\" material=\"w\" { radius #true }", (2, 34), "needs a number, not #true", ""),
    Case("sphere \"s\" material=\"w\" { radius }", (2, 27), "radius takes one number, not 0 values", ""),
    Case("sphere \"s\" material=\"w\" { radius 1 2 }", (2, 27), "radius takes one number, not 2 values", ""),
    Case(
        "sphere \"s\" material=\"w\" { radius 1; center 0 1 }",
        (2, 37),
        "center takes three numbers, not 2",
        "",
    ),
    Case(
        "sphere \"s\" material=\"w\" { radius 1; center 0 \"a\" #nan }",
        (2, 46),
        "center needs a number, not \"a\"",
        "",
    ),
    Case(
        "sphere \"s\" material=\"w\" center=3 { radius 1 }",
        (2, 25),
        "center takes three numbers",
        "center x y z",
    ),
    Case("sphere \"s\" material=\"w\" { radius 1 { x 2 } }", (2, 38), "radius has values, and no block", ""),
    Case("sphere \"s\" material=\"w\" { radius 1 r=1 }", (2, 36), "radius has no property r", ""),
    Case("sphere \"s\" material=\"w\" { radius (m)1 }", (2, 35), "type annotations", ""),
    Case("matte \"m\" { color 1 0.5 1.5 }", (2, 13), "color must be a colour with channels in 0..1", ""),
    Case("matte \"m\" { color -0.1 }", (2, 13), "color must be a colour", ""),
    Case("matte \"m\" { color 1; reflectiveness 2 }", (2, 22), "reflectiveness must lie in 0..1, not 2", ""),
    Case("point-light \"l\" { intensity -1 }", (2, 19), "intensity must be light", ""),
    Case("point-light \"l\" { intensity 1; shadow 0 }", (2, 39), "shadow needs #true or #false, not 0", ""),
    Case(
        "spot-light \"l\" { direction 0 -1 0; intensity 1; inner 50; outer 40 }",
        (2, 59),
        "outer must not be under inner",
        "",
    ),
    Case(
        "spot-light \"l\" { direction 0 0 0; intensity 1; inner 5; outer 40 }",
        (2, 18),
        "direction must not be zero",
        "",
    ),
    Case(
        "directional-light \"l\" { direction 0 0 0; irradiance 1 }",
        (2, 25),
        "direction must not be zero",
        "",
    ),
    Case("plane \"p\" material=\"w\" { normal 0 0 0 }", (2, 26), "normal must not be zero", ""),
    Case(
        "rectangle \"r\" material=\"w\" { corner 0 0 0; edge-u 1 0 0; edge-v 1 1 0 }",
        (2, 58),
        "edge-v must be perpendicular to edge-u, not at 45° to it",
        "write edge-v 0 1 0",
    ),
    Case("box \"b\" material=\"w\" { min 0 0 0; max 1 -1 1 }", (2, 35), "max must not be below min", ""),
    Case(
        "triangle \"t\" material=\"w\" { a 0 0 0; b 1 0 0; c 2 0 0 }",
        (2, 47),
        "c must not lie on one line",
        "",
    ),
    Case("checker \"c\" scale=0", (2, 13), "scale must be greater than 0", ""),
    Case("camera \"c\" { eye 0 0 0; target 0 0 0 }", (2, 25), "target must lie in a direction", ""),
    Case("camera \"c\" { eye 0 0 5; direction 0 -1 0; up 0 -1 0 }", (2, 43), "up must not be", "up 0 1 0"),
    Case(
        "camera \"c\" { eye 0 0 5; direction 0 0 -1; fov 180 }",
        (2, 43),
        "fov must lie between 0 and 180",
        "",
    ),
    Case("settings { max-depth 1000000000 }", (2, 12), "max-depth must be a whole number in 0..1000", ""),
    Case("settings { max-depth 2.5 }", (2, 12), "max-depth must be a whole number", ""),
    Case(
        "settings { integrator \"oclusion\" }",
        (2, 23),
        "integrator is one of whitted, path, occlusion",
        "did you mean \"occlusion\"?",
    ),
    Case("settings { occlusion-distance 0 }", (2, 12), "occlusion-distance must be greater than 0", ""),
    // What is missing or there twice
    Case("sphere \"s\" material=\"w\"", (2, 1), "this sphere needs a radius", "must be given radius"),
    Case(
        "sphere \"s\" { radius 1 }",
        (2, 1),
        "this sphere needs a material",
        "material=\"name of a material\"",
    ),
    Case(
        "sphere material=\"w\" { radius 1 }",
        (2, 1),
        "this sphere needs a name",
        "write sphere \"some name\"",
    ),
    Case("sphere \"\" material=\"w\" { radius 1 }", (2, 8), "a name must not be empty", ""),
    Case("sphere 1 material=\"w\" { radius 1 }", (2, 8), "stands in quotes, 1 does not", ""),
    Case("sphere \"s\" 1 material=\"w\" { radius 1 }", (2, 12), "has only one name", "in the block"),
    Case("sphere \"s\" material=\"w\" {\n radius 1\n radius 2\n}", (4, 2), "radius is given twice", "line 3"),
    Case("sphere \"s\" material=\"w\" radius=1 { radius 2 }", (2, 36), "radius is given twice", "line 2"),
    Case("sphere \"s\" material=\"w\" material=\"w\" radius=1", (2, 34), "material is given twice", ""),
    Case("matte \"w\" { color 0 0 0 }", (2, 7), "\"w\" is taken by another material", "line 1"),
    Case(
        "plane \"p\" material=\"w\"\nambient-light \"p\" radiance=1",
        (3, 15),
        "\"p\" is taken by another",
        "line 2",
    ),
    Case("group \"g\" {\n  group \"g\"\n}", (3, 9), "\"g\" is taken by another", "line 2"),
    Case("settings\nsettings", (3, 1), "settings are given twice", "line 2"),
    Case("settings \"s\"", (2, 10), "settings have no name", ""),
    Case("camera \"c\" { eye 0 0 5 }", (2, 1), "target", ""),
    // Groups and placements
    Case("group \"g\" { matte \"m\" { color 1 } }", (2, 13), "a matte cannot stand in a group", "at the top"),
    Case("group \"g\" { shpere \"s\" }", (2, 13), "unknown word \"shpere\"", "\"sphere\""),
    Case("sphere \"s\" material=\"w\" { radius 1; plane \"p\" }", (2, 37), "only a group can", ""),
    Case("group \"g\" { move 1 2 }", (2, 13), "move takes three numbers: x y z, not 2 values", ""),
    Case("group \"g\" { turn 30 0 0 0 }", (2, 13), "turn must have an axis", ""),
    Case("group \"g\" { turn 30 0 1 0 { abuot 1 2 3 } }", (2, 29), "turn has no abuot", "about x y z"),
    Case("group \"g\" { scale 0 }", (2, 13), "scale must be greater than 0", ""),
    Case("group \"g\" { scale 1e300; scale 1e300 }", (2, 26), "scale must be greater than 0 and finite", ""),
    Case("group \"g\" { seed-turn 1 x }", (2, 25), "seed-turn needs a number, not x", ""),
    // Syntax
    Case(
        "sphere \"s\" material=\"w\" {\n  radius 1",
        (2, 25),
        "this sphere is never closed",
        "close it with }",
    ),
    Case("}", (2, 1), "no block to close", "leave the } away"),
    Case("sphere \"s material=w {\n radius 1 }", (2, 8), "never closed", "write \"s\""),
    Case("sphere \"s\" material=\"w\" { radius 1..5 }", (2, 34), "1..5 is no number", "such as 0.5"),
    Case("point-light \"l\" { intensity 1; shadow false }", (2, 39), "", "write #false"),
    Case(
        "sphere \"s\" material=\"w\" { radius 1 } /* never closed",
        (2, 38),
        "comment is never closed",
        "close it with */",
    ),
    Case("settings {\n  max-depth 0x\n}", (3, 13), "0x is no number", "such as 0.5"),
    Case("{ radius 1 }", (2, 1), "behind no word", "write what it is before it"),
    // Meshes
    Case(
        "mesh \"m\" material=\"w\" file=\"none.ply\"",
        (2, 28),
        "none.ply: cannot be read",
        "relative to the folder",
    ),
    Case("mesh \"m\" material=\"w\" { file \"a.off\" }", (2, 30), "must end in one of .ply, .obj", ""),
    Case("mesh \"m\" material=\"w\" { file 3 }", (2, 30), "a path in quotes, not 3", ""),
    Case("mesh \"m\" material=\"w\"", (2, 1), "this mesh needs a file", ""),
    Case(
        "mesh \"m\" material=\"w\" { file \"bad.ply\" }",
        (2, 30),
        "bad.ply:11: a face refers to vertex 7",
        "",
    ),
];

fn refused(text: &str) -> SceneTextError {
    let folder = tempfile::tempdir().unwrap();
    let mesh = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
                element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0 7\n";
    std::fs::write(folder.path().join("bad.ply"), mesh).unwrap();
    match parse(text, "bad.kdl", Some(folder.path())) {
        Ok(_) => panic!("was read:\n{text}"),
        Err(error) => error,
    }
}

#[test]
fn every_bad_scene_is_refused_with_its_place_and_a_hint() {
    let mut wrong = Vec::new();
    for Case(text, place, message, hint) in AFTER_A_MATERIAL {
        let error = refused(&format!("{W}{text}"));
        let first = &error.complaints()[0];
        let right = (first.line(), first.column()) == *place
            && first.message().contains(message)
            && first.hint().unwrap_or_default().contains(hint)
            && error.to_string().starts_with(&format!("bad.kdl:{}:{}: ", place.0, place.1));
        if !right {
            wrong.push(format!(
                "{text}\n   expected {place:?} {message:?} {hint:?}\n   got {error} | {:?}",
                first.hint()
            ));
        }
    }
    assert!(AFTER_A_MATERIAL.len() >= 40);
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn one_look_tells_everything_that_is_wrong() {
    let text =
        "sphere \"a\" material=\"red\" { radius -1 }\nplnae \"b\"\npoint-light \"c\" { intensity 1 2 }\n";
    let error = refused(text);
    let lines: Vec<usize> = error.complaints().iter().map(catoptra_scene::Complaint::line).collect();
    assert_eq!(lines, [1, 1, 2, 3]);
    assert!(error.to_string().ends_with("(and 3 more errors)"), "{error}");
}

#[test]
fn the_report_shows_the_source_line_and_the_hint() {
    let error = refused("matte \"w\" { color 1 }\nplane \"p\" materail=\"w\"");
    assert_eq!((error.line(), error.column(), error.file()), (Some(2), Some(11), Path::new("bad.kdl")));
    let report = format!("{:?}", miette::Report::new(error));
    for part in ["bad.kdl", "plane \"p\" materail=\"w\"", "no \"materail\"", "did you mean \"material\"?"] {
        assert!(report.contains(part), "{part} is not in\n{report}");
    }
}

#[test]
fn columns_count_characters() {
    let error = refused("camera \"Übersicht 日本\" { eye 0 0 a; direction 0 0 -1 }");
    assert_eq!(error.column(), Some(33));
}

#[test]
fn a_flood_of_errors_is_counted_not_told() {
    let error = refused(&"nonsense\n".repeat(10_000));
    assert!(error.complaints().len() <= 50);
    assert!(error.to_string().ends_with("(and 9999 more errors)"), "{error}");
}

#[test]
fn nesting_without_end_is_refused() {
    for (text, column) in [("group \"g\" {", 11 * 68 + 11), ("/*", 1), ("x {", 3 * 68 + 3), ("\" { /*", 1)] {
        let error = refused(&text.repeat(100_000));
        if column > 1 {
            assert_eq!(error.column(), Some(column), "{error}");
            assert!(error.to_string().contains("deep inside each other"), "{error}");
        }
    }
}

#[test]
fn groups_deeper_than_a_scene_allows_are_refused() {
    let open: String = (0..66).map(|i| format!("group \"g{i}\" {{")).collect();
    let error = refused(&format!("{open}{}", "}".repeat(66)));
    assert!(error.to_string().contains("more than 64 groups"), "{error}");
}

#[test]
fn a_mesh_without_a_folder_says_so() {
    let Err(error) = parse("matte \"w\" color=1\nmesh \"m\" material=\"w\" file=\"a.ply\"", "built in", None)
    else {
        panic!("was read");
    };
    assert!(error.to_string().contains("no folder"), "{error}");
}

#[test]
fn an_empty_file_is_an_empty_scene() {
    let (scene, _) = parse("", "empty.kdl", None).unwrap();
    assert_eq!(scene.entities().len(), 0);
}

fn written(bytes: &[u8]) -> SceneTextError {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.kdl");
    std::fs::write(&path, bytes).unwrap();
    match load(&path) {
        Ok(_) => panic!("was read"),
        Err(error) => error,
    }
}

#[test]
fn bytes_that_are_no_text_are_refused_with_their_place() {
    let error = written(b"matte \"w\" color=1\nplane \"\xff\" material=\"w\"");
    assert_eq!((error.line(), error.column()), (Some(2), Some(8)));
    assert!(error.to_string().contains("no UTF-8"), "{error}");
    assert_eq!(error.hint(), Some("save the file as UTF-8"));
}

#[test]
fn a_file_longer_than_any_scene_is_refused_unread() {
    let error = written(&vec![b' '; (16 << 20) + 1]);
    assert!(error.to_string().contains("longer than 16 MiB"), "{error}");
}

#[test]
fn a_missing_file_and_a_folder_say_why() {
    for (path, why) in [("/no/such/scene.kdl", "cannot be read: "), ("/", "is a folder")] {
        let Err(error) = load(Path::new(path)) else { panic!("was read") };
        assert!(error.to_string().starts_with(&format!("{path}: {why}")), "{error}");
        assert_eq!((error.line(), error.file()), (None, Path::new(path)));
        // A report adds the sources of an error to its message, which tells the cause already.
        assert!(std::error::Error::source(&error).is_none());
    }
}

#[test]
fn what_is_no_scene_is_told_whatever_its_size() {
    let error = written(&b"v 0 0 1\n".repeat(3 << 20));
    assert!(error.to_string().ends_with("bad.kdl: is a mesh, not a scene"), "{error}");
    assert!(error.hint().is_some_and(|hint| hint.contains("name it in a scene")), "{error}");
    assert!(written(b"\x89PNG\r\n\x1a\n\0").to_string().contains("is a picture"));
}

#[cfg(unix)]
#[test]
fn a_device_is_no_scene() {
    let Err(error) = load(Path::new("/dev/zero")) else { panic!("was read") };
    assert!(error.to_string().contains("is a device"), "{error}");
}

#[test]
fn a_scene_is_read_from_any_input_and_finds_its_meshes_in_the_folder_given() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let text = "matte \"w\" { color 1 }\nmesh \"m\" material=\"w\" { file \"m.obj\" }\n";
    let (_, file) = load_from(text.as_bytes(), Path::new("<stdin>"), folder.path()).unwrap();
    assert_eq!(file.path(), None);
    assert_eq!(file.mesh_paths().collect::<Vec<_>>(), [folder.path().join("m.obj")]);
    let Err(error) = load_from(&b"?"[..], Path::new("<stdin>"), folder.path()) else { panic!("was read") };
    assert!(error.to_string().starts_with("<stdin>:1:"), "{error}");
    let Err(error) = load_from(std::io::repeat(b' '), Path::new("<stdin>"), folder.path()) else {
        panic!("was read")
    };
    assert!(error.to_string().contains("longer than 16 MiB"), "{error}");
}
