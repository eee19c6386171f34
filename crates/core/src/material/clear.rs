//! Which lobes does the surface of clear matter have?

use crate::lobe::fresnel::is_no_boundary;
use crate::lobe::{Complement, Passage, RoughInterface, Roughness, SmoothInterface, ThinWall};
use crate::{Bsdf, Rgb, SurfacePoint};

/// The surface of clear matter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Clear {
    /// Index of refraction.
    pub(super) ior: f64,
    pub(super) roughness: Roughness,
    /// Share of light that gets through the surface (of a thin wall through the wall), by channel.
    pub(super) tint: Rgb,
    /// Whether it is a wall that bends no light.
    pub(super) thin: bool,
}

impl Clear {
    /// Adds its lobes, each counting `weight`.
    pub(super) fn add_to(&self, bsdf: &mut Bsdf, weight: Rgb, at: &SurfacePoint) {
        if self.thin {
            self.add_wall(bsdf, weight, at);
        } else {
            self.add_interface(bsdf, weight, at);
        }
    }

    fn add_interface(&self, bsdf: &mut Bsdf, weight: Rgb, at: &SurfacePoint) {
        let eta = if at.shading.front { self.ior / at.outside_ior } else { at.outside_ior / self.ior };
        if is_no_boundary(eta) {
            return bsdf.add(weight, Passage { tint: self.tint });
        }
        let facet = SmoothInterface { eta, tint: self.tint };
        match self.roughness.facets() {
            Some(ggx) => {
                let interface = RoughInterface { ggx, facet };
                bsdf.add(weight, interface);
                bsdf.add(weight, Complement::of_interface(&interface));
            }
            None => bsdf.add(weight, facet),
        }
    }

    fn add_wall(&self, bsdf: &mut Bsdf, weight: Rgb, at: &SurfacePoint) {
        let facets = self.roughness.facets();
        let wall = ThinWall { eta: self.ior / at.outside_ior, tint: self.tint, facets };
        bsdf.add(weight, wall);
        if let Some(ggx) = facets {
            let [reflected, through] = wall.mean_shares();
            bsdf.add(weight, Complement::of_wall(ggx, reflected, through));
        }
    }
}
