//! Is the window as one expects who knows others? Smooth pictures at rest, views by key, the middle button, a list of keys
//! that can be read.

use crate::picture::Picture;
use crate::stage::{PICTURE, Stage};
use crate::{MIDDLE, SCENE, is_green, is_red, stage};

/// A red ball's edge, half covered.
const fn is_half_red([r, g, b]: [u8; 3]) -> bool {
    r > 60 && r < 230 && g < 20 && b < 20
}

#[test]
fn at_rest_edges_are_smooth() {
    let Some(stage) = stage() else { return };
    let log = stage.log();
    let last = log.lines().next_back().unwrap_or_default();
    assert!(last.contains(" settled 100% ") && last.ends_with(" at rest"), "{log}");
    let edge = stage.picture().count(PICTURE, is_half_red);
    assert!(edge > 200, "{edge} pixels along the edge are between red and black");
}

#[test]
fn keys_look_from_the_sides_and_without_perspective() {
    let Some(stage) = stage() else { return };
    let start = stage.picture().count(PICTURE, is_red);
    stage.key("3");
    stage.until("the green ball before the red one", |picture| is_green(picture.rgb(MIDDLE.0, MIDDLE.1)));
    stage.key("ctrl+3");
    stage.until("the red ball before the green one", |picture| {
        is_red(picture.rgb(MIDDLE.0, MIDDLE.1)) && picture.count(PICTURE, is_green) == 0
    });
    stage.key("7");
    stage.until("both from above", |picture| {
        picture.middle(PICTURE, is_green).is_some_and(|(x, _)| x > MIDDLE.0 as f64 + 100.0)
    });
    let seen = stage.settle().count(PICTURE, is_red);
    assert!(seen.abs_diff(start) < start / 20, "{start} became {seen}");
    stage.key("5");
    // The outline of a ball before an eye is larger than its middle circle is.
    stage.until("parallel rays", |picture| {
        let red = picture.count(PICTURE, is_red);
        red < seen && red > seen / 2
    });
}

#[test]
fn the_middle_button_orbits_and_with_shift_pans() {
    let Some(stage) = stage() else { return };
    let place = |picture: &Picture| picture.middle(PICTURE, is_green).unwrap_or_default();
    let start = place(&stage.picture());
    stage.drag((60, 60), (100, 0), "2");
    stage.until("another side", |picture| (place(picture).0 - start.0).abs() > 15.0);
    let orbited = place(&stage.settle());
    stage.xdotool(&["keydown", "Shift_L"]);
    stage.drag((60, 60), (-50, 80), "2");
    stage.xdotool(&["keyup", "Shift_L"]);
    stage.until("the ball 80 pixels lower", |picture| (place(picture).1 - orbited.1 - 80.0).abs() < 12.0);
}

#[test]
fn the_list_of_keys_fits_into_a_small_window() {
    let Some(stage) = stage() else { return };
    list_fits(&stage, (500, 350), 228);
}

#[test]
fn the_list_of_keys_fits_where_two_pixels_make_a_point() {
    let Some(stage) = Stage::start_scaled(Some(SCENE), 2) else { return };
    list_fits(&stage, (860, 500), 316);
}

/// Opens the list in a window of that size, whose picture is that wide.
fn list_fits(stage: &Stage, (width, height): (usize, usize), room: usize) {
    stage.resize(width, height);
    stage.wait("the small window", |stage| stage.log().contains(&format!("{room}x{height} 1/1")));
    let before = stage.settle();
    stage.key("F1");
    let changed = |picture: &Picture, columns: std::ops::Range<usize>| {
        let pixels = columns.flat_map(|x| (0..height).map(move |y| (x, y)));
        pixels.filter(|(x, y)| picture.at(*x, *y) != before.at(*x, *y)).count()
    };
    let shown = stage.until("the list", |picture| changed(picture, 20..width - 20) > 1000);
    // The column of keys, with letters; and a rim of the window beside the list.
    let bright = |x: usize, y: usize| shown.rgb(x, y).into_iter().all(|channel| channel > 150);
    let letters = (16..160).flat_map(|x| (70..height - 20).map(move |y| (x, y)));
    assert!(letters.filter(|(x, y)| bright(*x, *y)).count() > 200, "keys are read at the left");
    assert_eq!(changed(&shown, 0..2), 0, "nothing reaches over the left rim");
}

#[test]
fn letters_move_the_camera_while_the_right_button_is_held() {
    let Some(stage) = stage() else { return };
    let start = stage.picture().count(PICTURE, is_red);
    stage.point(60, 60);
    stage.xdotool(&["mousedown", "3", "key", "w", "key", "w", "key", "w"]);
    stage.until("a larger ball", |picture| picture.count(PICTURE, is_red) > start * 5 / 4);
    stage.xdotool(&["key", "s", "key", "s", "key", "s", "mouseup", "3"]);
    stage.until("the ball as before", |picture| picture.count(PICTURE, is_red).abs_diff(start) < start / 20);
}
