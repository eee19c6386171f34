//! The glossy surface: Phong's model with Blinn's half vector, classic and energy-normalised.
//!
//! Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977. The normalised lobe is
//! divided by its integral over the half sphere for light along the normal, 8π (2^(−n/2) + n) / ((n + 2) (n + 4)),
//! so that a white one then gives back all the light, and less from the side; the usual (n + 8) / 8π
//! (Akenine-Möller, Haines and Hoffman, *Real-Time Rendering*, 3rd ed., section 7.6) gives back up to 7.5 % more.

use std::f64::consts::PI;

use super::{REFLECTIVENESS, ShadingPoint, Surface};
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Coefficient, Field, FieldKind, InvalidPart, Lane, Part, Rgb, Triple, Value, Values};

/// Ambient, diffuse and specular parts. With θ the angle between the normal and the half vector and i that of the
/// light, one unit of irradiance shows
/// * classic: `(diffuse cos i + specular cosⁿ θ) / π`,
/// * normalised: `(diffuse / π + specular (n + 2) (n + 4) / (8π (2^(−n/2) + n)) cosⁿ θ) cos i`.
#[derive(Debug, Clone, PartialEq)]
pub struct Phong {
    ambient: Constant3,
    diffuse: Constant3,
    specular: Constant3,
    shininess: Coefficient,
    normalised: bool,
    /// What cosⁿ θ is multiplied by: 1/π or the normalisation.
    lobe: Coefficient,
    reflectiveness: Coefficient,
}

const MODELS: &[&str] = &["classic", "normalised"];

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
        Field::required("model", FieldKind::Choice(MODELS), "", "Classic, or normalised to keep energy.")
            .or(|| Value::Word(MODELS[0].to_owned())),
        REFLECTIVENESS,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let shininess = given.not_negative("shininess")?;
        let normalised = given.choice("model")? == 1;
        let lobe = if normalised { normalisation(shininess) } else { 1.0 / PI };
        Ok(Self {
            ambient: given.color("ambient")?.into(),
            diffuse: given.color("diffuse")?.into(),
            specular: given.color("specular")?.into(),
            shininess: Coefficient::new(shininess),
            normalised,
            lobe: Coefficient::new(lobe),
            reflectiveness: Coefficient::new(given.fraction("reflectiveness")?),
        })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("ambient", Value::Color(self.ambient.rgb()))
            .with("diffuse", Value::Color(self.diffuse.rgb()))
            .with("specular", Value::Color(self.specular.rgb()))
            .with("shininess", Value::Number(self.shininess.wide))
            .with("model", Value::Word(MODELS[usize::from(self.normalised)].to_owned()))
            .with("reflectiveness", Value::Number(self.reflectiveness.wide))
    }
}

/// One over what cosⁿ θ cos i gives in all, for light along the normal.
fn normalisation(n: f64) -> f64 {
    (n + 2.0) * ((n + 4.0) / (8.0 * PI * ((-n / 2.0).exp2() + n)))
}

impl Surface for Phong {
    #[inline(always)]
    fn under_ambient<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        Triple::of(at.distance, &self.ambient)
    }

    #[inline(always)]
    fn albedo<L: Lane>(&self, at: &ShadingPoint<L>) -> Triple<L> {
        Triple::of(at.distance, &self.diffuse)
    }

    fn is_glossy(&self) -> bool {
        self.specular.rgb() != Rgb::BLACK
    }

    #[inline(always)]
    fn gloss<L: Lane>(&self, at: &ShadingPoint<L>, towards: Triple<L>, cosine: L) -> Triple<L> {
        let half = towards + at.to_viewer;
        // Zero only for light from straight behind, where the cosine is not positive.
        let along = half.dot(at.normal) / half.dot(half).sqrt();
        let lobe = along.max(cosine.number(0.0)).power(self.shininess) * cosine.of(self.lobe);
        let specular = if self.normalised { lobe * cosine } else { lobe };
        Triple::of(cosine, &self.specular).scale(specular)
    }

    fn reflectiveness(&self) -> Coefficient {
        self.reflectiveness
    }
}
