//! Metal: reflects in its colour, blurred as it is rough.

use super::Surface;
use crate::lobe::fresnel::Fresnel;
use crate::lobe::{Boundary, Complement, Roughness};
use crate::part::Given;
use crate::texture::{Level, Paint, TexturePoint, TextureSource};
use crate::{
    Bsdf, Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, SurfacePoint, Value, Values,
};

/// A conductor, given by its reflectance or by its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Metal {
    reflectance: Reflectance,
    edge: Paint,
    roughness: Level,
}

/// How its colour was given.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Reflectance {
    Color(Paint),
    /// An index into the names.
    Preset(usize),
}

/// Names of metals.
const PRESETS: &[&str] = &[
    "gold",
    "silver",
    "copper",
    "aluminium",
    "iron",
    "chromium",
    "brass",
    "titanium",
    "nickel",
    "platinum",
    "zinc",
];

/// Reflectances at normal incidence, linear Rec. 709, in the order of the names (Akenine-Möller et al., *Real-Time Rendering*,
/// 4th ed. 2018, table 9.2, from measured indices of refraction).
const REFLECTANCES: [Rgb; PRESETS.len()] = [
    Rgb::new(1.000, 0.782, 0.344),
    Rgb::new(0.972, 0.960, 0.915),
    Rgb::new(0.955, 0.638, 0.538),
    Rgb::new(0.913, 0.922, 0.924),
    Rgb::new(0.562, 0.565, 0.578),
    Rgb::new(0.549, 0.556, 0.554),
    Rgb::new(0.910, 0.778, 0.423),
    Rgb::new(0.542, 0.497, 0.449),
    Rgb::new(0.660, 0.609, 0.526),
    Rgb::new(0.673, 0.637, 0.585),
    Rgb::new(0.664, 0.824, 0.850),
];

/// Reflectance at normal incidence, where neither that nor a name is given: silver's, in round numbers.
const UNNAMED: Rgb = Rgb::new(0.97, 0.96, 0.92);

impl Metal {
    fn color(&self) -> Rgb {
        match self.reflectance {
            Reflectance::Color(color) => color.rgb(),
            Reflectance::Preset(index) => REFLECTANCES[index],
        }
    }

    /// The lobes of a metal, each counting `weight`.
    pub(super) fn add_lobes(bsdf: &mut Bsdf, weight: Rgb, fresnel: Fresnel, roughness: Roughness) {
        let boundary = Boundary::new(roughness, fresnel);
        bsdf.add(weight, boundary.lobe());
        if let Some(ggx) = boundary.facets() {
            bsdf.add(weight, Complement::of_metal(ggx, fresnel));
        }
    }
}

impl Metal {
    /// Of a reflectance at normal incidence; [`with`](Part::with) sets its `roughness` and `edge`, or a `preset` such as `"gold"` in place
    /// of the colour.
    ///
    /// # Errors
    /// A channel outside 0..=1.
    pub fn new(color: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("color", Value::Color(color)))
    }
}

impl Part for Metal {
    const NAME: &'static str = "metal";
    const DOC: &'static str = "Metal, polished or rough, by colour or by name.";
    const FIELDS: &'static [Field] = &[
        Field::required(
            "color",
            FieldKind::Color,
            "",
            "Share of light that is reflected at normal incidence.",
        )
        .instead_of("preset")
        .or(|| Value::Color(UNNAMED)),
        Field::required("preset", FieldKind::Choice(PRESETS), "", "Name of a metal, instead of its colour.")
            .instead_of("color"),
        Field::required("edge", FieldKind::Color, "", "Colour that reflections are multiplied by near 82°.")
            .or(|| Value::Color(Rgb::WHITE)),
        Field::required("roughness", FieldKind::Fraction, "", "How blurred reflections are; 0 is a mirror.")
            .or(|| Value::Number(0.2)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let reflectance = match (given.has("color"), given.has("preset")) {
            (true, true) => {
                return Err(InvalidPart::new("preset", "must be given alone", "beside color"));
            }
            (false, true) => Reflectance::Preset(given.choice("preset")?),
            (_, false) => Reflectance::Color(given.paint("color")?),
        };
        Ok(Self { reflectance, edge: given.paint("edge")?, roughness: given.level("roughness")? })
    }

    fn values(&self) -> Values {
        let values = match self.reflectance {
            Reflectance::Color(color) => Values::new().with("color", color.value()),
            Reflectance::Preset(index) => {
                Values::new().with("preset", Value::Word(PRESETS[index].to_owned()))
            }
        };
        values.with("edge", self.edge.value()).with("roughness", self.roughness.value())
    }
}

impl Surface for Metal {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        Lobes::none(at.distance)
    }

    fn needs_bsdf(&self) -> bool {
        true
    }

    fn bsdf(&self, at: &SurfacePoint) -> Bsdf {
        let mut bsdf = Bsdf::new(at);
        let fresnel = Fresnel::metal(self.color(), self.edge.rgb());
        Self::add_lobes(&mut bsdf, Rgb::WHITE, fresnel, Roughness::new(self.roughness.base()));
        bsdf
    }

    fn is_textured(&self) -> bool {
        let color = matches!(self.reflectance, Reflectance::Color(color) if color.is_textured());
        color || self.edge.is_textured() || self.roughness.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        let reflectance = match self.reflectance {
            Reflectance::Color(color) => Reflectance::Color(color.resolved(textures, at)),
            preset @ Reflectance::Preset(_) => preset,
        };
        Self {
            reflectance,
            edge: self.edge.resolved(textures, at),
            roughness: self.roughness.resolved(textures, at),
        }
    }
}
