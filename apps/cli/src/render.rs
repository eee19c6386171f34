//! `catoptra render`: a picture of a scene, the time a frame takes, and counts.

use std::path::Path;

use catoptra_scene::atomic::is_straight;
use catoptra_tracer::{Cancelled, Control, Display, Film, Stats};
use miette::{Result, miette};

use crate::args::{RenderArgs, STDOUT};
use crate::console::{check_heard, print, say, warn};
use crate::destination::{Output, check_apart, check_writable};
use crate::job::{Job, Means, scene_input};
use crate::output::{Format, write_film};
use crate::stats::{FrameTimes, write_stats};
use crate::suggest::unknown;
use crate::{Outcome, interrupt, progress};

/// Renders, measures and writes what is asked for.
pub(crate) fn run(args: &RenderArgs) -> Result<Outcome> {
    let (means, display) = (Means::of(&args.job)?, find_display(args.display.as_deref())?);
    let outputs = outputs(args);
    check(args, &outputs)?;
    let job = Job::new(&args.job, means, &outputs)?;
    warn_of_idle(args);
    let control = interrupt::control();
    let mut film = job.film()?;
    let Ok((times, stats)) = frames(&job, args.repeat, &mut film, &control) else {
        say("interrupted: nothing is written");
        return Ok(Outcome::Interrupted);
    };
    let write = || {
        args.output.as_deref().map_or(Ok(()), |path| write_film(path, &film, display))?;
        args.stats.as_deref().map_or(Ok(()), |path| write_stats(path, &job, &times, &stats))
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

/// The files that are to be written.
fn outputs(args: &RenderArgs) -> Vec<Output<'_>> {
    let picture = args.output.as_deref().map(|path| ("--output", path));
    let stats = args.stats.as_deref().map(|path| ("--stats", path));
    picture.into_iter().chain(stats).collect()
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

/// Says which options change nothing.
fn warn_of_idle(args: &RenderArgs) {
    match args.output.as_deref().map(|path| (path, Format::of(path))) {
        _ if args.display.is_none() => {}
        None => warn("--display changes nothing: no picture is written without --output"),
        Some((path, Ok(Format::Exr))) => {
            warn(&format!("--display changes nothing: {} holds linear light", path.display()));
        }
        Some(_) => {}
    }
}

/// One frame, or a warm-up and as many as are to be timed.
fn frames(
    job: &Job,
    repeat: Option<u32>,
    film: &mut Film,
    control: &Control,
) -> Result<(FrameTimes, Stats), Cancelled> {
    let (first, mut stats) = progress::while_showing(control, || job.frame(film, control))?;
    let Some(count) = repeat else {
        return Ok((FrameTimes::of(vec![first]), stats));
    };
    let mut times = Vec::new();
    for _ in 0..count {
        let (time, of_frame) = job.frame(film, control)?;
        times.push(time);
        stats = of_frame;
    }
    Ok((FrameTimes::of(times), stats))
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
