//! The colour half of FLIP: filtered with the eye's contrast sensitivity, compared in Hunt-adjusted Lab.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::plane::{Plane, weights};
use crate::Picture;

/// One term `height * sqrt(PI / spread) * exp(-PI² d² / spread)` of a contrast sensitivity function; d in degrees.
struct Term {
    height: f64,
    spread: f64,
}

/// Contrast sensitivity of the achromatic, the red-green and the blue-yellow channel: the constants of the paper's table 1.
const SENSITIVITY: [&[Term]; 3] = [
    &[Term { height: 1.0, spread: 0.0047 }],
    &[Term { height: 1.0, spread: 0.0053 }],
    &[Term { height: 34.1, spread: 0.04 }, Term { height: 13.5, spread: 0.025 }],
];

/// The widest spread above; all filters are cut at three standard deviations of it.
const WIDEST: f64 = 0.04;

/// Exponent of the colour difference (paper, section 4.1.2).
const EXPONENT: f64 = 0.7;

/// Below `KNEE` of the largest difference, differences are spread over 0..`KNEE_ERROR`; the rest share what is left.
const KNEE: f64 = 0.4;
const KNEE_ERROR: f64 = 0.95;

/// Linear Rec. 709 to CIE XYZ, by columns, from the primaries and white of ITU-R BT.709.
const TO_XYZ: DMat3 = DMat3::from_cols(
    DVec3::new(10_135_552.0 / 24_577_794.0, 2_613_072.0 / 12_288_897.0, 1_425_312.0 / 73_733_382.0),
    DVec3::new(8_788_810.0 / 24_577_794.0, 8_788_810.0 / 12_288_897.0, 8_788_810.0 / 73_733_382.0),
    DVec3::new(4_435_075.0 / 24_577_794.0, 887_015.0 / 12_288_897.0, 70_074_185.0 / 73_733_382.0),
);

/// The XYZ of each pixel over that of white, as luminance and the two opponent differences, one plane each.
///
/// These are the paper's YCxCz without its offset and scale, which no linear filter sees.
pub(super) fn opponent(picture: &Picture) -> [Plane; 3] {
    let white = TO_XYZ * DVec3::ONE;
    let values = |of: fn(DVec3) -> f64| {
        let values = picture.pixels().iter().map(|pixel| {
            let rgb = DVec3::from_array(pixel.map(|value| f64::from(value.clamp(0.0, 1.0))));
            of(TO_XYZ * rgb / white)
        });
        Plane { width: picture.width() as usize, values: values.collect() }
    };
    [values(|xyz| xyz.y), values(|xyz| xyz.x - xyz.y), values(|xyz| xyz.y - xyz.z)]
}

/// Colour difference of each pixel, 0 to 1.
pub(super) fn differences(reference: &[Plane; 3], test: &[Plane; 3], pixels_per_degree: f64) -> Vec<f64> {
    let [reference, test] = [reference, test].map(|planes| perceived(planes, pixels_per_degree));
    let largest = hyab(hunt(DVec3::Y), hunt(DVec3::Z)).powf(EXPONENT);
    reference.iter().zip(&test).map(|(a, b)| redistributed(hyab(*a, *b).powf(EXPONENT), largest)).collect()
}

/// Filtered, clamped to what the display shows, in Hunt-adjusted Lab.
fn perceived(planes: &[Plane; 3], pixels_per_degree: f64) -> Vec<DVec3> {
    let filtered: Vec<Plane> =
        planes.iter().zip(SENSITIVITY).map(|(plane, terms)| seen(plane, terms, pixels_per_degree)).collect();
    let white = TO_XYZ * DVec3::ONE;
    let to_rgb = TO_XYZ.inverse();
    let pixel = |i: usize| {
        let [y, red_green, blue_yellow] = [0, 1, 2].map(|channel| filtered[channel].values[i]);
        let xyz = DVec3::new(y + red_green, y, y - blue_yellow) * white;
        hunt((to_rgb * xyz).clamp(DVec3::ZERO, DVec3::ONE))
    };
    (0..planes[0].values.len()).map(pixel).collect()
}

/// A plane as the eye resolves it: the sum of one Gaussian per term, all weights summing to 1.
fn seen(plane: &Plane, terms: &[Term], pixels_per_degree: f64) -> Plane {
    let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i32;
    let gaussians: Vec<(f64, Vec<f64>)> = terms
        .iter()
        .map(|term| {
            let height = term.height * (PI / term.spread).sqrt();
            (height, weights(radius, |x| (-(PI * x / pixels_per_degree).powi(2) / term.spread).exp()))
        })
        .collect();
    let total: f64 = gaussians.iter().map(|(height, bell)| height * bell.iter().sum::<f64>().powi(2)).sum();
    let mut values = vec![0.0; plane.values.len()];
    for (height, bell) in &gaussians {
        let part = plane.filtered(bell, bell);
        values.iter_mut().zip(&part.values).for_each(|(sum, part)| *sum += height / total * part);
    }
    Plane { width: plane.width, values }
}

/// Linear RGB in 0..1 as CIE Lab with the colour axes scaled by lightness: colours of dark things differ less (Hunt 1952).
fn hunt(rgb: DVec3) -> DVec3 {
    const DELTA: f64 = 6.0 / 29.0;
    let f = |t: f64| if t > DELTA.powi(3) { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 };
    let xyz = TO_XYZ * rgb / (TO_XYZ * DVec3::ONE);
    let (x, y, z) = (f(xyz.x), f(xyz.y), f(xyz.z));
    let lightness = 116.0 * y - 16.0;
    DVec3::new(lightness, 5.0 * (x - y) * lightness, 2.0 * (y - z) * lightness)
}

/// City-block in lightness, Euclidean in the colour axes (Abasi, Amani Tehran, Fairchild 2020): fit for large differences.
fn hyab(a: DVec3, b: DVec3) -> f64 {
    let d = a - b;
    d.x.abs() + d.y.hypot(d.z)
}

/// The difference as an error of 0 to 1, most of the range given to the small differences.
fn redistributed(difference: f64, largest: f64) -> f64 {
    let knee = KNEE * largest;
    if difference < knee {
        difference * KNEE_ERROR / knee
    } else {
        KNEE_ERROR + (difference - knee) / (largest - knee) * (1.0 - KNEE_ERROR)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_has_lightness_100_and_no_color() {
        assert!((hunt(DVec3::ONE) - DVec3::new(100.0, 0.0, 0.0)).length() < 1e-9);
    }

    #[test]
    fn the_knee_joins_both_ranges() {
        assert!((redistributed(0.4 - 1e-12, 1.0) - redistributed(0.4, 1.0)).abs() < 1e-9);
        assert!((redistributed(1.0, 1.0) - 1.0).abs() < 1e-12);
    }
}
