//! Finds what a ray meets: by the trees, or by trying every shape.

use catoptra_core::{Ray, Span};

use crate::cull::{PointBounds, all_blockers, blockers_between};
use crate::snapshot::LampRow;
use crate::{Hit, Snapshot, SurfaceId};

/// Ray queries on a snapshot, one ray at a time.
pub(crate) trait Search {
    /// What a ray meets first.
    fn nearest(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> Option<Hit>;

    /// Whether a ray meets anything.
    fn occluded(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> bool;

    /// Adds the shapes that may stand between a point, relative to the snapshot's origin, and a lamp.
    fn find_blockers(
        &self,
        snapshot: &Snapshot,
        lamp: &LampRow,
        point: &PointBounds,
        blockers: &mut Vec<u32>,
    );
}

/// Walks the trees.
pub(crate) struct Trees;

impl Search for Trees {
    fn nearest(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> Option<Hit> {
        snapshot.nearest_in_frame(ray, span, leaving)
    }

    fn occluded(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> bool {
        snapshot.occluded_in_frame(ray, span, leaving)
    }

    fn find_blockers(
        &self,
        snapshot: &Snapshot,
        lamp: &LampRow,
        point: &PointBounds,
        blockers: &mut Vec<u32>,
    ) {
        blockers_between(snapshot, lamp, point, false, blockers);
    }
}

/// Tries every shape and triangle.
pub(crate) struct Exhaustive;

impl Search for Exhaustive {
    fn nearest(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> Option<Hit> {
        snapshot.nearest_of_all_in_frame(ray, span, leaving)
    }

    fn occluded(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> bool {
        snapshot.nearest_of_all_in_frame(ray, span, leaving).is_some()
    }

    fn find_blockers(&self, snapshot: &Snapshot, lamp: &LampRow, _: &PointBounds, blockers: &mut Vec<u32>) {
        all_blockers(snapshot, lamp, blockers);
    }
}
