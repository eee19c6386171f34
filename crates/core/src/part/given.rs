//! Checked access of a part's constructor to its values, each of the kind and range that its field states.

use glam::{DVec2, DVec3};

use super::{Field, FieldKind, ImageSource, MeshSource, ProfileSource, Rows, Textured, Value, Values};
use crate::texture::{Level, Paint, TextureUse};
use crate::{InvalidPart, Rgb, TextureId};

/// The largest magnitude of a number in a part, about 3.4e38: SIMD code keeps numbers in `f32` too, where a larger
/// one would be infinite.
pub const LARGEST: f64 = f32::MAX as f64;

const WITHIN_LARGEST: &str = "must be at most 3.4e38 in magnitude";

/// Values as a part's constructor reads them: by name, of the kind its field states, with defaults filled in.
#[derive(Debug, Clone, Copy)]
pub struct Given<'a> {
    pub(super) fields: &'static [Field],
    pub(super) values: &'a Values,
}

impl Given<'_> {
    fn value(&self, name: &'static str) -> Result<Value, InvalidPart> {
        match self.value_and_texture(name)? {
            (value, None) => Ok(value),
            (_, Some(_)) => Err(InvalidPart::new(name, "must be a plain value", "one with a texture")),
        }
    }

    /// A value, and the texture that multiplies it.
    fn value_and_texture(&self, name: &'static str) -> Result<(Value, Option<TextureUse>), InvalidPart> {
        let default =
            || self.fields.iter().find(|f| f.name == name).and_then(|f| f.default).map(|make| make());
        match self.values.get(name).cloned().or_else(default) {
            Some(Value::Textured(textured)) => {
                let Textured { base, by } = *textured;
                Ok((base, Some(by)))
            }
            Some(value) => Ok((value, None)),
            None => Err(InvalidPart::new(name, "must be given", "missing")),
        }
    }

    /// Refuses a number; the message gives angles in degrees, as they are written.
    fn refuse(&self, name: &'static str, requirement: &str, found: f64) -> InvalidPart {
        match self.fields.iter().find(|field| field.name == name).map(|field| field.kind) {
            Some(FieldKind::Angle) => InvalidPart::new(name, requirement, degrees(found)),
            _ => InvalidPart::new(name, requirement, short(found)),
        }
    }

    /// Whether a value was given.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.values.get(name).is_some()
    }

    /// A number of any kind.
    ///
    /// # Errors
    /// Missing, not a number, not finite, or beyond [`LARGEST`].
    pub fn number(&self, name: &'static str) -> Result<f64, InvalidPart> {
        match self.value(name)? {
            Value::Number(v) if v.abs() <= LARGEST => Ok(v),
            Value::Number(v) if v.is_finite() => Err(self.refuse(name, WITHIN_LARGEST, v)),
            other => Err(wrong(name, "must be a finite number", &other)),
        }
    }

    /// A number greater than 0.
    ///
    /// # Errors
    /// Missing, not a number, not finite, or not greater than 0.
    pub fn positive(&self, name: &'static str) -> Result<f64, InvalidPart> {
        let v = self.number(name)?;
        if v > 0.0 { Ok(v) } else { Err(self.refuse(name, "must be greater than 0", v)) }
    }

    /// A number of at least 0.
    ///
    /// # Errors
    /// Missing, not a number, not finite, or negative.
    pub fn not_negative(&self, name: &'static str) -> Result<f64, InvalidPart> {
        let v = self.number(name)?;
        if v >= 0.0 { Ok(v) } else { Err(self.refuse(name, "must be at least 0", v)) }
    }

    /// A number in 0..=1.
    ///
    /// # Errors
    /// Missing, not a number, or outside.
    pub fn fraction(&self, name: &'static str) -> Result<f64, InvalidPart> {
        fraction(name, self.number(name)?)
    }

    /// A number in 0..=1, which a texture may multiply.
    ///
    /// # Errors
    /// Missing, not a number, or outside.
    pub fn level(&self, name: &'static str) -> Result<Level, InvalidPart> {
        match self.value_and_texture(name)? {
            (Value::Number(v), texture) => Ok(Level::new(fraction(name, v)?, texture)),
            (other, _) => Err(wrong(name, "must be a finite number", &other)),
        }
    }

    /// Two numbers.
    ///
    /// # Errors
    /// Missing, not two numbers, not finite, or beyond [`LARGEST`].
    pub fn pair(&self, name: &'static str) -> Result<DVec2, InvalidPart> {
        match self.value(name)? {
            Value::Pair(v) if v.abs().max_element() <= LARGEST && v.is_finite() => Ok(v),
            other @ Value::Pair(v) if v.is_finite() => Err(wrong(name, WITHIN_LARGEST, &other)),
            other => Err(wrong(name, "must be two finite numbers", &other)),
        }
    }

    /// Two numbers greater than 0.
    ///
    /// # Errors
    /// Missing, not two numbers, not finite, or one not greater than 0.
    pub fn positive_pair(&self, name: &'static str) -> Result<DVec2, InvalidPart> {
        let v = self.pair(name)?;
        let is_positive = v.x > 0.0 && v.y > 0.0;
        if is_positive { Ok(v) } else { Err(wrong(name, "must be greater than 0", &Value::Pair(v))) }
    }

    /// A whole number within a range.
    ///
    /// # Errors
    /// Missing, not a number, not whole, or outside.
    pub fn count(&self, name: &'static str, [least, most]: [u32; 2]) -> Result<u32, InvalidPart> {
        let v = self.number(name)?;
        if v.fract() == 0.0 && (f64::from(least)..=f64::from(most)).contains(&v) {
            return Ok(v as u32);
        }
        Err(self.refuse(name, &format!("must be a whole number in {least}..{most}"), v))
    }

    /// A whole number of a range.
    ///
    /// # Errors
    /// Missing, not a number, not whole, or outside.
    pub fn whole(&self, name: &'static str, least: u32, most: u32) -> Result<u32, InvalidPart> {
        let number = self.number(name)?;
        if !((f64::from(least)..=f64::from(most)).contains(&number) && number.fract() == 0.0) {
            return Err(InvalidPart::new(name, format!("must be a whole number in {least}..{most}"), number));
        }
        // In range, so that the conversion is exact.
        Ok(number as u32)
    }

    /// Rows of numbers, as many in each as the field states.
    ///
    /// # Errors
    /// Missing, no rows of so many numbers, not finite, or beyond [`LARGEST`].
    pub fn rows(&self, name: &'static str) -> Result<Rows, InvalidPart> {
        let width = self.fields.iter().find_map(|field| match field.kind {
            FieldKind::Rows(width) if field.name == name => Some(width),
            _ => None,
        });
        let width = width.unwrap_or(0);
        match self.value(name)? {
            Value::Rows(rows) if rows.width() == width => {
                let wrong = |row: &[f64]| {
                    let is_finite = row.iter().all(|v| v.is_finite());
                    let requirement = if is_finite { WITHIN_LARGEST } else { "must be finite numbers" };
                    InvalidPart::new(name, requirement, numbers(row))
                };
                let refused = rows.iter().find(|row| !row.iter().all(|v| v.abs() <= LARGEST)).map(wrong);
                refused.map_or(Ok(rows), Err)
            }
            other => Err(wrong(name, &format!("must be rows of {width} finite numbers"), &other)),
        }
    }

    /// A point.
    ///
    /// # Errors
    /// Missing, not three numbers, not finite, or beyond [`LARGEST`].
    pub fn point(&self, name: &'static str) -> Result<DVec3, InvalidPart> {
        match self.value(name)? {
            Value::Vector(v) if v.abs().max_element() <= LARGEST && v.is_finite() => Ok(v),
            other @ Value::Vector(v) if v.is_finite() => Err(wrong(name, WITHIN_LARGEST, &other)),
            other => Err(wrong(name, "must be three finite numbers", &other)),
        }
    }

    /// A direction; its length is kept.
    ///
    /// # Errors
    /// Missing, not three numbers, not finite, beyond [`LARGEST`], or too short to have a direction.
    pub fn direction(&self, name: &'static str) -> Result<DVec3, InvalidPart> {
        let v = self.point(name)?;
        if v.try_normalize().is_some() { Ok(v) } else { Err(InvalidPart::new(name, "must not be zero", v)) }
    }

    /// A reflectance.
    ///
    /// # Errors
    /// Missing, not a colour, or a channel outside 0..=1.
    pub fn color(&self, name: &'static str) -> Result<Rgb, InvalidPart> {
        color(name, &self.value(name)?)
    }

    /// A reflectance, which a texture may multiply.
    ///
    /// # Errors
    /// Missing, not a colour, a channel outside 0..=1, or a texture of which a single channel is named.
    pub fn paint(&self, name: &'static str) -> Result<Paint, InvalidPart> {
        let (value, texture) = self.value_and_texture(name)?;
        Ok(Paint::new(color(name, &value)?, colored(name, texture)?))
    }

    /// An amount of light, which a texture may multiply.
    ///
    /// # Errors
    /// As for [`quantity`](Self::quantity), or a texture of which a single channel is named.
    pub fn light(&self, name: &'static str) -> Result<Paint, InvalidPart> {
        let (value, texture) = self.value_and_texture(name)?;
        Ok(Paint::new(quantity(name, &value)?, colored(name, texture)?))
    }

    /// An amount of light.
    ///
    /// # Errors
    /// Missing, not a colour, or a channel negative, not finite, or beyond [`LARGEST`].
    pub fn quantity(&self, name: &'static str) -> Result<Rgb, InvalidPart> {
        quantity(name, &self.value(name)?)
    }

    /// Yes or no.
    ///
    /// # Errors
    /// Missing or not a flag.
    pub fn flag(&self, name: &'static str) -> Result<bool, InvalidPart> {
        match self.value(name)? {
            Value::Flag(v) => Ok(v),
            other => Err(wrong(name, "must be #true or #false", &other)),
        }
    }

    /// The index of a word in the field's list of choices.
    ///
    /// # Errors
    /// Missing or none of the words.
    pub fn choice(&self, name: &'static str) -> Result<usize, InvalidPart> {
        let words: &[&str] = self
            .fields
            .iter()
            .find_map(|f| match f.kind {
                FieldKind::Choice(words) if f.name == name => Some(words),
                _ => None,
            })
            .unwrap_or(&[]);
        let value = self.value(name)?;
        let found = match &value {
            Value::Word(word) => words.iter().position(|w| w == word),
            _ => None,
        };
        found.ok_or_else(|| wrong(name, &format!("must be one of {}", words.join(", ")), &value))
    }

    /// A mesh.
    ///
    /// # Errors
    /// Missing or not a mesh.
    pub fn mesh(&self, name: &'static str) -> Result<MeshSource, InvalidPart> {
        match self.value(name)? {
            Value::Mesh(mesh) => Ok(mesh),
            other => Err(wrong(name, "must be a mesh file", &other)),
        }
    }

    /// An intensity profile.
    ///
    /// # Errors
    /// Missing or not a profile.
    pub fn profile(&self, name: &'static str) -> Result<ProfileSource, InvalidPart> {
        match self.value(name)? {
            Value::Profile(profile) => Ok(profile),
            other => Err(wrong(name, "must be an IES file", &other)),
        }
    }

    /// A picture.
    ///
    /// # Errors
    /// Missing or not a picture.
    pub fn image(&self, name: &'static str) -> Result<ImageSource, InvalidPart> {
        match self.value(name)? {
            Value::Image(image) => Ok(image),
            other => Err(wrong(name, "must be a picture file", &other)),
        }
    }

    /// One of the scene's textures; whether it has that one, the scene checks.
    ///
    /// # Errors
    /// Missing or not a texture.
    pub fn texture(&self, name: &'static str) -> Result<TextureId, InvalidPart> {
        match self.value(name)? {
            Value::Texture(texture) => Ok(texture),
            other => Err(wrong(name, "must be a texture", &other)),
        }
    }
}

fn fraction(name: &'static str, v: f64) -> Result<f64, InvalidPart> {
    if (0.0..=1.0).contains(&v) { Ok(v) } else { Err(InvalidPart::new(name, "must lie in 0..1", v)) }
}

fn color(name: &'static str, value: &Value) -> Result<Rgb, InvalidPart> {
    match value {
        Value::Color(c) if c.all(|v| (0.0..=1.0).contains(&v)) => Ok(*c),
        other => Err(wrong(name, "must be a colour with channels in 0..1", other)),
    }
}

fn quantity(name: &'static str, value: &Value) -> Result<Rgb, InvalidPart> {
    match value {
        Value::Color(c) if c.all(|v| (0.0..=LARGEST).contains(&v)) => Ok(*c),
        Value::Color(c) if c.all(|v| v >= 0.0 && v.is_finite()) => Err(wrong(name, WITHIN_LARGEST, value)),
        other => Err(wrong(name, "must be light with finite channels of at least 0", other)),
    }
}

/// Refuses a single channel, of which no colour is made.
fn colored(name: &'static str, texture: Option<TextureUse>) -> Result<Option<TextureUse>, InvalidPart> {
    match texture.and_then(|by| by.channel) {
        Some(channel) => {
            let found = format!("by its channel \"{}\" alone", channel.word());
            let refused = InvalidPart::new(name, "must be multiplied by all of the texture's colour", found);
            Err(refused.with_hint("leave channel away: a channel is for fractions"))
        }
        None => Ok(texture),
    }
}

/// An angle in degrees, rounded to the ten digits that come back from radians as they were written.
pub(crate) fn degrees(radians: f64) -> String {
    let degrees = radians.to_degrees();
    let rounded: f64 = format!("{degrees:.9e}").parse().unwrap_or(degrees);
    format!("{}°", short(rounded))
}

/// A number without a row of zeros where it is huge or tiny.
fn short(v: f64) -> String {
    if v != 0.0 && !(1e-9..1e16).contains(&v.abs()) { format!("{v:e}") } else { v.to_string() }
}

/// Numbers side by side.
fn numbers(row: &[f64]) -> String {
    row.iter().map(|v| short(*v)).collect::<Vec<_>>().join(" ")
}

fn wrong(name: &'static str, requirement: &str, found: &Value) -> InvalidPart {
    let found = match found {
        Value::Number(v) => short(*v),
        Value::Vector(v) => numbers(&v.to_array()),
        Value::Color(c) => c.to_array().map(short).join(" "),
        Value::Flag(v) => format!("#{v}"),
        Value::Word(w) => format!("\"{w}\""),
        Value::Mesh(m) => format!("the mesh {}", m.path),
        Value::Profile(p) => format!("the profile {}", p.path),
        Value::Pair(v) => numbers(&v.to_array()),
        Value::Image(i) => format!("the picture {}", i.path),
        Value::Texture(texture) => texture.to_string(),
        Value::Rows(rows) => format!("{} rows of {}", rows.iter().len(), rows.width()),
        Value::Textured(_) => "a value with a texture".to_owned(),
    };
    InvalidPart::new(name, requirement, found)
}
