//! Does a block on one line stay on one line, and is the text to the byte what it was when an edit is undone?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use catoptra_core::Placement;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, Flags};
use catoptra_scene::parse;

const TEXT: &str = "matte \"m\" { color 0.5 }
sphere \"ball\" material=\"m\" { center 0 1 0; radius 1 } // round
plane \"floor\" material=\"m\"
group \"g\" { box \"block\" material=\"m\" { min 0 0 0; max 1 1 1 } }
point-light \"lamp\" { position 0 3 0; intensity 1; }
";

/// The text after an edit of one thing, and after taking it back.
fn there_and_back(name: &str, edit: impl Fn(catoptra_core::scene::EntityId) -> Edit) -> String {
    let (mut scene, mut file) = parse(TEXT, "test", None).unwrap();
    let inverse = scene.apply(edit(scene.entity_named(name).unwrap())).unwrap();
    file.update(&scene);
    let changed = file.text();
    let (again, _) = parse(&changed, "again", None).unwrap_or_else(|e| panic!("{e}: {changed}"));
    assert_eq!(
        again.placement(again.entity_named(name).unwrap()),
        scene.placement(scene.entity_named(name).unwrap())
    );
    scene.apply(inverse).unwrap();
    file.update(&scene);
    assert_eq!(file.text(), TEXT, "after {changed}");
    changed
}

#[test]
fn steps_come_and_go_on_the_line() {
    let moved = Placement::IDENTITY.moved(DVec3::new(1.0, 2.0, 3.0)).unwrap();
    let all = Placement::IDENTITY.scaled(2.0).unwrap().moved(DVec3::X).unwrap();
    for name in ["ball", "floor", "g", "block", "lamp"] {
        for placement in [moved, all] {
            there_and_back(name, |id| Edit::Placement(id, placement));
        }
        there_and_back(name, |id| Edit::Flags(id, Flags { hidden: true, locked: true }));
    }
    let changed = there_and_back("ball", |id| Edit::Placement(id, all));
    assert!(changed.contains("{ center 0 1 0; radius 1; scale 2; move 1 0 0 } // round"), "{changed}");
    let changed = there_and_back("g", |id| Edit::Placement(id, moved));
    assert!(changed.contains("group \"g\" { move 1 2 3; box \"block\""), "{changed}");
}

#[test]
fn another_kind_keeps_the_line() {
    let values = catoptra_core::Values::new()
        .with("min", catoptra_core::Value::Vector(DVec3::ZERO))
        .with("max", catoptra_core::Value::Vector(DVec3::ONE));
    let make = catoptra_core::Shape::kind_named("box").unwrap().make;
    let changed = there_and_back("ball", |id| Edit::Shape(id, make(&values).unwrap()));
    assert!(changed.contains("box \"ball\" material=\"m\" { min 0 0 0; max 1 1 1 } // round"), "{changed}");
}

#[test]
fn what_stands_first_or_alone_goes_with_what_sets_it_apart() {
    for (block, left) in [
        ("{ move 1 0 0 }", ""),
        ("{ move 1 0 0; hidden #true }", " { hidden #true }"),
        ("{ scale 2; turn 90 0 1 0; move 1 0 0 }", ""),
        ("{ hidden #true; scale 2; move 1 0 0 }", " { hidden #true }"),
        ("{\n    move 1 0 0\n}", ""),
        ("{\n    // a word\n    move 1 0 0\n}", " {\n    // a word\n}"),
    ] {
        let text = format!("matte \"m\" {{ color 0.5 }}\nplane \"floor\" material=\"m\" {block}\n");
        let (mut scene, mut file) = parse(&text, "test", None).unwrap();
        let floor = scene.entity_named("floor").unwrap();
        scene.apply(Edit::Placement(floor, Placement::IDENTITY)).unwrap();
        file.update(&scene);
        let expected = format!("matte \"m\" {{ color 0.5 }}\nplane \"floor\" material=\"m\"{left}\n");
        assert_eq!(file.text(), expected, "{block}");
    }
}
