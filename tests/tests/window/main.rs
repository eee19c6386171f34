//! Does the window do what it promises? The viewer under Xvfb, driven by xdotool, judged by screenshots.
#![cfg(target_os = "linux")]

mod picture;
mod stage;

use std::time::Duration;

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

/// The picture without its lower rim, where the status line tells of things in that colour too.
const UPPER: (usize, usize) = (PICTURE.0, PICTURE.1 - 60);

const MIDDLE: (usize, usize) = (PICTURE.0 / 2, PICTURE.1 / 2);

fn stage() -> Option<Stage> {
    Stage::start(Some(SCENE))
}

#[test]
fn it_starts_with_the_built_in_scene() {
    let Some(stage) = Stage::start(None) else { return };
    let picture = stage.picture();
    assert!(picture.colors(PICTURE) > 1000, "a picture with {} colours", picture.colors(PICTURE));
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
    let nearer = stage.picture().count(PICTURE, is_red);
    assert!(nearer > before * 5 / 4, "{before} red pixels became {nearer}");
    stage.wheel(MIDDLE.0, MIDDLE.1, "4", 5);
    stage.key("Home");
    let picture = stage.picture();
    assert!(picture.count(PICTURE, is_red) > 1000 && picture.count(PICTURE, is_green) > 300);
}

#[test]
fn a_drag_orbits_and_a_right_drag_pans() {
    let Some(stage) = stage() else { return };
    let place = |stage: &Stage| stage.picture().middle(PICTURE, is_green).expect("a green ball");
    let start = place(&stage);
    stage.drag((60, 60), (100, 0), "1");
    let orbited = place(&stage);
    assert!((orbited.0 - start.0).abs() > 15.0, "{start:?} became {orbited:?}");
    stage.drag((60, 60), (-50, 80), "3");
    let panned = place(&stage);
    assert!((panned.1 - orbited.1 - 80.0).abs() < 12.0, "{orbited:?} became {panned:?}");
}

#[test]
fn a_click_selects_and_outlines() {
    let Some(stage) = stage() else { return };
    assert_eq!(stage.picture().count(UPPER, is_accent), 0);
    stage.click(MIDDLE.0, MIDDLE.1);
    assert!(stage.picture().count(UPPER, is_accent) > 300);
    stage.key("Escape");
    assert_eq!(stage.picture().count(UPPER, is_accent), 0);
}

#[test]
fn the_turntable_turns_is_undone_and_saved() {
    let Some(stage) = stage() else { return };
    let before = stage.picture();
    let file = stage.folder.path().join("scene.kdl");
    stage.key("t");
    stage.drag((60, 60), (0, 100), "1");
    stage.drag((60, 60), (200, 0), "1");
    let (x, _) = stage.picture().middle(PICTURE, is_green).expect("a green ball");
    let (start, _) = before.middle(PICTURE, is_green).expect("a green ball");
    assert!(x < start - 40.0, "a turn by 60 degrees brings it from {start} to {x}");
    assert_eq!(std::fs::read_to_string(&file).expect("the scene"), SCENE, "nothing is saved unasked");
    stage.key("ctrl+s");
    let saved = std::fs::read_to_string(&file).expect("the saved scene");
    assert!(
        saved != SCENE && saved.contains("// two balls") && saved.contains("// the large one"),
        "{saved}"
    );
    stage.key("ctrl+z");
    stage.key("ctrl+z");
    let after = stage.picture();
    let differing = (0..500).filter(|y| (0..PICTURE.0).any(|x| before.at(x, *y) != after.at(x, *y))).count();
    assert_eq!(differing, 0, "rows of the picture differ after undo");
    stage.key("ctrl+shift+z");
    stage.key("ctrl+shift+z");
    assert!(stage.picture().at(start as usize, MIDDLE.1) != before.at(start as usize, MIDDLE.1));
}

#[test]
fn the_picture_follows_the_size_of_the_window() {
    let Some(mut stage) = stage() else { return };
    for (width, height) in [(1200, 700), (500, 400), (1, 1), (300, 900), (900, 600)] {
        stage.resize(width, height);
        assert!(stage.runs(), "at {width}x{height}");
        let room = if width > 408 { width - 272 } else { width };
        if room > 1 {
            let picture = stage.picture();
            assert!(is_red(picture.rgb(room / 2, height / 2)), "at {width}x{height}");
            assert!(stage.log().contains(&format!("{room}x{height} 1/1")), "at {width}x{height}");
        }
    }
}

#[test]
fn a_window_that_was_away_is_shown_again() {
    let Some(mut stage) = stage() else { return };
    let before = stage.picture();
    stage.hide();
    assert!(stage.picture() != before && stage.runs());
    stage.show();
    let after = stage.picture();
    assert!((0..UPPER.1).all(|y| (0..UPPER.0).all(|x| before.at(x, y) == after.at(x, y))));
}

#[test]
fn it_fits_a_screen_with_two_pixels_to_a_point() {
    let Some(stage) = Stage::start_scaled(Some(SCENE), 2) else { return };
    let room = SIZE.0 - 2 * 272;
    assert!(stage.log().contains(&format!("{room}x{} 1/1", SIZE.1)), "{}", stage.log());
    stage.click(room / 2, SIZE.1 / 2);
    assert!(stage.picture().count((room, SIZE.1), is_accent) > 600, "the outline is twice as thick");
}

#[test]
fn at_rest_nothing_is_traced_and_no_time_is_used() {
    let Some(stage) = stage() else { return };
    let (frames, ticks) = (stage.frames(), stage.ticks());
    std::thread::sleep(Duration::from_secs(2));
    assert_eq!(stage.frames(), frames, "frames traced at rest");
    assert!(stage.ticks() - ticks <= 1, "{} ticks of processor time used at rest", stage.ticks() - ticks);
}

#[test]
fn p_writes_the_picture() {
    let Some(stage) = stage() else { return };
    stage.key("p");
    stage.key("p");
    for name in ["scene.png", "scene-2.png"] {
        let bytes = std::fs::read(stage.folder.path().join(name)).expect("a picture");
        assert!(bytes.starts_with(b"\x89PNG\r\n"), "{name}");
    }
}

#[test]
fn a_broken_scene_is_reported_and_the_last_one_stays() {
    let broken = SCENE.replace("radius 2", "radius -2");
    let Some(mut stage) = Stage::start(Some(&broken)) else { return };
    assert!(stage.runs());
    let report = stage.picture();
    assert!(report.count(PICTURE, is_accent) > 20, "the report's title");
    stage.key("Escape");
    let shown = stage.picture();
    assert!(shown.colors(PICTURE) > 1000, "the built-in scene");
    assert!(shown.count(PICTURE, |_| true) > 0 && shown != report);
}

#[test]
fn keys_are_listed_and_the_panel_can_go() {
    let Some(stage) = stage() else { return };
    let before = stage.picture();
    stage.key("F1");
    assert!(stage.picture() != before);
    stage.key("F1");
    stage.key("Tab");
    assert!(stage.log().contains(&format!("{}x{} 1/1", SIZE.0, SIZE.1)), "the picture fills the window");
}

#[test]
fn ctrl_q_quits() {
    let Some(mut stage) = stage() else { return };
    stage.xdotool(&["key", "ctrl+q"]);
    assert_eq!(stage.exit_code(), Some(0));
}
