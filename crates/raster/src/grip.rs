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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::projection::Projection;
    use crate::sample;
    use crate::style::OverlayStyle;
    use catoptra_core::scene::Scene;

    fn stage(scene: &Scene) -> Stage<'_> {
        let view = Projection::new(&sample::camera(), sample::WIDTH, sample::HEIGHT);
        Stage::new(scene, view, OverlayStyle::default(), &[])
    }

    fn downward() -> Scene {
        let apex = DVec3::new(0.5, 4.0, 0.0);
        sample::lit_by(sample::spot(apex, DVec3::new(0.2, -1.0, 0.3), 20.0, 60.0)).0
    }

    /// Where a point of a ring of the first light stands in the picture.
    fn seen(stage: &Stage<'_>, half: f64, azimuth: f64) -> (f64, f64) {
        let cone = Cone::of(stage, &stage.lights[0]).unwrap();
        let seen = stage.view.project(cone.point(half, azimuth)).unwrap();
        (seen.x, seen.y)
    }

    #[test]
    fn a_ring_is_gripped_where_it_is_drawn() {
        let scene = downward();
        let stage = stage(&scene);
        for (ring, half) in [(Ring::Inner, 10_f64.to_radians()), (Ring::Outer, 30_f64.to_radians())] {
            let (x, y) = seen(&stage, half, 0.7);
            let grip = ring_at(&stage, x, y).unwrap();
            assert_eq!((grip.light, grip.ring), (stage.lights[0].id, ring));
        }
        assert!(ring_at(&stage, 2.0, 2.0).is_none());
    }

    #[test]
    fn dragging_is_the_inverse_of_projecting() {
        let scene = downward();
        let stage = stage(&scene);
        for azimuth in [-2.5, -1.0, 0.3, 1.6, 3.0] {
            for degrees in [12.0_f64, 25.0, 44.4, 71.0, 89.0] {
                let grip = RingGrip { light: stage.lights[0].id, ring: Ring::Outer, azimuth };
                let (x, y) = seen(&stage, degrees.to_radians(), azimuth);
                let found = drag_ring(&stage, grip, x, y).unwrap();
                let (again_x, again_y) = seen(&stage, 0.5 * found, azimuth);
                assert!((again_x - x).hypot(again_y - y) < 1e-6, "{degrees} at {azimuth} became {found}");
            }
        }
    }

    #[test]
    fn dragging_across_the_view_gives_the_very_angle() {
        let (scene, light) =
            sample::lit_by(sample::spot(DVec3::new(0.0, 4.0, 0.0), DVec3::NEG_Y, 20.0, 60.0));
        let stage = stage(&scene);
        let cone = Cone::of(&stage, &stage.lights[0]).unwrap();
        let azimuth = cone.azimuth_of(DVec3::new(1.0, 4.0, 0.0));
        for degrees in [21.0_f64, 60.0, 133.0, 179.0] {
            let (x, y) = seen(&stage, 0.5 * degrees.to_radians(), azimuth);
            let found = drag_ring(&stage, RingGrip { light, ring: Ring::Outer, azimuth }, x, y).unwrap();
            assert!((found.to_degrees() - degrees).abs() < 1e-6, "{degrees} became {}", found.to_degrees());
        }
    }

    #[test]
    fn angles_stay_in_order_and_in_range() {
        let scene = downward();
        let stage = stage(&scene);
        let light = stage.lights[0].id;
        let drag = |ring, x, y| drag_ring(&stage, RingGrip { light, ring, azimuth: 0.3 }, x, y).unwrap();
        for number in 0..400 {
            let (x, y) = (f64::from(number % 20) * 40.0 - 200.0, f64::from(number / 20) * 30.0 - 150.0);
            let (inner, outer) = (drag(Ring::Inner, x, y), drag(Ring::Outer, x, y));
            assert!(inner > 0.0 && inner <= 60_f64.to_radians() + 1e-12, "{inner}");
            assert!(outer >= 20_f64.to_radians() - 1e-12 && outer <= PI, "{outer}");
        }
    }

    #[test]
    fn a_light_that_is_gone_cannot_be_dragged() {
        let (other, _) = sample::lit_by(sample::point(DVec3::ZERO));
        let scene = downward();
        let stage = stage(&scene);
        let grip = RingGrip { light: stage.lights[0].id, ring: Ring::Inner, azimuth: 0.0 };
        let view = stage.view;
        let bare = Stage::new(&other, view, OverlayStyle::default(), &[]);
        assert!(drag_ring(&bare, grip, 10.0, 10.0).is_none());
        assert!(drag_ring(&stage, grip, f64::NAN, 10.0).is_none());
    }
}
