//! Are repeats read as copies, told of where they are wrong, and saved without loss?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;
use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, EntityId, Node, Scene, Subtree};
use catoptra_core::{Placement, Shape};
use catoptra_scene::{SceneFile, parse};

const TEXT: &str = "matte \"m\" { color 0.5 }\n// A row.\nrepeat \"posts\" count=4 {\n    step { move 2 0 0; turn 90 0 1 0 } // a step\n    move 0 1 0\n    \
    // One post.\n    sphere \"ball\" material=\"m\" { radius 0.5 }\n    group \"foot\" { box \"block\" material=\"m\" { min 0 0 0; max 1 1 1 } }\n}\n\
    camera \"eye\" { eye 0 0 9; target 0 0 0 }\n";

fn read(text: &str, folder: Option<&Path>) -> (Scene, SceneFile) {
    parse(text, "test.kdl", folder).unwrap_or_else(|e| panic!("{:?}\n{text}", miette::Report::new(e)))
}

fn refused(inside: &str) -> String {
    let text = format!("matte \"m\" {{ color 0.5 }}\n{inside}");
    let Err(error) = parse(&text, "test.kdl", None) else { panic!("was read: {text}") };
    let told = error.complaints().iter().map(|c| format!("{c} ({})\n", c.hint().unwrap_or_default()));
    told.collect()
}

fn id(scene: &Scene, name: &str) -> EntityId {
    scene.entity_named(name).unwrap_or_else(|| panic!("{name} is not there"))
}

/// Everything in a scene by name, in order, where it stands to within rounding: not every turn is spelled exactly.
fn told(scene: &Scene) -> Vec<String> {
    let things = scene.walk().into_iter().map(|id| {
        let material = scene.material_of(id).map(|m| scene.material_name(m).to_owned());
        let parent = scene.parent(id).and_then(|p| scene.name(p));
        let shape = scene.shape(id).map(|shape| shape.values());
        let at = scene.placement(id).unwrap();
        let tips = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| (at.point(p) * 1e9).round() + DVec3::ZERO);
        format!("{:?} in {parent:?} {tips:?} {material:?} {shape:?}", scene.name(id))
    });
    let mut all: Vec<String> = scene.materials().map(|(_, name, m)| format!("{name} {m:?}")).collect();
    all.sort();
    all.extend(things);
    all
}

fn saved(scene: &Scene, file: &mut SceneFile, folder: Option<&Path>) -> String {
    file.update(scene);
    let text = file.text();
    assert_eq!(told(&read(&text, folder).0), told(scene), "{text}");
    file.update(scene);
    assert_eq!(file.text(), text);
    text
}

#[test]
fn a_repeat_is_a_group_of_copies_a_step_apart() {
    let (scene, _) = read(TEXT, None);
    let root = id(&scene, "posts");
    let names: Vec<_> = scene.children(Some(root)).into_iter().filter_map(|id| scene.name(id)).collect();
    assert_eq!(names, ["posts/1", "posts/2", "posts/3", "posts/4"]);
    assert_eq!(scene.parent(id(&scene, "posts/3/block")), Some(id(&scene, "posts/3/foot")));
    // By hand: each time 2 m along x and then a quarter turn to the right hand, which takes x to −z; all 1 m up.
    let expected =
        [DVec3::Y, DVec3::new(0.0, 1.0, -2.0), DVec3::new(-2.0, 1.0, -2.0), DVec3::new(-2.0, 1.0, 0.0)];
    for (number, expected) in (1..).zip(expected) {
        let bounds = scene.world_bounds(id(&scene, &format!("posts/{number}/ball"))).unwrap();
        let center = bounds.min.midpoint(bounds.max);
        assert!((center - expected).length() < 1e-12, "{number}: {center}");
    }
}

#[test]
fn repeats_stand_in_repeats_and_groups() {
    let text = "matte \"m\" { color 0.5 }\ngroup \"house\" {\n repeat \"wall\" count=2 {\n  step { move 0 1 0 }\n  \
        repeat \"row\" count=3 { step { move 1 0 0 }; sphere \"brick\" material=\"m\" { radius 0.1 } }\n }\n}\n\
        repeat \"fence\" { count 2; step { scale 0.5 }; sphere \"brick\" material=\"m\" { radius 1 } }";
    let (scene, mut file) = read(text, None);
    let bounds = scene.world_bounds(id(&scene, "wall/2/row/3/brick")).unwrap();
    assert!((bounds.min - DVec3::new(1.9, 0.9, -0.1)).length() < 1e-12);
    let small = scene.world_bounds(id(&scene, "fence/2/brick")).unwrap();
    assert!((small.max - DVec3::splat(0.5)).length() < 1e-12);
    assert_eq!(saved(&scene, &mut file, None), text);
}

#[test]
fn meshes_in_a_repeat_are_stored_once() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\no Leg\nf 1 2 3\n").unwrap();
    let text = "matte \"m\" { color 0.5 }\nrepeat \"row\" count=3 {\n step { move 1 0 0 }\n mesh \"x\" material=\"m\" { file \"a.obj\" }\n \
        model \"chair\" { file \"a.obj\"; part \"Leg\" material=\"m\" { move 0 0 1 }; sphere \"cat\" material=\"m\" { radius 0.1 } }\n}";
    let (mut scene, mut file) = read(text, Some(folder.path()));
    let mesh = |name: &str| match scene.shape(id(&scene, name)) {
        Some(Shape::Mesh(mesh)) => Arc::clone(&mesh.source().mesh),
        _ => panic!("{name} is no mesh"),
    };
    assert!(Arc::ptr_eq(&mesh("row/1/x"), &mesh("row/3/x")));
    assert!(Arc::ptr_eq(&mesh("row/1/chair/Leg"), &mesh("row/2/chair/Leg")));
    let leg = scene.world_bounds(id(&scene, "row/3/chair/Leg")).unwrap();
    assert!((leg.max - DVec3::new(3.0, 1.0, 1.0)).length() < 1e-6, "{leg:?}");
    assert!(scene.entity_named("row/2/cat").is_some());
    assert_eq!(saved(&scene, &mut file, Some(folder.path())), text);
    let material = scene.material_named("m").unwrap();
    scene.apply(Edit::RenameMaterial(material, "grey".into())).unwrap();
    assert_eq!(saved(&scene, &mut file, Some(folder.path())), text.replace("\"m\"", "\"grey\""));
    scene.apply(Edit::Remove(id(&scene, "row/2/chair/Leg"))).unwrap();
    let text = saved(&scene, &mut file, Some(folder.path()));
    assert!(text.contains("a.obj#Leg") && text.contains("matte \"chair/grey\""), "{text}");
}

#[test]
fn what_stands_outside_is_edited_without_the_repeat() {
    let (mut scene, mut file) = read(TEXT, None);
    let root = id(&scene, "posts");
    let up = scene.placement(root).unwrap().moved(DVec3::new(0.0, 0.5, 0.0)).unwrap();
    scene.apply(Edit::Placement(root, up)).unwrap();
    let m = scene.material_named("m").unwrap();
    scene.apply(Edit::RenameMaterial(m, "steel".into())).unwrap();
    scene.add_group("new", None).unwrap();
    let text = saved(&scene, &mut file, None);
    let expected = TEXT.replace("move 0 1 0", "move 0 1.5 0").replace("\"m\"", "\"steel\"");
    assert_eq!(text, format!("{expected}group \"new\"\n"));
}

#[test]
fn a_changed_copy_is_written_out_with_all_others() {
    type Change = fn(&Scene) -> Edit;
    let edits: [Change; 7] = [
        |s| Edit::Placement(id(s, "posts/2"), Placement::IDENTITY),
        |s| Edit::Remove(id(s, "posts/3/ball")),
        |s| Edit::Remove(id(s, "posts/3")),
        |s| Edit::Name(id(s, "posts/3"), "third".into()),
        |s| Edit::Name(id(s, "posts"), "columns".into()),
        |s| Edit::Parent(id(s, "posts/4/ball"), None),
        |s| Edit::insert(Subtree::new(Node::group("guest", Vec::new())).under(id(s, "posts/1"))),
    ];
    for (i, edit) in edits.into_iter().enumerate() {
        let (mut scene, mut file) = read(TEXT, None);
        let undo = scene.apply(edit(&scene)).unwrap();
        let text = saved(&scene, &mut file, None);
        assert!(!text.contains("repeat") && text.contains("group \"posts/1\""), "{i}: {text}");
        for comment in ["// A row.\n", "// a step\n", "// One post.\n"] {
            assert!(text.contains(comment), "{i}: {text}");
        }
        assert!(text.find("// a step") < text.find("\"posts/1\""), "{i}: {text}");
        scene.apply(undo).unwrap();
        saved(&scene, &mut file, None);
    }
}

#[test]
fn an_edit_that_is_undone_before_saving_changes_no_byte() {
    let (mut scene, mut file) = read(TEXT, None);
    let undo = scene.apply(Edit::Remove(id(&scene, "posts/3"))).unwrap();
    scene.apply(undo).unwrap();
    assert_eq!(saved(&scene, &mut file, None), TEXT);
    scene.apply(Edit::Remove(id(&scene, "posts"))).unwrap();
    let text = saved(&scene, &mut file, None);
    assert!(!text.contains("posts") && text.contains("// A row."), "{text}");
}

#[test]
fn names_in_a_repeat_are_its_own() {
    let text = TEXT.replace("camera", "sphere \"ball\" material=\"m\" { radius 1 }\ncamera");
    let (scene, mut file) = read(&text, None);
    assert_eq!(saved(&scene, &mut file, None), text);
    let message = refused("repeat \"r\" count=2 { step { move 1 0 0 }; group \"a\"; group \"a\" }");
    assert!(message.contains("\"a\" is taken"), "{message}");
}

#[test]
fn what_is_wrong_is_told_once() {
    let ball = "sphere \"b\" material=\"m\" { radius 1 }";
    for (repeat, told) in [
        (format!("repeat \"r\" {{ step {{ move 1 0 0 }}; {ball} }}"), "needs a count"),
        (format!("repeat \"r\" count=3 {{ {ball} }}"), "needs a step"),
        (format!("repeat \"r\" count=3 {{ step; {ball} }}"), "leads nowhere"),
        (format!("repeat \"r\" count=3 {{ step {{ mve 1 0 0 }}; {ball} }}"), "no \"mve\""),
        (format!("repeat \"r\" count=3 {{ step 1 0 0; {ball} }}"), "a step has a block"),
        (format!("repeat \"r\" count=3 {{ step {{ move 1 0 }}; {ball} }}"), "three numbers"),
        (format!("repeat \"r\" count=0 {{ step {{ move 1 0 0 }}; {ball} }}"), "must be 1 to 100000, not 0"),
        (format!("repeat \"r\" count=2.5 {{ step {{ move 1 0 0 }}; {ball} }}"), "one whole number"),
        (format!("repeat \"r\" count=1e30 {{ step {{ move 1 0 0 }}; {ball} }}"), "must be 1 to 100000"),
        (format!("repeat \"r\" count=2 {{ count 2; step {{ move 1 0 0 }}; {ball} }}"), "given twice"),
        (format!("repeat \"r\" count=2 {{ stp {{ move 1 0 0 }}; {ball} }}"), "did you mean \"step\"?"),
        (format!("repat \"r\" count=2 {{ step {{ move 1 0 0 }}; {ball} }}"), "did you mean \"repeat\"?"),
        (format!("repeat \"r\" count=2000 {{ step {{ scale 9 }}; {ball} }}"), "numbers end at copy"),
        (
            "repeat \"r\" count=2 { step { move 1 0 0 }; sphere \"b\" material=\"n\" { radius 1 } }".into(),
            "no material \"n\"",
        ),
        (
            "repeat \"r\" count=2 { step { move 1 0 0 }; matte \"b\" { color 1 } }".into(),
            "cannot stand in a group",
        ),
    ] {
        let message = refused(&repeat);
        assert!(message.contains(told), "{repeat}: {message}");
        assert_eq!(message.lines().count(), 1, "{repeat}: {message}");
    }
}

#[test]
fn counts_are_bounded_together() {
    let nested = |count: u32| {
        format!(
            "repeat \"a\" count={count} {{ step {{ move 1 0 0 }}; repeat \"b\" count={count} {{ step {{ move 0 1 0 }}; \
             repeat \"c\" count={count} {{ step {{ move 0 0 1 }}; group \"x\" }} }} }}"
        )
    };
    let message = refused(&nested(100_000));
    assert!(message.contains("more than 200000") && message.contains("smaller count"), "{message}");
    assert!(refused(&nested(60)).contains("more than 200000"));
    let (scene, _) = read(&nested(20), None);
    assert_eq!(scene.entities().count(), 1 + 20 * (1 + 1 + 20 * (1 + 1 + 20 * 2)));
}
