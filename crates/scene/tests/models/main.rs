//! Are models that a scene names, or that are given as scenes, read, changed by the text and saved without loss?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Content, Edit, Node, Role, Scene, Subtree};
use catoptra_core::{Placement, Shape};
use catoptra_scene::SceneFile;

mod parts;

/// Two triangles of two materials; the second stands 2 m beside the first.
const OBJ: &str = "mtllib chair.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 2 1 0\n\
    o Leg\nusemtl Steel\nf 1 2 3\no Seat\nusemtl Wood\nf 4 5 6\n";
const MTL: &str = "newmtl Steel\nKd 0.1 0.2 0.3\nnewmtl Wood\nKd 0.4 0.3 0.2\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("chair.obj"), OBJ).unwrap();
    std::fs::write(folder.path().join("chair.mtl"), MTL).unwrap();
    folder
}

fn read(text: &str, folder: &Path) -> (Scene, SceneFile) {
    match catoptra_scene::parse(text, "test.kdl", Some(folder)) {
        Ok(read) => read,
        Err(error) => panic!("{:?}", error.complaints().iter().map(ToString::to_string).collect::<Vec<_>>()),
    }
}

fn refused(text: &str, folder: &Path) -> String {
    let Err(error) = catoptra_scene::parse(text, "test.kdl", Some(folder)) else {
        panic!("was read: {text}")
    };
    error.complaints().iter().map(|c| format!("{c} ({})\n", c.hint().unwrap_or_default())).collect()
}

fn worn(scene: &Scene, shape: &str) -> String {
    let id = scene.entity_named(shape).and_then(|id| scene.material_of(id));
    id.map_or_else(String::new, |id| scene.material_name(id).to_owned())
}

/// Everything in a scene by name and without ids, in order.
fn told(scene: &Scene) -> Vec<String> {
    let looks = scene
        .materials()
        .map(|(id, name, m)| format!("{name} {:?} {:?}", m.kind_name(), (m.values(), scene.finish(id))));
    let things = scene.walk().into_iter().map(|id| {
        let parent = scene.parent(id).and_then(|p| scene.name(p));
        let shape = scene.shape(id).map(|s| s.values());
        let (name, placement) = (scene.name(id).unwrap(), scene.placement(id).unwrap());
        format!("{name} in {parent:?} {placement:?} {} {shape:?} {:?}", worn(scene, &name), scene.light(id))
    });
    let mut looks: Vec<String> = looks.collect();
    looks.sort();
    looks.into_iter().chain(things).collect()
}

/// Saves and loads again: the scene must be the same.
fn check_saved(scene: &Scene, file: &mut SceneFile, folder: &Path) -> String {
    file.update(scene);
    let text = file.text();
    let (again, _) = read(&text, folder);
    assert_eq!(told(&again), told(scene), "{text}");
    text
}

#[test]
fn a_model_is_a_group_of_what_its_file_holds() {
    let folder = folder();
    let (scene, _) = read("model \"chair\" { file \"chair.obj\"; scale 0.5; move 0 1 0 }", folder.path());
    let root = scene.entity_named("chair").unwrap();
    assert_eq!(scene.role(root), Some(Role::Group));
    let names: Vec<_> = scene.children(Some(root)).into_iter().filter_map(|id| scene.name(id)).collect();
    assert_eq!(names, ["chair/Leg", "chair/Seat"]);
    assert_eq!(
        (worn(&scene, "chair/Leg"), worn(&scene, "chair/Seat")),
        ("chair/Steel".into(), "chair/Wood".into())
    );
    let bounds = scene.world_bounds(root).unwrap();
    assert!((bounds.max - DVec3::new(1.5, 1.5, 0.0)).length() < 1e-6, "{bounds:?}");
}

#[test]
fn text_overrides_parts_and_materials() {
    let folder = folder();
    let text = "matte \"chair/Wood\" { color 1 0 0 }\nmirror \"chrome\"\n\
        model \"chair\" {\n file \"chair.obj\"\n part \"Leg\" material=\"chrome\" { move 0 0 7 }\n sphere \"ball\" material=\"chair/Steel\" { radius 1 }\n}\n\
        model \"stool\" { file \"chair.obj\"; part \"Seat\" { remove #true } }\n";
    let (scene, mut file) = read(text, folder.path());
    assert_eq!((worn(&scene, "chair/Leg"), worn(&scene, "ball")), ("chrome".into(), "chair/Steel".into()));
    let leg = scene.entity_named("chair/Leg").unwrap();
    assert_eq!(scene.placement(leg).unwrap().translation(), DVec3::new(0.0, 0.0, 7.0));
    assert_eq!(scene.entity_named("stool/Seat"), None);
    assert!(scene.entity_named("stool/Leg").is_some());
    assert_eq!(scene.materials().count(), 5, "chair/Wood once");
    assert_eq!(check_saved(&scene, &mut file, folder.path()), text);
}

#[test]
fn a_part_of_a_file_is_a_mesh() {
    let folder = folder();
    let (scene, _) = read(
        "matte \"m\" { color 0.5 }\nmesh \"leg\" material=\"m\" { file \"chair.obj#Leg\" }\nmesh \"all\" material=\"m\" { file \"chair.obj\" }",
        folder.path(),
    );
    let triangles = |name: &str| match scene.entity_named(name).and_then(|id| scene.shape(id)) {
        Some(Shape::Mesh(mesh)) => mesh.source().mesh.triangles().len(),
        _ => 0,
    };
    assert_eq!((triangles("leg"), triangles("all")), (1, 2));
    let message = refused(
        "matte \"m\" { color 0.5 }\nmesh \"leg\" material=\"m\" { file \"chair.obj#Log\" }",
        folder.path(),
    );
    assert!(message.contains("holds no mesh \"Log\"") && message.contains("\"Leg\""), "{message}");
}

#[test]
fn what_is_wrong_is_told() {
    let folder = folder();
    for (inside, told) in [
        ("part \"Log\" { remove #true }", "did you mean \"Leg\"?"),
        ("part \"Leg\" material=\"chair/Stel\"", "did you mean \"chair/Steel\"?"),
        ("part \"Leg\" { remove #true; move 1 0 0 }", "removed and changed"),
        ("part \"Leg\" { remove #true }; part \"Leg\" { move 1 0 0 }", "given twice"),
        ("part \"Leg\" { matte \"x\" }", "cannot stand in a group"),
        ("part \"Leg\" { camera \"x\" { eye 0 0 1; target 0 0 0 } }", "cannot have members"),
        ("part \"Leg\" { remove 1 }", "#true or #false"),
        ("colour 1", "colour"),
    ] {
        let message = refused(&format!("model \"chair\" {{ file \"chair.obj\"; {inside} }}"), folder.path());
        assert!(message.contains(told), "{inside}: {message}");
    }
    assert!(refused("model \"chair\"", folder.path()).contains("needs a file"));
    assert!(refused("part \"x\"", folder.path()).contains("stands in a model"));
    assert!(refused("model \"chair\" { file \"none.obj\" }", folder.path()).contains("none.obj"));
}

/// A scene text, one edit, and whether the model's node stays.
#[test]
fn nothing_is_lost_or_doubled_by_saving() {
    let folder = folder();
    let text = "camera \"eye\" { eye 0 0 9; target 0 0 0 }\nmatte \"m\" { color 0.5 }\nmodel \"chair\" {\n    file \"chair.obj\"\n}\n\
        sphere \"ball\" material=\"m\" { radius 1 }\n";
    let moved = Placement::IDENTITY.moved(DVec3::X).unwrap();
    type Change = fn(&Scene, Placement) -> Edit;
    let edits: [(Change, bool); 9] = [
        (|s, p| Edit::Placement(s.entity_named("chair").unwrap(), p), true),
        (|s, p| Edit::Placement(s.entity_named("chair/Leg").unwrap(), p), true),
        (|s, _| Edit::Remove(s.entity_named("chair/Leg").unwrap()), true),
        (|s, _| Edit::Remove(s.entity_named("chair").unwrap()), false),
        (|s, _| Edit::MaterialOf(s.entity_named("chair/Leg").unwrap(), s.material_named("m").unwrap()), true),
        (|s, _| Edit::Name(s.entity_named("chair").unwrap(), "sofa".into()), false),
        (
            |s, _| {
                Edit::MaterialOf(s.entity_named("ball").unwrap(), s.material_named("chair/Steel").unwrap())
            },
            true,
        ),
        (
            |s, _| {
                let m = s.material_named("m").unwrap();
                let node =
                    Node::new("new", Content::Shape(s.shape(s.entity_named("ball").unwrap()).unwrap(), m));
                Edit::insert(Subtree::new(node).under(s.entity_named("chair").unwrap()))
            },
            true,
        ),
        (
            |s, _| {
                let other = s.material(s.material_named("m").unwrap()).clone();
                Edit::Material(s.material_named("chair/Steel").unwrap(), other)
            },
            true,
        ),
    ];
    for (i, (edit, stays)) in edits.into_iter().enumerate() {
        let (mut scene, mut file) = read(text, folder.path());
        let undo = scene.apply(edit(&scene, moved)).unwrap();
        let saved = check_saved(&scene, &mut file, folder.path());
        assert_eq!(saved.contains("model \"chair\""), stays, "{i}: {saved}");
        scene.apply(undo).unwrap();
        check_saved(&scene, &mut file, folder.path());
    }
}

#[test]
fn a_model_is_a_scene_with_view_and_light() {
    let folder = folder();
    for (name, obj) in [
        ("wide.obj", "v 0 0 0\nv 9 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("high.obj", "v 0 0 0\nv 1 0 0\nv 0 9 0\nf 1 2 3\n"),
        ("tiny.obj", "v 0 0 0\nv 1e-6 0 0\nv 0 1e-6 0\nf 1 2 3\n"),
        ("far.obj", "v 1000000 0 0\nv 1000001 0 0\nv 1000000 1 0\nf 1 2 3\n"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, obj).unwrap();
        let (scene, file) = catoptra_scene::load(&path).unwrap();
        assert_eq!(file.path(), None);
        assert!(file.added().unwrap().contains("has no lights and no camera"), "{:?}", file.added());
        let camera = scene.world_camera(scene.main_camera().unwrap()).unwrap();
        let root = scene.entity_named(name.trim_end_matches(".obj")).unwrap();
        let bounds = scene.world_bounds(root).unwrap();
        let axis = camera.forward();
        for corner in
            [bounds.min, bounds.max, bounds.min.with_y(bounds.max.y), bounds.max.with_y(bounds.min.y)]
        {
            let ray = (corner - camera.eye()).normalize();
            assert!(ray.angle_between(axis) < 15f64.to_radians(), "{name}: {corner}");
        }
        assert!(scene.lights().len() >= 2 && camera.forward().y < 0.0);
    }
    std::fs::write(folder.path().join("bad.obj"), "f 1 2 3\n").unwrap();
    let Err(error) = catoptra_scene::load(&folder.path().join("bad.obj")) else { panic!("was read") };
    assert!(error.to_string().contains("bad.obj"), "{error}");
}

#[test]
fn a_model_with_a_shining_part_gets_a_studio() {
    let folder = folder();
    std::fs::write(folder.path().join("chair.mtl"), MTL.replace("newmtl Wood", "newmtl Wood\nKe 1 0 0"))
        .unwrap();
    let (scene, file) = catoptra_scene::load(&folder.path().join("chair.obj")).unwrap();
    assert!(file.added().is_some_and(|told| told.contains("a studio")), "{:?}", file.added());
    assert_eq!(scene.lights().len(), 3);
}

#[test]
fn models_are_recognised_by_how_they_begin() {
    let folder = folder();
    std::fs::write(folder.path().join("chair.stl"), OBJ).unwrap();
    std::fs::write(folder.path().join("chair"), OBJ).unwrap();
    for name in ["chair.stl", "chair"] {
        let (scene, file) = catoptra_scene::load(&folder.path().join(name)).unwrap();
        assert!(scene.entity_named("chair/Leg").is_some() && file.path().is_none(), "{name}");
        let (scene, _) = read(&format!("model \"a\" {{ file \"{name}\" }}"), folder.path());
        assert!(scene.entity_named("a/Leg").is_some(), "{name}");
    }
}

#[test]
fn what_is_left_out_of_meshes_is_told_too() {
    let folder = folder();
    std::fs::write(folder.path().join("odd.obj"), format!("{OBJ}curv2 1 2\n")).unwrap();
    let text = "matte \"m\" { color 0.5 }\nmesh \"a\" material=\"m\" { file \"odd.obj\" }\n";
    let (_, file) = read(text, folder.path());
    assert_eq!(file.warnings().len(), 1, "{:?}", file.warnings());
    assert!(file.warnings()[0].starts_with("odd.obj"), "{:?}", file.warnings());
    assert!(file.warnings()[0].contains("free-form"), "{:?}", file.warnings());
    let (_, both) = read(&format!("{text}model \"b\" {{ file \"odd.obj\" }}"), folder.path());
    assert_eq!(both.warnings().len(), 1, "each thing once: {:?}", both.warnings());
}

#[test]
fn a_texture_of_a_model_is_named_in_the_text() {
    let folder = folder();
    catoptra_scene::image::write_png(&folder.path().join("oak.png"), 1, 1, &[9, 8, 7]).unwrap();
    std::fs::write(folder.path().join("chair.mtl"), format!("{MTL}map_Kd oak.png\n")).unwrap();
    let text = "checker-texture \"own\"\nmatte \"table\" { color 1 texture=\"chair/oak.png\" }\n\
        group \"g\" {\n model \"chair\" { file \"chair.obj\" }\n}\n";
    let (mut scene, mut file) = read(text, folder.path());
    let names: Vec<_> = scene.textures().map(|(_, name, _)| name.to_owned()).collect();
    assert_eq!(names, ["own", "chair/oak.png"]);
    let oak = scene.texture_named("chair/oak.png").unwrap();
    let table = scene.material_named("table").unwrap();
    assert_eq!(scene.material(table).values().textures().collect::<Vec<_>>(), [oak]);
    file.update(&scene);
    let saved = file.text();
    let (again, _) = read(&saved, folder.path());
    assert_eq!(told(&again), told(&scene), "{saved}");
    scene.apply(Edit::Remove(scene.entity_named("g").unwrap())).unwrap();
    check_saved(&scene, &mut file, folder.path());
    let message = refused(&text.replace("chair/oak", "chair/oka"), folder.path());
    assert!(message.contains("did you mean \"chair/oak.png\"?"), "{message}");
}
