//! How is the viewer started? Its command line.

use std::path::PathBuf;

use clap::Parser;

use crate::parts::USUAL_ERROR;

/// The smallest and largest window asked for, in pixels each way.
const SIZES: std::ops::RangeInclusive<u32> = 1..=16384;

/// Shows a ray-traced scene in a window, to be turned, lit and changed. F1 in the window lists the keys.
#[derive(Debug, Clone, Parser)]
#[command(name = "catoptra-viewer", version)]
pub(crate) struct Options {
    /// Scene file to open; without one a built-in scene is shown.
    pub(crate) file: Option<PathBuf>,
    /// Threads that trace [default: one per core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Size of the window's content in logical pixels: on a display of scale 2 each is two pixels wide and high.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub(crate) size: (u32, u32),
    /// Refine the picture at rest until the standard error of what is displayed of each pixel, 0 to 1, is under E, or samples
    /// are many; a scene's own setting comes first.
    #[arg(long, value_name = "E", default_value_t = USUAL_ERROR, value_parser = max_error)]
    pub(crate) max_error: f64,
    /// Write a line on stderr for each finished frame: milliseconds, rays, size.
    #[arg(long)]
    pub(crate) log_frames: bool,
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    match sides {
        Some((w, h)) if SIZES.contains(&w) && SIZES.contains(&h) => Ok((w, h)),
        _ => Err(format!("a size is WIDTHxHEIGHT with sides of {} to {}", SIZES.start(), SIZES.end())),
    }
}

fn max_error(text: &str) -> Result<f64, String> {
    let error = text.parse().ok().filter(|error: &f64| error.is_finite() && *error > 0.0);
    error.ok_or_else(|| "an error is a number above 0".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_has_two_sides() {
        assert_eq!(size("1280x720"), Ok((1280, 720)));
        for wrong in ["", "x", "5", "0x5", "5x", "-3x4", "99999x2", "4x4x4"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn an_error_is_above_zero() {
        assert_eq!(max_error("0.01"), Ok(0.01));
        for wrong in ["", "0", "-1", "nan", "inf", "x"] {
            assert!(max_error(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn threads_are_as_many_as_can_be() {
        let threads = |count| Options::try_parse_from(["catoptra-viewer", "--threads", count]);
        assert_eq!(threads("8").unwrap().threads, Some(8));
        for wrong in ["0", "1025", "99999999999", "-1", "x"] {
            assert!(threads(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory as _;
        Options::command().debug_assert();
    }
}
