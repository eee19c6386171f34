//! Where does a trigonometric polynomial of degree two change its sign?

use super::conic::Turn;

/// `constant + cos φ·cos + sin φ·sin + cos 2φ·cos2 + sin 2φ·sin2`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Wave {
    constant: f64,
    cos: f64,
    sin: f64,
    cos2: f64,
    sin2: f64,
}

/// At most four places, in no order.
pub(super) type Turns = ([Turn; 4], usize);

impl Wave {
    /// Adds `weight` times the square of `c + x cos φ + y sin φ`.
    pub(super) fn add_square(&mut self, weight: f64, [c, x, y]: [f64; 3]) {
        let (xx, yy) = (x * x / 2.0, y * y / 2.0);
        self.constant += weight * (c * c + xx + yy);
        self.cos += weight * 2.0 * c * x;
        self.sin += weight * 2.0 * c * y;
        self.cos2 += weight * (xx - yy);
        self.sin2 += weight * x * y;
    }

    /// A bound on its values.
    pub(super) fn size(&self) -> f64 {
        self.constant.abs() + self.cos.abs() + self.sin.abs() + self.cos2.abs() + self.sin2.abs()
    }

    /// An even number of places. With t = tan(φ/2) each half of the circle is a polynomial of degree four on −1..=1.
    pub(super) fn sign_changes(&self) -> Turns {
        let mut found = ([Turn::START; 4], 0);
        for side in [1.0, -1.0] {
            let (a, b, c) = (self.constant, self.cos * side, self.sin * side);
            let (d, e) = (self.cos2, self.sin2);
            let quartic = [a + b + d, 2.0 * c + 4.0 * e, 2.0 * a - 6.0 * d, 2.0 * c - 4.0 * e, a - b + d];
            // Where the halves meet both must see the same sign.
            let ends = [-side, side].map(|sin| 4.0 * (a + self.sin * sin - d));
            let (ts, count) = roots(quartic, ends);
            for t in &ts[..count] {
                let scale = side / (1.0 + t * t);
                if found.1 < 4 {
                    found.0[found.1] = Turn { cos: (1.0 - t) * (1.0 + t) * scale, sin: 2.0 * t * scale };
                    found.1 += 1;
                }
            }
        }
        found.1 -= found.1 % 2;
        found
    }
}

/// Sign changes of a polynomial, lowest coefficient first, on −1..=1, where it has the values `ends`: between the sign
/// changes of its derivative it is monotonous, and so is that between those of its own.
fn roots(p: [f64; 5], ends: [f64; 2]) -> ([f64; 4], usize) {
    let first = [p[1], 2.0 * p[2], 3.0 * p[3], 4.0 * p[4]];
    let (turns, count) = quadratic([first[1], 2.0 * first[2], 3.0 * first[3]]);
    let first_ends = [-1.0, 1.0].map(|t| horner(&first, t));
    let (stops, count) = between::<4, 3>(&first, &turns[..count], first_ends);
    between::<5, 4>(&p, &stops[..count], ends)
}

/// Sign changes of a polynomial on −1..=1 that is monotonous between the given places, which are in order.
fn between<const N: usize, const M: usize>(p: &[f64; N], stops: &[f64], ends: [f64; 2]) -> ([f64; M], usize) {
    let (mut found, mut count) = ([0.0; M], 0);
    let mut from = (-1.0, ends[0]);
    for k in 0..=stops.len() {
        let to = match stops.get(k) {
            Some(&t) => (t, horner(p, t)),
            None => (1.0, ends[1]),
        };
        if (from.1 > 0.0) != (to.1 > 0.0) {
            found[count] = bracketed(p, from, to);
            count += 1;
        }
        from = to;
    }
    (found, count)
}

#[inline]
fn horner<const N: usize>(p: &[f64; N], t: f64) -> f64 {
    let mut sum = p[N - 1];
    for k in (0..N - 1).rev() {
        sum = sum * t + p[k];
    }
    sum
}

/// Roots of a quadratic polynomial within −1..=1, in order.
fn quadratic([c, b, a]: [f64; 3]) -> ([f64; 2], usize) {
    let root2 = b * b - 4.0 * a * c;
    if !(root2 >= 0.0) {
        return ([0.0; 2], 0);
    }
    let q = -(b + root2.sqrt().copysign(b)) / 2.0;
    let (mut found, mut count) = ([0.0; 2], 0);
    for t in [q / a, c / q] {
        if t.abs() < 1.0 {
            found[count] = t;
            count += 1;
        }
    }
    found[..count].sort_unstable_by(f64::total_cmp);
    (found, count)
}

/// How often a bracket is narrowed: Newton's steps settle within a few, and 60 halvings leave nothing of it.
const STEPS: usize = 60;

/// The one sign change between two places with different signs, by Newton's steps where they stay within, halving otherwise.
fn bracketed<const N: usize>(p: &[f64; N], mut from: (f64, f64), mut to: (f64, f64)) -> f64 {
    let mut t = (from.0 + to.0) / 2.0;
    for _ in 0..STEPS {
        let (mut value, mut slope) = (p[N - 1], 0.0);
        for k in (0..N - 1).rev() {
            slope = slope * t + value;
            value = value * t + p[k];
        }
        if value == 0.0 {
            return t;
        }
        if (value > 0.0) == (from.1 > 0.0) {
            from = (t, value);
        } else {
            to = (t, value);
        }
        let newton = t - value / slope;
        let next = if from.0 < newton && newton < to.0 { newton } else { (from.0 + to.0) / 2.0 };
        if next == t {
            break;
        }
        t = next;
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Wave {
        fn at(&self, Turn { cos, sin }: Turn) -> f64 {
            let linear = self.constant + self.cos * cos + self.sin * sin;
            linear + self.cos2 * (cos - sin) * (cos + sin) + self.sin2 * 2.0 * sin * cos
        }
    }

    #[test]
    fn sign_changes_are_those_that_a_fine_grid_sees() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for _ in 0..2000 {
            let wave =
                Wave { constant: random(), cos: random(), sin: random(), cos2: random(), sin2: random() };
            let at = |i: i32| {
                let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 4000.0).sin_cos();
                wave.at(Turn { cos, sin })
            };
            let seen = (0..4000).filter(|&i| (at(i) > 0.0) != (at(i + 1) > 0.0)).count();
            let (turns, count) = wave.sign_changes();
            let touches = (0..4000).any(|i| at(i).abs() < 1e-5);
            assert!(count == seen || touches, "{wave:?} {count} {seen}");
            for turn in &turns[..count] {
                assert!(wave.at(*turn).abs() < 1e-14, "{wave:?} {turn:?}");
            }
        }
    }
}
