//! Plastic: colour under a clear, more or less smooth surface.

use super::Surface;
use crate::lobe::fresnel::Fresnel;
use crate::lobe::{Boundary, Complement, Roughness};
use crate::part::Given;
use crate::texture::{Level, Paint, TexturePoint, TextureSource};
use crate::{
    Bsdf, Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, SurfacePoint, Value, Values,
};

/// Matter that scatters light evenly under a clear boundary that reflects some. What the boundary does not reflect is
/// scattered, and all of that comes out again of which the colour leaves all: white plastic absorbs nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Plastic {
    color: Paint,
    ior: f64,
    roughness: Level,
}

impl Plastic {
    /// Of a colour below its surface; [`with`](Part::with) sets its `ior` and `roughness`.
    ///
    /// # Errors
    /// A channel outside 0..=1.
    pub fn new(color: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("color", Value::Color(color)))
    }
}

impl Part for Plastic {
    const NAME: &'static str = "plastic";
    const DOC: &'static str = "Colour under a clear surface, shiny or satin.";
    const FIELDS: &'static [Field] = &[
        Field::required(
            "color",
            FieldKind::Color,
            "",
            "Share of light that comes out again of what goes in.",
        ),
        Field::required("ior", FieldKind::Number, "", "Index of refraction, greater than 0.")
            .or(|| Value::Number(1.5)),
        Field::required("roughness", FieldKind::Fraction, "", "How blurred reflections are; 0 is polished.")
            .or(|| Value::Number(0.2)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self {
            color: given.paint("color")?,
            ior: given.positive("ior")?,
            roughness: given.level("roughness")?,
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("color", self.color.value())
            .with("ior", Value::Number(self.ior))
            .with("roughness", self.roughness.value())
    }
}

impl Surface for Plastic {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        Lobes::none(at.distance)
    }

    fn needs_bsdf(&self) -> bool {
        true
    }

    fn bsdf(&self, at: &SurfacePoint) -> Bsdf {
        let mut bsdf = Bsdf::new(at);
        let fresnel = Fresnel::clear(self.ior / at.outside_ior);
        let boundary = Boundary::new(Roughness::new(self.roughness.base()), fresnel);
        bsdf.add(Rgb::WHITE, boundary.lobe());
        bsdf.add(Rgb::WHITE, Complement::below(boundary, self.color.rgb()));
        bsdf
    }

    fn is_textured(&self) -> bool {
        self.color.is_textured() || self.roughness.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self {
            color: self.color.resolved(textures, at),
            roughness: self.roughness.resolved(textures, at),
            ..*self
        }
    }
}
