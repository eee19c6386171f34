//! Whitted's integrator, one path at a time in `f64`. As every surface sends on at most
//! one ray, the recursion is a loop that carries the weight of what is still to come.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arrival, Light, Ray, Rgb, Span, Triple};

use crate::Hit;
use crate::integrator::Search;
use crate::integrator::walker::{Meeting, Walker};

impl<S: Search> Walker<'_, S> {
    /// The light that arrives along a ray from the camera, and what the ray meets first.
    pub(super) fn follow(&mut self, mut ray: Ray) -> (Rgb, Option<Hit>) {
        let snapshot = self.frame.snapshot;
        let (mut light, mut weight) = (Rgb::BLACK, Rgb::WHITE);
        let (mut first, mut leaving) = (None, None);
        self.stats.rays.primary += 1;
        for depth in 0.. {
            let Some(hit) = self.search.nearest(snapshot, &ray, Span::AHEAD, leaving) else {
                light += weight * snapshot.background();
                break;
            };
            if depth == 0 {
                first = Some(hit);
            }
            let meeting = self.meet(hit, ray);
            let reflected = meeting.material.reflectiveness().wide;
            if reflected < 1.0 {
                light += weight * (1.0 - reflected) * self.local(&meeting);
            }
            weight = weight * meeting.material.reflection_color().rgb() * reflected;
            if !self.goes_on(weight, depth) {
                break;
            }
            self.stats.rays.reflection += 1;
            ray = mirror(&meeting);
            leaving = Some(hit.place);
        }
        (light, first)
    }

    /// Whether a reflection of that weight is traced.
    fn goes_on(&mut self, weight: Rgb, depth: u32) -> bool {
        let skipped = &mut self.stats.skipped;
        let reason = if !(weight.max_channel() > 0.0) {
            &mut skipped.not_reflective
        } else if depth >= self.frame.view.max_depth {
            &mut skipped.depth_limit
        } else if weight.max_channel() < f64::from(self.frame.view.weight_cutoff) {
            &mut skipped.weight_cutoff
        } else {
            return true;
        };
        *reason += 1;
        false
    }

    /// The surface's own look: what it shows of itself, of ambient light, and of each light that reaches it.
    fn local(&mut self, meeting: &Meeting<'_>) -> Rgb {
        let snapshot = self.frame.snapshot;
        let at = &meeting.shading;
        let ambient: Rgb = rgb(meeting.material.under_ambient(at)) * snapshot.ambient();
        let mut light = rgb(meeting.material.own(at)) + ambient;
        if !meeting.material.answers_light() {
            self.stats.skipped.unlit_material += snapshot.lights().len() as u64;
            return light;
        }
        for lamp in snapshot.lights() {
            let arrival = lamp.arriving::<f64>(meeting.point.into());
            if let Some(cosine) = self.arrives(meeting, lamp, &arrival) {
                light += rgb(meeting.material.under_light(at, arrival.towards, cosine))
                    * rgb(lamp.irradiance(&arrival));
            }
        }
        light
    }

    /// The cosine under which a light reaches the surface, if it does.
    fn arrives(&mut self, meeting: &Meeting<'_>, lamp: &Light, arrival: &Arrival<f64>) -> Option<f64> {
        if !arrival.lit {
            self.stats.skipped.out_of_cone += 1;
            return None;
        }
        let cosine = arrival.towards.dot(meeting.shading.normal);
        if !(cosine > 0.0 && arrival.towards.dot(meeting.normal.into()) > 0.0) {
            self.stats.skipped.facing_away += 1;
            return None;
        }
        if !lamp.shadow() {
            self.stats.skipped.shadow_off += 1;
            return Some(cosine);
        }
        self.stats.rays.shadow += 1;
        let (ray, span) = shadow_ray(meeting.point, lamp)?;
        let leaving = Some(meeting.hit.place);
        (!self.search.occluded(self.frame.snapshot, &ray, span, leaving)).then_some(cosine)
    }
}

/// The way from a point to a light.
fn shadow_ray(point: DVec3, lamp: &Light) -> Option<(Ray, Span)> {
    match lamp.position() {
        Some(position) => Some((Ray::new(point, position - point), Span::TO_LIGHT)),
        None => lamp.direction().map(|direction| (Ray::new(point, -direction), Span::AHEAD)),
    }
}

/// The mirrored ray. Where a smoothed normal would send it through the surface, the surface's own normal is taken.
fn mirror(meeting: &Meeting<'_>) -> Ray {
    let d = meeting.ray.direction;
    let about = |n: DVec3| d - n * (2.0 * d.dot(n));
    let smooth = about(meeting.shading.normal.into());
    let direction = if smooth.dot(meeting.normal) > 0.0 { smooth } else { about(meeting.normal) };
    Ray::new(meeting.point, direction)
}

fn rgb(light: Triple<f64>) -> Rgb {
    Rgb::new(light.x, light.y, light.z)
}
