//! How large is what one sees? A grid on the ground, y = 0, in metres, tens and hundreds of them (or finer, or
//! coarser): lines fade where they come too close to each other in the picture, so the next coarser ones remain.

use super::{Gizmo, no_marks};
use crate::canvas::Canvas;
use crate::ink::Ink;
use crate::stage::Stage;
use crate::tint::Tint;
use catoptra_core::glam::DVec3;

pub(super) const GIZMO: Gizmo = Gizmo { name: "grid", shown: |style| style.grid, draw, marks: no_marks };

/// Heights of the eye, in metres, between which the finest spacing follows it.
const HEIGHTS: (f64, f64) = (0.05, 1e7);
/// Height of the eye over the finest spacing, at most ten times as much.
const FINEST: f64 = 4.0;
/// Spacings drawn, each ten times the one before.
const LEVELS: i32 = 3;
/// Lines of a spacing on either side of the middle.
const LINES: i32 = 18;
/// Pieces of half a line; opacity is even between their ends.
const PIECES: i32 = 10;
/// Opacity of the strongest lines.
const OPACITY: f32 = 0.5;
/// Pixels between neighbouring lines at which they have faded out, and at which they are in full.
const CLOSE: (f64, f64) = (6.0, 44.0);
/// Pieces weaker than this at both ends are not drawn.
const FAINT: f32 = 0.06;

/// Parallel lines of one spacing, in both directions.
struct Level {
    spacing: f64,
    reach: f64,
    /// The lines are strongest here.
    middle: DVec3,
    /// Whether every tenth line is left to the next coarser level.
    gaps: bool,
}

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    let height = stage.view.stand().y.abs().clamp(HEIGHTS.0, HEIGHTS.1);
    let finest = (height / FINEST).log10().floor() as i32;
    let ahead = stage.view.direction(0.5 * stage.view.width(), 0.5 * stage.view.height());
    for step in 0..LEVELS {
        let spacing = 10_f64.powi(finest + step);
        let reach = spacing * f64::from(LINES);
        let middle = (stage.view.stand() + ahead * (0.4 * reach)).with_y(0.0);
        lines(canvas, &Level { spacing, reach, middle, gaps: step + 1 < LEVELS });
    }
}

fn lines(canvas: &mut Canvas<'_>, level: &Level) {
    for (along, across, axis) in [(DVec3::X, DVec3::Z, Tint::X), (DVec3::Z, DVec3::X, Tint::Z)] {
        let first = (level.middle.dot(across) / level.spacing).round();
        for line in -LINES..=LINES {
            let number = first + f64::from(line);
            if level.gaps && number % 10.0 == 0.0 {
                continue;
            }
            let foot = across * (number * level.spacing) + along * level.middle.dot(along);
            let tint = if number == 0.0 { axis } else { Tint::QUIET };
            fading(canvas, (foot, along * level.reach), tint, level);
        }
    }
}

/// A line through `foot`, as far as `half` to either side.
fn fading(canvas: &mut Canvas<'_>, (foot, half): (DVec3, DVec3), tint: Tint, level: &Level) {
    let ink = Ink { tint, opacity: OPACITY, width: 1.0, casing: 0.4 };
    let at = |piece: i32| {
        let point = foot + half * (f64::from(piece) / f64::from(PIECES));
        (point, strength(canvas, point, level))
    };
    let ends: Vec<(DVec3, f32)> = (-PIECES..=PIECES).map(at).collect();
    for pair in ends.windows(2) {
        if pair[0].1.max(pair[1].1) > FAINT {
            canvas.hair([pair[0], pair[1]], ink);
        }
    }
}

/// How strong the lines are at a point, 0 to 1: less with the distance from the middle, and less where neighbouring
/// lines come close in the picture.
fn strength(canvas: &Canvas<'_>, point: DVec3, level: &Level) -> f32 {
    let share = point.distance(level.middle) / level.reach;
    let away = (1.0 - share * share).max(0.0);
    let eye = canvas.view().eye();
    // Lines across the view come closer than those along it, by the sine of the angle at which the ground is seen.
    let sine = eye.y.abs() / eye.distance(point);
    let gap = canvas
        .view()
        .metres_per_pixel(point)
        .map_or(CLOSE.1, |pixel| level.spacing * sine / (pixel * f64::from(canvas.scale())));
    (away * ((gap - CLOSE.0) / (CLOSE.1 - CLOSE.0)).clamp(0.0, 1.0)) as f32
}
