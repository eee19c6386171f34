//! LDR-FLIP: how large is the difference one perceives when flipping between two pictures on one display?
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating Images",
//! Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020. Two pipelines meet in one error per pixel: colours are filtered with the
//! contrast sensitivity of the eye and compared with the HyAB distance in a Hunt-adjusted Lab space; edges and points are
//! detected in the luminance and compared in strength; the feature difference then sharpens the colour difference.

mod color;
mod feature;
mod plane;

use super::{Metric, Viewing};
use crate::Pair;

/// Mean LDR-FLIP.
pub(super) const METRIC: Metric =
    Metric { name: "flip", doc: "mean LDR-FLIP, 0 to 1, of linear values clamped to 0..1", measure };

fn measure(pair: Pair<'_>, viewing: &Viewing) -> f64 {
    let map = flip_map(pair, viewing);
    map.iter().sum::<f64>() / map.len() as f64
}

/// FLIP of each pixel, 0 to 1, row-major; pictures are linear Rec. 709 and are clamped to 0..1, as a display clamps them.
///
/// Costs a few hundred multiplications per pixel at the default 67 pixels per degree, growing with `pixels_per_degree`.
pub fn flip_map(pair: Pair<'_>, viewing: &Viewing) -> Vec<f64> {
    let [reference, test] = [pair.reference(), pair.test()].map(color::opponent);
    let colors = color::differences(&reference, &test, viewing.pixels_per_degree);
    let features = feature::differences(&reference[0], &test[0], viewing.pixels_per_degree);
    colors.iter().zip(&features).map(|(color, feature)| color.powf(1.0 - feature)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Picture;

    const WIDTH: u32 = 48;
    const HEIGHT: u32 = 40;

    fn gradient(x: u32, y: u32) -> [f32; 3] {
        let share = |part: u32, whole: u32| (f64::from(part) / f64::from(whole)) as f32;
        [share(x, WIDTH - 1), share(y, HEIGHT - 1), share(x + y, WIDTH + HEIGHT - 2)]
    }

    /// A byte of noise in 0..=1 for a pixel and a channel.
    fn noise(x: u32, y: u32, channel: u32) -> f32 {
        let mut h =
            x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663) ^ channel.wrapping_mul(83_492_791);
        h = (h ^ (h >> 13)).wrapping_mul(1_274_126_177);
        ((h >> 16) & 0xff) as f32 / 255.0
    }

    /// The mean and the values at (20,17), (0,0) and (24,20).
    fn flip(reference: fn(u32, u32) -> [f32; 3], test: fn(u32, u32) -> [f32; 3]) -> [f64; 4] {
        let [a, b] = [reference, test].map(|paint| Picture::painted(WIDTH, HEIGHT, paint).unwrap());
        let map = flip_map(Pair::new(&a, &b).unwrap(), &Viewing::default());
        let at = |x: usize, y: usize| map[y * WIDTH as usize + x];
        [map.iter().sum::<f64>() / map.len() as f64, at(20, 17), at(0, 0), at(24, 20)]
    }

    /// The expected numbers of these tests were computed from the same pictures with flip-evaluator 1.7, the program of the
    /// paper's authors, which works in f32.
    fn assert_close(found: [f64; 4], expected: [f64; 4]) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 2e-4, "{found} instead of {expected}");
        }
    }

    #[test]
    fn black_against_white() {
        assert_close(flip(|_, _| [0.0; 3], |_, _| [1.0; 3]), [0.967_401, 0.967_388, 0.967_388, 0.967_388]);
    }

    #[test]
    fn green_against_blue_is_the_largest_difference() {
        assert_close(flip(|_, _| [0.0, 1.0, 0.0], |_, _| [0.0, 0.0, 1.0]), [1.0; 4]);
    }

    #[test]
    fn an_edge_moved_by_a_pixel() {
        assert_close(
            flip(
                |x, _| if x >= WIDTH / 2 { [0.75; 3] } else { [0.25; 3] },
                |x, _| if x > WIDTH / 2 { [0.75; 3] } else { [0.25; 3] },
            ),
            [0.032_336, 0.011_229, 0.0, 0.326_144],
        );
    }

    #[test]
    fn noise_over_a_gradient() {
        let noisy = |x, y| std::array::from_fn(|c| 0.5 * gradient(x, y)[c] + 0.25 * noise(x, y, c as u32));
        assert_close(
            flip(|x, y| gradient(x, y).map(|v| 0.5 * v), noisy),
            [0.398_528, 0.392_838, 0.736_970, 0.328_968],
        );
    }

    #[test]
    fn a_single_bright_pixel() {
        let dot = |x, y| if (x, y) == (20, 17) { [1.0; 3] } else { [0.0; 3] };
        assert_close(flip(|_, _| [0.0; 3], dot), [0.007_453, 0.864_906, 0.0, 0.001_171]);
    }

    #[test]
    fn a_gradient_tinted() {
        let tinted = |x, y| {
            let [r, g, b] = gradient(x, y);
            [r, 0.8 * g, 0.9 * b]
        };
        assert_close(flip(gradient, tinted), [0.338_553, 0.342_643, 0.099_977, 0.361_116]);
    }
}
