//! The backend that is obviously right: every ray against every shape and triangle, in `f64`.

use super::{Backend, Frame};
use crate::integrator::{Exhaustive, trace_pixels};
use crate::query::{HitSlice, RaySlice};
use crate::{Snapshot, Stats, Tile};

/// Tries everything.
pub(super) struct Oracle;

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
        hits.fill(snapshot, rays, |way| snapshot.nearest_of_all_on(way))
    }

    fn find_occluded(&self, snapshot: &Snapshot, rays: RaySlice<'_>, occluded: &mut [bool]) -> Stats {
        rays.ask(snapshot, occluded, |way| snapshot.nearest_of_all_on(way).is_some())
    }
}
