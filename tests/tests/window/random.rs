//! Does the window bear a hand that does anything at all? A minute of keys, clicks, drags, drops, sizes and pasted text,
//! made from a number; nothing may break, no edit may go unasked, and undo must take all of it back to the same bytes.
//!
//! `CATOPTRA_RANDOM_SECONDS` goes on for longer, `CATOPTRA_RANDOM_SEED` does something else; a failure tells its seed and all
//! that was done.

use std::path::PathBuf;
use std::thread::sleep;
use std::time::{Duration, Instant};

use catoptra_lab::adversary::Random;

use crate::programs::LOOK;
use crate::stage::{SIZE, Stage};

/// Something of every sort.
const SCENE: &str = "\
// two balls and a cup
camera \"main\" { eye 0 1 12; target 0 0 0; fov 45 }
camera \"plan\" { eye 0 9 0.1; target 0 0 0; projection \"orthographic\"; height 6 } // from above
ambient-light \"sky\" { radiance 0.3 }
checker-texture \"tiles\" { scale 2 3 }
matte \"red\" { color 1 0 0 }
matte \"worn\" { color 0.50 }

sphere \"left ball\" material=\"red\" { center 0 0 0; radius 2 } // the large one
group \"table\" {
    turn 20 0 1 0
    sphere \"right ball\" material=\"worn\" { center 4 0 0; radius 1 }
    spot-light \"spot\" { position 0 4 0; direction 0 -1 0; intensity 60; inner 25; outer 25 }
    difference \"cup\" { cylinder \"rim\" material=\"red\" { from -4 0 0; to -4 1 0; radius 0.6 }; sphere \"hollow\" material=\"red\" { center -4 1 0; radius 0.5 } }
}
plane \"floor\" material=\"worn\" { move 0 -2 0 }
rectangle-light \"lamp\" { corner -1 4 0; edge-u 2 0 0; edge-v 0 1 0; radiance 3 }
";

/// Keys that do something and stay with the scene, and some that do nothing. Tab goes through buttons while one is typing,
/// those of the file menu too; so it comes after Esc.
const KEYS: &str = "F1 Escape+Tab Home f 0 c 1 3 7 ctrl+1 ctrl+3 ctrl+7 5 Left Right Up Down t o g r s q n i bracketright \
    bracketleft e v m l b p Delete shift+a ctrl+d shift+d ctrl+x ctrl+c ctrl+v F2 ctrl+g ctrl+shift+g h alt+h ctrl+l ctrl+a \
    Escape ctrl+s ctrl+z ctrl+shift+z ctrl+y ctrl+z Escape Return Return x y z shift+x minus 1 2 period slash BackSpace space \
    ctrl+plus ctrl+minus ctrl+0 F9 ctrl+k";

/// What is typed: names of things that can be added, names, numbers, nonsense.
const TYPED: &[&str] = &[
    "sphere",
    "box",
    "spot",
    "glass",
    "prism",
    "union",
    "model",
    "globe",
    "1/3",
    "2*0.45",
    "-1",
    "1e30",
    "0",
    "#ff8000",
    "nan",
    "(",
    "picture.png",
    "model.obj",
];

/// What other programs put on the clipboard.
const CLIPS: &[&str] = &[
    "matte \"blue\" { color 0 0 1 }\nsphere \"new\" material=\"blue\" { center -3 0 0; radius 1 }\n",
    "sphere \"left ball\" material=\"red\" { radius -1 }\n",
    "not a scene { at all",
    "",
];

/// Ways to leave the scene; with edits that are not saved each must ask first.
const LEAVING: &[&str] = &["ctrl+q", "ctrl+n", "F5", "ctrl+o", "close", "drop"];

/// Files that can be dropped without another scene to come of it: what they are called and what they hold.
const FILES: &[(&str, &str)] = &[
    ("picture.png", ""),
    ("broken.png", "\u{1}PNG and no more"),
    ("model.obj", "o flag\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"),
    ("broken.obj", "v 0 0\nf 1 2 3 4\n"),
    ("broken.kdl", "sphere \"ball\" { radius -2 }\n"),
    ("notes.txt", "a list of things to do"),
];

/// How long the window may take to save, busy with pictures as it may be.
const SOON: Duration = Duration::from_secs(5);

#[derive(Debug)]
enum Step {
    Keys(&'static str),
    Type(&'static str),
    Click { at: (usize, usize), button: &'static str, held: &'static str },
    Drag { from: (usize, usize), by: (i32, i32), button: &'static str, held: &'static str },
    Wheel { at: (usize, usize), button: &'static str },
    Drop(&'static str),
    Clip(&'static str),
    Resize(usize, usize),
    Leave(&'static str),
}

fn one_of<T: Copy>(random: &mut Random, all: &[T]) -> T {
    all[random.below(all.len())]
}

/// A place in the window: often in the panel, never on the menu of files.
fn place(random: &mut Random, (width, height): (usize, usize)) -> (usize, usize) {
    let panel = width.saturating_sub(272);
    let at = match random.below(3) {
        0 => (panel + random.below(272.min(width)), random.below(height)),
        _ => (random.below(width), random.below(height)),
    };
    let is_menu = at.0 >= panel && at.0 < panel + 70 && at.1 < 70;
    if is_menu { (at.0, height - 1) } else { at }
}

fn step(random: &mut Random, size: &mut (usize, usize)) -> Step {
    let keys: Vec<&'static str> = KEYS.split_whitespace().collect();
    let held = one_of(random, &["", "", "", "Shift_L", "Control_L"]);
    let way = |random: &mut Random| random.below(300) as i32 - 150;
    match random.below(100) {
        0..45 => Step::Keys(one_of(random, &keys)),
        45..55 => Step::Type(one_of(random, TYPED)),
        55..75 => {
            Step::Click { at: place(random, *size), button: one_of(random, &["1", "1", "1", "3", "2"]), held }
        }
        75..87 => {
            let by = (way(random), way(random));
            Step::Drag { from: place(random, *size), by, button: one_of(random, &["1", "1", "2", "3"]), held }
        }
        87..91 => Step::Wheel { at: place(random, *size), button: one_of(random, &["4", "5"]) },
        91..94 => Step::Drop(one_of(random, FILES).0),
        94..96 => Step::Clip(one_of(random, CLIPS)),
        96..98 => {
            let small = random.below(4) == 0;
            *size = if small { (200, 150) } else { (500 + random.below(700), 350 + random.below(350)) };
            Step::Resize(size.0, size.1)
        }
        _ => Step::Leave(one_of(random, LEAVING)),
    }
}

/// What was done, told when the test fails.
struct Story {
    seed: u64,
    steps: Vec<Step>,
}

impl Drop for Story {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let steps: Vec<String> = self.steps.iter().map(|step| format!("{step:?}")).collect();
            eprintln!("CATOPTRA_RANDOM_SEED={} did {} steps:\n{}", self.seed, steps.len(), steps.join("\n"));
        }
    }
}

/// A window that is being tried.
struct Trial {
    stage: Stage,
}

impl Trial {
    fn start() -> Option<Self> {
        let stage = Stage::start(Some(SCENE))?;
        let folder = stage.folder.path();
        for (name, text) in FILES {
            std::fs::write(folder.join(name), text).expect("a file to be dropped");
        }
        catoptra_scene::image::write_png(&folder.join("picture.png"), 1, 1, &[90, 60, 30])
            .expect("a picture");
        std::fs::write(folder.join("other.kdl"), SCENE.replace("radius 2", "radius 1"))
            .expect("another scene");
        Some(Self { stage })
    }

    fn file(&self) -> PathBuf {
        self.stage.folder.path().join("scene.kdl")
    }

    fn act(&mut self, step: &Step) {
        let stage = &self.stage;
        match *step {
            Step::Keys("Escape+Tab") => {
                stage.xdotool(&["key", "Escape", "Tab"]);
            }
            Step::Keys("b") => {
                stage.xdotool(&["keydown", "b", "sleep", "0.05", "keyup", "b"]);
            }
            Step::Keys(keys) => stage.key(keys),
            Step::Type(typed) => {
                stage.xdotool(&["type", "--delay", "3", typed]);
            }
            Step::Click { at, button, held } => {
                stage.point(at.0, at.1);
                stage.holding(held, || stage.press(button));
            }
            Step::Drag { from, by, button, held } => stage.holding(held, || stage.drag(from, by, button)),
            Step::Wheel { at, button } => stage.wheel(at.0, at.1, button, 2),
            Step::Drop(name) => stage.drop_file(&stage.folder.path().join(name)),
            Step::Clip(text) => stage.set_clipboard(text),
            Step::Resize(width, height) => stage.resize(width, height),
            Step::Leave(way) => self.leave(way),
        }
    }

    /// Tries to leave the scene and then stays, where that has edits which are not saved.
    fn leave(&mut self, way: &str) {
        self.escape();
        if !self.is_edited() {
            return;
        }
        let stage = &self.stage;
        match way {
            "close" => stage.close(),
            "drop" => stage.drop_file(&stage.folder.path().join("other.kdl")),
            "ctrl+o" => {
                stage.key(way);
                sleep(Duration::from_millis(100));
                stage.xdotool(&["type", "--delay", "3", "other.kdl"]);
                stage.key("Return");
            }
            key => stage.key(key),
        }
        sleep(Duration::from_millis(100));
        self.escape();
        assert!(self.stage.runs(), "{way} ended the viewer unasked");
        assert!(self.is_edited(), "{way} took edits away unasked");
    }

    fn escape(&self) {
        self.stage.xdotool(&["key", "--delay", "40", "Escape", "Escape", "Escape", "Escape"]);
        sleep(Duration::from_millis(100));
    }

    /// Whether the title says that the scene has edits which are not saved.
    fn is_edited(&self) -> bool {
        self.stage.title().starts_with("scene *")
    }

    fn assert_whole(&mut self) {
        let log = self.stage.log();
        assert!(!log.contains("panicked"), "the viewer said:\n{}", told(&log));
        assert!(self.stage.runs(), "the viewer has ended; it said:\n{}", told(&log));
    }

    /// Takes everything back and saves, until the file is what it was.
    fn undo_all(&mut self, inputs: usize) {
        self.stage.resize(SIZE.0, SIZE.1);
        self.escape();
        for _ in 0..inputs / 20 + 3 {
            self.stage.xdotool(&["key", "--repeat", "60", "--delay", "2", "ctrl+z"]);
            self.stage.key("ctrl+s");
            if self.is_as_it_was_soon() {
                return;
            }
        }
        let saved = std::fs::read_to_string(self.file()).expect("the scene");
        panic!("what was undone and saved is not what was opened:\n{saved}");
    }

    /// Whether the file holds soon what it held at first. Not as soon as the window is at rest: by the exact backend, which may
    /// have been chosen, that can take minutes.
    fn is_as_it_was_soon(&self) -> bool {
        let begin = Instant::now();
        while begin.elapsed() < SOON {
            if std::fs::read_to_string(self.file()).is_ok_and(|text| text == SCENE) {
                return true;
            }
            sleep(LOOK);
        }
        false
    }
}

/// What was logged, but for frames.
fn told(log: &str) -> String {
    log.lines().filter(|line| !line.starts_with("frame ")).collect::<Vec<_>>().join("\n")
}

fn number(variable: &str, usual: u64) -> u64 {
    std::env::var(variable).ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

#[test]
fn whatever_is_done_nothing_breaks_and_undo_takes_it_all_back() {
    let Some(mut trial) = Trial::start() else { return };
    let time = Duration::from_secs(number("CATOPTRA_RANDOM_SECONDS", 50));
    let mut story = Story { seed: number("CATOPTRA_RANDOM_SEED", 1), steps: Vec::new() };
    let (mut random, mut size, begin) = (Random::new(story.seed), SIZE, Instant::now());
    while begin.elapsed() < time {
        story.steps.push(step(&mut random, &mut size));
        trial.act(&story.steps[story.steps.len() - 1]);
        sleep(Duration::from_millis(random.below(40) as u64));
        if story.steps.len().is_multiple_of(16) {
            trial.assert_whole();
        }
    }
    trial.undo_all(story.steps.len());
    trial.assert_whole();
    eprintln!("{} steps from seed {}", story.steps.len(), story.seed);
}
