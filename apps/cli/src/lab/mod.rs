//! `catoptra lab`: how fast and how exact is tracing? One file for each question.

mod answer;
mod pareto;
mod ray_file;
mod rays;
mod stress;
mod trace;

use clap::{Args, Subcommand};
use miette::Result;

use crate::Outcome;

#[derive(Args)]
pub(crate) struct LabArgs {
    #[command(subcommand)]
    question: Question,
}

#[derive(Subcommand)]
enum Question {
    /// Time how fast the rays of a file are traced against a mesh
    Trace(trace::TraceArgs),
    /// Write the rays that a picture asks about
    Rays(rays::RaysArgs),
    /// Answer a file of cases that are hard to answer
    Answer(answer::AnswerArgs),
    /// Count the wrong answers of a results file
    Score(answer::ScoreArgs),
    /// Hold every backend against exact arithmetic on hard rays
    Stress(stress::StressArgs),
    /// Measure run time against error for every way to answer a question
    Pareto(pareto::ParetoArgs),
}

/// Answers one question.
pub(crate) fn run(args: &LabArgs) -> Result<Outcome> {
    match &args.question {
        Question::Trace(args) => trace::run(args),
        Question::Rays(args) => rays::run(args),
        Question::Answer(args) => answer::run(args),
        Question::Score(args) => answer::run_score(args),
        Question::Stress(args) => stress::run(args),
        Question::Pareto(args) => pareto::run(args),
    }
}
