//! Are things hidden and locked as the text says, and does the text follow when that changes?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_core::scene::{Edit, EntityId, Flags, Scene};
use catoptra_scene::{SceneFile, parse};

const HIDDEN: Flags = Flags { hidden: true, locked: false };
const LOCKED: Flags = Flags { hidden: false, locked: true };

const TEXT: &str = "matte \"m\" { color 0.5 }
sphere \"ball\" material=\"m\" locked=#true { radius 1 } // round
group \"things\" {
    hidden #true // for a while
    sphere \"inner\" material=\"m\" { radius 1 }
}
point-light \"lamp\" { position 0 3 0; intensity 1 }
camera \"eye\" { eye 0 0 9; target 0 0 0 }
";

fn read(text: &str, folder: Option<&Path>) -> (Scene, SceneFile) {
    parse(text, "test.kdl", folder).unwrap_or_else(|e| panic!("{:?}\n{text}", miette::Report::new(e)))
}

fn id(scene: &Scene, name: &str) -> EntityId {
    scene.entity_named(name).unwrap_or_else(|| panic!("{name} is not there"))
}

/// The text after those changes; read again it says the same.
fn changed(text: &str, folder: Option<&Path>, flags: &[(&str, Flags)]) -> String {
    let (mut scene, mut file) = read(text, folder);
    for (name, flags) in flags {
        scene.apply(Edit::Flags(id(&scene, name), *flags)).unwrap();
    }
    file.update(&scene);
    let new = file.text();
    let (again, _) = read(&new, folder);
    for entity in scene.entities() {
        let name = scene.name(entity).unwrap();
        assert_eq!(again.flags(id(&again, &name)), scene.flags(entity), "{name} in {new}");
    }
    new
}

#[test]
fn flags_are_read_from_lines_and_properties() {
    let (scene, _) = read(TEXT, None);
    assert_eq!(scene.flags(id(&scene, "ball")), LOCKED);
    assert_eq!(scene.flags(id(&scene, "things")), HIDDEN);
    assert_eq!(scene.flags(id(&scene, "lamp")), Flags::default());
    assert!(scene.is_hidden(id(&scene, "inner")));
    assert_eq!(scene.world_shapes().len(), 1);
}

#[test]
fn only_what_changed_is_written() {
    assert_eq!(changed(TEXT, None, &[("ball", LOCKED)]), TEXT);
    let lamp = "point-light \"lamp\" { position 0 3 0; intensity 1; hidden #true }";
    let expected = TEXT.replace("point-light \"lamp\" { position 0 3 0; intensity 1 }", lamp);
    assert_eq!(changed(TEXT, None, &[("lamp", HIDDEN)]), expected);
    let none = Flags::default();
    let expected = TEXT.replace(" locked=#true", "").replace("    hidden #true // for a while\n", "");
    assert_eq!(changed(TEXT, None, &[("ball", none), ("things", none)]), expected);
    let back = changed(&expected, None, &[("things", LOCKED)]);
    assert!(back.contains("group \"things\" {\n    locked #true\n"), "{back}");
}

#[test]
fn parts_of_models_and_what_stands_in_repeats_have_them_too() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "o leg\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no seat\nf 1 2 3\n";
    std::fs::write(folder.path().join("chair.obj"), obj).unwrap();
    let text = "model \"chair\" {\n    file \"chair.obj\"\n    part \"leg\" { move 1 0 0 }\n}\n";
    let folder = Some(folder.path());
    let new = changed(text, folder, &[("chair/leg", HIDDEN), ("chair/seat", LOCKED)]);
    assert!(new.contains("part \"leg\" { hidden #true; move 1 0 0 }"), "{new}");
    assert!(new.contains("part \"seat\" { locked #true }"), "{new}");
    assert!(!changed(&new, folder, &[("chair/seat", Flags::default())]).contains("locked"));
    let whole = changed(text, folder, &[("chair", HIDDEN)]);
    assert!(whole.starts_with("model \"chair\" {") && whole.contains("hidden #true"), "{whole}");
    let row = "matte \"m\" { color 0.5 }\nrepeat \"row\" count=3 { step { move 1 0 0 }\n\
        sphere \"ball\" material=\"m\" hidden=#true { radius 1 } }\n";
    let (scene, _) = read(row, None);
    assert!(scene.is_hidden(id(&scene, "row/2/ball")));
    assert!(changed(row, None, &[("row", LOCKED)]).contains("locked #true"));
    assert_eq!(changed(row, None, &[("row/2/ball", Flags::default())]).matches("hidden #true").count(), 2);
}

#[test]
fn what_is_no_flag_is_told() {
    for (wrong, part) in [
        ("hidden 1", "hidden takes #true or #false"),
        ("hidden", "hidden takes #true or #false"),
        ("hidden #true; hidden #false", "hidden is given twice"),
        ("hiden #true", "hidden"),
    ] {
        let text = TEXT.replace("position 0 3 0;", &format!("position 0 3 0; {wrong};"));
        let Err(error) = parse(&text, "test.kdl", None) else { panic!("was read: {text}") };
        let told: String =
            error.complaints().iter().map(|c| format!("{c} {}", c.hint().unwrap_or_default())).collect();
        assert!(told.contains(part), "{wrong}: {told}");
    }
    assert!(parse(&TEXT.replace("color 0.5", "color 0.5; hidden #true"), "t", None).is_err());
}
