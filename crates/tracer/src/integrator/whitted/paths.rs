//! Whitted's integrator, one path at a time in `f64`. As every surface sends on at most one ray, the recursion is a loop
//! that carries the weight of what is still to come.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arrival, Light, Lobes, Ray, Rgb, Span, Triple};

use crate::Hit;
use crate::integrator::Search;
use crate::integrator::walker::{CameraRay, SurfaceHit, Walker};
use crate::lamps::Drawn;
use crate::shade::{MirrorNormals, continues, mirror_direction};

impl<S: Search> Walker<'_, S> {
    /// The light that arrives along a ray from the camera, and what the ray meets first.
    pub(super) fn follow(&mut self, camera: &CameraRay) -> (Rgb, Option<Hit>) {
        let (snapshot, mut ray) = (self.frame.snapshot, camera.ray);
        let mut footprint = self.footprint(camera);
        let (mut light, mut weight) = (Rgb::BLACK, Triple::splat(1.0));
        let (mut first, mut leaving) = (None, None);
        self.stats.rays.primary += 1;
        for depth in 0.. {
            let Some(hit) = self.search.nearest(snapshot, &ray, Span::AHEAD, leaving) else {
                light += rgb(weight) * snapshot.background();
                break;
            };
            if depth == 0 {
                first = Some(hit);
            }
            let surface = self.surface_at(hit, ray);
            let lobes = match footprint.take() {
                Some(footprint) => {
                    surface.material.visit_mean_lobes((&surface.shading, &footprint), |lobes| lobes)
                }
                None => surface.material.lobes(&surface.shading),
            };
            if lobes.share > 0.0 {
                let drawn = Drawn { sampler: camera.sampler, sample: camera.sample, depth };
                light += rgb(weight) * lobes.share * self.local(&surface, &lobes, &drawn);
            }
            let skipped = &mut self.stats.skipped;
            let Some(mirror) = lobes.mirror else {
                skipped.not_reflective += 1;
                break;
            };
            weight = weight.times(mirror.tint);
            if !continues(true, weight, depth, self.frame.view, skipped) {
                break;
            }
            self.stats.rays.reflection += 1;
            ray = mirrored(&surface);
            leaving = Some(hit.surface);
        }
        (light, first)
    }

    /// What the base shows of itself, of ambient light, and of each light that reaches it.
    fn local(&mut self, surface: &SurfaceHit<'_>, lobes: &Lobes<f64>, drawn: &Drawn) -> Rgb {
        let snapshot = self.frame.snapshot;
        let mut light = rgb(lobes.unlit(Triple::of(lobes.share, snapshot.ambient_light())));
        if !lobes.is_lit() {
            self.stats.skipped.unlit_material += snapshot.lights().len() as u64;
            return light;
        }
        for lamp in snapshot.lights() {
            let arrival = lamp.arriving::<f64>(surface.point.into());
            if let Some(cosine) = self.arrives(surface, lamp, &arrival) {
                let shown = lobes.evaluate(&surface.shading, arrival.direction, cosine);
                light += rgb(shown.times(lamp.irradiance(&arrival)));
            }
        }
        light + self.lamplight(surface, lobes, drawn)
    }

    /// The cosine under which a light reaches the surface, if it does.
    fn arrives(&mut self, surface: &SurfaceHit<'_>, lamp: &Light, arrival: &Arrival<f64>) -> Option<f64> {
        if !arrival.lit {
            self.stats.skipped.out_of_cone += 1;
            return None;
        }
        let cosine = arrival.direction.dot(surface.shading.normal);
        if !(cosine > 0.0 && arrival.direction.dot(surface.normal.into()) > 0.0) {
            self.stats.skipped.facing_away += 1;
            return None;
        }
        if !lamp.shadow() {
            self.stats.skipped.shadow_off += 1;
            return Some(cosine);
        }
        self.stats.rays.shadow += 1;
        let (ray, span) = shadow_ray(surface.point, lamp)?;
        let leaving = Some(surface.hit.surface);
        (!self.search.occluded(self.frame.snapshot, &ray, span, leaving)).then_some(cosine)
    }
}

/// The segment from a point to a light.
pub(in crate::integrator) fn shadow_ray(point: DVec3, lamp: &Light) -> Option<(Ray, Span)> {
    match lamp.position() {
        Some(position) => Some((Ray::new(point, position - point), Span::TO_LIGHT)),
        None => lamp.direction().map(|direction| (Ray::new(point, -direction), Span::AHEAD)),
    }
}

fn mirrored(surface: &SurfaceHit<'_>) -> Ray {
    let normal = surface.normal.into();
    let normals = MirrorNormals { geometric: normal, shading: Some(surface.shading.normal), facing: normal };
    let direction = mirror_direction(surface.ray.direction.into(), &normals);
    Ray::new(surface.point, direction.into())
}

pub(super) fn rgb(light: Triple<f64>) -> Rgb {
    Rgb::new(light.x, light.y, light.z)
}
