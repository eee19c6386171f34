//! Which ring of a light cone is under the pointer, and which angle brings it there?

use crate::cone::Cone;
use crate::stage::Stage;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::EntityId;
use std::f64::consts::{FRAC_PI_2, PI};

/// One of the two rings of a spot light's cone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Ring {
    /// Inside of it the light is undiminished.
    Inner,
    /// Outside of it there is no light.
    Outer,
}

/// A ring taken hold of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingGrip {
    /// The spot light.
    pub light: EntityId,
    /// Which of its rings.
    pub ring: Ring,
    /// Where on the ring: radians about the cone's axis, in the frame of the gizmo.
    pub azimuth: f64,
}

/// Pixels about a ring within which it is gripped, on a display of scale 1.
const REACH: f64 = 6.0;
/// Smallest half angle a drag gives, in radians (0.01 degrees): at zero there would be no ring left to grip.
const SMALLEST: f64 = PI / 18_000.0;
/// First looks along a meridian; between two of them its distance to the pointer has at most one minimum.
const LOOKS: u32 = 90;
/// Halvings of the step between two looks: 1e-12 radians are left.
const HALVINGS: u32 = 34;

/// The ring under the pixel (`x`, `y`): selected lights first, then the nearest.
pub(crate) fn ring_at(stage: &Stage<'_>, x: f64, y: f64) -> Option<RingGrip> {
    let mut best: Option<(bool, f64, RingGrip)> = None;
    for placed in &stage.lights {
        let Some(cone) = Cone::of(stage, placed) else { continue };
        for (ring, half) in [(Ring::Outer, cone.outer), (Ring::Inner, cone.inner)] {
            let Some((off, azimuth)) = nearest_on_ring(stage, &cone, half, (x, y)) else { continue };
            let better = best.is_none_or(|(selected, least, _)| (!placed.selected, off) < (!selected, least));
            if off <= REACH * f64::from(stage.scale()) && better {
                best = Some((placed.selected, off, RingGrip { light: placed.id, ring, azimuth }));
            }
        }
    }
    best.map(|(_, _, grip)| grip)
}

/// The full angle that brings the gripped point of the ring nearest to the pixel (`x`, `y`).
pub(crate) fn drag_ring(stage: &Stage<'_>, grip: RingGrip, x: f64, y: f64) -> Option<f64> {
    let placed = stage.lights.iter().find(|placed| placed.id == grip.light)?;
    let cone = Cone::of(stage, placed)?;
    let off = |half: f64| {
        let seen = stage.view.project(cone.point(half, grip.azimuth))?;
        let off = (seen.x - x).hypot(seen.y - y);
        off.is_finite().then_some(off)
    };
    let (least_half, most_half) = match grip.ring {
        Ring::Inner => (SMALLEST.min(cone.outer), cone.outer),
        Ring::Outer => (cone.inner.max(SMALLEST), FRAC_PI_2.max(cone.outer)),
    };
    let step = (most_half - least_half) / f64::from(LOOKS);
    let looks = (0..=LOOKS).map(|look| least_half + step * f64::from(look));
    let (start, _) = looks.filter_map(|half| Some((half, off(half)?))).min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (mut half, mut least, mut reach) = (start, off(start)?, step);
    for _ in 0..HALVINGS {
        for candidate in [half - reach, half + reach] {
            let candidate = candidate.clamp(least_half, most_half);
            if let Some(found) = off(candidate).filter(|&found| found < least) {
                (half, least) = (candidate, found);
            }
        }
        reach *= 0.5;
    }
    Some(2.0 * half)
}

/// Pixels from a pointer to a ring, and the azimuth of the ring's nearest point.
fn nearest_on_ring(stage: &Stage<'_>, cone: &Cone, half: f64, pointer: (f64, f64)) -> Option<(f64, f64)> {
    let ring = cone.ring(half);
    let sides = ring.windows(2).filter_map(|side| {
        let [from, to] = stage.view.segment(side[0], side[1])?;
        let (along, length2) = ((to.x - from.x, to.y - from.y), from.pixels_to(to).powi(2));
        let dot = (pointer.0 - from.x) * along.0 + (pointer.1 - from.y) * along.1;
        let share = if length2 > 0.0 { (dot / length2).clamp(0.0, 1.0) } else { 0.0 };
        let spot = from.towards(to, share);
        let off = (spot.x - pointer.0).hypot(spot.y - pointer.1);
        Some((off, side[0].lerp(side[1], share)))
    });
    let (off, point): (f64, DVec3) = sides.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((off, cone.azimuth_of(point)))
}
