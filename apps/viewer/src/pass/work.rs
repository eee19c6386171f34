//! How much work is it to trace each part of the picture? Parts are traced one by one, and what each costs is counted.

use std::time::Instant;

use catoptra_tracer::{Film, Region, Size, Stats, View, render};
use rayon::prelude::*;

use super::{Painted, Pass, Seen, false_color};
use crate::lighting::Illumination;

/// Edge of the squares that counts are taken of, in pixels.
const SQUARE: u32 = 8;

pub(super) const TESTS: Pass = Pass {
    name: "tests",
    doc: "Tests of rays against shapes, triangles and boxes, to a pixel, as a mean over squares of 8 x 8.",
    illumination: Illumination::Scene,
    integrator: None,
    paint: Some(|seen| {
        let tests = |part: &Part| (part.stats.tests.shapes + part.stats.tests.boxes) as f64 / part.pixels;
        paint(seen, SQUARE, "tests a pixel", tests)
    }),
};

pub(super) const SETTLED: Pass = Pass {
    name: "settled",
    doc: "Tests that f32 left open and f64 decided, to a pixel, as a mean over squares of 8 x 8.",
    illumination: Illumination::Scene,
    integrator: None,
    paint: Some(|seen| {
        let settled = |part: &Part| part.stats.settled as f64 / part.pixels;
        paint(seen, SQUARE, "settled a pixel", settled)
    }),
};

pub(super) const TIME: Pass = Pass {
    name: "time",
    doc: "Nanoseconds to a pixel, measured tile by tile.",
    illumination: Illumination::Scene,
    integrator: None,
    paint: Some(|seen| paint(seen, Film::TILE, "ns a pixel", |part| part.nanoseconds / part.pixels)),
};

/// A part of the picture that was traced for itself.
struct Part {
    stats: Stats,
    nanoseconds: f64,
    pixels: f64,
}

fn paint(
    seen: &Seen<'_>,
    edge: u32,
    unit: &'static str,
    number: impl Fn(&Part) -> f64 + Sync,
) -> Option<Painted> {
    let size = seen.film.size();
    let (columns, rows) = (size.width.div_ceil(edge), size.height.div_ceil(edge));
    let places: Vec<(u32, u32)> = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))).collect();
    let trace = |&(x, y): &(u32, u32)| {
        let region = Region::new(x * edge, y * edge, Size::new(edge, edge)).within(size);
        Some(number(&traced(seen, region)?))
    };
    let numbers: Option<Vec<f64>> = seen.pool.run(|| places.par_iter().map(trace).collect());
    let numbers = numbers?;
    let at = |(x, y): (u32, u32)| numbers[((y / edge) * columns + x / edge) as usize] as f32;
    Some(false_color::plain(seen.pixels().map(at).collect(), unit))
}

fn traced(seen: &Seen<'_>, region: Region) -> Option<Part> {
    if seen.control.is_cancelled() {
        return None;
    }
    let view = View { crop: Some(region), ..seen.view.clone() };
    let mut film = Film::of_region(region, Film::TILE);
    let since = Instant::now();
    let control = catoptra_tracer::Control::default();
    let stats = render(seen.backend, seen.snapshot, &view, &mut film, seen.pool, &control).ok()?;
    let nanoseconds = since.elapsed().as_secs_f64() * 1e9;
    Some(Part { stats, nanoseconds, pixels: region.size.pixels() as f64 })
}
