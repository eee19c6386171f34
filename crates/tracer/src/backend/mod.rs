//! Which ways there are to trace, and what a way must do.
//!
//! A new backend is one file here, its `mod` line and its name in the list below.

mod oracle;
mod scalar;
mod wide;

use catoptra_core::Raster;
use catoptra_core::glam::DVec3;

use crate::query::{HitSlice, RaySlice};
use crate::{Snapshot, Stats, Tile, View};

/// What a backend is given: a snapshot, and from where it is looked at.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// What is looked at.
    pub snapshot: &'a Snapshot,
    /// From where, and how far to go.
    pub view: &'a View,
    /// The view's rays, in the snapshot's frame.
    pub raster: Raster,
    /// The eye, relative to the snapshot's origin.
    pub(crate) eye: DVec3,
    /// Whether the eye, and so every ray of the view, stays outside all convex solids.
    pub(crate) outside_solids: bool,
}

impl<'a> Frame<'a> {
    /// Looks at a snapshot.
    #[must_use]
    pub fn new(snapshot: &'a Snapshot, view: &'a View) -> Self {
        let frame = Self::without_eye(snapshot, view);
        Self { outside_solids: snapshot.columns().is_outside(frame.eye), ..frame }
    }

    /// As [`new`](Self::new), without asking where the eye lies.
    pub(crate) fn without_eye(snapshot: &'a Snapshot, view: &'a View) -> Self {
        let raster = view.camera.raster(view.size.width, view.size.height);
        let eye = raster.eye - snapshot.origin();
        let raster = Raster { eye: raster.eye - snapshot.frame(), ..raster };
        Self { snapshot, view, raster, eye, outside_solids: false }
    }
}

/// A way to trace.
pub trait Backend: Send + Sync {
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
        hits.fill(snapshot, rays, |way| snapshot.nearest_on(way))
    }

    /// Finds whether each ray meets anything, for as many rays as there are in `rays`. Knows no threads.
    fn find_occluded(&self, snapshot: &Snapshot, rays: RaySlice<'_>, occluded: &mut [bool]) -> Stats {
        rays.ask(snapshot, occluded, |way| snapshot.is_occluded_on(way))
    }
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
