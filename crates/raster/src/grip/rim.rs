//! Is the rim of a disk light or the outline of a sphere light under the pointer, and which radius brings it there?

use super::{Handle, Held, along, nearest_on};
use crate::outline::{Outline, azimuth_about, outwards};
use crate::stage::{PlacedLight, Stage};
use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, Light, Value};

/// What is round of a light, with its distance from the pointer in pixels.
pub(super) fn handle(stage: &Stage<'_>, placed: &PlacedLight, pointer: (f64, f64)) -> Option<(f64, Handle)> {
    let outline = Outline::of(&placed.light)?;
    let (off, point, _) = nearest_on(&stage.view, &outline.curve(&stage.view), pointer)?;
    match outline {
        Outline::Disk { center, normal, .. } => {
            Some((off, Handle::Rim { azimuth: azimuth_about(normal, point - center) }))
        }
        Outline::Ball { .. } => Some((off, Handle::Outline)),
        Outline::Rectangle { .. } => None,
    }
}

/// The light with its rim under the pointer.
pub(super) fn drag_disk(held: &Held<'_>, azimuth: f64) -> Option<Result<Light, InvalidPart>> {
    let Outline::Disk { center, normal, radius } = Outline::of(&held.placed.light)? else { return None };
    let to = along(&held.stage.view, (center, outwards(normal, azimuth)), held.pointer)?;
    with_radius(held, (center, radius), to)
}

/// The light whose outline passes under the pointer: the ray there touches it.
pub(super) fn drag_ball(held: &Held<'_>) -> Option<Result<Light, InvalidPart>> {
    let Outline::Ball { center, radius } = Outline::of(&held.placed.light)? else { return None };
    let view = &held.stage.view;
    let ray = view.direction(held.pointer.0, held.pointer.1).try_normalize()?;
    let from_eye = center - view.eye();
    if !(from_eye.dot(ray) > 0.0) {
        return None;
    }
    with_radius(held, (center, radius), from_eye.cross(ray).length())
}

/// The light with a radius in metres of the world, where it has `radius` now.
fn with_radius(
    held: &Held<'_>,
    (center, radius): (DVec3, f64),
    to: f64,
) -> Option<Result<Light, InvalidPart>> {
    let values = held.own.values();
    let Some(&Value::Number(own)) = values.get("radius") else { return None };
    let least = held.smallest(center)?.min(radius);
    Some(held.own.with("radius", Value::Number(own * (to.max(least) / radius))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grip::{Grip, drag, grip_at};
    use crate::sample::{self, placed_in_group, stage_of};
    use std::f64::consts::TAU;
    use std::slice::from_ref;

    fn radius(light: &Light) -> f64 {
        match Outline::of(light) {
            Some(Outline::Disk { radius, .. } | Outline::Ball { radius, .. }) => radius,
            _ => panic!("nothing round"),
        }
    }

    #[test]
    fn a_rim_is_gripped_where_it_is_drawn_and_comes_to_the_pointer() {
        let (scene, light) = placed_in_group(sample::round_panel());
        let (stage, outer) = (stage_of(&scene, from_ref(&light)), scene.world_placement(light).unwrap());
        let Some(Outline::Disk { center, normal, radius: was }) = Outline::of(&stage.lights[0].light) else {
            panic!("a disk")
        };
        for step in 0..12 {
            let out = outwards(normal, TAU * f64::from(step) / 12.0);
            let seen = stage.view.project(center + out * was).unwrap();
            let grip = grip_at(&stage, seen.x, seen.y).unwrap();
            let Handle::Rim { azimuth } = grip.handle else { panic!("no rim") };
            assert!(outwards(normal, azimuth).angle_between(out) < 0.05);
            for factor in [0.3, 0.99, 1.6] {
                let wanted = center + outwards(normal, azimuth) * (was * factor);
                let seen = stage.view.project(wanted).unwrap();
                let now = drag(&stage, grip, seen.x, seen.y).unwrap().unwrap().placed(&outer);
                assert!((radius(&now) - was * factor).abs() < 1e-9, "{} for {factor}", radius(&now) / was);
            }
        }
    }

    #[test]
    fn the_outline_of_a_ball_comes_to_the_pointer() {
        let (scene, light) = placed_in_group(sample::globe());
        let stage = stage_of(&scene, from_ref(&light));
        let outline = Outline::of(&stage.lights[0].light).unwrap();
        let curve = outline.curve(&stage.view);
        let seen = stage.view.project(curve[5]).unwrap();
        let grip = grip_at(&stage, seen.x, seen.y).unwrap();
        assert_eq!(grip, Grip { light, handle: Handle::Outline });
        for (x, y) in [(seen.x + 9.0, seen.y - 4.0), (seen.x - 8.0, seen.y)] {
            let own = drag(&stage, grip, x, y).unwrap().unwrap();
            let now = own.placed(&scene.world_placement(light).unwrap());
            let grown = Outline::of(&now).unwrap().handles(&stage.view);
            // The four handles lie on the circle; the pointer's ray touches the ball of that radius.
            assert_eq!(grown.len(), 4);
            let Outline::Ball { center, .. } = outline else { panic!("a ball") };
            let ray = stage.view.direction(x, y).normalize();
            let touch = stage.view.eye() + ray * (center - stage.view.eye()).dot(ray);
            assert!((touch.distance(center) - radius(&now)).abs() < 1e-9);
        }
    }

    #[test]
    fn something_is_left_to_grip() {
        for light in [sample::round_panel(), sample::globe()] {
            let (scene, light) = placed_in_group(light);
            let stage = stage_of(&scene, from_ref(&light));
            for handle in [Handle::Rim { azimuth: 0.4 }, Handle::Outline] {
                for number in 0..400 {
                    let (x, y) =
                        (f64::from(number % 20) * 40.0 - 200.0, f64::from(number / 20) * 30.0 - 150.0);
                    if let Some(now) = drag(&stage, Grip { light, handle }, x, y) {
                        assert!(radius(&now.unwrap()) > 1e-3);
                    }
                }
            }
        }
    }
}
