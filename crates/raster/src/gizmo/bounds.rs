//! How far does the selected thing reach? Brackets at the corners of its bounds.

use super::{Gizmo, no_marks};
use crate::canvas::Canvas;
use crate::ink::Ink;
use crate::stage::Stage;
use crate::tint::Tint;
use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Shape};

pub(super) const GIZMO: Gizmo =
    Gizmo { name: "selection", shown: |style| style.selection, draw, marks: no_marks };

/// Length of a bracket as a fraction of the edge.
const BRACKET: f64 = 0.22;
/// How far outside the bounds the brackets stand, as a fraction of the longest edge.
const AIR: f64 = 0.01;
/// Half the side of the square drawn for a plane, in pixels, and the length of its normal.
const PLANE: f64 = 60.0;

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    for &id in stage.selection {
        if let Some(bounds) = stage.scene.world_bounds(id) {
            brackets(canvas, bounds);
        } else if let (Some(Shape::Plane(plane)), Some(placement)) =
            (stage.scene.shape(id), stage.scene.world_placement(id))
        {
            square(stage, canvas, placement.point(plane.point()), placement.direction(plane.normal()));
        }
    }
}

fn brackets(canvas: &mut Canvas<'_>, bounds: Aabb) {
    let ink = Ink::new(Tint::ACCENT).with_width(2.0);
    let (centre, half) = (bounds.centre(), 0.5 * bounds.size());
    let half = half + DVec3::splat(2.0 * AIR * half.max_element());
    for corner in 0..8_u32 {
        let sign = |axis: u32| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
        let out = DVec3::new(sign(0), sign(1), sign(2)) * half;
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let inward = axis * out * (-2.0 * BRACKET);
            canvas.segment(centre + out, centre + out + inward, ink);
        }
    }
}

/// A plane has no bounds: a square of constant size lies on it, with its normal.
fn square(stage: &Stage<'_>, canvas: &mut Canvas<'_>, point: DVec3, normal: DVec3) {
    let Some(pixel) = stage.view.metres_per_pixel(point) else { return };
    let size = PLANE * pixel * f64::from(stage.scale());
    let (across, upward) = normal.normalize_or(DVec3::Y).any_orthonormal_pair();
    let corner = |x: f64, y: f64| point + (across * x + upward * y) * size;
    let ink = Ink::new(Tint::ACCENT).with_width(2.0);
    let corners =
        [corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0)];
    canvas.curve(&corners, ink);
    canvas.segment(point, point + normal.normalize_or(DVec3::Y) * size, ink);
}
