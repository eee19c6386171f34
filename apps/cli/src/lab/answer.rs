//! `catoptra lab answer`: what does the tracer answer to a file of hard cases, and `catoptra lab score`: how much of
//! that is wrong?

use std::path::{Path, PathBuf};

use catoptra_lab::stress::{
    Asked, Cases, StressError, answer, read_answers, read_cases, read_results, results_text, score,
};
use clap::Args;
use miette::{Result, miette};

use crate::Outcome;
use crate::console::print;
use crate::destination::{check_apart, check_writable};
use crate::names::find_backend;
use crate::output::write_file;
use crate::pool::new_pool;

#[derive(Args)]
pub(crate) struct AnswerArgs {
    /// Case file (begins with "STRESS 1")
    cases: PathBuf,
    /// Where the results are written
    results: PathBuf,
    /// Backend to ask: wide (what pictures are rendered with), scalar or oracle (exhaustive)
    #[arg(long, value_name = "NAME", default_value = "wide")]
    backend: String,
    /// Threads to trace with [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

#[derive(Args)]
pub(crate) struct ScoreArgs {
    /// Case file
    cases: PathBuf,
    /// The right answers (begins with "STRESS-ANSWERS 1")
    answers: PathBuf,
    /// Results to be scored
    results: PathBuf,
}

/// Answers all cases and writes the results.
pub(crate) fn run(args: &AnswerArgs) -> Result<Outcome> {
    let backend = find_backend(&args.backend)?;
    let outputs = [("RESULTS", args.results.as_path())];
    check_apart(&outputs, &[("the case file", args.cases.clone())])?;
    check_writable(&outputs)?;
    let cases = load_cases(&args.cases)?;
    let pool = new_pool(args.threads)?;
    let replies = answer(&cases, Asked { backend, pool: &pool });
    write_file(&args.results, results_text(replies).as_bytes())?;
    Ok(Outcome::Done)
}

/// Prints wrong and all answers of every group. Finds a difference where any is wrong.
pub(crate) fn run_score(args: &ScoreArgs) -> Result<Outcome> {
    let cases = load_cases(&args.cases)?;
    let answers = read_answers(&read(&args.answers)?).map_err(|error| place(&args.answers, &error))?;
    let results = read_results(&read(&args.results)?, &cases.cases);
    let replies = results.map_err(|error| place(&args.results, &error))?;
    let scores = score(&cases.cases, &answers, &replies);
    let mut text = String::from("group                     cases  wrong\n");
    for (group, score) in &scores {
        let examples: Vec<String> = score.examples.iter().map(ToString::to_string).collect();
        let told =
            if examples.is_empty() { String::new() } else { format!("  such as {}", examples.join(", ")) };
        text += &format!("{group:24} {:6} {:6}{told}\n", score.cases, score.wrong);
    }
    let (all, wrong) = scores.values().fold((0, 0), |(all, wrong), s| (all + s.cases, wrong + s.wrong));
    text += &format!("{:24} {all:6} {wrong:6}\n", "all");
    let worst = scores.values().map(|score| score.path_error).fold(0.0, f64::max);
    text += &format!(
        "largest error of a path: {worst:.1e} of what its conditioning makes of a relative error of 1\n"
    );
    print(&text)?;
    Ok(if wrong == 0 { Outcome::Done } else { Outcome::Differs })
}

fn read(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).map_err(|error| miette!("{} cannot be read: {error}", path.display()))
}

fn load_cases(path: &Path) -> Result<Cases> {
    read_cases(&read(path)?).map_err(|error| place(path, &error))
}

fn place(path: &Path, error: &StressError) -> miette::Report {
    miette!("{}: {error}", path.display())
}
