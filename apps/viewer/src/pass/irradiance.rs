//! How much light arrives on each surface, whatever its colour?

use catoptra_tracer::{ProbeOptions, Receiver, irradiance_at};

use catoptra_core::Integrator;

use super::{Painted, Pass, Seen, false_color};
use crate::lighting::Illumination;

pub(super) const PASS: Pass = Pass {
    name: "irradiance",
    doc: "The direct and ambient light on each surface, in false colours with lines of equal light; of single lights by \
          solo. The number stands by the pointer.",
    illumination: Illumination::Scene,
    integrator: Some(Integrator::Whitted),
    paint: Some(paint),
};

/// Rays to a lamp where its light has no closed form: as few as there may be, as many pixels are asked about.
const RAYS: u32 = 32;

fn paint(seen: &Seen<'_>) -> Option<Painted> {
    let receiver = |x, y| {
        let met = seen.hit(x, y)?;
        Receiver::new(met.point, met.hit.crossing.shading_normal * met.side).ok()
    };
    let receivers = seen.map(receiver)?;
    let there: Vec<Receiver> = receivers.iter().flatten().copied().collect();
    let options = ProbeOptions { rays: RAYS, ..ProbeOptions::default() };
    let found = irradiance_at(seen.snapshot, &there, &options, seen.pool, seen.control).ok()?;
    let mut found = found.into_iter();
    let number = |receiver: &Option<Receiver>| {
        receiver.and_then(|_| found.next()).map_or(f32::NAN, |light| light.mean.luminance() as f32)
    };
    let values = receivers.iter().map(number).collect();
    Some(false_color::with_lines(values, seen.film.size(), "W/m² (lx)"))
}
