//! Does the window show a scene as one asks for: brighter, by single lights, as it was before, by passes?

use crate::picture::Picture;
use crate::stage::{PICTURE, Stage};
use crate::{MIDDLE, SCENE, UPPER, is_accent, is_red};

/// A white ball in red and in blue light from everywhere: both together are magenta.
const LIGHTS: &str = "camera \"main\" { eye 0 0 12; target 0 0 0; fov 45 }\n\
    ambient-light \"red sky\" { radiance 1 0 0 }\nambient-light \"blue sky\" { radiance 0 0 1 }\n\
    matte \"white\" { color 1 }\nsphere \"ball\" material=\"white\" { radius 2 }\n";

/// Where the rows of the tree stand, in pixels.
const FIRST_ROW: usize = 86;
const ROW: usize = 22;

/// Clicks a row of the tree.
fn click_row(stage: &Stage, row: usize) {
    stage.click(PICTURE.0 + 46, FIRST_ROW + ROW * row);
}

fn middle_is(wanted: [u8; 3]) -> impl Fn(&Picture) -> bool {
    move |picture| {
        picture.rgb(MIDDLE.0, MIDDLE.1).iter().zip(wanted).all(|(is, wanted)| is.abs_diff(wanted) <= 2)
    }
}

#[test]
fn exposure_goes_by_stops_and_follows_the_picture() {
    let Some(stage) = Stage::start(Some(SCENE)) else { return };
    for _ in 0..6 {
        stage.key("bracketleft");
    }
    // Two stops less: a quarter of the light.
    stage.until("a darker ball", middle_is([137, 0, 0]));
    for _ in 0..6 {
        stage.key("bracketright");
    }
    stage.until("the ball as it was", middle_is([255, 0, 0]));
    stage.key("e");
    let red = |picture: &Picture| picture.rgb(MIDDLE.0, MIDDLE.1);
    stage.until("an exposure of its own", |picture| red(picture)[0] < 250 && red(picture)[0] > 90);
    let text = std::fs::read_to_string(stage.folder.path().join("scene.kdl")).expect("the scene");
    assert_eq!(text, SCENE);
}

#[test]
fn a_light_shines_alone_or_is_muted_in_the_window_alone() {
    let Some(stage) = Stage::start(Some(LIGHTS)) else { return };
    let signs = |picture: &Picture| picture.count((PICTURE.0, 60), is_accent);
    assert!(middle_is([255, 0, 255])(&stage.picture()));
    assert_eq!(signs(&stage.picture()), 0);
    click_row(&stage, 1);
    stage.key("l");
    stage.until("red light alone", middle_is([255, 0, 0]));
    stage.until("a sign that tells of it", |picture| signs(picture) > 100);
    stage.key("l");
    stage.until("both lights", middle_is([255, 0, 255]));
    stage.key("m");
    stage.until("blue light alone", middle_is([0, 0, 255]));
    // A file that was saved would hold what the window shows.
    stage.key("ctrl+s");
    stage.settle();
    let text = std::fs::read_to_string(stage.folder.path().join("scene.kdl")).expect("the scene");
    assert_eq!(text, LIGHTS);
    stage.key("Escape");
    stage.key("m");
    stage.until("all lights", middle_is([255, 0, 255]));
}

#[test]
fn a_scene_without_lights_is_lit_from_the_camera_and_says_so() {
    let unlit = SCENE.replace("ambient-light \"sky\" { radiance 1 1 1 }\n", "");
    let Some(stage) = Stage::start(Some(&unlit)) else { return };
    let picture = stage.until("a lit ball", |picture| is_red(picture.rgb(MIDDLE.0, MIDDLE.1)));
    assert!(picture.count((PICTURE.0, 60), is_accent) > 100, "a sign tells why");
    stage.drag((60, 60), (100, 0), "1");
    stage.until("a ball that is lit from the new side", |picture| is_red(picture.rgb(MIDDLE.0, MIDDLE.1)));
}

#[test]
fn the_scene_before_the_last_edit_is_seen_while_a_key_is_held() {
    let Some(stage) = Stage::start(Some(SCENE)) else { return };
    stage.click(MIDDLE.0, MIDDLE.1);
    stage.until("an outline", |picture| picture.count(UPPER, is_accent) > 300);
    stage.key("Delete");
    stage.until("no red ball", |picture| picture.count(UPPER, is_red) == 0);
    stage.xdotool(&["keydown", "b"]);
    stage.until("the red ball", |picture| picture.count(UPPER, is_red) > 1000);
    stage.xdotool(&["keyup", "b"]);
    stage.until("no red ball again", |picture| picture.count(UPPER, is_red) == 0);
}

#[test]
fn passes_show_colours_and_normals() {
    let Some(stage) = Stage::start(Some(SCENE)) else { return };
    stage.key("v");
    stage.until("albedo", middle_is([255, 0, 0]));
    stage.key("v");
    stage.until("a normal towards the eye", middle_is([128, 128, 255]));
}

/// A window of which the panel shows its lower end, with switches in known places.
const TALL: (usize, usize) = (900, 710);
const MARK_CLIPPED: (usize, usize) = (657, 455);
const COMPARE: (usize, usize) = (675, 560);
const COMPARED_WITH: (usize, usize) = (720, 582);
const COMPARE_NOW: (usize, usize) = (835, 582);

/// Shows the lower end of the panel.
fn tall() -> Option<Stage> {
    let stage = Stage::start(Some(SCENE))?;
    stage.resize(TALL.0, TALL.1);
    let size = format!(" {}x{} ", PICTURE.0, TALL.1);
    let is_rest = |line: &str| line.contains(&size) && line.ends_with(" at rest");
    stage.wait("the tall window", |stage| stage.log().lines().last().is_some_and(is_rest));
    stage.wheel(760, TALL.1 - 60, "5", 30);
    stage.settle();
    Some(stage)
}

#[test]
fn pixels_that_are_brighter_than_white_can_be_marked() {
    let Some(stage) = tall() else { return };
    let marked = |picture: &Picture| picture.count(PICTURE, |rgb| rgb == [255, 0, 200]);
    assert_eq!(marked(&stage.picture()), 0);
    stage.click(MARK_CLIPPED.0, MARK_CLIPPED.1);
    stage.until("stripes on the balls", |picture| marked(picture) > 20_000);
    // Three stops darker nothing is clipped.
    (0..9).for_each(|_| stage.key("bracketleft"));
    stage.until("no stripes", |picture| marked(picture) == 0);
}

#[test]
fn a_picture_on_disk_stands_beside_and_the_error_is_told() {
    let Some(stage) = tall() else { return };
    let file = stage.folder.path().join("blue.png");
    let numbers = |picture: &Picture| {
        let panel = (PICTURE.0..TALL.0).flat_map(|x| (590..TALL.1).map(move |y| (x, y)));
        panel.filter(|(x, y)| is_accent(picture.rgb(*x, *y))).count()
    };
    // All blue, as large as the picture.
    let (width, height) = (PICTURE.0 as u32, TALL.1 as u32);
    let blue = [0, 0, 255].repeat(PICTURE.0 * TALL.1);
    catoptra_scene::image::write_png(&file, width, height, &blue).expect("another picture");
    stage.click(COMPARE.0, COMPARE.1);
    let opened = stage.settle();
    assert_eq!(numbers(&opened), 0);
    stage.click(COMPARED_WITH.0, COMPARED_WITH.1);
    stage.xdotool(&["type", "blue.png"]);
    stage.click(COMPARE_NOW.0, COMPARE_NOW.1);
    let is_blue = |rgb: [u8; 3]| rgb == [0, 0, 255];
    let shown = stage.until("blue beside red", |picture| {
        picture.count(PICTURE, is_blue) > PICTURE.0 * PICTURE.1 / 3 && numbers(picture) > 50
    });
    assert!(is_red(shown.rgb(MIDDLE.0 - 20, TALL.1 / 2)) && is_blue(shown.rgb(MIDDLE.0 + 20, TALL.1 / 2)));
}
