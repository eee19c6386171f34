//! Do clicks in the panel do what they say? Tests that find a word in what egui shows and click on it.

use std::path::Path;

use catoptra_core::scene::{MaterialId, TextureId};
use catoptra_core::{Material, Value};
use catoptra_tracer::Pool;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, Rect, Shape};

use super::show;
use crate::document::Document;
use crate::guard::Next;
use crate::loader::Opened;
use crate::naming::Named;
use crate::viewer::{Broken, Viewer};

const TEXT: &str = "image-texture \"wood\" { file \"wood.png\"; wrap-v \"clamp\" }\n\
    noise-texture \"noise\"\nchecker-texture \"tiles\" { scale 2 3 }\nbrick-texture \"bricks\"\nmarble-texture \"marble\"\n\
    matte \"grey\" { color 0.5 0.4 0.3; reflectiveness 0.2 }\n\
    phong \"worn\" { diffuse 0.8 texture=\"wood\"; reflectiveness 0.5 texture=\"noise\" channel=\"g\"\n\
        opacity 0.9 texture=\"noise\"; alpha-cutoff 0.4; sides \"single\"; normal-map \"tiles\"; normal-strength 0.5 }\n\
    glass \"clear\"\nmetal \"gold\" { preset \"gold\" }\nprincipled \"all\"\n\
    sphere \"ball\" material=\"grey\" { radius 1 }\nsphere \"old\" material=\"worn\" { radius 1 }\n\
    sphere \"lens\" material=\"clear\" { radius 1 }\nsphere \"ring\" material=\"gold\" { radius 1 }\n\
    sphere \"toy\" material=\"all\" { radius 1 }\n\
    sphere \"small\" material=\"grey\" { radius 1; scale 0.375 }\n";

/// A viewer with egui.
struct Bench {
    viewer: Viewer,
    context: Context,
    _folder: tempfile::TempDir,
}

impl Bench {
    /// With that shape selected.
    fn new(selected: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
        write("room.kdl", TEXT.as_bytes());
        catoptra_scene::image::write_png(&folder.path().join("wood.png"), 1, 1, &[90, 60, 30]).unwrap();
        let document = Document::open(Path::new(&folder.path().join("room.kdl"))).unwrap();
        let mut viewer = Viewer::new(Opened::new(document, &Pool::new(1).unwrap()));
        let shape = viewer.document.scene().entity_named(selected);
        viewer.select(shape);
        let context = Context::default();
        super::set_theme(&context);
        let mut bench = Self { viewer, context, _folder: folder };
        bench.frames(3);
        bench
    }

    fn frame(&mut self, events: Vec<Event>) -> Vec<(String, Rect)> {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, egui::vec2(1280.0, 2600.0)));
        let input = egui::RawInput { screen_rect, events, ..Default::default() };
        let viewer = &mut self.viewer;
        let output = self.context.run_ui(input, |ui| {
            show(ui, viewer, "");
        });
        viewer.follow_scene();
        let mut texts = Vec::new();
        for clipped in &output.shapes {
            collect(&clipped.shape, &mut texts);
        }
        texts
    }

    fn frames(&mut self, count: usize) -> Vec<(String, Rect)> {
        (0..count).map(|_| self.frame(Vec::new())).last().unwrap()
    }

    /// Clicks on a word: on the one that is shown over all others of the same.
    fn click(&mut self, word: &str) {
        let shown = self.frames(2);
        let found = shown.iter().rev().find(|(text, _)| text == word);
        let pos = found.unwrap_or_else(|| panic!("{word} is not shown: {shown:?}")).1.center();
        let button = |pressed| {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
            Event::PointerButton { pos, button, pressed, modifiers }
        };
        self.frame(vec![Event::PointerMoved(pos)]);
        self.frame(vec![button(true)]);
        self.frame(vec![button(false)]);
        self.frames(2);
    }

    /// Clicks on a number, types over it, and ends that by a key.
    fn type_over(&mut self, number: &str, text: &str, key: egui::Key) {
        self.click(number);
        self.frame(vec![Event::Text(text.to_owned())]);
        let end = |pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        self.frame(vec![end(true)]);
        self.frame(vec![end(false)]);
        self.frames(2);
    }

    fn material_id(&self, name: &str) -> MaterialId {
        self.viewer.document.scene().material_named(name).unwrap()
    }

    fn material(&self, name: &str) -> &Material {
        self.viewer.document.scene().material(self.material_id(name))
    }

    fn texture(&self, name: &str) -> TextureId {
        self.viewer.document.scene().texture_named(name).unwrap()
    }

    fn value(&self, material: &str, field: &str) -> Value {
        self.material(material).values().get(field).unwrap().clone()
    }

    fn undo(&mut self) {
        assert!(self.viewer.document.undo().is_some());
        assert!(self.viewer.document.is_saved(), "it was one step");
    }
}

fn collect(shape: &Shape, texts: &mut Vec<(String, Rect)>) {
    match shape {
        Shape::Text(text) => {
            texts.push((text.galley.text().to_owned(), text.galley.rect.translate(text.pos.to_vec2())));
        }
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, texts)),
        _ => {}
    }
}

#[test]
fn looking_at_materials_and_textures_changes_nothing_of_them() {
    for shape in ["ball", "old", "lens", "ring", "toy"] {
        let mut bench = Bench::new(shape);
        for texture in ["wood", "noise", "tiles", "bricks", "marble"] {
            bench.viewer.texture = Some(bench.texture(texture));
            bench.frames(3);
            assert!(bench.viewer.document.is_saved(), "{shape} with {texture} was changed");
        }
    }
}

#[test]
fn a_field_gets_a_texture_and_loses_it() {
    let mut bench = Bench::new("ball");
    let before = bench.value("grey", "color");
    bench.click("+");
    bench.click("marble");
    let id = bench.texture("marble");
    assert_eq!(
        bench.viewer.document.scene().painted_with(id),
        [bench.material_id("grey")],
        "{:?}",
        bench.viewer.notice
    );
    bench.undo();
    assert_eq!(bench.value("grey", "color"), before);
    let mut bench = Bench::new("old");
    let is_painted = |bench: &Bench| matches!(bench.value("worn", "reflectiveness"), Value::Textured(_));
    assert!(is_painted(&bench));
    bench.click("g");
    bench.click("luminance");
    let Value::Textured(textured) = bench.value("worn", "reflectiveness") else {
        panic!("it lost its texture")
    };
    assert_eq!(textured.by.channel, Some(catoptra_core::texture::Channel::Luminance));
    bench.undo();
}

#[test]
fn another_kind_keeps_the_color_as_one_step() {
    let mut bench = Bench::new("ball");
    let (before, color) = (bench.material("grey").clone(), bench.value("grey", "color"));
    bench.click("matte");
    bench.click("plastic");
    assert_eq!((bench.material("grey").kind_name(), bench.value("grey", "color")), ("plastic", color));
    bench.undo();
    assert_eq!(*bench.material("grey"), before);
}

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
fn what_is_wrong_with_a_file_stands_there_until_it_is_read_again() {
    let mut bench = Bench::new("ball");
    let source = Next::Open("broken.kdl".into());
    bench.viewer.error = Some(Broken { report: "line 3 is wrong".to_owned(), source: source.clone() });
    assert!(bench.frames(3).iter().any(|(text, _)| text == "line 3 is wrong"));
    bench.click("Retry");
    assert_eq!(bench.viewer.take_next(), Some(source));
}

#[test]
fn what_has_failed_is_shown_until_it_is_closed() {
    let mut bench = Bench::new("ball");
    bench.viewer.failure = Some("it was not saved".to_owned());
    assert!(bench.frames(3).iter().any(|(text, _)| text == "it was not saved"));
    bench.click("Close");
    assert_eq!(bench.viewer.failure, None);
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
fn glass_is_water_by_its_name() {
    let mut bench = Bench::new("lens");
    bench.click("preset");
    bench.click("water");
    assert_eq!(bench.value("clear", "ior"), Value::Number(1.333));
    bench.undo();
}

#[test]
fn a_named_metal_gets_a_color_and_a_name_again() {
    let mut bench = Bench::new("ring");
    let metal = |bench: &Bench, field: &str| bench.material("gold").values().get(field).cloned();
    let named = |name: &str| Some(Value::Word(name.to_owned()));
    bench.click("gold");
    bench.click("copper");
    assert_eq!(metal(&bench, "preset"), named("copper"));
    bench.undo();
    assert_eq!(metal(&bench, "preset"), named("gold"));
    bench.click("0.97");
    assert_eq!((metal(&bench, "preset"), metal(&bench, "color").is_some()), (None, true));
    bench.click("–");
    bench.click("silver");
    assert_eq!((metal(&bench, "preset"), metal(&bench, "color")), (named("silver"), None));
}

#[test]
fn a_name_that_is_typed_for_a_texture_becomes_its_name() {
    let mut bench = Bench::new("ball");
    let wood = bench.texture("wood");
    bench.viewer.texture = Some(wood);
    bench.viewer.typed_name = Some((Named::Texture(wood), "oak".to_owned()));
    bench.frames(2);
    assert_eq!(bench.viewer.document.scene().texture_name(wood), Some("oak"));
    bench.undo();
    bench.viewer.typed_name = Some((Named::Texture(wood), "noise".to_owned()));
    bench.frames(2);
    assert_eq!(bench.viewer.document.scene().texture_name(wood), Some("wood"), "that name is taken");
    assert!(bench.viewer.notice.is_some());
}

#[test]
fn a_texture_is_selected_and_its_wrapping_changed() {
    let mut bench = Bench::new("ball");
    bench.click("wood");
    assert_eq!(bench.viewer.texture, Some(bench.texture("wood")));
    bench.click("repeat");
    bench.click("mirror");
    let wood = bench.texture("wood");
    let values = |bench: &Bench| bench.viewer.document.scene().find_texture(wood).unwrap().values();
    assert_eq!(values(&bench).get("wrap"), Some(&Value::Word("mirror".to_owned())));
    bench.undo();
    assert_eq!(values(&bench).get("wrap"), Some(&Value::Word("repeat".to_owned())));
    bench.click("×");
    assert_eq!(values(&bench).get("wrap-v"), None);
    bench.undo();
}

#[test]
fn a_new_texture_comes_and_goes() {
    let mut bench = Bench::new("ball");
    bench.click("Add");
    bench.click("marble-texture");
    let id = bench.texture("marble-texture");
    assert_eq!(bench.viewer.texture, Some(id));
    bench.click("Remove");
    assert_eq!(bench.viewer.document.scene().find_texture(id), None);
    assert_eq!(bench.viewer.texture, None);
}

#[test]
fn a_finish_gets_a_normal_map_and_loses_it() {
    let mut bench = Bench::new("ball");
    bench.click("Finish");
    let finish = |bench: &Bench| bench.viewer.document.scene().finish(bench.material_id("grey"));
    // Of the two that can be given, the normal map is the last.
    bench.click("give");
    assert_eq!(finish(&bench).normal_map().map(|map| map.texture), Some(bench.texture("wood")));
    bench.click("×");
    assert!(finish(&bench).is_plain());
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
fn a_colour_is_typed_in_digits_or_as_the_file_has_it() {
    let mut bench = Bench::new("ball");
    let digits = bench.frames(2).into_iter().rev().find(|(text, _)| text.starts_with('#')).unwrap().0;
    bench.type_over(&digits, "0.5 1/4 1", egui::Key::Enter);
    assert_eq!(bench.value("grey", "color"), Value::Color(catoptra_core::Rgb::new(0.5, 0.25, 1.0)));
    bench.undo();
}
