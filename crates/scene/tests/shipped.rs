//! Do all scene files in `scenes/` load, come back from a save as they were, and stay what the documentation says?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::{Path, PathBuf};

use catoptra_core::scene::Settings;
use catoptra_core::{Camera, Field, FieldKind, Finish, Light, Material, Shape, Texture, Value};
use catoptra_scene::{load, model, parse};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

fn shipped() -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = ["seed", "gallery"]
        .iter()
        .flat_map(|name| std::fs::read_dir(folder().join(name)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "kdl"))
        .collect();
    files.sort();
    files
}

#[test]
fn every_shipped_scene_loads_and_has_a_camera() {
    let files = shipped();
    assert!(files.len() >= 20, "only {} scenes", files.len());
    for path in files {
        let (scene, _) = load(&path).unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)));
        assert!(scene.main_camera().is_some(), "{}", path.display());
    }
}

#[test]
fn saving_without_an_edit_changes_no_byte() {
    for path in shipped() {
        let (scene, mut file) = load(&path).unwrap();
        file.update(&scene);
        assert_eq!(file.text(), std::fs::read_to_string(&path).unwrap(), "{}", path.display());
    }
}

#[test]
fn the_welcome_scene_needs_no_other_file() {
    let text = std::fs::read_to_string(folder().join("gallery/welcome.kdl")).unwrap();
    parse(&text, "welcome.kdl", None).unwrap();
}

#[test]
fn every_kind_and_field_is_documented() {
    let readme = std::fs::read_to_string(folder().join("README.md")).unwrap();
    let kinds: Vec<(&str, &[Field])> = Shape::KINDS
        .iter()
        .map(|k| (k.name, k.fields))
        .chain(Light::KINDS.iter().map(|k| (k.name, k.fields)))
        .chain(Material::KINDS.iter().map(|k| (k.name, k.fields)))
        .chain(Texture::KINDS.iter().map(|k| (k.name, k.fields)))
        .chain([("Fields of any material", Finish::KIND.fields)])
        .chain([(Camera::KIND.name, Camera::KIND.fields), (Settings::KIND.name, Settings::KIND.fields)])
        .collect();
    for (kind, fields) in kinds {
        let heading = if kind.contains(' ') { format!("### {kind}") } else { format!("### `{kind}`") };
        let Some((_, section)) = readme.split_once(&heading) else { panic!("{kind} has no section") };
        let section = section.split("\n##").next().unwrap_or_default();
        for field in fields {
            let row = section.lines().find(|line| line.starts_with(&format!("| `{}` |", field.name)));
            let row = row.unwrap_or_else(|| panic!("{kind} lacks {}", field.name));
            let cells: Vec<&str> = row.split('|').map(str::trim).collect();
            assert_eq!(cells[2..4], [word_for(field.kind), unit_of(field)], "{row}");
            let default = field.default.map(|default| default());
            if let Some(Value::Flag(on)) = default {
                assert_eq!(cells[4], format!("#{on}"), "{row}");
            } else if let Some(Value::Number(number)) = default {
                let degrees = field.kind == FieldKind::Angle;
                let number = if degrees { number.to_degrees() } else { number };
                assert_eq!(cells[4].parse(), Ok(number), "{row}");
            }
        }
    }
}

#[test]
fn every_format_of_models_is_documented() {
    let readme = std::fs::read_to_string(folder().join("README.md")).unwrap();
    let (_, section) = readme.split_once("### `model`").unwrap();
    let section = section.split("\n##").next().unwrap_or_default();
    for ending in model::endings() {
        assert!(section.contains(&format!("`.{ending}`")), "{ending}");
    }
}

/// What the table of kinds calls a kind.
fn word_for(kind: FieldKind) -> &'static str {
    match kind {
        FieldKind::Number => "number",
        FieldKind::Length => "length",
        FieldKind::Count => "count",
        FieldKind::Fraction => "fraction",
        FieldKind::Angle => "angle",
        FieldKind::Point => "point",
        FieldKind::Direction => "direction",
        FieldKind::Color => "color",
        FieldKind::Quantity => "quantity",
        FieldKind::Flag => "flag",
        FieldKind::Choice(_) => "choice",
        FieldKind::Mesh => "mesh",
        FieldKind::Profile => "profile",
        FieldKind::Pair => "pair",
        FieldKind::Image => "image",
        FieldKind::Texture => "texture",
        FieldKind::Rows(2) => "pairs",
        FieldKind::Rows(3) => "points",
        FieldKind::Rows(_) => "rows",
    }
}

fn unit_of(field: &Field) -> &'static str {
    if field.kind == FieldKind::Angle { "°" } else { field.unit }
}
