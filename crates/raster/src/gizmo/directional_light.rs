//! Which way does a directional light travel? Parallel arrows from a lamp that stands outside the scene's bounds, on
//! the side the light comes from.

use super::Gizmo;
use super::arrow::arrow;
use super::mark::{Rim, lamp};
use crate::canvas::Canvas;
use crate::ink::Ink;
use crate::stage::{PlacedLight, Stage};
use catoptra_core::Light;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::EntityId;

pub(super) const GIZMO: Gizmo = Gizmo { name: "directional light", shown: |style| style.lights, draw, marks };

/// Length of the arrows in pixels.
const LENGTH: f64 = 64.0;
/// How far the outer arrows stand from the middle one, in pixels.
const SPREAD: f64 = 19.0;
/// Distance of the lamp from the middle of the scene, in half diagonals of its bounds.
const AWAY: f64 = 1.15;

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    for placed in &stage.lights {
        let Some((from, direction)) = anchor(stage, placed) else { continue };
        let Some(pixel) = stage.view.metres_per_pixel(from) else { continue };
        let pixel = pixel * f64::from(stage.scale());
        let tint = placed.tint();
        // The arrows stand side by side in the plane that turns its face to the eye.
        let across = direction.cross(stage.view.eye() - from).normalize_or_zero() * (SPREAD * pixel);
        for (aside, gap) in [(-1.0, 2.0), (0.0, 16.0), (1.0, 2.0)] {
            let start = from + across * aside;
            arrow(
                canvas,
                start + direction * (gap * pixel),
                start + direction * (LENGTH * pixel),
                Ink::new(tint),
            );
        }
        canvas.flush();
        lamp(canvas, from, tint, Rim::Rays, placed.selected);
    }
}

fn marks(stage: &Stage<'_>) -> Vec<(EntityId, DVec3)> {
    stage.lights.iter().filter_map(|placed| Some((placed.id, anchor(stage, placed)?.0))).collect()
}

/// Where the lamp stands, and the unit direction its light travels.
fn anchor(stage: &Stage<'_>, placed: &PlacedLight) -> Option<(DVec3, DVec3)> {
    let Light::DirectionalLight(_) = placed.light else { return None };
    let direction = placed.light.direction()?;
    let extent = stage.extent();
    Some((extent.centre() - direction * (0.5 * AWAY * extent.size().length()), direction))
}
