//! Metal, glass, plastic and cloth in one: the parameters of glTF and OpenPBR.

mod look;

use super::medium::{Medium, absorption};
use super::{Emission, Surface};
use crate::lobe::Frame;
use crate::part::Given;
use crate::texture::{Paint, TexturePoint, TextureSource};
use crate::{
    Bsdf, Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, SurfacePoint, Triple, Value,
    Values,
};
use look::Look;

/// A base that is metal, clear or coloured, under sheen, under a coat. A layer dims what is below it by what it sends back to the
/// viewer: that keeps all energy, and is reciprocal within layers but not between them (as glTF's layers are).
#[derive(Debug, Clone, PartialEq)]
pub struct Principled {
    look: Look,
    tint: Paint,
    tint_distance: f64,
    priority: u32,
    unlit: bool,
}

const fn fraction(name: &'static str, default: fn() -> Value, doc: &'static str) -> Field {
    Field::required(name, FieldKind::Fraction, "", doc).or(default)
}

const fn color(name: &'static str, doc: &'static str) -> Field {
    Field::required(name, FieldKind::Color, "", doc).or(|| Value::Color(Rgb::WHITE))
}

const NONE: fn() -> Value = || Value::Number(0.0);
const ALL: fn() -> Value = || Value::Number(1.0);

impl Principled {
    /// Of a base colour; [`with`](Part::with) sets all its other fields, which are those of scene text.
    ///
    /// # Errors
    /// A channel outside 0..=1.
    pub fn new(base_color: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("base-color", Value::Color(base_color)))
    }
}

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
            base_color: given.paint("base-color")?,
            metallic: given.level("metallic")?,
            roughness: given.level("roughness")?,
            ior: given.positive("ior")?,
            transmission: given.level("transmission")?,
            specular: given.level("specular")?,
            specular_color: given.paint("specular-color")?,
            anisotropy: given.level("anisotropy")?,
            anisotropy_rotation: given.number("anisotropy-rotation")?,
            sheen: given.level("sheen")?,
            sheen_color: given.paint("sheen-color")?,
            sheen_roughness: given.level("sheen-roughness")?,
            coat: given.level("coat")?,
            coat_roughness: given.level("coat-roughness")?,
            emission: given.light("emission")?,
            thin: given.flag("thin")?,
        };
        Ok(Self {
            look,
            tint: given.paint("tint")?,
            tint_distance: given.positive("tint-distance")?,
            priority: given.whole("priority", 0, u32::MAX)?,
            unlit: given.flag("unlit")?,
        })
    }

    fn values(&self) -> Values {
        let look = &self.look;
        Values::new()
            .with("base-color", look.base_color.value())
            .with("metallic", look.metallic.value())
            .with("roughness", look.roughness.value())
            .with("ior", Value::Number(look.ior))
            .with("transmission", look.transmission.value())
            .with("specular", look.specular.value())
            .with("specular-color", look.specular_color.value())
            .with("anisotropy", look.anisotropy.value())
            .with("anisotropy-rotation", Value::Number(look.anisotropy_rotation))
            .with("sheen", look.sheen.value())
            .with("sheen-color", look.sheen_color.value())
            .with("sheen-roughness", look.sheen_roughness.value())
            .with("coat", look.coat.value())
            .with("coat-roughness", look.coat_roughness.value())
            .with("emission", look.emission.value())
            .with("thin", Value::Flag(look.thin))
            .with("tint", self.tint.value())
            .with("tint-distance", Value::Number(self.tint_distance))
            .with("priority", Value::Number(f64::from(self.priority)))
            .with("unlit", Value::Flag(self.unlit))
    }
}

impl Principled {
    /// What it sends out by itself.
    fn shown(&self) -> Rgb {
        let emission = self.look.emission.rgb();
        if self.unlit { emission + self.look.base_color.rgb() } else { emission }
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
        let look = &self.look;
        let frame = Frame::new(at.normal(), at.tangent).turned(look.anisotropy_rotation);
        let mut bsdf = Bsdf::in_frame(at, frame);
        if self.unlit || at.shading.front {
            bsdf.emission = self.shown();
        }
        if self.unlit {
            return bsdf;
        }
        // Layers lie on the outside.
        let below = if at.shading.front { look.add_layers(&mut bsdf, at) } else { Rgb::WHITE };
        look.add_base(&mut bsdf, below, at);
        bsdf
    }

    fn medium(&self) -> Option<Medium> {
        let absorption = absorption(self.tint.rgb(), self.tint_distance);
        self.look.is_solid().then_some(Medium { ior: self.look.ior, absorption, priority: self.priority })
    }

    fn is_anisotropic(&self) -> bool {
        self.look.anisotropy.base() > 0.0
    }

    fn emission(&self) -> Option<Emission> {
        let radiance = self.look.emission.rgb();
        (radiance != Rgb::BLACK && !self.unlit).then_some(Emission { radiance, two_sided: false })
    }

    fn emission_is_textured(&self) -> bool {
        self.look.emission.is_textured()
    }

    fn is_textured(&self) -> bool {
        self.look.is_textured() || self.tint.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self { look: self.look.resolved(textures, at), tint: self.tint.resolved(textures, at), ..*self }
    }
}
