//! Does the window do what it promises? The viewer under Xvfb, driven by xdotool, judged by screenshots.
#![cfg(target_os = "linux")]

mod clipboard;
mod desktop;
mod files;
mod guards;
mod keeping;
mod making;
mod manners;
mod moving;
mod picture;
mod programs;
mod random;
mod seeing;
mod selecting;
mod stage;
mod tree;
mod writing;

use std::time::{Duration, Instant};

use picture::Picture;
use stage::{PICTURE, SIZE, Stage};

/// A red ball and a green one beside it before black, lit from everywhere alike: every pixel's colour is known.
const SCENE: &str = "\
// two balls
camera \"main\" { eye 0 0 12; target 0 0 0; fov 45 }
ambient-light \"sky\" { radiance 1 1 1 }
matte \"red\" { color 1 0 0 }
matte \"green\" { color 0 1 0 }
sphere \"left ball\" material=\"red\" { center 0 0 0; radius 2 } // the large one
sphere \"right ball\" material=\"green\" { center 4 0 0; radius 1 }
";

const fn is_red([r, g, b]: [u8; 3]) -> bool {
    r > 200 && g < 40 && b < 40
}

const fn is_green([r, g, b]: [u8; 3]) -> bool {
    g > 200 && r < 40 && b < 40
}

/// The colour of outlines and bounds.
const fn is_accent([r, g, b]: [u8; 3]) -> bool {
    r > 220 && g > 150 && g < 200 && b < 90
}

/// The picture without its lower rim, where the status line tells of things in that colour too, and of time.
const UPPER: (usize, usize) = (PICTURE.0, PICTURE.1 - 60);

const MIDDLE: (usize, usize) = (PICTURE.0 / 2, PICTURE.1 / 2);

/// Whether two screenshots are the same in their left upper part of that size.
fn same(a: &Picture, b: &Picture, (width, height): (usize, usize)) -> bool {
    (0..height).all(|y| (0..width).all(|x| a.at(x, y) == b.at(x, y)))
}

fn stage() -> Option<Stage> {
    Stage::start(Some(SCENE))
}

#[test]
fn it_starts_with_the_built_in_scene() {
    let Some(stage) = Stage::start(None) else { return };
    stage.until("a picture of many colours", |picture| picture.colors(PICTURE) > 1000);
    assert!(stage.log().contains(&format!("{}x{} 1/1", PICTURE.0, PICTURE.1)), "{}", stage.log());
}

#[test]
fn it_shows_the_scene_that_was_named() {
    let Some(stage) = stage() else { return };
    let picture = stage.picture();
    assert!(is_red(picture.rgb(MIDDLE.0, MIDDLE.1)));
    let (x, y) = picture.middle(PICTURE, is_green).expect("a green ball");
    assert!(
        x > MIDDLE.0 as f64 + 100.0 && (y - MIDDLE.1 as f64).abs() < 3.0,
        "the green ball is at {x}, {y}"
    );
    assert_eq!(picture.rgb(20, 20), [0; 3]);
}

#[test]
fn the_wheel_comes_nearer_and_home_shows_all() {
    let Some(stage) = stage() else { return };
    let before = stage.picture().count(PICTURE, is_red);
    stage.wheel(MIDDLE.0, MIDDLE.1, "4", 3);
    stage.until("a larger ball", |picture| picture.count(PICTURE, is_red) > before * 5 / 4);
    stage.wheel(MIDDLE.0, MIDDLE.1, "4", 9);
    stage.until("the red ball alone", |picture| picture.count(PICTURE, is_green) == 0);
    stage.key("Home");
    stage.until("both balls", |picture| {
        picture.count(PICTURE, is_red) > 1000 && picture.count(PICTURE, is_green) > 300
    });
}

#[test]
fn a_drag_orbits_and_a_right_drag_pans() {
    let Some(stage) = stage() else { return };
    let place = |picture: &Picture| picture.middle(PICTURE, is_green).unwrap_or_default();
    let start = place(&stage.picture());
    stage.drag((60, 60), (100, 0), "1");
    stage.until("another side", |picture| (place(picture).0 - start.0).abs() > 15.0);
    let orbited = place(&stage.settle());
    stage.drag((60, 60), (-50, 80), "3");
    stage.until("the ball 80 pixels lower", |picture| (place(picture).1 - orbited.1 - 80.0).abs() < 12.0);
    let panned = place(&stage.settle());
    assert!((panned.1 - orbited.1 - 80.0).abs() < 12.0, "{orbited:?} became {panned:?}");
}

#[test]
fn a_click_selects_and_outlines() {
    let Some(stage) = stage() else { return };
    assert_eq!(stage.picture().count(UPPER, is_accent), 0);
    stage.click(MIDDLE.0, MIDDLE.1);
    stage.until("an outline", |picture| picture.count(UPPER, is_accent) > 300);
    stage.key("Escape");
    stage.until("no outline", |picture| picture.count(UPPER, is_accent) == 0);
}

#[test]
fn the_turntable_turns_is_undone_and_saved() {
    let Some(stage) = stage() else { return };
    let before = stage.picture();
    let (start, _) = before.middle(PICTURE, is_green).expect("a green ball");
    let file = stage.folder.path().join("scene.kdl");
    stage.key("t");
    stage.drag((60, 60), (0, 100), "1");
    stage.drag((60, 60), (200, 0), "1");
    stage.until("a turn by 60 degrees", |picture| {
        picture.middle(PICTURE, is_green).is_some_and(|(x, _)| x < start - 40.0)
    });
    assert_eq!(std::fs::read_to_string(&file).expect("the scene"), SCENE, "nothing is saved unasked");
    stage.key("ctrl+s");
    stage.wait("the saved scene", |_| std::fs::read_to_string(&file).is_ok_and(|text| text != SCENE));
    let saved = std::fs::read_to_string(&file).expect("the saved scene");
    assert!(saved.contains("// two balls") && saved.contains("// the large one"), "{saved}");
    stage.key("ctrl+z");
    stage.key("ctrl+z");
    stage.key("t");
    stage.until("the picture as it was", |picture| same(&before, picture, UPPER));
    stage.key("ctrl+shift+z");
    stage.key("ctrl+shift+z");
    let turned =
        |picture: &Picture| picture.at(start as usize, MIDDLE.1) != before.at(start as usize, MIDDLE.1);
    stage.until("the turn again", turned);
}

#[test]
fn the_picture_follows_the_size_of_the_window() {
    let Some(mut stage) = stage() else { return };
    for (width, height) in [(1200, 700), (500, 400), (1, 1), (300, 680), (900, 600)] {
        stage.resize(width, height);
        let room = if width > 408 { width - 272 } else { width };
        let size = format!("{room}x{height}");
        stage.wait(&size, |stage| {
            let log = stage.log();
            let last = log.lines().next_back().unwrap_or_default();
            last.contains(&format!(" {size} 1/1 settled 100%")) && last.ends_with("at rest")
        });
        if room > 1 {
            stage.until(&format!("the ball at {size}"), |picture| is_red(picture.rgb(room / 2, height / 2)));
        }
        assert!(stage.runs(), "at {width}x{height}");
    }
}

#[test]
fn a_window_that_was_away_is_shown_again() {
    let Some(mut stage) = stage() else { return };
    let before = stage.picture();
    stage.hide();
    stage.until("no window", |picture| !is_red(picture.rgb(MIDDLE.0, MIDDLE.1)));
    assert!(stage.runs());
    stage.show();
    stage.until("the picture as it was", |picture| same(&before, picture, UPPER));
}

#[test]
fn it_fits_a_screen_with_two_pixels_to_a_point() {
    let Some(stage) = Stage::start_scaled(Some(SCENE), 2) else { return };
    let room = SIZE.0 - 2 * 272;
    assert!(stage.log().contains(&format!("{room}x{} 1/1", SIZE.1)), "{}", stage.log());
    stage.click(room / 2, SIZE.1 / 2);
    let is_outline = |picture: &Picture, x: usize| is_accent(picture.rgb(x, SIZE.1 / 2));
    let thickness = |picture: &Picture| (0..room / 2).filter(|x| is_outline(picture, *x)).count();
    stage.until("an outline of four pixels", |picture| (4..=6).contains(&thickness(picture)));
}

#[test]
fn at_rest_nothing_is_traced_and_no_time_is_used() {
    let Some(stage) = stage() else { return };
    let mut rest = (stage.ticks(), Instant::now());
    stage.wait("half a second without work", |stage| {
        if stage.ticks() != rest.0 {
            rest = (stage.ticks(), Instant::now());
        }
        rest.1.elapsed() > Duration::from_millis(500)
    });
    let (frames, ticks) = (stage.frames(), stage.ticks());
    std::thread::sleep(Duration::from_secs(2));
    assert_eq!(stage.frames(), frames, "frames traced at rest");
    assert!(stage.ticks() - ticks <= 1, "{} ticks of processor time used at rest", stage.ticks() - ticks);
}

#[test]
fn a_broken_scene_is_reported_and_the_last_one_stays() {
    let broken = SCENE.replace("radius 2", "radius -2");
    let Some(mut stage) = Stage::start(Some(&broken)) else { return };
    let report = stage.until("the report's title", |picture| picture.count(UPPER, is_accent) > 20);
    stage.key("Escape");
    stage.until("the built-in scene", |picture| {
        picture.colors(PICTURE) > 1000 && !same(&report, picture, UPPER)
    });
    assert!(stage.runs());
}

#[test]
fn keys_are_listed_and_the_panel_can_go() {
    let Some(stage) = stage() else { return };
    let before = stage.picture();
    stage.key("F1");
    stage.until("the list", |picture| !same(&before, picture, UPPER));
    stage.key("F1");
    stage.until("no list", |picture| same(&before, picture, UPPER));
    stage.key("Tab");
    let filled = format!("{}x{} 1/1", SIZE.0, SIZE.1);
    stage.wait("a picture that fills the window", |stage| stage.log().contains(&filled));
}

#[test]
fn ctrl_q_quits() {
    let Some(mut stage) = stage() else { return };
    stage.key("ctrl+q");
    assert_eq!(stage.exit_code(), Some(0));
}
