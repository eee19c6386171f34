//! The list of gizmos: what each shows, when, and where it can be clicked.
//!
//! A new gizmo is one new file here and one line in [`GIZMOS`].

mod aim;
mod arrow;
mod axes;
mod bounds;
mod directional_light;
mod frustum;
mod grid;
mod light_cone;
mod manipulator;
mod mark;
mod point_light;
mod surface_light;

use crate::canvas::Canvas;
use crate::stage::Stage;
use crate::style::OverlayStyle;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::EntityId;

/// One kind of overlay.
pub(crate) struct Gizmo {
    /// What it is called, for tests and benches.
    #[cfg_attr(not(test), expect(dead_code, reason = "names a gizmo where a test fails"))]
    pub(crate) name: &'static str,
    /// Whether a style shows it.
    pub(crate) shown: fn(&OverlayStyle) -> bool,
    /// Draws it; lines that are still gathered afterwards are flushed before the next gizmo.
    pub(crate) draw: fn(&Stage<'_>, &mut Canvas<'_>),
    /// The marks that can be clicked: whose, and where in the world.
    pub(crate) marks: fn(&Stage<'_>) -> Vec<(EntityId, DVec3)>,
}

/// All gizmos, from the undermost to the topmost.
pub(crate) const GIZMOS: &[Gizmo] = &[
    grid::GIZMO,
    axes::GIZMO,
    bounds::GIZMO,
    frustum::GIZMO,
    light_cone::GIZMO,
    directional_light::GIZMO,
    point_light::GIZMO,
    surface_light::GIZMO,
    aim::GIZMO,
    manipulator::GIZMO,
];

/// For gizmos that cannot be clicked.
fn no_marks(_: &Stage<'_>) -> Vec<(EntityId, DVec3)> {
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layer::Layer;
    use crate::sample;

    /// How many pixels an overlay touches.
    fn painted(style: OverlayStyle) -> usize {
        let (scene, camera) = (sample::scene(), sample::camera());
        let ball = [scene.entity_named("ball").unwrap()];
        let mut layer = Layer::new();
        crate::Overlay { selection: &ball, ..sample::overlay(&scene, &camera, style) }.draw(&mut layer);
        layer.pixmap().unwrap().pixels().iter().filter(|pixel| pixel.alpha() > 0).count()
    }

    #[test]
    fn every_gizmo_shows_something_alone() {
        let none = OverlayStyle::NONE;
        let alone = [
            OverlayStyle { grid: true, ..none },
            OverlayStyle { axes: true, ..none },
            OverlayStyle { lights: true, ..none },
            OverlayStyle { cones: true, ..none },
            OverlayStyle { selection: true, ..none },
            OverlayStyle { cameras: true, ..none },
            OverlayStyle { manipulator: Some(sample::manipulator()), ..none },
        ];
        assert_eq!(painted(none), 0);
        for gizmo in GIZMOS {
            let mut shown = alone.iter().filter(|style| (gizmo.shown)(style)).peekable();
            assert!(shown.peek().is_some(), "nothing shows the {}", gizmo.name);
            assert!(shown.all(|&style| painted(style) > 20), "the {} is not seen", gizmo.name);
        }
    }

    #[test]
    fn lights_and_cameras_can_be_clicked_where_they_stand() {
        let (scene, camera) = (sample::scene(), sample::camera());
        let overlay = sample::overlay(&scene, &camera, OverlayStyle::default());
        let stage = overlay.stage();
        let marks: Vec<_> = GIZMOS.iter().flat_map(|gizmo| (gizmo.marks)(&stage)).collect();
        assert_eq!(marks.len(), 7);
        for (id, point) in marks {
            let seen = stage.view.project(point).unwrap();
            assert_eq!(overlay.mark_at(seen.x + 3.0, seen.y - 3.0), Some(id));
        }
        assert_eq!(overlay.mark_at(1.0, 239.0), None);
        let hidden = sample::overlay(&scene, &camera, OverlayStyle::NONE);
        assert_eq!(hidden.mark_at(160.0, 120.0), None);
    }
}
