//! How much light arrives on each surface, whatever its colour, and from which light?

use catoptra_core::Integrator;
use catoptra_tracer::{ProbeOptions, Receiver, Snapshot, irradiance_at};

use super::{Painted, Pass, Seen, false_color};
use crate::lighting::Illumination;

pub(super) const PASS: Pass = Pass {
    name: "irradiance",
    doc: "The direct and ambient light on each surface, in false colours with lines of equal light. By the pointer stand the \
          number, and what each light gives of it; the colours can be those of the selected lights alone.",
    illumination: Illumination::EachLight,
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
    let mut shares = Vec::new();
    for part in &seen.lights.parts {
        let snapshot = part.snapshot(seen.snapshot, seen.pool);
        shares.push((part.id, part.name.clone(), measured(seen, snapshot, &receivers)?));
    }
    let alone = &seen.lights.alone;
    let mut counted = shares.iter().filter(|(id, ..)| alone.is_empty() || alone.contains(id));
    let known = !alone.is_empty() || (seen.lights.are_all && !shares.is_empty());
    let values = match counted.next().filter(|_| known) {
        Some((_, _, first)) => counted
            .fold(first.clone(), |sum, (_, _, values)| sum.iter().zip(values).map(|(a, b)| a + b).collect()),
        None => measured(seen, seen.snapshot, &receivers)?,
    };
    let mut painted = false_color::with_lines(values, seen.film.size(), "W/m² (lx)");
    if let Some(numbers) = &mut painted.numbers {
        numbers.shares = shares.into_iter().map(|(_, name, values)| (name, values)).collect();
    }
    Some(painted)
}

/// The light on each receiver, NaN where there is none; `None` when it was cancelled.
fn measured(seen: &Seen<'_>, snapshot: &Snapshot, receivers: &[Option<Receiver>]) -> Option<Vec<f32>> {
    let there: Vec<Receiver> = receivers.iter().flatten().copied().collect();
    let options = ProbeOptions { rays: RAYS, ..ProbeOptions::default() };
    let found = irradiance_at(snapshot, &there, &options, seen.pool, seen.control).ok()?;
    let mut found = found.into_iter();
    let number = |receiver: &Option<Receiver>| {
        receiver.and_then(|_| found.next()).map_or(f32::NAN, |light| light.mean.luminance() as f32)
    };
    Some(receivers.iter().map(number).collect())
}
