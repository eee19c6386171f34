//! A frame: a snapshot, and the view of it that is traced.

use catoptra_core::glam::DVec3;
use catoptra_core::{Raster, RayStart};

use crate::edges::EdgeList;
use crate::{Snapshot, View};

/// What a backend is given: a snapshot, and from where it is looked at.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// The snapshot that is traced.
    pub snapshot: &'a Snapshot,
    /// From where, and how far to go.
    pub view: &'a View,
    /// The view's rays, in the snapshot's frame.
    pub raster: Raster,
    /// The eye, relative to the snapshot's origin.
    pub(crate) eye: DVec3,
    /// Whether the eye, and so every ray of the view, stays outside all convex solids.
    pub(crate) outside_solids: bool,
    /// The outlines that are seen, where they are to be shown exactly.
    pub(crate) edges: Option<&'a EdgeList>,
}

impl<'a> Frame<'a> {
    /// Looks at a snapshot.
    #[must_use]
    pub fn new(snapshot: &'a Snapshot, view: &'a View) -> Self {
        let frame = Self::without_eye(snapshot, view);
        let outside = frame.is_pinhole() && snapshot.columns().is_outside(frame.eye);
        Self { outside_solids: outside, ..frame }
    }

    /// As [`new`](Self::new), without asking where the eye lies.
    pub(crate) fn without_eye(snapshot: &'a Snapshot, view: &'a View) -> Self {
        let raster = view.camera.raster(view.size.width, view.size.height);
        let eye = raster.eye - snapshot.origin();
        let start = match raster.start {
            // One sample is seen from the middle of the lens.
            RayStart::Lens(_) if view.samples <= 1 => RayStart::Eye,
            start => start,
        };
        let raster = Raster { eye: raster.eye - snapshot.frame(), start, ..raster };
        Self { snapshot, view, raster, eye, outside_solids: false, edges: None }
    }

    /// Whether all rays of the view start at the eye.
    pub(crate) fn is_pinhole(&self) -> bool {
        self.raster.start == RayStart::Eye
    }
}
