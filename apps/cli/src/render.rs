//! `catoptra render`: a picture of a scene, the time a frame takes, and counts.

use std::path::Path;

use catoptra_core::Settings;
use catoptra_scene::atomic::is_straight;
use catoptra_tracer::{Cancelled, Control, Display, Film, Pattern, Reached, Scale, Target, Tone};
use miette::{Result, miette};

use crate::args::{RenderArgs, STDOUT};
use crate::console::{check_heard, print, say, warn};
use crate::destination::{Output, check_apart, check_writable};
use crate::film::KeptFilm;
use crate::job::{Frame, Job, Means, scene_input};
use crate::output::{Format, write_film};
use crate::stats::{FrameTimes, write_stats};
use crate::suggest::unknown;
use crate::words::counted;
use crate::{Outcome, interrupt, progress};

/// Renders, measures and writes what is asked for.
pub(crate) fn run(args: &RenderArgs) -> Result<Outcome> {
    let (means, display) = (Means::of(&args.job)?, find_display(args.display.as_deref())?);
    let outputs = outputs(args);
    check(args, &outputs)?;
    let mut job = Job::new(&args.job, means, &outputs)?;
    warn_of_idle(args);
    let tone = display.exposed(args.exposure.unwrap_or(job.scene.settings().exposure()));
    job.target = find_target(args, &job, tone)?;
    job.warn_of_idle(&args.job);
    let control = interrupt::control();
    let Some((film, times, frame)) = trace(args, &job, &control)? else {
        return Ok(Outcome::Interrupted);
    };
    if let (Some(target), Some(reached)) = (&job.target, &frame.reached) {
        say(&reached_words(target, reached));
    }
    let write = || {
        args.output.as_deref().map_or(Ok(()), |path| write_film(path, &film, tone))?;
        args.stats.as_deref().map_or(Ok(()), |path| write_stats(path, &job, &times, &frame))
    };
    if outputs.iter().any(|(_, path)| is_straight(path)) {
        let Some(written) = interrupt::while_waiting(&control, write) else {
            return Ok(Outcome::Interrupted);
        };
        written?;
    } else {
        write()?;
    }
    if args.repeat.is_some() {
        print(&summary(&job, &times))?;
    }
    Ok(Outcome::Done)
}

/// Traces what is asked for; `None` where that was interrupted, and said so.
fn trace(args: &RenderArgs, job: &Job, control: &Control) -> Result<Option<(Film, FrameTimes, Frame)>> {
    if let Some(path) = &args.film {
        let mut kept = KeptFilm::open(job, path, args.time)?;
        let done = kept.go_on(control)?;
        return Ok(done.map(|(time, frame)| (kept.film, FrameTimes::of(vec![time]), frame)));
    }
    let mut film = job.film()?;
    let Ok((times, frame)) = frames(job, args.repeat, &mut film, control) else {
        say("interrupted: nothing is written");
        return Ok(None);
    };
    Ok(Some((film, times, frame)))
}

/// The files that are to be written.
fn outputs(args: &RenderArgs) -> Vec<Output<'_>> {
    let picture = args.output.as_deref().map(|path| ("--output", path));
    let stats = args.stats.as_deref().map(|path| ("--stats", path));
    let film = args.film.as_deref().map(|path| ("--film", path));
    picture.into_iter().chain(stats).chain(film).collect()
}

/// Refuses what cannot end well before any work is done.
fn check(args: &RenderArgs, outputs: &[Output<'_>]) -> Result<()> {
    match (outputs, args.repeat) {
        ([], None) => {
            return Err(miette!(
                help =
                    "give --output FILE for a picture, --repeat N for times, or --stats FILE.json for counts",
                "there is nothing to do"
            ));
        }
        ([], Some(_)) => check_heard()?,
        _ if outputs.iter().any(|(_, path)| *path == Path::new(STDOUT)) => check_heard()?,
        _ => {}
    }
    if let Some(path) = &args.output {
        Format::of(path)?;
    }
    check_apart(outputs, &[scene_input(&args.job.scene)])?;
    check_writable(outputs)
}

fn find_display(name: Option<&str>) -> Result<Display> {
    let Some(name) = name else { return Ok(Display::default()) };
    let names: Vec<&str> = Display::ALL.iter().map(|display| display.name()).collect();
    Display::named(name).ok_or_else(|| unknown("display transform", name, &names))
}

/// How sure pixels are to be, by the options and the scene's settings; `None` for as many samples as are asked for.
fn find_target(args: &RenderArgs, job: &Job, tone: Tone) -> Result<Option<Target>> {
    let max_error = args.max_error.or(job.scene.settings().max_error());
    if args.film.is_some() && max_error.is_some() {
        warn("--film samples all pixels alike: the scene's max-error changes nothing");
    }
    if args.film.is_some() || (max_error.is_none() && args.time.is_none()) {
        return Ok(None);
    }
    if args.job.pattern.is_some() && job.view.pattern != Pattern::Owen {
        return Err(miette!(
            help = "leave --pattern away, or ask for --samples without a target",
            "only the pattern owen tells how sure a pixel is, not {}",
            job.view.pattern.name()
        ));
    }
    if let Some(samples) = args.job.samples.filter(|samples| *samples < Target::LEAST) {
        return Err(miette!(
            help = "with --max-error or --time, --samples is the most that a pixel may take",
            "errors are judged by {} samples or more, not {samples}",
            Target::LEAST
        ));
    }
    let scale = match args.output.as_deref().map(Format::of) {
        Some(Ok(Format::Exr)) => Scale::Radiance,
        _ => Scale::Displayed(tone),
    };
    let most = if job.view.samples > 1 { job.view.samples } else { Settings::MAX_SAMPLES };
    Ok(Some(Target { max_error, scale, time: args.time, most }))
}

/// What a target has come to.
fn reached_words(target: &Target, reached: &Reached) -> String {
    let Reached { fewest, mean, most, error, unfinished, .. } = reached;
    let missed = match (target.max_error, unfinished) {
        (Some(max_error), 1..) => {
            format!("; {} above {max_error}", counted(*unfinished, "pixel"))
        }
        _ => String::new(),
    };
    format!(
        "{fewest} to {most} samples a pixel, {mean:.1} in the mean; standard errors up to {error:.2e}{missed}"
    )
}

/// Says which options change nothing.
fn warn_of_idle(args: &RenderArgs) {
    let given = [("--display", args.display.is_some()), ("--exposure", args.exposure.is_some())];
    for (option, _) in given.iter().filter(|(_, given)| *given) {
        match args.output.as_deref().map(|path| (path, Format::of(path))) {
            None if args.max_error.is_some() => {}
            None => warn(&format!("{option} changes nothing: no picture is written without --output")),
            Some((path, Ok(Format::Exr))) => {
                warn(&format!("{option} changes nothing: {} holds linear light", path.display()));
            }
            Some(_) => {}
        }
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
