//! One number per pixel, and its convolution with a separable filter.

/// One value per pixel, row-major; not empty.
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) values: Vec<f64>,
}

/// An odd number of weights, the middle one for the pixel itself.
pub(super) type Weights = Vec<f64>;

/// The weights `weight(-radius) ..= weight(radius)`.
pub(super) fn weights(radius: i32, weight: impl Fn(f64) -> f64) -> Weights {
    (-radius..=radius).map(|x| weight(f64::from(x))).collect()
}

/// Scaled so that the positive weights sum to 1 and the negative ones to -1.
pub(super) fn balanced(weights: Weights) -> Weights {
    let positive: f64 = weights.iter().filter(|w| **w > 0.0).sum();
    let negative: f64 = weights.iter().filter(|w| **w < 0.0).sum();
    let scaled = |w: f64| match w {
        w if w > 0.0 => w / positive,
        w if w < 0.0 => w / -negative,
        _ => 0.0,
    };
    weights.into_iter().map(scaled).collect()
}

impl Plane {
    /// Filtered along rows and then along columns; beyond the border the border's value goes on.
    pub(super) fn filtered(&self, along_row: &[f64], along_column: &[f64]) -> Self {
        let (width, height) = (self.width, self.values.len() / self.width);
        let mut across = vec![0.0; self.values.len()];
        for (out, row) in across.chunks_exact_mut(width).zip(self.values.chunks_exact(width)) {
            for (x, out) in out.iter_mut().enumerate() {
                *out =
                    along_row.iter().enumerate().map(|(i, w)| w * row[reach(x, i, along_row, width)]).sum();
            }
        }
        let mut values = vec![0.0; self.values.len()];
        for (y, out) in values.chunks_exact_mut(width).enumerate() {
            for (i, weight) in along_column.iter().enumerate() {
                let row = &across[reach(y, i, along_column, height) * width..][..width];
                out.iter_mut().zip(row).for_each(|(out, value)| *out += weight * value);
            }
        }
        Self { width, values }
    }
}

/// The index that weight number `weight` reads for the output at `at`, held inside `0..length`.
fn reach(at: usize, weight: usize, weights: &[f64], length: usize) -> usize {
    (at + weight).saturating_sub(weights.len() / 2).min(length - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_of_sum_one_keeps_an_even_plane_up_to_its_border() {
        let plane = Plane { width: 3, values: vec![2.0; 6] };
        let out = plane.filtered(&[0.25, 0.5, 0.25], &[0.1, 0.2, 0.4, 0.2, 0.1]);
        assert!(out.values.iter().all(|value| (value - 2.0).abs() < 1e-12));
    }

    #[test]
    fn weights_reach_left_and_right_in_order() {
        let plane = Plane { width: 3, values: vec![1.0, 10.0, 100.0] };
        assert_eq!(plane.filtered(&[1.0, 2.0, 3.0], &[1.0]).values, [33.0, 321.0, 510.0]);
    }

    #[test]
    fn both_signs_are_balanced() {
        assert_eq!(balanced(vec![-1.0, -3.0, 2.0]), [-0.25, -0.75, 1.0]);
    }
}
