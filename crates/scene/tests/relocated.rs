//! Does a scene that is saved into another folder find its files from there?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_scene::{OnDisk, image, load};

const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

const TEXT: &str = "// a room\nimage-texture \"wood\" { file \"maps/wood.png\" } // oak\n\
    matte \"m\" { color 1 texture=\"wood\" }\nmesh \"tri\" material=\"m\" { file \"tri.obj\" }\n\
    group \"g\" { model \"thing\" { file \"./tri.obj\"; move 1 0 0 } }\n";

fn write_room(folder: &Path) {
    std::fs::create_dir_all(folder.join("maps")).unwrap();
    std::fs::write(folder.join("tri.obj"), MESH).unwrap();
    image::write_png(&folder.join("maps/wood.png"), 1, 1, &[90, 60, 30]).unwrap();
    std::fs::write(folder.join("room.kdl"), TEXT).unwrap();
}

#[test]
fn a_scene_saved_elsewhere_opens_there_and_saved_back_is_as_it_was() {
    let outer = tempfile::tempdir().unwrap();
    let (here, there) = (outer.path().join("here"), outer.path().join("there/in"));
    write_room(&here);
    std::fs::create_dir_all(&there).unwrap();
    let (scene, mut file) = load(&here.join("room.kdl")).unwrap();
    file.save(&scene, &there.join("moved.kdl")).unwrap();
    let written = std::fs::read_to_string(there.join("moved.kdl")).unwrap();
    for (before, after) in [("\"maps/", "\"../../here/maps/"), ("\"tri.obj", "\"../../here/tri.obj")] {
        assert!(TEXT.contains(before) && written.contains(after), "{written}");
    }
    assert!(written.starts_with("// a room\n") && written.contains("// oak") && !written.contains("\"./tri"));
    assert_eq!(file.on_disk(), OnDisk::Same);
    let (again, other) = load(&there.join("moved.kdl")).unwrap();
    assert_eq!(again.entities().len(), scene.entities().len());
    assert_eq!(other.mesh_paths().count() + other.image_paths().count() + other.model_paths().count(), 3);
    file.save(&scene, &here.join("room.kdl")).unwrap();
    assert_eq!(std::fs::read_to_string(here.join("room.kdl")).unwrap(), TEXT);
}

#[test]
fn paths_that_come_with_edits_lead_from_the_new_folder_too() {
    let outer = tempfile::tempdir().unwrap();
    let (here, there) = (outer.path().join("here"), outer.path().join("there"));
    write_room(&here);
    std::fs::create_dir_all(&there).unwrap();
    let (mut scene, mut file) = load(&here.join("room.kdl")).unwrap();
    let tri = scene.entity_named("tri").unwrap();
    let back = scene.apply(catoptra_core::Edit::Remove(tri)).unwrap();
    file.save(&scene, &there.join("moved.kdl")).unwrap();
    assert!(load(&there.join("moved.kdl")).unwrap().0.entity_named("tri").is_none());
    scene.apply(back).unwrap();
    file.save(&scene, &there.join("moved.kdl")).unwrap();
    let (again, _) = load(&there.join("moved.kdl")).unwrap();
    assert!(again.shape(again.entity_named("tri").unwrap()).unwrap().as_mesh().is_some());
}
