//! Points against a disk's rim: how far from the centre.

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane};
use fearless_simd::Simd;

use super::flat::{FlatRow, Outline, Sides};
use crate::lanes::{F, F3};
use crate::numeric::magnitude_of;

/// A disk, seen from its centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct DiskOutline {
    radius: f32,
}

impl FlatRow {
    /// The disk of a radius round a centre.
    pub(crate) fn disk(center: DVec3, normal: DVec3, radius: f64, prim: u32) -> Self {
        let outline = Outline::Disk(DiskOutline { radius: radius as f32 });
        Self::new(center, normal, outline, magnitude_of(center) + (radius as f32).next_up(), prim)
    }
}

impl DiskOutline {
    /// A point whose coordinates are off by e is off by √3 e; what is left of 2e is far more than the roundings of
    /// squares take, since e is a dozen roundings of the radius and more. A distance d off by that changes
    /// |d² − r²| by 2e (2r ± 2e) near the rim.
    #[inline(always)]
    pub(super) fn sides<S: Simd>(&self, s: S, point: F3<S>, error: F<S>) -> Sides<S> {
        let radius = F::splat(s, self.radius);
        let (off, square) = (error + error, radius * radius);
        let beyond = point.dot(point) - square;
        let band = off * (radius + radius);
        Sides { inside: beyond.less(-band), outside: off.mul_add(off, band).less(beyond) }
    }
}
