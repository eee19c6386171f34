//! Are errors of textures told with their place and a hint, and are textures no slips?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::fs;

use catoptra_core::scene::Scene;
use catoptra_scene::image::write_png;
use catoptra_scene::{SceneFile, SceneTextError, parse};
use tempfile::TempDir;

/// A folder with a picture: red and green over blue and white.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("pictures")).unwrap();
    let bytes = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255];
    write_png(&folder.path().join("pictures/wood.png"), 2, 2, &bytes).unwrap();
    folder
}

fn read(folder: &TempDir, text: &str) -> Result<(Scene, SceneFile), SceneTextError> {
    parse(text, "room.kdl", Some(folder.path()))
}

fn refusal(folder: &TempDir, text: &str) -> SceneTextError {
    read(folder, text).err().unwrap_or_else(|| panic!("was read: {text}"))
}

/// Texts behind a texture "clouds" in the first line; where and what is wrong with each, and what the hint says.
const WRONG: &[(&str, &str, &str)] = &[
    (
        "matte \"a\" { color 1 texture=\"cluods\" }",
        "2:29: there is no texture \"cluods\"",
        "did you mean \"clouds\"?",
    ),
    (
        "matte \"a\" { color 1 texture=\"clouds\" channel=\"r\" }",
        "2:13: color must be multiplied by all of the texture's colour, not by its channel \"r\" alone",
        "a channel is for fractions",
    ),
    (
        "matte \"a\" { color 1; opacity 1 texture=\"clouds\" channel=\"alpha\" }",
        "2:57: channel is one of r, g, b, a, luminance, not \"alpha\"",
        "did you mean \"a\"?",
    ),
    (
        "matte \"a\" { color 1; opacity 1 channel=\"a\" }",
        "2:32: a channel is one of a texture, and there is none",
        "name of a texture",
    ),
    (
        "phong \"a\" { diffuse 1; shininess 5 texture=\"clouds\" }",
        "2:36: shininess takes no texture",
        "colours and fractions of materials",
    ),
    (
        "checker-texture \"a\" { color 1 texture=\"clouds\" }",
        "2:31: color takes no texture",
        "colours and fractions",
    ),
    (
        "sphere-light \"a\" { radius 1; radiance 1 texture=\"clouds\" }",
        "2:41: radiance takes no texture",
        "materials",
    ),
    ("matte \"a\" { color 1 textrue=\"clouds\" }", "2:21: color has no property textrue", ""),
    ("matte \"a\" { color 1 texture=1 }", "2:29: texture needs the name of a texture in quotes", ""),
    ("matte \"a\" { color 1 texture=\"clouds\" texture=\"clouds\" }", "2:38: texture is given twice", ""),
    ("matte \"a\" { color 1; normal-map \"fog\" }", "2:33: there is no texture \"fog\"", "clouds"),
    (
        "matte \"a\" { color 1; normal-strength 2 }",
        "2:22: normal-strength must stand beside a normal-map, not alone",
        "normal-map",
    ),
    ("matte \"a\" { color 1; sides \"both\" }", "2:28: sides is one of single, double, not \"both\"", ""),
    ("noise-texture \"clouds\"", "2:15: the name \"clouds\" is taken by another texture", "line 1"),
    ("noise-texture", "2:1: this noise-texture needs a name", ""),
    ("noise-texture \"a\" { octaves 0 }", "2:21: octaves must be a whole number in 1..16, not 0", ""),
    ("noise-texture \"a\" { scale 1 2 3 }", "2:21: scale takes two numbers or one, not 3 values", ""),
    ("noise-texture \"a\" { scale 0 2 }", "2:21: scale must not be 0, not 0 2", ""),
    ("image-texture \"a\"", "2:1: this image-texture needs a file", ""),
    ("image-texture \"a\" { file \"none.png\" }", "2:26: ", "relative to the folder"),
    ("group \"g\" { noise-texture \"a\" }", "2:13: a noise-texture cannot stand in a group", "at the top"),
    (
        "image-texture \"a\" { file \"pictures/wood.png\"; filter \"bilinear\" }",
        "2:54: filter is one of nearest, linear, ewa",
        "linear",
    ),
];

#[test]
fn what_is_wrong_is_told_with_its_place_and_a_hint() {
    let folder = folder();
    for (text, message, hint) in WRONG {
        let error = refusal(&folder, &format!("noise-texture \"clouds\"\n{text}\n"));
        let told = error.to_string();
        assert!(told.starts_with(&format!("room.kdl:{message}")), "{text}\n{told}");
        assert_eq!(error.complaints().len(), 1, "{text}: {:?}", error.complaints());
        assert!(error.hint().unwrap_or_default().contains(hint), "{text}\n{:?}", error.hint());
    }
}

/// Slips elsewhere in a text do not make slips of textures.
#[test]
fn textures_are_no_slips() {
    let folder = folder();
    let many = (0..60).fold("noise-texture \"clouds\"\n".to_owned(), |text, i| {
        text + &format!("matte \"m{i}\" {{ color 0.8 0.8 0.8 texture=\"clouds\"; opacity 1 texture=\"clouds\" channel=\"b\" }}\n")
    });
    read(&folder, &many).unwrap();
    let error = refusal(&folder, &format!("{many}sphere \"ball\" material=\"m1\" {{ radius=1 }}\n"));
    assert_eq!(error.complaints().len(), 1, "{error:?}");
    assert!(error.hint().unwrap_or_default().contains("radius 1"), "{error}");
}
