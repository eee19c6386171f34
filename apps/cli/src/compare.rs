//! `catoptra compare`: how far is a picture from its reference, and is that within the limits?

use std::path::{Path, PathBuf};

use catoptra_lab::{METRICS, Metric, Pair, Picture, Viewing};
use catoptra_scene::image::false_color::{Scale, color};
use catoptra_scene::image::write_png;
use clap::Args;
use miette::{IntoDiagnostic, Result, miette};
use serde_json::{Map, Value, json};

use crate::Outcome;
use crate::args::limit;
use crate::console::print;
use crate::destination::{check_apart, check_writable};
use crate::input::{Stored, read_picture};
use crate::output::Format;

#[derive(Args)]
pub(crate) struct CompareArgs {
    /// Picture taken as right (.png or .exr)
    pub(crate) reference: PathBuf,
    /// Picture that is judged
    pub(crate) test: PathBuf,
    /// Answer with a JSON object
    #[arg(long)]
    pub(crate) json: bool,
    /// A pixel counts as differing past this difference of a channel (a step of a .png is 0.00393)
    #[arg(long, value_name = "X", default_value_t = 0.0, value_parser = limit)]
    pub(crate) threshold: f64,
    /// Picture of the differences to write (.png): the largest difference of a channel in false colours, dark for none, bright for the
    /// largest of all
    #[arg(long, value_name = "FILE")]
    pub(crate) diff: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) limits: LimitArgs,
}

/// Limits past which a comparison ends with exit code 1.
#[derive(Args)]
pub(crate) struct LimitArgs {
    /// Largest root mean squared error allowed
    #[arg(long, value_name = "X", value_parser = limit)]
    pub(crate) max_rmse: Option<f64>,
    /// Largest relative mean squared error allowed
    #[arg(long, value_name = "X", value_parser = limit)]
    pub(crate) max_relmse: Option<f64>,
    /// Largest difference of a channel allowed; the bytes of a .png count as 0 to 1, so a step is 0.00393
    #[arg(long, value_name = "X", value_parser = limit)]
    pub(crate) max_difference: Option<f64>,
    /// Largest mean FLIP allowed
    #[arg(long, value_name = "X", value_parser = limit)]
    pub(crate) max_flip: Option<f64>,
    /// Most differing pixels allowed
    #[arg(long, value_name = "N")]
    pub(crate) max_differing: Option<u64>,
}

/// Compares two picture files.
pub(crate) fn run(args: &CompareArgs) -> Result<Outcome> {
    check_difference(args)?;
    let (reference, test) = (read_picture(&args.reference)?, read_picture(&args.test)?);
    if reference.is_encoded() != test.is_encoded() {
        return Err(miette!(
            help = "compare two .png (as displayed) or two .exr (linear light)",
            "{} and {} do not hold the same kind of values",
            args.reference.display(),
            args.test.display()
        ));
    }
    let measured = measure(&reference, &test, args.threshold)?;
    if let Some(path) = &args.diff {
        write_difference(path, &reference.values, &test.values)?;
    }
    let passed = |(metric, value): &(&Metric, f64)| {
        limit_of(metric.name, &args.limits).is_none_or(|limit| *value <= limit)
    };
    let within = measured.iter().all(passed);
    let answer = if args.json {
        format!("{}\n", as_json(args, &reference.values, &measured, within))
    } else {
        as_table(&args.limits, &measured)
    };
    print(&answer)?;
    Ok(if within { Outcome::Done } else { Outcome::Differs })
}

/// Refuses a picture of differences that cannot be written.
fn check_difference(args: &CompareArgs) -> Result<()> {
    let Some(path) = args.diff.as_deref() else { return Ok(()) };
    if Format::of(path)? != Format::Png {
        return Err(miette!(help = "give it the ending .png", "the picture of differences is a .png"));
    }
    let inputs = [("the reference", args.reference.clone()), ("the test", args.test.clone())];
    check_apart(&[("--diff", path)], &inputs)?;
    check_writable(&[("--diff", path)])
}

/// Writes the largest difference of a channel of each pixel, as a share of the largest of all, in false colours.
fn write_difference(path: &Path, reference: &Picture, test: &Picture) -> Result<()> {
    let channels =
        |(a, b): (&[f32; 3], &[f32; 3])| (0..3).map(|i| f64::from((a[i] - b[i]).abs())).fold(0.0, f64::max);
    let differences: Vec<f64> = reference.pixels().iter().zip(test.pixels()).map(channels).collect();
    let scale = Scale::of([0.0, differences.iter().copied().fold(0.0, f64::max)]);
    let bytes: Vec<u8> = differences.iter().flat_map(|difference| color(scale.share(*difference))).collect();
    write_png(path, reference.width(), reference.height(), &bytes).into_diagnostic()
}

/// Every metric of two pictures: over the values as they are stored, except FLIP, which judges the light a display emits.
fn measure(reference: &Stored, test: &Stored, threshold: f64) -> Result<Vec<(&'static Metric, f64)>> {
    let viewing = Viewing { threshold: threshold as f32, ..Viewing::default() };
    let wrong_sizes = |error| miette!("the pictures cannot be compared: {error}");
    let stored = Pair::new(&reference.values, &test.values).map_err(wrong_sizes)?;
    let (light_of_reference, light_of_test) = (reference.light(), test.light());
    let light = Pair::new(&light_of_reference, &light_of_test).map_err(wrong_sizes)?;
    let pair_for = |metric: &Metric| if metric.name == "flip" { light } else { stored };
    Ok(METRICS.iter().map(|metric| (metric, (metric.measure)(pair_for(metric), &viewing))).collect())
}

/// The limit that the user has set for a metric.
fn limit_of(metric: &str, limits: &LimitArgs) -> Option<f64> {
    match metric {
        "rmse" => limits.max_rmse,
        "relmse" => limits.max_relmse,
        "max-difference" => limits.max_difference,
        "flip" => limits.max_flip,
        "differing" => limits.max_differing.map(|count| count as f64),
        _ => None,
    }
}

fn as_table(limits: &LimitArgs, measured: &[(&Metric, f64)]) -> String {
    let line = |(metric, value): &(&Metric, f64)| {
        let verdict = match limit_of(metric.name, limits) {
            Some(limit) if *value <= limit => format!("within {limit}"),
            Some(limit) => format!("PAST {limit}"),
            None => String::new(),
        };
        format!("{:<15} {:>16}  {verdict:<16}  {}\n", metric.name, number(*value), metric.doc)
    };
    measured.iter().map(line).collect()
}

/// A number as short as it can be read: whole ones without a point.
fn number(value: f64) -> String {
    if value.fract() == 0.0 { format!("{value:.0}") } else { format!("{value:.8}") }
}

fn as_json(args: &CompareArgs, reference: &Picture, measured: &[(&Metric, f64)], within: bool) -> Value {
    let mut object = Map::new();
    object.insert("reference".into(), json!(args.reference.display().to_string()));
    object.insert("test".into(), json!(args.test.display().to_string()));
    object.insert("size".into(), json!({ "width": reference.width(), "height": reference.height() }));
    object.insert("threshold".into(), json!(args.threshold));
    for (metric, value) in measured {
        object.insert(metric.name.replace('-', "_"), json!(value));
    }
    object.insert("within_limits".into(), json!(within));
    Value::Object(object)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_limit_belongs_to_a_metric() {
        let all = LimitArgs {
            max_rmse: Some(1.0),
            max_relmse: Some(1.0),
            max_difference: Some(1.0),
            max_flip: Some(1.0),
            max_differing: Some(1),
        };
        assert_eq!(METRICS.iter().filter(|metric| limit_of(metric.name, &all).is_some()).count(), 5);
    }

    #[test]
    fn whole_numbers_have_no_point() {
        assert_eq!((number(12.0), number(0.5)), ("12".to_owned(), "0.50000000".to_owned()));
    }
}
