//! Light from surfaces at one point, in `f64`: in closed form, or by rays.

use catoptra_core::{Lobes, Rgb};

use super::paths::rgb;
use crate::LampLight;
use crate::integrator::Search;
use crate::integrator::walker::{SurfaceHit, Walker};
use crate::lamps::{
    Drawn, Gathered, LampRay, LampRays, LitPoint, follow, follow_picked, gather_for_rays, picked,
};
use crate::snapshot::LampRow;

impl<S: Search> Walker<'_, S> {
    /// What a surface shows of the light of all lamps, before the base's share.
    pub(super) fn lamplight(&mut self, surface: &SurfaceHit<'_>, lobes: &Lobes<f64>, drawn: &Drawn) -> Rgb {
        let snapshot = self.frame.snapshot;
        let at = LitPoint {
            point: surface.point,
            normal: surface.shading.normal.into(),
            ground: surface.normal,
            surface: Some(surface.hit.surface),
        };
        let brdf = match lobes.diffuse {
            Some(diffuse) => rgb(diffuse.brdf()),
            None => Rgb::BLACK,
        };
        let mut light = Rgb::BLACK;
        if let Some(tree) = &snapshot.lamps().tree {
            self.stats.lamps.sampled += 1;
            let (origin, count) = (snapshot.origin_in_frame(), self.frame.view.lamp_rays_of_sample());
            let rays = picked(snapshot.lamps(), tree, &at, origin, drawn, count);
            let shone = follow_picked(rays, &surface.shading, lobes, |ray| {
                self.is_blocked(&ray.ray, ray.lamp, surface)
            });
            light += shone.glossy + brdf * shone.irradiance;
        }
        for (number, lamp) in snapshot.lamps().asked().iter().enumerate() {
            let stats = &mut self.stats.lamps;
            let seen = match self.frame.view.lamp_light {
                LampLight::Exact => self.sight.gather(self.search, snapshot, lamp, &at, stats),
                LampLight::Rays | LampLight::PlainRays => gather_for_rays(lamp, &at, stats),
            };
            if seen == Gathered::Exactly(0.0) {
                continue;
            }
            let glossy = lobes.is_glossy();
            let shown = match seen {
                Gathered::Exactly(irradiance) if !glossy => brdf * irradiance,
                _ => {
                    let rays = LampRays::new(lamp, number, &at, drawn, self.frame.view.lamp_rays_of_sample());
                    let (found, shown) =
                        follow(&rays, &surface.shading, lobes, |ray| self.is_blocked(ray, lamp, surface));
                    shown + brdf * found.of(seen, rays.count)
                }
            };
            light += shown * lamp.radiance.rgb();
        }
        light
    }

    fn is_blocked(&mut self, ray: &LampRay, lamp: &LampRow, surface: &SurfaceHit<'_>) -> bool {
        lamp.shadow && {
            self.stats.rays.lamp += 1;
            self.search.occluded(self.frame.snapshot, &ray.ray, ray.span, Some(surface.hit.surface))
        }
    }
}
