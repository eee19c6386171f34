//! Rays in `f64` beside the formulas' numbers: the same lanes wide and narrow, so that one rule serves a single ray and
//! a packet.

use catoptra_core::{Arithmetic, Lane, Triple};
use fearless_simd::Simd;

use super::{D, F, M};

/// `f64` in every lane, which is rounded to the numbers that formulas are written in.
pub(crate) trait Precise: Arithmetic {
    /// The same lanes as the formulas' numbers.
    type Narrow: Lane;

    /// Rounded.
    fn narrow(self) -> Self::Narrow;

    /// `if_true` where the mask holds, else `if_false`.
    fn pick(mask: <Self::Narrow as Lane>::Mask, if_true: Self, if_false: Self) -> Self;
}

impl Precise for f64 {
    type Narrow = Self;

    fn narrow(self) -> Self {
        self
    }
    fn pick(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }
}

impl<S: Simd> Precise for D<S> {
    type Narrow = F<S>;

    #[inline(always)]
    fn narrow(self) -> F<S> {
        D::narrow(self)
    }
    #[inline(always)]
    fn pick(mask: M<S>, if_true: Self, if_false: Self) -> Self {
        D::pick(mask, if_true, if_false)
    }
}

/// Rounded.
#[inline(always)]
pub(crate) fn narrow3<P: Precise>(v: Triple<P>) -> Triple<P::Narrow> {
    Triple::new(v.x.narrow(), v.y.narrow(), v.z.narrow())
}

/// `if_true` where the mask holds, else `if_false`.
#[inline(always)]
pub(crate) fn pick3<P: Precise>(
    mask: <P::Narrow as Lane>::Mask,
    if_true: Triple<P>,
    if_false: Triple<P>,
) -> Triple<P> {
    Triple::new(
        P::pick(mask, if_true.x, if_false.x),
        P::pick(mask, if_true.y, if_false.y),
        P::pick(mask, if_true.z, if_false.z),
    )
}
