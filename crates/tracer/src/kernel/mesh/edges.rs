//! Eight triangles as seen from the common origin of rays: planes through their edges, with error bounds.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use super::{CommonOrigin, LeafBlock, bound_eight};
use crate::accel::{Block8, WIDTH};
use crate::lanes::MulAdd8;
use crate::numeric::{BUNDLE_DEPTH, BUNDLE_EDGE, BUNDLE_TOP};

/// Eight triangles as seen from the common origin.
pub(super) struct Prepared {
    /// Planes through the common origin and each edge.
    pub(super) edges: [[[f32; WIDTH]; 3]; 3],
    pub(super) edge_error: [f32; WIDTH],
    /// The triangle's own normal, and the common origin's distance from its plane along that.
    pub(super) normal: [[f32; WIDTH]; 3],
    pub(super) top: [f32; WIDTH],
    /// What the errors of depths grow with; see [`Plane`](super::planes::Plane).
    pub(super) depth_errors: [[f32; WIDTH]; 2],
}

/// Bounds of the rays of a group that all triangles are tested with: one box of slopes, and error bounds.
pub(super) struct RayBounds {
    slopes: Slopes,
    /// Errors of an edge's value per size of its plane's components, axis by axis, and per length of the edge.
    shares: [f32; 3],
    beside: f32,
}

/// The middles of slopes, and how far they lie from those.
pub(super) struct Slopes {
    middle: [f32; 2],
    half: [f32; 2],
}

impl Slopes {
    #[inline(always)]
    pub(super) fn of([low, high]: [[f32; 2]; 2]) -> Self {
        // Half the width is rounded by less than what the edges' doubled errors have room for.
        Self {
            middle: [(low[0] + high[0]) * 0.5, (low[1] + high[1]) * 0.5],
            half: [(high[0] - low[0]) * 0.5, (high[1] - low[1]) * 0.5],
        }
    }
}

/// Three numbers for each of eight triangles.
type Eight3<S> = [f32x8<S>; 3];

impl CommonOrigin {
    /// The bounds of the rays that blocks are tested with: the same for all blocks.
    pub(super) fn ray_bounds(&self) -> RayBounds {
        let most = self.steepest();
        RayBounds {
            slopes: Slopes::of(self.widened([self.low, self.high])),
            shares: [
                BUNDLE_EDGE * most[0] + self.slopes_off,
                BUNDLE_EDGE * most[1] + self.slopes_off,
                BUNDLE_EDGE,
            ],
            beside: 2.0 * (1.0 + most[0] + most[1]) * self.slack,
        }
    }

    /// A block as seen from the common origin, and which of a leaf's triangles in it rays may meet, if any.
    #[inline(always)]
    pub(super) fn prepare<S: Simd>(
        &self,
        s: S,
        leaf: &LeafBlock<'_>,
        ray_bounds: &RayBounds,
    ) -> Option<(Prepared, u64)> {
        let block = &leaf.tree.blocks[leaf.block];
        let (a, b, c) = (self.corner(s, block, 0), self.corner(s, block, 1), self.corner(s, block, 2));
        let edges = [minus(c, b), minus(a, c), minus(b, a)];
        let (p, q, r) =
            (self.seen_from_origin(s, a), self.seen_from_origin(s, b), self.seen_from_origin(s, c));
        let planes = [cross(edges[0], q), cross(edges[1], r), cross(edges[2], p)];
        // Each axis counts with its own sizes: rays run mostly along one, and edges often along few.
        let size = largest(edges);
        let far = [p[0].abs() + size[0], p[1].abs() + size[1], p[2].abs() + size[2]];
        let length = size[0].max(size[1]).max(size[2]);
        let least = f32x8::splat(s, f32::MIN_POSITIVE);
        let of_point = length.fused(f32x8::splat(s, ray_bounds.beside), least);
        let edge_error = bound_eight(s, weighted(s, products(size, far), ray_bounds.shares, of_point));
        let seen = seen(s, &planes, edge_error, &ray_bounds.slopes) & leaf.own;
        if seen == 0 {
            return None;
        }
        let normal = cross(edges[1], edges[2]);
        let top = dot(p, normal);
        let areas = [size[1] * size[2], size[2] * size[0], size[0] * size[1]];
        let of_point = (length * length).fused(f32x8::splat(s, 6.0 * self.slack), least);
        let top_error = dot(areas, far).fused(f32x8::splat(s, 2.0 * BUNDLE_TOP), of_point);
        let slope_error = weighted(s, areas, ray_bounds.shares.map(|share| share + share), least);
        let deepest = p[2].max(q[2]).max(r[2]).max(f32x8::splat(s, 0.0)) + f32x8::splat(s, 2.0 * self.slack);
        let most = (deepest * f32x8::splat(s, 1.5)).fused(slope_error, top_error);
        let certain = (most * f32x8::splat(s, 4.0)).simd_lt(top.abs());
        let share = certain.select(f32x8::splat(s, 1.5) / top.abs(), f32x8::splat(s, f32::INFINITY));
        let of_square = bound_eight(s, slope_error * share);
        let of_depth = bound_eight(s, top_error.fused(share, f32x8::splat(s, BUNDLE_DEPTH)));
        let prepared = Prepared {
            edges: [stored(planes[0]), stored(planes[1]), stored(planes[2])],
            edge_error: edge_error.to_array(),
            normal: stored(normal),
            top: top.to_array(),
            depth_errors: [of_square.to_array(), of_depth.to_array()],
        };
        Some((prepared, seen))
    }

    /// A corner of every triangle, axis by axis as in `axes`.
    #[inline(always)]
    fn corner<S: Simd>(&self, s: S, block: &Block8, corner: usize) -> Eight3<S> {
        let rows = &block.corners[corner];
        [
            f32x8::load_array_ref(s, &rows[self.axes[0]]),
            f32x8::load_array_ref(s, &rows[self.axes[1]]),
            f32x8::load_array_ref(s, &rows[self.axes[2]]),
        ]
    }

    /// Corners as seen from the common origin, mirrored as it is.
    #[inline(always)]
    fn seen_from_origin<S: Simd>(&self, s: S, p: Eight3<S>) -> Eight3<S> {
        let sign = f32x8::splat(s, self.sign);
        [
            p[0].mul_sub_precise(sign, f32x8::splat(s, self.origin[0])),
            p[1].mul_sub_precise(sign, f32x8::splat(s, self.origin[1])),
            p[2].mul_sub_precise(sign, f32x8::splat(s, self.origin[2])),
        ]
    }
}

impl Prepared {
    /// Triangles that the rays within a box of slopes are not certain to miss.
    #[inline(always)]
    pub(super) fn seen_by<S: Simd>(&self, s: S, slopes: &Slopes) -> u64 {
        let [a, b, c] = &self.edges;
        let planes = [loaded(s, a), loaded(s, b), loaded(s, c)];
        seen(s, &planes, f32x8::load_array_ref(s, &self.edge_error), slopes)
    }
}

/// Triangles that not all rays are certain to miss: those that no two edges leave all rays on different sides of.
#[inline(always)]
fn seen<S: Simd>(s: S, planes: &[Eight3<S>; 3], error: f32x8<S>, slopes: &Slopes) -> u64 {
    let doubled = error + error;
    let (u, v) = (f32x8::splat(s, slopes.middle[0]), f32x8::splat(s, slopes.middle[1]));
    let (du, dv) = (f32x8::splat(s, slopes.half[0]), f32x8::splat(s, slopes.half[1]));
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
fn minus<S: Simd>(a: Eight3<S>, b: Eight3<S>) -> Eight3<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross<S: Simd>(a: Eight3<S>, b: Eight3<S>) -> Eight3<S> {
    [
        a[1].mul_sub_precise(b[2], a[2] * b[1]),
        a[2].mul_sub_precise(b[0], a[0] * b[2]),
        a[0].mul_sub_precise(b[1], a[1] * b[0]),
    ]
}

/// At least the sizes of a cross product's components, term by term, of vectors within boxes of these sizes.
#[inline(always)]
fn products<S: Simd>(a: Eight3<S>, b: Eight3<S>) -> Eight3<S> {
    [a[1].fused(b[2], a[2] * b[1]), a[2].fused(b[0], a[0] * b[2]), a[0].fused(b[1], a[1] * b[0])]
}

#[inline(always)]
fn dot<S: Simd>(a: Eight3<S>, b: Eight3<S>) -> f32x8<S> {
    a[0].fused(b[0], a[1].fused(b[1], a[2] * b[2]))
}

/// Components times their shares, and something more.
#[inline(always)]
fn weighted<S: Simd>(s: S, v: Eight3<S>, shares: [f32; 3], more: f32x8<S>) -> f32x8<S> {
    let [x, y, z] = [f32x8::splat(s, shares[0]), f32x8::splat(s, shares[1]), f32x8::splat(s, shares[2])];
    v[0].fused(x, v[1].fused(y, v[2].fused(z, more)))
}

/// The largest size of each coordinate of three vectors.
#[inline(always)]
fn largest<S: Simd>([a, b, c]: [Eight3<S>; 3]) -> Eight3<S> {
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
fn stored<S: Simd>(v: Eight3<S>) -> [[f32; WIDTH]; 3] {
    [v[0].to_array(), v[1].to_array(), v[2].to_array()]
}
