//! How a part describes itself: its kind, its fields, and its values by name, so that scene text, panels, docs
//! and tests follow from the part's own file.

use std::sync::Arc;

use glam::DVec3;

use crate::{InvalidPart, Rgb, TriangleMesh};

/// What sort of value a field takes, and the range it lies in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldKind {
    /// Any finite number, in magnitude at most [`LARGEST`]; the same goes for every number of a part.
    Number,
    /// A number of metres greater than 0.
    Length,
    /// A whole number of at least 0.
    Count,
    /// A number in 0..=1.
    Fraction,
    /// An angle: radians in the API, degrees in text.
    Angle,
    /// A point, metres.
    Point,
    /// A direction of any length but zero.
    Direction,
    /// A reflectance: each channel in 0..=1.
    Color,
    /// An amount of light: each channel at least 0.
    Quantity,
    /// Yes or no.
    Flag,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A triangle mesh read from a file.
    Mesh,
}

/// The largest magnitude of a number in a part, about 3.4e38: SIMD code keeps numbers in `f32` too, where a larger
/// one would be infinite.
pub const LARGEST: f64 = f32::MAX as f64;

const WITHIN_LARGEST: &str = "must be at most 3.4e38 in magnitude";

/// One named parameter of a part.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// Its name in scene text.
    pub name: &'static str,
    /// What it takes.
    pub kind: FieldKind,
    /// What it is when left out; `None` where nothing stands for it.
    pub default: Option<fn() -> Value>,
    /// Whether it may be left out.
    pub may_be_missing: bool,
    /// Its unit, empty for pure numbers.
    pub unit: &'static str,
    /// One sentence for docs and panels.
    pub doc: &'static str,
}

impl Field {
    /// A field that must be given.
    #[must_use]
    pub const fn required(
        name: &'static str,
        kind: FieldKind,
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self { name, kind, default: None, may_be_missing: false, unit, doc }
    }

    /// The same field, left out without anything standing for it.
    #[must_use]
    pub const fn optional(self) -> Self {
        Self { may_be_missing: true, ..self }
    }

    /// The same field, with a value that stands when it is left out.
    #[must_use]
    pub const fn or(self, default: fn() -> Value) -> Self {
        Self { default: Some(default), may_be_missing: true, ..self }
    }
}

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

/// The value of a field.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// For [`FieldKind::Number`], `Length`, `Count`, `Fraction` and `Angle`.
    Number(f64),
    /// For [`FieldKind::Point`] and `Direction`.
    Vector(DVec3),
    /// For [`FieldKind::Color`] and `Quantity`.
    Color(Rgb),
    /// For [`FieldKind::Flag`].
    Flag(bool),
    /// For [`FieldKind::Choice`].
    Word(String),
    /// For [`FieldKind::Mesh`].
    Mesh(MeshSource),
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

    /// The value of that name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|(n, _)| *n == name).map(|(_, v)| v)
    }

    /// All of them, in order.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &Value)> {
        self.0.iter().map(|(n, v)| (*n, v))
    }
}

/// One kind of part: its name, what it is, its fields, and how to make one.
#[derive(Debug, Clone, Copy)]
pub struct Kind<T: 'static> {
    /// Its word in scene text.
    pub name: &'static str,
    /// One sentence.
    pub doc: &'static str,
    /// Its fields, in the order they are written.
    pub fields: &'static [Field],
    /// Makes one; optional fields that are left out take their default.
    pub make: fn(&Values) -> Result<T, InvalidPart>,
}

impl<T> Kind<T> {
    /// The field of that name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<&'static Field> {
        self.fields.iter().find(|f| f.name == name)
    }
}

/// A part of a scene that describes itself.
pub trait Part: Sized {
    /// Its word in scene text.
    const NAME: &'static str;
    /// One sentence.
    const DOC: &'static str;
    /// Its fields, in the order they are written.
    const FIELDS: &'static [Field];

    /// Makes one from checked-for-kind, named values.
    ///
    /// # Errors
    /// A value that is missing or refused.
    fn make(given: &Given<'_>) -> Result<Self, InvalidPart>;

    /// Its values by name: what [`make`](Self::make) makes an equal part from.
    fn values(&self) -> Values;
}

/// Makes a part from values: what stands behind [`Kind::make`].
///
/// # Errors
/// A value that is missing, of the wrong sort, or refused.
pub fn make<P: Part>(values: &Values) -> Result<P, InvalidPart> {
    P::make(&Given { fields: P::FIELDS, values })
}

/// Values as a part's constructor asks for them: by name, of the kind its field states, with defaults filled in.
#[derive(Debug, Clone, Copy)]
pub struct Given<'a> {
    fields: &'static [Field],
    values: &'a Values,
}

impl Given<'_> {
    fn value(&self, name: &'static str) -> Result<Value, InvalidPart> {
        let default =
            || self.fields.iter().find(|f| f.name == name).and_then(|f| f.default).map(|make| make());
        let value = self.values.get(name).cloned().or_else(default);
        value.ok_or_else(|| InvalidPart::new(name, "must be given", "missing"))
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
            Value::Number(v) if v.is_finite() => Err(InvalidPart::new(name, WITHIN_LARGEST, v)),
            other => Err(wrong(name, "must be a finite number", &other)),
        }
    }

    /// A number greater than 0.
    ///
    /// # Errors
    /// Missing, not a number, not finite, or not greater than 0.
    pub fn positive(&self, name: &'static str) -> Result<f64, InvalidPart> {
        let v = self.number(name)?;
        if v > 0.0 { Ok(v) } else { Err(InvalidPart::new(name, "must be greater than 0", v)) }
    }

    /// A number of at least 0.
    ///
    /// # Errors
    /// Missing, not a number, not finite, or negative.
    pub fn not_negative(&self, name: &'static str) -> Result<f64, InvalidPart> {
        let v = self.number(name)?;
        if v >= 0.0 { Ok(v) } else { Err(InvalidPart::new(name, "must be at least 0", v)) }
    }

    /// A number in 0..=1.
    ///
    /// # Errors
    /// Missing, not a number, or outside.
    pub fn fraction(&self, name: &'static str) -> Result<f64, InvalidPart> {
        let v = self.number(name)?;
        if (0.0..=1.0).contains(&v) { Ok(v) } else { Err(InvalidPart::new(name, "must lie in 0..1", v)) }
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
        match self.value(name)? {
            Value::Color(c) if c.all(|v| (0.0..=1.0).contains(&v)) => Ok(c),
            other => Err(wrong(name, "must be a colour with channels in 0..1", &other)),
        }
    }

    /// An amount of light.
    ///
    /// # Errors
    /// Missing, not a colour, or a channel negative, not finite, or beyond [`LARGEST`].
    pub fn quantity(&self, name: &'static str) -> Result<Rgb, InvalidPart> {
        match self.value(name)? {
            Value::Color(c) if c.all(|v| (0.0..=LARGEST).contains(&v)) => Ok(c),
            other @ Value::Color(c) if c.all(|v| v >= 0.0 && v.is_finite()) => {
                Err(wrong(name, WITHIN_LARGEST, &other))
            }
            other => Err(wrong(name, "must be light with finite channels of at least 0", &other)),
        }
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

    /// The place of a word in the field's list of choices.
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
}

fn wrong(name: &'static str, requirement: &str, found: &Value) -> InvalidPart {
    let found = match found {
        Value::Number(v) => v.to_string(),
        Value::Vector(v) => format!("{} {} {}", v.x, v.y, v.z),
        Value::Color(c) => format!("{} {} {}", c.r, c.g, c.b),
        Value::Flag(v) => format!("#{v}"),
        Value::Word(w) => format!("\"{w}\""),
        Value::Mesh(m) => format!("the mesh {}", m.path),
    };
    InvalidPart::new(name, requirement, found)
}

/// Declares an enum with one variant per kind of part, and what follows from the list: the table of kinds,
/// making, naming and changing parts, and a macro `$each!(value, part => expression)` that evaluates the
/// expression with `part` bound to whatever the value holds. (`$d` stands for a dollar sign.)
macro_rules! parts {
    ($d:tt $each:ident $(#[$meta:meta])* $vis:vis enum $name:ident { $($(#[$doc:meta])* $variant:ident),+ $(,)? }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq)]
        #[non_exhaustive]
        $vis enum $name { $($(#[$doc])* $variant($variant)),+ }

        $(impl From<$variant> for $name {
            fn from(part: $variant) -> Self {
                Self::$variant(part)
            }
        })+

        impl $name {
            /// Every kind there is, in the order of the list.
            pub const KINDS: &'static [$crate::Kind<Self>] = &[$($crate::Kind {
                name: <$variant as $crate::Part>::NAME,
                doc: <$variant as $crate::Part>::DOC,
                fields: <$variant as $crate::Part>::FIELDS,
                make: |values| $crate::part::make::<$variant>(values).map(Self::$variant),
            }),+];

            /// The kind of that name.
            #[must_use]
            pub fn kind_named(name: &str) -> Option<&'static $crate::Kind<Self>> {
                Self::KINDS.iter().find(|k| k.name == name)
            }

            /// The word for its kind.
            #[must_use]
            pub fn kind_name(&self) -> &'static str {
                match self { $(Self::$variant(_) => <$variant as $crate::Part>::NAME),+ }
            }

            /// Its kind.
            #[must_use]
            pub fn kind(&self) -> &'static $crate::Kind<Self> {
                let name = self.kind_name();
                Self::KINDS.iter().find(|k| k.name == name).unwrap_or(&Self::KINDS[0])
            }

            /// Its values by field name.
            #[must_use]
            pub fn values(&self) -> $crate::Values {
                match self { $(Self::$variant(part) => $crate::Part::values(part)),+ }
            }

            /// The same part with one value changed.
            ///
            /// # Errors
            /// A field that the kind has not, or a value that it refuses.
            pub fn with(&self, field: &'static str, value: $crate::Value) -> Result<Self, $crate::InvalidPart> {
                let kind = self.kind();
                if kind.field(field).is_none() {
                    return Err($crate::InvalidPart::new(field, format!("must be a field of {}", kind.name), "unknown"));
                }
                (kind.make)(&self.values().with(field, value))
            }
        }

        macro_rules! $each {
            ($d value:expr, $d part:ident => $d body:expr) => {
                match $d value { $($name::$variant($d part) => $d body),+ }
            };
        }
    };
}
pub(crate) use parts;
