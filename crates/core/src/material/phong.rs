//! The glossy surface: ambient, diffuse and specular parts.

use super::{MirrorShare, Surface};
use crate::lane::Constant3;
use crate::lobe::{self, PhongModel, PhongShape};
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Lane, Lobes, Part, Rgb, ShadingPoint, Triple, Value, Values};

/// A diffuse lobe under a [highlight](lobe::Phong), and an ambient response of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Phong {
    ambient: Constant3,
    diffuse: Constant3,
    specular: Constant3,
    shape: PhongShape,
    mirror: MirrorShare,
}

const MODELS: [PhongModel; 2] = [PhongModel::Classic, PhongModel::Normalised];

/// The words for them.
const MODEL_WORDS: &[&str] = &["classic", "normalised"];

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
            ambient: given.color("ambient")?.into(),
            diffuse: given.color("diffuse")?.into(),
            specular: given.color("specular")?.into(),
            shape: PhongShape::new(shininess, model),
            mirror: MirrorShare::given(given, Rgb::WHITE)?,
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("ambient", Value::Color(self.ambient.rgb()))
            .with("diffuse", Value::Color(self.diffuse.rgb()))
            .with("specular", Value::Color(self.specular.rgb()))
            .with("shininess", Value::Number(self.shape.exponent()))
            .with("model", Value::Word(MODEL_WORDS[self.shape.model() as usize].to_owned()))
            .with("reflectiveness", self.mirror.value())
    }
}

impl Surface for Phong {
    #[inline(always)]
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        let like = at.distance;
        let highlight = lobe::Phong { specular: Triple::of(like, &self.specular), shape: self.shape };
        self.mirror.over(Lobes {
            ambient: Triple::of(like, &self.ambient),
            phong: if self.specular.rgb() == Rgb::BLACK { None } else { Some(highlight) },
            ..Lobes::matte(Triple::of(like, &self.diffuse))
        })
    }
}
