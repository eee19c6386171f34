//! Whitted's recursion: direct light with shadows, and mirror reflection.
//!
//! Whitted, "An improved illumination model for shaded display", CACM 23(6), 1980.

mod lamps;
mod paths;
mod pieces;
mod streams;
mod tiles;

use catoptra_core::Rgb;

use super::walker::{CameraRay, Walker};
use super::{Integrate, Search};
use crate::{Frame, Hit, Stats, Tile};

/// See the file's head.
pub(super) struct Whitted;

impl Integrate for Whitted {
    fn gather<S: Search>(walker: &mut Walker<'_, S>, camera: &CameraRay) -> (Rgb, Option<Hit>) {
        walker.follow(camera)
    }

    fn trace_tile(frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        tiles::trace_tile(frame, tile)
    }
}
