//! Round outlines: what curve do a sphere and a disk draw on the sphere of directions, and what is an arc's share of the
//! contour?
//!
//! Both are circles in space seen from the eye: a disk its rim, a sphere the circle where lines of sight touch it. The curve
//! is X(φ) = P + Q cos φ + R sin φ with P the middle, Q and R of the radius' length along e₁ and e₂, and e₁ along what of P
//! lies in the circle's plane. Then |X|² = A + B cos φ and n·(X × X′) = α + β cos φ + γ sin φ, so the integral of their
//! ratio is elementary. It is written with D = √(A² − B²) = |P − Q| |P + Q|, κ = B/(A + D) and
//! ψ = atan2(κ sin φ, 1 + κ cos φ), so that nothing cancels as B vanishes.

use std::f64::consts::PI;

use glam::DVec3;

use super::angle::{angle, log_ratio_over_difference};

/// A place on a circle: cosine and sine of its angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn {
    pub cos: f64,
    pub sin: f64,
}

impl Turn {
    /// Where angles begin.
    pub(super) const START: Self = Self { cos: 1.0, sin: 0.0 };

    /// Of a vector's direction in the plane; the start for zero.
    pub(super) fn of(x: f64, y: f64) -> Self {
        let length = (x * x + y * y).sqrt();
        if length > 0.0 { Self { cos: x / length, sin: y / length } } else { Self::START }
    }

    /// Grows with the angle, from 0 to 4 for a whole turn.
    #[inline]
    pub(super) fn key(self) -> f64 {
        let share = self.cos / (self.cos.abs() + self.sin.abs());
        if self.sin >= 0.0 { 1.0 - share } else { 3.0 + share }
    }

    /// Turned back and forth by another angle.
    #[inline]
    pub(super) fn around(self, by: Self) -> Arc {
        let (cc, ss) = (self.cos * by.cos, self.sin * by.sin);
        let (sc, cs) = (self.sin * by.cos, self.cos * by.sin);
        Arc { from: Self { cos: cc + ss, sin: sc - cs }, to: Self { cos: cc - ss, sin: sc + cs } }
    }

    /// The sine of the angle from here to another place.
    pub(super) fn cross(self, other: Self) -> f64 {
        self.cos * other.sin - self.sin * other.cos
    }
}

/// A piece of a circle, counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    pub from: Turn,
    pub to: Turn,
}

impl Arc {
    /// What it leaves of the circle.
    pub(super) fn rest(self) -> Self {
        Self { from: self.to, to: self.from }
    }

    /// Its length in radians, given how much the key grows along it, which tells almost nothing from almost a whole turn.
    #[inline]
    pub(super) fn length(self, keys: f64) -> f64 {
        let (sin, cos) =
            (self.from.cross(self.to), self.from.cos * self.to.cos + self.from.sin * self.to.sin);
        let short = angle(sin, cos);
        if (short < 0.0 && keys > 1.0) || keys > 3.0 && short < 1.0 { short + 2.0 * PI } else { short }
    }
}

/// How a circle lies to a half-space whose plane holds the eye.
#[derive(Debug, Clone, Copy)]
pub(super) enum Cut {
    Within,
    Outside,
    /// The arc within.
    Part(Arc),
}

/// A circle in space as seen from the eye, counter-clockwise as seen from outside the sphere of directions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Conic {
    /// From the eye to its middle.
    pub center: DVec3,
    /// Unit normal, away from the eye.
    pub axis: DVec3,
    pub radius: f64,
    /// Unit vectors in its plane.
    pub across: [DVec3; 2],
    /// Of a sphere: the cone of lines of sight is round.
    pub is_round: bool,
    integral: Integral,
}

impl Conic {
    /// The rim of a disk; `axis` is its unit normal, away from the eye.
    pub(super) fn rim(normal: DVec3, center: DVec3, axis: DVec3, radius: f64) -> Self {
        let along = (center - axis * axis.dot(center)).normalize_or_zero();
        let first = if along == DVec3::ZERO { axis.any_orthonormal_vector() } else { along };
        let second = axis.cross(first).normalize();
        Self::new(normal, [center, axis], radius, [second.cross(axis), second])
    }

    /// The outline of a sphere that does not hold the eye.
    pub(super) fn outline(normal: DVec3, center: DVec3, radius: f64) -> Self {
        let distance = center.length();
        let axis = center / distance;
        let (sin, cos) = (radius / distance, ((distance - radius) * (distance + radius)).sqrt() / distance);
        let first = axis.any_orthonormal_vector();
        let conic = Self::new(normal, [axis * cos, axis], sin, [first, axis.cross(first)]);
        Self { is_round: true, ..conic }
    }

    fn new(normal: DVec3, [center, axis]: [DVec3; 2], radius: f64, across: [DVec3; 2]) -> Self {
        let integral = Integral::new(normal, center, across.map(|e| e * radius));
        Self { center, axis, radius, across, is_round: false, integral }
    }

    /// The point at an angle, from the eye.
    #[inline]
    pub(super) fn at(&self, turn: Turn) -> DVec3 {
        self.center + (self.across[0] * turn.cos + self.across[1] * turn.sin) * self.radius
    }

    /// The angle at which a direction lies, as seen from the middle.
    pub(super) fn turn_of(&self, direction: DVec3) -> Turn {
        let y = direction * (self.axis.dot(self.center) / self.axis.dot(direction)) - self.center;
        Turn::of(self.across[0].dot(y), self.across[1].dot(y))
    }

    /// Where a plane through the eye cuts it.
    #[inline]
    pub(super) fn cut(&self, plane: DVec3) -> Cut {
        let middle = plane.dot(self.center);
        let (x, y) = (plane.dot(self.across[0]) * self.radius, plane.dot(self.across[1]) * self.radius);
        let reach2 = x * x + y * y;
        let reach = if middle * middle < reach2 { reach2.sqrt() } else { 0.0 };
        if !(middle.abs() < reach) {
            return if middle > 0.0 { Cut::Within } else { Cut::Outside };
        }
        let per = 1.0 / reach;
        let half = Turn { cos: -middle * per, sin: ((reach - middle) * (reach + middle)).sqrt() * per };
        Cut::Part(Turn { cos: x * per, sin: y * per }.around(half))
    }

    /// Twice an arc's share of the contour; `keys` as in [`Arc::length`].
    #[inline]
    pub(super) fn arc(&self, arc: Arc, keys: f64) -> f64 {
        self.integral.arc(arc, arc.length(keys))
    }

    /// Twice the whole curve's share of the contour.
    pub(super) fn whole(&self) -> f64 {
        let Integral { alpha, beta, kappa, d, .. } = self.integral;
        2.0 * PI / d * (alpha - beta * kappa)
    }
}

/// What the integral of n·(X × dX) / |X|² needs.
#[derive(Debug, Clone, Copy)]
struct Integral {
    alpha: f64,
    beta: f64,
    gamma: f64,
    a: f64,
    b: f64,
    d: f64,
    kappa: f64,
}

impl Integral {
    fn new(normal: DVec3, p: DVec3, [q, r]: [DVec3; 2]) -> Self {
        let (a, b) = (p.length_squared() + q.length_squared(), 2.0 * p.dot(q));
        let d = (p - q).length() * (p + q).length();
        let [alpha, beta, gamma] = [q.cross(r), p.cross(r), q.cross(p)].map(|v| normal.dot(v));
        Self { alpha, beta, gamma, a, b, d, kappa: b / (a + d) }
    }

    #[inline]
    fn arc(&self, Arc { from, to }: Arc, length: f64) -> f64 {
        let (cos, sin) = (to.cos - from.cos, to.sin - from.sin);
        if self.kappa == 0.0 {
            return (self.alpha * length + self.beta * sin - self.gamma * cos) / self.a;
        }
        let psi = |turn: Turn| angle(self.kappa * turn.sin, 1.0 + self.kappa * turn.cos);
        let turned = psi(to) - psi(from);
        let square = |turn: Turn| self.a + self.b * turn.cos;
        let plain = (length - 2.0 * turned) / self.d;
        let with_cos =
            (2.0 * self.a / (self.a + self.d) * (turned / self.kappa) - self.kappa * length) / self.d;
        let with_sin = -cos * log_ratio_over_difference(square(from), square(to), self.b * cos);
        self.alpha * plain + self.beta * with_cos + self.gamma * with_sin
    }
}
