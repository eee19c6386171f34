//! Whitted's recursion: direct light with shadows, and mirror reflection.
//!
//! Whitted, "An improved illumination model for shaded display", CACM 23(6), 1980.

mod bounces;
mod lamps;
mod paths;
mod pieces;
mod receivers;
mod streams;
mod tally;
mod tiles;

use catoptra_core::Rgb;

use super::matter;
use super::walker::{CameraRay, Walker};
use super::{Integrate, Search};
use crate::shade::Gathers;
use crate::{Frame, Hit, Stats, Tile};
pub(super) use paths::shadow_ray;
pub(crate) use receivers::Receivers;
pub(super) use tiles::trace_lanes;

/// See the file's head.
pub(super) struct Whitted;

impl Integrate for Whitted {
    fn gather<S: Search>(walker: &mut Walker<'_, S>, camera: &CameraRay) -> (Rgb, Option<Hit>) {
        if walker.frame.snapshot.matter().is_needed {
            walker.follow_paths::<Self>(camera)
        } else {
            walker.follow(camera)
        }
    }

    fn trace_tile(frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        if frame.snapshot.matter().is_needed {
            matter::trace_tile::<Self>(frame, tile)
        } else {
            trace_lanes(frame, tile, Gathers::mirrored(frame.snapshot))
        }
    }
}
