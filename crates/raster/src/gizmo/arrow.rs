//! An arrow of the world, its head flat to the eye.

use crate::canvas::Canvas;
use crate::ink::Ink;
use catoptra_core::glam::DVec3;

/// Draws an arrow between two points of the world.
pub(super) fn arrow(canvas: &mut Canvas<'_>, tail: DVec3, head: DVec3, ink: Ink) {
    canvas.segment(tail, head, ink);
    let direction = head - tail;
    let side = direction.cross(canvas.view().eye() - head).normalize_or_zero() * (0.09 * direction.length());
    let back = head - direction * 0.18;
    canvas.curve(&[back + side, head, back - side], ink);
}
