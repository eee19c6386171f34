//! Rubber: a rough matte colour with a faint, blurred shine.

use super::Surface;
use crate::lobe::fresnel::Fresnel;
use crate::lobe::{Boundary, RoughDiffuse, Roughness};
use crate::part::Given;
use crate::texture::{Level, Paint, TexturePoint, TextureSource};
use crate::{
    Bsdf, Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, SurfacePoint, Value, Values,
};

/// Rough matte matter under a boundary of the same roughness. What the boundary does not reflect to the viewer is shown of the
/// matter below, so that white rubber absorbs nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Rubber {
    color: Paint,
    roughness: Level,
}

/// Index of refraction: natural rubber's is 1.52 (*Polymer Handbook*, 4th ed. 1999), and 1.5 shares its table with most glass and
/// plastic.
const IOR: f64 = 1.5;

impl Rubber {
    /// Of a colour below its surface; [`with`](Part::with) sets its `roughness`.
    ///
    /// # Errors
    /// A channel outside 0..=1.
    pub fn new(color: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("color", Value::Color(color)))
    }
}

impl Part for Rubber {
    const NAME: &'static str = "rubber";
    const DOC: &'static str = "A rough matte colour with a faint shine.";
    const FIELDS: &'static [Field] = &[
        Field::required("color", FieldKind::Color, "", "Share of light that is scattered below the surface."),
        Field::required("roughness", FieldKind::Fraction, "", "How rough it is, its shine and its colour.")
            .or(|| Value::Number(0.7)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self { color: given.paint("color")?, roughness: given.level("roughness")? })
    }

    fn values(&self) -> Values {
        Values::new().with("color", self.color.value()).with("roughness", self.roughness.value())
    }
}

impl Surface for Rubber {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        Lobes::none(at.distance)
    }

    fn needs_bsdf(&self) -> bool {
        true
    }

    fn bsdf(&self, at: &SurfacePoint) -> Bsdf {
        let mut bsdf = Bsdf::new(at);
        let fresnel = Fresnel::clear(IOR / at.outside_ior);
        let boundary = Boundary::new(Roughness::new(self.roughness.base()), fresnel);
        let left = Rgb::WHITE - boundary.reflected(bsdf.cosine());
        bsdf.add(Rgb::WHITE, boundary.lobe());
        bsdf.add(left, RoughDiffuse::new(self.color.rgb(), self.roughness.base()));
        bsdf
    }

    fn is_textured(&self) -> bool {
        self.color.is_textured() || self.roughness.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self { color: self.color.resolved(textures, at), roughness: self.roughness.resolved(textures, at) }
    }
}
