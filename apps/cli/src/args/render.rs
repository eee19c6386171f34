//! Which options does `catoptra render` have?

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};

use super::JobArgs;
use super::values::{exposure, finite, frames, max_error, or_stdout, seconds};

#[derive(Args)]
pub(crate) struct RenderArgs {
    /// Scene files (.kdl) or model files (.obj, .glb and so on), or - for standard input
    #[arg(required = true, value_name = "SCENE")]
    pub(crate) scenes: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) job: JobArgs,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
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
    /// On Ctrl-C, write the part of the picture that is traced by then; the rest of it is black
    #[arg(long)]
    pub(crate) keep_partial: bool,
    /// Render so many pictures while the camera turns by --turn
    #[arg(long, value_name = "N", value_parser = frames, requires = "turn")]
    pub(crate) frames: Option<u32>,
    /// By how many degrees the camera turns in all, about which axis: through what it looks at, or else the middle of the scene. The
    /// next frame after the last would be the end of the turn, so that 360 makes a loop
    #[arg(long, num_args = 4, value_names = ["DEGREES", "X", "Y", "Z"], value_parser = finite, allow_negative_numbers = true)]
    #[arg(requires = "frames")]
    pub(crate) turn: Option<Vec<f64>>,
    /// Time N frames after a warm-up: from snapshot to film, without files and parsing
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) repeat: Option<u32>,
    /// Write counts and times as a JSON object; - is standard output
    #[arg(long, value_name = "FILE.json", value_parser = PathBufValueParser::new().map(or_stdout))]
    pub(crate) stats: Option<PathBuf>,
}

/// What a picture file holds, and where it goes.
#[derive(Args)]
pub(crate) struct PictureArgs {
    /// Picture to write: .png (8 bits, as displayed) or .exr (linear, 32 bits); - is standard output. {scene}, {camera} and {frame} in
    /// it stand for the names of these [default: SCENE.png in the current folder, unless --repeat, --stats or --film is given]
    #[arg(short, long, value_name = "FILE", value_parser = PathBufValueParser::new().map(or_stdout))]
    pub(crate) output: Option<PathBuf>,
    /// Write over a picture that is there, where --output names none
    #[arg(long)]
    pub(crate) force: bool,
    /// Format of the picture: png or exr [default: what the name ends in, exr with --layers, or else png]
    #[arg(long, value_name = "NAME")]
    pub(crate) format: Option<String>,
    /// Display transform of a .png: linear, srgb or filmic [default: srgb]
    #[arg(long, value_name = "NAME")]
    pub(crate) display: Option<String>,
    /// Brighten a .png by so many stops, each a factor of 2 [default: the scene's setting, or 0]
    #[arg(long, value_name = "STOPS", value_parser = exposure, allow_negative_numbers = true)]
    pub(crate) exposure: Option<f64>,
    /// Channels of an .exr, with commas between: color (R G B), depth (Z), normal, albedo, uv, id, samples, error [default: color]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) layers: Vec<String>,
    /// How an .exr is packed, without loss: zip, piz, rle or none [default: zip]
    #[arg(long, value_name = "NAME")]
    pub(crate) compression: Option<String>,
    /// Leave out of an .exr how it was made (version, scene, camera, command, seconds): equal pictures are equal files then
    #[arg(long)]
    pub(crate) reproducible: bool,
}
