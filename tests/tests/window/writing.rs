//! Does P write the picture that a person asks for, as large and as fine, and where?

use std::path::Path;

use crate::stage::{PICTURE, Stage};
use crate::{UPPER, is_accent, same, stage};

/// Width and height of a PNG, once it is whole.
fn size(file: &Path) -> Option<(u32, u32)> {
    let bytes = std::fs::read(file).ok()?;
    let number = |at: usize| Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    bytes.starts_with(b"\x89PNG\r\n").then_some((number(16)?, number(20)?))
}

fn written(stage: &Stage, name: &str) -> (u32, u32) {
    let file = stage.folder.path().join(name);
    stage.wait(name, |_| file.exists());
    size(&file).expect("a whole picture")
}

/// Asks for a picture.
fn ask(stage: &Stage) {
    let before = stage.settle();
    stage.key("p");
    stage.until("a box", |picture| !same(&before, picture, UPPER));
    stage.settle();
}

#[test]
fn p_asks_and_shift_p_writes_one_more() {
    let Some(stage) = stage() else { return };
    let view = (PICTURE.0 as u32, PICTURE.1 as u32);
    ask(&stage);
    assert!(!stage.folder.path().join("scene.png").exists(), "not before the answer");
    stage.key("Return");
    assert_eq!(written(&stage, "scene.png"), view);
    ask(&stage);
    stage.key("ctrl+a");
    stage.xdotool(&["type", "large"]);
    for number in ["1500", "900", "4"] {
        stage.key("Tab");
        stage.xdotool(&["type", number]);
    }
    stage.key("Return");
    assert_eq!(written(&stage, "large.png"), (1500, 900));
    stage.settle();
    stage.key("shift+p");
    assert_eq!(written(&stage, "large-2.png"), (1500, 900));
    let bytes = |name: &str| std::fs::read(stage.folder.path().join(name)).expect("a picture");
    assert!(bytes("large.png") == bytes("large-2.png"), "the same picture twice");
}

#[test]
fn what_is_there_is_replaced_only_on_demand() {
    let Some(stage) = stage() else { return };
    let file = stage.folder.path().join("there.png");
    std::fs::write(&file, "something").expect("a file");
    ask(&stage);
    stage.key("ctrl+a");
    stage.xdotool(&["type", "there.png"]);
    let told = stage.settle().count(UPPER, is_accent);
    stage.key("Return");
    stage.until("that it is there", |picture| picture.count(UPPER, is_accent) > told + 20);
    assert_eq!(std::fs::read(&file).expect("the file"), b"something");
    stage.key("Return");
    stage.wait("the picture", |_| size(&file).is_some());
}

#[test]
fn a_picture_can_be_left_and_cancelled() {
    let Some(stage) = stage() else { return };
    let before = stage.settle();
    ask(&stage);
    stage.key("Escape");
    stage.until("the picture as it was", |picture| same(&before, picture, UPPER));
    ask(&stage);
    // Of so many samples that it is not there before the button is.
    for number in ["3000", "2000", "4096"] {
        stage.key("Tab");
        stage.xdotool(&["type", number]);
    }
    stage.key("Return");
    let is_sign = |[r, g, b]: [u8; 3]| [r, g, b] != [0; 3];
    let sign = stage.until("how far it is", |picture| picture.count((200, 40), is_sign) > 1000);
    // The button stands at the right end of the sign.
    let right = (0..400).rev().find(|x| is_sign(sign.rgb(*x, 24))).expect("a sign");
    stage.click(right - 30, 24);
    stage.until("no sign", |picture| picture.count((200, 40), is_sign) == 0);
    let left = std::fs::read_dir(stage.folder.path()).expect("the folder").filter_map(Result::ok);
    assert!(left.map(|entry| entry.path()).all(|path| path.extension().is_none_or(|ending| ending != "png")));
}
