//! How the angles of a file become those of a profile: symmetric halves and quarters are unfolded, and types A and B
//! are turned to polar angles and azimuths (LM-63-2002, section 3: photometric zero and horizontal).

use catoptra_core::IntensityProfile;
use catoptra_core::light::Pole;

use super::error::Fault;
use super::photometry::{Kind, Photometry};
use super::text::Number;

/// Makes the profile.
///
/// # Errors
/// Angles out of the range of the file's photometric type.
pub(super) fn profile(photometry: Photometry) -> Result<IntensityProfile, Fault> {
    let Photometry { kind, vertical, horizontal, candela } = photometry;
    let rows: Vec<Vec<f64>> = candela.chunks_exact(vertical.len()).map(<[f64]>::to_vec).collect();
    let planes = |horizontal: &[Number]| -> Vec<(f64, Vec<f64>)> {
        horizontal.iter().map(|angle| angle.value).zip(rows).collect()
    };
    let degrees = |angles: &[Number]| -> Vec<f64> { angles.iter().map(|angle| angle.value).collect() };
    match kind {
        Kind::C => {
            within(&vertical, "vertical", 0.0, 180.0)?;
            within(&horizontal, "horizontal", 0.0, 360.0)?;
            let planes = all_round(planes(&horizontal), &horizontal)?;
            make(Pole::Nadir, degrees(&vertical), planes)
        }
        Kind::B => {
            within(&vertical, "vertical", -180.0, 180.0)?;
            within(&horizontal, "horizontal", -90.0, 90.0)?;
            let parallels = both_sides(planes(&horizontal), &horizontal)?;
            // Horizontal angles turn clockwise, towards the pole.
            let polar = parallels.iter().rev().map(|(angle, _)| 90.0 - angle).collect();
            let column = |row: usize| parallels.iter().rev().map(|(_, values)| values[row]).collect();
            let azimuths = vertical.iter().enumerate().map(|(row, angle)| (angle.value, column(row)));
            make(Pole::Across, polar, azimuths.collect())
        }
        Kind::A => {
            within(&vertical, "vertical", -90.0, 90.0)?;
            within(&horizontal, "horizontal", -180.0, 180.0)?;
            let planes = both_sides(planes(&horizontal), &horizontal)?;
            let polar = vertical.iter().map(|angle| angle.value + 90.0).collect();
            let counterclockwise = planes.into_iter().rev().map(|(angle, values)| (-angle, values));
            make(Pole::Nadir, polar, counterclockwise.collect())
        }
    }
}

fn make(pole: Pole, polar: Vec<f64>, azimuths: Vec<(f64, Vec<f64>)>) -> Result<IntensityProfile, Fault> {
    let (azimuth, rows): (Vec<f64>, Vec<Vec<f64>>) = azimuths.into_iter().unzip();
    IntensityProfile::new(pole, polar, azimuth, rows.concat()).map_err(Fault::file)
}

fn within(angles: &[Number], which: &str, from: f64, to: f64) -> Result<(), Fault> {
    match angles.iter().find(|angle| !(from..=to).contains(&angle.value)) {
        None => Ok(()),
        Some(angle) => {
            let message = format!("{which} angles must lie in {from}..{to}, not be {}", angle.value);
            Err(Fault::at(angle.place, message))
        }
    }
}

/// Planes of type C, unfolded to a whole turn. One plane is the same all round.
fn all_round(mut planes: Vec<(f64, Vec<f64>)>, angles: &[Number]) -> Result<Vec<(f64, Vec<f64>)>, Fault> {
    let [first, last] = [angles[0], angles[angles.len() - 1]];
    if planes.len() == 1 {
        planes[0].0 = 0.0;
        return Ok(planes);
    }
    let widest = planes.windows(2).map(|pair| pair[1].0 - pair[0].0).fold(0.0, f64::max);
    match (first.value, last.value) {
        (0.0, 90.0) => {
            mirror(&mut planes);
            mirror(&mut planes);
        }
        (0.0, 180.0) | (90.0, 270.0) => mirror(&mut planes),
        (0.0, 360.0) => {}
        // The last plane, which is the first again, was left out.
        (0.0, last) if last > 180.0 && 360.0 - last <= widest => {
            let again = planes[0].1.clone();
            planes.push((360.0, again));
        }
        (first_value, last_value) => {
            let place = if first_value == 0.0 { last.place } else { first.place };
            let message = format!(
                "horizontal angles of type C must be 0 alone or span 0..90, 0..180, 90..270 or 0..360, not \
                 {first_value}..{last_value}"
            );
            return Err(Fault::at(place, message));
        }
    }
    Ok(planes)
}

/// Adds the mirror image of all planes in the last one.
fn mirror(planes: &mut Vec<(f64, Vec<f64>)>) {
    let Some((last, _)) = planes.last().cloned() else { return };
    let images: Vec<_> =
        planes.iter().rev().skip(1).map(|(angle, values)| (2.0 * last - angle, values.clone())).collect();
    planes.extend(images);
}

/// Planes of types A and B: those that begin with 0 stand for both sides.
fn both_sides(planes: Vec<(f64, Vec<f64>)>, angles: &[Number]) -> Result<Vec<(f64, Vec<f64>)>, Fault> {
    let first = angles[0];
    if planes.len() < 2 {
        let message = "types A and B need at least 2 horizontal angles";
        return Err(Fault::at(first.place, message));
    }
    if first.value != 0.0 {
        return Ok(planes);
    }
    let images = planes.iter().skip(1).rev().map(|(angle, values)| (-angle, values.clone()));
    Ok(images.chain(planes.iter().cloned()).collect())
}
