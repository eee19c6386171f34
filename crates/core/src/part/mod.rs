//! How a part describes itself: its kind, its fields, and its values by name, so that scene text, panels, docs
//! and tests follow from the part's own file.

mod given;
mod value;

pub(crate) use given::degrees;
pub use given::{Given, LARGEST};
pub use value::{ImageSource, MeshSource, ProfileSource, Rows, Textured, Value, Values};

use crate::{InvalidPart, Rgb};

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
    /// How a luminaire shines by direction, read from a file.
    Profile,
    /// Two numbers; one stands for both.
    Pair,
    /// A picture read from a file.
    Image,
    /// One of the scene's textures, by its name.
    Texture,
    /// Any count of rows of so many numbers each; in text every row is a line of its own.
    Rows(usize),
}

impl FieldKind {
    /// Whether a value of this kind can be multiplied by a texture; a material says which of its fields are.
    #[must_use]
    pub fn is_paintable(self) -> bool {
        matches!(self, Self::Color | Self::Quantity | Self::Fraction)
    }
}

/// One named parameter of a part.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// Its name in scene text.
    pub name: &'static str,
    /// What it takes.
    pub kind: FieldKind,
    /// What it is when left out; `None` where it has no default.
    pub default: Option<fn() -> Value>,
    /// Whether it may be left out.
    pub may_be_missing: bool,
    /// The field whose place it takes: of the two exactly one is given.
    pub instead_of: Option<&'static str>,
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
        Self { name, kind, default: None, may_be_missing: false, instead_of: None, unit, doc }
    }

    /// The same field, which may be left out and has no default.
    #[must_use]
    pub const fn optional(self) -> Self {
        Self { may_be_missing: true, ..self }
    }

    /// The same field, given or else the other one.
    #[must_use]
    pub const fn instead_of(self, other: &'static str) -> Self {
        Self { may_be_missing: true, instead_of: Some(other), ..self }
    }

    /// The same field, with a default for when it is left out.
    #[must_use]
    pub const fn or(self, default: fn() -> Value) -> Self {
        Self { default: Some(default), may_be_missing: true, ..self }
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

    /// Values of a part of this kind, with every amount of light that they tell put to none.
    #[must_use]
    pub fn without_light(&self, values: &Values) -> Values {
        let has = |name: &str| values.get(name).is_some();
        self.fields.iter().fold(values.clone(), |dark, field| match field.kind {
            FieldKind::Quantity if has(field.name) => dark.with(field.name, Value::Color(Rgb::BLACK)),
            // A picture of all that is around has a factor instead.
            FieldKind::Number if field.name == "scale" && has("file") => {
                dark.with(field.name, Value::Number(0.0))
            }
            _ => dark,
        })
    }
}

/// A part of a scene that describes itself.
///
/// Its constructors take what has no default; [`with`](Self::with) sets all else by the names of scene text:
///
/// ```
/// use catoptra_core::{Part, Rgb, material::Phong};
///
/// let red = Phong::new(Rgb::new(0.8, 0.1, 0.1))?.with("shininess", 40.0)?.with("reflectiveness", 0.2)?;
/// assert!(red.with("shinyness", 1.0).is_err(), "no such field");
/// # Ok::<(), catoptra_core::InvalidPart>(())
/// ```
///
/// Which kinds of parts there are is closed: shapes, materials, lights and textures are lists of this crate, since the tracer
/// has code of its own for each in its inner loops. A new kind is one file and one line here, and none elsewhere.
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

    /// The same part with one value changed, or given in place of the one that the field stands
    /// [instead of](Field::instead_of).
    ///
    /// # Errors
    /// A field that the part has not, or a value that it refuses.
    fn with(&self, field: &'static str, value: impl Into<Value>) -> Result<Self, InvalidPart> {
        let instead_of = Self::FIELDS.iter().find(|known| known.name == field).and_then(|f| f.instead_of);
        let values = match instead_of {
            Some(other) => self.values().without(other),
            None => self.values(),
        };
        make(&values.with(field, value.into()))
    }
}

/// Makes a part from values: the work of [`Kind::make`].
///
/// # Errors
/// A value that is missing, of the wrong sort, or refused, and one whose name is that of no field.
pub fn make<P: Part>(values: &Values) -> Result<P, InvalidPart> {
    if let Some((name, _)) = values.iter().find(|(name, _)| P::FIELDS.iter().all(|field| field.name != *name))
    {
        let known: Vec<&str> = P::FIELDS.iter().map(|field| field.name).collect();
        let unknown = InvalidPart::new(name, format!("must be a field of {}", P::NAME), "unknown");
        return Err(unknown.with_hint(format!("its fields are: {}", known.join(", "))));
    }
    P::make(&Given { fields: P::FIELDS, values })
}

/// Declares an enum with one variant per kind of part, and what follows from the list: the table of kinds,
/// making, naming and changing parts, and a macro `$each!(value, part => expression)` that evaluates the
/// expression with `part` bound to whatever the value holds. (`$d` is a dollar sign.)
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

            /// See [`Part::with`]($crate::Part::with).
            ///
            /// # Errors
            /// A field that the kind has not, or a value that it refuses.
            pub fn with(
                &self,
                field: &'static str,
                value: impl Into<$crate::Value>,
            ) -> Result<Self, $crate::InvalidPart> {
                match self { $(Self::$variant(part) => $crate::Part::with(part, field, value).map(Self::$variant)),+ }
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
