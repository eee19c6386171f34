//! Clips a triangle at a plane: boxes round the parts on either side, which are never too small.
//!
//! The part on one side is the convex hull of the corners there and of the two points where edges cross the plane, so a
//! box that holds those holds it. A crossing lies exactly in the plane; its other coordinates
//! y = a + (b − a) · (s − p) / (q − p) are computed in `f64` within [`CLIP_ERROR`] of |a| + |b| and rounded outwards.

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;

use super::Box32;
use crate::numeric::CLIP_ERROR;

/// Boxes round what of a triangle, whose corners `f32` holds, lies in a box: before a plane across an axis, and past
/// it. A box is empty only where nothing does; what lies in the plane is part of both.
pub(super) fn halves(corners: &[DVec3; 3], within: &Box32, axis: usize, at: f32) -> [Box32; 2] {
    let (mut before, mut past) = (Box32::EMPTY, Box32::EMPTY);
    let place = f64::from(at);
    for (p, q) in [(0, 1), (1, 2), (2, 0)].map(|(p, q)| (corners[p], corners[q])) {
        let corner = Box32::from(Aabb { min: p, max: p });
        if p[axis] <= place {
            before = before.union(&corner);
        }
        if p[axis] >= place {
            past = past.union(&corner);
        }
        if p[axis].min(q[axis]) < place && place < p[axis].max(q[axis]) {
            let crossing = crossing(p, q, axis, at);
            (before, past) = (before.union(&crossing), past.union(&crossing));
        }
    }
    [before.intersection(within), past.intersection(within)]
}

/// A box round the point where an edge crosses a plane between its ends.
fn crossing(p: DVec3, q: DVec3, axis: usize, at: f32) -> Box32 {
    let point = p + (q - p) * ((f64::from(at) - p[axis]) / (q[axis] - p[axis]));
    let error = CLIP_ERROR * (p.abs() + q.abs());
    let around = Box32::from(Aabb { min: point - error, max: point + error });
    let with_axis = |mut corner: [f32; 3]| {
        corner[axis] = at;
        corner
    };
    Box32 { min: with_axis(around.min), max: with_axis(around.max) }
}

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;

    use catoptra_core::exact::{Dyadic, Number};

    use super::*;
    use crate::random::Random;

    /// Thin or wide, small or far from zero.
    fn triangle(random: &mut Random) -> [[f32; 3]; 3] {
        let place = random.point() * [0.0, 1.0, 1e6][random.bits() as usize % 3];
        [(); 3].map(|()| {
            let size = [1e-30, 1e-3, 1.0, 1e10][random.bits() as usize % 4];
            (place + random.point() * size).as_vec3().to_array()
        })
    }

    fn around(corners: &[[f32; 3]; 3]) -> Box32 {
        corners.iter().fold(Box32::EMPTY, |b, p| b.union(&Box32 { min: *p, max: *p }))
    }

    fn wide(p: &[f32; 3]) -> DVec3 {
        DVec3::from_array(p.map(f64::from))
    }

    /// How the place where an edge crosses the plane `at` of the first axis compares with `y` along another, by exact
    /// arithmetic.
    fn compared([p, q]: [[f32; 3]; 2], axis: usize, at: f32, y: f32) -> Ordering {
        let [a, b, from, to, at, y] = [p[axis], q[axis], p[0], q[0], at, y].map(|v| Dyadic::of(f64::from(v)));
        let along = to.minus(&from);
        let rest = b.minus(&a).times(&at.minus(&from)).minus(&y.minus(&a).times(&along));
        if along.signum().is_lt() { rest.signum().reverse() } else { rest.signum() }
    }

    #[test]
    fn a_crossing_lies_within_its_box_which_is_hardly_larger() {
        let mut random = Random(3);
        let (mut tried, mut tight) = (0, 0);
        while tried < 20_000 {
            let [p, q, _] = triangle(&mut random);
            let at = p[0] + (q[0] - p[0]) * random.number().abs() as f32;
            if !(p[0].min(q[0]) < at && at < p[0].max(q[0])) {
                continue;
            }
            tried += 1;
            let found = crossing(wide(&p), wide(&q), 0, at);
            assert_eq!((found.min[0], found.max[0]), (at, at));
            for axis in 1..3 {
                let compared = |y: f32| compared([p, q], axis, at, y);
                let (low, high) = (found.min[axis], found.max[axis]);
                assert!(compared(low).is_ge() && compared(high).is_le(), "{p:?} {q:?} {at}");
                let (within, beyond) = (low.next_up().next_up(), high.next_down().next_down());
                tight += usize::from(compared(within).is_le() && compared(beyond).is_ge());
            }
        }
        assert!(tight > tried, "{tight} of {tried}");
    }

    #[test]
    fn both_halves_hold_all_points_of_a_triangle() {
        let mut random = Random(5);
        for _ in 0..20_000 {
            let corners = triangle(&mut random);
            let (whole, axis) = (around(&corners), random.bits() as usize % 3);
            let share = random.number().abs() as f32;
            let at = whole.min[axis] + (whole.max[axis] - whole.min[axis]) * share;
            let [before, past] = halves(&corners.map(|p| wide(&p)), &whole, axis, at);
            assert_eq!(whole.union(&before), whole);
            assert_eq!(whole.union(&past), whole);
            for p in corners {
                let holds = |b: &Box32| b.union(&Box32 { min: p, max: p }) == *b;
                assert!(p[axis] > at || holds(&before), "{corners:?} {axis} {at}");
                assert!(p[axis] < at || holds(&past), "{corners:?} {axis} {at}");
            }
        }
    }

    #[test]
    fn cutting_again_and_again_leaves_no_gap_and_no_slack() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut rest = around(&corners);
        for cut in 1..8 {
            let at = cut as f32 / 8.0;
            let [slice, next] = halves(&corners.map(|p| wide(&p)), &rest, 0, at);
            let high = 1.0 - (at - 0.125);
            assert_eq!((slice.min[0], slice.max[0]), (at - 0.125, at));
            assert!((slice.max[1] - at).abs() <= 1e-6 && slice.max[1] >= at, "{slice:?}");
            assert!((slice.max[2] - high).abs() <= 1e-6 && slice.max[2] >= high, "{slice:?}");
            rest = next;
        }
    }
}
