//! `catoptra lab stress`: how many hard rays does a backend answer otherwise than exact arithmetic, and how many leak out of
//! closed shapes?

use catoptra_lab::adversary::{GROUPS, closed};
use catoptra_tracer::{Backend, Pool, backends};
use clap::Args;
use miette::{IntoDiagnostic, Result};

use crate::Outcome;
use crate::console::{check_heard, print};
use crate::names::find_backend;
use crate::pool::new_pool;

#[derive(Args)]
pub(crate) struct StressArgs {
    /// Rays of every group, at least
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    rays: usize,
    /// Rays from within every closed shape
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    within: usize,
    /// Number of the first trial of every group
    #[arg(long, value_name = "N", default_value_t = 0)]
    first: u64,
    /// Only groups and closed shapes whose names hold this
    #[arg(long, value_name = "WORDS", default_value = "")]
    only: String,
    /// Backend to ask: wide, scalar or oracle [default: all of them]
    #[arg(long, value_name = "NAME")]
    backend: Option<String>,
    /// Threads to trace with [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

/// Prints asked and wrong rays of every group, and those that leak. Finds a difference where there are any.
pub(crate) fn run(args: &StressArgs) -> Result<Outcome> {
    let asked = match &args.backend {
        Some(name) => vec![find_backend(name)?],
        None => backends().to_vec(),
    };
    check_heard()?;
    let pool = new_pool(args.threads)?;
    let mut wrong = 0;
    for backend in asked {
        wrong += ask(args, backend, &pool)?;
    }
    Ok(if wrong == 0 { Outcome::Done } else { Outcome::Differs })
}

fn ask(args: &StressArgs, backend: &dyn Backend, pool: &Pool) -> Result<usize> {
    let mut wrong = 0;
    for group in GROUPS.iter().filter(|group| group.name.contains(&args.only)) {
        let replies = group.ask(backend, args.first, args.rays, pool).into_diagnostic()?;
        let example = replies.wrong.first().map(|told| format!("  {told}")).unwrap_or_default();
        let (asked, failed) = (replies.asked, replies.wrong.len());
        print(&format!("{:8} {:24} {asked:9} rays {failed:6} wrong{example}\n", backend.name(), group.name))?;
        wrong += failed;
    }
    for shape in closed().into_diagnostic()?.iter().filter(|shape| shape.name.contains(&args.only)) {
        let leaks = shape.leaks(backend, args.within, pool).into_diagnostic()?;
        let within = args.within;
        print(&format!("{:8} {:24} {within:9} rays {leaks:6} leaked\n", backend.name(), shape.name))?;
        wrong += leaks;
    }
    Ok(wrong)
}
