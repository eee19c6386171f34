//! Rays from a point to a rectangular lamp, aimed in vector lanes: all of them start at the point, so that they walk a mesh as
//! one bundle.
//!
//! Their ends lie evenly in the lamp's area but for a warp, which draws them closer where more arrives: by a bilinear
//! function that has what arrives from the lamp's corners there. It is the warp of
//! [`lamp_points`](catoptra_core::lamp_points), over the area instead of the solid angle.

use catoptra_core::glam::DVec3;
use catoptra_core::numeric::{LAMP_POINT_ROUNDING, LEAST_DENSITY};
use catoptra_core::{Arithmetic, Lane};
use fearless_simd::Simd;

use crate::lamps::Drawn;
use crate::lanes::{D3, F, MOST_LANES, U, narrow3, share_of_one, splat_wide};
use crate::search::FromPoint;
use crate::snapshot::FlatLamp;

/// A rectangular lamp as a point sees it, all relative to the point.
pub(super) struct QuadRays {
    corner: DVec3,
    edges: [DVec3; 2],
    normal: DVec3,
    /// Density at (0, 0), (1, 0), (0, 1) and (1, 1).
    density: [f32; 4],
    /// Which share of the way things block: what is farther is the lamp, but for rounding.
    end: f64,
}

/// Weights of rays, in the order in which they are traced.
pub(super) type Weights = Vec<f32>;

impl QuadRays {
    /// To a rectangle, given relative to the snapshot's origin as `position` is.
    pub(super) fn new(flat: &FlatLamp, position: DVec3, normal: DVec3) -> Option<Self> {
        let &[a, b, _, d] = flat.corners() else { return None };
        let (corner, edges) = (a - position, [b - a, d - a]);
        let arriving = |to: DVec3| {
            let square = to.length_squared();
            normal.dot(to).max(0.0) / (square * square)
        };
        let corners = [corner, corner + edges[0], corner + edges[1], corner + edges[0] + edges[1]];
        let values = corners.map(arriving);
        let largest = values.iter().fold(0.0, |most: f64, value| most.max(*value));
        let density = if largest > 0.0 && largest.is_finite() {
            let values = values.map(|value| value.max(largest * LEAST_DENSITY));
            let mean = values.iter().sum::<f64>() / 4.0;
            values.map(|value| (value / mean) as f32)
        } else {
            [1.0; 4]
        };
        let size = a.abs().element_sum() + edges[0].abs().element_sum() + edges[1].abs().element_sum();
        let off = (size + position.abs().element_sum()) * LAMP_POINT_ROUNDING;
        let height = flat.normal.dot(corner).abs();
        let end = if off < height { 1.0 - off / height } else { 0.0 };
        Some(Self { corner, edges, normal, density, end })
    }

    /// Aims `count` rays and weighs them by what would arrive along each.
    #[inline(always)]
    pub(super) fn aim<S: Simd>(
        &self,
        s: S,
        drawn: &Drawn,
        pair: u32,
        count: u32,
        rays: &mut FromPoint,
        weights: &mut Weights,
    ) {
        let sampler = drawn.sampler.in_lanes(s);
        let first = drawn.sample.wrapping_mul(count);
        let [a, b, c, d] = self.density.map(|density| F::splat(s, density));
        let half = F::splat(s, 0.5);
        let normal = narrow3(splat_wide(s, self.normal));
        weights.clear();
        for k in (0..count).step_by(F::<S>::LANES) {
            let [u, v] = sampler.pair(U::counted(s, first.wrapping_add(k)), pair).map(share_of_one);
            let second = linear(v, (a + b) * half, (c + d) * half);
            let (low, high) = (between(second, a, c), between(second, b, d));
            let share = linear(u, low, high);
            let to = self.point(s, share, second);
            let lanes = (count - k).min(F::<S>::LANES as u32);
            rays.push_lanes(to, self.end, lanes as usize);
            let way = narrow3(to);
            let square = way.dot(way);
            let arriving = way.dot(normal).max(F::splat(s, 0.0)) / (square * square);
            let mut found = [0.0; MOST_LANES];
            (arriving / between(share, low, high)).store(&mut found);
            weights.extend(&found[..lanes as usize]);
        }
    }

    #[inline(always)]
    fn point<S: Simd>(&self, s: S, u: F<S>, v: F<S>) -> D3<S> {
        let [along, up] = self.edges.map(|edge| splat_wide(s, edge));
        along.scale_add(u.widen(), up.scale_add(v.widen(), splat_wide(s, self.corner)))
    }
}

/// Where an even share goes under a density that is linear from `a` at 0 to `b` at 1.
#[inline(always)]
fn linear<S: Simd>(share: F<S>, a: F<S>, b: F<S>) -> F<S> {
    share * (a + b) / (a + between(share, a * a, b * b).sqrt())
}

#[inline(always)]
fn between<S: Simd>(share: F<S>, a: F<S>, b: F<S>) -> F<S> {
    share.mul_add(b - a, a)
}

/// Which share of all weights is that of rays that are not blocked.
pub(super) fn open_share(weights: &[f32], blocked: &[bool]) -> f64 {
    let (mut open, mut all) = (0.0, 0.0);
    for (weight, blocked) in weights.iter().zip(blocked) {
        let weight = f64::from(*weight);
        all += weight;
        open += if *blocked { 0.0 } else { weight };
    }
    if all > 0.0 { open / all } else { 0.0 }
}
