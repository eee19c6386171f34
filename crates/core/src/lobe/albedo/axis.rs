//! Where do the values of a table stand, and what is between them?

use crate::numeric::SMOOTH_SLOPE;

/// Four neighbouring values of a table and what each counts: the cubic through them (Lagrange), which is off by the fourth power
/// of their distance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stencil {
    first: usize,
    weights: [f64; 4],
}

impl Stencil {
    /// At `x` in 0..=1 of an axis of `n` ≥ 4 values from 0 to 1.
    pub(super) fn at(x: f64, n: usize) -> Self {
        let place = x.clamp(0.0, 1.0) * (n - 1) as f64;
        let first = (place as usize).saturating_sub(1).min(n - 4);
        let t = place - first as f64;
        let [a, b, c, d] = [t, t - 1.0, t - 2.0, t - 3.0];
        Self { first, weights: [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0] }
    }

    /// The value there. Values that do not count are not asked for.
    pub(super) fn of(&self, value: impl Fn(usize) -> f64) -> f64 {
        let counted = self.weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0);
        counted.map(|(k, weight)| weight * value(self.first + k)).sum()
    }
}

/// A table over two axes, row by row.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    columns: usize,
    values: Vec<f64>,
}

impl Grid {
    /// With the values at each row and column, both from 0 to 1.
    pub(super) fn new(rows: usize, columns: usize, value: impl Fn(f64, f64) -> f64) -> Self {
        let place = |k: usize, n: usize| k as f64 / (n - 1) as f64;
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        Self {
            columns,
            values: cells.map(|(row, column)| value(place(row, rows), place(column, columns))).collect(),
        }
    }

    /// Between the values of four rows and four columns.
    pub(super) fn at(&self, row: f64, column: f64) -> f64 {
        let across = Stencil::at(column, self.columns);
        let rows = Stencil::at(row, self.values.len() / self.columns);
        rows.of(|row| across.of(|column| self.values[row * self.columns + column]))
    }
}

/// A table over slopes alone, finer than others, as what it holds grows by orders of magnitude.
#[derive(Debug, Clone)]
pub(super) struct Means(Vec<f64>);

impl Means {
    /// Values of a [`Means`].
    const ROWS: usize = 81;

    /// With the value at each place of a slope.
    pub(super) fn new(value: impl Fn(f64) -> f64) -> Self {
        Self((0..Self::ROWS).map(|row| value(row as f64 / (Self::ROWS - 1) as f64)).collect())
    }

    /// Between the values of four slopes.
    pub(super) fn at(&self, alpha: f64) -> f64 {
        Stencil::at(place_of_alpha(alpha), Self::ROWS).of(|row| self.0[row])
    }
}

/// Slopes α of 0 to 1 on an axis: by their square root, which is what people call roughness.
pub(super) fn place_of_alpha(alpha: f64) -> f64 {
    let least = SMOOTH_SLOPE.sqrt();
    (alpha.sqrt() - least) / (1.0 - least)
}

/// The slope that stands there.
pub(super) fn alpha_at(place: f64) -> f64 {
    let least = SMOOTH_SLOPE.sqrt();
    let root = least + place * (1.0 - least);
    root * root
}

/// Cosines on an axis that is fine where they are up to `scale`, where things happen.
pub(super) fn place_of_cosine(cosine: f64, scale: f64) -> f64 {
    cosine * (1.0 + scale) / (cosine + scale)
}

/// The cosine that stands there.
pub(super) fn cosine_at(place: f64, scale: f64) -> f64 {
    scale * place / (1.0 + scale - place)
}

/// Cosines on an axis that is fine within `scale` of 0 and of a cosine `edge`, which stands in its middle.
pub(super) fn place_about_edge(cosine: f64, edge: f64, scale: f64) -> f64 {
    if cosine < edge {
        let (x, scale) = (cosine / edge, scale / edge);
        0.25 * (place_of_cosine(x, scale) + 1.0 - place_of_cosine(1.0 - x, scale))
    } else {
        let rest = 1.0 - edge;
        0.5 + 0.5 * place_of_cosine((cosine - edge) / rest, scale / rest)
    }
}

/// The cosine that stands there, by bisection.
pub(super) fn cosine_about_edge(place: f64, edge: f64, scale: f64) -> f64 {
    let [mut low, mut high] = [0.0, 1.0];
    for _ in 0..f64::MANTISSA_DIGITS {
        let middle = f64::midpoint(low, high);
        if place_about_edge(middle, edge, scale) < place { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_met_exactly() {
        let cubic = |x: f64| 2.0 - x + 3.0 * x * x - 5.0 * x * x * x;
        let grid = Grid::new(7, 5, |row, column| cubic(row) * cubic(column));
        for (row, column) in [(0.0, 0.0), (1.0, 1.0), (0.3, 0.99), (0.51, 0.02), (2.0, -1.0)] {
            let expected = cubic(f64::clamp(row, 0.0, 1.0)) * cubic(f64::clamp(column, 0.0, 1.0));
            assert!((grid.at(row, column) - expected).abs() < 1e-13, "{row} {column}");
        }
    }

    #[test]
    fn places_are_undone() {
        for x in [0.0, 0.2, 0.7, 1.0] {
            assert!((place_of_alpha(alpha_at(x)) - x).abs() < 1e-14);
            assert!((place_of_cosine(cosine_at(x, 0.05), 0.05) - x).abs() < 1e-14);
            assert!((place_about_edge(cosine_about_edge(x, 0.7, 0.05), 0.7, 0.05) - x).abs() < 1e-14);
        }
    }
}
