//! Which way do three points of a plane turn? Certain for any finite numbers.

use std::cmp::Ordering;

use catoptra_core::exact::{Bounded, Dyadic, Number, Verdict, decide};
use catoptra_core::glam::DVec2;
use catoptra_core::numeric::UNIT_ROUNDOFF_F64;

/// Error of `(b − a) × (c − a)`, relative to the sum of its two products: three roundings in each and one in their
/// difference (Shewchuk 1997), rounded up for the terms of higher order.
const ERROR: f64 = 4.0 * UNIT_ROUNDOFF_F64;

/// Products below this may have lost digits at the lower end of what `f64` can hold.
const SMALLEST: f64 = 1e-280;

/// `Greater` where `c` lies to the left of the line from `a` to `b`, `Less` to its right, `Equal` on it.
pub(super) fn turn(a: DVec2, b: DVec2, c: DVec2) -> Ordering {
    let [left, right] = products(a, b, c);
    let (difference, size) = (left - right, left.abs() + right.abs());
    if size > SMALLEST && difference.abs() > ERROR * size {
        return if difference > 0.0 { Ordering::Greater } else { Ordering::Less };
    }
    let decided = decide(|| turn_in::<Bounded>(a, b, c).map(Some), || turn_in::<Dyadic>(a, b, c).map(Some));
    decided.unwrap_or(Ordering::Equal)
}

/// Whether no point of a box lies on the line from `a` to `b` or to its left. Some boxes of which that is true are missed.
pub(super) fn is_right_of(a: DVec2, b: DVec2, [min, max]: [DVec2; 2]) -> bool {
    // Of all its points the one that lies furthest to the left.
    let x = if b.y > a.y { min.x } else { max.x };
    let y = if b.x > a.x { max.y } else { min.y };
    let [left, right] = products(a, b, DVec2::new(x, y));
    let size = left.abs() + right.abs();
    size > SMALLEST && left - right < -ERROR * size
}

fn products(a: DVec2, b: DVec2, c: DVec2) -> [f64; 2] {
    [(b.x - a.x) * (c.y - a.y), (b.y - a.y) * (c.x - a.x)]
}

fn turn_in<N: Number>(a: DVec2, b: DVec2, c: DVec2) -> Verdict<Ordering> {
    let between = |to: f64, from: f64| N::of(to).minus(&N::of(from));
    let [bx, by] = [between(b.x, a.x), between(b.y, a.y)];
    let [cx, cy] = [between(c.x, a.x), between(c.y, a.y)];
    N::compare_products([&bx, &cy], [&by, &cx])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_digit_decides() {
        let (a, b) = (DVec2::ZERO, DVec2::new(1e16, 3e16));
        let y = 0.75_f64;
        let cases = [(y.next_down(), Ordering::Less), (y, Ordering::Equal), (y.next_up(), Ordering::Greater)];
        for (y, is) in cases {
            assert_eq!(turn(a, b, DVec2::new(0.25, y)), is, "{y}");
        }
    }

    #[test]
    fn numbers_at_both_ends_of_the_range_are_told() {
        for size in [1e-200, 1.0, 1e200] {
            let [a, b, c] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|p| DVec2::from(p) * size);
            assert_eq!(turn(a, b, c), Ordering::Greater, "{size}");
            assert_eq!(turn(a, c, b), Ordering::Less, "{size}");
            assert_eq!(turn(a, b, b + b), Ordering::Equal, "{size}");
        }
    }

    #[test]
    fn boxes_with_a_point_on_the_line_are_not_to_its_right() {
        let (a, b) = (DVec2::new(0.1, 0.1), DVec2::new(0.7, 0.7));
        assert!(!is_right_of(a, b, [DVec2::new(0.3, 0.2), DVec2::new(0.4, 0.3)]));
        assert!(is_right_of(a, b, [DVec2::new(0.31, 0.2), DVec2::new(0.4, 0.3)]));
        assert!(!is_right_of(b, a, [DVec2::new(0.31, 0.2), DVec2::new(0.4, 0.3)]));
    }
}
