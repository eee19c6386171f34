//! How much of what is seen does a material mirror, the same from every side?

use crate::lobe::Mirror;
use crate::part::Given;
use crate::texture::{Level, Paint, TexturePoint, TextureSource};
use crate::{Coefficient, Constant3, Field, FieldKind, InvalidPart, Lane, Lobes, Rgb, Triple, Value};

/// A share of what is seen that is mirrored; the base shows the rest.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MirrorShare {
    share: Level,
    /// What the light that is mirrored is multiplied by.
    color: Paint,
    /// The base's share.
    base: Coefficient,
    /// Share that is mirrored, by channel, where that is not black.
    tint: Option<Constant3>,
}

impl MirrorShare {
    /// How scene text gives it.
    pub(super) const FIELD: Field = Field::required(
        "reflectiveness",
        FieldKind::Fraction,
        "",
        "Share of what is seen that is reflected; the rest is the surface's own look.",
    )
    .or(|| Value::Number(0.0));

    /// As given, of light that is mirrored in a colour.
    ///
    /// # Errors
    /// A share outside 0..=1.
    pub(super) fn given(given: &Given<'_>, color: Paint) -> Result<Self, InvalidPart> {
        Ok(Self::new(given.level(Self::FIELD.name)?, color))
    }

    fn new(share: Level, color: Paint) -> Self {
        let tint = color.rgb() * share.base();
        Self {
            share,
            color,
            base: Coefficient::new(1.0 - share.base()),
            tint: (tint != Rgb::BLACK).then(|| tint.into()),
        }
    }

    /// The colour of what is mirrored.
    pub(super) fn color(&self) -> &Paint {
        &self.color
    }

    pub(super) fn is_textured(&self) -> bool {
        self.share.is_textured() || self.color.is_textured()
    }

    /// With what its textures are at a point.
    pub(super) fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        if !self.is_textured() {
            return self.clone();
        }
        Self::new(self.share.resolved(textures, at), self.color.resolved(textures, at))
    }

    /// As given.
    pub(super) fn value(&self) -> Value {
        self.share.value()
    }

    /// A base and its share, and the mirror over it.
    #[inline(always)]
    pub(super) fn over<L: Lane>(&self, base: Lobes<L>) -> Lobes<L> {
        let like = base.share;
        let mirror = match &self.tint {
            Some(tint) => Some(Mirror { tint: Triple::of(like, tint) }),
            None => None,
        };
        Lobes { share: like.of(self.base), mirror, ..base }
    }
}
