//! Can several things be selected at once, and is what is done done to all of them?

use crate::picture::Picture;
use crate::stage::{PICTURE, Stage};
use crate::{MIDDLE, UPPER, is_accent, is_green, is_red, stage};

fn is_empty(picture: &Picture) -> bool {
    picture.count(PICTURE, is_red) == 0 && picture.count(PICTURE, is_green) == 0
}

/// Selects the red ball, then the green one with that key held.
fn both(key: &str) -> Option<Stage> {
    let stage = stage()?;
    let (x, y) = stage.picture().middle(PICTURE, is_green).expect("a green ball");
    stage.click(MIDDLE.0, MIDDLE.1);
    let one = stage.until("an outline", |picture| picture.count(UPPER, is_accent) > 300);
    let outline = one.count(UPPER, is_accent);
    stage.xdotool(&["keydown", key]);
    stage.click(x as usize, y as usize);
    stage.xdotool(&["keyup", key]);
    stage.until("two outlines", |picture| picture.count(UPPER, is_accent) > outline + 100);
    Some(stage)
}

#[test]
fn shift_or_ctrl_click_selects_several_and_delete_takes_all() {
    for key in ["Shift_L", "Control_L"] {
        let Some(stage) = both(key) else { return };
        stage.key("Delete");
        stage.until("no ball", is_empty);
        stage.key("ctrl+z");
        stage.until("both balls", |picture| {
            picture.count(PICTURE, is_red) > 1000 && picture.count(PICTURE, is_green) > 300
        });
    }
}
