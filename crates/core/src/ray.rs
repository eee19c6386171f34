//! What is traced, over which stretch, and what it meets.

use glam::{DVec2, DVec3};

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

/// The stretch `min < t <= max` of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Open lower end.
    pub min: f64,
    /// Closed upper end.
    pub max: f64,
}

impl Span {
    /// Everything in front of the origin.
    pub const AHEAD: Self = Self { min: 0.0, max: f64::INFINITY };

    /// Everything in front of the origin up to and including `max`.
    #[must_use]
    pub const fn until(max: f64) -> Self {
        Self { min: 0.0, max }
    }

    /// Whether `t` lies on the stretch; never for NaN.
    #[must_use]
    pub fn contains(self, t: f64) -> bool {
        self.min < t && t <= self.max
    }
}

/// Where a ray meets a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Ray parameter, in units of the ray's direction.
    pub t: f64,
    /// Unit geometric normal, on the shape's outer side (for open surfaces: the side the shape's definition names).
    pub normal: DVec3,
    /// Unit normal to shade with; differs from `normal` only on meshes with vertex normals.
    pub shading_normal: DVec3,
    /// Which flat piece of the shape was met: triangle of a mesh, face of a box; 0 for smooth shapes.
    pub facet: u32,
    /// Texture coordinates; zero where the shape has none.
    pub uv: DVec2,
}

impl Crossing {
    /// A crossing that shades with its geometric normal and has no texture coordinates.
    #[must_use]
    pub const fn flat(t: f64, normal: DVec3, facet: u32) -> Self {
        Self { t, normal, shading_normal: normal, facet, uv: DVec2::ZERO }
    }
}

/// The nearer of two crossings; the first where they tie.
#[must_use]
pub fn nearer(a: Option<Crossing>, b: Option<Crossing>) -> Option<Crossing> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.t < a.t { b } else { a }),
        (a, b) => a.or(b),
    }
}
