//! Are textures read, kept and written back as scene text names them, and what paints with them?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::fs;
use std::sync::Arc;

use catoptra_core::glam::DVec2;
use catoptra_core::scene::{Edit, Scene};
use catoptra_core::texture::Channel;
use catoptra_core::{
    Finish, Material, MaterialId, Rgb, Texture, TextureId, TexturePoint, TextureUse, Value, Values,
};
use catoptra_scene::image::write_png;
use catoptra_scene::{SceneFile, SceneTextError, load, parse};
use tempfile::TempDir;

/// A folder with a picture: red and green over blue and white.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("pictures")).unwrap();
    let bytes = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255];
    write_png(&folder.path().join("pictures/wood.png"), 2, 2, &bytes).unwrap();
    folder
}

fn read(folder: &TempDir, text: &str) -> Result<(Scene, SceneFile), SceneTextError> {
    parse(text, "room.kdl", Some(folder.path()))
}

const ROOM: &str = "// Everything wooden.
image-texture \"wood\" {
    file \"pictures/wood.png\" // from the workshop
    scale 2
    turn 90
}
noise-texture \"clouds\" { octaves 3 }
matte \"floor\" {
    color 0.5 0.5 0.25 texture=\"wood\" // tinted
    reflectiveness 1 texture=\"clouds\" channel=\"g\"
    opacity 0.5
    normal-map \"wood\"
}
plane \"ground\" material=\"floor\"
";

fn material(scene: &Scene, name: &str) -> (MaterialId, Material) {
    let id = scene.material_named(name).unwrap();
    (id, scene.material(id).clone())
}

#[test]
fn textures_are_read_where_materials_name_them() {
    let folder = folder();
    let (scene, file) = read(&folder, ROOM).unwrap();
    let (wood, clouds) = (scene.texture_named("wood").unwrap(), scene.texture_named("clouds").unwrap());
    let (id, floor) = material(&scene, "floor");
    let color = Value::Color(Rgb::new(0.5, 0.5, 0.25)).textured(TextureUse::of(wood));
    assert_eq!(floor.values().get("color"), Some(&color));
    let green = TextureUse { texture: clouds, channel: Some(Channel::Green) };
    assert_eq!(floor.values().get("reflectiveness"), Some(&Value::Number(1.0).textured(green)));
    assert_eq!(scene.finish(id).opacity().base(), 0.5);
    assert_eq!(scene.finish(id).normal_map().map(|map| map.texture), Some(wood));
    let texture = scene.find_texture(wood).unwrap();
    assert_eq!(texture.values().get("scale"), Some(&Value::Pair(DVec2::splat(2.0))));
    // uv 3/8 1/8, twice as large, turned left by a right angle: (−1/4, 3/4), in the upper right quarter: green.
    let at = TexturePoint::at_uv(DVec2::new(0.375, 0.125));
    let color = texture.color(&at);
    assert!((color.g - 1.0).abs() < 1e-12 && color.r.max(color.b) < 1e-12, "{color:?}");
    let resolved = floor.resolved(&scene, &at);
    assert!(!resolved.is_textured() && floor.is_textured());
    assert_eq!(resolved.values().get("color"), Some(&Value::Color(Rgb::new(0.0, 0.5, 0.0))));
    assert_eq!(file.image_paths().collect::<Vec<_>>(), [folder.path().join("pictures/wood.png")]);
}

#[test]
fn the_order_of_nodes_does_not_matter() {
    let folder = folder();
    let text = "matte \"a\" { color 1 texture=\"spots\" }\nmatte \"b\" { color 1 texture=\"wood\" }\n\
                image-texture \"wood\" { file \"pictures/wood.png\" }\nchecker-texture \"spots\"\n";
    let (scene, _) = read(&folder, text).unwrap();
    let painted = |name| scene.painted_with(scene.texture_named(name).unwrap());
    assert_eq!(painted("spots"), [material(&scene, "a").0]);
    assert_eq!(painted("wood"), [material(&scene, "b").0]);
}

#[test]
fn an_unedited_text_keeps_every_byte_and_a_new_one_reads_back() {
    let folder = folder();
    let (scene, mut file) = read(&folder, ROOM).unwrap();
    file.update(&scene);
    assert_eq!(file.text(), ROOM);
    let written = SceneFile::new(&scene).text();
    let (again, _) = read(&folder, &written).unwrap();
    assert!(again == scene, "{written}");
}

#[test]
fn a_picture_is_loaded_once_and_kept_when_its_file_is_gone() {
    let folder = folder();
    let path = folder.path().join("room.kdl");
    let text = ROOM.to_owned() + "image-texture \"planks\" { file \"pictures/wood.png\"; wrap \"clamp\" }\n";
    fs::write(&path, &text).unwrap();
    let (mut scene, mut file) = load(&path).unwrap();
    let picture = |scene: &Scene, name| match scene.find_texture(scene.texture_named(name).unwrap()) {
        Some(Texture::ImageTexture(texture)) => Arc::clone(&texture.source().image),
        other => panic!("{other:?}"),
    };
    assert!(Arc::ptr_eq(&picture(&scene, "wood"), &picture(&scene, "planks")));
    // Another reading of the same file shares it too, and one of a changed file does not.
    let (other, _) = load(&path).unwrap();
    assert!(Arc::ptr_eq(&picture(&scene, "wood"), &picture(&other, "wood")));
    write_png(&folder.path().join("pictures/wood.png"), 1, 1, &[9; 3]).unwrap();
    let (changed, _) = load(&path).unwrap();
    assert!(!Arc::ptr_eq(&picture(&scene, "wood"), &picture(&changed, "wood")));
    fs::remove_file(folder.path().join("pictures/wood.png")).unwrap();
    let clouds = scene.texture_named("clouds").unwrap();
    let finer = scene.find_texture(clouds).unwrap().with("octaves", Value::Number(5.0)).unwrap();
    scene.apply(Edit::Texture(clouds, finer)).unwrap();
    file.save(&scene, &path).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), text.replace("octaves 3", "octaves 5"));
}

fn noise() -> Texture {
    (Texture::kind_named("noise-texture").unwrap().make)(&Values::new()).unwrap()
}

fn change(scene: &mut Scene, field: &'static str, value: Value) {
    let (id, floor) = material(scene, "floor");
    scene.apply(Edit::Material(id, floor.with(field, value).unwrap())).unwrap();
}

/// Does edits, and answers with the text afterwards, which reads back as the scene.
fn edited(edit: impl Fn(&mut Scene, TextureId, TextureId)) -> String {
    let folder = folder();
    let (mut scene, mut file) = read(&folder, ROOM).unwrap();
    let (wood, clouds) = (scene.texture_named("wood").unwrap(), scene.texture_named("clouds").unwrap());
    edit(&mut scene, wood, clouds);
    file.update(&scene);
    let text = file.text();
    let (again, _) = read(&folder, &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let names = |scene: &Scene, values: &Values| -> Vec<String> {
        values.textures().filter_map(|id| scene.texture_name(id).map(str::to_owned)).collect()
    };
    let told = |scene: &Scene| -> Vec<String> {
        let material = |(id, name, material): (MaterialId, &str, &Material)| {
            let finish = catoptra_core::Part::values(&scene.finish(id));
            let values = [material.values(), finish];
            let plain = values.each_ref().map(|values| {
                values
                    .iter()
                    .map(|(name, value)| format!("{name} {:?}", value.clone().untextured()))
                    .collect::<Vec<_>>()
            });
            let plain = plain.map(|all| {
                all.into_iter().filter(|line| !line.starts_with("normal-map")).collect::<Vec<_>>()
            });
            format!("{name} {plain:?} {:?}", values.each_ref().map(|values| names(scene, values)))
        };
        let mut all: Vec<String> = scene.materials().map(material).collect();
        let mut textures: Vec<_> =
            scene.textures().map(|(_, name, texture)| format!("{name} {texture:?}")).collect();
        textures.sort();
        all.extend(textures);
        all
    };
    assert_eq!(told(&again), told(&scene), "{text}");
    text
}

#[test]
fn a_renamed_texture_is_renamed_wherever_it_is_named() {
    let text = edited(|scene, wood, _| {
        scene.apply(Edit::RenameTexture(wood, "oak \"1\"".into())).unwrap();
    });
    let oak = ROOM.replace("\"wood\"", "\"oak \\\"1\\\"\"");
    assert_eq!(text, oak);
}

#[test]
fn textures_of_a_field_come_change_and_go() {
    let color = Value::Color(Rgb::new(0.5, 0.5, 0.25));
    let text = edited(|scene, _, clouds| {
        change(scene, "color", color.clone().textured(TextureUse::of(clouds)));
    });
    assert_eq!(text, ROOM.replace("0.25 texture=\"wood\"", "0.25 texture=\"clouds\""));
    let text = edited(|scene, _, _| change(scene, "color", color.clone()));
    assert_eq!(text, ROOM.replace(" texture=\"wood\" //", " //"));
    let text = edited(|scene, _, _| change(scene, "reflectiveness", Value::Number(0.25)));
    assert_eq!(text, ROOM.replace("1 texture=\"clouds\" channel=\"g\"", "0.25"));
    let by = |texture, channel| TextureUse { texture, channel };
    let text = edited(|scene, wood, _| {
        let alpha = by(wood, Some(Channel::Alpha));
        change(scene, "reflectiveness", Value::Number(0.5).textured(alpha));
    });
    assert_eq!(
        text,
        ROOM.replace("1 texture=\"clouds\" channel=\"g\"", "0.5 texture=\"wood\" channel=\"a\"")
    );
    let text = edited(|scene, _, clouds| {
        change(scene, "reflectiveness", Value::Number(1.0).textured(by(clouds, None)));
    });
    assert_eq!(text, ROOM.replace("1 texture=\"clouds\" channel=\"g\"", "1 texture=\"clouds\""));
}

#[test]
fn finishes_come_change_and_go() {
    let set = |scene: &mut Scene, finish: Finish| {
        let (id, _) = material(scene, "floor");
        scene.apply(Edit::Finish(id, finish)).unwrap();
    };
    let text = edited(|scene, _, _| set(scene, Finish::default()));
    assert_eq!(text, ROOM.replace("    opacity 0.5\n    normal-map \"wood\"\n", "    opacity 1\n"));
    let text = edited(|scene, wood, clouds| {
        let finish = Finish::default().with("opacity", Value::Number(0.5).textured(TextureUse::of(wood)));
        set(scene, finish.unwrap().with("normal-map", Value::Texture(clouds)).unwrap());
    });
    let right = ROOM.replace("opacity 0.5", "opacity 0.5 texture=\"wood\"");
    assert_eq!(text, right.replace("normal-map \"wood\"", "normal-map \"clouds\""));
}

#[test]
fn textures_are_added_before_what_is_painted_with_them_and_removed() {
    let text = edited(|scene, _, _| {
        let id = scene.add_texture("fog", noise()).unwrap();
        change(scene, "color", Value::Color(Rgb::WHITE).textured(TextureUse::of(id)));
        let (floor, _) = material(scene, "floor");
        scene.apply(Edit::Finish(floor, Finish::default())).unwrap();
        scene.apply(Edit::RemoveTexture(scene.texture_named("wood").unwrap())).unwrap();
    });
    assert!(text.contains("noise-texture \"clouds\" { octaves 3 }\nnoise-texture \"fog\"\nmatte"), "{text}");
    assert!(!text.contains("\"wood\"") && text.contains("color 1 1 1 texture=\"fog\" // tinted"), "{text}");
}

#[test]
fn two_textures_can_change_names() {
    edited(|scene, wood, clouds| {
        scene.apply(Edit::RenameTexture(wood, "x".into())).unwrap();
        scene.apply(Edit::RenameTexture(clouds, "wood".into())).unwrap();
        scene.apply(Edit::RenameTexture(wood, "clouds".into())).unwrap();
    });
}
