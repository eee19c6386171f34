//! Packets of rays at the CPU's native SIMD width: `f32` kernels propose hits, `f64` decides what they leave open.

use super::{Backend, Sealed};
use crate::integrator::trace_packets;
use crate::rays::{HitSlice, RaySlice};
use crate::search::query::{Answers, answer};
use crate::{Frame, Instructions, Snapshot, Stats, Tile, View};

/// The default backend.
pub(super) struct Wide;

impl Sealed for Wide {}

impl Backend for Wide {
    fn name(&self) -> &'static str {
        "wide"
    }

    fn doc(&self) -> &'static str {
        "packets of rays in f32 at the CPU's native width, settled in f64"
    }

    fn level(&self, view: &View) -> &'static str {
        view.instructions.unwrap_or_else(Instructions::best).name()
    }

    fn trace(&self, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        trace_packets(frame, tile)
    }

    fn find_nearest(&self, snapshot: &Snapshot, rays: RaySlice<'_>, hits: &mut HitSlice<'_>) -> Stats {
        answer(snapshot, rays, Answers::Nearest(hits))
    }

    fn find_occluded(&self, snapshot: &Snapshot, rays: RaySlice<'_>, occluded: &mut [bool]) -> Stats {
        answer(snapshot, rays, Answers::Occluded(occluded))
    }
}
