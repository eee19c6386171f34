//! Ambient occlusion: what share of the sky does a surface see, weighted by the cosine?
//!
//! Zhukov, Iones and Kronin, "An ambient light illumination model", EGWR 1998, with nothing between seen and hidden: one
//! direction a camera sample, 1 where nothing is met within the view's distance and 0 where something is. Where the camera
//! sees no surface, nothing hides the sky: 1. Materials do not matter.

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Rgb, Span};

use super::hemisphere::cosine_weighted;
use super::walker::{CameraRay, Meeting, Walker};
use super::{Integrate, Search};
use crate::Hit;
use crate::sampler::share;

/// See the file's head.
pub(super) struct Occlusion;

impl Integrate for Occlusion {
    fn gather<S: Search>(walker: &mut Walker<'_, S>, camera: &CameraRay) -> (Rgb, Option<Hit>) {
        walker.stats.rays.primary += 1;
        let Some(hit) = walker.search.nearest(walker.frame.snapshot, &camera.ray, Span::AHEAD, None) else {
            return (Rgb::WHITE, None);
        };
        let meeting = walker.meet(hit, camera.ray);
        let numbers = camera.sampler.pair(camera.sample, DIRECTION).map(share);
        let direction = cosine_weighted(meeting.shading.normal, numbers).into();
        let light = if walker.sees_sky(&meeting, direction) { Rgb::WHITE } else { Rgb::BLACK };
        (light, Some(hit))
    }
}

/// The pair of dimensions that the direction goes by.
const DIRECTION: u32 = 0;

impl<S: Search> Walker<'_, S> {
    /// Whether nothing is met along a direction; directions below the surface that a smooth normal leads to meet the
    /// surface itself.
    fn sees_sky(&mut self, meeting: &Meeting<'_>, direction: DVec3) -> bool {
        if !(direction.dot(meeting.normal) > 0.0) {
            self.stats.skipped.below_surface += 1;
            return false;
        }
        self.stats.rays.occlusion += 1;
        let ray = Ray::new(meeting.point, direction);
        let span = Span::until(self.frame.view.occlusion_distance);
        !self.search.occluded(self.frame.snapshot, &ray, span, Some(meeting.hit.place))
    }
}
