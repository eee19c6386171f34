//! The list of backends, and the trait that each implements.
//!
//! A new backend is one file here, its `mod` line and its name in the list below.

mod oracle;
mod scalar;
mod wide;

use sealed::Sealed;

use crate::rays::{HitSlice, RaySlice};
use crate::{Frame, Snapshot, Stats, Tile, View};

/// Traces tiles of a frame.
///
/// Backends are those of this crate: the trait is sealed, since a backend works on the tracer's own columns and writes tiles
/// that keep promises to each other. [`query`](crate::query) and [`Caster`](crate::Caster) answer single rays for
/// integrators that live elsewhere.
pub trait Backend: sealed::Sealed + Send + Sync {
    /// Its name on the command line.
    fn name(&self) -> &'static str;

    /// One sentence.
    fn doc(&self) -> &'static str;

    /// Which instructions it uses for a view, such as `avx512`; `scalar` for none in particular.
    fn level(&self, _view: &View) -> &'static str {
        "scalar"
    }

    /// Traces all pixels of a tile. Knows no threads; never stores a light that is not finite.
    fn trace(&self, frame: &Frame<'_>, tile: &mut Tile) -> Stats;

    /// Finds what each ray meets first, for as many rays as there are in `rays`. Knows no threads.
    fn find_nearest(&self, snapshot: &Snapshot, rays: RaySlice<'_>, hits: &mut HitSlice<'_>) -> Stats {
        hits.fill(snapshot, rays, |segment| snapshot.nearest_on(segment))
    }

    /// Finds whether each ray meets anything, for as many rays as there are in `rays`. Knows no threads.
    fn find_occluded(&self, snapshot: &Snapshot, rays: RaySlice<'_>, occluded: &mut [bool]) -> Stats {
        rays.ask(snapshot, occluded, |segment| snapshot.is_occluded_on(segment))
    }
}

/// Keeps the trait to this crate.
pub(crate) mod sealed {
    /// What only this crate's backends are.
    pub trait Sealed {}
}

const BACKENDS: &[&dyn Backend] = &[&wide::Wide, &scalar::Scalar, &oracle::Oracle];

/// Every backend, the default first.
#[must_use]
pub fn backends() -> &'static [&'static dyn Backend] {
    BACKENDS
}

/// The backend of that name.
#[must_use]
pub fn backend_named(name: &str) -> Option<&'static dyn Backend> {
    BACKENDS.iter().copied().find(|b| b.name() == name)
}
