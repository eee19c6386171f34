//! Is nobody's work lost unasked? Closing, dropping, saving and turning, with edits that are not saved.

use std::path::PathBuf;

use crate::picture::Picture;
use crate::stage::{PICTURE, SIZE, Stage};
use crate::{MIDDLE, SCENE, is_accent, is_green, is_red, stage};

/// Another scene: a blue ball.
const OTHER: &str = "\
camera \"main\" { eye 0 0 12; target 0 0 0; fov 45 }
ambient-light \"sky\" { radiance 1 1 1 }
matte \"blue\" { color 0 0 1 }
sphere \"ball\" material=\"blue\" { center 0 0 0; radius 2 }
";

/// The box of a question stands in the middle of the window: a place left of all that is written in it.
const BOX: (usize, usize) = (SIZE.0 / 2 - 196, SIZE.1 / 2);

pub(crate) fn asks(picture: &Picture) -> bool {
    picture.rgb(BOX.0, BOX.1) == [0x16, 0x18, 0x1d]
}

fn is_free(picture: &Picture) -> bool {
    !asks(picture)
}

/// A window on two balls of which the red one was taken out, and the scene's file.
fn edited() -> Option<(Stage, PathBuf)> {
    let stage = stage()?;
    stage.click(MIDDLE.0, MIDDLE.1);
    stage.until("an outline", |picture| picture.count(PICTURE, is_accent) > 300);
    stage.key("Delete");
    stage.until("no red ball", |picture| picture.count(PICTURE, is_red) == 0);
    let file = stage.folder.path().join("scene.kdl");
    Some((stage, file))
}

fn text(file: &PathBuf) -> String {
    std::fs::read_to_string(file).expect("a scene")
}

#[test]
fn closing_asks_and_esc_stays_and_enter_saves() {
    let Some((mut stage, file)) = edited() else { return };
    stage.close();
    stage.until("a question", asks);
    stage.key("Escape");
    stage.until("no question", is_free);
    assert!(stage.runs() && text(&file) == SCENE);
    stage.key("ctrl+q");
    stage.until("the question again", asks);
    assert!(text(&file) == SCENE, "nothing is saved before the answer");
    stage.key("Return");
    assert_eq!(stage.exit_code(), Some(0));
    let saved = text(&file);
    assert!(!saved.contains("left ball") && saved.contains("// two balls"), "{saved}");
}

#[test]
fn edits_can_be_discarded() {
    let Some((mut stage, file)) = edited() else { return };
    stage.key("ctrl+q");
    stage.until("a question", asks);
    stage.key("Tab");
    stage.key("Return");
    assert_eq!(stage.exit_code(), Some(0));
    assert_eq!(text(&file), SCENE);
}

#[test]
fn without_edits_the_close_button_closes() {
    let Some(mut stage) = stage() else { return };
    stage.close();
    assert_eq!(stage.exit_code(), Some(0));
}

#[test]
fn while_something_is_asked_the_picture_stays() {
    let Some((stage, _)) = edited() else { return };
    let green = |picture: &Picture| picture.middle(PICTURE, is_green);
    let before = green(&stage.settle());
    stage.key("ctrl+q");
    stage.until("a question", asks);
    stage.drag((60, 60), (100, 50), "1");
    stage.wheel(60, 60, "4", 3);
    stage.key("Home");
    stage.key("ctrl+z");
    stage.key("Escape");
    stage.until("no question", is_free);
    let after = stage.settle();
    assert_eq!(green(&after), before, "the view was changed");
    assert_eq!(after.count(PICTURE, is_red), 0, "the edit was taken back");
}

#[test]
fn a_failed_save_keeps_the_window_and_the_question() {
    let Some((mut stage, file)) = edited() else { return };
    std::fs::remove_file(&file).expect("the scene goes");
    std::fs::create_dir_all(file.join("in the way")).expect("a folder in its place");
    stage.key("ctrl+q");
    stage.until("a question", asks);
    stage.key("Return");
    let told = |picture: &Picture| picture.count((SIZE.0, SIZE.1 - 60), is_accent);
    let changed = stage.settle();
    assert!(asks(&changed) && told(&changed) == 0);
    overwrite(&stage);
    stage.until("the reason", |picture| asks(picture) && told(picture) > 50);
    assert!(stage.runs());
    std::fs::remove_dir_all(&file).expect("the folder goes");
    overwrite(&stage);
    assert_eq!(stage.exit_code(), Some(0));
    assert!(!text(&file).contains("left ball"));
}

/// Goes back from the last button, which has the keys at first, and presses the one that many before it.
fn press(stage: &Stage, before_last: usize) {
    (0..before_last).for_each(|_| stage.key("shift+Tab"));
    stage.key("Return");
}

fn overwrite(stage: &Stage) {
    press(stage, 3);
}

#[test]
fn a_dropped_file_waits_for_an_answer() {
    let Some((stage, file)) = edited() else { return };
    let other = stage.folder.path().join("other.kdl");
    std::fs::write(&other, OTHER).expect("another scene");
    let is_blue = |[r, g, b]: [u8; 3]| b > 200 && r < 40 && g < 40;
    stage.drop_file(&other);
    stage.until("a question", asks);
    stage.key("Escape");
    stage.until("no question", is_free);
    let kept = stage.settle();
    assert!(
        kept.count(PICTURE, is_green) > 300 && kept.count(PICTURE, is_blue) == 0,
        "the drop is forgotten"
    );
    stage.drop_file(&other);
    stage.until("the question again", asks);
    stage.key("Return");
    stage.until("the other scene", |picture| picture.count(PICTURE, is_blue) > 1000);
    assert!(!text(&file).contains("left ball"), "saved first");
    std::fs::write(&file, SCENE).expect("the first scene");
    stage.drop_file(&file);
    stage.until("the first scene, unasked", |picture| picture.count(PICTURE, is_red) > 1000);
}

#[test]
fn a_file_changed_elsewhere_is_overwritten_only_on_demand() {
    let Some((stage, file)) = edited() else { return };
    let theirs = SCENE.replace("fov 45", "fov 50");
    std::fs::write(&file, &theirs).expect("their scene");
    stage.key("ctrl+s");
    stage.until("a question", asks);
    stage.key("Return");
    stage.until("no question", is_free);
    assert_eq!(text(&file), theirs, "Enter leaves things as they are");
    stage.key("ctrl+s");
    stage.until("the question again", asks);
    overwrite(&stage);
    stage.until("no question", is_free);
    stage.wait("the scene", |_| !text(&file).contains("left ball"));
    assert!(text(&file).contains("fov 45"));
}

#[test]
fn a_file_changed_elsewhere_can_be_shown() {
    let Some((stage, file)) = edited() else { return };
    let theirs = SCENE.replace("radius 2", "radius 3");
    std::fs::write(&file, &theirs).expect("their scene");
    stage.key("ctrl+s");
    stage.until("a question", asks);
    press(&stage, 2);
    stage.until("their ball", |picture| picture.count(PICTURE, is_red) > 60_000);
    assert_eq!(text(&file), theirs);
}

#[test]
fn a_file_changed_elsewhere_can_be_left_alone_and_it_is_shown_what_differs() {
    let Some((stage, file)) = edited() else { return };
    let theirs = SCENE.replace("fov 45", "fov 50");
    std::fs::write(&file, &theirs).expect("their scene");
    stage.key("ctrl+s");
    let is_new = |[r, g, b]: [u8; 3]| g > 150 && r < 150 && b < 150 && g > r + 50;
    stage.until("a question with what is new", |picture| {
        asks(picture) && (BOX.0..SIZE.0 - BOX.0).any(|x| (100..SIZE.1).any(|y| is_new(picture.rgb(x, y))))
    });
    press(&stage, 1);
    stage.settle();
    stage.key("ctrl+a");
    stage.xdotool(&["type", "mine"]);
    stage.key("Return");
    let mine = stage.folder.path().join("mine.kdl");
    stage.wait("my scene", |_| mine.exists());
    assert!(!text(&mine).contains("left ball") && text(&mine).contains("fov 45"));
    assert_eq!(text(&file), theirs);
}

#[test]
fn redo_is_ctrl_y_too_and_what_comes_back_is_selected() {
    let Some((stage, _)) = edited() else { return };
    stage.key("ctrl+z");
    stage.until("the red ball, outlined", |picture| {
        picture.count(PICTURE, is_red) > 1000 && picture.count((PICTURE.0, SIZE.1 - 60), is_accent) > 300
    });
    stage.key("ctrl+y");
    stage.until("no red ball", |picture| picture.count(PICTURE, is_red) == 0);
}

#[test]
fn the_turntable_has_a_sign() {
    let Some(stage) = stage() else { return };
    let top = (PICTURE.0, 40);
    assert_eq!(stage.picture().count(top, is_accent), 0, "it is off at first");
    stage.key("t");
    stage.until("a sign", |picture| picture.count(top, is_accent) > 4000);
    stage.key("t");
    stage.until("no sign", |picture| picture.count(top, is_accent) == 0);
}
