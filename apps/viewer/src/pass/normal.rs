//! Which way do surfaces look? x, y and z of the normal as red, green and blue.

use catoptra_core::Integrator;

use super::{NOTHING, Painted, Pass, Seen, packed};
use crate::lighting::Illumination;

pub(super) const PASS: Pass = Pass {
    name: "normal",
    doc: "Which way each surface looks: x is red, y green, z blue, a half is 0. On the side that is seen.",
    illumination: Illumination::Scene,
    integrator: Some(Integrator::Whitted),
    paint: Some(paint),
};

fn paint(seen: &Seen<'_>) -> Option<Painted> {
    let color = |x, y| {
        seen.hit(x, y).map_or(NOTHING, |met| {
            let normal = met.hit.crossing.shading_normal * met.side;
            packed(normal.to_array().map(|v| 0.5 + 0.5 * v))
        })
    };
    Some(Painted { colors: seen.map(color)?, numbers: None })
}
