//! Is the reading of a scene watched, and stopped before the next file where it is told to?

use std::fs;
use std::sync::Arc;

use catoptra_core::Control;
use catoptra_scene::{LoadError, load_unless_cancelled};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A scene of two meshes, in a folder that is gone with it.
fn scene() -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let nodes = ["a", "b"].map(|name| {
        fs::write(folder.path().join(format!("{name}.obj")), TRIANGLE).expect("a file");
        format!("mesh \"{name}\" material=\"grey\" {{ file \"{name}.obj\" }}\n")
    });
    let path = folder.path().join("scene.kdl");
    fs::write(&path, format!("matte \"grey\" {{ color 0.5 }}\n{}", nodes.concat())).expect("a file");
    (folder, path)
}

#[test]
fn what_is_read_is_told() {
    let (_folder, path) = scene();
    let control = Arc::new(Control::default());
    let (scene, _) = load_unless_cancelled(&path, &control).expect("a scene");
    assert_eq!(scene.shapes().len(), 2);
    assert!(control.progress() > 0.9, "{}", control.progress());
    assert_eq!(Arc::strong_count(&control), 1, "nobody watches any more");
}

#[test]
fn a_cancelled_reading_says_so_until_its_control_is_reset() {
    let (folder, path) = scene();
    let control = Arc::new(Control::default());
    control.cancel();
    for path in [&path, &folder.path().join("a.obj")] {
        assert!(
            matches!(load_unless_cancelled(path, &control), Err(LoadError::Cancelled(_))),
            "{}",
            path.display()
        );
    }
    control.reset();
    assert!(load_unless_cancelled(&path, &control).is_ok());
    let missing = folder.path().join("none.kdl");
    assert!(matches!(load_unless_cancelled(&missing, &control), Err(LoadError::Scene(_))));
}
