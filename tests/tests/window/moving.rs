//! Can things be moved by hand? By handles, by keys and numbers, lights by their marks and aims; each as one step to undo.

use crate::picture::Picture;
use crate::stage::{PICTURE, Stage};
use crate::{MIDDLE, SCENE, UPPER, is_accent, is_red};

/// A spot light four metres over a floor, seen from in front; it lights a disc in the middle of the picture.
const SPOT: &str = "camera \"main\" { eye 0 5 10; target 0 0 0; fov 45 }\nmatte \"white\" { color 1 }\n\
    plane \"floor\" material=\"white\"\n\
    spot-light \"spot\" { position 0 4 0; direction 0 -1 0; intensity 60; inner 25; outer 25 }\n";

/// Where its mark stands in the picture, in pixels: four metres over the middle.
const MARK: (usize, usize) = (MIDDLE.0, 24);

fn ball(picture: &Picture) -> (f64, f64) {
    picture.middle(UPPER, is_red).unwrap_or_default()
}

fn saved(stage: &Stage) -> String {
    let file = stage.folder.path().join("scene.kdl");
    let before = std::fs::read_to_string(&file).unwrap_or_default();
    stage.key("ctrl+s");
    stage.wait("the saved scene", |_| std::fs::read_to_string(&file).is_ok_and(|text| text != before));
    std::fs::read_to_string(&file).unwrap_or_default()
}

/// The numbers after a word of a scene.
fn numbers(text: &str, word: &str) -> Vec<String> {
    let rest = text.split(word).nth(1).unwrap_or_default();
    let end = rest.find([';', '}', '\n']).unwrap_or(rest.len());
    rest[..end].split_whitespace().map(str::to_owned).collect()
}

fn select_ball(stage: &Stage) {
    stage.click(MIDDLE.0, MIDDLE.1);
    stage.until("an outline", |picture| picture.count(UPPER, is_accent) > 300);
}

#[test]
fn a_handle_moves_what_is_selected_along_its_axis() {
    let Some(stage) = Stage::start(Some(SCENE)) else { return };
    select_ball(&stage);
    let start = ball(&stage.settle());
    stage.drag((MIDDLE.0 + 50, MIDDLE.1), (-100, 40), "1");
    stage.until("the ball 100 pixels to the left", |picture| (ball(picture).0 - start.0 + 100.0).abs() < 8.0);
    assert!((ball(&stage.settle()).1 - start.1).abs() < 6.0, "and no lower");
    let text = saved(&stage);
    let center = numbers(&text, "center");
    assert_eq!(center[1..], ["0", "0"], "{text}");
    let x: f64 = center[0].parse().expect("a number");
    assert!((x + 1.66).abs() < 0.1 && center[0].len() <= 5, "a round number: {text}");
    stage.key("ctrl+z");
    stage.until("the ball where it was", |picture| (ball(picture).0 - start.0).abs() < 2.0);
}

#[test]
fn keys_move_by_numbers_and_escape_takes_back() {
    let Some(stage) = Stage::start(Some(SCENE)) else { return };
    select_ball(&stage);
    let start = ball(&stage.settle());
    stage.key("g");
    stage.point(MIDDLE.0 - 80, MIDDLE.1 + 60);
    stage.until("a ball that follows the pointer", |picture| (ball(picture).0 - start.0 + 80.0).abs() < 8.0);
    stage.key("Escape");
    stage.until("the ball where it was", |picture| (ball(picture).0 - start.0).abs() < 2.0);
    stage.key("g");
    for key in ["x", "minus", "3", "slash", "2", "Return"] {
        stage.key(key);
    }
    stage.until("a ball 1.5 m further left", |picture| (ball(picture).0 - start.0 + 90.5).abs() < 6.0);
    assert_eq!(numbers(&saved(&stage), "center"), ["-1.5", "0", "0"]);
}

/// Where the light on the floor lies.
fn disc(picture: &Picture) -> (f64, f64) {
    // Below the mark and above the status line.
    let lit = |[r, g, b]: [u8; 3]| r > 120 && g > 120 && b > 120;
    let (_, height) = UPPER;
    let seen = (0..PICTURE.0).flat_map(|x| (60..height).map(move |y| (x, y)));
    let seen: Vec<_> = seen.filter(|(x, y)| lit(picture.rgb(*x, *y))).collect();
    let count = seen.len().max(1) as f64;
    let sum = seen.iter().fold((0, 0), |sum, (x, y)| (sum.0 + x, sum.1 + y));
    (sum.0 as f64 / count, sum.1 as f64 / count)
}

#[test]
fn a_light_is_aimed_by_dragging_its_target() {
    let Some(stage) = Stage::start(Some(SPOT)) else { return };
    let start = disc(&stage.settle());
    stage.click(MARK.0, MARK.1);
    stage.until("a selected light", |picture| picture.count(PICTURE, is_accent) > 50);
    stage.drag((MIDDLE.0, MIDDLE.1), (150, 0), "1");
    stage.until("light further right", |picture| (disc(picture).0 - start.0 - 150.0).abs() < 30.0);
    let text = saved(&stage);
    assert_eq!(numbers(&text, "position"), ["0", "4", "0"], "{text}");
    stage.key("ctrl+z");
    stage.until("light where it was", |picture| (disc(picture).0 - start.0).abs() < 3.0);
}

#[test]
fn a_light_is_moved_by_its_mark() {
    let Some(stage) = Stage::start(Some(SPOT)) else { return };
    let start = disc(&stage.settle());
    stage.drag(MARK, (100, 0), "1");
    stage.until("light further right", |picture| disc(picture).0 - start.0 > 60.0);
    let text = saved(&stage);
    assert_eq!(numbers(&text, "direction"), ["0", "-1", "0"], "{text}");
    let position = numbers(&text, "position");
    assert!(position[0].parse().is_ok_and(|x: f64| x > 0.8), "{text}");
    assert!(position.iter().all(|number| number.len() <= 6), "round numbers: {text}");
}
