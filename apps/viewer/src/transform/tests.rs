use std::path::Path;

use catoptra_core::glam::DVec3;
use catoptra_tracer::Pool;
use winit::keyboard::{Key, NamedKey};

use super::*;
use crate::document::Document;
use crate::loader::Opened;

const TEXT: &str = "camera \"c\" { eye 0 2 10; target 0 2 0 }\nmatte \"grey\" { color 0.5 }\n\
    plane \"floor\" material=\"grey\"\nsphere \"ball\" material=\"grey\" { center 0 2 0; radius 0.5 }\n\
    sphere \"other\" material=\"grey\" { center 2 2 0; radius 0.5 }\n\
    spot-light \"spot\" { position -2 3 0; direction 0 -1 0; intensity 20; inner 20; outer 40 }\n";

fn viewer(folder: &Path) -> Viewer {
    let path = folder.join("scene.kdl");
    std::fs::write(&path, TEXT).unwrap();
    let document = Document::open(&path).unwrap();
    let mut viewer = Viewer::new(Opened::new(document, &Pool::new(1).unwrap()));
    viewer.size = (640, 360);
    viewer
}

fn select(viewer: &mut Viewer, names: &[&str]) {
    let scene = viewer.document.scene();
    let ids: Vec<EntityId> = names.iter().map(|name| scene.entity_named(name).unwrap()).collect();
    viewer.select_all(ids.into_iter().collect());
}

fn center(viewer: &Viewer, name: &str) -> DVec3 {
    let scene = viewer.document.scene();
    pivot::place_of(scene, scene.entity_named(name).unwrap()).unwrap()
}

fn press(viewer: &mut Viewer, text: &str) {
    for c in text.chars() {
        assert!(key(viewer, &Key::Character(c.to_string().as_str().into()), false));
    }
}

fn seen(viewer: &Viewer, point: DVec3) -> (f64, f64) {
    let seen = Projection::new(&viewer.camera, 640, 360).project(point).unwrap();
    (seen.x, seen.y)
}

#[test]
fn what_is_selected_follows_the_pointer_as_one_step() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path());
    select(&mut viewer, &["ball", "other", "spot"]);
    let before = ["ball", "other", "spot"].map(|name| center(&viewer, name));
    begin(&mut viewer, Tool::Move, Constraint::Free, Ends::ByClick, (320.0, 180.0));
    for x in 0..30 {
        pull(&mut viewer, (320.0 + f64::from(x) * 3.0, 180.0), false);
    }
    keep(&mut viewer);
    let moved = ["ball", "other", "spot"].map(|name| center(&viewer, name));
    let by: Vec<DVec3> = moved.iter().zip(&before).map(|(now, was)| *now - *was).collect();
    let first = by[0];
    assert!(first.x > 0.5 && by.iter().all(|by| by.distance(first) < 1e-9), "{by:?}");
    assert!(viewer.document.undo().is_some());
    assert_eq!(["ball", "other", "spot"].map(|name| center(&viewer, name)), before);
    assert!(viewer.document.is_saved());
}

#[test]
fn typed_numbers_and_axes_are_exact_and_saved_short() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path());
    select(&mut viewer, &["ball"]);
    begin(&mut viewer, Tool::Move, Constraint::Free, Ends::ByClick, (320.0, 180.0));
    pull(&mut viewer, (341.0, 155.0), false);
    press(&mut viewer, "y1/4");
    assert_eq!(center(&viewer, "ball"), DVec3::new(0.0, 2.25, 0.0));
    assert!(key(&mut viewer, &Key::Named(NamedKey::Enter), false));
    assert!(!key(&mut viewer, &Key::Character("y".into()), false), "it has ended");
    viewer.document.save().unwrap();
    let text = std::fs::read_to_string(folder.path().join("scene.kdl")).unwrap();
    assert!(text.contains("center 0 2.25 0"), "{text}");
    begin(&mut viewer, Tool::Move, Constraint::Along(Axis::X), Ends::ByClick, (320.0, 180.0));
    pull(&mut viewer, (347.3, 155.0), false);
    let ball = viewer.document.scene().entity_named("ball").unwrap();
    let values = viewer.document.scene().shape(ball).unwrap().values();
    let Some(catoptra_core::Value::Vector(at)) = values.get("center") else { panic!("{values:?}") };
    assert!(at.x > 0.1 && at.x.to_string().len() <= 4, "{at}");
}

#[test]
fn taking_back_leaves_everything_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path());
    for (tool, ends) in
        [(Tool::Move, Ends::ByClick), (Tool::Turn, Ends::ByRelease), (Tool::Scale, Ends::ByClick)]
    {
        select(&mut viewer, &["ball", "spot"]);
        begin(&mut viewer, tool, Constraint::Free, ends, (400.0, 180.0));
        pull(&mut viewer, (460.0, 120.0), false);
        assert!(!viewer.document.is_saved(), "{tool:?} did something");
        assert!(key(&mut viewer, &Key::Named(NamedKey::Escape), false));
        assert!(viewer.document.is_saved() && viewer.transform.is_none());
        assert_eq!(center(&viewer, "ball"), DVec3::new(0.0, 2.0, 0.0));
    }
}

#[test]
fn what_could_be_done_again_still_can_when_a_drag_is_taken_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path());
    let ball = viewer.document.scene().entity_named("ball").unwrap();
    let drag = |viewer: &mut Viewer| {
        select(viewer, &["ball"]);
        begin(viewer, Tool::Move, Constraint::Free, Ends::ByClick, (400.0, 180.0));
        pull(viewer, (460.0, 120.0), false);
        take_back(viewer);
    };
    drag(&mut viewer);
    assert!(viewer.document.redo().is_none(), "what was taken back is gone");
    viewer.edit(Edit::Name(ball, "globe".to_owned()));
    assert!(viewer.document.undo().is_some());
    drag(&mut viewer);
    assert!(viewer.document.is_saved() && viewer.document.redo().is_some());
    assert_eq!(viewer.document.scene().name(ball).as_deref(), Some("globe"));
}

#[test]
fn ctrl_goes_by_round_steps() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path());
    select(&mut viewer, &["ball"]);
    begin(&mut viewer, Tool::Move, Constraint::Free, Ends::ByRelease, (320.0, 180.0));
    pull(&mut viewer, (399.0, 143.0), true);
    let at = center(&viewer, "ball");
    assert!(at.x > 0.5 && (at.x * 2.0).fract() == 0.0 && (at.y * 2.0).fract() == 0.0, "{at}");
}

#[test]
fn things_stand_on_the_surface_under_the_pointer() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path());
    viewer.settings.on_surfaces = true;
    for (name, height) in [("ball", 0.5..0.52), ("spot", 0.02..1.0)] {
        select(&mut viewer, &[name]);
        let to = seen(&viewer, DVec3::new(1.0, 0.0, 4.0));
        let from = seen(&viewer, center(&viewer, name));
        begin(&mut viewer, Tool::Move, Constraint::Free, Ends::ByRelease, from);
        // Wherever the pointer was before.
        pull(&mut viewer, (from.0 - 30.0, from.1 + 60.0), false);
        pull(&mut viewer, to, false);
        let at = center(&viewer, name);
        assert!((at.x - 1.0).abs() < 0.05 && height.contains(&at.y) && (at.z - 4.0).abs() < 0.05, "{at}");
        keep(&mut viewer);
    }
}

#[test]
fn a_turn_about_the_middle_of_several_takes_them_round() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path());
    select(&mut viewer, &["ball", "other"]);
    begin(&mut viewer, Tool::Turn, Constraint::Along(Axis::Y), Ends::ByClick, (320.0, 180.0));
    press(&mut viewer, "180");
    let (ball, other) = (center(&viewer, "ball"), center(&viewer, "other"));
    assert!((ball - DVec3::new(2.0, 2.0, 0.0)).length() < 1e-9, "{ball}");
    assert!((other - DVec3::new(0.0, 2.0, 0.0)).length() < 1e-9, "{other}");
}

#[test]
fn locked_things_stay() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path());
    let ball = viewer.document.scene().entity_named("ball").unwrap();
    viewer.edit(Edit::Flags(ball, catoptra_core::Flags { hidden: false, locked: true }));
    select(&mut viewer, &["ball"]);
    begin(&mut viewer, Tool::Move, Constraint::Free, Ends::ByClick, (320.0, 180.0));
    assert!(viewer.transform.is_none());
}

#[test]
fn a_light_that_is_flown_goes_along_with_the_view() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path());
    let (home, spot) = (viewer.camera.clone(), viewer.document.scene().entity_named("spot").unwrap());
    crate::fly::begin(&mut viewer, spot);
    assert!(viewer.document.is_saved(), "looking changes nothing");
    assert!((viewer.camera.forward() - DVec3::NEG_Y).length() < 1e-9);
    let camera = crate::camera_control::orbit(&viewer.camera, 0.0, -0.4);
    viewer.look(camera.clone());
    viewer.follow_scene();
    let light = viewer.document.scene().world_light(spot).unwrap();
    assert!((light.position().unwrap() - camera.eye()).length() < 0.05);
    assert!(light.direction().unwrap().angle_between(camera.forward()) < 1e-3);
    crate::fly::end(&mut viewer);
    assert_eq!(viewer.camera, home);
}
