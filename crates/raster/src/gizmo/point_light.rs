//! Where does a point light stand? A lamp with rays all round, in its colour.

use super::Gizmo;
use super::mark::{Rim, lamp};
use crate::canvas::Canvas;
use crate::stage::{PlacedLight, Stage};
use catoptra_core::Light;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::EntityId;

pub(super) const GIZMO: Gizmo = Gizmo { name: "point light", shown: |style| style.lights, draw, marks };

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    for placed in &stage.lights {
        if let Some(at) = position(placed) {
            lamp(canvas, at, placed.tint(), Rim::Rays, placed.selected);
        }
    }
}

fn marks(stage: &Stage<'_>) -> Vec<(EntityId, DVec3)> {
    stage.lights.iter().filter_map(|placed| Some((placed.id, position(placed)?))).collect()
}

fn position(placed: &PlacedLight) -> Option<DVec3> {
    if let Light::PointLight(_) = placed.light { placed.light.position() } else { None }
}
