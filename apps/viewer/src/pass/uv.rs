//! How do texture coordinates lie on surfaces? u as red, v as green, with lines at tenths.

use catoptra_core::Integrator;
use catoptra_core::glam::DVec2;

use super::{Met, NOTHING, Painted, Pass, Seen, packed};
use crate::lighting::Illumination;

pub(super) const PASS: Pass = Pass {
    name: "uv",
    doc: "Texture coordinates: u is red, v green, in checks of a tenth.",
    illumination: Illumination::Scene,
    integrator: Some(Integrator::Whitted),
    paint: Some(paint),
};

fn paint(seen: &Seen<'_>) -> Option<Painted> {
    let color = |x, y| {
        let uv = seen.hit(x, y).and_then(|met| coordinates(seen, &met));
        uv.map_or(NOTHING, color_of)
    };
    Some(Painted { colors: seen.map(color)?, numbers: None })
}

/// Of a point, on its shape as it is before it is placed.
fn coordinates(seen: &Seen<'_>, met: &Met) -> Option<DVec2> {
    let (shape, to_own) = seen.own.get(&met.entity)?;
    Some(shape.parametrization(to_own.point(met.point), met.hit.crossing.facet).uv)
}

fn color_of(uv: DVec2) -> u32 {
    let within = uv - uv.floor();
    let tenths = (uv * 10.0).floor();
    let odd = (tenths.x + tenths.y).rem_euclid(2.0) != 0.0;
    let dimmed = if odd { 0.8 } else { 1.0 };
    packed([within.x * dimmed, within.y * dimmed, 0.25 * dimmed])
}
