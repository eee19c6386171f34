//! Where does the surface of a light lie, and to which side does it shine?
//!
//! Its outline, arrows along the sides that shine, a lamp in the middle. A selected light shows the handles of its size.

use super::Gizmo;
use super::arrow::arrow;
use super::mark::{Rim, knob, lamp};
use crate::canvas::Canvas;
use crate::ink::Ink;
use crate::outline::Outline;
use crate::stage::{PlacedLight, Stage};
use catoptra_core::glam::DVec3;
use catoptra_core::scene::EntityId;

pub(super) const GIZMO: Gizmo = Gizmo { name: "surface light", shown: |style| style.lights, draw, marks };

/// Length of an arrow in pixels, where its way is seen from the side.
const LENGTH: f64 = 64.0;
/// How far from the middle it begins, in pixels.
const GAP: f64 = 16.0;

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    for placed in &stage.lights {
        let Some(outline) = Outline::of(&placed.light) else { continue };
        let tint = placed.tint();
        let ink = Ink::new(tint).with_opacity(if placed.selected { 1.0 } else { 0.6 });
        canvas.curve(&outline.curve(&stage.view), ink);
        let middle = outline.middle(stage.view.eye());
        if let Some(pixel) = stage.view.metres_per_pixel(middle) {
            let pixel = pixel * f64::from(stage.scale());
            for way in lit_ways(placed, &outline) {
                arrow(canvas, middle + way * (GAP * pixel), middle + way * (LENGTH * pixel), ink);
            }
        }
        canvas.flush();
        if placed.selected {
            for handle in outline.handles(&stage.view) {
                knob(canvas, handle, 3.2, tint.lighter(0.6));
            }
        }
        lamp(canvas, middle, tint, Rim::Rays, placed.selected);
    }
}

fn marks(stage: &Stage<'_>) -> Vec<(EntityId, DVec3)> {
    let middle = |placed: &PlacedLight| Some(Outline::of(&placed.light)?.middle(stage.view.eye()));
    stage.lights.iter().filter_map(|placed| Some((placed.id, middle(placed)?))).collect()
}

/// The unit normals on the sides that shine; none of a ball, which shines everywhere.
fn lit_ways(placed: &PlacedLight, outline: &Outline) -> Vec<DVec3> {
    let Some(normal) = outline.normal() else { return Vec::new() };
    let two_sided = placed.light.lamp().is_some_and(|lamp| lamp.emission.two_sided);
    if two_sided { vec![normal, -normal] } else { vec![normal] }
}
