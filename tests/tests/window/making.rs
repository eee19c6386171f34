//! Can a scene be made in the window? Adding, duplicating, pasting, grouping and hiding, by keys, as a person would.

use std::path::PathBuf;

use crate::picture::Picture;
use crate::stage::{PICTURE, SIZE, Stage};
use crate::{MIDDLE, SCENE, UPPER, is_accent, is_green, is_red, stage};

/// The grey of new shapes under the scene's light.
const fn is_grey([r, g, b]: [u8; 3]) -> bool {
    r > 150 && r < 235 && r == g && g == b
}

fn selected(stage: &Stage, key: &str) {
    stage.click(MIDDLE.0, MIDDLE.1);
    stage.until("an outline", |picture| picture.count(UPPER, is_accent) > 300);
    stage.key(key);
}

fn saved(stage: &Stage, holds: &str) -> String {
    let file: PathBuf = stage.folder.path().join("scene.kdl");
    stage.key("ctrl+s");
    let text = || std::fs::read_to_string(&file).unwrap_or_default();
    stage.wait(holds, |_| text().contains(holds));
    text()
}

fn saved_as_it_was(stage: &Stage) {
    stage.key("ctrl+s");
    let file = stage.folder.path().join("scene.kdl");
    stage.wait("the text as it was", |_| std::fs::read_to_string(&file).is_ok_and(|text| text == SCENE));
}

fn both(picture: &Picture) -> bool {
    picture.count(PICTURE, is_red) > 1000 && picture.count(PICTURE, is_green) > 300
}

#[test]
fn a_ball_is_added_where_the_pointer_is_and_one_undo_takes_it_back() {
    let Some(stage) = stage() else { return };
    let before = stage.picture();
    assert_eq!(before.count(UPPER, is_grey), 0);
    // On the red ball, left of its middle.
    stage.point(MIDDLE.0 - 40, MIDDLE.1);
    stage.key("shift+a");
    stage
        .until("the list", |picture| picture.at(SIZE.0 / 2, SIZE.1 / 2) != before.at(SIZE.0 / 2, SIZE.1 / 2));
    stage.xdotool(&["type", "sphere"]);
    stage.key("Return");
    let with = stage.until("a grey ball", |picture| picture.count(UPPER, is_grey) > 500);
    let (x, _) = with.middle(UPPER, is_grey).expect("a grey ball");
    assert!(x < MIDDLE.0 as f64, "it is at {x}");
    let text = saved(&stage, "sphere \"sphere\" material=\"sphere\"");
    assert!(text.starts_with("// two balls") && text.contains("matte \"sphere\""), "{text}");
    stage.key("ctrl+z");
    stage.until("no grey ball", |picture| picture.count(UPPER, is_grey) == 0 && both(picture));
    saved_as_it_was(&stage);
}

#[test]
fn what_is_chosen_to_be_added_can_be_left() {
    let Some(stage) = stage() else { return };
    let before = stage.picture();
    stage.key("shift+a");
    stage
        .until("the list", |picture| picture.at(SIZE.0 / 2, SIZE.1 / 2) != before.at(SIZE.0 / 2, SIZE.1 / 2));
    stage.key("Escape");
    stage.until("the picture as it was", |picture| crate::same(&before, picture, UPPER));
}

#[test]
fn a_duplicate_stands_beside_and_is_selected() {
    let Some(stage) = stage() else { return };
    let red = stage.picture().count(PICTURE, is_red);
    selected(&stage, "ctrl+d");
    // Beside it, where the green ball stood: that is inside now.
    stage.until("two red balls", |picture| picture.count(PICTURE, is_red) > red * 3 / 2);
    assert!(saved(&stage, "left ball 2").contains("sphere \"left ball 2\" material=\"red\""));
    stage.key("Delete");
    stage.until("the balls as before", both);
}

#[test]
fn what_is_cut_is_pasted_back() {
    let Some(stage) = stage() else { return };
    selected(&stage, "ctrl+x");
    stage.until("no red ball", |picture| picture.count(PICTURE, is_red) == 0);
    stage.key("ctrl+v");
    stage.until("both balls", both);
    stage.key("ctrl+v");
    let text = saved(&stage, "left ball 2");
    assert!(text.contains("sphere \"left ball\" material=\"red\""), "{text}");
}

#[test]
fn what_is_copied_in_one_window_is_pasted_in_another_and_in_an_editor() {
    let Some(stage) = stage() else { return };
    selected(&stage, "ctrl+c");
    let text = stage.clipboard();
    assert!(text.contains("sphere \"left ball\" material=\"red\""), "{text}");
    stage.set_clipboard(
        "matte \"blue\" { color 0 0 1 }\nsphere \"new\" material=\"blue\" { center -3 0 0; radius 1 }\n",
    );
    stage.key("ctrl+v");
    let is_blue = |[r, g, b]: [u8; 3]| b > 200 && r < 40 && g < 40;
    stage.until("a blue ball", |picture| picture.count(PICTURE, is_blue) > 300);
}

#[test]
fn hidden_things_come_back_and_stay_hidden_in_the_file() {
    let Some(stage) = stage() else { return };
    selected(&stage, "h");
    stage.until("no red ball", |picture| picture.count(PICTURE, is_red) == 0);
    assert!(saved(&stage, "hidden #true").contains("// the large one"));
    stage.key("alt+h");
    stage.until("both balls", both);
    saved_as_it_was(&stage);
}

#[test]
fn a_name_is_typed_after_f2() {
    let Some(stage) = stage() else { return };
    selected(&stage, "F2");
    stage.settle();
    stage.xdotool(&["type", "globe"]);
    stage.key("Return");
    assert!(saved(&stage, "globe").contains("sphere \"globe\" material=\"red\""));
}

#[test]
fn a_new_scene_is_saved_where_it_is_asked() {
    let Some(stage) = stage() else { return };
    stage.key("ctrl+n");
    stage.until("no red ball", |picture| picture.count(PICTURE, is_red) == 0);
    stage.key("ctrl+shift+s");
    stage.settle();
    stage.key("ctrl+a");
    stage.xdotool(&["type", "mine"]);
    stage.key("Return");
    let file = stage.folder.path().join("mine.kdl");
    stage.wait("the new file", |_| file.exists());
    stage.key("ctrl+o");
    stage.settle();
    stage.xdotool(&["type", "scene.kdl"]);
    stage.key("Return");
    stage.until("both balls again", both);
}

#[test]
fn a_dropped_model_stands_in_the_scene_and_one_undo_takes_it_back() {
    let Some(stage) = stage() else { return };
    let file = stage.folder.path().join("flag.obj");
    std::fs::write(&file, "o flag\nv 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n").expect("a model");
    stage.drop_file(&file);
    stage.until("a flag before the red ball", |picture| picture.count(UPPER, is_grey) > 500);
    assert!(saved(&stage, "flag.obj").contains("model \"flag\""));
    stage.key("ctrl+z");
    stage.until("no flag", |picture| picture.count(UPPER, is_grey) == 0 && both(picture));
    saved_as_it_was(&stage);
}
