//! Light at surfaces of any material, in `f64`: refraction through nested media, textures, cut-outs, light from all around. What
//! integrators that follow rays of many kinds have in common; lanes know nothing of it.

mod direct;
mod environment;
mod from_point;
mod lamplight;
mod media;
mod packets;
mod spread;
mod vertex;
mod visibility;

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Rgb, Span};

use super::Search;
use super::walker::{CameraRay, Walker};
use crate::lamps::Drawn;
use crate::sampler::Sampler;
use crate::{Frame, Hit, SurfaceId};
pub(super) use direct::Estimate;
pub(super) use from_point::light_along;
pub(crate) use media::Media;
pub(super) use packets::trace_tile;
pub(super) use spread::Spread;
pub(super) use vertex::{Met, Vertex};

/// How a ray came to run where it runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Origin {
    /// From the camera, or in the only direction there was.
    Alone,
    /// Chosen among many on the viewer's side, with this density, 1/sr.
    Reflected(f64),
    /// Chosen among many on the other side, with this density, 1/sr.
    Transmitted(f64),
    /// Chosen from a point whose direct light of lamps is gathered elsewhere, and no other.
    Apart,
}

/// A ray of a path, and what the path is like so far.
#[derive(Debug, Clone)]
pub(super) struct PathRay {
    /// In the snapshot's frame.
    pub(super) ray: Ray,
    pub(super) leaving: Option<SurfaceId>,
    /// What one unit of radiance along it counts for in the pixel.
    pub(super) weight: Rgb,
    /// The same of the lobes whose light from lamps is not gathered elsewhere.
    pub(super) glossy: Rgb,
    pub(super) origin: Origin,
    /// How many bounces it came by.
    pub(super) depth: u32,
    /// How many surfaces it has passed since the last one.
    pub(super) passed: u32,
    pub(super) media: Media,
    pub(super) spread: Spread,
}

impl PathRay {
    /// One that begins a path and stands for no more than itself.
    pub(super) fn new(ray: Ray, leaving: Option<SurfaceId>, media: Media) -> Self {
        Self {
            ray,
            leaving,
            weight: Rgb::WHITE,
            glossy: Rgb::WHITE,
            origin: Origin::Alone,
            depth: 0,
            passed: 0,
            media,
            spread: Spread::Cone { width: 0.0, growth: 0.0 },
        }
    }

    /// Of the camera, and what it stands for a square of the picture of that side, in pixels.
    pub(super) fn from_camera(frame: &Frame<'_>, ray: Ray, side: f64, media: &Media) -> Self {
        Self { spread: Spread::of_pixel(&frame.raster, side), ..Self::new(ray, None, media.clone()) }
    }

    /// The ray that goes straight on from a hit.
    fn straight_on(self, hit: &Hit, point: DVec3) -> Self {
        let spread = self.spread.after(&self.ray, hit.crossing.t, 0.0);
        let direction = self.ray.direction;
        let passed = self.passed + 1;
        Self { ray: Ray::new(point, direction), leaving: Some(hit.surface), passed, spread, ..self }
    }
}

/// Which random numbers a path goes by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Numbers {
    pub(super) sampler: Sampler<u32>,
    pub(super) sample: u32,
}

impl Numbers {
    pub(super) fn drawn(&self, depth: u32) -> Drawn {
        Drawn { sampler: self.sampler, sample: self.sample, depth }
    }
}

/// What an integrator does with what a ray meets.
pub(super) trait Bounce {
    /// The light that is added to the pixel; rays that go on are left in the walker's list.
    fn meet<S: Search>(walker: &mut Walker<'_, S>, path: PathRay, hit: Option<Hit>, numbers: &Numbers)
    -> Rgb;
}

impl<S: Search> Walker<'_, S> {
    /// The light that arrives along a camera ray by an integrator's rules, and what the ray meets first.
    pub(super) fn follow_paths<B: Bounce>(&mut self, camera: &CameraRay) -> (Rgb, Option<Hit>) {
        let numbers = Numbers { sampler: camera.sampler, sample: camera.sample };
        let side = camera.side.unwrap_or_else(|| self.frame.view.side_of_sample());
        let media = Media::round_camera(self.frame, &camera.ray);
        self.stats.rays.primary += 1;
        self.follow_ray::<B>(PathRay::from_camera(self.frame, camera.ray, side, &media), &numbers)
    }

    /// The light that arrives along a ray and all that go on from it, and what the ray meets first.
    fn follow_ray<B: Bounce>(&mut self, first: PathRay, numbers: &Numbers) -> (Rgb, Option<Hit>) {
        let nearest = |walker: &Self, path: &PathRay| {
            walker.search.nearest(walker.frame.snapshot, &path.ray, Span::AHEAD, path.leaving)
        };
        self.pending.clear();
        let first_hit = nearest(self, &first);
        let mut light = B::meet(self, first, first_hit, numbers);
        while let Some(path) = self.pending.pop() {
            self.stats.rays.reflection += 1;
            let hit = nearest(self, &path);
            light += B::meet(self, path, hit, numbers);
        }
        (light, first_hit)
    }
}
