//! How are single values on the command line read?

use std::path::PathBuf;
use std::time::Duration;

use catoptra_core::Settings;
use catoptra_tracer::{Region, Size};

use super::{STANDARD, STDOUT};

/// Widest and highest picture, in pixels; also what one side of a PNG viewer commonly takes.
const LONGEST_SIDE: u32 = 32_768;

/// Most frames of a turntable: an hour of a film.
const MOST_FRAMES: u32 = 100_000;

/// Most pixels of a picture: a film of this many fits the memory of a common computer.
const MOST_PIXELS: u64 = 1 << 27;

pub(crate) fn or_stdout(path: PathBuf) -> PathBuf {
    if path.as_os_str() == STANDARD { PathBuf::from(STDOUT) } else { path }
}

/// Reads `WIDTHxHEIGHT`.
pub(crate) fn size(text: &str) -> Result<Size, String> {
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
pub(crate) fn crop(text: &str) -> Result<Region, String> {
    let wanted = || "a part is written X,Y,WIDTH,HEIGHT in pixels, such as 100,50,64,64".to_owned();
    let numbers: Result<Vec<u32>, _> = text.split(',').map(str::parse).collect();
    match numbers.map_err(|_| wanted())?[..] {
        [x, y, width, height] if width > 0 && height > 0 => Ok(Region::new(x, y, Size { width, height })),
        [_, _, _, _] => Err("a part has at least one pixel".to_owned()),
        _ => Err(wanted()),
    }
}

/// Reads the edge of a tile.
pub(crate) fn tile(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(edge) if (4..=4096).contains(&edge) && edge.is_multiple_of(4) => Ok(edge),
        _ => Err("the edge of a tile is a multiple of 4, from 4 to 4096".to_owned()),
    }
}

/// Reads a number of samples.
pub(crate) fn samples(text: &str) -> Result<u32, String> {
    let most = Settings::MAX_SAMPLES;
    match text.parse::<u32>() {
        Ok(count) if (1..=most).contains(&count) => Ok(count),
        _ => Err(format!("samples are a whole number from 1 to {most}")),
    }
}

/// Reads a radiance to cut off at.
pub(crate) fn clamp(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(most) if most > 0.0 && most.is_finite() => Ok(most),
        _ => Err("a radiance to cut off at is a number greater than 0".to_owned()),
    }
}

/// Reads an exposure in stops.
pub(crate) fn exposure(text: &str) -> Result<f64, String> {
    let most = Settings::MAX_EXPOSURE;
    match text.parse::<f64>() {
        Ok(stops) if stops.abs() <= most => Ok(stops),
        _ => Err(format!("an exposure is a number of stops from -{most} to {most}")),
    }
}

/// Reads a standard error to come under.
pub(crate) fn max_error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if error > 0.0 && error.is_finite() => Ok(error),
        _ => Err("an error to come under is a number greater than 0, such as 0.01".to_owned()),
    }
}

/// Reads a time in seconds.
pub(crate) fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| *seconds > 0.0);
    let time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    time.ok_or_else(|| "a time is a number of seconds greater than 0".to_owned())
}

/// Reads a number of frames.
pub(crate) fn frames(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(count) if (1..=MOST_FRAMES).contains(&count) => Ok(count),
        _ => Err(format!("frames are a whole number from 1 to {MOST_FRAMES}")),
    }
}

/// Reads a finite number.
pub(crate) fn finite(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err("this is a finite number".to_owned()),
    }
}

/// Reads a limit: a number from 0 up.
pub(crate) fn limit(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number >= 0.0 && number.is_finite() => Ok(number),
        _ => Err("a limit is a number from 0 up".to_owned()),
    }
}

#[cfg(test)]
mod tests {

    use super::*;

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
    fn frames_are_counted_from_one() {
        assert_eq!([frames("1"), frames("100000")], [Ok(1), Ok(100_000)]);
        for bad in ["0", "100001", "-1", "1.5", "x"] {
            assert!(frames(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn limits_refuse_what_cannot_be_passed() {
        for bad in ["NaN", "-1", "inf", "x"] {
            assert!(limit(bad).is_err(), "{bad}");
        }
    }
}
