//! What holds for a scene as a whole: what is seen where there is nothing, and how often light may bounce.

use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Kind, Part, Rgb, Value, Values};

/// Settings of a scene. The default is a black background and 5 bounces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    background: Rgb,
    max_depth: u32,
}

impl Settings {
    /// How to make settings from named values.
    pub const KIND: &'static Kind<Self> =
        &Kind { name: Self::NAME, doc: Self::DOC, fields: Self::FIELDS, make: crate::part::make::<Self> };

    /// The largest depth there is: after as many bounces on mirrors that give back 99 % of the light, 1 part in
    /// 23,000 is left, less than a picture shows.
    pub const MAX_DEPTH: u32 = 1000;

    /// Radiance seen where a ray leaves the scene, and the most reflections one after the other (0 for none).
    ///
    /// # Errors
    /// A background that is negative or not finite; a depth above [`Self::MAX_DEPTH`].
    pub fn new(background: Rgb, max_depth: u32) -> Result<Self, InvalidPart> {
        let values = Values::new()
            .with("background", Value::Color(background))
            .with("max-depth", Value::Number(f64::from(max_depth)));
        crate::part::make(&values)
    }

    /// The same with another background.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn with_background(self, background: Rgb) -> Result<Self, InvalidPart> {
        Self::new(background, self.max_depth)
    }

    /// The same with another depth.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn with_max_depth(self, max_depth: u32) -> Result<Self, InvalidPart> {
        Self::new(self.background, max_depth)
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
        Self { background: Rgb::BLACK, max_depth: 5 }
    }
}

impl Part for Settings {
    const NAME: &'static str = "settings";
    const DOC: &'static str = "What holds for the scene as a whole.";
    const FIELDS: &'static [Field] = &[
        Field::required(
            "background",
            FieldKind::Quantity,
            "W/(m² sr)",
            "Radiance seen where a ray leaves the scene.",
        )
        .or(|| Value::Color(Rgb::BLACK)),
        Field::required("max-depth", FieldKind::Count, "", "The most reflections one after the other.")
            .or(|| Value::Number(5.0)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let depth = given.number("max-depth")?;
        let most = f64::from(Self::MAX_DEPTH);
        if !((0.0..=most).contains(&depth) && depth.fract() == 0.0) {
            return Err(InvalidPart::new("max-depth", format!("must be a whole number in 0..{most}"), depth));
        }
        // In range, so that the conversion is exact.
        Ok(Self { background: given.quantity("background")?, max_depth: depth as u32 })
    }

    fn values(&self) -> Values {
        Values::new()
            .with("background", Value::Color(self.background))
            .with("max-depth", Value::Number(f64::from(self.max_depth)))
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
