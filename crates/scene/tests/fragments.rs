//! Do parts of scenes travel as text, with all that they need?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_core::Aabb;
use catoptra_core::scene::{EntityId, Scene};
use catoptra_scene::{PasteError, fragment, parse};

const TEXT: &str = "image-texture \"wood\" { file \"wood.png\" }
checker-texture \"tiles\" { scale 2 3 }
matte \"oak\" { color 0.8 texture=\"wood\"; opacity 0.9 }
matte \"red\" { color 1 0 0 }
group \"table\" {
    move 1 2 3
    box \"top\" material=\"oak\" { min 0 0 0; max 2 0.1 1 }
    sphere \"ball\" material=\"red\" { radius 0.5; hidden #true }
}
mesh \"flag\" material=\"red\" { file \"flag.obj\" }
point-light \"lamp\" { position 0 3 0; intensity 1 }
";

/// Two folders: a scene with its files in the first, and an empty one beside it.
fn folders() -> (tempfile::TempDir, Scene) {
    let folder = tempfile::tempdir().unwrap();
    let (from, to) = (folder.path().join("from"), folder.path().join("to"));
    std::fs::create_dir(&from).unwrap();
    std::fs::create_dir(&to).unwrap();
    std::fs::write(from.join("flag.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    catoptra_scene::image::write_png(&from.join("wood.png"), 1, 1, &[90, 60, 30]).unwrap();
    let (scene, _) = parse(TEXT, "test", Some(&from)).unwrap();
    (folder, scene)
}

fn id(scene: &Scene, name: &str) -> EntityId {
    scene.entity_named(name).unwrap_or_else(|| panic!("{name} is not there"))
}

fn copied(scene: &Scene, names: &[&str], folder: &Path) -> String {
    let ids: Vec<EntityId> = names.iter().map(|name| id(scene, name)).collect();
    fragment::text_of(scene, &ids, folder).unwrap()
}

fn bounds(scene: &Scene, name: &str) -> Option<Aabb> {
    scene.world_bounds(id(scene, name))
}

#[test]
fn a_group_arrives_elsewhere_with_all_that_it_needs() {
    let (folder, scene) = folders();
    let (from, to) = (folder.path().join("from"), folder.path().join("to"));
    let text = copied(&scene, &["table", "flag"], &from);
    assert!(!text.contains("tiles") && !text.contains("lamp"), "{text}");
    let mut other = Scene::new();
    let pasted = fragment::paste(&other, &text, &to).unwrap();
    other.apply(pasted.edit).unwrap();
    assert_eq!(pasted.ids, [id(&other, "table"), id(&other, "flag")]);
    assert_eq!(bounds(&other, "table"), bounds(&scene, "table"));
    assert_eq!(bounds(&other, "flag"), bounds(&scene, "flag"));
    assert!(other.is_hidden(id(&other, "ball")));
    let oak = other.material_of(id(&other, "top")).unwrap();
    assert_eq!(other.material_name(oak), "oak");
    assert_eq!(other.finish(oak), scene.finish(scene.material_named("oak").unwrap()));
    assert_eq!(other.painted_with(other.texture_named("wood").unwrap()), [oak]);
}

#[test]
fn a_member_stands_where_it_stood_in_the_world() {
    let (folder, scene) = folders();
    let from = folder.path().join("from");
    let text = copied(&scene, &["top"], &from);
    let mut other = Scene::new();
    other.apply(fragment::paste(&other, &text, &from).unwrap().edit).unwrap();
    assert_eq!(bounds(&other, "top"), bounds(&scene, "top"));
}

#[test]
fn at_home_looks_are_shared_paths_are_short_and_names_are_free() {
    let (folder, scene) = folders();
    let from = folder.path().join("from");
    let text = copied(&scene, &["table", "flag"], &from);
    let mut twice = scene.clone();
    let pasted = fragment::paste(&scene, &text, &from).unwrap();
    twice.apply(pasted.edit).unwrap();
    assert_eq!(twice.materials().count(), scene.materials().count());
    assert_eq!(twice.textures().count(), scene.textures().count());
    assert_eq!(bounds(&twice, "table 2"), bounds(&scene, "table"));
    assert_eq!(twice.shape(id(&twice, "flag 2")), scene.shape(id(&scene, "flag")));
}

#[test]
fn another_material_of_the_same_name_gets_a_name_of_its_own() {
    let (other, _) = parse("matte \"red\" { color 0.5 0 0 }\n", "other", None).unwrap();
    let text = "matte \"red\" { color 1 0 0 }\nsphere \"ball\" material=\"red\" { radius 1 }\n";
    let mut both = other.clone();
    both.apply(fragment::paste(&other, text, Path::new("")).unwrap().edit).unwrap();
    let worn = both.material_of(id(&both, "ball")).unwrap();
    assert_eq!(both.material_name(worn), "red 2");
}

#[test]
fn what_is_no_scene_is_refused() {
    let scene = Scene::new();
    let refused = |text| fragment::paste(&scene, text, Path::new("")).err();
    assert!(matches!(refused("hello there"), Some(PasteError::Text(_))));
    assert!(matches!(refused("sphere \"b\" material=\"none\" { radius 1 }"), Some(PasteError::Text(_))));
    assert!(matches!(refused(""), Some(PasteError::Empty)));
    assert!(matches!(refused("settings { max-depth 3 }"), Some(PasteError::Empty)));
}
