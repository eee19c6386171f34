//! Where is the origin of the world, and which way do x, y and z point? Three lettered lines of constant size.

use super::{Gizmo, no_marks};
use crate::canvas::Canvas;
use crate::ink::Ink;
use crate::stage::Stage;
use crate::tint::Tint;
use catoptra_core::glam::DVec3;
use tiny_skia::PathBuilder;

pub(super) const GIZMO: Gizmo = Gizmo { name: "axes", shown: |style| style.axes, draw, marks: no_marks };

/// Length of an axis in pixels.
const LENGTH: f64 = 72.0;
/// How far behind the tip its letter stands, in pixels.
const LETTER_GAP: f64 = 12.0;

/// Strokes of a letter, in a square from -1 to 1 whose y points down.
type Letter = &'static [&'static [(f32, f32)]];
const LETTER_X: Letter = &[&[(-0.8, -1.0), (0.8, 1.0)], &[(0.8, -1.0), (-0.8, 1.0)]];
const LETTER_Y: Letter = &[&[(-0.8, -1.0), (0.0, 0.0), (0.8, -1.0)], &[(0.0, 0.0), (0.0, 1.0)]];
const LETTER_Z: Letter = &[&[(-0.8, -1.0), (0.8, -1.0), (-0.8, 1.0), (0.8, 1.0)]];

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    let Some(pixel) = stage.view.metres_per_pixel(DVec3::ZERO) else { return };
    let pixel = pixel * f64::from(stage.scale());
    let axes = [(DVec3::X, Tint::X, LETTER_X), (DVec3::Y, Tint::Y, LETTER_Y), (DVec3::Z, Tint::Z, LETTER_Z)];
    for (axis, tint, letter) in axes {
        canvas.segment(DVec3::ZERO, axis * (LENGTH * pixel), Ink::new(tint).with_width(2.2));
        write(canvas, axis * ((LENGTH + LETTER_GAP) * pixel), tint, letter);
    }
}

fn write(canvas: &mut Canvas<'_>, at: DVec3, tint: Tint, letter: Letter) {
    let Some(seen) = canvas.view().project(at) else { return };
    let (x, y, half) = (seen.x as f32, seen.y as f32, 4.2 * canvas.scale());
    if !(x.abs() < 1e5 && y.abs() < 1e5) {
        return;
    }
    let mut builder = PathBuilder::new();
    for line in letter {
        for (index, (right, down)) in line.iter().enumerate() {
            let (x, y) = (x + half * right, y + half * down);
            if index == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
        }
    }
    let hidden = canvas.sight.hides(at);
    if let Some(path) = builder.finish() {
        canvas.stroke(&path, Ink::new(tint).with_width(1.7), hidden);
    }
}
