//! The glossy surface: ambient, diffuse and specular parts.

use super::{MirrorShare, Surface};
use crate::lobe::{self, PhongModel, PhongShape};
use crate::part::Given;
use crate::texture::{Paint, TexturePoint, TextureSource};
use crate::{Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, Triple, Value, Values};

/// A diffuse lobe under a [highlight](lobe::Phong), and an ambient response of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Phong {
    ambient: Paint,
    diffuse: Paint,
    specular: Paint,
    shape: PhongShape,
    mirror: MirrorShare,
}

const MODELS: [PhongModel; 2] = [PhongModel::Classic, PhongModel::Normalised];

/// The words for them.
const MODEL_WORDS: &[&str] = &["classic", "normalised"];

impl Phong {
    /// Of a diffuse albedo, with a white highlight; [`with`](Part::with) sets its `specular`, `shininess`, `ambient`,
    /// `model` and `reflectiveness`.
    ///
    /// # Errors
    /// A channel outside 0..=1.
    pub fn new(diffuse: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&Values::new().with("diffuse", Value::Color(diffuse)))
    }
}

impl Part for Phong {
    const NAME: &'static str = "phong";
    const DOC: &'static str = "A glossy surface with ambient, diffuse and specular parts.";
    const FIELDS: &'static [Field] = &[
        Field::required("ambient", FieldKind::Color, "", "Share of ambient light that is shown.")
            .or(|| Value::Color(Rgb::WHITE)),
        Field::required("diffuse", FieldKind::Color, "", "Share of light that is scattered."),
        Field::required("specular", FieldKind::Color, "", "Strength of the highlight.")
            .or(|| Value::Color(Rgb::WHITE)),
        Field::required("shininess", FieldKind::Number, "", "Exponent of the highlight, at least 0.")
            .or(|| Value::Number(16.0)),
        Field::required(
            "model",
            FieldKind::Choice(MODEL_WORDS),
            "",
            "Classic, or normalised to keep energy.",
        )
        .or(|| Value::Word(MODEL_WORDS[0].to_owned())),
        MirrorShare::FIELD,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let (shininess, model) = (given.not_negative("shininess")?, MODELS[given.choice("model")?]);
        Ok(Self {
            ambient: given.paint("ambient")?,
            diffuse: given.paint("diffuse")?,
            specular: given.paint("specular")?,
            shape: PhongShape::new(shininess, model),
            mirror: MirrorShare::given(given, Rgb::WHITE.into())?,
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("ambient", self.ambient.value())
            .with("diffuse", self.diffuse.value())
            .with("specular", self.specular.value())
            .with("shininess", Value::Number(self.shape.exponent()))
            .with("model", Value::Word(MODEL_WORDS[self.shape.model() as usize].to_owned()))
            .with("reflectiveness", self.mirror.value())
    }
}

impl Surface for Phong {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        let like = at.distance;
        let highlight = lobe::Phong { specular: Triple::of(like, self.specular.base()), shape: self.shape };
        self.mirror.over(Lobes {
            ambient: Triple::of(like, self.ambient.base()),
            phong: if self.specular.rgb() == Rgb::BLACK { None } else { Some(highlight) },
            ..Lobes::matte(Triple::of(like, self.diffuse.base()))
        })
    }

    fn is_textured(&self) -> bool {
        self.ambient.is_textured()
            || self.diffuse.is_textured()
            || self.specular.is_textured()
            || self.mirror.is_textured()
    }

    fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        Self {
            ambient: self.ambient.resolved(textures, at),
            diffuse: self.diffuse.resolved(textures, at),
            specular: self.specular.resolved(textures, at),
            mirror: self.mirror.resolved(textures, at),
            shape: self.shape,
        }
    }
}
