//! How is a translucent body filled that grows denser towards its middle?
//!
//! It is given as nested convex outlines of one opacity each. All of them are added up row by row and blended once,
//! so that a body which fills the picture costs one pass over it and not one for each outline.

use crate::pixel::{opaque, times, update, whole};
use crate::projection::Spot;
use crate::tint::Tint;
use tiny_skia::{Pixmap, Rect};

/// An opacity that changes evenly over the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ramp {
    pub(crate) from: (f64, f64),
    /// Change per pixel to the right and per pixel down.
    pub(crate) slope: (f64, f64),
    /// The factor at `from`, which is also the largest, and the smallest.
    pub(crate) range: (f64, f64),
}

impl Ramp {
    /// The same factor everywhere.
    pub(crate) fn even(factor: f64) -> Self {
        Self { from: (0.0, 0.0), slope: (0.0, 0.0), range: (factor, factor) }
    }

    /// From one factor at a point to another at a second point, and no further.
    pub(crate) fn between((start, most): ((f64, f64), f64), (end, least): ((f64, f64), f64)) -> Self {
        let way = (end.0 - start.0, end.1 - start.1);
        let per_pixel2 = (least - most) / (way.0 * way.0 + way.1 * way.1);
        Self { from: start, slope: (way.0 * per_pixel2, way.1 * per_pixel2), range: (most, least) }
    }
}

/// Fills the outlines, each with `opacity` times the ramp; tells the bounds of what was touched.
pub(crate) fn fill(
    pixmap: &mut Pixmap,
    outlines: &[Vec<Spot>],
    (tint, opacity): (Tint, f32),
    ramp: Ramp,
) -> Option<Rect> {
    let (width, height) = (pixmap.width() as usize, pixmap.height() as usize);
    let spans: Vec<Spans> = outlines.iter().filter_map(|outline| Spans::of(outline, width, height)).collect();
    let top = spans.iter().map(|spans| spans.top).min()?;
    let bottom = spans.iter().map(|spans| spans.top + spans.rows.len()).max()?;
    let mut steps = vec![0.0_f32; width + 2];
    let (mut leftmost, mut rightmost) = (width, 0);
    let rows = pixmap.data_mut().chunks_exact_mut(4 * width).enumerate();
    for (y, row) in rows.take(bottom).skip(top) {
        let (mut first, mut last) = (width, 0);
        for &(left, right) in spans.iter().filter_map(|spans| spans.rows.get(y.checked_sub(spans.top)?)) {
            if right > left {
                first = first.min(add_edge(&mut steps, left, 1.0));
                last = last.max(add_edge(&mut steps, right, -1.0) + 1);
            }
        }
        if first >= last {
            continue;
        }
        (leftmost, rightmost) = (leftmost.min(first), rightmost.max(last));
        let last = last.min(width);
        let start =
            (first as f64 + 0.5 - ramp.from.0) * ramp.slope.0 + (y as f64 + 0.5 - ramp.from.1) * ramp.slope.1;
        let factor =
            ((start + ramp.range.0) as f32, ramp.slope.0 as f32, ramp.range.0 as f32, ramp.range.1 as f32);
        blend_row(&mut row[4 * first..4 * last], &steps[first..last], (tint, opacity), factor);
        steps[first..(last + 2).min(width + 2)].fill(0.0);
    }
    Rect::from_ltrb(leftmost as f32, top as f32, rightmost as f32, bottom as f32)
}

/// Where a convex outline begins and ends in each row, in pixels.
struct Spans {
    top: usize,
    rows: Vec<(f32, f32)>,
}

impl Spans {
    fn of(outline: &[Spot], width: usize, height: usize) -> Option<Self> {
        if outline.len() < 3 {
            return None;
        }
        let row = |y: f64| ((y - 0.5).ceil().max(0.0) as usize).min(height);
        let top = outline.iter().map(|corner| row(corner.y)).min()?;
        let bottom = outline.iter().map(|corner| row(corner.y)).max()?;
        let mut rows = vec![(f32::INFINITY, f32::NEG_INFINITY); bottom - top];
        for (index, &corner) in outline.iter().enumerate() {
            let next = outline[(index + 1) % outline.len()];
            let (upper, lower) = if corner.y <= next.y { (corner, next) } else { (next, corner) };
            let slope = (lower.x - upper.x) / (lower.y - upper.y);
            for y in row(upper.y)..row(lower.y) {
                let x = (upper.x + (y as f64 + 0.5 - upper.y) * slope).clamp(0.0, width as f64) as f32;
                let (left, right) = &mut rows[y - top];
                (*left, *right) = (left.min(x), right.max(x));
            }
        }
        Some(Self { top, rows })
    }
}

/// Adds a step of `height` at a place within a pixel to the row's steps; gives the pixel back.
fn add_edge(steps: &mut [f32], x: f32, height: f32) -> usize {
    let pixel = x as usize;
    let part = x - pixel as f32;
    steps[pixel] += height * (1.0 - part);
    steps[pixel + 1] += height * part;
    pixel
}

fn blend_row(
    row: &mut [u8],
    steps: &[f32],
    (tint, opacity): (Tint, f32),
    (mut factor, slope, most, least): (f32, f32, f32, f32),
) {
    let tint = opaque(tint);
    let mut cover = 0.0;
    for (pixel, step) in row.chunks_exact_mut(4).zip(steps) {
        cover += step;
        let alpha = whole((cover * opacity * factor.clamp(least, most)).clamp(0.0, 1.0));
        factor += slope;
        update(pixel, |under| times(tint, alpha) + times(under, 255 - alpha));
    }
}
