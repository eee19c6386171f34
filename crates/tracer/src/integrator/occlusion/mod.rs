//! Ambient occlusion: what share of the sky does a surface see, weighted by the cosine?
//!
//! Zhukov, Iones and Kronin, "An ambient light illumination model", EGWR 1998, with nothing between seen and hidden: one
//! direction a camera sample, 1 where nothing is met within the view's distance and 0 where something is. Where the
//! camera sees no surface, nothing hides the sky: 1. Materials do not matter.

mod packets;
mod paths;

use catoptra_core::Rgb;

use super::walker::{CameraRay, Walker};
use super::{Integrate, Search};
use crate::{Frame, Hit, Stats, Tile};

/// See the file's head.
pub(super) struct Occlusion;

impl Integrate for Occlusion {
    fn gather<S: Search>(walker: &mut Walker<'_, S>, camera: &CameraRay) -> (Rgb, Option<Hit>) {
        walker.openness(camera)
    }

    fn trace_tile(frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        packets::trace_tile(frame, tile)
    }
}
