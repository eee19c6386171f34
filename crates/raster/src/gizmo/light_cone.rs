//! Where does a spot light shine, and how does it fall off between its inner and its outer cone?
//!
//! The inner and the outer ring with their edges; thin rings where three quarters, half and a quarter of the light pass;
//! where a style asks for beams, nested translucent cones, one per step of the falloff, brightest where the light is.
//! A selected light shows all of it and the handles of its rings; others keep to thin lines, and show them if asked.

use super::Gizmo;
use super::mark::{Rim, knob, lamp};
use crate::canvas::Canvas;
use crate::cone::Cone;
use crate::glow::Ramp;
use crate::hull::hull;
use crate::ink::Ink;
use crate::projection::Spot;
use crate::stage::{PlacedLight, Stage};
use crate::tint::Tint;
use catoptra_core::Light;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::EntityId;
use std::f64::consts::TAU;

pub(super) const GIZMO: Gizmo =
    Gizmo { name: "light cone", shown: |style| style.cones || style.lights, draw, marks };

/// Opacity of the whole beam on its axis at the apex, selected and not.
const BEAM: (f32, f32) = (0.42, 0.16);
/// What is left of it at the rings.
const BEAM_END: f64 = 0.4;
/// What is left of it everywhere, where the cone is seen end-on.
const BEAM_END_ON: f64 = 0.6;
/// The axis in the picture, in pixels, below which the cone counts as seen end-on.
const END_ON: f64 = 8.0;
/// Nested cones in the beam, selected and not.
const STEPS: (u32, u32) = (10, 6);
/// Shares of the light whose rings are drawn thinly.
const LEVELS: [f64; 3] = [0.75, 0.5, 0.25];
/// Cones narrower than this against each other, in radians, are drawn as one.
const CLOSE: f64 = 1e-3;

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    for placed in &stage.lights {
        let Some(apex) = apex(placed) else { continue };
        let tint = placed.tint();
        if stage.shows_cone(placed)
            && let Some(cone) = Cone::of(stage, placed)
        {
            if stage.style.beams {
                beam(canvas, &cone, tint, placed.selected);
            }
            lines(canvas, &cone, tint, placed.selected);
            canvas.flush();
            if placed.selected {
                handles(canvas, &cone, tint);
            }
        }
        lamp(canvas, apex, tint, Rim::Plain, placed.selected);
    }
}

fn marks(stage: &Stage<'_>) -> Vec<(EntityId, DVec3)> {
    stage.lights.iter().filter_map(|placed| Some((placed.id, apex(placed)?))).collect()
}

fn apex(placed: &PlacedLight) -> Option<DVec3> {
    if let Light::SpotLight(_) = placed.light { placed.light.position() } else { None }
}

/// Nested cones: where the share of light passing is high, many of them lie over each other.
fn beam(canvas: &mut Canvas<'_>, cone: &Cone, tint: Tint, selected: bool) {
    let (opacity, steps) = if selected { (BEAM.0, STEPS.0) } else { (BEAM.1, STEPS.1) };
    let apart = cone.outer - cone.inner > CLOSE;
    let (steps, opacity) = if apart { (steps, opacity / steps as f32) } else { (1, opacity) };
    let level = |step: u32| (f64::from(step) + 0.5) / f64::from(steps);
    let outlines: Vec<Vec<Spot>> =
        (0..steps).map(|step| silhouette(canvas, cone, cone.half_angle_of(level(step)))).collect();
    canvas.glow(&outlines, (tint, opacity), fade(canvas, cone));
}

/// The outline of a cone in the picture: of its sides and its base. Nothing where the eye is in it, since
/// that would tint the whole picture and tell nothing.
fn silhouette(canvas: &Canvas<'_>, cone: &Cone, half: f64) -> Vec<Spot> {
    if cone.holds(half, canvas.view().eye()) {
        return Vec::new();
    }
    let ring = cone.ring(half);
    let base = canvas.view().polygon(&ring[1..]);
    let sides = ring.windows(2).flat_map(|side| canvas.view().polygon(&[cone.apex, side[0], side[1]]));
    hull(sides.chain(base).collect())
}

/// Full at the apex, fainter towards the rings; one opacity where the cone is seen end-on or its apex is not seen.
fn fade(canvas: &Canvas<'_>, cone: &Cone) -> Ramp {
    let end = cone.apex + cone.axis * (cone.reach * cone.outer.cos().max(0.3));
    match (canvas.view().project(cone.apex), canvas.view().project(end)) {
        (Some(from), Some(to)) if (to.x - from.x).hypot(to.y - from.y) > END_ON => {
            Ramp::between(((from.x, from.y), 1.0), ((to.x, to.y), BEAM_END))
        }
        _ => Ramp::even(BEAM_END_ON),
    }
}

fn lines(canvas: &mut Canvas<'_>, cone: &Cone, tint: Tint, selected: bool) {
    let strength = if selected { 1.0 } else { 0.6 };
    let ink = Ink::new(tint).with_opacity(strength);
    let bright = Ink::new(tint.lighter(0.45)).with_opacity(strength);
    if selected && cone.outer - cone.inner > CLOSE {
        for level in LEVELS {
            let thin = Ink { casing: 0.0, ..ink }.with_width(1.0).with_opacity(0.2 + 0.6 * level as f32);
            canvas.curve(&cone.ring(cone.half_angle_of(level)), thin);
        }
    }
    edges(canvas, cone, cone.outer, ink);
    edges(
        canvas,
        cone,
        cone.inner,
        Ink { casing: 0.3, ..bright }.with_width(1.2).with_opacity(0.7 * strength),
    );
    canvas.straight(
        cone.apex,
        cone.apex + cone.axis * cone.reach,
        Ink { casing: 0.0, ..bright }.with_width(1.0).with_opacity(0.5 * strength),
    );
    canvas.curve(&cone.ring(cone.outer), ink);
    canvas.curve(&cone.ring(cone.inner), bright);
}

/// The two lines along which a cone turns its edge to the eye.
fn edges(canvas: &mut Canvas<'_>, cone: &Cone, half: f64, ink: Ink) {
    for azimuth in cone.edges(half, canvas.view().eye()).into_iter().flatten() {
        canvas.straight(cone.apex, cone.point(half, azimuth), ink);
    }
}

/// Knobs on the rings, where they can be dragged, and the end of the axis.
fn handles(canvas: &mut Canvas<'_>, cone: &Cone, tint: Tint) {
    knob(canvas, cone.apex + cone.axis * cone.reach, 1.8, tint.lighter(0.45));
    let start = cone.edges(cone.outer, canvas.view().eye()).map_or(0.0, |[first, _]| first);
    for quarter in 0..4 {
        let azimuth = start + TAU * f64::from(quarter) / 4.0;
        knob(canvas, cone.point(cone.outer, azimuth), 3.2, tint);
        knob(canvas, cone.point(cone.inner, azimuth), 3.2, tint.lighter(0.6));
    }
}
