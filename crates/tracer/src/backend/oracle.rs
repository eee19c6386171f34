//! The reference backend: every ray against every shape and triangle, in `f64`, without trees.

use super::{Backend, Sealed};
use crate::integrator::{Exhaustive, trace_pixels};
use crate::rays::{HitSlice, RaySlice};
use crate::{Frame, Snapshot, Stats, Tile};

/// Tries everything.
pub(super) struct Oracle;

impl Sealed for Oracle {}

impl Backend for Oracle {
    fn name(&self) -> &'static str {
        "oracle"
    }

    fn doc(&self) -> &'static str {
        "every ray against every shape in f64; slow and obviously right"
    }

    fn trace(&self, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        trace_pixels(&Exhaustive, frame, tile)
    }

    fn find_nearest(&self, snapshot: &Snapshot, rays: RaySlice<'_>, hits: &mut HitSlice<'_>) -> Stats {
        hits.fill(snapshot, rays, |segment| snapshot.nearest_of_all_on(segment))
    }

    fn find_occluded(&self, snapshot: &Snapshot, rays: RaySlice<'_>, occluded: &mut [bool]) -> Stats {
        rays.ask(snapshot, occluded, |segment| snapshot.nearest_of_all_on(segment).is_some())
    }
}
