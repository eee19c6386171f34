//! Where does a selected light aim? A line to the first surface that it meets, and a knob there that can be dragged.

use super::mark::knob;
use super::{Gizmo, no_marks};
use crate::canvas::Canvas;
use crate::grip::aim_line;
use crate::ink::Ink;
use crate::stage::Stage;
use crate::tint::Tint;

pub(super) const GIZMO: Gizmo = Gizmo { name: "aim", shown: |style| style.lights, draw, marks: no_marks };

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    for placed in &stage.lights {
        let Some([from, to]) = aim_line(stage, placed) else { continue };
        canvas.segment(from, to, Ink::new(placed.tint()).with_width(1.4).with_opacity(0.8));
        canvas.flush();
        // The surface that it stands on does not hide it.
        let depth = canvas.sight.depth.take();
        knob(canvas, to, 4.5, Tint::ACCENT);
        canvas.sight.depth = depth;
    }
}
