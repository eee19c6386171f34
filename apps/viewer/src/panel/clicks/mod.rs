//! Do clicks in the panel do what they say? Tests that find a word in what egui shows and click on it.

mod boxes;
mod labels;
mod materials;
mod textures;
mod things;

use std::path::Path;

use catoptra_core::scene::{MaterialId, TextureId};
use catoptra_core::{Material, Value};
use catoptra_tracer::Pool;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, Rect, Shape};

use super::show;
use crate::document::Document;
use crate::loader::Opened;
use crate::turns;
use crate::viewer::Viewer;

const TEXT: &str = "settings { background 0.1 0.2 0.3 }\n\
    image-texture \"wood\" { file \"wood.png\"; wrap-v \"clamp\" }\n\
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
        let output = turns::run(&self.context, input, |ui| {
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

    /// Where a word stands: the one that is shown over all others of the same.
    fn place(&mut self, word: &str) -> Pos2 {
        let shown = self.frames(2);
        let found = shown.iter().rev().find(|(text, _)| text == word);
        found.unwrap_or_else(|| panic!("{word} is not shown: {shown:?}")).1.center()
    }

    fn click(&mut self, word: &str) {
        let pos = self.place(word);
        self.frame(vec![Event::PointerMoved(pos)]);
        self.frame(vec![button(pos, true)]);
        self.frame(vec![button(pos, false)]);
        self.frames(2);
    }

    /// Drags a word to another, or so many points below that.
    fn drag(&mut self, word: &str, (to, below): (&str, f32)) {
        let (from, to) = (self.place(word), self.place(to) + egui::vec2(0.0, below));
        self.frame(vec![Event::PointerMoved(from)]);
        self.frame(vec![button(from, true)]);
        for share in [0.3, 0.6, 1.0] {
            self.frame(vec![Event::PointerMoved(from.lerp(to, share))]);
        }
        self.frame(vec![button(to, false)]);
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

fn button(pos: Pos2, pressed: bool) -> Event {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    Event::PointerButton { pos, button, pressed, modifiers }
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
