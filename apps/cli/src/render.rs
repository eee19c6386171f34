//! `catoptra render`: a picture of a scene, the time a frame takes, and counts.

use catoptra_tracer::{Cancelled, Control, Display, Film, Stats};
use miette::{Result, miette};

use crate::args::RenderArgs;
use crate::job::Job;
use crate::output::{Format, check_folder, print, write_film};
use crate::stats::{FrameTimes, write_stats};
use crate::suggest::unknown;
use crate::{Outcome, interrupt, progress};

/// Renders, measures and writes what is asked for.
pub(crate) fn run(args: &RenderArgs) -> Result<Outcome> {
    let display = check(args)?;
    let job = Job::new(&args.job)?;
    let control = interrupt::control();
    let mut film = job.film();
    let Ok((times, stats)) = frames(&job, args.repeat, &mut film, &control) else {
        eprintln!("interrupted: nothing is written");
        return Ok(Outcome::Interrupted);
    };
    if let Some(path) = &args.output {
        write_film(path, &film, display)?;
    }
    if let Some(path) = &args.stats {
        write_stats(path, &job, &times, &stats)?;
    }
    if args.repeat.is_some() {
        print(&summary(&job, &times))?;
    }
    Ok(Outcome::Done)
}

/// Refuses what cannot end well before any work is done; gives the display transform asked for.
fn check(args: &RenderArgs) -> Result<Display> {
    if args.output.is_none() && args.repeat.is_none() && args.stats.is_none() {
        return Err(miette!(
            help = "give --output FILE for a picture, --repeat N for times, or --stats FILE.json for counts",
            "there is nothing to do"
        ));
    }
    if let Some(path) = &args.output {
        Format::of(path)?;
    }
    for path in args.output.iter().chain(&args.stats) {
        check_folder(path)?;
    }
    let names: Vec<&str> = Display::ALL.iter().map(|display| display.name()).collect();
    Display::named(&args.display).ok_or_else(|| unknown("display transform", &args.display, &names))
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
