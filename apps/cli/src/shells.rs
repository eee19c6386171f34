//! `catoptra completions` and `catoptra man`: what shells and `man` know of this program, made from its own list of options.

use std::path::PathBuf;

use clap::{Args, CommandFactory};
use clap_complete::Shell;
use miette::{Result, miette};

use crate::Outcome;
use crate::args::Cli;
use crate::console::print_answer;

#[derive(Args)]
pub(crate) struct CompletionsArgs {
    /// Shell that is to complete commands: its words go to standard output
    shell: Shell,
}

#[derive(Args)]
pub(crate) struct ManArgs {
    /// Folder to write the pages to: catoptra.1, and one for each command
    folder: PathBuf,
}

/// Prints what a shell reads to complete commands.
pub(crate) fn complete(args: &CompletionsArgs) -> Result<Outcome> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "catoptra", &mut script);
    print_answer(&String::from_utf8_lossy(&script))?;
    Ok(Outcome::Done)
}

/// Writes the manual pages.
pub(crate) fn write_pages(args: &ManArgs) -> Result<Outcome> {
    let written = std::fs::create_dir_all(&args.folder)
        .and_then(|()| clap_mangen::generate_to(Cli::command(), &args.folder));
    written
        .map_err(|error| miette!("manual pages cannot be written to {}: {error}", args.folder.display()))?;
    Ok(Outcome::Done)
}
