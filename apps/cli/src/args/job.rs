//! Which options say how frames are made?

use catoptra_tracer::{Film, Region, Size};
use clap::Args;

use super::values::{clamp, crop, samples, size, tile};

/// What a picture is made from: shared by the commands that trace.
#[derive(Args)]
pub(crate) struct JobArgs {
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
