//! What is planned for, and which work may be left out.

use crate::{Skip, Snapshot};

/// The snapshot that is planned for, and which work may be left out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Planner<'a> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) skip: Skip,
    /// Whether every ray stays outside all convex solids.
    pub(crate) outside: bool,
}
