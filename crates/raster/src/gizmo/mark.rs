//! The sign of a lamp: a disc of constant size in the picture, in the light's colour, with a rim of rays or without.

use crate::canvas::Canvas;
use crate::ink::Ink;
use crate::tint::Tint;
use catoptra_core::glam::DVec3;
use std::f32::consts::TAU;
use tiny_skia::{PathBuilder, Shader};

/// Radius of the disc in pixels.
const RADIUS: f32 = 4.6;
/// Opacity of marks behind a traced surface.
const HIDDEN: f32 = 0.4;

/// What stands round a lamp's disc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rim {
    /// Nothing.
    Plain,
    /// Short rays all round.
    Rays,
}

/// Draws the sign of a lamp at a point of the world; a selected one wears a ring.
pub(super) fn lamp(canvas: &mut Canvas<'_>, at: DVec3, tint: Tint, rim: Rim, selected: bool) {
    let Some(seen) = canvas.view().project(at) else { return };
    let hidden = canvas.sight.hides(at);
    let (x, y, scale) = (seen.x as f32, seen.y as f32, canvas.scale());
    let beyond = 24.0 * scale;
    let inside = |value: f32, size: f64| value > -beyond && value < size as f32 + beyond;
    if !(inside(x, canvas.view().width()) && inside(y, canvas.view().height())) {
        return;
    }
    if rim == Rim::Rays {
        rays(canvas, (x, y), tint, hidden);
    }
    let opacity = if hidden { HIDDEN } else { 1.0 };
    disc(canvas, (x, y), (RADIUS + 2.0) * scale, Tint::DARK, 0.7 * opacity);
    disc(canvas, (x, y), (RADIUS + 0.8) * scale, Tint(255, 255, 255), opacity);
    disc(canvas, (x, y), (RADIUS - 0.4) * scale, tint, opacity);
    if selected {
        let ink = Ink::new(Tint::ACCENT).with_width(1.8);
        if let Some(path) = PathBuilder::from_circle(x, y, 15.0 * scale) {
            canvas.stroke(&path, ink, hidden);
        }
    }
}

/// Draws a small cased disc at a point of the world, as the end of an axis or a handle; hidden ones are left out.
pub(super) fn knob(canvas: &mut Canvas<'_>, at: DVec3, radius: f32, tint: Tint) {
    let Some(seen) = canvas.view().project(at) else { return };
    if canvas.sight.hides(at) || seen.x.abs().max(seen.y.abs()) > 1e5 {
        return;
    }
    let (at, scale) = ((seen.x as f32, seen.y as f32), canvas.scale());
    disc(canvas, at, (radius + 1.2) * scale, Tint::DARK, 0.65);
    disc(canvas, at, radius * scale, tint, 1.0);
}

fn rays(canvas: &mut Canvas<'_>, (x, y): (f32, f32), tint: Tint, hidden: bool) {
    let mut builder = PathBuilder::new();
    for ray in 0..8 {
        let (sin, cos) = (TAU * ray as f32 / 8.0).sin_cos();
        let (near, far) = (8.4 * canvas.scale(), 11.8 * canvas.scale());
        builder.move_to(x + cos * near, y + sin * near);
        builder.line_to(x + cos * far, y + sin * far);
    }
    if let Some(path) = builder.finish() {
        canvas.stroke(&path, Ink::new(tint.lighter(0.25)).with_width(1.8), hidden);
    }
}

fn disc(canvas: &mut Canvas<'_>, (x, y): (f32, f32), radius: f32, tint: Tint, opacity: f32) {
    if let Some(path) = PathBuilder::from_circle(x, y, radius) {
        canvas.paint(&path, Shader::SolidColor(tint.color(opacity)));
    }
}
