//! Light from all around at a point.

use std::f64::consts::PI;

use catoptra_core::glam::DVec3;
use catoptra_core::lobe::Diffuse;
use catoptra_core::{Emitter, Environment, FromAfar, Ray, Rgb, Span};

use super::{Estimate, Numbers, Origin, PathRay, Vertex};
use crate::integrator::Search;
use crate::integrator::walker::Walker;
use crate::sampler::{pairs, share};

impl<S: Search> Walker<'_, S> {
    /// Radiance that a ray shows that meets nothing.
    pub(in crate::integrator) fn surroundings(&self, path: &PathRay) -> Rgb {
        let snapshot = self.frame.snapshot;
        let all = &snapshot.matter().surroundings;
        if all.is_empty() {
            return snapshot.background();
        }
        let seen = |environment: &Environment| {
            let seen = environment.radiance(path.ray.direction);
            match path.origin {
                Origin::Reflected(pdf) | Origin::Transmitted(pdf) if !environment.is_even() => {
                    seen * (pdf / (pdf + environment.pdf(path.ray.direction)))
                }
                _ => seen,
            }
        };
        all.iter().map(seen).fold(Rgb::BLACK, |sum, light| sum + light)
    }

    /// Radiance that a point shows of the light from all around, as far as rays in chosen directions do not find it.
    pub(super) fn of_surroundings(
        &mut self,
        vertex: &Vertex<'_>,
        path: &PathRay,
        numbers: &Numbers,
        estimate: Estimate,
    ) -> Rgb {
        let mut light = Rgb::BLACK;
        for environment in &self.frame.snapshot.matter().surroundings {
            light += match estimate {
                Estimate::Alone => self.openness_to(environment, vertex, path, numbers),
                Estimate::WithPaths if environment.is_even() => Rgb::BLACK,
                Estimate::WithPaths => self.chosen_of(environment, vertex, path, numbers),
            };
        }
        light
    }

    /// What is shown of it along one direction that it chooses, beside those that paths choose.
    fn chosen_of(
        &mut self,
        environment: &Environment,
        vertex: &Vertex<'_>,
        path: &PathRay,
        numbers: &Numbers,
    ) -> Rgb {
        let u = numbers.sampler.pair(numbers.sample, pairs::surroundings(path.depth)).map(share);
        let Some(found) = environment.sample(u) else { return Rgb::BLACK };
        let shown = vertex.bsdf.evaluate(found.direction) * found.radiance;
        let pdf = found.pdf + vertex.bsdf.pdf(found.direction);
        let shown = (shown * (1.0 / pdf), found.direction);
        self.light_of_afar(environment, vertex, path, shown, Estimate::WithPaths)
    }

    /// What is shown of it where no rays are sent on in chosen directions: as much as a matte surface of the same albedo would
    /// show of it, beside what mirrored and bent rays see.
    fn openness_to(
        &mut self,
        environment: &Environment,
        vertex: &Vertex<'_>,
        path: &PathRay,
        numbers: &Numbers,
    ) -> Rgb {
        let albedo = vertex.bsdf.scattered();
        if !(albedo.max_channel() > 0.0) {
            return Rgb::BLACK;
        }
        let normal: DVec3 = vertex.surface.shading.normal.into();
        let (count, mut light) = (self.frame.view.lamp_rays_of_sample(), Rgb::BLACK);
        for k in 0..count {
            let number = numbers.sample.wrapping_mul(count).wrapping_add(k);
            let u = numbers.sampler.pair(number, pairs::surroundings(path.depth)).map(share);
            let found = if environment.is_even() {
                let (direction, cosine) = Diffuse::direction(normal.into(), u);
                let direction: DVec3 = direction.into();
                Some(FromAfar { direction, radiance: environment.radiance(direction), pdf: cosine / PI })
            } else {
                environment.sample(u)
            };
            let Some(FromAfar { direction, radiance, pdf }) = found else { continue };
            let cosine = direction.dot(normal).max(0.0);
            let shown = albedo * radiance * (cosine / (PI * pdf * f64::from(count)));
            light += self.light_of_afar(environment, vertex, path, (shown, direction), Estimate::Alone);
        }
        light
    }

    /// What of light along a direction from afar reaches a point.
    fn light_of_afar(
        &mut self,
        environment: &Environment,
        vertex: &Vertex<'_>,
        path: &PathRay,
        (light, direction): (Rgb, DVec3),
        estimate: Estimate,
    ) -> Rgb {
        if !(light.max_channel() > 0.0 && light.all(f64::is_finite)) {
            return Rgb::BLACK;
        }
        if !environment.shadow() {
            return light;
        }
        self.stats.rays.shadow += 1;
        let above = direction.dot(vertex.surface.normal) > 0.0;
        let media = if above { &path.media } else { &vertex.behind };
        let segment = (Ray::new(vertex.surface.point, direction), Span::AHEAD);
        let filtered = estimate.through_glass(self.frame.view.clear_shadows);
        let leaving = Some(vertex.surface.hit.surface);
        light * self.comes_through(segment, leaving, media, filtered)
    }
}
