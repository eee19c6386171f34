//! `catoptra render`: pictures of scenes, the time a frame takes, and counts.

mod names;
mod picture;
mod plan;
mod target;
mod turntable;

use std::path::Path;

use catoptra_scene::atomic::is_straight;
use catoptra_tracer::{Cancelled, Control, Film, Moments};
use miette::{Result, miette};

use crate::args::RenderArgs;
use crate::console::{detail, print, say, warn};
use crate::film::KeptFilm;
use crate::job::{Frame, Job, Means, Resources, placed_camera};
use crate::output::Format;
use crate::pool::milliseconds_since;
use crate::stats::{FrameTimes, Stages, write_stats};
use crate::words::{counted, percent};
use crate::{Outcome, interrupt, progress};
use picture::{Looks, Picture};
use plan::{Plan, Shot, plan};
use target::{find_target, reached_words};
use turntable::{Turntable, middle_of};

/// Renders, measures and writes what is asked for.
pub(crate) fn run(args: &RenderArgs) -> Result<Outcome> {
    let (means, looks) = (Means::of(&args.job)?, Looks::of(&args.picture)?);
    let turn = args.frames.zip(args.turn.as_deref());
    let table = turn.map(|(frames, turn)| Turntable::new(frames, turn)).transpose()?;
    plan::check(args)?;
    let resources = Resources::claim(&args.job, |size| looks.bytes_of(size))?;
    let plans = plan(args, &looks, table.as_ref())?;
    warn_of_idle(args, &looks);
    let control = interrupt::control();
    for Plan { loaded, shots } in plans {
        let Some(first) = shots.first() else { continue };
        let job = Job::new(&args.job, means, &resources, loaded, first.camera)?;
        let mut scene = SceneShots { args, looks: &looks, table: table.as_ref(), job, control: &control };
        for (at, shot) in shots.iter().enumerate() {
            scene.turn_to(shot)?;
            if at == 0 {
                scene.job.warn_of_idle(&args.job);
            }
            if shots.len() > 1 {
                detail(&shot.words);
            }
            if let Outcome::Interrupted = scene.make(shot)? {
                return Ok(Outcome::Interrupted);
            }
        }
    }
    Ok(Outcome::Done)
}

/// The pictures of one scene, made one after another.
struct SceneShots<'a> {
    args: &'a RenderArgs,
    looks: &'a Looks,
    table: Option<&'a Turntable>,
    job: Job,
    control: &'a Control,
}

/// What tracing has come to.
enum Traced {
    Whole(Film, FrameTimes, Box<Frame>),
    /// It was interrupted.
    Part(Film),
}

impl SceneShots<'_> {
    /// Looks at the scene as a picture shows it.
    fn turn_to(&mut self, shot: &Shot) -> Result<()> {
        self.job.look_through(shot.camera)?;
        if let Some((table, frame)) = self.table.zip(shot.frame) {
            let camera = placed_camera(&self.job.scene, shot.camera)?;
            let about = middle_of(&self.job.scene, &camera);
            self.job.view.camera = table.camera(&camera, about, frame)?;
            self.job.turned = Some(table.words(frame));
        }
        let format = shot.files.picture.as_deref().map(|path| self.looks.format_of(path)).transpose()?;
        let stops = self.args.picture.exposure.unwrap_or(self.job.scene.settings().exposure());
        self.job.tone = self.looks.display.exposed(stops);
        self.job.target = find_target(self.args, &self.job, format, self.job.tone)?;
        self.job.view.moments = if self.looks.tells_errors() { Moments::Channels } else { Moments::None };
        if self.looks.tells_errors() && self.job.target.is_none() {
            self.check_errors()?;
        }
        Ok(())
    }

    /// Refuses to tell errors that nobody knows.
    fn check_errors(&self) -> Result<()> {
        if self.args.film.is_some() {
            return Err(miette!("--layers error does not go with --film, which keeps no errors"));
        }
        if self.job.view.samples < 2 {
            let help = "ask for more --samples, or for --max-error or --time";
            return Err(miette!(help = help, "--layers error needs two samples a pixel or more"));
        }
        Ok(())
    }

    /// Traces a picture and writes what is asked for.
    fn make(&self, shot: &Shot) -> Result<Outcome> {
        let (job, control) = (&self.job, self.control);
        let (film, times, frame) = match self.trace(shot)? {
            Traced::Whole(film, times, frame) => (film, times, frame),
            Traced::Part(film) => return self.keep(shot, &film),
        };
        if let (Some(target), Some(reached)) = (&job.target, &frame.reached) {
            say(&reached_words(target, reached));
        }
        detail(&format!("traced {} in {:.1} ms", counted(frame.stats.rays.total(), "ray"), times.median));
        let mut stages =
            Stages { load: job.load_ms, snapshot: job.build_ms, trace: times.median, ..Stages::default() };
        if let Some(path) = shot.files.picture.as_deref() {
            let (written, layers_and_write) = self.write(path, &film, times.median)?;
            if !written {
                return Ok(Outcome::Interrupted);
            }
            [stages.layers, stages.write] = layers_and_write;
        }
        if let Some(path) = shot.files.stats.as_deref() {
            let write = || write_stats(path, job, (&times, &stages), &frame);
            let Some(written) = waiting(path, control, write) else { return Ok(Outcome::Interrupted) };
            written?;
        }
        if self.args.repeat.is_some() {
            print(&summary(job, &times))?;
        }
        Ok(Outcome::Done)
    }

    /// Traces what is asked for.
    fn trace(&self, shot: &Shot) -> Result<Traced> {
        let (job, control) = (&self.job, self.control);
        if let Some(path) = &shot.files.film {
            let mut kept = KeptFilm::open(job, path, self.args.time)?;
            return Ok(match kept.go_on(control)? {
                Some((time, frame)) => Traced::Whole(kept.film, FrameTimes::of(vec![time]), frame.into()),
                None => Traced::Part(kept.film),
            });
        }
        let mut film = job.film()?;
        Ok(match frames(job, self.args.repeat, &mut film, control) {
            Ok((times, frame)) => Traced::Whole(film, times, frame.into()),
            Err(Cancelled) => Traced::Part(film),
        })
    }

    /// Writes a picture: whether it was, and the milliseconds of its layers and of writing.
    fn write(&self, path: &Path, film: &Film, milliseconds: f64) -> Result<(bool, [f64; 2])> {
        let started = std::time::Instant::now();
        let job = &self.job;
        let picture = Picture::of((job, film), self.looks, path, (job.tone, milliseconds), self.control)?;
        let layers = milliseconds_since(started);
        let Some(picture) = picture else {
            say("interrupted: nothing is written");
            return Ok((false, [layers, 0.0]));
        };
        let Some(written) = waiting(path, self.control, || picture.write(path)) else {
            return Ok((false, [layers, 0.0]));
        };
        written?;
        let write = milliseconds_since(started) - layers;
        if plan::writes_usual(self.args) {
            say(&format!("wrote {}", path.display()));
        } else {
            detail(&format!("wrote {} in {write:.1} ms", path.display()));
        }
        Ok((true, [layers, write]))
    }

    /// Writes what there is of a picture that was interrupted, where that is asked for.
    fn keep(&self, shot: &Shot, film: &Film) -> Result<Outcome> {
        let wanted = shot.files.picture.as_deref().filter(|_| self.args.keep_partial);
        let (done, all) = traced_pixels(film);
        let Some(path) = wanted.filter(|_| done > 0) else {
            if shot.files.film.is_none() {
                say("interrupted: nothing is written");
            }
            return Ok(Outcome::Interrupted);
        };
        // What was asked for when nobody had interrupted yet is asked for still.
        let go_on = Control::default();
        let tone = (self.job.tone, 0.0);
        if let Some(picture) = Picture::of((&self.job, film), self.looks, path, tone, &go_on)? {
            waiting(path, &go_on, || picture.write(path)).transpose()?;
        }
        say(&format!("interrupted: {} holds {} of the picture", path.display(), percent(done, all)));
        Ok(Outcome::Interrupted)
    }
}

/// How many pixels have samples, and how many there are.
fn traced_pixels(film: &Film) -> (u64, u64) {
    let size = film.size();
    let pixels = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
    (pixels.filter(|(x, y)| film.samples(*x, *y) > 0).count() as u64, size.pixels() as u64)
}

/// Does what writes to a path; where that may wait for others, an interruption ends it. `None` where there was one before.
fn waiting<T>(path: &Path, control: &Control, write: impl FnOnce() -> T) -> Option<T> {
    if is_straight(path) { interrupt::while_waiting(control, write) } else { Some(write()) }
}

/// Says which options change nothing.
fn warn_of_idle(args: &RenderArgs, looks: &Looks) {
    let (given, exists) = (&args.picture, args.picture.output.is_some() || plan::writes_usual(args));
    let format = given.output.as_deref().map_or_else(|| Ok(looks.usual()), |path| looks.format_of(path));
    let is_exr = format.is_ok_and(|format| format == Format::Exr);
    let name =
        given.output.as_deref().map_or_else(|| "an .exr".to_owned(), |path| path.display().to_string());
    for (option, _) in [("--display", given.display.is_some()), ("--exposure", given.exposure.is_some())]
        .iter()
        .filter(|(_, given)| *given)
    {
        match (exists, is_exr) {
            (false, _) if args.max_error.is_some() => {}
            (false, _) => warn(&format!("{option} changes nothing: no picture is written without --output")),
            (true, true) => warn(&format!("{option} changes nothing: {name} holds linear light")),
            (true, false) => {}
        }
    }
    let of_exr = [
        ("--layers", !given.layers.is_empty()),
        ("--compression", given.compression.is_some()),
        ("--reproducible", given.reproducible),
    ];
    for (option, _) in of_exr.iter().filter(|(_, given)| *given && !(exists && is_exr)) {
        warn(&format!("{option} changes nothing: no .exr is written"));
    }
    if given.force && !plan::writes_usual(args) {
        warn("--force changes nothing: what options name is written over without it");
    }
    if args.keep_partial && !exists {
        warn("--keep-partial changes nothing: no picture is written without --output");
    }
}

/// One frame, or a warm-up and as many as are to be timed.
fn frames(
    job: &Job,
    repeat: Option<u32>,
    film: &mut Film,
    control: &Control,
) -> Result<(FrameTimes, Frame), Cancelled> {
    let (first, mut last) = progress::while_showing(control, || job.frame(film, control))?;
    let Some(count) = repeat else {
        return Ok((FrameTimes::of(vec![first]), last));
    };
    let mut times = Vec::new();
    for _ in 0..count {
        let (time, frame) = job.frame(film, control)?;
        times.push(time);
        last = frame;
    }
    Ok((FrameTimes::of(times), last))
}

/// The line that `--repeat` prints.
fn summary(job: &Job, times: &FrameTimes) -> String {
    let size = job.view.region().size;
    format!(
        "{} {}x{} threads {} {} {}: min {:.2} ms median {:.2} ms over {} frames\n",
        job.scene_name,
        size.width,
        size.height,
        job.pool.threads(),
        job.backend.name(),
        job.backend.level(&job.view),
        times.min,
        times.median,
        times.frames
    )
}

/// The command that this program was started with, as a shell would take it.
fn command_line() -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:,=+@%".contains(c);
    let word = |word: std::ffi::OsString| {
        let word = word.to_string_lossy().into_owned();
        let plain = !word.is_empty() && word.chars().all(is_plain);
        if plain { word } else { format!("'{}'", word.replace('\'', r"'\''")) }
    };
    let program = std::iter::once("catoptra".to_owned());
    program.chain(std::env::args_os().skip(1).map(word)).collect::<Vec<_>>().join(" ")
}
