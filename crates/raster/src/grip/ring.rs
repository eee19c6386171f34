//! Which ring of a light cone is under the pointer, and which angle brings it there?

use super::{Handle, Held, Ring, nearest_on};
use crate::cone::Cone;
use crate::stage::{PlacedLight, Stage};
use catoptra_core::{InvalidPart, Light, Value};
use std::f64::consts::{FRAC_PI_2, PI};

/// Smallest half angle a drag gives, in radians (0.01 degrees): at zero there would be no ring left to grip.
const SMALLEST: f64 = PI / 18_000.0;
/// First looks along a meridian; between two of them its distance to the pointer has at most one minimum.
const LOOKS: u32 = 90;
/// Halvings of the step between two looks: 1e-12 radians are left.
const HALVINGS: u32 = 34;

/// The rings of a light, each with its distance from the pointer in pixels and its point there.
pub(super) fn handles(stage: &Stage<'_>, placed: &PlacedLight, pointer: (f64, f64)) -> Vec<(f64, Handle)> {
    let Some(cone) = Cone::of(stage, placed) else { return Vec::new() };
    let nearest = |(ring, half)| {
        let (off, point, _) = nearest_on(&stage.view, &cone.ring(half), pointer)?;
        Some((off, Handle::Ring { ring, azimuth: cone.azimuth_of(point) }))
    };
    [(Ring::Outer, cone.outer), (Ring::Inner, cone.inner)].into_iter().filter_map(nearest).collect()
}

/// The light with its ring there.
pub(super) fn drag(held: &Held<'_>, ring: Ring, azimuth: f64) -> Option<Result<Light, InvalidPart>> {
    let angle = angle(held.stage, held.placed, (ring, azimuth), held.pointer)?;
    let field = match ring {
        Ring::Inner => "inner",
        Ring::Outer => "outer",
    };
    Some(held.own.with(field, Value::Number(angle)))
}

/// The full angle that brings the gripped point of the ring nearest to the pixel (`x`, `y`).
fn angle(
    stage: &Stage<'_>,
    placed: &PlacedLight,
    (ring, azimuth): (Ring, f64),
    (x, y): (f64, f64),
) -> Option<f64> {
    let cone = Cone::of(stage, placed)?;
    let off = |half: f64| {
        let seen = stage.view.project(cone.point(half, azimuth))?;
        let off = (seen.x - x).hypot(seen.y - y);
        off.is_finite().then_some(off)
    };
    let (least_half, most_half) = match ring {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grip::{Grip, drag, grip_at};
    use crate::sample;
    use catoptra_core::glam::DVec3;
    use catoptra_core::scene::{EntityId, Scene};

    fn stage(scene: &Scene) -> Stage<'_> {
        sample::stage_of(scene, &[])
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

    /// The full angle of a ring once its point is dragged to a pixel.
    fn dragged(
        stage: &Stage<'_>,
        light: EntityId,
        (ring, azimuth): (Ring, f64),
        (x, y): (f64, f64),
    ) -> Option<f64> {
        let grip = Grip { light, handle: Handle::Ring { ring, azimuth } };
        let Light::SpotLight(spot) = drag(stage, grip, x, y)?.unwrap() else { return None };
        Some(match ring {
            Ring::Inner => spot.inner(),
            Ring::Outer => spot.outer(),
        })
    }

    #[test]
    fn a_ring_is_gripped_where_it_is_drawn() {
        let scene = downward();
        let stage = stage(&scene);
        for (ring, half) in [(Ring::Inner, 10_f64.to_radians()), (Ring::Outer, 30_f64.to_radians())] {
            let (x, y) = seen(&stage, half, 0.7);
            let grip = grip_at(&stage, x, y).unwrap();
            assert_eq!(grip.light, stage.lights[0].id);
            assert!(matches!(grip.handle, Handle::Ring { ring: found, .. } if found == ring));
        }
        assert!(grip_at(&stage, 2.0, 2.0).is_none());
    }

    #[test]
    fn dragging_is_the_inverse_of_projecting() {
        let scene = downward();
        let stage = stage(&scene);
        for azimuth in [-2.5, -1.0, 0.3, 1.6, 3.0] {
            for degrees in [12.0_f64, 25.0, 44.4, 71.0, 89.0] {
                let light = stage.lights[0].id;
                let (x, y) = seen(&stage, degrees.to_radians(), azimuth);
                let found = dragged(&stage, light, (Ring::Outer, azimuth), (x, y)).unwrap();
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
            let found = dragged(&stage, light, (Ring::Outer, azimuth), (x, y)).unwrap();
            assert!((found.to_degrees() - degrees).abs() < 1e-6, "{degrees} became {}", found.to_degrees());
        }
    }

    #[test]
    fn angles_stay_in_order_and_in_range() {
        let scene = downward();
        let stage = stage(&scene);
        let light = stage.lights[0].id;
        let drag = |ring, x, y| dragged(&stage, light, (ring, 0.3), (x, y)).unwrap();
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
        let light = stage.lights[0].id;
        let bare = sample::stage_of(&other, &[]);
        assert!(dragged(&bare, light, (Ring::Inner, 0.0), (10.0, 10.0)).is_none());
        assert!(dragged(&stage, light, (Ring::Inner, 0.0), (f64::NAN, 10.0)).is_none());
    }
}
