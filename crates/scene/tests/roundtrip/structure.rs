//! Do names, kinds, members and their order follow, with the comments that belong to them?

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, History, Node, Subtree};
use catoptra_core::{Light, Material, Value, Values};

use super::{difference, edited, id, make_shape};

#[test]
fn names_and_references_follow() {
    let text = edited(|scene| {
        let red = scene.material_named("red").unwrap();
        scene.apply(Edit::RenameMaterial(red, "a \"deep\" red".into())).unwrap();
        scene.apply(Edit::Name(id(scene, "right"), "rightmost".into())).unwrap();
        scene.apply(Edit::MaterialOf(id(scene, "left"), red)).unwrap();
    });
    assert_eq!(
        difference(&text).0,
        [
            r#"phong "a \"deep\" red" {"#,
            r#"sphere "left" material="a \"deep\" red" { center -1 0.50 0; radius 5e-1 }"#,
            r#"sphere "rightmost" material="a \"deep\" red" {"#,
        ]
    );
}

#[test]
fn names_can_be_swapped() {
    edited(|scene| {
        let (left, right) = (id(scene, "left"), id(scene, "right"));
        scene.apply(Edit::Name(left, "x".into())).unwrap();
        scene.apply(Edit::Name(right, "left".into())).unwrap();
        scene.apply(Edit::Name(left, "right".into())).unwrap();
    });
}

#[test]
fn what_is_removed_goes_with_its_lines_and_nothing_else() {
    let text = edited(|scene| {
        scene.apply(Edit::Remove(id(scene, "right"))).unwrap();
        scene.apply(Edit::Remove(id(scene, "floor"))).unwrap();
    });
    let (new, old) = difference(&text);
    assert_eq!(new, Vec::<&str>::new());
    assert_eq!(old.len(), 5, "{old:?}");
    assert!(text.contains("// the other one"));
}

#[test]
fn what_was_saved_and_is_undone_leaves_no_trace() {
    let (mut scene, mut file) = super::start();
    let mut history = History::new();
    let (lamp, red) = (id(&scene, "lamp"), scene.material_named("red").unwrap());
    let (light, material) = (scene.light(lamp).unwrap(), scene.material(red).clone());
    for edit in [
        Edit::Remove(id(&scene, "right")),
        // A field that is not written, as it has the usual value.
        Edit::Material(red, material.with("reflectiveness", Value::Number(0.5)).unwrap()),
        Edit::Light(lamp, light.with("outer", Value::Number(1.0)).unwrap()),
    ] {
        history.apply(&mut scene, edit).unwrap();
        file.update(&scene);
        assert_ne!(file.text(), super::TEXT);
        history.undo(&mut scene);
        file.update(&scene);
        assert_eq!(file.text(), super::TEXT);
    }
}

#[test]
fn a_removed_name_can_be_used_again() {
    edited(|scene| {
        scene.apply(Edit::Remove(id(scene, "balls"))).unwrap();
        let white = scene.material_named("white").unwrap();
        let sphere = make_shape("sphere", &Values::new().with("radius", Value::Number(2.0)));
        scene.add_shape("balls", sphere, white, None).unwrap();
    });
}

#[test]
fn new_things_are_written_where_they_belong() {
    let text = edited(|scene| {
        let mirror = (Material::kind_named("mirror").unwrap().make)(&Values::new()).unwrap();
        let mirror = scene.add_material("silver", mirror).unwrap();
        let sphere = make_shape("sphere", &Values::new().with("radius", Value::Number(0.1)));
        let group = scene.add_group("inner", Some(id(scene, "balls"))).unwrap();
        scene.add_shape("tiny", sphere.clone(), mirror, Some(group)).unwrap();
        scene.add_shape("last", sphere.clone(), mirror, None).unwrap();
        let node = Node::shape("first", sphere, mirror);
        scene.apply(Edit::insert(Subtree { node, parent: None, index: Some(0) })).unwrap();
    });
    let (new, old) = difference(&text);
    assert_eq!(old, Vec::<&str>::new(), "{text}");
    assert_eq!(new.iter().filter(|line| **line == "radius 0.1").count(), 3);
    assert!(text.contains("mirror \"silver\"\n\ngroup") || text.contains("mirror \"silver\"\n"), "{text}");
    assert!(text.find("\"first\"") < text.find("\"balls\""));
}

#[test]
fn a_kind_can_change() {
    let text = edited(|scene| {
        let values =
            Values::new().with("min", Value::Vector(DVec3::ZERO)).with("max", Value::Vector(DVec3::ONE));
        scene.apply(Edit::Shape(id(scene, "right"), make_shape("box", &values))).unwrap();
        let lamp = id(scene, "lamp");
        let values = scene.light(lamp).unwrap().values();
        let values = values.iter().filter(|(name, _)| ["position", "intensity", "shadow"].contains(name));
        let values = values.fold(Values::new(), |all, (name, value)| all.with(name, value.clone()));
        let light = (Light::kind_named("point-light").unwrap().make)(&values).unwrap();
        scene.apply(Edit::Light(lamp, light)).unwrap();
    });
    assert!(text.contains("box \"right\" material=\"red\" {"), "{text}");
    assert!(text.contains("point-light \"lamp\" shadow=#false {"), "{text}");
}

#[test]
fn members_change_groups_and_take_their_comments_along() {
    let text = edited(|scene| {
        scene.apply(Edit::Parent(id(scene, "right"), None)).unwrap();
        scene.apply(Edit::Parent(id(scene, "floor"), Some(id(scene, "balls")))).unwrap();
    });
    assert!(text.contains("5e-1 }\n    plane \"floor\" material=\"white\"\n"), "{text}");
    assert!(
        text.contains(
            "\nsphere \"right\" material=\"red\" {\n    center +1 0.5 0\n    radius 0.5 // same\n}\n"
        ),
        "{text}"
    );
}

#[test]
fn a_member_outlives_its_group() {
    let text = edited(|scene| {
        scene.apply(Edit::Parent(id(scene, "left"), None)).unwrap();
        scene.apply(Edit::Remove(id(scene, "balls"))).unwrap();
    });
    assert!(text.contains("center -1 0.50 0; radius 5e-1"), "{text}");
}

#[test]
fn groups_change_places_inside_each_other() {
    edited(|scene| {
        let outer = id(scene, "balls");
        let inner = scene.add_group("inner", Some(outer)).unwrap();
        scene.apply(Edit::Parent(id(scene, "left"), Some(inner))).unwrap();
        scene.apply(Edit::Parent(inner, None)).unwrap();
        scene.apply(Edit::Parent(outer, Some(inner))).unwrap();
        scene.apply(Edit::Order(inner, 0)).unwrap();
    });
}

#[test]
fn the_order_of_siblings_follows() {
    let text = edited(|scene| {
        scene.apply(Edit::Order(id(scene, "main"), 0)).unwrap();
        scene.apply(Edit::Order(id(scene, "right"), 0)).unwrap();
    });
    assert!(text.find("camera") < text.find("group"), "{text}");
    assert!(text.ends_with("// the end\n"));
}
