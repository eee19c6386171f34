//! How much of a lamp does one point see? In `f64`: in closed form, or as far as rays to the lamp would have to find out.

use arrayvec::ArrayVec;
use catoptra_core::contour::{self, Blocker, Leaving, Scratch};
use catoptra_core::glam::DVec3;

use crate::cull::{PointBounds, Shaft};
use crate::snapshot::{Ball, LampRow};
use crate::{LampStats, Snapshot, SurfaceId};

/// Up to so many overlapping shapes light comes past in closed form; the cost grows with their square, and rays take less
/// past more. Measured: see `benches/README.md`.
const MOST_BLOCKERS: usize = 16;

/// A point that lamps shine on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LitPoint {
    /// In the snapshot's frame.
    pub(crate) point: DVec3,
    /// Unit normal to shade with, on the viewer's side.
    pub(crate) normal: DVec3,
    /// The surface's own, on the same side.
    pub(crate) ground: DVec3,
    /// What it lies on; nothing for a point in space.
    pub(crate) surface: Option<SurfaceId>,
}

/// What a lamp of unit radiance gives to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Gathered {
    /// Irradiance.
    Exactly(f64),
    /// Up to this irradiance: how much of it, rays tell.
    UpTo(f64),
}

/// What a lamp gives to a point where it is left to rays to find what stands between.
pub(crate) fn gather_for_rays(lamp: &LampRow, at: &LitPoint, stats: &mut LampStats) -> Gathered {
    let open = contour::open(at.point, at.normal, &lamp.outline);
    if !(open > 0.0) {
        stats.facing_away += 1;
        return Gathered::Exactly(0.0);
    }
    stats.sampled += 1;
    Gathered::UpTo(open)
}

/// What a lamp gives to a point past the shapes that may stand between.
pub(crate) fn gather(
    snapshot: &Snapshot,
    lamp: &LampRow,
    shapes: impl Iterator<Item = u32>,
    at: &LitPoint,
    scratch: &mut Scratch,
    stats: &mut LampStats,
) -> Gathered {
    let open = contour::open(at.point, at.normal, &lamp.outline);
    if !(open > 0.0) {
        stats.facing_away += 1;
        return Gathered::Exactly(0.0);
    }
    let ground = Blocker::ground(at.ground);
    let seen = blockers(snapshot, lamp, shapes, at, &ground)
        .and_then(|blockers| contour::visible(at.point, at.normal, &lamp.outline, &blockers, scratch).ok());
    let Some(seen) = seen else {
        stats.sampled += 1;
        return Gathered::UpTo(open);
    };
    let class = if seen == open {
        &mut stats.open
    } else if seen == 0.0 {
        &mut stats.dark
    } else {
        &mut stats.partly
    };
    *class += 1;
    Gathered::Exactly(seen)
}

/// The outlines of the shapes that may hide some of a lamp from a point; `None` where they are too many or one has none.
fn blockers<'a>(
    snapshot: &'a Snapshot,
    lamp: &LampRow,
    shapes: impl Iterator<Item = u32>,
    at: &LitPoint,
    ground: &'a Blocker,
) -> Option<ArrayVec<(&'a Blocker, Leaving), MOST_BLOCKERS>> {
    let mut blockers = ArrayVec::new();
    if at.ground != at.normal {
        blockers.push((ground, Leaving::Nothing));
    }
    for prim in shapes {
        let leaving = match at.surface {
            Some(surface) if surface.prim == prim => Leaving::Facet(surface.facet),
            _ => Leaving::Nothing,
        };
        match &snapshot.lamps().blockers[prim as usize] {
            Some(blocker) if contour::may_hide(at.point, at.normal, &lamp.outline, blocker) => {
                blockers.try_push((blocker, leaving)).ok()?;
            }
            None if may_stand_between(snapshot, lamp, prim, at) => return None,
            _ => {}
        }
    }
    Some(blockers)
}

/// Whether a shape may hide some of a lamp from a point.
pub(crate) fn may_hide(snapshot: &Snapshot, lamp: &LampRow, prim: u32, at: &LitPoint) -> bool {
    let outlined = match &snapshot.lamps().blockers[prim as usize] {
        Some(blocker) => contour::may_hide(at.point, at.normal, &lamp.outline, blocker),
        None => true,
    };
    outlined && may_stand_between(snapshot, lamp, prim, at)
}

/// Whether the ball round a shape reaches between a point and a lamp.
fn may_stand_between(snapshot: &Snapshot, lamp: &LampRow, prim: u32, at: &LitPoint) -> bool {
    let Some(bounds) = snapshot.prims()[prim as usize].bounds() else { return true };
    let ball = Ball::round(bounds);
    let origin = snapshot.origin_in_frame();
    let here = PointBounds::at(prim, at.point - origin);
    Shaft::new(&here, &lamp.ball).meets(&Ball { center: ball.center - origin, ..ball })
}
