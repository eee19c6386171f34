//! The binary `catoptra`: what does the user ask for, and with which exit code does it end?
//!
//! 0: done. 1: pictures differ past a limit. 2: bad usage or input, said on stderr. 130: interrupted.

mod args;
mod compare;
mod explain;
mod input;
mod interrupt;
mod job;
mod lab;
mod memory;
mod output;
mod progress;
mod render;
mod stats;
mod suggest;
mod words;

use std::process::ExitCode;

use clap::Parser;
use miette::MietteHandlerOpts;

use args::{Cli, Command};

/// How a command that was understood has ended.
enum Outcome {
    Done,
    Differs,
    Interrupted,
}

fn main() -> ExitCode {
    // Long paths stay in one piece, so that tools can find them in the message.
    let plain = |_: &_| Box::new(MietteHandlerOpts::new().wrap_lines(false).build()) as Box<_>;
    if let Err(report) = miette::set_hook(Box::new(plain)) {
        eprintln!("{report}");
    }
    let outcome = match Cli::parse().command {
        Command::Render(args) => render::run(&args),
        Command::Explain(args) => explain::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Lab(args) => lab::run(&args),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Differs) => ExitCode::from(1),
        Ok(Outcome::Interrupted) => ExitCode::from(130),
        Err(report) => {
            eprintln!("{report:?}");
            ExitCode::from(2)
        }
    }
}
