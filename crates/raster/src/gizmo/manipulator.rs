//! By which handles is what is selected moved, turned or scaled? Arrows and squares, rings, or a circle about a pivot, over
//! all else.

use super::mark::knob;
use super::{Gizmo, no_marks};
use crate::canvas::Canvas;
use crate::ink::Ink;
use crate::manipulator::{Axis, Manipulator, RING, Tool};
use crate::stage::Stage;
use crate::tint::Tint;
use catoptra_core::glam::DVec3;
use tiny_skia::{PathBuilder, Shader};

pub(super) const GIZMO: Gizmo =
    Gizmo { name: "manipulator", shown: |style| style.manipulator.is_some(), draw, marks: no_marks };

/// Length and half width of an arrow's head as shares of the arrow.
const HEAD: [f64; 2] = [0.2, 0.07];

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    let Some(manipulator) = stage.style.manipulator else { return };
    // Handles stand in front of what they move.
    let depth = canvas.sight.depth.take();
    match manipulator.tool {
        Tool::Move => draw_arrows(stage, canvas, &manipulator),
        Tool::Turn => draw_rings(stage, canvas, &manipulator),
        Tool::Scale => draw_circle(stage, canvas, &manipulator),
    }
    canvas.flush();
    canvas.sight.depth = depth;
}

fn tint(axis: Axis) -> Tint {
    [Tint::X, Tint::Y, Tint::Z][axis.index()]
}

fn draw_arrows(stage: &Stage<'_>, canvas: &mut Canvas<'_>, manipulator: &Manipulator) {
    let scale = f64::from(stage.scale());
    for axis in Axis::ALL {
        if let Some(corners) = manipulator.square(&stage.view, axis, scale) {
            fill(canvas, &corners, tint(axis), 0.45);
        }
    }
    for axis in Axis::ALL {
        let Some([start, tip]) = manipulator.arrow(&stage.view, axis, scale) else { continue };
        let along = tip - start;
        let side = along.cross(stage.view.eye() - tip).normalize_or_zero() * (HEAD[1] * along.length());
        let neck = tip - along * HEAD[0];
        canvas.segment(start, neck, Ink::new(tint(axis)).with_width(2.6));
        canvas.flush();
        fill(canvas, &[neck + side, tip, neck - side], tint(axis), 1.0);
    }
}

fn draw_rings(stage: &Stage<'_>, canvas: &mut Canvas<'_>, manipulator: &Manipulator) {
    for axis in Axis::ALL {
        let ring = manipulator.ring(&stage.view, manipulator.axis(axis), RING, f64::from(stage.scale()));
        if let Some(ring) = ring {
            canvas.curve(&ring, Ink::new(tint(axis)).with_width(2.6));
        }
    }
}

fn draw_circle(stage: &Stage<'_>, canvas: &mut Canvas<'_>, manipulator: &Manipulator) {
    let Some(circle) = manipulator.circle(&stage.view, f64::from(stage.scale())) else { return };
    canvas.curve(&circle, Ink::new(Tint::QUIET).with_width(2.6));
    canvas.flush();
    for at in circle.iter().step_by(circle.len() / 4) {
        knob(canvas, *at, 4.5, Tint::QUIET);
    }
}

/// Fills a flat polygon of the world.
fn fill(canvas: &mut Canvas<'_>, corners: &[DVec3], tint: Tint, opacity: f32) {
    let mut builder = PathBuilder::new();
    for (index, spot) in canvas.view().polygon(corners).into_iter().enumerate() {
        let (x, y) = (spot.x as f32, spot.y as f32);
        if index == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
    }
    builder.close();
    if let Some(path) = builder.finish() {
        canvas.paint(&path, Shader::SolidColor(tint.color(opacity)));
    }
}
