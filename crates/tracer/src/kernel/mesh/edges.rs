//! Eight triangles as the rays of a bundle see them: their edges as lines, with error bounds.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use super::common::Eight3;
use crate::accel::WIDTH;
use crate::lanes::MulAdd8;

/// Eight triangles as the rays see them.
pub(crate) struct Prepared {
    /// Lines of the edges: n of n·(u, v, 1).
    pub(super) edges: [[[f32; WIDTH]; 3]; 3],
    pub(super) edge_error: [f32; WIDTH],
    /// What tells at which depth rays cross their planes; see [`Plane`](super::planes::Plane).
    pub(super) normal: [[f32; WIDTH]; 3],
    pub(super) top: [f32; WIDTH],
    pub(super) depth_errors: [[f32; WIDTH]; 2],
}

/// The middle of a box round places, and how far they lie from that.
pub(super) struct Around {
    middle: [f32; 2],
    half: [f32; 2],
}

impl Around {
    #[inline(always)]
    pub(super) fn of([low, high]: [[f32; 2]; 2]) -> Self {
        // Half the width is rounded by less than what the edges' doubled errors have room for.
        Self {
            middle: [(low[0] + high[0]) * 0.5, (low[1] + high[1]) * 0.5],
            half: [(high[0] - low[0]) * 0.5, (high[1] - low[1]) * 0.5],
        }
    }
}

impl Prepared {
    /// Triangles that the rays within a box of places are not certain to miss.
    #[inline(always)]
    pub(super) fn seen_by<S: Simd>(&self, s: S, around: &Around) -> u64 {
        let [a, b, c] = &self.edges;
        let planes = [loaded(s, a), loaded(s, b), loaded(s, c)];
        seen(s, &planes, f32x8::load_array_ref(s, &self.edge_error), around)
    }
}

/// Triangles that not all rays are certain to miss: those that no two edges leave all rays on different sides of.
#[inline(always)]
pub(super) fn seen<S: Simd>(s: S, planes: &[Eight3<S>; 3], error: f32x8<S>, around: &Around) -> u64 {
    let doubled = error + error;
    let (u, v) = (f32x8::splat(s, around.middle[0]), f32x8::splat(s, around.middle[1]));
    let (du, dv) = (f32x8::splat(s, around.half[0]), f32x8::splat(s, around.half[1]));
    let (mut least_high, mut most_low) = (f32x8::splat(s, f32::INFINITY), f32x8::splat(s, f32::NEG_INFINITY));
    for n in planes {
        let middle = n[0].fused(u, n[1].fused(v, n[2]));
        let radius = n[0].abs().fused(du, n[1].abs().fused(dv, doubled));
        least_high = least_high.min(middle + radius);
        most_low = most_low.max(middle - radius);
    }
    let zero = f32x8::splat(s, 0.0);
    !(least_high.simd_lt(zero) & most_low.simd_gt(zero)).to_bitmask() & 0xff
}

#[inline(always)]
pub(super) fn minus<S: Simd>(a: Eight3<S>, b: Eight3<S>) -> Eight3<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(super) fn cross<S: Simd>(a: Eight3<S>, b: Eight3<S>) -> Eight3<S> {
    [
        a[1].mul_sub_precise(b[2], a[2] * b[1]),
        a[2].mul_sub_precise(b[0], a[0] * b[2]),
        a[0].mul_sub_precise(b[1], a[1] * b[0]),
    ]
}

/// At least the sizes of a cross product's components, term by term, of vectors within boxes of these sizes.
#[inline(always)]
pub(super) fn products<S: Simd>(a: Eight3<S>, b: Eight3<S>) -> Eight3<S> {
    [a[1].fused(b[2], a[2] * b[1]), a[2].fused(b[0], a[0] * b[2]), a[0].fused(b[1], a[1] * b[0])]
}

#[inline(always)]
pub(super) fn dot<S: Simd>(a: Eight3<S>, b: Eight3<S>) -> f32x8<S> {
    a[0].fused(b[0], a[1].fused(b[1], a[2] * b[2]))
}

/// Components times their shares, and something more.
#[inline(always)]
pub(super) fn weighted<S: Simd>(s: S, v: Eight3<S>, shares: [f32; 3], more: f32x8<S>) -> f32x8<S> {
    let [x, y, z] = [f32x8::splat(s, shares[0]), f32x8::splat(s, shares[1]), f32x8::splat(s, shares[2])];
    v[0].fused(x, v[1].fused(y, v[2].fused(z, more)))
}

/// The largest size of each coordinate of three vectors.
#[inline(always)]
pub(super) fn largest<S: Simd>([a, b, c]: [Eight3<S>; 3]) -> Eight3<S> {
    [
        a[0].abs().max(b[0].abs()).max(c[0].abs()),
        a[1].abs().max(b[1].abs()).max(c[1].abs()),
        a[2].abs().max(b[2].abs()).max(c[2].abs()),
    ]
}

#[inline(always)]
fn loaded<S: Simd>(s: S, [x, y, z]: &[[f32; WIDTH]; 3]) -> Eight3<S> {
    [f32x8::load_array_ref(s, x), f32x8::load_array_ref(s, y), f32x8::load_array_ref(s, z)]
}

#[inline(always)]
pub(super) fn stored<S: Simd>(v: Eight3<S>) -> [[f32; WIDTH]; 3] {
    [v[0].to_array(), v[1].to_array(), v[2].to_array()]
}
