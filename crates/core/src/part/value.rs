//! What the value of a field can be, and values by name.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::texture::{Image, TextureUse};
use crate::{IntensityProfile, Rgb, TextureId, TriangleMesh};

/// A triangle mesh and the file it came from.
#[derive(Debug, Clone)]
pub struct MeshSource {
    /// Path as written in the scene, relative to the scene's folder.
    pub path: String,
    /// The triangles, in the mesh's own space.
    pub mesh: Arc<TriangleMesh>,
}

impl PartialEq for MeshSource {
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path && (Arc::ptr_eq(&self.mesh, &other.mesh) || self.mesh == other.mesh)
    }
}

/// An intensity profile and the file it came from.
#[derive(Debug, Clone)]
pub struct ProfileSource {
    /// Path as written in the scene, relative to the scene's folder.
    pub path: String,
    /// How the luminaire shines by direction.
    pub profile: Arc<IntensityProfile>,
}

impl PartialEq for ProfileSource {
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path
            && (Arc::ptr_eq(&self.profile, &other.profile) || self.profile == other.profile)
    }
}

/// A picture and the file it came from.
#[derive(Debug, Clone)]
pub struct ImageSource {
    /// Path as written in the scene, relative to the scene's folder.
    pub path: String,
    /// The picture.
    pub image: Arc<Image>,
}

impl PartialEq for ImageSource {
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path && (Arc::ptr_eq(&self.image, &other.image) || self.image == other.image)
    }
}

/// A colour or a number, and the texture that multiplies it.
#[derive(Debug, Clone, PartialEq)]
pub struct Textured {
    /// What is multiplied: [`Value::Color`] or [`Value::Number`].
    pub base: Value,
    /// By what.
    pub by: TextureUse,
}

/// Rows of numbers, all of the same length.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rows {
    width: usize,
    numbers: Vec<f64>,
}

impl Rows {
    /// Of so many numbers each.
    #[must_use]
    pub fn of<const N: usize>(rows: impl IntoIterator<Item = [f64; N]>) -> Self {
        Self { width: N, numbers: rows.into_iter().flatten().collect() }
    }

    /// How many numbers a row has; 0 where there is none.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// The rows, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.numbers.chunks_exact(self.width.max(1))
    }

    /// With one more row, if that has as many numbers as the others.
    #[must_use]
    pub fn with(mut self, row: &[f64]) -> Self {
        if self.numbers.is_empty() {
            self.width = row.len();
        }
        if row.len() == self.width {
            self.numbers.extend(row);
        }
        self
    }
}

/// The value of a field.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// For [`FieldKind::Number`](super::FieldKind::Number), `Length`, `Count`, `Fraction` and `Angle`.
    Number(f64),
    /// For [`FieldKind::Point`](super::FieldKind::Point) and `Direction`.
    Vector(DVec3),
    /// For [`FieldKind::Color`](super::FieldKind::Color) and `Quantity`.
    Color(Rgb),
    /// For [`FieldKind::Flag`](super::FieldKind::Flag).
    Flag(bool),
    /// For [`FieldKind::Choice`](super::FieldKind::Choice).
    Word(String),
    /// For [`FieldKind::Mesh`](super::FieldKind::Mesh).
    Mesh(MeshSource),
    /// For [`FieldKind::Profile`](super::FieldKind::Profile).
    Profile(ProfileSource),
    /// For [`FieldKind::Pair`](super::FieldKind::Pair).
    Pair(DVec2),
    /// For [`FieldKind::Image`](super::FieldKind::Image).
    Image(ImageSource),
    /// For [`FieldKind::Texture`](super::FieldKind::Texture).
    Texture(TextureId),
    /// For [`FieldKind::Rows`](super::FieldKind::Rows).
    Rows(Rows),
    /// For [`FieldKind::Color`](super::FieldKind::Color), `Quantity` and `Fraction`, times a texture.
    Textured(Box<Textured>),
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<DVec3> for Value {
    fn from(vector: DVec3) -> Self {
        Self::Vector(vector)
    }
}

impl From<DVec2> for Value {
    fn from(pair: DVec2) -> Self {
        Self::Pair(pair)
    }
}

impl From<Rgb> for Value {
    fn from(color: Rgb) -> Self {
        Self::Color(color)
    }
}

impl From<bool> for Value {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl From<&str> for Value {
    fn from(word: &str) -> Self {
        Self::Word(word.to_owned())
    }
}

impl Value {
    /// The same value, times a texture.
    #[must_use]
    pub fn textured(self, by: TextureUse) -> Self {
        Self::Textured(Box::new(Textured { base: self.untextured(), by }))
    }

    /// The same value without a texture.
    #[must_use]
    pub fn untextured(self) -> Self {
        match self {
            Self::Textured(textured) => textured.base,
            plain => plain,
        }
    }

    /// The texture that it names, if it names one.
    #[must_use]
    pub fn texture(&self) -> Option<TextureId> {
        match self {
            Self::Texture(texture) => Some(*texture),
            Self::Textured(textured) => Some(textured.by.texture),
            _ => None,
        }
    }
}

/// Values by field name, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Values(Vec<(&'static str, Value)>);

impl Values {
    /// No values.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// With one more value, or a changed one.
    #[must_use]
    pub fn with(mut self, name: &'static str, value: Value) -> Self {
        self.set(name, value);
        self
    }

    /// Sets a value, replacing the one of that name.
    pub fn set(&mut self, name: &'static str, value: Value) {
        match self.0.iter_mut().find(|(n, _)| *n == name) {
            Some(entry) => entry.1 = value,
            None => self.0.push((name, value)),
        }
    }

    /// Without the value of that name.
    #[must_use]
    pub fn without(mut self, name: &str) -> Self {
        self.0.retain(|(n, _)| *n != name);
        self
    }

    /// The value of that name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|(n, _)| *n == name).map(|(_, v)| v)
    }

    /// The textures that they name, one for each value.
    pub fn textures(&self) -> impl Iterator<Item = TextureId> {
        self.0.iter().filter_map(|(_, value)| value.texture())
    }

    /// All of them, in order.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &Value)> {
        self.0.iter().map(|(n, v)| (*n, v))
    }
}
