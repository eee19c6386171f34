//! The binary `catoptra`: what does the user ask for, and with which exit code does it end?
//!
//! 0: done. 1: pictures differ past a limit, or a check found something. 2: bad usage or input, said on stderr. 130: interrupted.

mod args;
mod cast;
mod check;
mod compare;
mod console;
mod destination;
mod explain;
mod film;
mod fmt;
mod info;
mod input;
mod interrupt;
mod job;
mod lab;
mod layers;
mod loaded;
mod memory;
mod names;
mod numbers;
mod output;
mod pick;
mod pool;
mod probe;
mod processor;
mod progress;
mod render;
mod rows;
mod shells;
#[cfg(unix)]
mod signals;
mod stats;
mod suggest;
mod surfaces;
mod words;

use std::io::IsTerminal;
use std::process::ExitCode;

use clap::Parser;
use miette::{IntoDiagnostic, MietteHandlerOpts, Result};

use args::{Cli, Command};
use console::{Talk, complain, print_answer, set_talk};

/// How a command that was understood has ended.
enum Outcome {
    Done,
    Differs,
    Interrupted,
}

fn main() -> ExitCode {
    #[cfg(unix)]
    signals::tame();
    // Long paths stay in one piece, so that tools can find them in the message.
    let plain = |_: &_| Box::new(MietteHandlerOpts::new().wrap_lines(false).build()) as Box<_>;
    if let Err(report) = miette::set_hook(Box::new(plain)) {
        complain(&report.to_string());
    }
    let outcome = match Cli::try_parse() {
        Ok(cli) => {
            match (cli.quiet, cli.verbose) {
                (true, _) => set_talk(Talk::Quiet),
                (false, true) => set_talk(Talk::Verbose),
                (false, false) => {}
            }
            run(cli.command)
        }
        Err(told) if told.use_stderr() => {
            let _ = told.print();
            return BAD.into();
        }
        Err(help) => show(&help),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Differs) => ExitCode::from(1),
        Ok(Outcome::Interrupted) => interrupt::CODE.into(),
        Err(report) => {
            complain(&format!("{report:?}"));
            BAD.into()
        }
    }
}

/// Exit code of bad usage and input.
const BAD: u8 = 2;

fn run(command: Command) -> Result<Outcome> {
    match command {
        Command::Render(args) => render::run(&args),
        Command::Explain(args) => explain::run(&args),
        Command::Info(args) => info::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Fmt(args) => fmt::run(&args),
        Command::Completions(args) => shells::complete(&args),
        Command::Man(args) => shells::write_pages(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Pick(args) => pick::run(&args),
        Command::Cast(args) => cast::run(&args),
        Command::Probe(args) => probe::run(&args),
        Command::Lab(args) => lab::run(&args),
    }
}

/// Shows the help or the version, in colours on a terminal.
fn show(help: &clap::Error) -> Result<Outcome> {
    if std::io::stdout().is_terminal() {
        help.print().into_diagnostic()?;
    } else {
        print_answer(&help.render().to_string())?;
    }
    Ok(Outcome::Done)
}
