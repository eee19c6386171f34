//! Clear matter: light is mirrored and bent at its surface, and absorbed on its way through.

use super::Surface;
use super::clear::Clear;
use super::medium::{Medium, absorption};
use crate::lobe::Roughness;
use crate::part::Given;
use crate::texture::{Level, Paint, TexturePoint, TextureSource};
use crate::{
    Bsdf, Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, SurfacePoint, Value, Values,
};

/// Glass, water, ice: a solid of one index of refraction, or a wall too thin to bend light.
#[derive(Debug, Clone, PartialEq)]
pub struct Glass {
    ior: f64,
    tint: Paint,
    tint_distance: f64,
    roughness: Level,
    thin: bool,
    priority: u32,
}

impl Glass {
    /// Clear, of an index of refraction; [`with`](Part::with) sets its `tint`, `tint-distance`, `roughness`, `thin` and `priority`.
    ///
    /// # Errors
    /// An index that is not positive and finite.
    pub fn new(ior: f64) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("ior", Value::Number(ior)))
    }
}

impl Part for Glass {
    const NAME: &'static str = "glass";
    const DOC: &'static str = "Clear matter that mirrors, bends and absorbs light.";
    const FIELDS: &'static [Field] = &[
        Field::required("ior", FieldKind::Number, "", "Index of refraction, greater than 0.")
            .or(|| Value::Number(1.5)),
        Field::required("tint", FieldKind::Color, "", "What is left of white light after the tint distance.")
            .or(|| Value::Color(Rgb::WHITE)),
        Field::required("tint-distance", FieldKind::Length, "m", "How far light goes until it has that tint.")
            .or(|| Value::Number(1.0)),
        Field::required("roughness", FieldKind::Fraction, "", "How frosted the surface is; 0 is clear.")
            .or(|| Value::Number(0.0)),
        Field::required(
            "thin",
            FieldKind::Flag,
            "",
            "Whether it is a wall that bends no light, such as a pane or a bubble; it has the tint at normal incidence.",
        )
        .or(|| Value::Flag(false)),
        Field::required(
            "priority",
            FieldKind::Count,
            "",
            "Where two solids overlap, the one of higher priority is there.",
        )
        .or(|| Value::Number(0.0)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self {
            ior: given.positive("ior")?,
            tint: given.paint("tint")?,
            tint_distance: given.positive("tint-distance")?,
            roughness: given.level("roughness")?,
            thin: given.flag("thin")?,
            priority: given.whole("priority", 0, u32::MAX)?,
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("ior", Value::Number(self.ior))
            .with("tint", self.tint.value())
            .with("tint-distance", Value::Number(self.tint_distance))
            .with("roughness", self.roughness.value())
            .with("thin", Value::Flag(self.thin))
            .with("priority", Value::Number(f64::from(self.priority)))
    }
}

impl Surface for Glass {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        Lobes::none(at.distance)
    }

    fn needs_bsdf(&self) -> bool {
        true
    }

    fn bsdf(&self, at: &SurfacePoint) -> Bsdf {
        let mut bsdf = Bsdf::new(at);
        // The tint of a solid is that of its inside.
        let tint = if self.thin { self.tint.rgb() } else { Rgb::WHITE };
        let roughness = Roughness::new(self.roughness.base());
        Clear { ior: self.ior, roughness, tint, thin: self.thin }.add_to(&mut bsdf, Rgb::WHITE, at);
        bsdf
    }

    fn medium(&self) -> Option<Medium> {
        let absorption = absorption(self.tint.rgb(), self.tint_distance);
        (!self.thin).then_some(Medium { ior: self.ior, absorption, priority: self.priority })
    }

    fn is_textured(&self) -> bool {
        self.tint.is_textured() || self.roughness.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self {
            tint: self.tint.resolved(textures, at),
            roughness: self.roughness.resolved(textures, at),
            ..*self
        }
    }
}
