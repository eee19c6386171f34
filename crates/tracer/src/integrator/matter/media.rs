//! Which solids of clear matter does a path run inside of?
//!
//! Solids may overlap: what is there is the medium of the highest priority, and of equal ones that of the shape with the higher
//! number (Schmidt and Budge, "Simple nested dielectrics in ray traced images", JGT 7(2), 2002). A surface of any other is
//! not there. Entering twice is entering once and leaving what was not entered does nothing, so that no order of crossings, and
//! none that rounding has lost, can unsettle the list.

use catoptra_core::{Medium, Ray, RayStart, Rgb, Span};
use smallvec::SmallVec;
use std::collections::BTreeMap;

use crate::{Frame, Hit, Snapshot};

/// The shapes of clear matter that a path is inside of, by their numbers.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Media(SmallVec<[u32; 4]>);

impl Media {
    /// Those that the camera's rays begin in: all at the eye, or, of parallel rays, this one.
    pub(crate) fn round_camera(frame: &Frame<'_>, ray: &Ray) -> Self {
        match frame.raster.start {
            RayStart::Eye | RayStart::Lens(_) => Self::round_eye(frame),
            RayStart::Window(_) => Self::round(frame.snapshot, ray),
        }
    }

    /// Those that the eye of a view lies in.
    pub(crate) fn round_eye(frame: &Frame<'_>) -> Self {
        Self::round(frame.snapshot, &Ray::new(frame.raster.eye, frame.raster.corner))
    }

    /// Those that a ray begins in: the solids whose surface it meets from within.
    pub(super) fn round(snapshot: &Snapshot, ray: &Ray) -> Self {
        let mut media = Self::default();
        if !snapshot.matter().is_see_through {
            return media;
        }
        let mut met: BTreeMap<u32, Hit> = BTreeMap::new();
        for (prim, number) in snapshot.prims().iter().zip(0..) {
            if medium(snapshot, prim.body).is_none() {
                continue;
            }
            let Some(hit) = snapshot.cross_part(number, None, ray, Span::AHEAD, None) else { continue };
            let nearest = met.entry(prim.body).or_insert(hit);
            if hit.crossing.t < nearest.crossing.t {
                *nearest = hit;
            }
        }
        for (body, hit) in met {
            if hit.crossing.normal.dot(ray.direction) > 0.0 {
                media.enter(body);
            }
        }
        media
    }

    /// Goes into a shape.
    pub(super) fn enter(&mut self, prim: u32) {
        if !self.0.contains(&prim) {
            self.0.push(prim);
        }
    }

    /// Goes out of a shape.
    pub(super) fn leave(&mut self, prim: u32) {
        self.0.retain(|inside| *inside != prim);
    }

    /// The shape whose medium is there.
    pub(super) fn top(&self, snapshot: &Snapshot) -> Option<u32> {
        let rank = |&prim: &u32| (medium(snapshot, prim).map_or(0, |medium| medium.priority), prim);
        self.0.iter().copied().max_by_key(rank)
    }

    /// What is there.
    pub(super) fn medium(&self, snapshot: &Snapshot) -> Option<Medium> {
        self.top(snapshot).and_then(|prim| medium(snapshot, prim))
    }

    /// The index of refraction of what is there; 1 in air.
    pub(super) fn ior(&self, snapshot: &Snapshot) -> f64 {
        self.medium(snapshot).map_or(1.0, |medium| medium.ior)
    }

    /// What is left of light after so many metres.
    pub(super) fn left_after(&self, snapshot: &Snapshot, distance: f64) -> Rgb {
        let Some(medium) = self.medium(snapshot) else { return Rgb::WHITE };
        // Where nothing is absorbed, nothing is so at any distance.
        medium
            .absorption
            .map(|absorption| if absorption > 0.0 { (-absorption * distance).exp() } else { 1.0 })
    }
}

fn medium(snapshot: &Snapshot, prim: u32) -> Option<Medium> {
    snapshot.matter().medium_in(&snapshot.prims()[prim as usize])
}
