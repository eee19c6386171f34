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
/// changes of its derivative it is monotonous, and so on down to a line.
fn roots(quartic: [f64; 5], ends: [f64; 2]) -> ([f64; 4], usize) {
    let mut stops = ([0.0; 4], 0);
    for degree in 1..=4_usize {
        // The derivative that is of this degree.
        let mut p = quartic;
        for taken in 0..4 - degree {
            for k in 0..4 - taken {
                p[k] = p[k + 1] * (k + 1) as f64;
            }
            p[4 - taken] = 0.0;
        }
        let p = &p[..=degree];
        let value = |t: f64| p.iter().rev().fold(0.0, |sum, c| sum * t + c);
        let mut found = ([0.0; 4], 0);
        let mut from = (-1.0, if degree == 4 { ends[0] } else { value(-1.0) });
        let last = (1.0, if degree == 4 { ends[1] } else { value(1.0) });
        let inner = stops.0.iter().take(stops.1).map(|&t| (t, value(t)));
        for to in inner.chain([last]) {
            if (from.1 > 0.0) != (to.1 > 0.0) {
                found.0[found.1] = bracketed(p, from, to);
                found.1 += 1;
            }
            from = to;
        }
        stops = found;
    }
    stops
}

/// How often a bracket is narrowed: Newton's steps settle within a few, and 60 halvings leave nothing of it.
const STEPS: usize = 60;

/// The one sign change between two places with different signs, by Newton's steps where they stay within, halving otherwise.
fn bracketed(p: &[f64], mut from: (f64, f64), mut to: (f64, f64)) -> f64 {
    let mut t = (from.0 + to.0) / 2.0;
    for _ in 0..STEPS {
        let (value, slope) =
            p.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * t + c, slope * t + value));
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
