//! Whitted's recursion: direct light with shadows, and mirror reflection.
//!
//! Whitted, "An improved illumination model for shaded display", CACM 23(6), 1980.

mod paths;
mod streams;
mod tiles;

pub(crate) use paths::{Search, trace_pixels};
pub(crate) use tiles::trace_tile;
