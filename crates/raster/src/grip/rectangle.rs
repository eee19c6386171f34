//! Which side or corner of a rectangle light is under the pointer, and which edges bring it there?

use super::{Edge, End, Handle, Held, along, nearest_on};
use crate::outline::Outline;
use crate::stage::{PlacedLight, Stage};
use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, Light, Shape, Value};

impl Edge {
    fn field(self) -> &'static str {
        match self {
            Self::U => "edge-u",
            Self::V => "edge-v",
        }
    }
}

impl End {
    /// Where it is, as a share of the edge.
    fn share(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Far => 1.0,
        }
    }
}

/// A corner of a light, or else one of its sides, with its distance from the pointer in pixels.
pub(super) fn handle(
    stage: &Stage<'_>,
    placed: &PlacedLight,
    pointer: (f64, f64),
    reach: f64,
) -> Option<(f64, Handle)> {
    let outline = Outline::of(&placed.light)?;
    let Outline::Rectangle { corner, edges: [u, v] } = outline else { return None };
    let corners = [End::Start, End::Far].into_iter().flat_map(|a| [[a, End::Start], [a, End::Far]]);
    let near = corners.filter_map(|ends| {
        let seen = stage.view.project(corner + u * ends[0].share() + v * ends[1].share())?;
        let off = (seen.x - pointer.0).hypot(seen.y - pointer.1);
        (off <= reach).then_some((off, Handle::Corner(ends)))
    });
    near.min_by(|a, b| a.0.total_cmp(&b.0)).or_else(|| {
        let (off, point, side) = nearest_on(&stage.view, &outline.curve(&stage.view), pointer)?;
        let (edge, end, along) = match side {
            0 => (Edge::V, End::Start, u),
            1 => (Edge::U, End::Far, v),
            2 => (Edge::V, End::Far, u),
            _ => (Edge::U, End::Start, v),
        };
        let share = ((point - corner).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        Some((off, Handle::Side { edge, end, share }))
    })
}

/// The light with that end of an edge, and so the side that stands there, under the pointer.
pub(super) fn drag_side(
    held: &Held<'_>,
    (edge, end): (Edge, End),
    share: f64,
) -> Option<Result<Light, InvalidPart>> {
    let Outline::Rectangle { corner, edges: [u, v] } = Outline::of(&held.placed.light)? else { return None };
    let (moving, other) = match edge {
        Edge::U => (u, v),
        Edge::V => (v, u),
    };
    let start = corner + other * share;
    let to = along(&held.stage.view, (start, moving), held.pointer)?;
    let least = held.smallest(start + moving * end.share())? / moving.length();
    Some(with_end(&held.own, (edge, end), to, least))
}

/// The light with a corner under the pointer.
pub(super) fn drag_corner(held: &Held<'_>, ends: [End; 2]) -> Option<Result<Light, InvalidPart>> {
    let outline = Outline::of(&held.placed.light)?;
    let (Outline::Rectangle { corner, edges }, Some(normal)) = (outline, outline.normal()) else {
        return None;
    };
    let view = &held.stage.view;
    let ray = view.direction(held.pointer.0, held.pointer.1);
    let distance = normal.dot(corner - view.eye()) / normal.dot(ray);
    let met = view.eye() + ray * distance;
    if !(distance > 0.0 && met.is_finite()) {
        return None;
    }
    let gripped = corner + edges[0] * ends[0].share() + edges[1] * ends[1].share();
    let smallest = held.smallest(gripped)?;
    let of = |light: &Light, edge: Edge, side: DVec3, end: End| {
        let to = (met - corner).dot(side) / side.length_squared();
        with_end(light, (edge, end), to, smallest / side.length())
    };
    Some(of(&held.own, Edge::U, edges[0], ends[0]).and_then(|light| of(&light, Edge::V, edges[1], ends[1])))
}

/// The light with an end of an edge at a share of the edge that it has, and the other end where it is; at least the share
/// `least` is left.
fn with_end(light: &Light, (edge, end): (Edge, End), to: f64, least: f64) -> Result<Light, InvalidPart> {
    let Some(Shape::Rectangle(own)) = light.lamp().map(|lamp| lamp.shape) else { return Ok(light.clone()) };
    let now = match edge {
        Edge::U => own.edges()[0],
        Edge::V => own.edges()[1],
    };
    let least = least.min(1.0);
    match end {
        End::Far => light.with(edge.field(), Value::Vector(now * to.max(least))),
        End::Start => {
            let to = to.min(1.0 - least);
            let light = light.with("corner", Value::Vector(own.corner() + now * to))?;
            light.with(edge.field(), Value::Vector(now * (1.0 - to)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grip::{Grip, drag, grip_at};
    use crate::sample::{self, placed_in_group, stage_of};
    use std::slice::from_ref;

    const ENDS: [End; 2] = [End::Start, End::Far];

    fn rectangle(light: &Light) -> (DVec3, [DVec3; 2]) {
        let Some(Shape::Rectangle(own)) = light.lamp().map(|lamp| lamp.shape) else { panic!("a rectangle") };
        (own.corner(), own.edges())
    }

    fn at(light: &Light, u: f64, v: f64) -> DVec3 {
        let (corner, edges) = rectangle(light);
        corner + edges[0] * u + edges[1] * v
    }

    #[test]
    fn sides_and_corners_are_gripped_where_they_are_drawn_while_selected() {
        let (scene, light) = placed_in_group(sample::panel());
        let (selected, other) = (stage_of(&scene, from_ref(&light)), stage_of(&scene, &[]));
        let shown = &selected.lights[0].light;
        let grip = |u, v| {
            let seen = selected.view.project(at(shown, u, v)).unwrap();
            assert_eq!(grip_at(&other, seen.x, seen.y), None);
            grip_at(&selected, seen.x + 1.0, seen.y).unwrap().handle
        };
        for (u, first) in [0.0, 1.0].into_iter().zip(ENDS) {
            for (v, second) in [0.0, 1.0].into_iter().zip(ENDS) {
                assert_eq!(grip(u, v), Handle::Corner([first, second]));
            }
            let Handle::Side { edge: Edge::U, end, share } = grip(u, 0.3) else { panic!("no side") };
            assert!(end == first && (share - 0.3).abs() < 0.05, "{share}");
            let Handle::Side { edge: Edge::V, end, share } = grip(0.6, u) else { panic!("no side") };
            assert!(end == first && (share - 0.6).abs() < 0.05, "{share}");
        }
    }

    #[test]
    fn a_dragged_side_is_under_the_pointer_and_the_opposite_one_stays() {
        let (mut scene, light) = placed_in_group(sample::panel());
        let before = scene.world_light(light).unwrap();
        for (edge, share, far) in [(Edge::U, 0.3, 1.4_f64), (Edge::V, 0.6, 0.2), (Edge::U, 0.9, 0.35)] {
            for end in ENDS {
                let to = if end == End::Far { far } else { 1.0 - far };
                let point = |light: &Light, along: f64| match edge {
                    Edge::U => at(light, along, share),
                    Edge::V => at(light, share, along),
                };
                let wanted = point(&before, to);
                let stage = stage_of(&scene, from_ref(&light));
                let seen = stage.view.project(wanted).unwrap();
                let grip = Grip { light, handle: Handle::Side { edge, end, share } };
                let own = drag(&stage, grip, seen.x, seen.y).unwrap().unwrap();
                let edited = scene.light(light).unwrap();
                scene.apply(catoptra_core::scene::Edit::Light(light, own)).unwrap();
                let now = scene.world_light(light).unwrap();
                assert!(point(&now, end.share()).distance(wanted) < 1e-9);
                let (opposite, was) = (point(&now, 1.0 - end.share()), point(&before, 1.0 - end.share()));
                assert!(opposite.distance(was) < 1e-9, "{was} became {opposite}");
                scene.apply(catoptra_core::scene::Edit::Light(light, edited)).unwrap();
            }
        }
    }

    #[test]
    fn a_dragged_corner_is_under_the_pointer_and_the_opposite_one_stays() {
        let (scene, light) = placed_in_group(sample::panel());
        let stage = stage_of(&scene, from_ref(&light));
        let (before, outer) = (stage.lights[0].light.clone(), scene.world_placement(light).unwrap());
        for first in ENDS {
            for second in ENDS {
                let (u, v) = (first.share(), second.share());
                let wanted = at(&before, u + 0.4 * (u - 0.5), v - 0.3 * (v - 0.5));
                let seen = stage.view.project(wanted).unwrap();
                let grip = Grip { light, handle: Handle::Corner([first, second]) };
                let now = drag(&stage, grip, seen.x, seen.y).unwrap().unwrap().placed(&outer);
                assert!(at(&now, u, v).distance(wanted) < 1e-9);
                assert!(at(&now, 1.0 - u, 1.0 - v).distance(at(&before, 1.0 - u, 1.0 - v)) < 1e-9);
            }
        }
    }

    #[test]
    fn something_is_left_to_grip() {
        let (scene, light) = placed_in_group(sample::panel());
        let stage = stage_of(&scene, from_ref(&light));
        let (was, edges) = rectangle(&scene.light(light).unwrap());
        for number in 0..400 {
            let (x, y) = (f64::from(number % 20) * 40.0 - 200.0, f64::from(number / 20) * 30.0 - 150.0);
            for end in ENDS {
                let side = Handle::Side { edge: Edge::U, end, share: 0.5 };
                for handle in [side, Handle::Corner([end, end])] {
                    let Some(light) = drag(&stage, Grip { light, handle }, x, y) else { continue };
                    let (corner, [u, v]) = rectangle(&light.unwrap());
                    assert!(u.dot(edges[0]) > 0.0 && v.dot(edges[1]) > 0.0, "{u} {v}");
                    let kept = was + (1.0 - end.share()) * (edges[0] - u);
                    assert!((corner - kept).dot(edges[0]).abs() < 1e-9);
                }
            }
        }
    }
}
