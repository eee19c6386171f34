//! What holds for a scene as a whole: what is seen where there is nothing, what a picture shows, and how far it goes.

use super::Integrator;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Kind, Part, Rgb, Value, Values};

/// Settings of a scene. The default is a black background, 5 bounces, the first integrator, and occlusion at any distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    background: Rgb,
    max_depth: u32,
    integrator: Integrator,
    occlusion_distance: Option<f64>,
}

const BACKGROUND: &str = "background";
const MAX_DEPTH: &str = "max-depth";
const INTEGRATOR: &str = "integrator";
const OCCLUSION_DISTANCE: &str = "occlusion-distance";

impl Settings {
    /// How to make settings from named values.
    pub const KIND: &'static Kind<Self> =
        &Kind { name: Self::NAME, doc: Self::DOC, fields: Self::FIELDS, make: crate::part::make::<Self> };

    /// The largest depth there is: after as many bounces on mirrors that give back 99 % of the light, 1 part in
    /// 23,000 is left, less than a picture shows.
    pub const MAX_DEPTH: u32 = 1000;

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
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let depth = given.number(MAX_DEPTH)?;
        let most = f64::from(Self::MAX_DEPTH);
        if !((0.0..=most).contains(&depth) && depth.fract() == 0.0) {
            return Err(InvalidPart::new(MAX_DEPTH, format!("must be a whole number in 0..{most}"), depth));
        }
        let limited = given.has(OCCLUSION_DISTANCE);
        Ok(Self {
            background: given.quantity(BACKGROUND)?,
            // In range, so that the conversion is exact.
            max_depth: depth as u32,
            integrator: Integrator::ALL[given.choice(INTEGRATOR)?],
            occlusion_distance: limited.then(|| given.positive(OCCLUSION_DISTANCE)).transpose()?,
        })
    }

    fn values(&self) -> Values {
        let values = Values::new()
            .with(BACKGROUND, Value::Color(self.background))
            .with(MAX_DEPTH, Value::Number(f64::from(self.max_depth)))
            .with(INTEGRATOR, Value::Word(self.integrator.name().to_owned()));
        match self.occlusion_distance {
            Some(distance) => values.with(OCCLUSION_DISTANCE, Value::Number(distance)),
            None => values,
        }
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
    fn a_background_that_is_no_light_is_refused_by_name() {
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            let error = Settings::new(Rgb::grey(bad), 5).unwrap_err();
            assert_eq!(error.field(), "background", "{bad}");
        }
    }
}
