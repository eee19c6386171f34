//! How does a pattern of squares look on average, over what a pixel shows of it?
//!
//! A place in the pixel sees the number of squares u that a surface point is off the pattern's corner as a quotient of two
//! linear functions, so u = k is a straight line in the pixel for every k. Whether u is even or odd is a square wave, a sum of
//! jumps at these lines; the mean of the product of two such waves is a sum over pairs of lines of the area that lies beyond both,
//! which is exact on flat surfaces.

use crate::numeric::{LEAST_SLOPE, MOST_SQUARES};
use crate::{Lane, LaneMask, ShadingPoint, Triple};

/// What a camera's ray stands for: the square of the picture round it.
#[derive(Debug, Clone, Copy)]
pub struct Footprint<L: Lane> {
    /// The ray's unit direction.
    pub direction: Triple<L>,
    /// What the square's width and height to the right and down add to it; zero for a point.
    pub sides: [Triple<L>; 2],
}

/// A coordinate over the square, whose sides reach from −1/2 to 1/2: (at + slopes·p + at (bends·p)) / (1 + bends·p) at p.
#[derive(Clone, Copy)]
pub(crate) struct Coordinate<L: Lane> {
    pub(crate) at: L,
    pub(crate) slopes: [L; 2],
    pub(crate) bends: [L; 2],
}

/// A half-plane: where one + x p + y q ≥ 0.
#[derive(Clone, Copy)]
struct Half<L: Lane> {
    one: L,
    x: L,
    y: L,
    /// 1 / x and 1 / y.
    inverse: [L; 2],
}

impl<L: Lane> Footprint<L> {
    /// Two coordinates of the surface points that the square shows, given along one axis as the numbers at its middle and how
    /// many of them a metre is.
    #[inline(always)]
    pub(super) fn coordinates(&self, at: &ShadingPoint<L>, [x, z]: [L; 2], scale: L) -> [Coordinate<L>; 2] {
        let Self { direction, sides: [across, down] } = self;
        let inverse = at.distance.number(1.0) / at.normal.dot(*direction);
        let bends = [at.normal.dot(*across) * inverse, at.normal.dot(*down) * inverse];
        let far = at.distance * scale;
        let axis_x = (direction.x, [across.x, down.x]);
        let axis_z = (direction.z, [across.z, down.z]);
        [Coordinate::along(x, far, axis_x, bends), Coordinate::along(z, far, axis_z, bends)]
    }
}

impl<L: Lane> Coordinate<L> {
    /// That of one axis, on a surface that is so many squares away.
    #[inline(always)]
    fn along(at: L, far: L, (way, [right, below]): (L, [L; 2]), bends: [L; 2]) -> Self {
        let [x, y] = bends;
        Self { at, slopes: [far * (right - way * x), far * (below - way * y)], bends }
    }

    /// The first whole number that it reaches in the square, and how many; at most, and more than [`MOST_SQUARES`] where it
    /// has no end.
    #[inline(always)]
    fn jumps(&self) -> (L, L) {
        let (half, zero) = (self.at.number(0.5), self.at.number(0.0));
        let rest = self.at.number(1.0) - half_sum(self.bends, half);
        let most = self.at.number(f64::from(MOST_SQUARES));
        let reach = L::select(zero.less(rest), half_sum(self.slopes, half) / rest, most).min(most);
        let first = -(reach - self.at).floor();
        (first, -(-(self.at + reach)).floor() - first)
    }

    /// Where it is at least `k`.
    #[inline(always)]
    fn beyond(&self, k: L) -> Half<L> {
        let off = self.at - k;
        let x = off.mul_add(self.bends[0], self.slopes[0]);
        let y = off.mul_add(self.bends[1], self.slopes[1]);
        // In parts of the slope, and never without one.
        let (least, one) = (off.number(LEAST_SLOPE), off.number(1.0));
        let scale = one / (x.abs() + y.abs()).max(least);
        let (x, y) = (not_level(x * scale, least), not_level(y * scale, least));
        Half { one: off * scale, x, y, inverse: [one / x, one / y] }
    }
}

#[inline(always)]
fn half_sum<L: Lane>([x, y]: [L; 2], half: L) -> L {
    (x.abs() + y.abs()) * half
}

/// A slope, or the least one where there is less.
#[inline(always)]
fn not_level<L: Lane>(slope: L, least: L) -> L {
    L::select(slope.abs().less(least), least, slope)
}

/// −1 for odd whole numbers, 1 for even ones.
#[inline(always)]
fn sign<L: Lane>(whole: L) -> L {
    let half = whole * whole.number(0.5);
    L::select(whole.number(0.25).less(half - half.floor()), whole.number(-1.0), whole.number(1.0))
}

/// The mean over the square of (−1)^(⌊u⌋ + ⌊v⌋); 0 for more squares than can be told apart.
#[inline(always)]
pub(crate) fn mean_sign<L: Lane>(u: &Coordinate<L>, v: &Coordinate<L>) -> L {
    let (zero, one) = (u.at.number(0.0), u.at.number(1.0));
    let ((first_u, count_u), (first_v, count_v)) = (u.jumps(), v.jumps());
    let most = zero.number(f64::from(MOST_SQUARES) - 0.5);
    // Also where a count is NaN.
    let few = (count_u.max(one) * count_v.max(one)).less(most);
    let (count_u, count_v) = (L::select(few, count_u, zero), L::select(few, count_v, zero));
    let mut sum = one;
    if zero.less(count_u.max(count_v)).any() {
        let jumps = [(first_u, count_u), (first_v, count_v)];
        sum = if one.less(count_u.max(count_v)).any() {
            sum_of_many([u, v], jumps)
        } else {
            sum_of_two([u, v], jumps)
        };
    }
    let signs = sign(first_u - one) * sign(first_v - one);
    L::select(few, signs * sum, zero)
}

/// The mean where each coordinate jumps at most once, in parts of its sign before the jumps: the operations of
/// [`sum_of_many`], so that neighbours make no difference.
#[inline(always)]
fn sum_of_two<L: Lane>(
    [u, v]: [&Coordinate<L>; 2],
    [(first_u, count_u), (first_v, count_v)]: [(L, L); 2],
) -> L {
    let (zero, jump) = (u.at.number(0.0), u.at.number(-2.0));
    let (half_u, half_v) = (u.beyond(first_u), v.beyond(first_v));
    let (jumps_u, jumps_v) = (zero.less(count_u), zero.less(count_v));
    let sum = u.at.number(1.0) + L::select(jumps_v, jump * area(&half_v), zero);
    let common = jump * common_area(&half_u, &half_v);
    let within = area(&half_u) + L::select(jumps_u & jumps_v, common, zero);
    sum + L::select(jumps_u, jump * within, zero)
}

/// The same for any number of jumps.
#[inline(always)]
fn sum_of_many<L: Lane>(
    [u, v]: [&Coordinate<L>; 2],
    [(first_u, count_u), (first_v, count_v)]: [(L, L); 2],
) -> L {
    let (zero, two) = (u.at.number(0.0), u.at.number(2.0));
    let mut sum = u.at.number(1.0);
    let mut jump = -two;
    for j in 0..MOST_SQUARES {
        let number = zero.number(f64::from(j));
        let beyond = number.less(count_v);
        if !beyond.any() {
            break;
        }
        sum = sum + L::select(beyond, jump * area(&v.beyond(first_v + number)), zero);
        jump = -jump;
    }
    let mut jump_u = -two;
    for i in 0..MOST_SQUARES {
        let number = zero.number(f64::from(i));
        let beyond_u = number.less(count_u);
        if !beyond_u.any() {
            break;
        }
        let half_u = u.beyond(first_u + number);
        let mut within = area(&half_u);
        let mut jump_v = -two;
        for j in 0..MOST_SQUARES {
            let number = zero.number(f64::from(j));
            let both = beyond_u & number.less(count_v);
            if !both.any() {
                break;
            }
            let common = common_area(&half_u, &v.beyond(first_v + number));
            within = within + L::select(both, jump_v * common, zero);
            jump_v = -jump_v;
        }
        sum = sum + L::select(beyond_u, jump_u * within, zero);
        jump_u = -jump_u;
    }
    sum
}

/// The area of the square within a half-plane: a half and a strip, or all but a corner.
#[inline(always)]
fn area<L: Lane>(half: &Half<L>) -> L {
    let (x, y, off) = (half.x.abs(), half.y.abs(), half.one.abs());
    let [inverse_x, inverse_y] = [half.inverse[0].abs(), half.inverse[1].abs()];
    let (point_5, one) = (off.number(0.5), off.number(1.0));
    let strip = off.mul_add(inverse_x.min(inverse_y), point_5);
    // How far the line lies within the corner.
    let corner = ((x + y) * point_5 - off).max(off.number(0.0));
    let rest = one - (corner * inverse_x) * (corner * inverse_y) * point_5;
    let larger = L::select((x.min(y) + off + off).less(x.max(y)), strip, rest);
    L::select(half.one.less(off.number(0.0)), one - larger, larger)
}

/// The area of the square within two half-planes.
///
/// By Gauss, twice the area is the border's length times its distance from the middle: a half for the sides of the square, and
/// the line's own value there, times ∆t, for a line that is walked as p₀ + t (−y, x).
#[inline(always)]
fn common_area<L: Lane>(g: &Half<L>, h: &Half<L>) -> L {
    let half = g.one.number(0.5);
    let sides = (side(g, h, half, half) + side(g, h, -half, half)) * half;
    let least = half.number(LEAST_SLOPE);
    let turn = h.y.mul_add(g.x, -(h.x * g.y));
    let turn = half.number(1.0) / not_level(turn, least);
    (sides + along(g, h, turn) + along(h, g, -turn)) * half
}

/// How much of the sides of the square at x and at y = `at` lies within two half-planes.
#[inline(always)]
fn side<L: Lane>(g: &Half<L>, h: &Half<L>, at: L, half: L) -> L {
    let ([gx, gy], [hx, hy]) = (g.inverse, h.inverse);
    let level = length(half, [(at.mul_add(g.y, g.one), gx), (at.mul_add(h.y, h.one), hx)]);
    level + length(half, [(at.mul_add(g.x, g.one), gy), (at.mul_add(h.x, h.one), hy)])
}

/// How much of the stretch from −`half` to `half` keeps two linear functions, given as value and 1 over the slope, from being
/// negative.
#[inline(always)]
fn length<L: Lane>(half: L, [a, b]: [(L, L); 2]) -> L {
    let (from, to) = clipped((-half, half), a);
    let (from, to) = clipped((from, to), b);
    (to - from).max(half.number(0.0))
}

/// Where on a stretch a linear function is not negative.
#[inline(always)]
fn clipped<L: Lane>((from, to): (L, L), (value, inverse): (L, L)) -> (L, L) {
    let root = -(value * inverse);
    let rises = value.number(0.0).less(inverse);
    (L::select(rises, from.max(root), from), L::select(rises, to, to.min(root)))
}

/// Twice what the line of `g` adds to the area: its piece within the square and `h`, times its distance from the middle.
/// `turn` is 1 over how much `h` rises along the line.
#[inline(always)]
fn along<L: Lane>(g: &Half<L>, h: &Half<L>, turn: L) -> L {
    let (half, far) = (g.one.number(0.5), g.one.number(4.0));
    let share = -(g.one / g.x.mul_add(g.x, g.y * g.y));
    let (x, y) = (share * g.x, share * g.y);
    let ahead = h.x.mul_add(x, h.y.mul_add(y, h.one));
    let [across, down] = g.inverse;
    let (from, to) = clipped((-far, far), (x + half, -down));
    let (from, to) = clipped((from, to), (half - x, down));
    let (from, to) = clipped((from, to), (y + half, across));
    let (from, to) = clipped((from, to), (half - y, -across));
    let (from, to) = clipped((from, to), (ahead, turn));
    (to - from).max(half.number(0.0)) * g.one
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that look random, from −1 to 1 (xorshift, Marsaglia 2003).
    fn number(state: &mut u64) -> f64 {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn counted(u: &Coordinate<f64>, v: &Coordinate<f64>, steps: u32) -> f64 {
        let at = |c: &Coordinate<f64>, x: f64, y: f64| {
            let bend = c.bends[0] * x + c.bends[1] * y;
            (c.at + c.slopes[0] * x + c.slopes[1] * y + c.at * bend) / (1.0 + bend)
        };
        let mut sum = 0.0;
        for (i, j) in (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))) {
            let [x, y] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(steps) - 0.5);
            sum += sign(at(u, x, y).floor() + at(v, x, y).floor());
        }
        sum / f64::from(steps * steps)
    }

    #[test]
    fn means_are_those_of_many_points() {
        let mut state = 88_172_645_463_325_252;
        let mut number = || number(&mut state);
        for size in [0.1, 0.6, 2.0, 4.0] {
            for _ in 0..60 {
                let bends = [0.2 * number(), 0.2 * number()];
                let mut coordinate =
                    || Coordinate { at: 9.0 * number(), slopes: [size * number(), size * number()], bends };
                let (u, v) = (coordinate(), coordinate());
                let (found, right) = (mean_sign(&u, &v), counted(&u, &v, 600));
                if found == 0.0 {
                    assert!(right.abs() < 0.1, "{size}: {right}");
                    continue;
                }
                assert!((found - right).abs() < 6e-3 * (1.0 + size), "{size}: {found} {right}");
            }
        }
    }

    #[test]
    fn few_jumps_give_the_bits_of_many() {
        let mut state = 1_234_567;
        let mut number = || number(&mut state);
        for _ in 0..1000 {
            let bends = [0.1 * number(), 0.1 * number()];
            let mut coordinate =
                || Coordinate { at: number(), slopes: [0.4 * number(), 0.4 * number()], bends };
            let (u, v) = (coordinate(), coordinate());
            let jumps = [u.jumps(), v.jumps()];
            if jumps.iter().all(|(_, count)| *count <= 1.0) {
                let [few, many] = [sum_of_two([&u, &v], jumps), sum_of_many([&u, &v], jumps)];
                assert_eq!(few.to_bits(), many.to_bits());
            }
        }
    }

    #[test]
    fn lines_along_the_square_leave_no_doubt() {
        let flat = |at: f64, slopes: [f64; 2]| Coordinate { at, slopes, bends: [0.0; 2] };
        // A square of the pattern for every square of the picture, and half of one, right on the lines.
        for (at, right) in [(0.5, 1.0), (1.5, -1.0), (1.0, 0.0)] {
            let found = mean_sign(&flat(at, [1.0, 0.0]), &flat(0.5, [0.0, 1.0]));
            assert!((found - right).abs() < 1e-11, "{at}: {found}");
        }
        let point = mean_sign(&flat(2.5, [0.0; 2]), &flat(0.25, [0.0; 2]));
        assert!((point - 1.0).abs() < 1e-11, "{point}");
    }

    #[test]
    fn what_is_too_fine_or_has_no_end_is_grey() {
        let fine = Coordinate { at: 0.3, slopes: [50.0, 0.0], bends: [0.0; 2] };
        let endless = Coordinate { at: 0.3, slopes: [0.1, 0.0], bends: [2.0, 0.5] };
        for coordinate in [fine, endless] {
            assert_eq!(
                mean_sign(&coordinate, &Coordinate { slopes: [0.0, 50.0], ..coordinate }).to_bits(),
                0
            );
        }
    }
}
