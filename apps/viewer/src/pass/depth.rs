//! How far away is what is seen?

use catoptra_core::Integrator;

use super::{Painted, Pass, Seen, false_color};
use crate::lighting::Illumination;

pub(super) const PASS: Pass = Pass {
    name: "depth",
    doc: "Metres from the eye to what is seen, along each ray.",
    illumination: Illumination::Scene,
    integrator: Some(Integrator::Whitted),
    paint: Some(paint),
};

fn paint(seen: &Seen<'_>) -> Option<Painted> {
    let depths = seen.film.depths();
    let metres = depths.into_iter().map(|depth| if depth.is_finite() { depth } else { f32::NAN }).collect();
    Some(false_color::with_lines(metres, seen.film.size(), "m"))
}
