//! How sure are the pixels of a picture to be, and how sure have they become?

use catoptra_core::Settings;
use catoptra_tracer::{Pattern, Reached, Scale, Target, Tone};
use miette::{Result, miette};

use crate::args::RenderArgs;
use crate::console::warn;
use crate::job::Job;
use crate::output::Format;
use crate::words::counted;

/// How sure pixels are to be, by the options and the scene's settings; `None` for as many samples as are asked for.
pub(super) fn find_target(
    args: &RenderArgs,
    job: &Job,
    format: Option<Format>,
    tone: Tone,
) -> Result<Option<Target>> {
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
    let scale = match format {
        Some(Format::Exr) => Scale::Radiance,
        _ => Scale::Displayed(tone),
    };
    let most = if job.view.samples > 1 { job.view.samples } else { Settings::MAX_SAMPLES };
    Ok(Some(Target { max_error, scale, time: args.time, most }))
}

/// What a target has come to.
pub(super) fn reached_words(target: &Target, reached: &Reached) -> String {
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
