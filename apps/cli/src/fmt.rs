//! `catoptra fmt`: scene text laid out by rule.

use std::io::Read;
use std::path::{Path, PathBuf};

use catoptra_scene::atomic;
use clap::Args;
use miette::{Result, miette};

use crate::Outcome;
use crate::args::STANDARD;
use crate::console::{check_heard, detail, print_answer};
use crate::output::write_file;

#[derive(Args)]
pub(crate) struct FmtArgs {
    /// Scene files (.kdl), each written anew where that changes it; - is standard input, and goes to standard output
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Change no file: print the names of those that would be, and end with exit code 1 if there is one
    #[arg(long)]
    check: bool,
}

/// Formats files.
pub(crate) fn run(args: &FmtArgs) -> Result<Outcome> {
    let mut changed = Vec::new();
    for path in &args.scenes {
        let (name, is_standard) = if path == Path::new(STANDARD) {
            ("<stdin>".to_owned(), true)
        } else {
            (path.display().to_string(), false)
        };
        if is_standard || args.check {
            check_heard()?;
        }
        let text = read(path, &name, is_standard)?;
        let formatted = catoptra_scene::format(&text, &name)?;
        if is_standard && !args.check {
            print_answer(&formatted)?;
        } else if formatted != text {
            if !args.check {
                atomic::check(path).map_err(|error| miette!("{name} cannot be written: {error}"))?;
                write_file(path, formatted.as_bytes())?;
                detail(&format!("formatted {name}"));
            }
            changed.push(name);
        }
    }
    if !args.check || changed.is_empty() {
        return Ok(Outcome::Done);
    }
    print_answer(&changed.iter().map(|name| format!("{name}\n")).collect::<String>())?;
    Ok(Outcome::Differs)
}

fn read(path: &Path, name: &str, is_standard: bool) -> Result<String> {
    let mut bytes = Vec::new();
    let read = if is_standard {
        std::io::stdin().lock().read_to_end(&mut bytes)
    } else {
        std::fs::File::open(path).and_then(|mut file| file.read_to_end(&mut bytes))
    };
    read.map_err(|error| miette!("{name} cannot be read: {error}"))?;
    String::from_utf8(bytes).map_err(|_| miette!(help = "save the file as UTF-8", "{name} is no UTF-8 text"))
}
