//! How does light leave a principled material where it is looked at?

use super::super::Metal;
use super::super::clear::Clear;
use crate::lobe::fresnel::Fresnel;
use crate::lobe::{Boundary, Complement, Diffuse, Roughness, Sheen};
use crate::texture::{Level, Paint, TexturePoint, TextureSource};
use crate::{Bsdf, Rgb, SurfacePoint};

/// What its surface is like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Look {
    pub(super) base_color: Paint,
    pub(super) metallic: Level,
    pub(super) roughness: Level,
    pub(super) ior: f64,
    pub(super) transmission: Level,
    pub(super) specular: Level,
    pub(super) specular_color: Paint,
    pub(super) anisotropy: Level,
    /// Radians.
    pub(super) anisotropy_rotation: f64,
    pub(super) sheen: Level,
    pub(super) sheen_color: Paint,
    pub(super) sheen_roughness: Level,
    pub(super) coat: Level,
    pub(super) coat_roughness: Level,
    pub(super) emission: Paint,
    pub(super) thin: bool,
}

/// Index of refraction of coats: lacquer's.
const COAT_IOR: f64 = 1.5;

impl Look {
    /// Whether light goes into what it encloses.
    pub(super) fn is_solid(&self) -> bool {
        self.transmission.base() > 0.0 && !self.thin
    }

    /// Adds a coat and sheen, and tells what they leave for the base.
    pub(super) fn add_layers(&self, bsdf: &mut Bsdf, at: &SurfacePoint) -> Rgb {
        let mut weight = Rgb::WHITE;
        let (coat, sheen) = (self.coat.base(), self.sheen.base());
        if coat > 0.0 {
            let fresnel = Fresnel::clear(COAT_IOR / at.outside_ior);
            let boundary = Boundary::new(Roughness::new(self.coat_roughness.base()), fresnel);
            bsdf.add(weight * coat, boundary.lobe());
            weight = weight * (Rgb::WHITE - boundary.reflected(bsdf.cosine()) * coat);
        }
        if sheen > 0.0 {
            let (fibres, color) = (Sheen::new(self.sheen_roughness.base()), self.sheen_color.rgb() * sheen);
            bsdf.add(weight * color, fibres);
            weight = weight * (1.0 - color.max_channel() * fibres.scattered(bsdf.cosine()));
        }
        weight
    }

    /// Adds the lobes of what is below, which count `weight` in all.
    pub(super) fn add_base(&self, bsdf: &mut Bsdf, weight: Rgb, at: &SurfacePoint) {
        let (color, metallic, transmission) =
            (self.base_color.rgb(), self.metallic.base(), self.transmission.base());
        let roughness = Roughness::stretched(self.roughness.base(), self.anisotropy.base());
        let (metal, rest) = (weight * metallic, weight * (1.0 - metallic));
        if metallic > 0.0 {
            Metal::add_lobes(bsdf, metal, Fresnel::metal(color, Rgb::WHITE), roughness);
        }
        let (clear, opaque) = (rest * transmission, rest * (1.0 - transmission));
        if transmission > 0.0 {
            let surface = Clear { ior: self.ior, roughness, tint: color, thin: self.thin };
            surface.add_to(bsdf, clear, at);
        }
        if self.specular.base() > 0.0 {
            let eta = self.ior / at.outside_ior;
            let fresnel = Fresnel::specular(eta, self.specular.base(), self.specular_color.rgb());
            let boundary = Boundary::new(roughness, fresnel);
            bsdf.add(opaque, boundary.lobe());
            bsdf.add(opaque, Complement::below(boundary, color));
        } else {
            bsdf.add(opaque, Diffuse { albedo: color.into() });
        }
    }
}

/// Where textures multiply it.
impl Look {
    pub(super) fn is_textured(&self) -> bool {
        let paints = [&self.base_color, &self.specular_color, &self.sheen_color, &self.emission];
        let levels = [
            &self.metallic,
            &self.roughness,
            &self.transmission,
            &self.specular,
            &self.anisotropy,
            &self.sheen,
            &self.sheen_roughness,
            &self.coat,
            &self.coat_roughness,
        ];
        paints.into_iter().any(Paint::is_textured) || levels.into_iter().any(Level::is_textured)
    }

    /// What it is at a point, without textures.
    pub(super) fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        let (paint, level) = (|p: &Paint| p.resolved(textures, at), |l: &Level| l.resolved(textures, at));
        Self {
            base_color: paint(&self.base_color),
            metallic: level(&self.metallic),
            roughness: level(&self.roughness),
            transmission: level(&self.transmission),
            specular: level(&self.specular),
            specular_color: paint(&self.specular_color),
            anisotropy: level(&self.anisotropy),
            sheen: level(&self.sheen),
            sheen_color: paint(&self.sheen_color),
            sheen_roughness: level(&self.sheen_roughness),
            coat: level(&self.coat),
            coat_roughness: level(&self.coat_roughness),
            emission: self.emission.resolved_light(textures, at),
            ..*self
        }
    }
}
