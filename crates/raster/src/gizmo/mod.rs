//! The list of gizmos: what each shows, when, and where it can be clicked.
//!
//! A new gizmo is one new file here and one line in [`GIZMOS`].

mod axes;
mod bounds;
mod directional_light;
mod frustum;
mod grid;
mod light_cone;
mod mark;
mod point_light;

use crate::canvas::Canvas;
use crate::overlay::OverlayStyle;
use crate::stage::Stage;
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
];

/// For gizmos that cannot be clicked.
fn no_marks(_: &Stage<'_>) -> Vec<(EntityId, DVec3)> {
    Vec::new()
}
