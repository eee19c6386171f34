//! How much of a lamp does a point see, past what a search finds in between?

use catoptra_core::contour::Scratch;

use super::Search;
use crate::cull::PointBounds;
use crate::film::NOTHING;
use crate::lamps::{Gathered, LitPoint, gather};
use crate::snapshot::LampRow;
use crate::{LampStats, Snapshot};

/// Room for that, kept from point to point.
#[derive(Debug, Default)]
pub(super) struct LampSight {
    scratch: Scratch,
    /// The shapes that may stand in the way.
    blockers: Vec<u32>,
}

impl LampSight {
    /// What a lamp of unit radiance gives to a point.
    pub(super) fn gather<S: Search>(
        &mut self,
        search: &S,
        snapshot: &Snapshot,
        lamp: &LampRow,
        at: &LitPoint,
        stats: &mut LampStats,
    ) -> Gathered {
        self.blockers.clear();
        if lamp.shadow {
            let prim = at.surface.map_or(NOTHING, |surface| surface.prim);
            let here = PointBounds::at(prim, at.point - snapshot.origin_in_frame());
            search.find_blockers(snapshot, lamp, &here, &mut self.blockers);
            self.blockers.sort_unstable();
        }
        gather(snapshot, lamp, self.blockers.iter().copied(), at, &mut self.scratch, stats)
    }
}
