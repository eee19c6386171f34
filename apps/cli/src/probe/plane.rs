//! Which points does a plane have, and what do numbers say about the light on it?

use std::fmt::Write;
use std::str::FromStr;

use catoptra_core::glam::DVec3;
use catoptra_tracer::{Irradiance, Receiver};
use miette::{IntoDiagnostic, Result};
use serde_json::{Value, json};

use crate::numbers::{in_full, rounded};

/// A parallelogram in equal cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    corner: DVec3,
    edges: [DVec3; 2],
    /// Cells along each edge.
    pub(super) cells: [u32; 2],
}

/// Most cells of a plane.
const MOST_CELLS: u64 = 1 << 24;

impl FromStr for Plane {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = "a plane is nine numbers (a corner, an edge u, an edge v) and NxM, such as \"0 0.8 0  4 0 0  0 0 -3  40x30\"";
        let words: Vec<&str> = text.split([' ', ',', '\t']).filter(|word| !word.is_empty()).collect();
        let Some((cells, numbers)) = words.split_last().filter(|(_, numbers)| numbers.len() == 9) else {
            return Err(format!("{wanted}; this has {} words", words.len()));
        };
        let mut values = [0.0; 9];
        for (value, word) in values.iter_mut().zip(numbers) {
            let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
            *value = number.ok_or_else(|| format!("`{word}` is no finite number: {wanted}"))?;
        }
        let [corner, u, v] = [0, 3, 6].map(|at| DVec3::from_slice(&values[at..at + 3]));
        let count = |digits: &str| digits.parse::<u32>().ok().filter(|count| *count > 0);
        let cells = cells.split_once(['x', 'X', '×']).and_then(|(n, m)| Some([count(n)?, count(m)?]));
        let cells =
            cells.ok_or_else(|| format!("the last word is how many cells there are, NxM: {wanted}"))?;
        if u64::from(cells[0]) * u64::from(cells[1]) > MOST_CELLS {
            return Err(format!("a plane may have at most {MOST_CELLS} cells"));
        }
        let plane = Self { corner, edges: [u, v], cells };
        if plane.normal().is_none() {
            return Err("the edges u and v must span an area".to_owned());
        }
        Ok(plane)
    }
}

impl Plane {
    /// u × v, of unit length.
    fn normal(&self) -> Option<DVec3> {
        let [u, v] = self.edges.map(DVec3::try_normalize);
        u?.cross(v?).try_normalize()
    }

    /// In the middle of each cell, row by row from the corner on, u first.
    pub(super) fn receivers(&self) -> Result<Vec<Receiver>> {
        let ([columns, rows], [u, v]) = (self.cells, self.edges);
        let share = |i: u32, of: u32| (f64::from(i) + 0.5) / f64::from(of);
        let normal = self.normal().unwrap_or(DVec3::ZERO);
        let points = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        let receiver = |(i, j)| {
            Receiver::new(self.corner + u * share(i, columns) + v * share(j, rows), normal).into_diagnostic()
        };
        points.map(receiver).collect()
    }
}

/// The light on a plane, as one number a cell: 0.2126 red + 0.7152 green + 0.0722 blue.
pub(super) struct Plan<'a> {
    pub(super) plane: &'a Plane,
    /// Row by row from the corner on.
    pub(super) values: Vec<f64>,
    /// The largest standard error.
    error: f64,
}

/// Digits of a number of the printed grid.
const DIGITS: usize = 6;

impl<'a> Plan<'a> {
    pub(super) fn new(plane: &'a Plane, found: &[Irradiance]) -> Self {
        let values = found.iter().map(|found| found.mean.luminance()).collect();
        let error = found.iter().map(|found| found.error.luminance()).fold(0.0, f64::max);
        Self { plane, values, error }
    }

    /// The least and the largest number.
    pub(super) fn range(&self) -> [f64; 2] {
        let least = self.values.iter().copied().fold(f64::INFINITY, f64::min);
        [least, self.values.iter().copied().fold(0.0, f64::max)]
    }

    fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// The least number over the mean (EN 12464-1); 0 where all is dark.
    fn uniformity(&self) -> f64 {
        if self.mean() > 0.0 { self.range()[0] / self.mean() } else { 0.0 }
    }

    fn rows(&self) -> impl DoubleEndedIterator<Item = &[f64]> {
        self.values.chunks(self.plane.cells[0] as usize)
    }

    /// A line for each row, as the picture shows them: the row at the end of v first, u to the right.
    pub(super) fn as_text(&self) -> String {
        let mut text = String::new();
        for row in self.rows().rev() {
            let numbers: Vec<String> = row.iter().map(|value| rounded(*value, DIGITS)).collect();
            let _ = writeln!(text, "{}", numbers.join(" "));
        }
        let [least, most] = self.range();
        let _ = writeln!(
            text,
            "# min {} mean {} max {} uniformity {} (min / mean), standard error at most {}",
            in_full(least),
            in_full(self.mean()),
            in_full(most),
            rounded(self.uniformity(), 4),
            rounded(self.error, 2)
        );
        text
    }

    /// Rows from the corner on.
    pub(super) fn as_json(&self, scene: &str) -> Value {
        let ([least, most], [u, v]) = (self.range(), self.plane.edges);
        json!({
            "scene": scene,
            "corner": self.plane.corner.to_array(),
            "u": u.to_array(),
            "v": v.to_array(),
            "cells": self.plane.cells,
            "min": least,
            "mean": self.mean(),
            "max": most,
            "uniformity": self.uniformity(),
            "error": self.error,
            "rows": self.rows().collect::<Vec<_>>(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_the_middles_of_cells_and_look_along_u_cross_v() {
        let plane: Plane = "0 1 0, 4 0 0, 0 0 -2, 4x1".parse().unwrap();
        let receivers = plane.receivers().unwrap();
        assert_eq!(receivers.len(), 4);
        assert_eq!(receivers[1], Receiver::new(DVec3::new(1.5, 1.0, -1.0), DVec3::Y).unwrap());
    }

    #[test]
    fn what_is_no_plane_is_refused() {
        for (text, words) in [
            ("", "this has 0 words"),
            ("0 0 0 1 0 0 0 1 0", "this has 9 words"),
            ("0 0 0 1 0 0 0 1 0 4", "NxM"),
            ("0 0 0 1 0 0 0 1 0 0x4", "NxM"),
            ("0 0 x 1 0 0 0 1 0 4x4", "`x`"),
            ("0 0 inf 1 0 0 0 1 0 4x4", "`inf`"),
            ("0 0 0 1 0 0 2 0 0 4x4", "span"),
            ("0 0 0 1 0 0 0 0 0 4x4", "span"),
            ("0 0 0 1 0 0 0 1 0 9999x9999", "at most"),
        ] {
            let error = text.parse::<Plane>().unwrap_err();
            assert!(error.contains(words), "{text}: {error}");
        }
    }

    #[test]
    fn a_plan_sums_up_and_stands_upright() {
        let plane: Plane = "0 0 0  1 0 0  0 1 0  2x2".parse().unwrap();
        let grey =
            |mean: f64| Irradiance { mean: catoptra_core::Rgb::grey(mean), error: catoptra_core::Rgb::BLACK };
        let plan = Plan::new(&plane, &[1.0, 2.0, 3.0, 6.0].map(grey));
        assert_eq!((plan.range(), plan.mean()), ([1.0, 6.0], 3.0));
        let text = plan.as_text();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[..2], ["3 6", "1 2"]);
        assert!(lines[2].contains("uniformity 0.3333"), "{text}");
    }
}
