//! `catoptra probe`: how much light arrives at points of a scene, or on a plane of it?

mod digits;
mod map;
mod plane;
mod points;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::Integrator;
use catoptra_scene::atomic::is_straight;
use catoptra_tracer::{Control, Irradiance, ProbeOptions, Receiver, Snapshot, irradiance_at};
use clap::Args;
use miette::{Result, miette};

use crate::args::STANDARD;
use crate::console::{check_heard, print_answer, say, warn};
use crate::destination::{Output, check_apart, check_writable};
use crate::loaded::{Loaded, file_name, scene_input};
use crate::names::find_integrator;
use crate::output::{Format, write_map};
use crate::pool::new_pool;
use crate::rows::Rows;
use crate::{Outcome, interrupt, progress};
pub(crate) use map::Map;
use plane::{Plan, Plane};

#[derive(Args)]
pub(crate) struct ProbeArgs {
    /// Scene file (.kdl), or - for standard input
    scene: PathBuf,
    /// File with a point and a normal of any length a line, `x y z nx ny nz`, or - for standard input; blank lines and those that
    /// begin with # pass through
    #[arg(required_unless_present = "plane", conflicts_with = "plane")]
    points: Option<PathBuf>,
    /// What light counts: whitted (direct and ambient) or path (all)
    #[arg(long, value_name = "NAME", default_value = "whitted")]
    integrator: String,
    /// Rays to each lamp whose light has no closed form at a point, and paths of integrator path, rounded up to a multiple of 32
    #[arg(long, value_name = "N", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=4_194_304))]
    samples: u32,
    /// Twice as many samples, again and again, until the standard error of every channel is at most E, or 4,194,304 are used
    #[arg(long, value_name = "E", value_parser = positive)]
    max_error: Option<f64>,
    /// What random choices go by
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Threads to work with [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Answer with a JSON object
    #[arg(long)]
    json: bool,
    /// Instead of points, the middles of N x M cells of a parallelogram: a corner, its edge u, its edge v (the normal is u x v),
    /// and how many along each, such as "0 0.8 0  4 0 0  0 0 -3  40x30"
    #[arg(long, value_name = "CORNER U V NxM", allow_hyphen_values = true)]
    plane: Option<Plane>,
    /// Picture of the plane in false colours with lines of equal light (.png), seen from where its normal points to, u to the right
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Measures and prints.
pub(crate) fn run(args: &ProbeArgs) -> Result<Outcome> {
    check(args)?;
    let pool = new_pool(args.threads)?;
    let points = args.points.as_deref().map(|path| Rows::read(path, &points::POINT)).transpose()?;
    let Loaded { scene, inputs, .. } = Loaded::read(&args.scene)?;
    check_apart(&outputs(args), &inputs)?;
    let receivers = match (&points, &args.plane) {
        (Some(points), _) => points.iter().copied().collect(),
        (None, Some(plane)) => plane.receivers()?,
        (None, None) => Vec::new(),
    };
    let snapshot = Snapshot::extract(&scene, &pool);
    let options = ProbeOptions {
        rays: args.samples,
        max_error: args.max_error,
        seed: args.seed,
        integrator: find_integrator(&args.integrator)?,
    };
    let control = interrupt::control();
    let ask = || irradiance_at(&snapshot, &receivers, &options, &pool, &control);
    let Ok(found) = progress::while_showing(&control, ask) else {
        say("interrupted: nothing is written");
        return Ok(Outcome::Interrupted);
    };
    if let (Some(limit), most) = (args.max_error, worst(&found))
        && most > limit
    {
        warn(&format!("the largest standard error is {most:e}, above --max-error"));
    }
    answer(args, points.as_ref(), &receivers, &found, &control)
}

/// Refuses what cannot end well before any work is done.
fn check(args: &ProbeArgs) -> Result<()> {
    match find_integrator(&args.integrator)? {
        Integrator::Whitted | Integrator::Path => {}
        other => {
            return Err(miette!(
                help = "irradiance is known by integrators whitted (direct and ambient light) and path (all light)",
                "integrator {} does not measure irradiance",
                other.name()
            ));
        }
    }
    if args.scene == Path::new(STANDARD) && args.points.as_deref() == Some(Path::new(STANDARD)) {
        return Err(miette!(
            help = "give one of them as a file",
            "the scene and the points cannot both come from standard input"
        ));
    }
    check_heard()?;
    if let Some(path) = &args.output {
        if args.plane.is_none() {
            return Err(miette!(
                help = "ask for a plane with --plane",
                "--output is for the picture of a plane"
            ));
        }
        if Format::of(path)? != Format::Png {
            return Err(miette!(help = "give it the ending .png", "the picture of a plane is a .png"));
        }
    }
    check_apart(&outputs(args), &[scene_input(&args.scene)])?;
    check_writable(&outputs(args))
}

/// The files that are to be written.
fn outputs(args: &ProbeArgs) -> Vec<Output<'_>> {
    args.output.as_deref().map(|path| ("--output", path)).into_iter().collect()
}

fn worst(found: &[Irradiance]) -> f64 {
    found.iter().map(|found| found.error.max_channel()).fold(0.0, f64::max)
}

/// Prints what was found and writes the picture of a plane.
fn answer(
    args: &ProbeArgs,
    points: Option<&Rows<Receiver>>,
    receivers: &[Receiver],
    found: &[Irradiance],
    control: &Arc<Control>,
) -> Result<Outcome> {
    let scene = file_name(&args.scene);
    let plan = args.plane.as_ref().map(|plane| Plan::new(plane, found));
    if let (Some(plan), Some(path)) = (&plan, &args.output) {
        let picture = Map::of(plan);
        let write = || write_map(path, &picture);
        if is_straight(path) {
            let Some(written) = interrupt::while_waiting(control, write) else {
                return Ok(Outcome::Interrupted);
            };
            written?;
        } else {
            write()?;
        }
    }
    let text = match (&plan, points, args.json) {
        (Some(plan), _, true) => format!("{}\n", plan.as_json(&scene)),
        (Some(plan), _, false) => plan.as_text(),
        (None, _, true) => format!("{}\n", points::as_json(&scene, receivers, found)),
        (None, points, false) => points.map_or_else(String::new, |points| points::as_text(points, found)),
    };
    print_answer(&text)?;
    Ok(Outcome::Done)
}

/// Reads a limit above 0.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("a limit is a number above 0".to_owned()),
    }
}
