//! Does saving say in `part` nodes what has become of the parts of a model, and take them back when it is undone?

use std::path::Path;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, EntityId, Node, Scene, Subtree};
use catoptra_core::{Placement, Value, Values};
use catoptra_scene::SceneFile;

use super::{check_saved, folder, read};

/// One triangle, in a group, beside it and in a group of that group, with places of their own.
fn lamp(folder: &Path) {
    let bytes: Vec<u8> =
        [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    std::fs::write(folder.join("lamp.bin"), bytes).unwrap();
    let text = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,3]}],
        "nodes":[{"name":"Arm","translation":[1,0,0],"children":[1,2]},{"name":"Shade","mesh":0,"translation":[0,2,0]},
        {"name":"Joint","children":[4]},{"name":"Foot","mesh":0},{"name":"Bulb","mesh":0,"translation":[0,0,1]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"materials":[{"name":"Paint"}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"lamp.bin"}]}"#;
    std::fs::write(folder.join("lamp.gltf"), text).unwrap();
}

const LAMP: &str = "matte \"m\" { color 0.5 }\nmodel \"lamp\" {\n    file \"lamp.gltf\" // of brass\n}\n";
const CHAIR: &str = "matte \"m\" { color 0.5 }\nmodel \"chair\" {\n    file \"chair.obj\" // of wood\n}\n";

fn id(scene: &Scene, name: &str) -> EntityId {
    scene.entity_named(name).unwrap_or_else(|| panic!("{name} is not there"))
}

fn at(x: f64, y: f64, z: f64) -> Placement {
    Placement::IDENTITY.moved(DVec3::new(x, y, z)).unwrap()
}

fn ball() -> catoptra_core::Shape {
    (catoptra_core::Shape::kind_named("sphere").unwrap().make)(
        &Values::new().with("radius", Value::Number(1.0)),
    )
    .unwrap()
}

type Change = fn(&Scene) -> Edit;

/// Edits, saves, undoes, saves: answers with the line that came, after checking that it is the only one and that it went.
fn line(text: &str, edit: Change) -> String {
    let folder = folder();
    lamp(folder.path());
    let (mut scene, mut file) = read(text, folder.path());
    let undo = scene.apply(edit(&scene)).unwrap();
    let saved = check_saved(&scene, &mut file, folder.path());
    assert_eq!(check_saved(&scene, &mut file, folder.path()), saved);
    let new: Vec<&str> = saved.lines().filter(|line| !text.lines().any(|old| old == *line)).collect();
    assert!(text.lines().all(|old| saved.lines().any(|line| line == old)), "{saved}");
    scene.apply(undo).unwrap();
    assert_eq!(check_saved(&scene, &mut file, folder.path()), text, "what was undone goes again");
    new.join("\n")
}

#[test]
fn a_changed_part_is_one_line() {
    let cases: [(&str, Change, &str); 9] = [
        (CHAIR, |s| Edit::Placement(id(s, "chair/Leg"), at(1.0, 0.0, 0.0)), "part \"Leg\" { move 1 0 0 }"),
        (
            CHAIR,
            |s| Edit::MaterialOf(id(s, "chair/Seat"), s.material_named("m").unwrap()),
            "part \"Seat\" material=\"m\"",
        ),
        (CHAIR, |s| Edit::Remove(id(s, "chair/Seat")), "part \"Seat\" { remove #true }"),
        (LAMP, |s| Edit::Placement(id(s, "lamp/Shade"), at(0.0, 3.0, 0.0)), "part \"Shade\" { move 0 3 0 }"),
        (LAMP, |s| Edit::Placement(id(s, "lamp/Shade"), at(0.0, 0.0, 0.0)), "part \"Shade\" { move 0 0 0 }"),
        (LAMP, |s| Edit::Placement(id(s, "lamp/Arm"), at(9.0, 0.0, 0.0)), "part \"Arm\" { move 9 0 0 }"),
        (LAMP, |s| Edit::Remove(id(s, "lamp/Arm")), "part \"Arm\" { remove #true }"),
        (
            LAMP,
            |s| Edit::MaterialOf(id(s, "lamp/Bulb"), s.material_named("m").unwrap()),
            "part \"Bulb\" material=\"m\"",
        ),
        (
            LAMP,
            |s| {
                Edit::Batch(vec![
                    Edit::Placement(id(s, "lamp/Foot"), at(0.0, 1.0, 0.0)),
                    Edit::MaterialOf(id(s, "lamp/Foot"), s.material_named("m").unwrap()),
                ])
            },
            "part \"Foot\" material=\"m\" { move 0 1 0 }",
        ),
    ];
    for (text, edit, expected) in cases {
        assert_eq!(line(text, edit), format!("    {expected}"));
    }
}

#[test]
fn a_guest_stands_in_the_node_of_its_group() {
    let expected = "    part \"Joint\" {\n        sphere \"cat\" material=\"m\" {\n            radius 1\n        }\n    }";
    let told = line(LAMP, |s| {
        let node = Node::shape("cat", ball(), s.material_named("m").unwrap());
        Edit::insert(Subtree::new(node).under(id(s, "lamp/Joint")))
    });
    assert_eq!(told, expected);
}

#[test]
fn nodes_of_people_are_changed_and_kept() {
    let folder = folder();
    lamp(folder.path());
    let text = "matte \"m\" { color 0.5 }\nmodel \"lamp\" file=\"lamp.gltf\" {\n    // higher\n    part \"Shade\" material=\"m\" {\n        \
        turn 90 0 1 0 // round\n        move 0 1 0 // up\n    }\n    part \"Foot\" { remove #true }\n    part \"Arm\" { sphere \"cat\" material=\"m\" { radius 1 } }\n}\n";
    let (mut scene, mut file) = read(text, folder.path());
    let shade = id(&scene, "lamp/Shade");
    let before = scene.placement(shade).unwrap();
    let mut after = |scene: &mut Scene, edit: Edit| {
        scene.apply(edit).unwrap();
        check_saved(scene, &mut file, folder.path())
    };
    let moved = before.moved(DVec3::Y).unwrap();
    assert_eq!(after(&mut scene, Edit::Placement(shade, moved)), text.replace("move 0 1 0", "move 0 2 0"));
    assert_eq!(after(&mut scene, Edit::Placement(shade, before)), text);
    // As the file has it: no steps, but the node and its comment stay.
    let plain = text.replace("        turn 90 0 1 0 // round\n        move 0 1 0 // up\n", "");
    assert_eq!(after(&mut scene, Edit::Placement(shade, at(0.0, 2.0, 0.0))), plain);
    let paint = scene.material_named("lamp/Paint").unwrap();
    assert_eq!(
        after(&mut scene, Edit::MaterialOf(shade, paint)),
        plain.replace("\"Shade\" material=\"m\"", "\"Shade\"")
    );
    let m = scene.material_named("m").unwrap();
    assert_eq!(after(&mut scene, Edit::MaterialOf(shade, m)), plain);
    let renamed = plain.replace("\"m\"", "\"tin\"");
    assert_eq!(after(&mut scene, Edit::RenameMaterial(m, "tin".into())), renamed);
    let gone = after(&mut scene, Edit::Remove(shade));
    assert!(
        gone.contains("part \"Shade\" {\n        remove #true\n    }") && gone.contains("// higher"),
        "{gone}"
    );
    let cat = id(&scene, "cat");
    let free = after(&mut scene, Edit::Parent(cat, None));
    assert!(free.contains("part \"Arm\" {") && free.contains("\nsphere \"cat\""), "{free}");
}

#[test]
fn a_part_comes_and_goes_while_it_is_saved() {
    let folder = folder();
    let (mut scene, mut file) = read(CHAIR, folder.path());
    let mut undos = Vec::new();
    let edits: [Change; 4] = [
        |s| Edit::Placement(id(s, "chair/Leg"), at(1.0, 0.0, 0.0)),
        |s| Edit::MaterialOf(id(s, "chair/Leg"), s.material_named("chair/Wood").unwrap()),
        |s| Edit::Placement(id(s, "chair/Leg"), at(0.0, 0.0, 0.0).scaled(2.0).unwrap()),
        |s| Edit::Remove(id(s, "chair/Leg")),
    ];
    let mut texts = vec![CHAIR.to_owned()];
    for edit in edits {
        undos.push(scene.apply(edit(&scene)).unwrap());
        texts.push(check_saved(&scene, &mut file, folder.path()));
    }
    assert!(texts[3].contains("part \"Leg\" material=\"chair/Wood\" { scale 2 }"), "{}", texts[3]);
    for (undo, _) in undos.into_iter().rev().zip(&texts) {
        scene.apply(undo).unwrap();
        check_saved(&scene, &mut file, folder.path());
    }
    assert_eq!(file.text(), CHAIR);
}

#[test]
fn what_part_nodes_cannot_say_is_written_out() {
    let edits: [Change; 5] = [
        |s| Edit::Name(id(s, "lamp/Shade"), "hat".into()),
        |s| Edit::Parent(id(s, "lamp/Shade"), None),
        |s| Edit::Order(id(s, "lamp/Foot"), 0),
        |s| Edit::Shape(id(s, "lamp/Foot"), ball()),
        |s| Edit::RenameMaterial(s.material_named("lamp/Paint").unwrap(), "paint".into()),
    ];
    for (i, edit) in edits.into_iter().enumerate() {
        let folder = folder();
        lamp(folder.path());
        let (mut scene, mut file) = read(LAMP, folder.path());
        let undo = scene.apply(edit(&scene)).unwrap();
        let text = check_saved(&scene, &mut file, folder.path());
        assert!(text.contains("group \"lamp\"") && text.contains("// of brass\n"), "{i}: {text}");
        scene.apply(undo).unwrap();
        check_saved(&scene, &mut file, folder.path());
    }
}

#[test]
fn a_model_of_one_word_gets_a_block() {
    let folder = folder();
    let text = "model \"chair\" file=\"chair.obj\"\n";
    let (mut scene, mut file): (Scene, SceneFile) = read(text, folder.path());
    scene.apply(Edit::Remove(id(&scene, "chair/Leg"))).unwrap();
    let saved = check_saved(&scene, &mut file, folder.path());
    assert_eq!(saved, "model \"chair\" file=\"chair.obj\" {\n    part \"Leg\" { remove #true }\n}\n");
}
