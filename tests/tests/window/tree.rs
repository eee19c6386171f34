//! Are rows of the tree dragged to other places, and does the scene's text follow?

use crate::stage::PICTURE;
use crate::{SCENE, stage};

/// Where the name of a row stands, from 0.
fn row(number: usize) -> (usize, usize) {
    (PICTURE.0 + 50, 86 + 22 * number)
}

#[test]
fn a_row_is_dragged_before_others_and_back_by_one_undo() {
    let Some(stage) = stage() else { return };
    let file = stage.folder.path().join("scene.kdl");
    let text = || std::fs::read_to_string(&file).unwrap_or_default();
    // The green ball, the last, to below the camera, the first.
    stage.drag(row(3), (0, -60), "1");
    stage.key("ctrl+s");
    stage.wait("the other order", |_| text().find("right ball") < text().find("left ball"));
    let moved = text();
    assert!(
        moved.find("right ball") < moved.find("ambient-light") && moved.contains("// the large one"),
        "{moved}"
    );
    stage.key("ctrl+z");
    stage.key("ctrl+s");
    stage.wait("the text as it was", |_| text() == SCENE);
}
