//! Do messages stay short, speak in the units that are written, and keep from the terminal what steers it?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_scene::model::read_mesh_bytes;
use catoptra_scene::{SceneTextError, parse};

fn refused(text: &str) -> SceneTextError {
    match parse(text, "bad.kdl", None) {
        Ok(_) => panic!("was read:\n{text}"),
        Err(error) => error,
    }
}

/// The whole report, as a terminal would get it without colours.
fn report(error: &SceneTextError) -> String {
    let theme = miette::GraphicalTheme::unicode_nocolor();
    let mut out = String::new();
    miette::GraphicalReportHandler::new_themed(theme)
        .with_links(false)
        .render_report(&mut out, error)
        .unwrap();
    out
}

#[test]
fn angles_are_told_in_degrees() {
    let spot = |angles: &str| format!("spot-light \"l\" {{ direction 0 -1 0; intensity 1; {angles} }}");
    let camera = |fov: &str| format!("camera \"c\" {{ eye 0 0 4; target 0 0 0; fov {fov} }}");
    for (text, told) in [
        (spot("inner -10; outer 40"), "inner must be at least 0, not -10°"),
        (spot("inner 10; outer -40"), "outer must be greater than 0, not -40°"),
        (spot("inner 10; outer 400"), "outer must be at most 360°, not 400°"),
        (spot("inner 50; outer 40"), "outer must not be under inner, 50°, not 40°"),
        (camera("-35.5"), "fov must lie between 0 and 180 degrees, not -35.5°"),
        (camera("200"), "fov must lie between 0 and 180 degrees, not 200°"),
        (camera("0.1e41"), "not 1e40°"),
    ] {
        let error = refused(&text);
        assert!(error.to_string().ends_with(told), "{error}");
    }
}

#[test]
fn of_a_long_line_only_a_piece_is_shown() {
    let spheres: String =
        (0..1500).map(|i| format!("sphere \"s{i}\" material=\"m\" {{ radius 1 }}; ")).collect();
    let text = format!("matte \"m\" {{ color 1 }}; {spheres}plnae \"p\"; {spheres}");
    let error = refused(&text.replacen("\"s0\" material", "\"first\" material", 1));
    let first = &error.complaints()[0];
    assert_eq!((first.line(), first.message()), (1, "unknown word \"plnae\""));
    let place = format!("[bad.kdl:1:{}]", first.column());
    let shown = report(&error);
    assert!(shown.contains(&place) && shown.contains("plnae \"p\""), "{shown}");
    assert!(shown.len() < 60_000, "{} bytes", shown.len());
    assert!(shown.lines().all(|line| line.chars().count() < 200));
}

#[test]
fn of_long_words_and_comments_only_a_piece_is_shown() {
    let long = "x".repeat(100_000);
    let texts = [
        format!("// {long}\nplnae \"p\"\n// {long}\n"),
        format!("{long} \"p\"\n"),
        format!("sphere \"{long}\"\n"),
        format!("matte \"m\" {{ color {long} }}\n"),
        format!("matte \"m\" {{ color 1.5.{long} }}\n"),
        format!("mesh \"m\" material=\"m\" {{ file \"{long}\" }}\n"),
    ];
    for text in texts {
        let shown = report(&refused(&text));
        assert!(shown.len() < 5000, "{} bytes: {}", shown.len(), &shown[..2000]);
    }
    let obj = format!("v 0 0 {long}\n");
    assert!(read_mesh_bytes(obj.as_bytes(), Path::new("m.obj")).unwrap_err().to_string().len() < 1000);
}

#[test]
fn many_errors_are_counted() {
    let shown = report(&refused(&"radius=.5\n".repeat(10_000)));
    assert!(shown.contains("more errors)"), "{shown}");
    assert!(shown.len() < 60_000, "{} bytes", shown.len());
}

#[test]
fn nothing_that_steers_a_terminal_is_passed_on() {
    let texts = [
        "plnae \"\u{1b}[2J\u{9b}31m\u{7}\"\n",
        "sphere \"s\\u{1b}[2J\" material=\"\\u{1b}]0;x\\u{7}\" { radius 1 }\n",
        "matte \"\u{202e}m\" { color 2 }\n// \u{1b}[2J\nplnae \"a\u{200b}\"\n",
        "\u{1b}[2J\n",
        "mesh \"m\" material=\"m\" { file \"/\\u{1b}[2J.obj\" }\n",
        "a\rplnae\u{b}\u{c}\u{7f}\n",
    ];
    for text in texts {
        let error = match parse(text, "bad\u{1b}[2J.kdl", None) {
            Ok(_) => panic!("was read:\n{text}"),
            Err(error) => error,
        };
        for shown in [report(&error), error.to_string()] {
            let steers = |c: char| (c.is_control() && c != '\n') || "\u{202e}\u{200b}".contains(c);
            assert!(!shown.contains(steers), "{shown:?}");
        }
    }
}

#[test]
fn names_in_meshes_and_of_meshes_are_spelled_out() {
    let obj = "v\u{1b}[2J 0 0 0\n";
    let ply = "ply\nformat \u{1b}[31mred 1.0\n";
    for (bytes, name) in
        [(obj, "\u{1b}[2J.obj"), (ply, "m\u{202e}.ply"), (obj, "m\n.obj"), ("", "a\u{7}.stl")]
    {
        let shown = read_mesh_bytes(bytes.as_bytes(), Path::new(name)).unwrap_err().to_string();
        assert!(!shown.contains(|c: char| c.is_control() || c == '\u{202e}'), "{shown:?}");
    }
    let error = catoptra_scene::image::read_png(Path::new("/no/\u{1b}[2J.png")).unwrap_err();
    assert!(!error.to_string().contains('\u{1b}'), "{error}");
}

#[test]
fn straight_down_needs_no_up() {
    for (view, up) in [("eye 0 5 0; target 0 0 0", "0 0 -1"), ("eye 0 0 0; direction 0 2 0", "0 0 1")] {
        let (scene, _) = parse(&format!("camera \"c\" {{ {view} }}"), "down.kdl", None).unwrap();
        let (same, _) = parse(&format!("camera \"c\" {{ {view}; up {up} }}"), "down.kdl", None).unwrap();
        let axes = |scene: &catoptra_core::scene::Scene| {
            let camera = scene.camera(scene.main_camera().unwrap()).unwrap();
            (camera.right(), camera.up(), camera.forward())
        };
        assert_eq!(axes(&scene), axes(&same));
    }
}

#[test]
fn a_rectangle_that_was_rounded_is_told_as_it_should_be() {
    let rectangle = |edges: &str| {
        format!("matte \"w\" color=1\nrectangle \"r\" material=\"w\" {{ corner 0 0 0; {edges} }}")
    };
    let error = refused(&rectangle("edge-u 0.866 0 -0.5; edge-v 0.333 0.7 0.577"));
    assert!(error.to_string().contains("not at 90.00"), "{error}");
    let right = error.hint().and_then(|hint| hint.strip_prefix("write ")).unwrap();
    assert!(right.starts_with("edge-v 0.333"), "{right}");
    parse(&rectangle(&format!("edge-u 0.866 0 -0.5; {right}")), "right.kdl", None).unwrap();
}

#[test]
fn text_of_sixteen_bits_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wide.kdl");
    let wide: Vec<u8> = "\u{feff}matte \"w\"".encode_utf16().flat_map(u16::to_le_bytes).collect();
    std::fs::write(&path, wide).unwrap();
    let Err(error) = catoptra_scene::load(&path) else { panic!("was read") };
    assert!(error.to_string().contains("UTF-16") && error.hint().unwrap().contains("UTF-8"), "{error}");
    // Without its mark it is text with a NUL behind every letter.
    let wide: String = "matte \"w\" { color 1 1 1 }".chars().flat_map(|c| [c, '\0']).collect();
    let error = refused(&wide);
    assert_eq!(error.column(), Some(2), "{error}");
}
