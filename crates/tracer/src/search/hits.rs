//! The closest hits of rays so far, in registers and in columns.

use fearless_simd::Simd;

use crate::film::NOTHING;
use crate::lanes::{Column, F, M, U};

/// The nearest crossing of every lane so far.
#[derive(Clone, Copy)]
pub(crate) struct Hits<S: Simd> {
    /// Metres along the ray; [`f32::MAX`] where nothing is met.
    pub(crate) t: F<S>,
    /// Bound on the error of `t`.
    pub(crate) error: F<S>,
    /// Which shape; [`NOTHING`] where nothing is met.
    pub(crate) prim: U<S>,
    /// Which facet of it.
    pub(crate) facet: U<S>,
}

impl<S: Simd> Hits<S> {
    #[inline(always)]
    pub(crate) fn nothing(s: S) -> Self {
        Self::nothing_until(s, F::splat(s, f32::MAX), F::splat(s, 0.0))
    }

    /// Nothing met up to a distance that is known within a bound.
    #[inline(always)]
    pub(crate) fn nothing_until(s: S, far: F<S>, error: F<S>) -> Self {
        Self { t: far, error, prim: U::splat(s, NOTHING), facet: U::splat(s, 0) }
    }

    /// Loads hits that were found before.
    #[inline(always)]
    pub(crate) fn found(s: S, found: &HitColumns, at: usize) -> Self {
        Self {
            t: F::load(s, &found.t[at..]),
            error: F::load(s, &found.error[at..]),
            prim: U::load(s, &found.prim[at..]),
            facet: U::load(s, &found.facet[at..]),
        }
    }

    /// Stores them for later.
    #[inline(always)]
    pub(crate) fn store(&self, found: &mut HitColumns, at: usize) {
        self.t.store(&mut found.t[at..]);
        self.error.store(&mut found.error[at..]);
        self.prim.store(&mut found.prim[at..]);
        self.facet.store(&mut found.facet[at..]);
    }

    /// Lanes that meet something.
    #[inline(always)]
    pub(crate) fn hits(&self) -> M<S> {
        !self.prim.is(NOTHING)
    }
}

/// The hits of a batch, column by column.
#[derive(Default)]
pub(crate) struct HitColumns {
    pub(crate) t: Column<f32>,
    /// Bound on the error of `t`.
    pub(crate) error: Column<f32>,
    pub(crate) prim: Column<u32>,
    pub(crate) facet: Column<u32>,
}

impl HitColumns {
    /// Makes room for `rays` rays.
    pub(crate) fn make_room(&mut self, rays: usize) {
        if self.t.len() < rays {
            self.t.resize(rays, 0.0);
            self.error.resize(rays, 0.0);
            self.prim.resize(rays, 0);
            self.facet.resize(rays, 0);
        }
    }
}
