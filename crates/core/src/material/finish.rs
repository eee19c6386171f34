//! What does a shape wear beside the lobes of its material, whatever the material: is it see-through, one-sided, bumpy?

use glam::DVec3;

use crate::part::Given;
use crate::texture::{Level, TexturePoint, TextureSource};
use crate::{Field, FieldKind, InvalidPart, Kind, Part, TextureId, Value, Values};

/// Which sides of a surface are there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sides {
    /// The one that the shape's normal points to; from behind it is not seen.
    Single,
    /// Both.
    Double,
}

const SIDES: [Sides; 2] = [Sides::Single, Sides::Double];
const SIDES_WORDS: &[&str] = &["single", "double"];

/// A texture whose colours stand for normals: red along the tangent, green along the bitangent, blue outwards, each
/// 2 c − 1. It needs `color-space "linear"`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalMap {
    /// Which texture of the scene.
    pub texture: TextureId,
    /// What the parts along the surface are multiplied by, at least 0.
    pub strength: f64,
}

impl NormalMap {
    /// The unit normal at a point: along tangent, bitangent and geometric normal. Never below the surface.
    #[must_use]
    pub fn normal(&self, textures: &impl TextureSource, point: &TexturePoint) -> DVec3 {
        let [x, y, z] = textures.texel(self.texture, point).color.to_array().map(|v| 2.0 * v - 1.0);
        DVec3::new(x * self.strength, y * self.strength, z.max(0.0)).try_normalize().unwrap_or(DVec3::Z)
    }
}

/// What surfaces have beside their lobes. The default is nothing special: opaque, seen from both sides, smooth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finish {
    opacity: Level,
    alpha_cutoff: Option<f64>,
    sides: Sides,
    normal_map: Option<NormalMap>,
}

impl Default for Finish {
    fn default() -> Self {
        Self { opacity: Level::from(1.0), alpha_cutoff: None, sides: Sides::Double, normal_map: None }
    }
}

impl Finish {
    /// As the kinds of other parts.
    pub const KIND: Kind<Self> =
        Kind { name: Self::NAME, doc: Self::DOC, fields: Self::FIELDS, make: crate::part::make };

    /// Whether it is nothing special.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// Whether it differs from point to point or from side to side.
    #[must_use]
    pub fn needs_coordinates(&self) -> bool {
        !self.is_plain()
    }

    /// Whether something behind may be seen through it somewhere.
    #[must_use]
    pub fn is_see_through(&self) -> bool {
        self.opacity.is_textured() || self.opacity.base() < 1.0
    }

    /// How opaque it is, before a cutoff.
    #[must_use]
    pub fn opacity(&self) -> Level {
        self.opacity
    }

    /// From which opacity on it is there whole; below it is not there at all. `None` where it blends.
    #[must_use]
    pub fn alpha_cutoff(&self) -> Option<f64> {
        self.alpha_cutoff
    }

    /// Which of its sides are there.
    #[must_use]
    pub fn sides(&self) -> Sides {
        self.sides
    }

    /// What bends its normals.
    #[must_use]
    pub fn normal_map(&self) -> Option<NormalMap> {
        self.normal_map
    }

    /// The share of light from behind that it keeps back at a point, 0..=1; 0 or 1 where there is a cutoff.
    #[must_use]
    pub fn opacity_at(&self, textures: &impl TextureSource, point: &TexturePoint) -> f64 {
        let opacity = self.opacity.at(textures, point);
        self.alpha_cutoff.map_or(opacity, |cutoff| f64::from(opacity >= cutoff))
    }

    /// The same with one value changed.
    ///
    /// # Errors
    /// A field that it has not, or a value that it refuses.
    pub fn with(&self, field: &'static str, value: Value) -> Result<Self, InvalidPart> {
        if Self::KIND.field(field).is_none() {
            return Err(InvalidPart::new(field, "must be a field of every material", "unknown"));
        }
        crate::part::make(&self.values().with(field, value))
    }
}

impl Part for Finish {
    const NAME: &'static str = "finish";
    const DOC: &'static str = "What any material may have beside its own fields.";
    const FIELDS: &'static [Field] = &[
        Field::required("opacity", FieldKind::Fraction, "", "Share of light from behind that is kept back.")
            .or(|| Value::Number(1.0)),
        Field::required(
            "alpha-cutoff",
            FieldKind::Fraction,
            "",
            "Opacity from which on it is there whole, and below not at all; without one it blends.",
        )
        .optional(),
        Field::required("sides", FieldKind::Choice(SIDES_WORDS), "", "Which of its sides are there.")
            .or(|| Value::Word("double".to_owned())),
        Field::required("normal-map", FieldKind::Texture, "", "Texture that bends its normals.").optional(),
        Field::required("normal-strength", FieldKind::Number, "", "How much it bends them, at least 0.")
            .or(|| Value::Number(1.0)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let has_cutoff = given.has("alpha-cutoff");
        let strength = given.not_negative("normal-strength")?;
        let normal_map = if given.has("normal-map") {
            Some(NormalMap { texture: given.texture("normal-map")?, strength })
        } else {
            None
        };
        if normal_map.is_none() && strength != 1.0 {
            let refused = InvalidPart::new("normal-strength", "must stand beside a normal-map", "alone");
            return Err(refused.with_hint("give normal-map too"));
        }
        Ok(Self {
            opacity: given.level("opacity")?,
            alpha_cutoff: if has_cutoff { Some(given.fraction("alpha-cutoff")?) } else { None },
            sides: SIDES[given.choice("sides")?],
            normal_map,
        })
    }

    fn values(&self) -> Values {
        let mut values = Values::new().with("opacity", self.opacity.value());
        if let Some(cutoff) = self.alpha_cutoff {
            values.set("alpha-cutoff", Value::Number(cutoff));
        }
        values.set("sides", Value::Word(SIDES_WORDS[self.sides as usize].to_owned()));
        if let Some(NormalMap { texture, strength }) = self.normal_map {
            values.set("normal-map", Value::Texture(texture));
            values.set("normal-strength", Value::Number(strength));
        }
        values
    }
}
