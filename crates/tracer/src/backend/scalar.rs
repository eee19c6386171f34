//! One ray after another in `f64`, by the trees.

use catoptra_core::{Ray, Span};

use super::Backend;
use crate::integrator::{Search, trace_pixels};
use crate::{Frame, Hit, Snapshot, Stats, SurfaceId, Tile};

/// Walks the trees.
pub(super) struct Scalar;

impl Search for Scalar {
    fn nearest(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> Option<Hit> {
        snapshot.nearest(ray, span, leaving)
    }

    fn occluded(&self, snapshot: &Snapshot, ray: &Ray, span: Span, leaving: Option<SurfaceId>) -> bool {
        snapshot.occluded(ray, span, leaving)
    }
}

impl Backend for Scalar {
    fn name(&self) -> &'static str {
        "scalar"
    }

    fn doc(&self) -> &'static str {
        "one ray after another in f64, with trees"
    }

    fn trace(&self, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        trace_pixels(self, frame, tile)
    }
}
