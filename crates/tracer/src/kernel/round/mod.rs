//! Rays against a closed cylinder, cone or capsule: between which distances they run inside its side without an end, and
//! whether they enter and leave it there or through its ends, with error bounds.
//!
//! A ray is seen from the point of it that is nearest to the middle of the shape: q from the middle, so that its numbers are
//! no larger than the shape. With a the unit axis, h = q·a, e = d·a, n = d − e a, m = q − h a, and ρ = r + k h the side's radius at
//! that height, the side is met where A s² + 2 B s + C = 0, A = n² − k² e², B = q·n − k e ρ, and B² − A C = |ρ n − k e m|² − (q·(d × a))²,
//! a form that keeps its digits (as in `core/geometry/lateral.rs`).

mod surface;

use catoptra_core::glam::DVec3;
use catoptra_core::{Arithmetic, Lane, LaneMask};
use fearless_simd::Simd;

use super::{Proposal, Rays, bound, solid as inside};
use crate::lanes::{F, F3, M, U, cross, splat3};
use crate::numeric::{
    DIRECTION_ERROR, POINT_ERROR, ROUND_BALL_ERROR, ROUND_CHORD_ERROR, ROUND_END_ERROR, ROUND_ROOT_ERROR,
    ROUND_SQUARE_ERROR, magnitude_of, rounded,
};

/// Facets as [`Cylinder`](catoptra_core::geometry::Cylinder) numbers them.
const SIDE: u32 = 0;
const LOWER: u32 = 1;
const UPPER: u32 = 2;

/// A closed solid round an axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RoundRow {
    ends: [DVec3; 2],
    radii: [f64; 2],
    has_balls: bool,
    axis: DVec3,
    /// How much the radius grows with a metre of height.
    growth: f64,
    middle32: [f32; 3],
    axis32: [f32; 3],
    growth32: f32,
    half_length: f32,
    /// Of the side, half way.
    radius: f32,
    /// Of a ball round it, rounded up.
    ball: f32,
    reach: f32,
}

/// Ends of the stretch on which rays run inside, in metres from the point nearest to the middle.
struct Stretch<S: Simd> {
    places: [F<S>; 2],
    errors: [F<S>; 2],
    /// Heights above the middle.
    heights: [F<S>; 2],
    height_errors: [F<S>; 2],
    /// Rays that certainly pass by, and those that certainly run inside somewhere.
    misses: M<S>,
    crosses: M<S>,
}

/// One end of the stretch inside the shape.
struct Passed<S: Simd> {
    t: F<S>,
    error: F<S>,
    facet: U<S>,
    known: M<S>,
}

/// A ray as seen from the middle.
struct Seen<S: Simd> {
    /// Metres to the point nearest to the middle.
    nearest: F<S>,
    q: F3<S>,
    direction: F3<S>,
    /// h and e.
    height: F<S>,
    climb: F<S>,
    /// Bound on the error of a coordinate of q.
    error: F<S>,
}

impl RoundRow {
    pub(crate) fn new(ends: [DVec3; 2], radii: [f64; 2], has_balls: bool) -> Self {
        let (along, middle) = (ends[1] - ends[0], ends[0].midpoint(ends[1]));
        let (axis, length, largest) = (along.normalize(), along.length(), radii[0].max(radii[1]));
        let growth = (radii[1] - radii[0]) / length;
        let ball = if has_balls { length / 2.0 + largest } else { (length / 2.0).hypot(largest) };
        let ball = (ball as f32).next_up();
        Self {
            ends,
            radii,
            has_balls,
            axis,
            growth,
            middle32: rounded(middle),
            axis32: rounded(axis),
            growth32: growth as f32,
            half_length: (length / 2.0) as f32,
            radius: f64::midpoint(radii[0], radii[1]) as f32,
            ball,
            reach: magnitude_of(middle) + ball,
        }
    }

    #[inline(always)]
    fn see<S: Simd>(&self, s: S, rays: &Rays<S>) -> Seen<S> {
        let (direction, axis) = (rays.direction, splat3(s, self.axis32));
        let to_middle = splat3(s, self.middle32) - rays.origin;
        let nearest = to_middle.dot(direction);
        let q = direction.scale_add(nearest, rays.origin - splat3(s, self.middle32));
        let error = bound(s, (rays.reach + F::splat(s, self.reach)) * F::splat(s, POINT_ERROR));
        Seen { nearest, q, direction, height: q.dot(axis), climb: direction.dot(axis), error }
    }

    /// Between which places rays run inside the side without an end. See [`ROUND_ROOT_ERROR`] for all bounds.
    #[inline(always)]
    fn side<S: Simd>(&self, s: S, seen: &Seen<S>) -> Stretch<S> {
        let of = |v: f32| F::splat(s, v);
        let (zero, ever, axis) = (of(0.0), of(f32::INFINITY), splat3(s, self.axis32));
        let k = of(self.growth32);
        let spread = of(1.0 + self.growth32.abs());
        let (across, around) = (axis.scale_add(-seen.climb, seen.direction), cross(seen.direction, axis));
        let m = axis.scale_add(-seen.height, seen.q);
        let radius = k.mul_add(seen.height, of(self.radius));
        let widens = k * seen.climb;
        let square = across.dot(across) - widens * widens;
        let half = seen.q.dot(across) - widens * radius;
        let v = across.scale(radius) - m.scale(widens);
        let (v2, volume) = (v.dot(v), seen.q.dot(around));
        let chord2 = v2 - volume * volume;
        let unsure = spread * seen.error;
        let doubt = bound(s, unsure * of(ROUND_CHORD_ERROR) * (v2.sqrt() + unsure * of(14.0)));
        let square_error = bound(s, of(ROUND_SQUARE_ERROR) * spread * spread);
        let root = chord2.max(zero).sqrt();
        let inverse = of(1.0) / square;
        let fixed = of(ROUND_ROOT_ERROR).mul_add(spread * unsure, doubt / root);
        let share = inverse.abs() * of(4.0 / 3.0);
        let steep = square.less(zero);
        let place = |way: F<S>| (way * root - half) * inverse;
        let [a, b] = [place(of(-1.0)), place(of(1.0))];
        let [first, last] = [a.min(b), a.max(b)];
        let off = |place: F<S>| bound(s, place.abs().mul_add(square_error, fixed).mul_add(share, seen.error));
        // Of a line steeper than the side, what lies beyond the tip is not the solid's.
        let shrinks = widens.less(zero);
        let places = [
            F::pick(steep, F::pick(shrinks, -ever, last), first),
            F::pick(steep, F::pick(shrinks, first, ever), last),
        ];
        let ends = [off(first), off(last)];
        let errors = [F::pick(steep, ends[1], ends[0]), F::pick(steep, ends[0], ends[1])];
        let (heights, height_errors) = heights(s, seen, [places, errors], steep, shrinks);
        let known = (square_error * of(4.0)).less(square.abs());
        Stretch {
            places,
            errors,
            heights,
            height_errors,
            misses: known & !steep & chord2.less(-doubt),
            crosses: known & doubt.less(chord2),
        }
    }

    /// Where rays run through an end: a disk, whose plane they cross for certain, or half a ball.
    #[inline(always)]
    fn end<S: Simd>(&self, s: S, seen: &Seen<S>, upper: M<S>, way: f32) -> (F<S>, F<S>, M<S>, M<S>) {
        let of = |v: f32| F::splat(s, v);
        let level = F::pick(upper, of(self.half_length), of(-self.half_length));
        if !self.has_balls {
            let inverse = of(1.0) / seen.climb;
            let place = (level - seen.height) * inverse;
            let off = place.abs().mul_add(of(DIRECTION_ERROR), seen.error * of(ROUND_END_ERROR));
            let error = bound(s, off * inverse.abs() * of(4.0 / 3.0));
            let known = of(4.0 * DIRECTION_ERROR).less(seen.climb.abs());
            return (place, error + seen.error, known, of(1.0).less(of(0.0)));
        }
        let axis = splat3(s, self.axis32);
        let from = axis.scale_add(-level, seen.q);
        let nearest = -from.dot(seen.direction);
        let remainder = seen.direction.scale_add(nearest, from);
        let (radius, off) = (of(self.radius), seen.error * of(ROUND_BALL_ERROR));
        let chord2 = radius * radius - remainder.dot(remainder);
        let doubt = bound(s, off * (radius + radius + radius + off));
        let root = chord2.max(of(0.0)).sqrt();
        let error = bound(s, off + off + doubt / root);
        (root.mul_add(of(way), nearest), error, doubt.less(chord2), chord2.less(-doubt))
    }

    /// The end of the stretch where rays enter (−1) or leave (1), and those that certainly pass by.
    #[inline(always)]
    fn pass<S: Simd>(&self, s: S, seen: &Seen<S>, side: &Stretch<S>, way: f32) -> (Passed<S>, M<S>) {
        let i = usize::from(way > 0.0);
        let limit = F::splat(s, self.half_length);
        let (height, error) = (side.heights[i], side.height_errors[i]);
        let beyond = height.abs() - limit;
        let (within, outside) = (beyond.less(-error), error.less(beyond));
        let upper = F::splat(s, 0.0).less(height);
        let (place, end_error, meets, misses) = self.end(s, seen, upper, way);
        let facet = U::pick(upper, U::splat(s, UPPER), U::splat(s, LOWER));
        let passed = Passed {
            t: seen.nearest + F::pick(within, side.places[i], place),
            error: F::pick(within, side.errors[i], end_error) + seen.error,
            facet: U::pick(within, U::splat(s, SIDE), facet),
            known: within | (outside & meets),
        };
        // Both ends lie beyond the same end of the side: a cylinder is missed, a capsule where that ball is.
        let (other, other_error) = (side.heights[1 - i], side.height_errors[1 - i]);
        let other_beyond = F::pick(upper, other, -other) - limit;
        let same = outside & other_error.less(other_beyond);
        let by = if self.has_balls { same & misses } else { same };
        (passed, by)
    }

    /// Where lines run inside it.
    #[inline(always)]
    pub(super) fn stretch<S: Simd>(&self, s: S, rays: &Rays<S>) -> inside::Stretch<S> {
        let seen = self.see(s, rays);
        let wide = F::splat(s, self.ball) + seen.error + seen.error;
        let side = self.side(s, &seen);
        let (enters, by) = self.pass(s, &seen, &side, -1.0);
        let (leaves, _) = self.pass(s, &seen, &side, 1.0);
        let end = |at: Passed<S>| inside::End::about(at.t, at.error, at.facet, at.known);
        inside::Stretch {
            misses: (wide * wide).less(seen.q.dot(seen.q)) | side.misses | (side.crosses & by),
            crosses: side.crosses & enters.known & leaves.known & !by,
            ends: [end(enters), end(leaves)],
        }
    }

    /// The crossing nearest ahead, and on which facet it lies.
    #[inline(always)]
    pub(crate) fn propose<S: Simd>(&self, s: S, rays: &Rays<S>) -> (Proposal<S>, U<S>) {
        let zero = F::splat(s, 0.0);
        let (seen, ball) = (self.see(s, rays), F::splat(s, self.ball));
        let wide = ball + seen.error + seen.error;
        let misses = (wide * wide).less(seen.q.dot(seen.q)) | seen.nearest.less(-(wide + seen.error));
        let nothing = zero.less(zero);
        let none = Proposal { t: zero, error: zero, hit: nothing, undecided: nothing };
        if !(!misses).any() {
            return (none, U::splat(s, SIDE));
        }
        let side = self.side(s, &seen);
        let misses = misses | side.misses;
        if !(!misses).any() {
            return (none, U::splat(s, SIDE));
        }
        let (enters, by) = self.pass(s, &seen, &side, -1.0);
        let (leaves, _) = self.pass(s, &seen, &side, 1.0);
        let crosses = side.crosses & enters.known & leaves.known & !by;
        let ahead = crosses & enters.error.less(enters.t);
        let inside = crosses & enters.t.less(-enters.error) & leaves.error.less(leaves.t);
        let behind = crosses & leaves.t.less(-leaves.error);
        let passes = misses | (side.crosses & by) | behind;
        let hit = (ahead | inside) & !passes;
        let proposal = Proposal {
            t: F::pick(inside, leaves.t, enters.t),
            error: F::pick(inside, leaves.error, enters.error),
            hit,
            // Written so that NaN, from numbers beyond those of f32, stays in doubt.
            undecided: !passes & !hit,
        };
        (proposal, U::pick(inside, leaves.facet, enters.facet))
    }
}

/// How high the ends of a stretch lie, and bounds on their errors: without an end where rays are steep and begin or end beyond
/// what there is of the side. A steep ray that sees the side shrink begins endlessly far away.
#[inline(always)]
fn heights<S: Simd>(
    s: S,
    seen: &Seen<S>,
    [places, errors]: [[F<S>; 2]; 2],
    steep: M<S>,
    shrinks: M<S>,
) -> ([F<S>; 2], [F<S>; 2]) {
    let of = |v: f32| F::splat(s, v);
    let (zero, ever) = (of(0.0), of(f32::INFINITY));
    let rising = zero.less(seen.climb);
    let height = |i: usize, endless: M<S>, up: M<S>| {
        let there = places[i].mul_add(seen.climb, seen.height);
        F::pick(steep & endless, F::pick(up, ever, -ever), there)
    };
    let error = |i: usize, endless: M<S>| {
        let climbed = places[i].abs().mul_add(of(DIRECTION_ERROR), errors[i]);
        F::pick(steep & endless, zero, bound(s, seen.error.mul_add(of(ROUND_END_ERROR), climbed)))
    };
    let heights = [height(0, shrinks, !rising), height(1, !shrinks, rising)];
    (heights, [error(0, shrinks), error(1, !shrinks)])
}
