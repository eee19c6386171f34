//! One ray after another in `f64`, by the trees.

use super::{Backend, Sealed};
use crate::integrator::{Trees, trace_pixels};
use crate::{Frame, Stats, Tile};

/// Walks the trees.
pub(super) struct Scalar;

impl Sealed for Scalar {}

impl Backend for Scalar {
    fn name(&self) -> &'static str {
        "scalar"
    }

    fn doc(&self) -> &'static str {
        "one ray after another in f64, with trees"
    }

    fn trace(&self, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        trace_pixels(&Trees, frame, tile)
    }
}
