//! The feature half of FLIP: how much do edges and points differ in strength?

use super::plane::{Plane, balanced, weights};

/// Width of the detectors in degrees (paper, section 4.2): the peak-to-trough distance of an edge that eyes find best.
const WIDTH: f64 = 0.082;

/// Feature difference of each pixel, 0 to 1, of two planes of luminance in 0..1.
pub(super) fn differences(reference: &Plane, test: &Plane, pixels_per_degree: f64) -> Vec<f64> {
    let deviation = 0.5 * WIDTH * pixels_per_degree;
    let [reference, test] = [reference, test].map(|plane| strengths(plane, deviation));
    let difference = |((edge_a, point_a), (edge_b, point_b)): (&(f64, f64), &(f64, f64))| {
        ((edge_a - edge_b).abs().max((point_a - point_b).abs()) * std::f64::consts::FRAC_1_SQRT_2).sqrt()
    };
    reference.iter().zip(&test).map(difference).collect()
}

/// Edge and point strength of each pixel: the lengths of the first and of the second derivatives of a Gaussian of the given
/// standard deviation in pixels, along both axes.
fn strengths(plane: &Plane, deviation: f64) -> Vec<(f64, f64)> {
    let radius = (3.0 * deviation).ceil() as i32;
    let bell = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
    let smooth = balanced(weights(radius, bell));
    let edge = balanced(weights(radius, |x| -x * bell(x)));
    let point = balanced(weights(radius, |x| (x * x / (deviation * deviation) - 1.0) * bell(x)));
    let length = |detector: &[f64]| {
        let (across, down) = (plane.filtered(detector, &smooth), plane.filtered(&smooth, detector));
        let lengths = across.values.iter().zip(&down.values).map(|(x, y)| x.hypot(*y));
        lengths.collect::<Vec<f64>>()
    };
    length(&edge).into_iter().zip(length(&point)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_plane_has_neither_edges_nor_points() {
        let strengths = strengths(&Plane { width: 8, values: vec![0.5; 64] }, 2.75);
        assert!(strengths.iter().all(|(edge, point)| *edge < 1e-12 && *point < 1e-12));
    }

    #[test]
    fn a_step_is_strongest_as_an_edge_where_it_stands() {
        let values: Vec<f64> = (0..40 * 40).map(|i| if i % 40 < 20 { 0.0 } else { 1.0 }).collect();
        let strengths = strengths(&Plane { width: 40, values }, 2.75);
        assert!(strengths[20 * 40 + 20].0 > 2.0 * strengths[20 * 40 + 26].0);
    }
}
