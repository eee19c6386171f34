use catoptra_core::glam::DVec3;
use catoptra_tracer::Pool;

use super::*;
use crate::document::Document;
use crate::gestures::{gesture, is_object, wheel};
use crate::input::{Drag, Gesture, Hold};
use crate::loader::{self, Opened};
use crate::selection::Picking;

fn viewer() -> Viewer {
    let mut viewer = Viewer::new(loader::welcome(&Pool::new(1).unwrap()).unwrap());
    viewer.size = (640, 360);
    viewer
}

fn placements(viewer: &Viewer) -> Vec<DVec3> {
    let scene = viewer.document.scene();
    scene.entities().filter_map(|id| scene.placement(id)).map(|p| p.point(DVec3::X)).collect()
}

#[test]
fn a_turntable_drag_turns_objects_by_three_tenths_of_a_degree_a_pixel_as_one_step() {
    let mut viewer = viewer();
    let before = placements(&viewer);
    for _ in 0..10 {
        gesture(&mut viewer, Gesture::Dragged { drag: Drag::Turn, by: (10.0, 0.0), to: (0.0, 0.0) });
    }
    gesture(&mut viewer, Gesture::Ended(Drag::Turn));
    let scene = viewer.document.scene();
    let floor = scene.entity_named("floor").unwrap();
    let turned = scene.placement(floor).unwrap().direction(DVec3::X);
    let angle = 30_f64.to_radians();
    assert!((turned - DVec3::new(angle.cos(), 0.0, -angle.sin())).length() < 1e-12, "{turned}");
    run(&mut viewer, Command::Undo);
    assert_eq!(placements(&viewer), before);
    assert!(viewer.document.is_saved());
}

#[test]
fn a_turntable_drag_leaves_round_numbers() {
    let mut viewer = viewer();
    for step in 0..10 {
        gesture(
            &mut viewer,
            Gesture::Dragged { drag: Drag::Turn, by: (7.0, f64::from(step)), to: (0.0, 0.0) },
        );
    }
    gesture(&mut viewer, Gesture::Ended(Drag::Turn));
    let text = viewer.document.text();
    let turns = text.lines().filter_map(|line| line.split("turn ").nth(1));
    let numbers: Vec<&str> =
        turns.flat_map(|rest| rest.split([';', '{', '}']).next().unwrap().split(' ')).collect();
    assert!(numbers.len() > 4 && numbers.iter().all(|number| number.len() <= 8), "{text}");
}

#[test]
fn the_turntable_leaves_lights_and_cameras_alone() {
    let mut viewer = viewer();
    gesture(&mut viewer, Gesture::Dragged { drag: Drag::Turn, by: (40.0, 9.0), to: (0.0, 0.0) });
    let scene = viewer.document.scene();
    let others = scene.children(None).into_iter().filter(|id| !is_object(&viewer, *id));
    let moved = others.filter(|id| scene.placement(*id) != Some(catoptra_core::Placement::IDENTITY)).count();
    assert_eq!(moved, 0);
}

#[test]
fn a_dragged_ring_changes_the_angle_as_one_step() {
    let mut viewer = viewer();
    viewer.settings.style.cones = true;
    let overlay = viewer.overlay(&viewer.camera);
    let spots = (0..360).flat_map(|y| (0..640).map(move |x| (f64::from(x), f64::from(y))));
    let (grip, at) = spots.filter_map(|(x, y)| Some((overlay.grip_at(x, y)?, (x, y)))).next().unwrap();
    let light = |viewer: &Viewer| viewer.document.scene().light(grip.light).unwrap();
    let before = light(&viewer);
    for step in 1..10 {
        let to = (at.0 + f64::from(step), at.1 + f64::from(step));
        gesture(&mut viewer, Gesture::Dragged { drag: Drag::Hold(Hold::Grip(grip)), by: (1.0, 1.0), to });
    }
    gesture(&mut viewer, Gesture::Ended(Drag::Hold(Hold::Grip(grip))));
    assert!(light(&viewer) != before);
    assert_eq!(viewer.selection.ids(), [grip.light]);
    run(&mut viewer, Command::Undo);
    assert_eq!(light(&viewer), before);
}

/// A viewer of a panel of light in a turned and scaled group, over a floor.
fn lamp_viewer(folder: &Path) -> (Viewer, EntityId) {
    let path = folder.join("lamp.kdl");
    let text = "camera \"c\" { eye 0 2 8; target 0 2 0 }\n\
        matte \"grey\" { color 0.5 }\nplane \"floor\" material=\"grey\"\n\
        group \"g\" { turn 20 1 0.3 0; scale 1.5; move 0 1 0\n\
            rectangle-light \"lamp\" { corner -1 0 0; edge-u 2 0 0; edge-v 0 1 0; radiance 3 } }\n";
    std::fs::write(&path, text).unwrap();
    let document = crate::document::Document::open(&path).unwrap();
    let mut viewer = Viewer::new(loader::Opened::new(document, &Pool::new(1).unwrap()));
    viewer.size = (640, 360);
    let lamp = viewer.document.scene().entity_named("lamp").unwrap();
    (viewer, lamp)
}

#[test]
fn one_more_click_selects_the_group_outwards_and_then_the_thing_again() {
    let text = "matte \"m\" { color 1 }\ngroup \"outer\" {\n    group \"inner\" { sphere \"ball\" material=\"m\" { radius 1 } }\n}\n\
                sphere \"alone\" material=\"m\" { center 5 0 0; radius 1 }\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.kdl");
    std::fs::write(&path, text).unwrap();
    let pool = Pool::new(1).unwrap();
    let mut viewer = Viewer::new(Opened::new(Document::open(&path).unwrap(), &pool));
    let named = |viewer: &Viewer, name: &str| viewer.document.scene().entity_named(name);
    let ball = named(&viewer, "ball");
    for wanted in ["ball", "inner", "outer", "ball", "inner"] {
        viewer.click_on(ball, Picking::Only);
        assert_eq!(viewer.selection.active(), named(&viewer, wanted), "{wanted}");
    }
    let alone = named(&viewer, "alone");
    for _ in 0..2 {
        viewer.click_on(alone, Picking::Only);
        assert_eq!(viewer.selection.active(), alone);
    }
    viewer.click_on(ball, Picking::Only);
    assert_eq!(viewer.selection.active(), ball);
}

#[test]
fn a_lamp_is_selected_by_its_surface_and_dragged_by_a_side_as_one_step() {
    let folder = tempfile::tempdir().unwrap();
    let (mut viewer, lamp) = lamp_viewer(folder.path());
    let bounds = viewer.document.scene().world_bounds(lamp).unwrap();
    let seen = |viewer: &Viewer| {
        let view = catoptra_raster::Projection::new(&viewer.camera, 640, 360);
        view.project(bounds.centre()).unwrap()
    };
    // Aside of the mark in its middle.
    let (x, y) = (seen(&viewer).x + 30.0, seen(&viewer).y);
    gesture(&mut viewer, Gesture::Click { at: (x, y), picking: Picking::Only });
    assert_eq!(viewer.selection.ids(), [lamp]);
    let overlay = viewer.overlay(&viewer.camera);
    let right = (320..640).map(|x| (f64::from(x), y));
    let (grip, at) = right.filter_map(|(x, y)| Some((overlay.grip_at(x, y)?, (x, y)))).next().unwrap();
    let light = |viewer: &Viewer| viewer.document.scene().light(lamp).unwrap();
    let before = light(&viewer);
    for step in 4..20 {
        let to = (at.0 + f64::from(step), at.1);
        gesture(&mut viewer, Gesture::Dragged { drag: Drag::Hold(Hold::Grip(grip)), by: (1.0, 0.0), to });
    }
    gesture(&mut viewer, Gesture::Ended(Drag::Hold(Hold::Grip(grip))));
    let edge = |light: &catoptra_core::Light| light.values().get("edge-u").cloned();
    assert!(edge(&light(&viewer)) != edge(&before));
    let same = light(&viewer).with("edge-u", edge(&before).unwrap()).unwrap();
    assert_eq!(same, before, "nothing but the edge");
    run(&mut viewer, Command::Undo);
    assert_eq!(light(&viewer), before);
    assert!(viewer.document.is_saved());
}

#[test]
fn deleting_the_selected_thing_deselects_it_and_undo_brings_it_back() {
    let mut viewer = viewer();
    let floor = viewer.document.scene().entity_named("floor");
    viewer.select(floor);
    run(&mut viewer, Command::Delete);
    viewer.follow_scene();
    assert_eq!(viewer.document.scene().entity_named("floor"), None);
    assert!(viewer.selection.is_empty());
    run(&mut viewer, Command::Undo);
    assert_eq!(viewer.document.scene().entity_named("floor"), floor);
    assert_eq!(viewer.selection.active(), floor, "it is selected again");
    assert_eq!(viewer.notice.as_ref().unwrap().0, "undo: delete floor");
}

#[test]
fn the_next_camera_comes_round_to_the_first() {
    let mut viewer = viewer();
    let (camera, cameras) =
        (viewer.camera.clone(), viewer.document.scene().entities_of(Role::Camera).count());
    run(&mut viewer, Command::NextCamera);
    assert!(viewer.camera != camera);
    for _ in 1..cameras {
        run(&mut viewer, Command::NextCamera);
    }
    assert_eq!(viewer.camera, camera);
}

#[test]
fn the_wheel_keeps_the_view_and_comes_nearer() {
    for mode in Mode::ALL {
        let mut viewer = viewer();
        viewer.settings.mode = mode;
        viewer.pointer.at = (320.0, 180.0);
        let before = viewer.camera.clone();
        wheel(&mut viewer, 2.0, false);
        let way = viewer.camera.eye() - before.eye();
        assert!(way.dot(before.forward()) > 0.1, "{way}");
        assert!((viewer.camera.forward() - before.forward()).length() < 1e-12);
    }
}

#[test]
fn moving_the_camera_reuses_the_copy_of_the_scene_and_editing_does_not() {
    let mut viewer = viewer();
    let extraction = std::sync::Arc::clone(&viewer.extraction);
    run(&mut viewer, Command::Step(1, 0));
    viewer.follow_scene();
    assert!(std::sync::Arc::ptr_eq(&extraction, &viewer.extraction));
    gesture(&mut viewer, Gesture::Dragged { drag: Drag::Turn, by: (40.0, 9.0), to: (0.0, 0.0) });
    viewer.follow_scene();
    assert!(!std::sync::Arc::ptr_eq(&extraction, &viewer.extraction));
    assert_eq!(viewer.extraction.revision(), viewer.document.scene().revision());
}

#[test]
fn what_was_removed_is_not_selected_in_a_picture_that_still_shows_it() {
    let mut viewer = viewer();
    let shown = (0..640).map(|x| (f64::from(x), 350.0)).find(|&(x, y)| viewer.pick(x, y).is_some());
    let (x, y) = shown.unwrap();
    gesture(&mut viewer, Gesture::Click { at: (x, y), picking: Picking::Only });
    assert!(!viewer.selection.is_empty());
    run(&mut viewer, Command::Delete);
    viewer.follow_scene();
    gesture(&mut viewer, Gesture::Click { at: (x, y), picking: Picking::Only });
    assert!(viewer.selection.is_empty());
}

#[test]
fn a_field_of_view_that_is_changed_is_that_of_what_one_sees() {
    let mut viewer = viewer();
    let main = viewer.document.scene().main_camera().unwrap();
    gesture(&mut viewer, Gesture::Dragged { drag: Drag::Orbit, by: (80.0, 9.0), to: (0.0, 0.0) });
    let (eye, fov) = (viewer.camera.eye(), viewer.camera.fov());
    let camera = viewer.document.scene().camera(main).unwrap();
    let wider = camera.clone().with_extent(catoptra_core::Extent::Angle(fov + 0.2)).unwrap();
    viewer.edit(catoptra_core::Edit::Camera(main, wider));
    viewer.follow_scene();
    assert_eq!(viewer.camera.eye(), eye, "the view stays where one has gone");
    assert!((viewer.camera.fov() - fov - 0.2).abs() < 1e-12);
    let elsewhere = camera.placed(&catoptra_core::Placement::IDENTITY.moved(DVec3::X).unwrap()).unwrap();
    viewer.edit(catoptra_core::Edit::Camera(main, elsewhere.clone()));
    viewer.follow_scene();
    assert!((viewer.camera.eye() - elsewhere.eye()).length() < 1e-9, "a camera that is moved is followed");
}
