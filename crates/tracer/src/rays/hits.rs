//! Lists of what rays meet first, in columns.

use super::{RAYS_PER_BLOCK, RaySlice};
use crate::film::NOTHING;
use crate::snapshot::RaySegment;
use crate::{Hit, Snapshot, Stats, SurfaceId};

/// What each ray of a list meets first.
#[derive(Debug, Clone, Default)]
pub struct HitList {
    length: usize,
    pub(crate) prim: Vec<u32>,
    pub(crate) facet: Vec<u32>,
    pub(crate) t: Vec<f64>,
}

impl HitList {
    /// How many rays were searched.
    #[must_use]
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether there was none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// What a ray meets first: where, and at which `t` in lengths of its direction. `None` where it meets nothing.
    ///
    /// The surface is the right one. `t` is computed in `f64`: the parameter of the plane or sphere it belongs to.
    ///
    /// # Panics
    /// A number that is not below [`len`](Self::len).
    #[must_use]
    pub fn get(&self, at: usize) -> Option<(SurfaceId, f64)> {
        assert!(at < self.length, "ray {at} of {}", self.length);
        let prim = self.prim[at];
        (prim != NOTHING).then(|| (SurfaceId { prim, facet: self.facet[at] }, self.t[at]))
    }

    /// All of its columns.
    pub(crate) fn as_slice(&mut self) -> HitSlice<'_> {
        HitSlice { prim: &mut self.prim, facet: &mut self.facet, t: &mut self.t }
    }

    /// Makes room for the hits of `length` rays.
    pub(crate) fn resize(&mut self, length: usize) {
        let room = length.next_multiple_of(RAYS_PER_BLOCK);
        self.length = length;
        self.prim.resize(room, NOTHING);
        self.facet.resize(room, 0);
        self.t.resize(room, 0.0);
    }
}

/// Columns for the hits of some rays, in whole blocks.
#[derive(Debug)]
pub struct HitSlice<'a> {
    pub(crate) prim: &'a mut [u32],
    pub(crate) facet: &'a mut [u32],
    pub(crate) t: &'a mut [f64],
}

impl HitSlice<'_> {
    /// Answers about one ray.
    ///
    /// # Panics
    /// A number past the room.
    pub fn set(&mut self, at: usize, hit: Option<(SurfaceId, f64)>) {
        let (surface, t) = hit.unwrap_or((SurfaceId { prim: NOTHING, facet: 0 }, 0.0));
        (self.prim[at], self.facet[at], self.t[at]) = (surface.prim, surface.facet, t);
    }

    /// Answers ray by ray what is met first.
    pub(crate) fn fill(
        &mut self,
        snapshot: &Snapshot,
        rays: RaySlice<'_>,
        search: impl Fn(&RaySegment<'_>) -> Option<Hit>,
    ) -> Stats {
        for at in 0..rays.len() {
            let hit = rays.follow(snapshot, at, &search);
            self.set(at, hit.map(|hit| (hit.surface, hit.crossing.t)));
        }
        Stats::default()
    }
}
