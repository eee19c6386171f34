//! What does a point show of the light that comes straight from lights and lamps?

use catoptra_core::{Light, Rgb};

use super::{Numbers, PathRay, Vertex};
use crate::integrator::Search;
use crate::integrator::walker::Walker;
use crate::integrator::whitted::shadow_ray;

/// What else gathers light, which direct light must not count again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::integrator) enum Estimate {
    /// Nothing: rays go on in single directions alone.
    Alone,
    /// Rays in directions that lobes choose: what they meet of lamps and surroundings is counted together with what is chosen
    /// here (Veach and Guibas, "Optimally combining sampling techniques", SIGGRAPH 1995, the balance heuristic).
    WithPaths,
}

impl Estimate {
    /// Whether light comes through clear matter without being bent.
    pub(super) fn through_glass(self, filtered: bool) -> bool {
        self == Self::Alone && filtered
    }
}

impl<S: Search> Walker<'_, S> {
    /// Radiance that a point shows of direct light.
    pub(in crate::integrator) fn direct_light(
        &mut self,
        vertex: &Vertex<'_>,
        path: &PathRay,
        numbers: &Numbers,
        estimate: Estimate,
    ) -> Rgb {
        if !vertex.bsdf.is_lit() {
            self.stats.skipped.unlit_material += self.frame.snapshot.lights().len() as u64;
            return Rgb::BLACK;
        }
        let mut light = Rgb::BLACK;
        for lamp in self.frame.snapshot.lights() {
            light += self.of_light(vertex, path, lamp, estimate);
        }
        light += self.of_lamps(vertex, path, numbers, estimate);
        light + self.of_surroundings(vertex, path, numbers, estimate)
    }

    /// Of a light that is a point or lies infinitely far away.
    fn of_light(&mut self, vertex: &Vertex<'_>, path: &PathRay, lamp: &Light, estimate: Estimate) -> Rgb {
        let arrival = lamp.arriving::<f64>(vertex.surface.point.into());
        if !arrival.lit {
            self.stats.skipped.out_of_cone += 1;
            return Rgb::BLACK;
        }
        let shown = vertex.bsdf.evaluate(arrival.direction.into());
        if !(shown.max_channel() > 0.0) {
            self.stats.skipped.facing_away += 1;
            return Rgb::BLACK;
        }
        let brought = lamp.irradiance(&arrival);
        let light = shown * Rgb::new(brought.x, brought.y, brought.z);
        if !lamp.shadow() {
            self.stats.skipped.shadow_off += 1;
            return light;
        }
        self.stats.rays.shadow += 1;
        let Some(segment) = shadow_ray(vertex.surface.point, lamp) else { return Rgb::BLACK };
        let above = segment.0.direction.dot(vertex.surface.normal) > 0.0;
        let media = if above { &path.media } else { &vertex.behind };
        let leaving = Some(vertex.surface.hit.surface);
        let filtered = estimate.through_glass(self.frame.view.clear_shadows);
        light * self.comes_through(segment, leaving, media, filtered)
    }
}
