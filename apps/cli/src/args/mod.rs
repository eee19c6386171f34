//! Which commands and options are there?

mod explain;
mod job;
mod render;
mod values;

use clap::{Parser, Subcommand};

use crate::cast::CastArgs;
use crate::check::CheckArgs;
use crate::compare::CompareArgs;
use crate::fmt::FmtArgs;
use crate::info::InfoArgs;
use crate::lab::LabArgs;
use crate::pick::PickArgs;
use crate::probe::ProbeArgs;
use crate::shells::{CompletionsArgs, ManArgs};
pub(crate) use explain::ExplainArgs;
pub(crate) use job::JobArgs;
pub(crate) use render::{PictureArgs, RenderArgs};
pub(crate) use values::{limit, size};

/// Renders scenes on the CPU, asks what is in them and what they cost, measures their light, and compares pictures.
#[derive(Parser)]
#[command(name = "catoptra", version, propagate_version = true, after_help = EXIT_CODES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Say nothing but errors and what is asked for: no notes, no warnings, no progress
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Say more: which files are read and written, and how long each stage takes
    #[arg(short, long, global = true)]
    pub(crate) verbose: bool,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 pictures differ past a limit or a check found something, 2 bad usage or input, 130 interrupted.";

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Render scenes to pictures, or time how long a frame takes
    Render(Box<RenderArgs>),
    /// Say what a scene needs, what takes how long, and what work is skipped
    Explain(ExplainArgs),
    /// Say what a scene or a model file holds
    Info(InfoArgs),
    /// Say what is odd about scenes: what nothing uses, no camera sees, lights nothing, or lies in one place
    Check(CheckArgs),
    /// Lay scene text out by rule
    Fmt(FmtArgs),
    /// Say what a pixel of a picture shows: which thing, where, of which material
    Pick(PickArgs),
    /// Say what rays of a file meet in a scene
    Cast(CastArgs),
    /// Measure how much light arrives at points of a scene, or on a plane
    Probe(ProbeArgs),
    /// Measure how far a picture is from a reference
    Compare(CompareArgs),
    /// Measure how fast and how exact tracing is
    Lab(LabArgs),
    /// Print what a shell reads to complete commands
    Completions(CompletionsArgs),
    /// Write manual pages to a folder
    Man(ManArgs),
}

/// What stands for standard input or output where a file is named.
pub(crate) const STANDARD: &str = "-";

/// Where the system has standard output among its files; `/dev/stdout` leads there.
pub(crate) const STDOUT: &str = "/dev/fd/1";

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_options_are_consistent() {
        Cli::command().debug_assert();
    }
}
