//! `catoptra lab pareto`: what does each way to answer a question cost, and how wrong is it?

mod averages;
mod closed_forms;
mod cutoffs;
mod known_light;
mod occlusion;
mod page;
mod pictures;
mod soft_shadows;
mod visibility;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use catoptra_core::Scene;
use catoptra_lab::{Clock, Picture, Plot, fastest};
use catoptra_tracer::{Backend, Control, Film, Pool, Snapshot, View, render};
use clap::Args;
use miette::{IntoDiagnostic, Result, WrapErr};

use crate::Outcome;
use crate::console::print;
use crate::destination::check_folder;
use crate::names::find_backend;
use crate::output::write_file;
use crate::pool::new_pool;

#[derive(Args)]
pub(crate) struct ParetoArgs {
    /// Folder for pareto.csv, a picture of each question (.svg) and the page ACCURACY.md; made where it is missing
    #[arg(long, value_name = "DIR", default_value = "pareto")]
    out: PathBuf,
    /// Threads to trace with; times are those of one frame on them
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: u16,
}

/// Answers some questions that have much in common.
type Ask = fn(&Lab) -> Result<Vec<Question>>;

const QUESTIONS: [Ask; 7] = [
    visibility::ask,
    pictures::ask,
    cutoffs::ask,
    averages::ask,
    occlusion::ask,
    soft_shadows::ask,
    closed_forms::ask,
];

/// A question with all ways to answer it that were tried.
pub(super) struct Question {
    /// The name of its picture and its rows in the CSV.
    name: &'static str,
    title: &'static str,
    /// What was done, and what the errors are errors of.
    words: String,
    /// What the times are times of, such as `ms a frame`.
    time: &'static str,
    /// What the errors are, the one that is drawn first.
    errors: &'static [&'static str],
    ways: Vec<Way>,
}

impl Question {
    /// Time against the first error.
    fn svg(&self) -> Result<String> {
        let mut lines: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
        for way in &self.ways {
            let point = (way.time, way.errors[0]);
            match lines.last_mut().filter(|(series, _)| *series == way.series) {
                Some((_, points)) => points.push(point),
                None => lines.push((way.series.clone(), vec![point])),
            }
        }
        Plot { title: self.title, x: self.time, y: self.errors[0], lines: &lines }.svg().into_diagnostic()
    }
}

/// One way to answer a question.
pub(super) struct Way {
    /// Ways of one series are one line of the picture.
    series: String,
    setting: String,
    time: f64,
    /// In the order of the question's errors.
    errors: Vec<f64>,
}

/// The series of pictures whose edges and patterns are shown by areas.
pub(super) const EXACT: &str = "exact edges";

/// Names of what is written beside the pictures.
const TABLE: &str = "pareto.csv";
const PAGE: &str = "ACCURACY.md";

/// Answers every question and writes what was found.
pub(crate) fn run(args: &ParetoArgs) -> Result<Outcome> {
    let folder = &args.out;
    check_folder(folder, &[TABLE, PAGE])?;
    let pool = new_pool(Some(args.threads))?;
    let lab = Lab { pool, wide: find_backend("wide")? };
    let mut questions = Vec::new();
    for ask in QUESTIONS {
        let started = Instant::now();
        let answered = ask(&lab)?;
        let names: Vec<&str> = answered.iter().map(|question| question.name).collect();
        print(&format!("{}: {:.1} s\n", names.join(", "), started.elapsed().as_secs_f64()))?;
        questions.extend(answered);
    }
    let closed_forms = known_light::markdown(&lab)?;
    std::fs::create_dir_all(folder)
        .into_diagnostic()
        .wrap_err_with(|| format!("the folder {} cannot be made", folder.display()))?;
    for question in &questions {
        write_file(&folder.join(format!("{}.svg", question.name)), question.svg()?.as_bytes())?;
    }
    write_file(&folder.join(TABLE), page::csv(&questions).as_bytes())?;
    write_file(&folder.join(PAGE), (page::markdown(&questions, &lab) + &closed_forms).as_bytes())?;
    print(&format!("written to {}\n", folder.display()))?;
    Ok(Outcome::Done)
}

/// What questions are answered with.
pub(super) struct Lab {
    pool: Pool,
    wide: &'static dyn Backend,
}

/// Every way is tried for this long, and as often as that at least; the least time counts.
const LONG_ENOUGH: Duration = Duration::from_millis(150);
const GOES: u32 = 5;

impl Lab {
    /// The answer, and the least milliseconds that it took: of one processor where there is one thread, else of the wall.
    fn fastest<T>(&self, answer: impl FnMut() -> T) -> (T, f64) {
        let clock = if self.pool.threads() == 1 { Clock::Processor } else { Clock::Wall };
        let (answered, least) = fastest(clock, GOES, LONG_ENOUGH, answer);
        (answered, least.as_secs_f64() * 1e3)
    }

    /// A picture of a view, and the milliseconds of its fastest frame.
    fn picture(&self, snapshot: &Snapshot, view: &View) -> Result<(Picture, f64)> {
        let mut film = Film::new(view.size);
        let (done, milliseconds) =
            self.fastest(|| render(self.wide, snapshot, view, &mut film, &self.pool, &Control::default()));
        done.into_diagnostic()?;
        let size = film.size();
        let picture =
            Picture::painted(size.width, size.height, |x, y| film.radiance(x, y)).into_diagnostic()?;
        Ok((picture, milliseconds))
    }
}

/// A scene of the lab's own.
fn parsed(text: &str) -> Result<Scene> {
    Ok(catoptra_scene::parse(text, "lab", None)?.0)
}
