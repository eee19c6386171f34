//! Where does a light aim, and what does it become when it aims elsewhere?

use super::Handle;
use crate::outline::Outline;
use crate::stage::{PlacedLight, Stage};
use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, Light, Placement, Value};

/// Pixels from a light to the handle of its aim where it meets nothing, on a display of scale 1.
const AWAY: f64 = 90.0;

/// Where a light stands and the unit vector along which it shines; `None` for what has not both.
fn stand(light: &Light) -> Option<(DVec3, DVec3)> {
    if let (Some(position), Some(direction)) = (light.position(), light.direction()) {
        return Some((position, direction));
    }
    let outline = Outline::of(light)?;
    Some((outline.middle(DVec3::NAN), outline.normal()?))
}

/// From where to where a selected light aims: to the first surface, or a little away where there is none.
pub(crate) fn line(stage: &Stage<'_>, placed: &PlacedLight) -> Option<[DVec3; 2]> {
    if !placed.selected {
        return None;
    }
    let (position, direction) = stand(&placed.light)?;
    let pixel = stage.view.metres_per_pixel(position)? * f64::from(stage.scale());
    // A lamp with a body begins a hair in front of it.
    let start = position + direction * pixel;
    let away = stage.nearest_surface(start, direction).map_or(AWAY * pixel, |metres| metres + pixel);
    Some([position, position + direction * away])
}

/// The handle of a light's aim, with its distance from the pointer in pixels.
pub(super) fn handle(stage: &Stage<'_>, placed: &PlacedLight, pointer: (f64, f64)) -> Option<(f64, Handle)> {
    let [_, target] = line(stage, placed)?;
    let seen = stage.view.project(target)?;
    Some(((seen.x - pointer.0).hypot(seen.y - pointer.1), Handle::Target))
}

/// The light, in its own space, that aims at a point of the world.
pub(crate) fn aimed(
    own: &Light,
    placed: &PlacedLight,
    outer: &Placement,
    at: DVec3,
) -> Option<Result<Light, InvalidPart>> {
    let (position, direction) = stand(&placed.light)?;
    let way = at - position;
    let wanted = way.try_normalize()?;
    let inner = outer.inverse();
    if placed.light.position().is_some() {
        return Some(own.with("direction", Value::Vector(inner.vector(way))));
    }
    // Half a turn has no axis of its own.
    let across = direction.cross(wanted).try_normalize().unwrap_or(direction.any_orthonormal_vector());
    let about = inner.point(position);
    let turn = Placement::IDENTITY.turned(about, inner.direction(across), direction.angle_between(wanted));
    Some(turn.map(|turn| own.placed(&turn)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grip::{Grip, grip_at};
    use crate::sample::{self, placed_in_group, stage_of};
    use std::slice::from_ref;

    #[test]
    fn a_light_aims_where_its_handle_is_put() {
        let spot = sample::spot(DVec3::new(0.5, 2.0, 0.0), DVec3::new(0.3, -1.0, -0.2), 20.0, 40.0);
        for light in [spot, sample::panel(), sample::round_panel()] {
            let (scene, id) = placed_in_group(light);
            let stage = stage_of(&scene, from_ref(&id));
            let [_, target] = line(&stage, &stage.lights[0]).unwrap();
            let seen = stage.view.project(target).unwrap();
            assert_eq!(grip_at(&stage, seen.x, seen.y), Some(Grip { light: id, handle: Handle::Target }));
            let (outer, at) = (scene.world_placement(id).unwrap(), DVec3::new(-0.7, 0.4, 1.3));
            let own = scene.light(id).unwrap();
            let now = aimed(&own, &stage.lights[0], &outer, at).unwrap().unwrap().placed(&outer);
            let ((before, _), (position, direction)) =
                (stand(&stage.lights[0].light).unwrap(), stand(&now).unwrap());
            assert!((position - before).length() < 1e-9, "it stays where it is");
            assert!(((at - position).normalize() - direction).length() < 1e-9);
        }
    }

    #[test]
    fn what_is_not_selected_or_shines_all_round_aims_nowhere() {
        let (scene, id) = placed_in_group(sample::point(DVec3::Y));
        assert!(line(&stage_of(&scene, from_ref(&id)), &stage_of(&scene, from_ref(&id)).lights[0]).is_none());
        let (scene, _) = placed_in_group(sample::round_panel());
        assert!(line(&stage_of(&scene, &[]), &stage_of(&scene, &[]).lights[0]).is_none());
    }
}
