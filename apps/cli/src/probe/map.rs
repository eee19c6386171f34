//! What does the light on a plane look like? False colours, lines of equal light, and a legend.

use catoptra_scene::image::false_color::{Scale, color};

use super::digits;
use super::plane::Plan;
use crate::numbers::rounded;

/// A picture of bytes, row by row from the top left, red, green and blue.
pub(crate) struct Map {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) bytes: Vec<u8>,
}

/// About how long the longer side of the plane is, and least pixels of a cell.
const SIDE: usize = 640;

/// Pixels round and between what is shown, and the width of the legend's bar.
const MARGIN: usize = 12;
const BAR: usize = 24;

const PAPER: [u8; 3] = [255; 3];
const INK: [u8; 3] = [0; 3];

impl Map {
    /// Draws a plan as seen from where its normal points to, u to the right.
    pub(super) fn of(plan: &Plan<'_>) -> Self {
        let [columns, rows] = plan.plane.cells.map(|count| count as usize);
        let cell = (SIDE / columns.max(rows)).max(1);
        let (across, down) = (columns * cell, rows * cell);
        let scale = Scale::of(plan.range());
        let words: Vec<(f64, String)> =
            scale.lines().into_iter().map(|line| (line, rounded(line, 6))).collect();
        let text = words.iter().map(|(_, word)| digits::width(word)).max().unwrap_or(0);
        let text = text.max(digits::width("lx"));
        let tall = down.max(words.len() * 2 * digits::HEIGHT).max(8 * digits::HEIGHT);
        let (width, height) = (across + BAR + text + 4 * MARGIN, tall + digits::HEIGHT + 3 * MARGIN);
        let mut map = Self { width, height, bytes: PAPER.repeat(width * height) };
        map.draw_plane(plan, &scale, cell);
        map.draw_legend(&scale, &words, [across + 2 * MARGIN, tall]);
        map
    }

    fn paint(&mut self, x: usize, y: usize, color: [u8; 3]) {
        if x < self.width && y < self.height {
            let at = 3 * (y * self.width + x);
            self.bytes[at..at + 3].copy_from_slice(&color);
        }
    }

    fn draw_plane(&mut self, plan: &Plan<'_>, scale: &Scale, cell: usize) {
        let [columns, rows] = plan.plane.cells.map(|count| count as usize);
        // A row at a time, with that above, of numbers between the middles of cells.
        let row = |y: usize| -> Vec<f64> {
            let up = (rows * cell - 1 - y) as f64 + 0.5;
            (0..columns * cell)
                .map(|x| between(plan, [x as f64 + 0.5, up].map(|at| at / cell as f64)))
                .collect()
        };
        let mut above = row(0);
        for y in 0..rows * cell {
            let here = row(y);
            for x in 0..columns * cell {
                let band = scale.band(here[x]);
                let line = band != scale.band(above[x]) || (x > 0 && band != scale.band(here[x - 1]));
                self.paint(MARGIN + x, MARGIN + y, if line { INK } else { color(scale.share(here[x])) });
            }
            above = here;
        }
    }

    fn draw_legend(&mut self, scale: &Scale, words: &[(f64, String)], [left, tall]: [usize; 2]) {
        for y in 0..tall {
            let share = 1.0 - (y as f64 + 0.5) / tall as f64;
            (0..BAR).for_each(|x| self.paint(left + x, MARGIN + y, color(share)));
        }
        let right = left + BAR + MARGIN;
        for (line, word) in words {
            let y = ((1.0 - scale.share(*line)) * tall as f64).round() as usize;
            (0..BAR).for_each(|x| self.paint(left + x, MARGIN + y, INK));
            let top = (MARGIN + y).saturating_sub(digits::HEIGHT / 2);
            digits::write(word, [right, top], |x, y| self.paint(x, y, INK));
        }
        digits::write("lx", [right, tall + 2 * MARGIN], |x, y| self.paint(x, y, INK));
    }
}

/// The light at a place, in cells from the corner: bilinear between the middles of cells, constant beyond the outer ones.
fn between(plan: &Plan<'_>, at: [f64; 2]) -> f64 {
    let cells = plan.plane.cells.map(|count| count as usize);
    let [(i, s), (j, t)] = [0, 1].map(|axis| {
        let place = (at[axis] - 0.5).clamp(0.0, (cells[axis] - 1) as f64);
        (place as usize, place.fract())
    });
    let value = |i: usize, j: usize| plan.values[j.min(cells[1] - 1) * cells[0] + i.min(cells[0] - 1)];
    let row = |j: usize| value(i, j) * (1.0 - s) + value(i + 1, j) * s;
    row(j) * (1.0 - t) + row(j + 1) * t
}

#[cfg(test)]
mod tests {
    use catoptra_core::Rgb;
    use catoptra_tracer::Irradiance;

    use super::*;
    use crate::probe::plane::Plane;

    fn map(plane: &str, values: &[f64]) -> Map {
        let plane: Plane = plane.parse().unwrap();
        let grey = |mean: &f64| Irradiance { mean: Rgb::grey(*mean), error: Rgb::BLACK };
        Map::of(&Plan::new(&plane, &values.iter().map(grey).collect::<Vec<_>>()))
    }

    fn pixel(map: &Map, x: usize, y: usize) -> [u8; 3] {
        let at = 3 * (y * map.width + x);
        [map.bytes[at], map.bytes[at + 1], map.bytes[at + 2]]
    }

    #[test]
    fn the_plane_stands_upright_in_its_colours() {
        let map = map("0 0 0  1 0 0  0 1 0  2x2", &[0.0, 10.0, 20.0, 40.0]);
        assert_eq!(map.bytes.len(), 3 * map.width * map.height);
        let [top, low] = [MARGIN + 1, MARGIN + 638];
        assert_eq!([pixel(&map, low, top), pixel(&map, top, low)], [color(1.0), color(0.0)]);
        assert_eq!([pixel(&map, top, top), pixel(&map, low, low)], [color(0.5), color(0.25)]);
    }

    #[test]
    fn equal_light_and_darkness_have_no_lines() {
        for value in [0.0, 5.0] {
            let map = map("0 0 0  1 0 0  0 1 0  3x1", &[value; 3]);
            assert_eq!(pixel(&map, MARGIN + 300, MARGIN + 100), color(0.0));
        }
    }
}
