//! On how many threads is there work, and how long does it take?

use std::time::Instant;

use catoptra_tracer::Pool;
use miette::{Result, miette};

/// The threads to trace with; one per core unless said.
pub(crate) fn new_pool(threads: Option<u16>) -> Result<Pool> {
    Pool::new(threads.map_or(0, usize::from))
        .map_err(|error| miette!(help = "ask for fewer with --threads", "{error}"))
}

/// Milliseconds from a moment until now.
pub(crate) fn milliseconds_since(started: Instant) -> f64 {
    started.elapsed().as_secs_f64() * 1e3
}
