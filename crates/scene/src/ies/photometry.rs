//! What stands in an IES file: its label, its tilt, its counts, its angles and its intensities, in that order.

use super::error::{Fault, Place};
use super::text::{Number, Text, parse};

/// How the angles of a file are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Planes round a vertical axis, vertical angles from nadir.
    C,
    /// Planes round a horizontal axis.
    B,
    /// Planes round a vertical axis, vertical angles from the horizontal.
    A,
}

/// The numbers of a file that a profile is made of.
pub(super) struct Photometry {
    pub(super) kind: Kind,
    /// Degrees, ascending.
    pub(super) vertical: Vec<Number>,
    /// Degrees, ascending.
    pub(super) horizontal: Vec<Number>,
    /// With all factors: for each horizontal angle, those of the vertical ones.
    pub(super) candela: Vec<f64>,
}

/// Reads a file.
///
/// # Errors
/// What is no IES file, and numbers that are missing or cannot be.
pub(super) fn read(bytes: &[u8]) -> Result<Photometry, Fault> {
    let mut text = Text::new(bytes)?;
    let version = label(&mut text)?;
    text.number("the number of lamps")?;
    text.number("the lumens per lamp")?;
    let multiplier = positive(text.number("the candela multiplier")?, "the candela multiplier")?;
    let rows = count(&mut text, "the number of vertical angles", 2)?;
    let columns = count(&mut text, "the number of horizontal angles", 1)?;
    let kind = kind(&mut text)?;
    for what in ["the type of units", "the width", "the length", "the height"] {
        text.number(what)?;
    }
    let ballast = positive(text.number("the ballast factor")?, "the ballast factor")?;
    let lamp = text.number("the ballast-lamp photometric factor")?;
    let lamp = match version {
        Version::Early => positive(lamp, "the ballast-lamp photometric factor")?,
        Version::Late => 1.0,
    };
    text.number("the input watts")?;
    check_room(&text, rows.value, columns.value, columns.place)?;
    let vertical = angles(&mut text, "vertical", rows.value as usize)?;
    let horizontal = angles(&mut text, "horizontal", columns.value as usize)?;
    let factor = multiplier * ballast * lamp;
    let candela = intensities(&mut text, &vertical, &horizontal, factor)?;
    if let Some((place, word)) = text.word()
        && parse(word).is_some()
    {
        let all = candela.len();
        let message = format!("more than {all} intensities: the numbers of angles do not fit what follows");
        return Err(Fault::at(place, message));
    }
    Ok(Photometry { kind, vertical, horizontal, candela })
}

/// What the number behind the ballast factor means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Version {
    /// Up to 1995: a factor.
    Early,
    /// From 2002 on: nothing, or a code.
    Late,
}

/// Reads the label, and the tilt behind it.
fn label(text: &mut Text<'_>) -> Result<Version, Fault> {
    let mut version = Version::Early;
    let mut is_first = true;
    while let Some((place, line)) = text.line() {
        let upper = line.to_ascii_uppercase();
        if is_first && !line.is_empty() {
            is_first = false;
            let has = |year: &[u8]| upper.windows(year.len()).any(|part| part == year);
            if has(b"LM-63-20") || has(b"LM-63-02") || upper.ends_with(b"LM-63-19") {
                version = Version::Late;
            }
        }
        if let Some(tilt) = upper.strip_prefix(b"TILT").map(<[u8]>::trim_ascii_start)
            && let Some(tilt) = tilt.strip_prefix(b"=")
        {
            let written = &line[line.len() - tilt.len()..];
            pass_tilt(text, place, tilt.trim_ascii(), written.trim_ascii())?;
            return Ok(version);
        }
    }
    Err(Fault::file("is no IES file: no line begins with TILT="))
}

/// Goes past the tilt of the lamp.
fn pass_tilt(text: &mut Text<'_>, place: Place, tilt: &[u8], written: &[u8]) -> Result<(), Fault> {
    match tilt {
        b"NONE" => Ok(()),
        b"INCLUDE" => {
            text.number("the lamp-to-luminaire geometry")?;
            let pairs = count(text, "the number of tilt angles", 0)?;
            check_room(text, pairs.value, 1.0, pairs.place)?;
            for _ in 0..pairs.value as usize {
                text.number("a tilt angle")?;
            }
            for _ in 0..pairs.value as usize {
                text.number("the factor of a tilt angle")?;
            }
            Ok(())
        }
        b"" => Err(Fault::at(place, "TILT= must be followed by NONE or INCLUDE")),
        _ => {
            let written = String::from_utf8_lossy(written);
            let message = format!(
                "tilt factors in a file of their own (\"{written}\") are not read: write TILT=NONE to do without"
            );
            Err(Fault::at(place, message))
        }
    }
}

fn positive(number: Number, what: &str) -> Result<f64, Fault> {
    if number.value > 0.0 {
        return Ok(number.value);
    }
    Err(Fault::at(number.place, format!("{what} must be greater than 0, not {}", number.value)))
}

/// A whole number of at least `least`.
fn count(text: &mut Text<'_>, what: &str, least: u32) -> Result<Number, Fault> {
    let number = text.number(what)?;
    if number.value.fract() == 0.0 && number.value >= f64::from(least) {
        return Ok(number);
    }
    let message = format!("{what} must be a whole number of at least {least}, not {}", number.value);
    Err(Fault::at(number.place, message))
}

fn kind(text: &mut Text<'_>) -> Result<Kind, Fault> {
    let number = text.number("the photometric type")?;
    match number.value {
        1.0 => Ok(Kind::C),
        2.0 => Ok(Kind::B),
        3.0 => Ok(Kind::A),
        other => {
            let message = format!("the photometric type must be 1 (C), 2 (B) or 3 (A), not {other}");
            Err(Fault::at(number.place, message))
        }
    }
}

/// Refuses counts that the rest of the file has no room for, each number taking a digit and a blank.
fn check_room(text: &Text<'_>, rows: f64, columns: f64, place: Place) -> Result<(), Fault> {
    let (claimed, room) = (rows * columns + rows + columns, text.left().div_ceil(2));
    if claimed <= room as f64 {
        return Ok(());
    }
    let message = format!(
        "{rows} by {columns} angles need {claimed} numbers, and at most {room} can follow in the file"
    );
    Err(Fault::at(place, message))
}

/// So many ascending angles.
fn angles(text: &mut Text<'_>, which: &str, count: usize) -> Result<Vec<Number>, Fault> {
    let mut angles: Vec<Number> = Vec::with_capacity(count);
    for i in 1..=count {
        let angle = text.number(&format!("{which} angle {i} of {count}"))?;
        if let Some(before) = angles.last().filter(|before| angle.value <= before.value) {
            let message = format!("{which} angles must increase: {} follows {}", angle.value, before.value);
            return Err(Fault::at(angle.place, message));
        }
        angles.push(angle);
    }
    Ok(angles)
}

fn intensities(
    text: &mut Text<'_>,
    vertical: &[Number],
    horizontal: &[Number],
    factor: f64,
) -> Result<Vec<f64>, Fault> {
    let mut candela = Vec::with_capacity(vertical.len() * horizontal.len());
    for h in horizontal {
        for v in vertical {
            let what = || format!("the intensity at vertical angle {} and horizontal {}", v.value, h.value);
            let number = match text.number("an intensity") {
                Ok(number) => number,
                Err(fault) => {
                    let all = vertical.len() * horizontal.len();
                    return Err(fault.within(format!("{} of {all}: {}", candela.len() + 1, what())));
                }
            };
            let value = number.value * factor;
            if !(number.value >= 0.0 && value <= f64::from(f32::MAX)) {
                let message = format!("{} must lie in 0..3.4e38 cd, not {}", what(), number.value);
                return Err(Fault::at(number.place, message));
            }
            candela.push(value);
        }
    }
    Ok(candela)
}
