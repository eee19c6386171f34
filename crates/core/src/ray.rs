//! What is traced, over which stretch, and what it meets.

use std::cmp::Ordering;

use glam::{DVec2, DVec3};

use crate::exact::{Bounded, Dyadic, Located, Number, Root, Verdict, count_order, decide};

/// The half line `origin + t * direction`, t > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes; any length but zero, and `t` counts in that length.
    pub direction: DVec3,
}

impl Ray {
    /// From a point along a direction of any length.
    #[must_use]
    pub const fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction }
    }

    /// The point at parameter `t`.
    #[must_use]
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// Whether every coordinate is finite and the direction is not zero. Anything else crosses nothing.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.origin.is_finite() && self.direction.is_finite() && self.direction != DVec3::ZERO
    }
}

/// The stretch `min <= t <= max` of a ray; both ends belong to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Lower end.
    pub min: f64,
    /// Upper end.
    pub max: f64,
}

/// The least number above 0: a stretch from here on leaves out the origin and nothing else that `f64` can name.
const ABOVE_ZERO: f64 = f64::from_bits(1);

impl Span {
    /// Everything in front of the origin, but not the origin itself.
    pub const AHEAD: Self = Self::until(f64::INFINITY);

    /// Everything in front of the origin up to and including `max`, but not the origin itself.
    #[must_use]
    pub const fn until(max: f64) -> Self {
        Self { min: ABOVE_ZERO, max }
    }

    /// Everything between the origin and a light at t = 1; a surface at the light itself throws no shadow.
    pub const TO_LIGHT: Self = Self::until(1.0_f64.next_down());

    /// The origin and everything in front of it.
    pub const FROM_ORIGIN: Self = Self { min: 0.0, max: f64::INFINITY };

    /// Whether `t` lies on the stretch; never for NaN.
    #[must_use]
    pub fn contains(self, t: f64) -> bool {
        self.min <= t && t <= self.max
    }
}

/// Where a ray meets a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Ray parameter, in units of the ray's direction.
    pub t: f64,
    /// Bound on how far `t` is from where the crossing is exactly.
    pub error: f64,
    /// Unit geometric normal, on the shape's outer side (for open surfaces: the side the shape's definition names).
    pub normal: DVec3,
    /// Unit normal to shade with; differs from `normal` only on meshes with vertex normals.
    pub shading_normal: DVec3,
    /// Which flat piece of the shape was met: triangle of a mesh, face of a box; 0 for smooth shapes.
    pub facet: u32,
    /// Texture coordinates where they come with the crossing (rectangles, meshes), else zero; see
    /// [`Geometry::parametrization`](crate::Geometry::parametrization) for those of every shape.
    pub uv: DVec2,
}

impl Crossing {
    /// A crossing that shades with its geometric normal and has no texture coordinates.
    #[must_use]
    pub const fn flat(at: Located, normal: DVec3, facet: u32) -> Self {
        Self { t: at.t, error: at.error, normal, shading_normal: normal, facet, uv: DVec2::ZERO }
    }

    /// A `t` that the crossing does not lie beyond.
    #[must_use]
    pub fn latest(&self) -> f64 {
        (self.t + self.error).next_up()
    }

    /// How its position on the ray compares with that of another crossing; where the bounds of both overlap and they are not
    /// seen to be `together`, the roots of both are computed, in exact numbers last. `Equal` where a root is missing.
    #[must_use]
    pub fn order(
        &self,
        other: &Self,
        together: impl FnOnce() -> bool,
        bounded: impl FnOnce() -> [Verdict<Option<Root<Bounded>>>; 2],
        exact: impl FnOnce() -> [Verdict<Option<Root<Dyadic>>>; 2],
    ) -> Ordering {
        self.located().order(&other.located(), together, bounded, exact)
    }

    /// Where it is.
    const fn located(&self) -> Located {
        Located { t: self.t, error: self.error }
    }
}

impl Located {
    /// As [`Crossing::order`].
    pub(crate) fn order(
        &self,
        other: &Self,
        together: impl FnOnce() -> bool,
        bounded: impl FnOnce() -> [Verdict<Option<Root<Bounded>>>; 2],
        exact: impl FnOnce() -> [Verdict<Option<Root<Dyadic>>>; 2],
    ) -> Ordering {
        // Comparisons of rounded sums hold for the sums themselves, as rounding keeps order.
        if self.t + self.error < other.t - other.error {
            Ordering::Less
        } else if other.t + other.error < self.t - self.error {
            Ordering::Greater
        } else if together() {
            Ordering::Equal
        } else {
            order_of_roots(bounded, exact)
        }
    }
}

/// How two roots compare: in numbers with error bounds, and where those cannot decide, in exact ones. `Equal` where one
/// is missing.
pub fn order_of_roots(
    bounded: impl FnOnce() -> [Verdict<Option<Root<Bounded>>>; 2],
    exact: impl FnOnce() -> [Verdict<Option<Root<Dyadic>>>; 2],
) -> Ordering {
    let exact = || {
        count_order();
        compare(exact())
    };
    decide(|| compare(bounded()), exact).unwrap_or(Ordering::Equal)
}

/// How two roots compare, if there are two.
fn compare<N: Number>([a, b]: [Verdict<Option<Root<N>>>; 2]) -> Verdict<Option<Ordering>> {
    match (a?, b?) {
        (Some(a), Some(b)) => a.compare(&b).map(Some),
        _ => Ok(None),
    }
}
