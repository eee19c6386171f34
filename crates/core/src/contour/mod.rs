//! How much light does a point receive from a surface of constant radiance that others partly hide? In closed form.
//!
//! The irradiance is the radiance times the *projected solid angle* Ω = ∫ max(n·ω, 0) dω over the directions ω in which the
//! lamp is seen. On the sphere of directions round the point (the *eye*) lamp and blockers are regions with convex outlines
//! of great circles (straight edges, the horizon) and conics (spheres, disks), and Ω is a contour integral over the outline
//! of what is left of the lamp: Lambert's formula for straight edges, elementary functions for the others (`conic.rs`).
//!
//! 1. The lamp becomes a convex polygon cut by the horizon; a round lamp lies within one, its *window* (`view.rs`).
//! 2. Flat and flat-faced blockers are taken away plane by plane, which leaves convex pieces that do not overlap
//!    (`cone.rs`, `polygon.rs`). That is continuous in the input: coincident edges need no rules but that of what is the
//!    same within rounding.
//! 3. On each piece, arcs of round outlines are found by subtraction of intervals (`round.rs`, `pair.rs`).
//! 4. A plane that parts lamp and blocker tells which is in front (`place.rs`, `sight.rs`); where there is none, there is
//!    no closed form.
//!
//! 5. A cylinder, cone or capsule is both its ends and a flat piece between them (`swept.rs`).
//!
//! A blocker on which the eye lies but for rounding (`held.rs`) is treated as left there: a flat piece hides nothing, a ball what
//! lies on its side of the plane that touches it at the eye.
//!
//! Values are known to 10⁻¹² (tests hold them against quadrature), those of a polygon that spans few radians, δ, also to
//! 10⁻¹⁵/δ of themselves, as its edges' shares cancel; an open disk or sphere to 10⁻¹⁴ of itself, however small.

mod angle;
mod blocker;
mod cone;
mod conic;
mod held;
mod lamp;
mod pair;
mod place;
mod polygon;
mod roots;
mod round;
mod sight;
mod swept;
mod view;

use glam::DVec3;

pub use blocker::Blocker;
pub(crate) use held::are_parallel;
pub use held::{facet_holds, facets_that_hold};
pub use lamp::Lamp;
pub(crate) use lamp::Outline;

use polygon::{Corner, Pieces};
use round::Curves;
use sight::{Seen, Sight};
use view::View;

/// Whether the point is known to lie on a blocker's own surface. A blocker that holds the point within
/// [`HELD_WITHIN`](crate::numeric::HELD_WITHIN) is treated as left whatever this says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leaving {
    /// It does not.
    Nothing,
    /// On this facet of it, numbered as [`Crossing::facet`](crate::Crossing::facet).
    Facet(u32),
}

/// Why a blocker leaves no closed form at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoClosedForm {
    /// A blocker touches the lamp or cuts through it, or stands so close that no plane was found between them.
    #[error("a blocker touches the lamp")]
    Touches,
    /// A plane cuts through a sphere that shines.
    #[error("a plane cuts through a sphere lamp")]
    CutsSphere,
    /// The point lies within a sphere that holds a part of the lamp.
    #[error("the point lies within a sphere that holds a part of the lamp")]
    PartlyWithin,
    /// The point lies within a solid round an axis, or on a rim of it.
    #[error("the point lies within a solid round an axis")]
    Within,
    /// Coordinates so large or small that their products leave the range of numbers.
    #[error("coordinates leave the range of numbers")]
    Range,
}

/// Memory that [`visible`] works in; kept from call to call, so that none is allocated.
#[derive(Debug, Default)]
pub struct Scratch {
    pieces: Pieces,
    next: Pieces,
    spare: [Vec<Corner>; 2],
    curves: Curves,
}

/// The projected solid angle, 0..=π, of a lamp with nothing in its way, as seen from a point with a unit normal.
#[must_use]
pub fn open(point: DVec3, normal: DVec3, lamp: &Lamp) -> f64 {
    View::of(point, normal, lamp).map_or(0.0, |view| view.open())
}

/// Whether a blocker may hide a part of a lamp from a point with a unit normal. Where not, it changes no bit of what
/// [`visible`] gives; where it may, it need not. By a ball round the blocker: a few dozen multiplications, and always `true`
/// for a plane.
#[must_use]
pub fn may_hide(point: DVec3, normal: DVec3, lamp: &Lamp, blocker: &Blocker) -> bool {
    View::of(point, normal, lamp).is_some_and(|view| view.may_meet(point, blocker))
}

/// The projected solid angle of what is seen of a lamp past blockers, from a point with a unit normal: at least 0, at most what
/// [`open`] gives, and the same bits as that where no blocker stands in the way.
///
/// # Errors
/// When a blocker that may hide a part of the lamp leaves no closed form.
pub fn visible(
    point: DVec3,
    normal: DVec3,
    lamp: &Lamp,
    blockers: &[(&Blocker, Leaving)],
    scratch: &mut Scratch,
) -> Result<f64, NoClosedForm> {
    let Some(view) = View::of(point, normal, lamp) else { return Ok(0.0) };
    let open = view.open();
    if !blockers.iter().any(|(blocker, _)| view.may_meet(point, blocker)) {
        return Ok(open);
    }
    scratch.pieces.begin(view.outline());
    scratch.curves.begin(view.round.as_ref());
    let mut sight = Sight { eye: point, lamp, view: &view, scratch, is_cut: false };
    for &(blocker, leaving) in blockers {
        if view.may_meet(point, blocker) && sight.hide(blocker, leaving)? == Seen::Nothing {
            return Ok(0.0);
        }
    }
    if !sight.is_cut && scratch.curves.are_plain() {
        return Ok(open);
    }
    if !scratch.curves.settle_pairs() {
        return Ok(0.0);
    }
    let Scratch { pieces, curves, .. } = scratch;
    let twice: f64 = pieces.iter().map(|piece| curves.contour(normal, piece)).sum();
    if twice.is_finite() { Ok((twice / 2.0).clamp(0.0, open)) } else { Err(NoClosedForm::Range) }
}
