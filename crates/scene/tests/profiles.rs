//! Are intensity profiles found, read, kept and written back as scene text names them?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::fs;
use std::sync::Arc;

use catoptra_core::scene::{Edit, Scene};
use catoptra_core::{Light, Rgb, Triple, Value};
use catoptra_scene::{SceneFile, SceneTextError, load, parse};
use tempfile::TempDir;

const LAMP: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 60 90\n0\n800 200 0\n";

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("profiles")).unwrap();
    fs::write(folder.path().join("profiles/lamp.ies"), LAMP).unwrap();
    folder
}

fn read(folder: &TempDir, text: &str) -> Result<(Scene, SceneFile), SceneTextError> {
    parse(text, "room.kdl", Some(folder.path()))
}

fn refusal(folder: &TempDir, text: &str) -> SceneTextError {
    read(folder, text).err().unwrap_or_else(|| panic!("was read: {text}"))
}

fn lights(scene: &Scene) -> Vec<Light> {
    scene.entities().filter_map(|id| scene.light(id)).collect()
}

#[test]
fn a_profile_stands_in_the_block_or_before_it_and_is_read_once() {
    let folder = folder();
    let text = "point-light \"a\" profile=\"profiles/lamp.ies\" { position 0 3 0 }\n\
                point-light \"b\" { position 0 3 0; profile \"profiles/lamp.ies\"; intensity 1 }\n\
                spot-light \"c\" profile=\"profiles/lamp.ies\" { position 0 3 0; direction 0 -1 0; inner 90; outer 180 }\n";
    let (scene, file) = read(&folder, text).unwrap();
    let lights = lights(&scene);
    assert_eq!(lights[0], lights[1]);
    // Straight below at 2 m; and under 60°, 2 m below as well: 200 cd over 16 m².
    for light in &lights {
        let below = light.arriving(Triple::new(0.0, 1.0, 0.0));
        assert!((below.strength - 800.0 / 4.0).abs() < 1e-9, "{}", light.kind_name());
    }
    let aside = lights[0].arriving(Triple::new(12.0_f64.sqrt(), 1.0, 0.0));
    assert!((aside.strength - 200.0 / 16.0).abs() < 1e-9);
    let sources: Vec<_> = lights
        .iter()
        .map(|light| match light.values().get("profile") {
            Some(Value::Profile(source)) => Arc::clone(&source.profile),
            other => panic!("{other:?}"),
        })
        .collect();
    assert!(sources.iter().all(|profile| Arc::ptr_eq(profile, &sources[0])));
    assert_eq!(file.profile_paths().collect::<Vec<_>>(), [folder.path().join("profiles/lamp.ies")]);
}

#[test]
fn the_path_is_kept_when_a_scene_is_edited_and_saved() {
    let folder = folder();
    let path = folder.path().join("room.kdl");
    let text =
        "point-light \"a\" profile=\"profiles/lamp.ies\" {\n    // on the ceiling\n    position 0 3 0\n}\n";
    fs::write(&path, text).unwrap();
    let (mut scene, mut file) = load(&path).unwrap();
    let id = scene.entities().next().unwrap();
    let dimmed = scene.light(id).unwrap().with("intensity", Value::Color(Rgb::grey(0.5))).unwrap();
    scene.apply(Edit::Light(id, dimmed)).unwrap();
    // The file is not read again, even where it is gone.
    fs::remove_file(folder.path().join("profiles/lamp.ies")).unwrap();
    file.save(&scene, &path).unwrap();
    let saved = fs::read_to_string(&path).unwrap();
    assert!(
        saved.contains("profile=\"profiles/lamp.ies\"") && saved.contains("// on the ceiling"),
        "{saved}"
    );
    assert!(saved.contains("intensity 0.5 0.5 0.5"), "{saved}");
    fs::write(folder.path().join("profiles/lamp.ies"), LAMP).unwrap();
    let written = SceneFile::new(&scene).text();
    let (again, _) = read(&folder, &written).unwrap();
    assert_eq!(lights(&again), lights(&scene), "{written}");
}

#[test]
fn files_that_are_missing_or_broken_are_told_with_their_line() {
    let folder = folder();
    fs::write(folder.path().join("profiles/broken.ies"), LAMP.replace("800 200", "800 -2")).unwrap();
    let missing = refusal(&folder, "point-light \"a\" profile=\"none.ies\"\n");
    let message = missing.to_string();
    assert!(
        message.starts_with("room.kdl:1:25: ") && message.contains("none.ies: cannot be read"),
        "{message}"
    );
    let broken = refusal(&folder, "point-light \"a\" { profile \"profiles/broken.ies\" }\n").to_string();
    assert!(
        broken.contains("broken.ies:7:5: the intensity at vertical angle 60 and horizontal 0 must lie in"),
        "{broken}"
    );
    let nowhere = parse("point-light \"a\" profile=\"lamp.ies\"\n", "room.kdl", None).err().unwrap();
    assert!(nowhere.to_string().contains("lies in no folder"), "{nowhere}");
    for text in ["point-light \"a\" profile=1\n", "point-light \"a\" { profile \"a\" \"b\" }\n"] {
        refusal(&folder, text);
    }
}

#[test]
fn fields_that_need_a_profile_say_so() {
    let folder = folder();
    let alone = refusal(&folder, "point-light \"a\" { intensity 1; horizontal 1 0 0 }\n").to_string();
    assert!(alone.contains("horizontal must stand beside a profile, not alone"), "{alone}");
    let neither = refusal(&folder, "point-light \"a\"\n").to_string();
    assert!(neither.contains("this point-light needs an intensity"), "{neither}");
}
