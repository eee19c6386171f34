//! Light from surfaces at a point of any material: what scatters alike in all directions in closed form, other lobes by rays.

use std::f64::consts::PI;

use catoptra_core::Rgb;
use catoptra_core::glam::DVec3;

use super::{Estimate, Numbers, Origin, PathRay, Vertex};
use crate::LampLight;
use crate::integrator::Search;
use crate::integrator::walker::Walker;
use crate::lamps::{Found, Gathered, LampRay, LampRays, LitPoint, gather_for_rays, may_hide, picked};
use crate::snapshot::LampRow;

/// Rays to each lamp from every point of a path.
const RAYS_OF_PATHS: u32 = 2;

impl<S: Search> Walker<'_, S> {
    /// Radiance that a point shows of the light of all lamps.
    pub(super) fn of_lamps(
        &mut self,
        vertex: &Vertex<'_>,
        path: &PathRay,
        numbers: &Numbers,
        estimate: Estimate,
    ) -> Rgb {
        let (at, drawn) = (vertex.lit_point(), numbers.drawn(path.depth));
        let count = match estimate {
            Estimate::Alone => self.frame.view.lamp_rays_of_sample(),
            Estimate::WithPaths => RAYS_OF_PATHS,
        };
        let lamps = self.frame.snapshot.lamps();
        let tree = match estimate {
            Estimate::Alone => lamps.tree.as_ref(),
            Estimate::WithPaths => lamps.tree_of_paths(),
        };
        if let Some(tree) = tree {
            self.stats.lamps.sampled += 1;
            let origin = self.frame.snapshot.origin_in_frame();
            let mut light = Rgb::BLACK;
            for found in picked(lamps, tree, &at, origin, &drawn, count) {
                // What other lobes show of so many lamps, paths find.
                let glossy = match estimate {
                    Estimate::Alone => vertex.bsdf.glossy(found.ray.direction) * found.ray.solid,
                    Estimate::WithPaths => Rgb::BLACK,
                };
                let brought = vertex.bsdf.diffuse() * (found.ray.share / PI) + glossy;
                if brought.max_channel() > 0.0 && found.ray.above_ground {
                    let through = self.of_ray(vertex, path, found.lamp, &found.ray, estimate);
                    light += brought * through * found.lamp.radiance.rgb();
                }
            }
            return light;
        }
        let mut light = Rgb::BLACK;
        for (number, lamp) in lamps.asked().iter().enumerate() {
            let seen = self.seen_of(lamp, &at);
            if seen == Gathered::Exactly(0.0) {
                continue;
            }
            let shown = match seen {
                Gathered::Exactly(irradiance) if !vertex.bsdf.is_glossy() => {
                    vertex.bsdf.diffuse() * (irradiance / PI)
                }
                _ => {
                    let rays = LampRays::new(lamp, number, &at, &drawn, count);
                    self.by_rays(vertex, path, (lamp, seen), &rays, estimate)
                }
            };
            light += shown * lamp.radiance.rgb();
        }
        light
    }

    /// What a point sees of a lamp of unit radiance, unless something see-through may stand between.
    fn seen_of(&mut self, lamp: &LampRow, at: &LitPoint) -> Gathered {
        let snapshot = self.frame.snapshot;
        let stats = &mut self.stats.lamps;
        if self.frame.view.lamp_light != LampLight::Exact {
            return gather_for_rays(lamp, at, stats);
        }
        // Asked alike whoever searches, so that all find the same light in the same way.
        let clear = &snapshot.matter().clear;
        if lamp.shadow && clear.iter().any(|&prim| may_hide(snapshot, lamp, prim, at)) {
            return gather_for_rays(lamp, at, stats);
        }
        self.sight.gather(self.search, snapshot, lamp, at, stats)
    }

    /// What a point shows of a lamp of unit radiance, of which so much was gathered, by rays.
    fn by_rays(
        &mut self,
        vertex: &Vertex<'_>,
        path: &PathRay,
        (lamp, seen): (&LampRow, Gathered),
        rays: &LampRays,
        estimate: Estimate,
    ) -> Rgb {
        let (mut found, mut brought, mut tinted) = (Found::default(), Rgb::BLACK, Rgb::BLACK);
        let (mut glossy, of_one) = (Rgb::BLACK, 1.0 / f64::from(rays.count));
        for (number, ray) in rays.above() {
            let through =
                if ray.above_ground { self.of_ray(vertex, path, lamp, &ray, estimate) } else { Rgb::BLACK };
            found.add(number, ray.share, through == Rgb::WHITE);
            let share = through * (ray.share * of_one);
            brought += share;
            if through != Rgb::WHITE {
                tinted += share;
            }
            if through != Rgb::BLACK {
                let shown = vertex.bsdf.glossy(ray.direction) * (ray.solid * of_one);
                glossy += shown * through * self.share_of_ray(vertex, lamp, &ray, rays.count, estimate);
            }
        }
        let irradiance = match (seen, estimate) {
            (Gathered::Exactly(seen), _) => Rgb::grey(seen),
            // Two rays alone: what corrects them would be cut off at nothing too often to be right in the mean.
            (Gathered::UpTo(_), Estimate::WithPaths) => brought,
            (Gathered::UpTo(_), Estimate::Alone) => Rgb::grey(found.of(seen, rays.count)) + tinted,
        };
        vertex.bsdf.diffuse() * irradiance * (1.0 / PI) + glossy
    }

    /// How much light comes along a ray to a lamp.
    fn of_ray(
        &mut self,
        vertex: &Vertex<'_>,
        path: &PathRay,
        lamp: &LampRow,
        ray: &LampRay,
        estimate: Estimate,
    ) -> Rgb {
        if !lamp.shadow {
            return Rgb::WHITE;
        }
        self.stats.rays.lamp += 1;
        let leaving = Some(vertex.surface.hit.surface);
        let filtered = estimate.through_glass(self.frame.view.clear_shadows);
        self.comes_through((ray.ray, ray.span), leaving, &path.media, filtered)
    }

    /// How much of what a ray to a lamp brings counts, beside rays that meet the lamp by themselves.
    fn share_of_ray(
        &self,
        vertex: &Vertex<'_>,
        lamp: &LampRow,
        ray: &LampRay,
        count: u32,
        estimate: Estimate,
    ) -> f64 {
        let (Estimate::WithPaths, Some(prim)) = (estimate, lamp.prim) else { return 1.0 };
        let to = ray.ray.direction;
        let normal = lamp.normal.unwrap_or_else(|| {
            let center = lamp.ball.center + self.frame.snapshot.origin_in_frame();
            (ray.ray.origin + to - center).normalize_or_zero()
        });
        let chosen = self.density_of_lamp(prim, to, normal) * f64::from(count);
        chosen / (chosen + vertex.bsdf.pdf(ray.direction))
    }

    /// How densely directions to a lamp lie, 1/sr, as if its points were chosen evenly: what both ways of meeting it are
    /// weighed by.
    fn density_of_lamp(&self, prim: u32, to: DVec3, normal: DVec3) -> f64 {
        let area = self.frame.snapshot.lamps().areas.get(&prim).copied().unwrap_or(f64::INFINITY);
        let cosine = to.normalize_or_zero().dot(normal).abs().max(1e-9);
        to.length_squared() / (area * cosine)
    }

    /// What of the light of its own that a path meets counts.
    pub(in crate::integrator) fn share_of_emission(&self, vertex: &Vertex<'_>, path: &PathRay) -> Rgb {
        let lamps = self.frame.snapshot.lamps();
        let prim = vertex.surface.hit.surface.prim;
        match path.origin {
            Origin::Alone => path.weight,
            _ if !lamps.areas.contains_key(&prim) => path.weight,
            Origin::Reflected(pdf) if lamps.tree_of_paths().is_none() => {
                let to = vertex.surface.point - path.ray.origin;
                let chosen = self.density_of_lamp(prim, to, vertex.surface.hit.crossing.normal)
                    * f64::from(RAYS_OF_PATHS);
                path.glossy * (pdf / (pdf + chosen))
            }
            Origin::Reflected(_) | Origin::Transmitted(_) | Origin::Apart => path.glossy,
        }
    }
}
