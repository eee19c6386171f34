//! Does the window follow its files? What is written elsewhere is shown, what is broken is told and tried again, and what
//! was not saved when the viewer was told to end is brought back.

use std::path::PathBuf;

use crate::picture::Picture;
use crate::stage::{PICTURE, SIZE, Stage};
use crate::{MIDDLE, SCENE, UPPER, is_accent, is_green, is_red, stage};

fn file(stage: &Stage) -> PathBuf {
    stage.folder.path().join("scene.kdl")
}

fn red(picture: &Picture) -> usize {
    picture.count(PICTURE, is_red)
}

#[test]
fn what_is_written_elsewhere_is_shown_from_the_same_view() {
    let Some(stage) = stage() else { return };
    stage.wheel(MIDDLE.0, MIDDLE.1, "4", 3);
    let near = stage.settle();
    std::fs::write(file(&stage), SCENE.replace("radius 2", "radius 1")).expect("their scene");
    stage.until("a smaller ball, as near", |picture| red(picture) > 1000 && red(picture) < red(&near) / 3);
    std::fs::write(file(&stage), SCENE).expect("the scene");
    stage.until("the ball as before", |picture| red(picture) == red(&near));
}

#[test]
fn a_mesh_that_is_written_elsewhere_is_shown() {
    let Some(stage) = stage() else { return };
    let mesh = stage.folder.path().join("flag.obj");
    let square = |side: f64| format!("v 0 0 0\nv {side} 0 0\nv {side} {side} 0\nv 0 {side} 0\nf 1 2 3 4\n");
    std::fs::write(&mesh, square(1.0)).expect("a mesh");
    let with = SCENE.replace(
        "sphere \"left ball\" material=\"red\" { center 0 0 0; radius 2 }",
        "mesh \"flag\" material=\"red\" { file \"flag.obj\" }",
    );
    std::fs::write(file(&stage), with).expect("a scene with a mesh");
    let small = stage.until("a red square", |picture| (100..8000).contains(&red(picture)));
    std::fs::write(&mesh, square(3.0)).expect("a larger mesh");
    stage.until("a larger square", |picture| red(picture) > 5 * red(&small));
}

#[test]
fn a_broken_file_is_told_and_read_again_when_it_is_mended_and_by_retry() {
    let Some(stage) = stage() else { return };
    let title = |picture: &Picture| picture.count(UPPER, is_accent) > 100;
    std::fs::write(file(&stage), SCENE.replace("radius 2", "radius -2")).expect("a broken scene");
    stage.until("the report over the last good scene", |picture| title(picture) && red(picture) > 500);
    std::fs::write(file(&stage), SCENE.replace("radius 2", "radius 1")).expect("a mended scene");
    stage.until("the mended scene, and no report", |picture| !title(picture) && red(picture) > 1000);
    let missing = SCENE.replace(
        "sphere \"left ball\" material=\"red\" { center 0 0 0; radius 2 }",
        "mesh \"flag\" material=\"red\" { file \"flag.obj\" }",
    );
    std::fs::write(file(&stage), missing).expect("a scene that lacks a file");
    stage.until("the report", title);
    let mesh = "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nf 1 2 3 4\n";
    std::fs::write(stage.folder.path().join("flag.obj"), mesh).expect("the file that was missing");
    stage.key("F5");
    stage.until("the scene, and no report", |picture| !title(picture) && red(picture) > 5000);
}

#[test]
fn edits_are_not_given_up_for_what_is_written_elsewhere() {
    let Some(stage) = stage() else { return };
    stage.click(MIDDLE.0, MIDDLE.1);
    stage.until("an outline", |picture| picture.count(UPPER, is_accent) > 300);
    stage.key("Delete");
    stage.until("no red ball", |picture| red(picture) == 0);
    let told = |picture: &Picture| picture.count((PICTURE.0, SIZE.1), is_accent) > 100;
    std::fs::write(file(&stage), SCENE.replace("radius 2", "radius 3")).expect("their scene");
    let picture = stage.until("a word about it", told);
    assert_eq!(red(&picture), 0, "the edit stays");
    stage.key("F5");
    stage.settle();
    stage.key("Tab");
    stage.key("Return");
    stage.until("their ball", |picture| red(picture) > 60_000);
}

#[test]
fn what_was_not_saved_when_the_viewer_was_told_to_end_is_brought_back() {
    let Some(mut stage) = stage() else { return };
    stage.click(MIDDLE.0, MIDDLE.1);
    stage.until("an outline", |picture| picture.count(UPPER, is_accent) > 300);
    stage.key("Delete");
    stage.until("no red ball", |picture| red(picture) == 0);
    stage.tell_to_end();
    assert_eq!(stage.exit_code(), Some(130));
    assert_eq!(std::fs::read_to_string(file(&stage)).expect("the scene"), SCENE, "it is not saved unasked");
    stage.restart(None);
    stage.settle();
    stage.key("Return");
    stage
        .until("the green ball alone", |picture| red(picture) == 0 && picture.count(PICTURE, is_green) > 300);
    stage.key("ctrl+s");
    stage.wait("the saved edit", |stage| {
        std::fs::read_to_string(file(stage))
            .is_ok_and(|text| !text.contains("left ball") && text.contains("// two"))
    });
    stage.key("ctrl+q");
    assert_eq!(stage.exit_code(), Some(0));
    stage.restart(Some("scene.kdl"));
    let picture = stage.settle();
    assert!(picture.count(PICTURE, is_green) > 300, "nothing is offered again");
    stage.key("ctrl+q");
    assert_eq!(stage.exit_code(), Some(0), "and nothing is asked");
}

#[test]
fn without_edits_nothing_is_kept() {
    let Some(mut stage) = stage() else { return };
    stage.tell_to_end();
    assert_eq!(stage.exit_code(), Some(130));
    assert!(!stage.folder.path().join("state/catoptra/recovery").exists());
}
