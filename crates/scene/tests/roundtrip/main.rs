//! Does saving an edited scene change only what was edited, and does the saved text mean the edited scene?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, EntityId, Integrator, Node, Role, Scene, Settings, Subtree};
use catoptra_core::{Placement, Rgb, Shape, Value, Values};
use catoptra_scene::{SceneFile, load, parse};

mod rows;
mod structure;
mod values;

const TEXT: &str = r#"// A small room.
settings { max-depth 3 } // three are enough

matte "white" { color 1.0 1.00 1 } /* plain */
phong "red" {
    diffuse 0.9 0.1 0.1   // strong
    shininess 0x20
}

group "balls" {
    move 1 0 0    // to the right
    sphere "left" material="white" { center -1 0.50 0; radius 5e-1 }
    // the other one
    sphere "right" material="red" {
        center +1 0.5 0
        radius 0.5 // same
    }
}

plane "floor" material="white"
spot-light "lamp" shadow=#false {
    position 0 5 0
    direction 0 -1 0
    intensity 10
    inner 20; outer 40.0
}
/- sphere "off" material="white" { radius 1 }

camera "main" { eye 0 1 5; target 0 0 0; fov 60 }
// the end
"#;

fn start() -> (Scene, SceneFile) {
    parse(TEXT, "room.kdl", None).unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)))
}

fn id(scene: &Scene, name: &str) -> EntityId {
    scene.entity_named(name).unwrap()
}

/// Everything in a scene, by name and in order.
fn contents(scene: &Scene) -> Vec<String> {
    fn tree(scene: &Scene, group: Option<EntityId>, out: &mut Vec<String>) {
        for id in scene.children(group) {
            let material = scene.material_of(id).map(|m| scene.material_name(m).to_owned());
            let (shape, light, camera) = (scene.shape(id), scene.light(id), scene.camera(id));
            let parent = group.and_then(|g| scene.name(g));
            out.push(format!(
                "{:?} {:?} in {parent:?} {shape:?} {light:?} {camera:?} {material:?} {:?}",
                scene.role(id),
                scene.name(id),
                scene.placement(id)
            ));
            tree(scene, Some(id), out);
        }
    }
    let mut out = vec![format!("{:?}", scene.settings())];
    let mut materials: Vec<String> = scene.materials().map(|(_, name, m)| format!("{name} {m:?}")).collect();
    materials.sort();
    out.extend(materials);
    tree(scene, None, &mut out);
    out
}

/// Applies the edit, updates the text, checks that it means the same scene, and answers with it.
fn edited(edit: impl FnOnce(&mut Scene)) -> String {
    let (mut scene, mut file) = start();
    edit(&mut scene);
    file.update(&scene);
    let text = file.text();
    let again =
        parse(&text, "again.kdl", None).unwrap_or_else(|e| panic!("{:?}\n{text}", miette::Report::new(e)));
    assert_eq!(contents(&again.0), contents(&scene), "{text}");
    // Once more, from the kept state and from the new one, changes nothing.
    file.update(&scene);
    assert_eq!(file.text(), text);
    text
}

/// The lines of `text` that are not in the original, and the lines of the original that are not in `text`.
fn difference(text: &str) -> (Vec<&str>, Vec<&str>) {
    let new = text.lines().filter(|line| !TEXT.lines().any(|old| old == *line)).map(str::trim).collect();
    let old = TEXT.lines().filter(|old| !text.lines().any(|line| line == *old)).map(str::trim).collect();
    (new, old)
}

fn set_shape(scene: &mut Scene, name: &str, field: &'static str, value: Value) {
    let id = id(scene, name);
    let shape = scene.shape(id).unwrap().with(field, value).unwrap();
    scene.apply(Edit::Shape(id, shape)).unwrap();
}

fn place(scene: &mut Scene, name: &str, change: impl FnOnce(Placement) -> Placement) {
    let id = id(scene, name);
    let placement = change(scene.placement(id).unwrap());
    scene.apply(Edit::Placement(id, placement)).unwrap();
}

#[test]
fn no_edit_changes_no_byte() {
    assert_eq!(edited(|_| ()), TEXT);
}

fn make_shape(kind: &str, values: &Values) -> Shape {
    (Shape::kind_named(kind).unwrap().make)(values).unwrap()
}

#[test]
fn a_scene_without_text_gets_one() {
    let (scene, _) = start();
    let text = SceneFile::new(&scene).text();
    let (again, _) =
        parse(&text, "new.kdl", None).unwrap_or_else(|e| panic!("{:?}\n{text}", miette::Report::new(e)));
    assert_eq!(contents(&again), contents(&scene));
}

#[test]
fn line_ends_of_the_file_are_kept() {
    let text = TEXT.replace('\n', "\r\n");
    let (mut scene, mut file) = parse(&text, "room.kdl", None).unwrap();
    set_shape(&mut scene, "floor", "point", Value::Vector(DVec3::new(0.0, -1.0, 0.0)));
    scene.apply(Edit::Parent(id(&scene, "right"), None)).unwrap();
    file.update(&scene);
    assert!(!file.text().replace("\r\n", "").contains('\n'));
}

#[test]
fn many_new_things_are_written_in_one_go() {
    let (mut scene, mut file) = start();
    let white = scene.material_named("white").unwrap();
    let sphere = make_shape("sphere", &Values::new().with("radius", Value::Number(0.1)));
    for i in 0..500 {
        scene.add_shape(&format!("grain {i}"), sphere.clone(), white, None).unwrap();
    }
    file.update(&scene);
    let (again, _) = parse(&file.text(), "again.kdl", None).unwrap();
    assert_eq!(contents(&again), contents(&scene));
}

#[test]
fn saving_and_loading_gives_an_equal_scene_and_no_other_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("room.kdl");
    std::fs::write(&path, TEXT).unwrap();
    let (mut scene, mut file) = load(&path).unwrap();
    set_shape(&mut scene, "left", "radius", Value::Number(0.625));
    file.save(&scene, &path).unwrap();
    let (again, file) = load(&path).unwrap();
    assert_eq!(contents(&again), contents(&scene));
    assert_eq!(file.path(), Some(path.as_path()));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    assert_eq!(scene.entities_of(Role::Shape).count(), 3);
}

#[test]
fn a_refused_save_leaves_the_file_alone() {
    let (scene, mut file) = start();
    let error = file.save(&scene, std::path::Path::new("/no/such/folder/room.kdl")).unwrap_err();
    assert!(error.to_string().starts_with("/no/such/folder/room.kdl: cannot be written"), "{error}");
}

/// SplitMix64 (Steele, Lea, Flood 2014), below `end`.
fn random(state: &mut u64, end: usize) -> usize {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) % end.max(1) as u64) as usize
}

/// One edit of any kind to anything; some are refused, which is as good.
fn random_edit(scene: &mut Scene, count: usize, state: &mut u64) {
    let all = scene.walk();
    let Some(&any) = all.get(random(state, all.len())) else { return };
    let other = all[random(state, all.len())];
    let materials: Vec<_> = scene.materials().map(|(id, ..)| id).collect();
    let material = materials[random(state, materials.len())];
    let number = random(state, 1000) as f64 / 64.0;
    let by = DVec3::new(number, 0.0, -number);
    let sphere = make_shape("sphere", &Values::new().with("radius", Value::Number(number + 0.5)));
    let edit = match random(state, 12) {
        0 => Edit::Remove(any),
        1 => Edit::Shape(any, sphere),
        2 => Edit::Placement(any, Placement::IDENTITY.moved(by).unwrap()),
        3 => Edit::MaterialOf(any, material),
        4 => Edit::Parent(any, Some(other)),
        5 => Edit::Parent(any, None),
        6 => Edit::Order(any, random(state, 6)),
        7 => Edit::Name(any, format!("named {count}")),
        8 => Edit::RenameMaterial(material, format!("worn {count}")),
        9 => {
            let node = Node::group(
                format!("new {count}"),
                vec![Node::shape(format!("in {count}"), sphere, material)],
            );
            Edit::insert(Subtree { node, parent: None, index: Some(random(state, 5)) })
        }
        10 => {
            let node = Node::shape(format!("new {count}"), sphere, material);
            Edit::insert(Subtree { node, parent: Some(other), index: Some(random(state, 3)) })
        }
        _ => {
            let settings = Settings::new(Rgb::grey(number), random(state, 9) as u32).unwrap();
            let distance = (random(state, 2) == 0).then_some(1.0 + number);
            let integrator = Integrator::ALL[random(state, Integrator::ALL.len())];
            Edit::Settings(settings.with_occlusion_distance(distance).unwrap().with_integrator(integrator))
        }
    };
    let _ = scene.apply(edit);
}

#[test]
fn any_edits_in_any_order_are_saved() {
    for seed in 0..150 {
        let mut state = seed;
        let (mut scene, mut file) = start();
        for round in 0..4 {
            for i in 0..=random(&mut state, 8) {
                random_edit(&mut scene, 100 * round + i, &mut state);
            }
            let before = file.text();
            file.update(&scene);
            let text = file.text();
            let (again, _) = parse(&text, "again.kdl", None).unwrap_or_else(|e| {
                panic!("seed {seed}: {:?}\n{before}\n-----\n{text}", miette::Report::new(e))
            });
            assert_eq!(contents(&again), contents(&scene), "seed {seed}\n{before}\n-----\n{text}");
            for comment in ["// A small room.", "/* plain */", "// the end"] {
                assert!(text.contains(comment), "seed {seed}: {comment} is gone from\n{text}");
            }
        }
    }
}
