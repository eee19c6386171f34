//! How much of what is seen does a material mirror, the same everywhere and from every side?

use crate::lobe::Mirror;
use crate::part::Given;
use crate::{Coefficient, Constant3, Field, FieldKind, InvalidPart, Lane, Lobes, Rgb, Triple, Value};

/// A constant share of what is seen that is mirrored; the base shows the rest.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MirrorShare {
    share: f64,
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
    pub(super) fn given(given: &Given<'_>, color: Rgb) -> Result<Self, InvalidPart> {
        let share = given.fraction(Self::FIELD.name)?;
        let tint = color * share;
        Ok(Self {
            share,
            base: Coefficient::new(1.0 - share),
            tint: (tint != Rgb::BLACK).then(|| tint.into()),
        })
    }

    /// As given.
    pub(super) fn value(&self) -> Value {
        Value::Number(self.share)
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
