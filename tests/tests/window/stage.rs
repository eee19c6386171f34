//! Where the viewer is put to be tried: a virtual screen of its own, a folder of its own, and a hand on mouse and keys.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::clipboard;
use crate::desktop;
use crate::picture::Picture;
use crate::programs::{self, LOOK};

/// How long anything may take before the test fails.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);

/// How long the window must stay the same to count as settled. What a test awaits it names itself ([`Stage::until`]);
/// this only tells apart a state in between from the one that stays.
const SETTLED: Duration = Duration::from_millis(150);

/// The viewer's size at the start, in pixels; its panel takes the right 272.
pub(crate) const SIZE: (usize, usize) = (900, 600);

/// The picture's part of that.
pub(crate) const PICTURE: (usize, usize) = (SIZE.0 - 272, SIZE.1);

/// A running viewer on a virtual screen.
pub(crate) struct Stage {
    viewer: Child,
    screen: Child,
    display: String,
    scale: u32,
    window: String,
    /// The folder that the viewer runs in.
    pub(crate) folder: tempfile::TempDir,
    buffer: tempfile::TempDir,
}

impl Stage {
    /// Starts the viewer on a scene with that text, or on its own scene. `None` where the machine lacks a program;
    /// that is said, and a failure when the environment demands windows.
    pub(crate) fn start(scene: Option<&str>) -> Option<Self> {
        Self::start_scaled(scene, 1)
    }

    /// As [`start`](Self::start), on a screen with that many pixels to a point.
    pub(crate) fn start_scaled(scene: Option<&str>, scale: u32) -> Option<Self> {
        if !programs::are_there() {
            return None;
        }
        let folder = tempfile::tempdir().expect("a folder");
        let buffer = tempfile::tempdir().expect("a folder");
        let (screen, display) = programs::open_screen(buffer.path());
        if let Some(text) = scene {
            std::fs::write(folder.path().join("scene.kdl"), text).expect("the scene is written");
        }
        let viewer = open_viewer(folder.path(), &display, scale, scene.map(|_| "scene.kdl"));
        let mut stage = Self { viewer, screen, display, scale, window: String::new(), folder, buffer };
        stage.begin();
        Some(stage)
    }

    /// Starts the viewer anew after its end, on a file of the folder or on its own scene.
    pub(crate) fn restart(&mut self, file: Option<&str>) {
        self.viewer = open_viewer(self.folder.path(), &self.display, self.scale, file);
        self.begin();
    }

    fn begin(&mut self) {
        self.window = self.find_window();
        self.xdotool(&["windowfocus", &self.window]);
        self.wait("a first picture in full", |stage| stage.log().contains(" 1/1"));
        self.settle();
    }

    fn find_window(&self) -> String {
        let mut found = String::new();
        self.wait("the window", |stage| {
            found = stage.xdotool(&["search", "--onlyvisible", "--name", "catoptra"]);
            !found.is_empty()
        });
        found.lines().next().unwrap_or_default().to_owned()
    }

    /// Runs xdotool and answers what it says.
    pub(crate) fn xdotool(&self, arguments: &[&str]) -> String {
        let output = Command::new("xdotool").args(arguments).env("DISPLAY", &self.display).output();
        String::from_utf8_lossy(&output.expect("xdotool runs").stdout).trim().to_owned()
    }

    /// Presses a key.
    pub(crate) fn key(&self, key: &str) {
        self.xdotool(&["key", key]);
    }

    /// Clicks there with the left button.
    pub(crate) fn click(&self, x: usize, y: usize) {
        self.point(x, y);
        self.press("1");
    }

    /// Presses a button where the pointer is.
    pub(crate) fn press(&self, button: &str) {
        self.xdotool(&["click", button]);
    }

    /// Does something while a key is held; none if that is empty.
    pub(crate) fn holding(&self, key: &str, act: impl FnOnce()) {
        if key.is_empty() {
            return act();
        }
        self.xdotool(&["keydown", key]);
        act();
        self.xdotool(&["keyup", key]);
    }

    /// The window's title.
    pub(crate) fn title(&self) -> String {
        self.xdotool(&["getwindowname", &self.window])
    }

    /// Moves the pointer.
    pub(crate) fn point(&self, x: usize, y: usize) {
        self.xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
    }

    /// Turns the wheel over that place; 4 is away from the person, 5 towards.
    pub(crate) fn wheel(&self, x: usize, y: usize, button: &str, notches: u32) {
        self.point(x, y);
        self.xdotool(&["click", "--repeat", &notches.to_string(), "--delay", "30", button]);
    }

    /// Drags with a button, in ten steps.
    pub(crate) fn drag(&self, from: (usize, usize), by: (i32, i32), button: &str) {
        let [x, y] = [from.0, from.1].map(|at| at.to_string());
        let [right, down] = [by.0, by.1].map(|by| (by / 10).to_string());
        let mut hand = vec!["mousemove", &x, &y, "mousedown", button];
        for _ in 0..10 {
            hand.extend(["mousemove_relative", "--", &right, &down, "sleep", "0.01"]);
        }
        hand.extend(["mouseup", button]);
        self.xdotool(&hand);
    }

    /// Makes the window another size.
    pub(crate) fn resize(&self, width: usize, height: usize) {
        self.xdotool(&["windowsize", &self.window, &width.to_string(), &height.to_string()]);
    }

    /// Takes the window off the screen, as minimising does.
    pub(crate) fn hide(&self) {
        self.xdotool(&["windowunmap", "--sync", &self.window]);
    }

    /// Puts the window back on the screen.
    pub(crate) fn show(&self) {
        self.xdotool(&["windowmap", "--sync", &self.window]);
    }

    /// What the screen shows.
    pub(crate) fn picture(&self) -> Picture {
        Picture::read(&self.buffer_file()).expect("a screenshot")
    }

    fn buffer_file(&self) -> PathBuf {
        self.buffer.path().join("Xvfb_screen0")
    }

    /// Presses the window's close button.
    pub(crate) fn close(&self) {
        desktop::close(&self.display, self.window_id()).expect("the button can be pressed");
    }

    /// Drops a file on the window.
    pub(crate) fn drop_file(&self, file: &Path) {
        desktop::drop_file(&self.display, self.window_id(), file).expect("the file can be dropped");
    }

    /// Tells the viewer to end, as a system does that shuts down.
    pub(crate) fn tell_to_end(&self) {
        let told = Command::new("kill").arg(self.viewer.id().to_string()).status();
        assert!(told.is_ok_and(|status| status.success()), "the viewer is told");
    }

    /// Ends the viewer as a system does that is out of memory: it cannot do anything any more.
    pub(crate) fn kill(&mut self) {
        self.viewer.kill().expect("the viewer can be killed");
        self.viewer.wait().expect("it ends");
    }

    /// The text on the clipboard.
    pub(crate) fn clipboard(&self) -> String {
        clipboard::read(&self.display).expect("the clipboard can be read")
    }

    /// Puts a text on the clipboard, as an editor does.
    pub(crate) fn set_clipboard(&self, text: &str) {
        clipboard::put(&self.display, text).expect("the clipboard can be owned");
    }

    fn window_id(&self) -> u32 {
        self.window.parse().expect("xdotool names windows by number")
    }

    /// Waits until the picture is refined and neither it nor anything else on the screen changes.
    pub(crate) fn settle(&self) -> Picture {
        let (begin, mut since, mut last) = (Instant::now(), Instant::now(), None);
        while since.elapsed() < SETTLED {
            assert!(begin.elapsed() < PATIENCE, "the window does not settle");
            sleep(LOOK);
            let log = self.log();
            let now = (log.len(), std::fs::read(self.buffer_file()).ok());
            if last.as_ref() != Some(&now) || !log.trim_end().ends_with(" at rest") {
                since = Instant::now();
                last = Some(now);
            }
        }
        self.picture()
    }

    /// Waits until the screen shows something, and answers what it shows then.
    pub(crate) fn until(&self, what: &str, mut shown: impl FnMut(&Picture) -> bool) -> Picture {
        let mut found = None;
        self.wait(what, |stage| {
            found = Picture::read(&stage.buffer_file()).filter(&mut shown);
            found.is_some()
        });
        found.unwrap_or_else(|| unreachable!("it was waited for"))
    }

    /// Waits for something to become true.
    pub(crate) fn wait(&self, what: &str, mut done: impl FnMut(&Self) -> bool) {
        let begin = Instant::now();
        while !done(self) {
            let failed = begin.elapsed() > PATIENCE || self.log().contains("error:");
            assert!(!failed, "{what} did not come; the viewer said:\n{}", self.log());
            sleep(LOOK);
        }
    }

    /// What the viewer has written on stderr.
    pub(crate) fn log(&self) -> String {
        std::fs::read_to_string(self.folder.path().join("log")).unwrap_or_default()
    }

    /// How many frames it has logged.
    pub(crate) fn frames(&self) -> usize {
        self.log().lines().filter(|line| line.starts_with("frame ")).count()
    }

    /// Processor time used so far, in ticks.
    pub(crate) fn ticks(&self) -> u64 {
        let stat =
            std::fs::read_to_string(format!("/proc/{}/stat", self.viewer.id())).expect("a running viewer");
        let after_name = stat.rsplit(')').next().unwrap_or_default();
        let fields: Vec<u64> = after_name.split_whitespace().map(|f| f.parse().unwrap_or(0)).collect();
        fields[11] + fields[12]
    }

    /// Whether the viewer still runs.
    pub(crate) fn runs(&mut self) -> bool {
        matches!(self.viewer.try_wait(), Ok(None))
    }

    /// Waits for the viewer's end; its exit code.
    pub(crate) fn exit_code(&mut self) -> Option<i32> {
        let begin = Instant::now();
        loop {
            if let Ok(Some(status)) = self.viewer.try_wait() {
                return status.code();
            }
            assert!(begin.elapsed() < PATIENCE, "the viewer does not end");
            sleep(LOOK);
        }
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        programs::end(&mut self.viewer);
        programs::end(&mut self.screen);
    }
}

/// Starts the viewer in a folder; what it remembers is in that folder too.
fn open_viewer(folder: &Path, display: &str, scale: u32, file: Option<&str>) -> Child {
    let mut command = Command::new(programs::viewer());
    let (width, height) = (SIZE.0 / scale as usize, SIZE.1 / scale as usize);
    command.args(["--log-frames", "--threads", "2", "--size", &format!("{width}x{height}")]);
    command.args(file);
    command.current_dir(folder).env("DISPLAY", display).env_remove("WAYLAND_DISPLAY");
    command.env("WINIT_X11_SCALE_FACTOR", scale.to_string()).env("XDG_STATE_HOME", folder.join("state"));
    command.stderr(File::create(folder.join("log")).expect("a log"));
    command.spawn().expect("the viewer starts")
}
