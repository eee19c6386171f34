//! Which commands, options and values are there?

use std::path::PathBuf;
use std::time::Duration;

use catoptra_core::Settings;
use catoptra_tracer::{Film, Region, Size};
use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};

use crate::info::InfoArgs;
use crate::lab::LabArgs;
use crate::probe::ProbeArgs;

/// Renders scenes on the CPU, says what they cost, measures their light, and compares pictures.
#[derive(Parser)]
#[command(name = "catoptra", version, propagate_version = true, after_help = EXIT_CODES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT_CODES: &str =
    "Exit codes: 0 done, 1 pictures differ past a limit, 2 bad usage or input, 130 interrupted.";

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Render a scene to a picture, or time how long a frame takes
    Render(RenderArgs),
    /// Say what a scene needs, which kernels run and what work is skipped
    Explain(ExplainArgs),
    /// Say what a scene or a model file holds
    Info(InfoArgs),
    /// Measure how much light arrives at points of a scene, or on a plane
    Probe(ProbeArgs),
    /// Measure how far a picture is from a reference
    Compare(CompareArgs),
    /// Measure how fast and how exact tracing is
    Lab(LabArgs),
}

/// What a picture is made from: shared by the commands that trace.
#[derive(Args)]
pub(crate) struct JobArgs {
    /// Scene file (.kdl) or model file (.obj, .glb and so on), or - for standard input
    pub(crate) scene: PathBuf,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = size)]
    pub(crate) size: Size,
    /// Camera to look through [default: the scene's first]
    #[arg(long, value_name = "NAME")]
    pub(crate) camera: Option<String>,
    /// Backend to trace with: wide (fast), scalar or oracle (exhaustive)
    #[arg(long, value_name = "NAME", default_value = "wide")]
    pub(crate) backend: String,
    /// What the picture shows: whitted (light, shadows, mirrors) or occlusion [default: the scene's setting]
    #[arg(long, value_name = "NAME")]
    pub(crate) integrator: Option<String>,
    /// Threads to trace with [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Samples per pixel [default: the scene's setting, or 1]
    #[arg(long, value_name = "N", value_parser = samples)]
    pub(crate) samples: Option<u32>,
    /// Where the samples lie in a pixel: owen (in each by itself), sobol (in all alike) or grid [default: owen]
    #[arg(long, value_name = "NAME")]
    pub(crate) pattern: Option<String>,
    /// How places in and round a pixel count: box, tent or blackman-harris [default: box]
    #[arg(long, value_name = "NAME")]
    pub(crate) filter: Option<String>,
    /// Cut off each sample's channels at this radiance, which tames rare bright ones and darkens the picture
    #[arg(long, value_name = "L", value_parser = clamp)]
    pub(crate) clamp: Option<f32>,
    /// Pixels that edges cross: off (by their samples) or exact (by the area of each part) [default: off]
    #[arg(long, value_name = "NAME")]
    pub(crate) edges: Option<String>,
    /// What random choices go by: another number makes other ones, the same one the same picture
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u32,
    /// Let glass throw whole shadows under whitted; else light comes straight through it with what it leaves of it
    #[arg(long)]
    pub(crate) opaque_glass: bool,
    /// Bounces followed one after another [default: the scene's setting, for path any number]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1000))]
    pub(crate) max_depth: Option<u32>,
    /// Trace only this part of the picture, in pixels from its upper left corner
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    pub(crate) crop: Option<Region>,
    /// Edge of the tiles that work is shared out in, a multiple of 4 [default: 32]; changes no pixel
    #[arg(long, value_name = "N", default_value_t = Film::TILE, hide_default_value = true, value_parser = tile)]
    pub(crate) tile: u32,
    /// Vector instructions of backend wide: avx512, avx2, sse2 [default: the best there are]; changes no pixel
    #[arg(long, value_name = "LEVEL")]
    pub(crate) simd: Option<String>,
}

#[derive(Args)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    pub(crate) job: JobArgs,
    /// Picture to write: .png (8 bits, as displayed) or .exr (linear, 32 bits)
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Display transform of a .png: linear, srgb or filmic [default: srgb]
    #[arg(long, value_name = "NAME")]
    pub(crate) display: Option<String>,
    /// Brighten a .png by so many stops, each a factor of 2 [default: the scene's setting, or 0]
    #[arg(long, value_name = "STOPS", value_parser = exposure, allow_negative_numbers = true)]
    pub(crate) exposure: Option<f64>,
    /// Sample each pixel until its standard error is under E: of displayed values 0 to 1, of radiance for an .exr; --samples is
    /// then the most [default: the scene's setting, or as many samples as are asked for]
    #[arg(long, value_name = "E", value_parser = max_error)]
    pub(crate) max_error: Option<f64>,
    /// Sample for so many seconds, or until --max-error is reached
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub(crate) time: Option<Duration>,
    /// Keep samples in this file and go on from those it holds, up to --samples or for --time; an interrupted render goes on with the
    /// same command
    #[arg(long, value_name = "FILE", conflicts_with_all = ["repeat", "max_error"])]
    pub(crate) film: Option<PathBuf>,
    /// Time N frames after a warm-up: from snapshot to film, without files and parsing
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) repeat: Option<u32>,
    /// Write counts and times as a JSON object; - is standard output
    #[arg(long, value_name = "FILE.json", value_parser = PathBufValueParser::new().map(or_stdout))]
    pub(crate) stats: Option<PathBuf>,
}

#[derive(Args)]
pub(crate) struct ExplainArgs {
    #[command(flatten)]
    pub(crate) job: JobArgs,
    /// Answer with a JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

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

/// Widest and highest picture, in pixels; also what one side of a PNG viewer commonly takes.
const LONGEST_SIDE: u32 = 32_768;

/// Most pixels of a picture: a film of this many fits the memory of a common computer.
const MOST_PIXELS: u64 = 1 << 27;

/// What stands for standard input or output where a file is named.
pub(crate) const STANDARD: &str = "-";

/// Where the system has standard output among its files; `/dev/stdout` leads there.
pub(crate) const STDOUT: &str = "/dev/fd/1";

fn or_stdout(path: PathBuf) -> PathBuf {
    if path.as_os_str() == STANDARD { PathBuf::from(STDOUT) } else { path }
}

/// Reads `WIDTHxHEIGHT`.
fn size(text: &str) -> Result<Size, String> {
    let wanted = || "a size is written WIDTHxHEIGHT in pixels, such as 640x480".to_owned();
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(wanted)?;
    let side = |digits: &str| digits.parse::<u32>().map_err(|_| wanted());
    let (width, height) = (side(width)?, side(height)?);
    if !(1..=LONGEST_SIDE).contains(&width) || !(1..=LONGEST_SIDE).contains(&height) {
        return Err(format!("each side must be 1 to {LONGEST_SIDE} pixels"));
    }
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(format!("a picture may have at most {MOST_PIXELS} pixels"));
    }
    Ok(Size { width, height })
}

/// Reads `X,Y,WIDTH,HEIGHT`.
fn crop(text: &str) -> Result<Region, String> {
    let wanted = || "a part is written X,Y,WIDTH,HEIGHT in pixels, such as 100,50,64,64".to_owned();
    let numbers: Result<Vec<u32>, _> = text.split(',').map(str::parse).collect();
    match numbers.map_err(|_| wanted())?[..] {
        [x, y, width, height] if width > 0 && height > 0 => Ok(Region::new(x, y, Size { width, height })),
        [_, _, _, _] => Err("a part has at least one pixel".to_owned()),
        _ => Err(wanted()),
    }
}

/// Reads the edge of a tile.
fn tile(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(edge) if (4..=4096).contains(&edge) && edge.is_multiple_of(4) => Ok(edge),
        _ => Err("the edge of a tile is a multiple of 4, from 4 to 4096".to_owned()),
    }
}

/// Reads a number of samples.
fn samples(text: &str) -> Result<u32, String> {
    let most = Settings::MAX_SAMPLES;
    match text.parse::<u32>() {
        Ok(count) if (1..=most).contains(&count) => Ok(count),
        _ => Err(format!("samples are a whole number from 1 to {most}")),
    }
}

/// Reads a radiance to cut off at.
fn clamp(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(most) if most > 0.0 && most.is_finite() => Ok(most),
        _ => Err("a radiance to cut off at is a number greater than 0".to_owned()),
    }
}

/// Reads an exposure in stops.
fn exposure(text: &str) -> Result<f64, String> {
    let most = Settings::MAX_EXPOSURE;
    match text.parse::<f64>() {
        Ok(stops) if stops.abs() <= most => Ok(stops),
        _ => Err(format!("an exposure is a number of stops from -{most} to {most}")),
    }
}

/// Reads a standard error to come under.
fn max_error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if error > 0.0 && error.is_finite() => Ok(error),
        _ => Err("an error to come under is a number greater than 0, such as 0.01".to_owned()),
    }
}

/// Reads a time in seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| *seconds > 0.0);
    let time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    time.ok_or_else(|| "a time is a number of seconds greater than 0".to_owned())
}

/// Reads a limit: a number from 0 up.
fn limit(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number >= 0.0 && number.is_finite() => Ok(number),
        _ => Err("a limit is a number from 0 up".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_options_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn sizes_are_two_positive_numbers() {
        let found = size("450x300").unwrap();
        assert_eq!((found.width, found.height), (450, 300));
        for bad in
            ["", "450", "x", "450x", "0x10", "10x0", "-1x5", "1x2x3", "1.5x2", "99999x1", "32768x32768"]
        {
            assert!(size(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_crop_is_four_numbers_and_not_empty() {
        assert_eq!(crop("1,2,30,40"), Ok(Region::new(1, 2, Size::new(30, 40))));
        for bad in ["", "1,2,3", "1,2,3,4,5", "1,2,0,4", "-1,2,3,4", "1;2;3;4", "1,2,3,99999999999"] {
            assert!(crop(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn tiles_are_whole_blocks() {
        assert_eq!(tile("12"), Ok(12));
        for bad in ["", "0", "6", "-4", "5000"] {
            assert!(tile(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn samples_are_any_number_that_a_picture_may_have() {
        assert_eq!([samples("1"), samples("15"), samples("65536")], [Ok(1), Ok(15), Ok(65_536)]);
        for bad in ["0", "65537", "-1", "1.5", "4294967296", "x"] {
            assert!(samples(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn targets_and_exposures_are_numbers_that_mean_something() {
        assert_eq!((max_error("0.01"), exposure("-1.5")), (Ok(0.01), Ok(-1.5)));
        assert_eq!(seconds("0.5"), Ok(Duration::from_millis(500)));
        for bad in ["0", "-1", "inf", "NaN", "x", ""] {
            assert!(max_error(bad).is_err() && seconds(bad).is_err(), "{bad}");
        }
        for bad in ["33", "NaN", "inf", "auto"] {
            assert!(exposure(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_clamp_leaves_some_light() {
        assert_eq!(clamp("2.5"), Ok(2.5));
        for bad in ["0", "-1", "inf", "NaN", "x"] {
            assert!(clamp(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn limits_refuse_what_cannot_be_passed() {
        for bad in ["NaN", "-1", "inf", "x"] {
            assert!(limit(bad).is_err(), "{bad}");
        }
    }
}
