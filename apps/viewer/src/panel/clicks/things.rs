//! Are things added, changed and put elsewhere by clicks and drags?

use super::*;
use crate::selection::Selection;

#[test]
fn a_shape_becomes_one_of_another_kind_as_one_step() {
    let mut bench = Bench::new("ball");
    let kind = |bench: &Bench| {
        let scene = bench.viewer.document.scene();
        scene.shape(scene.entity_named("ball").unwrap()).unwrap().kind_name()
    };
    bench.click("sphere");
    bench.click("disk");
    assert_eq!(kind(&bench), "disk");
    bench.undo();
    assert_eq!(kind(&bench), "sphere");
}

#[test]
fn something_is_added_from_the_list() {
    let mut bench = Bench::new("ball");
    bench.click("Add…");
    bench.click("box");
    let scene = bench.viewer.document.scene();
    assert_eq!(bench.viewer.selection.active(), scene.entity_named("box"));
    assert!(bench.viewer.adding.is_none() && !bench.viewer.document.is_saved());
}

#[test]
fn numbers_are_worked_out_and_given_up_by_escape() {
    let mut bench = Bench::new("small");
    let scale = |bench: &Bench| {
        let scene = bench.viewer.document.scene();
        scene.placement(scene.entity_named("small").unwrap()).unwrap().scale()
    };
    bench.type_over("0.375", "2/3", egui::Key::Escape);
    assert_eq!(scale(&bench), 0.375);
    assert!(bench.viewer.document.is_saved());
    bench.type_over("0.375", "1/4", egui::Key::Enter);
    assert_eq!(scale(&bench), 0.25);
    bench.undo();
    bench.type_over("0.375", "-3", egui::Key::Enter);
    assert_eq!(scale(&bench), 0.375, "what is refused changes nothing");
}

#[test]
fn rows_are_dragged_to_other_places_with_what_is_selected() {
    let mut bench = Bench::new("ball");
    let top = |bench: &Bench| -> Vec<String> {
        let scene = bench.viewer.document.scene();
        scene.children(None).into_iter().filter_map(|id| scene.name(id)).collect()
    };
    assert_eq!(top(&bench), ["ball", "old", "lens", "ring", "toy", "small"]);
    bench.drag("small", ("old", -8.0));
    assert_eq!(top(&bench), ["ball", "small", "old", "lens", "ring", "toy"]);
    bench.undo();
    let scene = bench.viewer.document.scene();
    let picked = ["toy", "ball"].map(|name| scene.entity_named(name).unwrap());
    bench.viewer.select_all(Selection::from_iter(picked));
    bench.drag("toy", ("lens", 8.0));
    assert_eq!(top(&bench), ["old", "lens", "ball", "toy", "ring", "small"]);
    bench.undo();
    bench.drag("toy", ("small", 60.0));
    assert_eq!(top(&bench).last().map(String::as_str), Some("toy"), "below all");
}
