//! Metal, glass, plastic and cloth in one: the parameters of glTF and OpenPBR.

use super::clear::Clear;
use super::medium::{Medium, absorption};
use super::{Emission, Metal, Surface};
use crate::lobe::fresnel::Fresnel;
use crate::lobe::{Boundary, Complement, Diffuse, Frame, Passage, Roughness, Sheen};
use crate::part::Given;
use crate::{
    Bsdf, Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, SurfacePoint, Triple, Value,
    Values,
};

/// A base that is metal, clear or coloured, under sheen, under a coat. A layer dims what is below it by what it sends back to the
/// viewer: that keeps all energy, and is reciprocal within layers but not between them (as glTF's layers are).
#[derive(Debug, Clone, PartialEq)]
pub struct Principled {
    look: Look,
    medium: Medium,
    /// As given.
    tint: Rgb,
    tint_distance: f64,
    unlit: bool,
}

/// What may differ from point to point.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Look {
    base_color: Rgb,
    metallic: f64,
    roughness: f64,
    ior: f64,
    transmission: f64,
    specular: f64,
    specular_color: Rgb,
    anisotropy: f64,
    anisotropy_rotation: f64,
    sheen: f64,
    sheen_color: Rgb,
    sheen_roughness: f64,
    coat: f64,
    coat_roughness: f64,
    emission: Rgb,
    opacity: f64,
    thin: bool,
}

/// Index of refraction of coats: lacquer's.
const COAT_IOR: f64 = 1.5;

const fn fraction(name: &'static str, default: fn() -> Value, doc: &'static str) -> Field {
    Field::required(name, FieldKind::Fraction, "", doc).or(default)
}

const fn color(name: &'static str, doc: &'static str) -> Field {
    Field::required(name, FieldKind::Color, "", doc).or(|| Value::Color(Rgb::WHITE))
}

const NONE: fn() -> Value = || Value::Number(0.0);
const ALL: fn() -> Value = || Value::Number(1.0);

impl Part for Principled {
    const NAME: &'static str = "principled";
    const DOC: &'static str = "Metal, glass, plastic or cloth, by the parameters of glTF and OpenPBR.";
    const FIELDS: &'static [Field] = &[
        color("base-color", "Colour of what is scattered, of metal, and of light that goes through."),
        fraction("metallic", NONE, "How much of it is metal."),
        fraction("roughness", || Value::Number(0.5), "How blurred reflections are; 0 is a mirror."),
        Field::required("ior", FieldKind::Number, "", "Index of refraction, greater than 0.")
            .or(|| Value::Number(1.5)),
        fraction("transmission", NONE, "How much of what is no metal lets light through."),
        fraction("specular", ALL, "Strength of reflections of what is neither metal nor clear."),
        color("specular-color", "Colour of these reflections at normal incidence."),
        fraction("anisotropy", NONE, "How much rougher it is along one direction than across."),
        Field::required(
            "anisotropy-rotation",
            FieldKind::Angle,
            "",
            "From where the first texture coordinate grows to that direction, anticlockwise.",
        )
        .or(NONE),
        fraction("sheen", NONE, "How much there is of fibres that shine on the rim, as of velvet."),
        color("sheen-color", "Colour of the fibres."),
        fraction("sheen-roughness", || Value::Number(0.3), "How wide the rim is, from 0.2 on."),
        fraction("coat", NONE, "How much of it is lacquered."),
        fraction("coat-roughness", NONE, "How blurred reflections in the lacquer are."),
        Field::required("emission", FieldKind::Quantity, "W/(m²·sr)", "Radiance of its own, on its front.")
            .or(|| Value::Color(Rgb::BLACK)),
        fraction("opacity", ALL, "How much of it is there; through the rest one sees straight."),
        Field::required("thin", FieldKind::Flag, "", "Whether it is a sheet that bends no light.")
            .or(|| Value::Flag(false)),
        color("tint", "What is left of white light after the tint distance, inside."),
        Field::required(
            "tint-distance",
            FieldKind::Length,
            "m",
            "How far light goes until it has that tint.",
        )
        .or(ALL),
        Field::required(
            "priority",
            FieldKind::Count,
            "",
            "Where two clear solids overlap, the one of higher priority is there.",
        )
        .or(NONE),
        Field::required("unlit", FieldKind::Flag, "", "Whether it shows its base color whatever the light.")
            .or(|| Value::Flag(false)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let look = Look {
            base_color: given.color("base-color")?,
            metallic: given.fraction("metallic")?,
            roughness: given.fraction("roughness")?,
            ior: given.positive("ior")?,
            transmission: given.fraction("transmission")?,
            specular: given.fraction("specular")?,
            specular_color: given.color("specular-color")?,
            anisotropy: given.fraction("anisotropy")?,
            anisotropy_rotation: given.number("anisotropy-rotation")?,
            sheen: given.fraction("sheen")?,
            sheen_color: given.color("sheen-color")?,
            sheen_roughness: given.fraction("sheen-roughness")?,
            coat: given.fraction("coat")?,
            coat_roughness: given.fraction("coat-roughness")?,
            emission: given.quantity("emission")?,
            opacity: given.fraction("opacity")?,
            thin: given.flag("thin")?,
        };
        let (tint, tint_distance) = (given.color("tint")?, given.positive("tint-distance")?);
        let priority = given.whole("priority", 0, u32::MAX)?;
        let medium = Medium { ior: look.ior, absorption: absorption(tint, tint_distance), priority };
        Ok(Self { look, medium, tint, tint_distance, unlit: given.flag("unlit")? })
    }

    fn values(&self) -> Values {
        let look = &self.look;
        Values::new()
            .with("base-color", Value::Color(look.base_color))
            .with("metallic", Value::Number(look.metallic))
            .with("roughness", Value::Number(look.roughness))
            .with("ior", Value::Number(look.ior))
            .with("transmission", Value::Number(look.transmission))
            .with("specular", Value::Number(look.specular))
            .with("specular-color", Value::Color(look.specular_color))
            .with("anisotropy", Value::Number(look.anisotropy))
            .with("anisotropy-rotation", Value::Number(look.anisotropy_rotation))
            .with("sheen", Value::Number(look.sheen))
            .with("sheen-color", Value::Color(look.sheen_color))
            .with("sheen-roughness", Value::Number(look.sheen_roughness))
            .with("coat", Value::Number(look.coat))
            .with("coat-roughness", Value::Number(look.coat_roughness))
            .with("emission", Value::Color(look.emission))
            .with("opacity", Value::Number(look.opacity))
            .with("thin", Value::Flag(look.thin))
            .with("tint", Value::Color(self.tint))
            .with("tint-distance", Value::Number(self.tint_distance))
            .with("priority", Value::Number(f64::from(self.medium.priority)))
            .with("unlit", Value::Flag(self.unlit))
    }
}

impl Principled {
    /// What it is like at a point.
    fn look(&self, _at: &SurfacePoint) -> Look {
        self.look
    }

    /// What it sends out by itself.
    fn shown(&self) -> Rgb {
        if self.unlit { self.look.emission + self.look.base_color } else { self.look.emission }
    }
}

impl Look {
    /// Adds a coat and sheen, and tells what they leave for the base of all that counts `weight`.
    fn add_layers(&self, bsdf: &mut Bsdf, mut weight: Rgb, at: &SurfacePoint) -> Rgb {
        if self.coat > 0.0 {
            let fresnel = Fresnel::clear(COAT_IOR / at.outside_ior);
            let coat = Boundary::new(Roughness::new(self.coat_roughness), fresnel);
            bsdf.add(weight * self.coat, coat.lobe());
            weight = weight * (Rgb::WHITE - coat.reflected(bsdf.cosine()) * self.coat);
        }
        if self.sheen > 0.0 {
            let (sheen, color) = (Sheen::new(self.sheen_roughness), self.sheen_color * self.sheen);
            bsdf.add(weight * color, sheen);
            weight = weight * (1.0 - color.max_channel() * sheen.scattered(bsdf.cosine()));
        }
        weight
    }

    /// Adds the lobes of what is below, which count `weight` in all.
    fn add_base(&self, bsdf: &mut Bsdf, weight: Rgb, at: &SurfacePoint) {
        let roughness = Roughness::stretched(self.roughness, self.anisotropy);
        let (metal, rest) = (weight * self.metallic, weight * (1.0 - self.metallic));
        if self.metallic > 0.0 {
            Metal::add_lobes(bsdf, metal, Fresnel::metal(self.base_color, Rgb::WHITE), roughness);
        }
        let (clear, opaque) = (rest * self.transmission, rest * (1.0 - self.transmission));
        if self.transmission > 0.0 {
            let surface = Clear { ior: self.ior, roughness, tint: self.base_color, thin: self.thin };
            surface.add_to(bsdf, clear, at);
        }
        if self.specular > 0.0 {
            let eta = self.ior / at.outside_ior;
            let fresnel = Fresnel::specular(eta, self.specular, self.specular_color);
            let boundary = Boundary::new(roughness, fresnel);
            bsdf.add(opaque, boundary.lobe());
            bsdf.add(opaque, Complement::below(boundary, self.base_color));
        } else {
            bsdf.add(opaque, Diffuse { albedo: self.base_color.into() });
        }
    }
}

impl Surface for Principled {
    /// Its own light; the rest is more than lanes know.
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        let radiance = Triple::of(at.distance, &self.shown().into());
        let dark = Triple::splat(at.distance.number(0.0));
        let emission = if self.unlit { radiance } else { Triple::select(at.front, radiance, dark) };
        Lobes { emission, ..Lobes::none(at.distance) }
    }

    fn needs_bsdf(&self) -> bool {
        true
    }

    fn bsdf(&self, at: &SurfacePoint) -> Bsdf {
        let look = self.look(at);
        let frame = Frame::new(at.normal(), at.tangent).turned(look.anisotropy_rotation);
        let mut bsdf = Bsdf::in_frame(at, frame);
        let there = Rgb::grey(look.opacity);
        bsdf.add(Rgb::WHITE - there, Passage { tint: Rgb::WHITE });
        if self.unlit {
            bsdf.emission = there * self.shown();
            return bsdf;
        }
        if at.shading.front {
            bsdf.emission = there * look.emission;
        }
        // Layers lie on the outside.
        let below = if at.shading.front { look.add_layers(&mut bsdf, there, at) } else { there };
        look.add_base(&mut bsdf, below, at);
        bsdf
    }

    fn medium(&self) -> Option<Medium> {
        (self.look.transmission > 0.0 && !self.look.thin).then_some(self.medium)
    }

    fn emission(&self) -> Option<Emission> {
        let radiance = self.look.emission;
        (radiance != Rgb::BLACK && !self.unlit).then_some(Emission { radiance, two_sided: false })
    }
}
