//! Which handle of a light is under the pointer, and what does the light become when it is dragged?

mod rectangle;
mod rim;
mod ring;
mod target;

pub(crate) use target::{aimed, line as aim_line};

use crate::projection::Projection;
use crate::stage::{PlacedLight, Stage};
use catoptra_core::glam::DVec3;
use catoptra_core::scene::EntityId;
use catoptra_core::{InvalidPart, Light};

/// A handle of a light's gizmo, taken hold of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grip {
    /// The light.
    pub light: EntityId,
    /// What of it.
    pub handle: Handle,
}

/// What of a light can be dragged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Handle {
    /// A ring of a spot light's cone.
    Ring {
        /// Which of its rings.
        ring: Ring,
        /// Where on the ring: radians about the cone's axis, in the frame of the gizmo.
        azimuth: f64,
    },
    /// A side of a rectangle light.
    Side {
        /// The edge that grows and shrinks as the side moves.
        edge: Edge,
        /// At which end of that edge the side stands.
        end: End,
        /// Where on the side: the share of the other edge, 0 to 1.
        share: f64,
    },
    /// A corner of a rectangle light: at which ends of `edge-u` and `edge-v` it stands.
    Corner([End; 2]),
    /// The rim of a disk light.
    Rim {
        /// Where on the rim: radians about the normal, in the frame of the gizmo.
        azimuth: f64,
    },
    /// The outline of a sphere light.
    Outline,
    /// What a light aims at: dragged by [`Overlay::aim`](crate::Overlay::aim), as pictures know what stands there.
    Target,
}

/// One of the two rings of a spot light's cone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Ring {
    /// Inside of it the light is undiminished.
    Inner,
    /// Outside of it there is no light.
    Outer,
}

/// One of the two edges of a rectangle light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Edge {
    /// `edge-u`.
    U,
    /// `edge-v`.
    V,
}

/// An end of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum End {
    /// Where the corner is.
    Start,
    /// The other one.
    Far,
}

/// Pixels about a handle within which it is gripped, on a display of scale 1.
const REACH: f64 = 6.0;
/// Pixels of the smallest lamp that a drag leaves: of none there would be nothing left to grip.
const SMALLEST: f64 = 2.0;

/// The handle under the pixel (`x`, `y`): of selected lights first, then the nearest. Lamps have handles while they are
/// selected, rings while their cone is shown.
pub(crate) fn grip_at(stage: &Stage<'_>, x: f64, y: f64) -> Option<Grip> {
    let reach = REACH * f64::from(stage.scale());
    let mut best: Option<(bool, f64, Grip)> = None;
    for placed in &stage.lights {
        let rings = if stage.shows_cone(placed) { ring::handles(stage, placed, (x, y)) } else { Vec::new() };
        let sizes = if stage.style.lights && placed.selected {
            let rectangle = rectangle::handle(stage, placed, (x, y), reach);
            rectangle.or_else(|| rim::handle(stage, placed, (x, y)))
        } else {
            None
        };
        let target = if stage.style.lights { target::handle(stage, placed, (x, y)) } else { None };
        for (off, handle) in rings.into_iter().chain(sizes).chain(target) {
            let better = best.is_none_or(|(selected, least, _)| (!placed.selected, off) < (!selected, least));
            if off <= reach && better {
                best = Some((placed.selected, off, Grip { light: placed.id, handle }));
            }
        }
    }
    best.map(|(_, _, grip)| grip)
}

/// The light, in its own space, whose gripped point is nearest to the pixel (`x`, `y`); `None` where there is none.
pub(crate) fn drag(stage: &Stage<'_>, grip: Grip, x: f64, y: f64) -> Option<Result<Light, InvalidPart>> {
    let placed = stage.lights.iter().find(|placed| placed.id == grip.light)?;
    let own = stage.scene.light(grip.light)?;
    let pointer = (x.is_finite() && y.is_finite()).then_some((x, y))?;
    let held = Held { stage, placed, own, pointer };
    match grip.handle {
        Handle::Ring { ring, azimuth } => ring::drag(&held, ring, azimuth),
        Handle::Side { edge, end, share } => rectangle::drag_side(&held, (edge, end), share),
        Handle::Corner(ends) => rectangle::drag_corner(&held, ends),
        Handle::Rim { azimuth } => rim::drag_disk(&held, azimuth),
        Handle::Outline => rim::drag_ball(&held),
        Handle::Target => None,
    }
}

/// A light that is dragged.
struct Held<'a> {
    stage: &'a Stage<'a>,
    /// As it is in the world.
    placed: &'a PlacedLight,
    /// In its own space.
    own: Light,
    /// Pixels.
    pointer: (f64, f64),
}

impl Held<'_> {
    /// Metres of the smallest lamp that a drag leaves at a point of the world; `None` behind the eye.
    fn smallest(&self, at: DVec3) -> Option<f64> {
        Some(self.stage.view.metres_per_pixel(at)? * SMALLEST * f64::from(self.stage.scale()))
    }
}

/// Pixels from a pointer to a line through points of the world, its nearest point, and on which piece it lies.
pub(crate) fn nearest_on(
    view: &Projection,
    line: &[DVec3],
    pointer: (f64, f64),
) -> Option<(f64, DVec3, usize)> {
    let pieces = line.windows(2).enumerate().filter_map(|(piece, ends)| {
        let [from, to] = view.segment(ends[0], ends[1])?;
        let (along, length2) = ((to.x - from.x, to.y - from.y), from.pixels_to(to).powi(2));
        let dot = (pointer.0 - from.x) * along.0 + (pointer.1 - from.y) * along.1;
        let share = if length2 > 0.0 { (dot / length2).clamp(0.0, 1.0) } else { 0.0 };
        let spot = from.towards(to, share);
        let off = (spot.x - pointer.0).hypot(spot.y - pointer.1);
        Some((off, view.point(spot), piece))
    });
    pieces.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// How far along a line, in units of `direction`, it comes nearest to the ray through the pointer; `None` where that is
/// behind the eye, or the line is seen end-on.
pub(crate) fn along(
    view: &Projection,
    (start, direction): (DVec3, DVec3),
    (x, y): (f64, f64),
) -> Option<f64> {
    let ray = view.direction(x, y);
    let across = direction.cross(ray);
    let from_eye = start - view.eye();
    let scale = across.length_squared().recip();
    let share = ray.cross(from_eye).dot(across) * scale;
    let ahead = direction.cross(from_eye).dot(across) * scale;
    (ahead > 0.0 && share.is_finite()).then_some(share)
}
