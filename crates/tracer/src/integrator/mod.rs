//! How light gathers along a path: Whitted's recursion over any way of answering what a ray meets.

mod whitted;

pub(crate) use whitted::{Search, trace_pixels, trace_tile};
