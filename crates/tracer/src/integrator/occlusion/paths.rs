//! Ambient occlusion, one path at a time in `f64`.

use catoptra_core::glam::DVec3;
use catoptra_core::lobe::Diffuse;
use catoptra_core::{Ray, Rgb, Span};

use crate::Hit;
use crate::integrator::Search;
use crate::integrator::walker::{CameraRay, SurfaceHit, Walker};
use crate::sampler::{pairs, share};

impl<S: Search> Walker<'_, S> {
    /// 1 where a camera ray's surface sees the sky along a random direction, else 0; and what the ray meets.
    pub(super) fn openness(&mut self, camera: &CameraRay) -> (Rgb, Option<Hit>) {
        self.stats.rays.primary += 1;
        let Some(hit) = self.search.nearest(self.frame.snapshot, &camera.ray, Span::AHEAD, None) else {
            return (Rgb::WHITE, None);
        };
        let surface = self.surface_at(hit, camera.ray);
        let numbers = camera.sampler.pair(camera.sample, pairs::DIRECTION).map(share);
        let (direction, _) = Diffuse::direction(surface.shading.normal, numbers);
        let light = if self.sees_sky(&surface, direction.into()) { Rgb::WHITE } else { Rgb::BLACK };
        (light, Some(hit))
    }

    /// Whether nothing is met along a direction; directions below the surface that a smooth normal leads to meet the
    /// surface itself.
    fn sees_sky(&mut self, surface: &SurfaceHit<'_>, direction: DVec3) -> bool {
        if !(direction.dot(surface.normal) > 0.0) {
            self.stats.skipped.below_surface += 1;
            return false;
        }
        self.stats.rays.occlusion += 1;
        let ray = Ray::new(surface.point, direction);
        let span = Span::until(self.frame.view.occlusion_distance);
        !self.search.occluded(self.frame.snapshot, &ray, span, Some(surface.hit.surface))
    }
}
