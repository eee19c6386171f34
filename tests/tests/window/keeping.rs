//! What is left of edits that were not saved when the window is killed? All but those of the last seconds.

use crate::guards::asks;
use crate::stage::{PICTURE, Stage};
use crate::{MIDDLE, SCENE, UPPER, is_accent, is_green, is_red, stage};

/// How many texts are kept.
fn kept(stage: &Stage) -> usize {
    let folder = std::fs::read_dir(stage.folder.path().join("state/catoptra/recovery"));
    let paths = folder.into_iter().flatten().filter_map(Result::ok).map(|entry| entry.path());
    paths.filter(|path| path.extension().is_some_and(|ending| ending == "kdl")).count()
}

/// A window on two balls of which the red one was taken out, some seconds later.
fn edited() -> Option<Stage> {
    let stage = stage()?;
    stage.click(MIDDLE.0, MIDDLE.1);
    stage.until("an outline", |picture| picture.count(UPPER, is_accent) > 300);
    stage.key("Delete");
    stage.wait("the edit to be kept", |stage| kept(stage) == 1);
    Some(stage)
}

#[test]
fn edits_of_a_window_that_was_killed_are_brought_back() {
    let Some(mut stage) = edited() else { return };
    let file = stage.folder.path().join("scene.kdl");
    stage.kill();
    assert_eq!(std::fs::read_to_string(&file).expect("the scene"), SCENE, "it is not saved unasked");
    stage.restart(None);
    stage.until("a question", asks);
    stage.key("Return");
    stage.until("the green ball alone", |picture| {
        picture.count(PICTURE, is_red) == 0 && picture.count(PICTURE, is_green) > 300
    });
    stage.key("ctrl+s");
    stage.wait("the saved edit", |_| {
        std::fs::read_to_string(&file)
            .is_ok_and(|text| !text.contains("left ball") && text.contains("// two"))
    });
    stage.wait("nothing to be kept", |stage| kept(stage) == 0);
    stage.key("ctrl+q");
    assert_eq!(stage.exit_code(), Some(0));
}

#[test]
fn what_is_discarded_or_taken_back_is_not_offered_again() {
    let Some(mut stage) = edited() else { return };
    stage.key("ctrl+z");
    stage.wait("nothing to be kept", |stage| kept(stage) == 0);
    stage.key("ctrl+y");
    stage.wait("the edit to be kept again", |stage| kept(stage) == 1);
    stage.key("ctrl+q");
    stage.until("a question", asks);
    stage.key("Tab");
    stage.key("Return");
    assert_eq!(stage.exit_code(), Some(0));
    assert_eq!(kept(&stage), 0);
}
