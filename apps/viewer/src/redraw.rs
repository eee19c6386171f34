//! What is drawn when? Each part only when it changed: egui's passes, the picture when a frame was finished, the
//! overlays when the picture, the scene or the selection changed.

use std::time::{Duration, Instant};

use catoptra_tracer::Size;

use crate::app::App;
use crate::canvas::{Pixels, Region};
use crate::fit::Fit;
use crate::pass::PASSES;
use crate::refine::Step;
use crate::screen::{Fitted, Screen};
use crate::status::{FrameFigures, REST, lamp_notes};
use crate::tracing::Frame;
use crate::viewer::Viewer;
use crate::{clipped, outline, panel, turns};

/// The status line is written anew this often while frames come in.
const STATUS_EVERY: Duration = Duration::from_millis(200);

/// How long a notice stands.
const NOTICE: Duration = Duration::from_secs(8);

impl App {
    /// Brings the window up to date.
    ///
    /// # Errors
    /// When the window cannot be drawn on.
    pub(crate) fn redraw(&mut self) -> Result<(), String> {
        let Some(mut screen) = self.screen.take() else { return Ok(()) };
        let outcome = self.redraw_on(&mut screen);
        self.screen = Some(screen);
        outcome
    }

    fn redraw_on(&mut self, screen: &mut Screen) -> Result<(), String> {
        let Some(Fitted { size, new: resized }) = screen.fit()? else { return Ok(()) };
        let now = Instant::now();
        let new_frame = self.take_frame(now);
        self.viewer.settings.style.scale = screen.pixels_per_point();
        let mut changed = if resized || self.exposed { Region::whole(size) } else { Region::NOTHING };
        self.exposed = false;
        if resized || self.viewer.stale.panel || self.is_due(screen, now) {
            changed = changed.union(self.show_egui(screen, now));
        }
        self.request_if_stale();
        if new_frame || self.viewer.stale.overlay || screen.canvas.size() != self.viewer.size {
            self.compose(screen);
            changed = changed.union(Region::whole(self.viewer.size));
        }
        let title = self.title();
        if self.shown_title != title {
            screen.window.set_title(&title);
            self.shown_title = title;
            // The scene was saved, or edited, or is another.
            self.watch_files();
        }
        screen.present(changed, &self.window_pool)
    }

    /// Whether egui asked for this moment, or the status line is out of date.
    fn is_due(&self, screen: &Screen, now: Instant) -> bool {
        [screen.due, self.status_due].into_iter().flatten().any(|due| due <= now)
    }

    fn show_egui(&mut self, screen: &mut Screen, now: Instant) -> Region {
        if self.viewer.notice.as_ref().is_some_and(|(_, since)| now.duration_since(*since) > NOTICE) {
            self.viewer.notice = None;
        }
        self.viewer.stale.panel = false;
        let line = self.status_line(now);
        let input = screen.input.take_egui_input(&screen.window);
        let mut room = egui::Rect::ZERO;
        let output = turns::run(&screen.egui, input, |ui| room = panel::show(ui, &mut self.viewer, &line));
        let scale = screen.pixels_per_point();
        let pixels = |points: f32| (points * scale).round().max(0.0) as u32;
        let size = (pixels(room.width()), pixels(room.height()));
        if size != self.viewer.size {
            self.viewer.size = size;
            self.viewer.stale.trace = true;
        }
        screen.take(output)
    }

    fn status_line(&mut self, now: Instant) -> String {
        let moving = self.last_frame.is_some_and(|last| now.duration_since(last) < REST);
        let notice_ends = self.viewer.notice.as_ref().map(|(_, since)| *since + NOTICE);
        self.status_due = if moving { Some(now + STATUS_EVERY) } else { notice_ends };
        let line = self.meter.line(self.pool.threads(), now);
        let (backend, mode) = (self.viewer.settings.backend.name(), self.viewer.settings.mode.name());
        let notes = lamp_notes(self.viewer.document.scene(), &self.viewer.latest.get());
        let exposure = self.viewer.settings.exposure.words();
        let pass =
            Some(self.viewer.settings.pass.name).filter(|_| self.viewer.settings.pass.name != PASSES[0].name);
        let shown: Vec<String> = pass.map(str::to_owned).into_iter().chain(exposure).collect();
        [&[line, backend.to_owned(), mode.to_owned()][..], &shown, &notes].concat().join("  ·  ")
    }

    /// Takes the newest frame from the worker; `false` if there is none.
    fn take_frame(&mut self, now: Instant) -> bool {
        let Some(finished) = self.worker.take() else { return false };
        let size = finished.frame.film.size();
        let figures = FrameFigures {
            took: finished.took,
            rays: finished.frame.rays,
            size: (size.width, size.height),
            step: finished.step,
            refined: finished.refined,
            is_last: finished.is_last,
        };
        let settings = self.viewer.document.scene().settings().exposure();
        if finished.frame.pass.paint.is_none() {
            self.viewer.expose(self.viewer.settings.exposure.followed(&finished.frame.film, settings));
        }
        self.viewer.readout.legend = finished.frame.numbers.as_ref().map(|of| (of.scale, of.unit));
        if self.options.log_frames {
            eprintln!("{}", figures.log_line());
        }
        self.meter.record(figures, now);
        self.last_frame = Some(now);
        if self.status_due.is_none_or(|due| due > now + STATUS_EVERY) {
            self.status_due = Some(now + STATUS_EVERY);
        }
        if let Some(old) = self.shown.replace(finished) {
            if old.frame.film.size().pixels() > size.pixels() {
                self.giving_back.expect(now);
            }
            self.worker.give_back(old.frame);
        }
        self.read_off(self.viewer.pointer.at);
        true
    }

    /// Reads off the picture what the pointer points to, if the pass has something to tell of it.
    pub(crate) fn read_off(&mut self, at: (f64, f64)) {
        let pointed = self
            .shown
            .as_ref()
            .filter(|_| self.over_picture)
            .and_then(|shown| self.pointed(&shown.frame, at));
        if pointed.is_some() || self.viewer.readout.pointed.is_some() {
            self.viewer.readout.pointed = pointed;
            self.viewer.stale.panel = true;
        }
    }

    fn pointed(&self, frame: &Frame, at: (f64, f64)) -> Option<String> {
        frame.pass.paint?;
        let Size { width, height } = frame.film.size();
        let (x, y) = Fit::new((width, height), frame.size).pixel(at)?;
        let name = frame.film.surface(x, y).and_then(|id| self.viewer.document.scene().name(id))?;
        let pixel = y as usize * width as usize + x as usize;
        Some(frame.numbers.as_ref().map_or_else(|| name.clone(), |numbers| numbers.words(pixel, &name)))
    }

    /// Lays out the newest frame and draws outline and overlays over it.
    fn compose(&mut self, screen: &mut Screen) {
        self.viewer.stale.overlay = false;
        let size = self.viewer.size;
        let Some(shown) = &mut self.shown else {
            screen.canvas.lay(&Pixels::default(), size, &self.window_pool);
            return;
        };
        if shown.frame.tone != self.viewer.tone() {
            shown.frame.encode(self.viewer.tone(), &self.window_pool);
        }
        let frame = &shown.frame;
        let (viewer, overlays, pool) = (&self.viewer, &mut self.overlays, &self.window_pool);
        let film = Some(&*frame.film).filter(|_| frame.size == size);
        let shows_overlays = is_any_shown(viewer);
        pool.run(|| {
            rayon::join(
                || screen.canvas.lay(&frame.pixels, size, pool),
                || {
                    if shows_overlays {
                        overlays.follow(viewer.overlay(&frame.camera), film, shown.generation);
                    }
                },
            )
        });
        let picture = screen.canvas.picture_mut();
        let in_full = (shown.step == Step::FULL).then_some(&frame.pixels);
        let tone = self.viewer.tone();
        self.viewer.comparison.lay_over(in_full, picture, (tone, &self.window_pool));
        let marks = self.viewer.settings.marks_clipped && frame.pass.paint.is_none();
        let clipped = marks.then(|| clipped::mark(picture));
        self.viewer.stale.panel |=
            clipped != self.viewer.readout.clipped || self.viewer.comparison.file().is_some();
        self.viewer.readout.clipped = clipped;
        let selection = &self.viewer.selection;
        if frame.size == size && !selection.is_empty() {
            let scene = self.viewer.document.scene();
            let width = self.viewer.settings.style.scale.round().max(1.0) as u32 * 2;
            outline::draw(&frame.film, width, |s| selection.covers(scene, s), picture);
        }
        if shows_overlays {
            self.overlays.lay_over(&mut picture.data);
        }
    }

    fn title(&self) -> String {
        let saved = if self.viewer.document.is_saved() { "" } else { " *" };
        format!("{}{saved} - catoptra", self.viewer.document.name())
    }
}

/// Whether any overlay is switched on that could show something.
fn is_any_shown(viewer: &Viewer) -> bool {
    let style = viewer.settings.style;
    let scene = style.grid || style.axes || style.lights || style.cones || style.cameras;
    viewer.shown.overlays && (scene || (style.selection && !viewer.selection.is_empty()))
}
