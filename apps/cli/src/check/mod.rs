//! `catoptra check`: is a scene valid, and what in it is probably not meant?
//!
//! A new lint is one new file here and one line in [`LINTS`].

mod coincident;
mod dark;
mod stage;
mod unseen;
mod unused;

use std::path::PathBuf;

use catoptra_scene::printable;
use catoptra_tracer::Size;
use clap::Args;
use miette::Result;
use serde_json::{Value, json};

use crate::Outcome;
use crate::args::size;
use crate::console::{check_heard, print_answer};
use crate::pool::new_pool;
use stage::Stage;

#[derive(Args)]
pub(crate) struct CheckArgs {
    /// Scene files (.kdl) or model files, or - for standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Size of the pictures that cameras see: as wide for its height, and with as many rays
    #[arg(long, value_name = "WxH", default_value = "320x240", value_parser = size)]
    size: Size,
    /// Threads to work with [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Answer with a JSON object
    #[arg(long)]
    json: bool,
}

/// What is odd about a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Finding {
    /// The line of the scene's text, from 1 up, where it has one.
    line: Option<usize>,
    message: String,
}

/// A kind of thing that is odd.
struct Lint {
    name: &'static str,
    find: fn(&Stage<'_>) -> Vec<Finding>,
}

/// All lints.
const LINTS: &[Lint] = &[unused::LINT, unseen::LINT, dark::LINT, coincident::LINT];

/// Reads scenes and says what is odd about them.
pub(crate) fn run(args: &CheckArgs) -> Result<Outcome> {
    check_heard()?;
    let pool = new_pool(args.threads)?;
    let (mut text, mut objects) = (String::new(), Vec::new());
    for path in &args.scenes {
        let (scene, file) = crate::loaded::load(path)?;
        let stage = Stage::of(&scene, &file, args.size, &pool)?;
        for lint in LINTS {
            for Finding { line, message } in (lint.find)(&stage) {
                let place = line.map_or_else(String::new, |line| format!(":{line}"));
                let told = printable(&message);
                text.push_str(&format!("{}{place}: {told} [{}]\n", path.display(), lint.name));
                objects.push(json!({
                    "scene": path.display().to_string(),
                    "line": line,
                    "lint": lint.name,
                    "message": message,
                }));
            }
        }
    }
    let found = !objects.is_empty();
    if args.json {
        print_answer(&format!("{}\n", Value::from(objects)))?;
    } else {
        print_answer(&text)?;
    }
    Ok(if found { Outcome::Differs } else { Outcome::Done })
}

#[cfg(test)]
mod tests {
    use catoptra_tracer::Pool;

    use super::*;

    /// What a lint finds in a scene: lines and messages.
    pub(super) fn findings(lint: &Lint, text: &str) -> Vec<(Option<usize>, String)> {
        let (scene, file) = catoptra_scene::parse(text, "text", None).unwrap();
        let pool = Pool::new(1).unwrap();
        let stage = Stage::of(&scene, &file, Size::new(64, 48), &pool).unwrap();
        (lint.find)(&stage).into_iter().map(|finding| (finding.line, finding.message)).collect()
    }

    #[test]
    fn names_of_lints_differ() {
        let names: std::collections::HashSet<&str> = LINTS.iter().map(|lint| lint.name).collect();
        assert_eq!(names.len(), LINTS.len());
    }

    #[test]
    fn a_plain_scene_is_in_order() {
        let text = "camera \"c\" { eye 0 1 5; target 0 1 0 }\nmatte \"m\" { color 0.5 }\n\
            sphere \"s\" material=\"m\" { center 0 1 0; radius 1 }\nplane \"p\" material=\"m\"\n\
            point-light \"l\" { position 3 5 3; intensity 9 }\n";
        for lint in LINTS {
            assert_eq!(findings(lint, text), [], "{}", lint.name);
        }
    }
}
