//! Where does the surface of a light lie, and to which side does it shine?
//!
//! Its outline, arrows along the sides that shine, a lamp in the middle. A selected light shows the handles of its size.

use super::Gizmo;
use super::arrow::arrow;
use super::mark::{Rim, knob, lamp};
use crate::canvas::Canvas;
use crate::ink::Ink;
use crate::outline::Outline;
use crate::stage::{PlacedLight, Stage};
use catoptra_core::glam::DVec3;
use catoptra_core::scene::EntityId;

pub(super) const GIZMO: Gizmo = Gizmo { name: "surface light", shown: |style| style.lights, draw, marks };

/// Length of an arrow in pixels, where its way is seen from the side.
const LENGTH: f64 = 64.0;
/// How far from the middle it begins, in pixels.
const GAP: f64 = 16.0;

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    for placed in &stage.lights {
        let Some(outline) = Outline::of(&placed.light) else { continue };
        let tint = placed.tint();
        let ink = Ink::new(tint).with_opacity(if placed.selected { 1.0 } else { 0.6 });
        canvas.curve(&outline.curve(&stage.view), ink);
        let middle = outline.middle(stage.view.eye());
        if let Some(pixel) = stage.view.metres_per_pixel(middle) {
            let pixel = pixel * f64::from(stage.scale());
            for way in lit_ways(placed, &outline) {
                arrow(canvas, middle + way * (GAP * pixel), middle + way * (LENGTH * pixel), ink);
            }
        }
        canvas.flush();
        if placed.selected {
            for handle in outline.handles(&stage.view) {
                knob(canvas, handle, 3.2, tint.lighter(0.6));
            }
        }
        lamp(canvas, middle, tint, Rim::Rays, placed.selected);
    }
}

fn marks(stage: &Stage<'_>) -> Vec<(EntityId, DVec3)> {
    let middle = |placed: &PlacedLight| Some(Outline::of(&placed.light)?.middle(stage.view.eye()));
    stage.lights.iter().filter_map(|placed| Some((placed.id, middle(placed)?))).collect()
}

/// The unit normals on the sides that shine; none of a ball, which shines everywhere.
fn lit_ways(placed: &PlacedLight, outline: &Outline) -> Vec<DVec3> {
    let Some(normal) = outline.normal() else { return Vec::new() };
    let two_sided = placed.light.lamp().is_some_and(|lamp| lamp.emission.two_sided);
    if two_sided { vec![normal, -normal] } else { vec![normal] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layer::Layer;
    use crate::overlay::Overlay;
    use crate::sample::{self, HEIGHT, WIDTH, lit_by};
    use crate::style::OverlayStyle;
    use catoptra_core::{Light, Value};

    /// Whether something is drawn within a pixel of each of some points of the world.
    fn drawn(light: Light, selected: bool, at: &[DVec3]) -> Vec<bool> {
        let (scene, id) = lit_by(light);
        let camera = sample::camera();
        let style = OverlayStyle { lights: true, ..OverlayStyle::NONE };
        let selection = if selected { vec![id] } else { Vec::new() };
        let mut layer = Layer::new();
        let overlay = Overlay { selection: &selection, ..sample::overlay(&scene, &camera, style) };
        overlay.draw(&mut layer);
        let view = overlay.stage().view;
        let pixmap = layer.pixmap().unwrap();
        let is_drawn = |point: &DVec3| {
            let seen = view.project(*point).unwrap();
            let near = |of: f64, size: u32| {
                let of = of as u32;
                of.saturating_sub(1)..(of + 2).min(size)
            };
            near(seen.y, HEIGHT)
                .any(|y| near(seen.x, WIDTH).any(|x| pixmap.pixel(x, y).unwrap().alpha() > 60))
        };
        at.iter().map(is_drawn).collect()
    }

    #[test]
    fn the_outline_is_drawn_and_arrows_on_the_sides_that_shine() {
        let places = [(-0.9, 0.0, 0.5), (0.5, 0.0, -0.5), (0.0, -1.5, 0.0), (0.0, 1.5, 0.0)];
        let places = places.map(|(x, y, z)| DVec3::new(x, 1.0 + y, z));
        assert_eq!(drawn(sample::panel(), false, &places), [true, true, true, false]);
        let both = sample::panel().with("two-sided", Value::Flag(true)).unwrap();
        assert_eq!(drawn(both, false, &places), [true; 4]);
    }

    #[test]
    fn a_ball_has_an_outline_and_no_arrow() {
        let ball = DVec3::new(0.5, 1.0, 0.0);
        let places =
            [ball + DVec3::X * 0.55, ball + DVec3::Y * 0.52, ball + DVec3::Y * 1.2, ball - DVec3::Y * 1.2];
        assert_eq!(drawn(sample::globe(), true, &places), [true, true, false, false]);
    }

    #[test]
    fn a_light_given_by_its_power_has_its_colour() {
        let stage = |light| sample::stage_of(&lit_by(light).0, &[]).lights[0].tint();
        let power = sample::panel().equivalent("power").unwrap();
        let by_power = sample::panel().with("power", power).unwrap();
        assert_eq!(stage(by_power), stage(sample::panel()));
    }
}
