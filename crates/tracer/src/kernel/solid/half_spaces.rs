//! Where do lines run behind all of some planes?

use catoptra_core::{Arithmetic, Lane};
use fearless_simd::Simd;

use super::super::{PlaneRow, Rays, bound};
use super::stretch::{End, Stretch};
use crate::lanes::{F, M, U, splat3};
use crate::numeric::DIRECTION_ERROR;

/// Where lines come in, or go out, as far as planes have been looked at: at least and at most.
#[derive(Clone, Copy)]
struct Latest<S: Simd> {
    least: F<S>,
    most: F<S>,
    facet: U<S>,
    known: M<S>,
}

impl<S: Simd> Latest<S> {
    #[inline(always)]
    fn never(s: S) -> Self {
        let never = F::splat(s, f32::NEG_INFINITY);
        Self { least: never, most: never, facet: U::splat(s, 0), known: M::splat(s, false) }
    }

    /// With what another plane says: the later one counts.
    #[inline(always)]
    fn and(self, s: S, least: F<S>, most: F<S>, facet: u32) -> Self {
        let later = self.most.less(least);
        let sooner = most.less(self.least);
        Self {
            least: self.least.max(least),
            most: self.most.max(most),
            facet: U::pick(later, U::splat(s, facet), self.facet),
            known: later | (sooner & self.known),
        }
    }

    #[inline(always)]
    fn end(self, s: S) -> End<S> {
        let Self { least, most, facet, known } = self;
        // Room for the roundings of numbers that were found in different ways; what is infinite stays so.
        let [less, more] = [1.0 - DIRECTION_ERROR, 1.0 + DIRECTION_ERROR].map(|share| F::splat(s, share));
        End { least: (least * less).min(least * more), most: (most * less).max(most * more), facet, known }
    }
}

/// Where lines run on the inner side of all planes, whose numbers are their facets.
#[inline(always)]
pub(super) fn stretch<S: Simd>(s: S, planes: &[PlaneRow], rays: &Rays<S>) -> Stretch<S> {
    let (mut enters, mut leaves) = (Latest::never(s), Latest::never(s));
    for (plane, facet) in planes.iter().zip(0..) {
        let Behind { near, far } = behind(s, plane, rays);
        enters = enters.and(s, near[0], near[1], facet);
        // The soonest exit is the latest one on the line the other way.
        leaves = leaves.and(s, -far[1], -far[0], facet);
    }
    let (enters, leaves) = (enters.end(s), leaves.end(s));
    let leaves = End { least: -leaves.most, most: -leaves.least, ..leaves };
    Stretch::between(s, rays, [enters, leaves])
}

/// From where to where lines run behind a plane, at least and at most.
struct Behind<S: Simd> {
    near: [F<S>; 2],
    far: [F<S>; 2],
}

#[inline(always)]
fn behind<S: Simd>(s: S, plane: &PlaneRow, rays: &Rays<S>) -> Behind<S> {
    let of = |v: f32| F::splat(s, v);
    let (none, ever) = (of(0.0), of(f32::INFINITY));
    let slope = splat3(s, plane.normal32).dot(rays.direction);
    let (depth, error) = plane.behind(s, rays);
    let inverse = of(1.0) / slope;
    let place = depth * inverse;
    // Of slopes above four times their error, at least three quarters are left.
    let direction_error = bound(s, of(DIRECTION_ERROR));
    let off = place.abs().mul_add(direction_error, error) * (inverse.abs() * of(4.0 / 3.0));
    let steep = of(4.0 * DIRECTION_ERROR).less(slope.abs());
    let outwards = none.less(slope);
    let [least, most] = [place - off, place + off];
    let near = [F::pick(outwards, -ever, least), F::pick(outwards, -ever, most)];
    let far = [F::pick(outwards, least, ever), F::pick(outwards, most, ever)];
    // Rays along the plane stay on the side they begin on for as long as that takes to use up.
    let long = (depth.abs() - error) * of(1.0 / (6.0 * DIRECTION_ERROR));
    let (inside, outside) = (error.less(depth), depth.less(-error));
    let flat_near = [F::pick(outside, long, -ever), F::pick(inside, -long, ever)];
    let flat_far = [F::pick(inside, long, -ever), ever];
    let pick = |i: usize, steeply: &[F<S>; 2], flat: &[F<S>; 2]| F::pick(steep, steeply[i], flat[i]);
    Behind {
        near: [pick(0, &near, &flat_near), pick(1, &near, &flat_near)],
        far: [pick(0, &far, &flat_far), pick(1, &far, &flat_far)],
    }
}
