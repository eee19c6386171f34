//! Does a scene know whether its file was changed by someone else?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::fs;
use std::path::{Path, PathBuf};

use catoptra_core::scene::{Edit, Scene};
use catoptra_scene::{OnDisk, SceneFile, load, parse};

const TEXT: &str = "matte \"grey\" { color 0.5 0.5 0.5 }\nsphere \"ball\" material=\"grey\" { radius 1 }\n";

fn start(folder: &Path) -> (PathBuf, Scene, SceneFile) {
    let path = folder.join("ball.kdl");
    fs::write(&path, TEXT).unwrap();
    let (scene, file) = load(&path).unwrap();
    (path, scene, file)
}

#[test]
fn a_file_is_the_same_until_it_holds_something_else() {
    let folder = tempfile::tempdir().unwrap();
    let (path, _, file) = start(folder.path());
    assert_eq!(file.on_disk(), OnDisk::Same);
    fs::write(&path, TEXT).unwrap();
    assert_eq!(file.on_disk(), OnDisk::Same, "written anew with the same content");
    let times = fs::metadata(&path).unwrap().modified().unwrap();
    fs::write(&path, TEXT.replace("radius 1", "radius 2")).unwrap();
    fs::File::options().append(true).open(&path).unwrap().set_modified(times).unwrap();
    assert_eq!(file.on_disk(), OnDisk::Changed, "as long and as old as before");
    fs::write(&path, "").unwrap();
    assert_eq!(file.on_disk(), OnDisk::Changed);
}

#[test]
fn what_was_saved_is_known_as_well() {
    let folder = tempfile::tempdir().unwrap();
    let (path, mut scene, mut file) = start(folder.path());
    let ball = scene.entity_named("ball").unwrap();
    scene.apply(Edit::Name(ball, "globe".to_owned())).unwrap();
    file.update(&scene);
    assert_eq!(file.on_disk(), OnDisk::Same, "an edit that is not saved");
    file.save(&scene, &path).unwrap();
    assert_eq!(file.on_disk(), OnDisk::Same);
    fs::write(&path, TEXT).unwrap();
    assert_eq!(file.on_disk(), OnDisk::Changed, "put back to what it was before the save");
}

#[test]
fn a_file_that_is_gone_is_missing_and_one_in_the_way_is_a_change() {
    let folder = tempfile::tempdir().unwrap();
    let (path, _, file) = start(folder.path());
    fs::remove_file(&path).unwrap();
    assert_eq!(file.on_disk(), OnDisk::Missing);
    fs::create_dir(&path).unwrap();
    assert_eq!(file.on_disk(), OnDisk::Changed);
    assert_eq!(parse(TEXT, "ball.kdl", None).unwrap().1.on_disk(), OnDisk::Missing);
}

#[test]
fn a_failed_save_forgets_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (path, mut scene, mut file) = start(folder.path());
    let ball = scene.entity_named("ball").unwrap();
    scene.apply(Edit::Name(ball, "globe".to_owned())).unwrap();
    assert!(file.save(&scene, &folder.path().join("no/such/folder.kdl")).is_err());
    assert_eq!((file.path(), file.on_disk()), (Some(path.as_path()), OnDisk::Same));
}
