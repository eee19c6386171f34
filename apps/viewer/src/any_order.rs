//! Is nothing lost, whatever is done in whatever order? Commands, gestures, clicks and typing at random; undo takes all of it
//! back to the same text, and redo brings all of it again.

use std::path::PathBuf;

use catoptra_core::scene::EntityId;
use catoptra_tracer::Pool;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, Rect};
use proptest::prelude::*;
use winit::keyboard::{Key, NamedKey};

use crate::document::Document;
use crate::guard::Answer;
use crate::input::{Button, Held};
use crate::keys::{Command, bindings};
use crate::loader::Opened;
use crate::making::starters::Addable;
use crate::selection::Picking;
use crate::viewer::{Viewer, Wanted};
use crate::{actions, gestures, making, panel, transform, turns};

const TEXT: &str = "\
// everything of everything
camera \"main\" { eye 0 2 12; target 0 1 0; fov 45 } // the first
camera \"plan\" { eye 0 9 0.1; target 0 0 0; projection \"orthographic\"; height 6 }
ambient-light \"sky\" { radiance 0.2 }
checker-texture \"tiles\" { scale 2 3 }
matte \"red\" { color 1 0 0 }
plastic \"worn\" { color 0.5 texture=\"tiles\" }

sphere \"ball\" material=\"red\" { center 0 1 0; radius 1 } // the large one
group \"table\" {
    turn 20 0 1 0
    box \"top\" material=\"worn\" { min -1 0 -1; max 1 0.1 1; move 2.5 1 0 }
    spot-light \"spot\" { position 0 4 0; direction 0 -1 0; intensity 60; inner 25; outer 25 }
    difference \"cup\" { cylinder \"rim\" material=\"red\" { from 0 0 0; to 0 1 0; radius 0.4 }; sphere \"hollow\" material=\"red\" { center 0 1 0; radius 0.3 } }
}
plane \"floor\" material=\"worn\"
rectangle-light \"lamp\" { corner -1 3 0; edge-u 2 0 0; edge-v 0 1 0; radiance 3 }
";

/// The window's size in pixels, its picture left and its panel right.
const SIZE: (u32, u32) = (912, 900);

/// Something that a person does.
#[derive(Debug, Clone)]
enum Step {
    /// A key that is bound.
    Key(usize),
    /// A thing is selected by its place in the tree; one more, or alone.
    Select(usize, bool),
    /// Something of the list is added at a place of the picture.
    Add(usize, (u32, u32)),
    /// The pointer is dragged over the picture.
    Drag { button: Button, held: Held, from: (u32, u32), by: (i32, i32) },
    /// The wheel is turned.
    Wheel(i8, bool),
    /// A letter goes to what is being moved.
    Typed(char),
    /// A click in the panel or on what stands over the picture.
    Click { at: (u32, u32), button: PointerButton, by: (i32, i32) },
    /// Text goes to the field that has the keys, and a key ends it.
    Text(String, egui::Key),
    /// A question is answered.
    Answer(Answer),
    /// The window is scrolled there.
    Scroll((u32, u32), i32),
}

fn pixel() -> impl Strategy<Value = (u32, u32)> {
    (0..SIZE.0, 0..SIZE.1)
}

fn way() -> impl Strategy<Value = (i32, i32)> {
    (-90..90, -90..90)
}

fn of_panel() -> impl Strategy<Value = (u32, u32)> {
    prop_oneof![4 => (SIZE.0..SIZE.0 + 272, 0..SIZE.1), 1 => (0..SIZE.0 + 272, 0..SIZE.1)]
}

fn held() -> impl Strategy<Value = Held> {
    (any::<bool>(), any::<bool>()).prop_map(|(shift, ctrl)| Held { shift: shift && !ctrl, ctrl, alt: false })
}

fn text() -> impl Strategy<Value = String> {
    prop_oneof!["[0-9./*-]{1,4}", "[a-z ]{1,6}", Just("1e30".to_owned()), Just("ball".to_owned())]
}

fn step() -> impl Strategy<Value = Step> {
    let button = prop_oneof![3 => Just(Button::Left), 1 => Just(Button::Middle), 1 => Just(Button::Right)];
    let click = prop_oneof![4 => Just(PointerButton::Primary), 1 => Just(PointerButton::Secondary)];
    let ends = prop_oneof![Just(egui::Key::Enter), Just(egui::Key::Escape), Just(egui::Key::Tab)];
    let answers = prop_oneof![Just(Answer::Write), Just(Answer::GiveUp), Just(Answer::Elsewhere)];
    prop_oneof![
        8 => (0..bindings().count()).prop_map(Step::Key),
        4 => (0..24_usize, any::<bool>()).prop_map(|(place, more)| Step::Select(place, more)),
        2 => (0..40_usize, pixel()).prop_map(|(what, at)| Step::Add(what, at)),
        4 => (button, held(), pixel(), way()).prop_map(|(button, held, from, by)| Step::Drag { button, held, from, by }),
        1 => (-3..4_i8, any::<bool>()).prop_map(|(notches, ctrl)| Step::Wheel(notches, ctrl)),
        3 => prop::sample::select("xyz01.5-/*".chars().collect::<Vec<_>>()).prop_map(Step::Typed),
        8 => (of_panel(), click, prop_oneof![2 => Just((0, 0)), 1 => way()])
            .prop_map(|(at, button, by)| Step::Click { at, button, by }),
        3 => (text(), ends).prop_map(|(text, key)| Step::Text(text, key)),
        1 => answers.prop_map(Step::Answer),
        1 => (of_panel(), -400..400_i32).prop_map(|(at, by)| Step::Scroll(at, by)),
    ]
}

/// A viewer with egui, and a clipboard.
struct Bench {
    viewer: Viewer,
    context: Context,
    pool: Pool,
    clipboard: String,
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("scene.kdl");
        std::fs::write(&file, TEXT).unwrap();
        let pool = Pool::new(1).unwrap();
        let mut viewer = Viewer::new(Opened::new(Document::open(&file).unwrap(), &pool));
        viewer.size = SIZE;
        let context = Context::default();
        panel::set_theme(&context);
        let mut bench = Self { viewer, context, pool, clipboard: String::new(), folder };
        bench.frame(Vec::new());
        bench
    }

    fn text(&mut self) -> String {
        self.viewer.document.text()
    }

    fn frame(&mut self, events: Vec<Event>) {
        let size = egui::vec2((SIZE.0 + 272) as f32, SIZE.1 as f32);
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, size));
        let input = egui::RawInput { screen_rect, events, ..Default::default() };
        let viewer = &mut self.viewer;
        let _ = turns::run(&self.context, input, |ui| {
            panel::show(ui, viewer, "");
        });
    }

    /// Follows what was done as the window does between events.
    fn follow(&mut self) {
        // Nothing is opened here.
        let _ = self.viewer.take_next();
        let home: PathBuf = self.folder.path().into();
        if self.viewer.browser.as_ref().is_some_and(|browser| browser.folder != home) {
            self.viewer.browser = None;
        }
        match self.viewer.wanted.take() {
            Some(Wanted::Copy(text)) => self.clipboard = text,
            Some(Wanted::Paste) => making::paste(&mut self.viewer, &self.clipboard.clone()),
            Some(Wanted::Model(_) | Wanted::DesktopDialog) | None => {}
        }
        self.viewer.follow_scene();
        self.viewer.latest.follow(&self.viewer.extraction, &self.pool);
    }

    fn do_all(&mut self, steps: &[Step]) {
        for step in steps {
            self.act(step);
            self.follow();
        }
        transform::keep(&mut self.viewer);
        self.viewer.finish_name();
        self.viewer.document.end_step();
        self.follow();
    }

    fn act(&mut self, step: &Step) {
        let viewer = &mut self.viewer;
        match step {
            Step::Key(number) => {
                bindings().nth(*number).into_iter().for_each(|binding| self.key(binding.command));
            }
            Step::Select(place, more) => {
                let all = viewer.document.scene().walk();
                let id: Option<EntityId> = all.get(place % all.len().max(1)).copied();
                viewer.click_on(id, if *more { Picking::Toggle } else { Picking::Only });
            }
            Step::Add(what, (x, y)) => {
                let all: Vec<Addable> = Addable::sections().into_iter().flat_map(|(_, all)| all).collect();
                making::add::add(viewer, all[what % all.len()], Some((f64::from(*x), f64::from(*y))));
            }
            Step::Drag { button, held, from, by } => self.drag(*button, *held, *from, *by),
            Step::Wheel(notches, ctrl) => gestures::wheel(viewer, f64::from(*notches), *ctrl),
            Step::Typed(letter) => {
                transform::key(viewer, &Key::Character(letter.to_string().into()), false);
            }
            Step::Click { at, button, by } => self.click(*at, *button, *by),
            Step::Text(text, key) => {
                self.frame(vec![Event::Text(text.clone())]);
                self.press(*key);
            }
            Step::Answer(answer) => viewer.answer(*answer),
            Step::Scroll(at, by) => {
                let delta = egui::vec2(0.0, *by as f32);
                let (unit, modifiers) = (egui::MouseWheelUnit::Point, Modifiers::NONE);
                let phase = egui::TouchPhase::Move;
                self.frame(vec![
                    Event::PointerMoved(point(*at)),
                    Event::MouseWheel { unit, delta, phase, modifiers },
                ]);
            }
        }
    }

    /// As the window does with a key.
    fn key(&mut self, command: Command) {
        let asks = self.viewer.guard.question().is_some() || self.viewer.browser.is_some();
        if self.viewer.transform.is_some() && command == Command::Escape {
            transform::key(&mut self.viewer, &Key::Named(NamedKey::Escape), false);
        } else if asks || self.viewer.adding.is_some() {
            (self.viewer.browser, self.viewer.adding) = (None, None);
            self.viewer.answer(Answer::Cancel);
        } else {
            if !matches!(command, Command::Transform(_)) {
                transform::keep(&mut self.viewer);
            }
            actions::run(&mut self.viewer, command);
        }
        self.frame(Vec::new());
    }

    fn drag(&mut self, button: Button, held: Held, from: (u32, u32), by: (i32, i32)) {
        let (x, y) = (f64::from(from.0), f64::from(from.1));
        let viewer = &mut self.viewer;
        let moved = viewer.pointer.moved((x, y));
        gestures::gesture(viewer, moved);
        if viewer.transform.is_some() {
            transform::pull(viewer, (x, y), held.ctrl);
            return transform::keep(viewer);
        }
        viewer.pointer.held = held;
        let hold = gestures::hold_at(viewer, (x, y));
        let mode = viewer.settings.mode;
        viewer.pointer.press(button, held, mode, hold);
        for part in 1..=3 {
            let part = f64::from(part) / 3.0;
            let gesture = viewer.pointer.moved((x + part * f64::from(by.0), y + part * f64::from(by.1)));
            gestures::gesture(viewer, gesture);
            viewer.follow_scene();
        }
        let gesture = viewer.pointer.release(button);
        gestures::gesture(viewer, gesture);
    }

    fn click(&mut self, at: (u32, u32), button: PointerButton, by: (i32, i32)) {
        let from = point(at);
        let to = from + egui::vec2(by.0 as f32, by.1 as f32);
        let modifiers = Modifiers::NONE;
        let press = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
        self.frame(vec![Event::PointerMoved(from)]);
        self.frame(vec![press(from, true)]);
        self.frame(vec![Event::PointerMoved(to)]);
        self.frame(vec![press(to, false)]);
    }

    fn press(&mut self, key: egui::Key) {
        let modifiers = Modifiers::NONE;
        let event = |pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
        self.frame(vec![event(true)]);
        self.frame(vec![event(false)]);
    }
}

fn point((x, y): (u32, u32)) -> Pos2 {
    Pos2::new(x as f32, y as f32)
}

proptest! {
    // An eighth of the usual number, which PROPTEST_CASES changes.
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 8, ..ProptestConfig::default() })]

    #[test]
    fn undo_takes_everything_back_and_redo_brings_it_again(steps in prop::collection::vec(step(), 1..60)) {
        let mut bench = Bench::new();
        bench.do_all(&steps);
        // Some of the steps may be taken back already.
        while bench.viewer.document.redo().is_some() {}
        let end = bench.text();
        while bench.viewer.document.undo().is_some() {}
        bench.follow();
        prop_assert_eq!(bench.text(), TEXT);
        while bench.viewer.document.redo().is_some() {}
        bench.follow();
        prop_assert_eq!(bench.text(), end);
    }
}
