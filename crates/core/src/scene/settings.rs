//! What holds for a scene as a whole: what is seen where there is nothing, what a picture shows, how far it goes, how sure
//! its pixels are, and how bright it is displayed.

use super::Integrator;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Kind, Part, Rgb, Value, Values};

/// Settings of a scene. The default is a black background, 5 bounces, the first integrator, occlusion at any distance, one
/// sample a pixel, and light displayed as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    background: Rgb,
    max_depth: u32,
    integrator: Integrator,
    occlusion_distance: Option<f64>,
    samples: u32,
    max_error: Option<f64>,
    exposure: f64,
}

const BACKGROUND: &str = "background";
const MAX_DEPTH: &str = "max-depth";
const INTEGRATOR: &str = "integrator";
const OCCLUSION_DISTANCE: &str = "occlusion-distance";
const SAMPLES: &str = "samples";
const MAX_ERROR: &str = "max-error";
const EXPOSURE: &str = "exposure";

impl Settings {
    /// How to make settings from named values.
    pub const KIND: &'static Kind<Self> =
        &Kind { name: Self::NAME, doc: Self::DOC, fields: Self::FIELDS, make: crate::part::make::<Self> };

    /// The largest depth there is: after as many bounces on mirrors that give back 99 % of the light, 1 part in
    /// 23,000 is left, less than a picture shows.
    pub const MAX_DEPTH: u32 = 1000;

    /// The most samples a pixel: an error of a 256th of what one sample has, less than a step of a picture's bytes.
    pub const MAX_SAMPLES: u32 = 65_536;

    /// The most stops of exposure either way: a factor of 2³², beyond any change from night to noon.
    pub const MAX_EXPOSURE: f64 = 32.0;

    /// Radiance seen where a ray leaves the scene, and the most reflections one after the other (0 for none); the rest as
    /// by default.
    ///
    /// # Errors
    /// A background that is negative or not finite; a depth above [`Self::MAX_DEPTH`].
    pub fn new(background: Rgb, max_depth: u32) -> Result<Self, InvalidPart> {
        Self::default().with_background(background)?.with_max_depth(max_depth)
    }

    /// The same with another background.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn with_background(self, background: Rgb) -> Result<Self, InvalidPart> {
        self.with(BACKGROUND, Value::Color(background))
    }

    /// The same with another depth.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn with_max_depth(self, max_depth: u32) -> Result<Self, InvalidPart> {
        self.with(MAX_DEPTH, Value::Number(f64::from(max_depth)))
    }

    /// The same with another integrator.
    #[must_use]
    pub fn with_integrator(self, integrator: Integrator) -> Self {
        Self { integrator, ..self }
    }

    /// The same with another distance up to which surfaces occlude the sky, metres; `None` for any distance.
    ///
    /// # Errors
    /// A distance that is not greater than 0, or not finite.
    pub fn with_occlusion_distance(self, distance: Option<f64>) -> Result<Self, InvalidPart> {
        match distance {
            Some(distance) => self.with(OCCLUSION_DISTANCE, Value::Number(distance)),
            None => Ok(Self { occlusion_distance: None, ..self }),
        }
    }

    /// Radiance seen where a ray leaves the scene.
    #[must_use]
    pub fn background(&self) -> Rgb {
        self.background
    }

    /// The most reflections one after the other; 0 for none.
    #[must_use]
    pub fn max_depth(&self) -> u32 {
        self.max_depth
    }

    /// What a picture shows.
    #[must_use]
    pub fn integrator(&self) -> Integrator {
        self.integrator
    }

    /// Up to where a surface that is met occludes the sky, metres; `None` for any distance.
    #[must_use]
    pub fn occlusion_distance(&self) -> Option<f64> {
        self.occlusion_distance
    }

    /// Samples a pixel, at least 1.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// The standard error that samples are to bring each pixel's displayed value under; `None` for as many samples as are
    /// asked for.
    #[must_use]
    pub fn max_error(&self) -> Option<f64> {
        self.max_error
    }

    /// By how many stops light is brightened for display, each a factor of 2.
    #[must_use]
    pub fn exposure(&self) -> f64 {
        self.exposure
    }

    /// The values by field name.
    #[must_use]
    pub fn values(&self) -> Values {
        Part::values(self)
    }

    /// The same with one value changed.
    ///
    /// # Errors
    /// A field that settings have not, or a value that is refused.
    pub fn with(&self, field: &'static str, value: Value) -> Result<Self, InvalidPart> {
        if Self::KIND.field(field).is_none() {
            return Err(InvalidPart::new(field, "must be a field of settings", "unknown"));
        }
        crate::part::make(&self.values().with(field, value))
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            background: Rgb::BLACK,
            max_depth: 5,
            integrator: Integrator::default(),
            occlusion_distance: None,
            samples: 1,
            max_error: None,
            exposure: 0.0,
        }
    }
}

impl Part for Settings {
    const NAME: &'static str = "settings";
    const DOC: &'static str = "What holds for the scene as a whole.";
    const FIELDS: &'static [Field] = &[
        Field::required(
            BACKGROUND,
            FieldKind::Quantity,
            "W/(m²·sr)",
            "Radiance seen where a ray leaves the scene.",
        )
        .or(|| Value::Color(Rgb::BLACK)),
        Field::required(MAX_DEPTH, FieldKind::Count, "", "The most reflections one after the other.")
            .or(|| Value::Number(5.0)),
        Field::required(INTEGRATOR, FieldKind::Choice(Integrator::NAMES), "", "What a picture shows.")
            .or(|| Value::Word(Integrator::default().name().to_owned())),
        Field::required(
            OCCLUSION_DISTANCE,
            FieldKind::Length,
            "m",
            "Up to where what is met hides the sky from a surface, for the integrator of occlusion; any distance if left out.",
        )
        .optional(),
        Field::required(SAMPLES, FieldKind::Count, "", "Samples a pixel of a picture that is written.")
            .or(|| Value::Number(1.0)),
        Field::required(
            MAX_ERROR,
            FieldKind::Number,
            "",
            "The standard error that samples are to bring each pixel's displayed value under.",
        )
        .optional(),
        Field::required(EXPOSURE, FieldKind::Number, "stops", "By how many factors of 2 light is brightened for display.")
            .or(|| Value::Number(0.0)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let limited = given.has(OCCLUSION_DISTANCE);
        let exposure = given.number(EXPOSURE)?;
        if exposure.abs() > Self::MAX_EXPOSURE {
            let most = Self::MAX_EXPOSURE;
            return Err(InvalidPart::new(EXPOSURE, format!("must lie in -{most}..{most} stops"), exposure));
        }
        Ok(Self {
            background: given.quantity(BACKGROUND)?,
            max_depth: given.whole(MAX_DEPTH, 0, Self::MAX_DEPTH)?,
            integrator: Integrator::ALL[given.choice(INTEGRATOR)?],
            occlusion_distance: limited.then(|| given.positive(OCCLUSION_DISTANCE)).transpose()?,
            samples: given.whole(SAMPLES, 1, Self::MAX_SAMPLES)?,
            max_error: given.has(MAX_ERROR).then(|| given.positive(MAX_ERROR)).transpose()?,
            exposure,
        })
    }

    fn values(&self) -> Values {
        let values = Values::new()
            .with(BACKGROUND, Value::Color(self.background))
            .with(MAX_DEPTH, Value::Number(f64::from(self.max_depth)))
            .with(INTEGRATOR, Value::Word(self.integrator.name().to_owned()))
            .with(SAMPLES, Value::Number(f64::from(self.samples)))
            .with(EXPOSURE, Value::Number(self.exposure));
        let optional = [(OCCLUSION_DISTANCE, self.occlusion_distance), (MAX_ERROR, self.max_error)];
        let given = optional.into_iter().filter_map(|(name, value)| value.map(|value| (name, value)));
        given.fold(values, |values, (name, value)| values.with(name, Value::Number(value)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn left_out_values_are_the_default() {
        assert_eq!((Settings::KIND.make)(&Values::new()).unwrap(), Settings::default());
    }

    #[test]
    fn values_make_equal_settings() {
        let settings = Settings::new(Rgb::new(0.1, 2.0, 0.0), 0).unwrap();
        assert_eq!((Settings::KIND.make)(&settings.values()).unwrap(), settings);
        let settings = settings.with_integrator(Integrator::Occlusion);
        let limited = settings.with_occlusion_distance(Some(0.25)).unwrap();
        for settings in [settings, limited] {
            assert_eq!((Settings::KIND.make)(&settings.values()).unwrap(), settings);
        }
    }

    #[test]
    fn changing_one_value_keeps_the_others() {
        let settings = Settings::default().with_integrator(Integrator::Occlusion).with_max_depth(7).unwrap();
        let settings =
            settings.with_occlusion_distance(Some(2.0)).unwrap().with_background(Rgb::WHITE).unwrap();
        assert_eq!((settings.max_depth(), settings.integrator()), (7, Integrator::Occlusion));
        assert_eq!((settings.background(), settings.occlusion_distance()), (Rgb::WHITE, Some(2.0)));
        let unlimited = settings.with_occlusion_distance(None).unwrap();
        assert_eq!((unlimited.occlusion_distance(), unlimited.max_depth()), (None, 7));
    }

    #[test]
    fn an_occlusion_distance_that_is_no_length_is_refused_by_name() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = Settings::default().with_occlusion_distance(Some(bad)).unwrap_err();
            assert_eq!(error.field(), "occlusion-distance", "{bad}");
        }
    }

    #[test]
    fn a_depth_that_is_no_count_is_refused_by_name() {
        for bad in [-1.0, 0.5, 1001.0, f64::NAN, f64::INFINITY] {
            let error = Settings::default().with("max-depth", Value::Number(bad)).unwrap_err();
            assert_eq!(error.field(), "max-depth", "{bad}");
        }
    }

    #[test]
    fn samples_targets_and_exposures_are_refused_by_name_and_kept() {
        let with = |field, value| Settings::default().with(field, Value::Number(value));
        for (field, bad) in [
            ("samples", 0.0),
            ("samples", 1.5),
            ("samples", 65_537.0),
            ("max-error", 0.0),
            ("max-error", -0.1),
            ("max-error", f64::NAN),
            ("exposure", f64::INFINITY),
            ("exposure", 33.0),
        ] {
            assert_eq!(with(field, bad).unwrap_err().field(), field, "{bad}");
        }
        let settings = with("samples", 65_536.0).unwrap().with("max-error", Value::Number(0.01)).unwrap();
        let settings = settings.with("exposure", Value::Number(-1.5)).unwrap();
        assert_eq!(
            (settings.samples(), settings.max_error(), settings.exposure()),
            (65_536, Some(0.01), -1.5)
        );
        assert_eq!((Settings::KIND.make)(&settings.values()).unwrap(), settings);
    }

    #[test]
    fn a_background_that_is_no_light_is_refused_by_name() {
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            let error = Settings::new(Rgb::grey(bad), 5).unwrap_err();
            assert_eq!(error.field(), "background", "{bad}");
        }
    }
}
