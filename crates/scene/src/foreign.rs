//! What is a file that was given as a scene, where it is something else, and what can be done with it?

use std::path::Path;

use crate::model;

/// Endings of models that no mesh is read from here.
const MODELS: &[&str] = &["3ds", "3mf", "abc", "blend", "dae", "fbx", "off", "usd", "usda", "usdc", "usdz"];

/// Endings of pictures.
const PICTURES: &[&str] =
    &["bmp", "exr", "gif", "hdr", "jpeg", "jpg", "png", "ppm", "tga", "tif", "tiff", "webp"];

/// How files begin, and the ending that they should have.
const BEGINNINGS: &[(&[u8], &str)] = &[
    (b"\x89PNG", "png"),
    (b"\x76\x2f\x31\x01", "exr"),
    (b"\xff\xd8\xff", "jpg"),
    (b"GIF8", "gif"),
    (b"IESNA", "ies"),
    (b"IES:LM", "ies"),
];

/// Bytes from the start that are looked through for what no text holds.
const LOOKED_THROUGH: usize = 8192;

/// What it is, to be read after the file's name, and what to do about it; `None` for what may be scene text.
pub(crate) fn told(name: &Path, bytes: &[u8]) -> Option<(String, String)> {
    let given =
        name.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let ending = by_content(bytes).unwrap_or(&given);
    let shown = name.display();
    if model::endings().any(|known| known == ending) {
        let rename = if given == ending { String::new() } else { format!("call it something.{ending} and ") };
        let help =
            format!("{rename}name it in a scene: mesh \"NAME\" material=\"MATERIAL\" {{ file \"{shown}\" }}");
        return Some(("is a mesh, not a scene".to_owned(), help));
    }
    if ending == "ies" {
        let help = format!("name it in a scene: point-light \"NAME\" profile=\"{shown}\"");
        return Some(("is the profile of a luminaire, not a scene".to_owned(), help));
    }
    if MODELS.contains(&ending) {
        let help = format!(
            "make it a mesh ({}) and name that in a scene: mesh \"NAME\" material=\"MATERIAL\" {{ file \"...\" }}",
            model::endings().map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(" or ")
        );
        return Some((format!("is a model (.{ending}), not a scene"), help));
    }
    if PICTURES.contains(&ending) {
        return Some(("is a picture, not a scene".to_owned(), SCENES.to_owned()));
    }
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Some(("is UTF-16 text".to_owned(), "save the file as UTF-8".to_owned()));
    }
    let start = &bytes[..bytes.len().min(LOOKED_THROUGH)];
    start.contains(&0).then(|| ("is a binary file, not a scene".to_owned(), SCENES.to_owned()))
}

const SCENES: &str = "a scene is text, such as: camera \"eye\" { eye 0 2 6; target 0 1 0 }";

/// The ending that a file of such content should have, where no scene could look like it.
fn by_content(bytes: &[u8]) -> Option<&'static str> {
    let magic = BEGINNINGS.iter().find(|(beginning, _)| bytes.starts_with(beginning));
    if let Some((_, ending)) = magic {
        return Some(ending);
    }
    model::of_content(bytes).map(|format| format.endings[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(name: &str, bytes: &[u8]) -> String {
        told(Path::new(name), bytes).map(|(message, help)| format!("{message}; {help}")).unwrap_or_default()
    }

    #[test]
    fn meshes_are_told_by_name_and_by_content() {
        for (name, bytes) in [
            ("m.obj", &b""[..]),
            ("M.PLY", b""),
            ("m.kdl", b"ply\nformat ascii 1.0\n"),
            ("m", b"# by hand\n\nv 0 0 1\n"),
            ("m.txt", b"solid cube\n facet normal 0 0 1\n"),
            ("m.stl", b""),
            ("m", b"glTF\x02"),
            ("m", b"{\n \"asset\": {}"),
        ] {
            let message = message(name, bytes);
            assert!(
                message.contains("is a mesh") && message.contains(&format!("file \"{name}\"")),
                "{message}"
            );
        }
        assert!(message("m.kdl", b"ply\r\n").contains("call it something.ply"));
    }

    #[test]
    fn profiles_are_told() {
        for (name, bytes) in [("lamp.IES", &b""[..]), ("lamp.txt", b"IESNA:LM-63-2002\r\n")] {
            assert!(message(name, bytes).contains(&format!("profile=\"{name}\"")), "{name}");
        }
    }

    #[test]
    fn models_and_pictures_are_told() {
        assert!(message("m.fbx", b"").contains(".obj"));
        for (name, bytes) in [("a.png", &b""[..]), ("a.kdl", b"\x89PNG\r\n"), ("a.JPG", b"")] {
            assert!(message(name, bytes).contains("is a picture"), "{name}");
        }
    }

    #[test]
    fn other_bytes_are_told_and_text_is_not() {
        assert!(message("a.kdl", b"\xff\xfem\0").contains("UTF-16"));
        assert!(message("a.kdl", b"\x7fELF\0\0").contains("binary"));
        for text in ["", "sphere \"a\"", "// v 1\nmatte \"v\"", "{", "solid 1", "/- o", "\u{fffd}"] {
            assert_eq!(told(Path::new("a.kdl"), text.as_bytes()), None, "{text}");
        }
    }
}
