//! What is asked about: a ray of the world, how much of it counts, and what it leaves.

use catoptra_core::glam::DVec3;
use catoptra_core::{EntityId, Ray, Span};

use super::InvalidRay;
use crate::SurfaceId;

/// A ray of the world that has been checked. All that lies in front of its origin counts, but not the origin itself.
///
/// ```
/// use catoptra_tracer::{InvalidRay, WorldRay};
///
/// let ray = WorldRay::new([0.0, 0.0, 5.0], [0.0, 0.0, -2.0])?.within([0.0, 1.0])?;
/// assert_eq!(ray.at(1.0).z, 3.0);
/// assert_eq!(WorldRay::new([0.0; 3], [0.0; 3]), Err(InvalidRay::NoDirection));
/// # Ok::<(), InvalidRay>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorldRay {
    ray: Ray,
    span: Span,
    leaving: Leaving,
}

/// What a ray leaves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Leaving {
    pub(super) surface: Option<SurfaceId>,
    pub(super) entity: Option<EntityId>,
}

impl WorldRay {
    /// From a point in metres, along a direction of any length but zero; `t` counts in that length.
    ///
    /// # Errors
    /// Numbers that are not finite, and a direction of zero.
    pub fn new(origin: impl Into<DVec3>, direction: impl Into<DVec3>) -> Result<Self, InvalidRay> {
        Ok(Self::of_parts(checked_line(origin.into(), direction.into())?, Span::AHEAD, Leaving::default()))
    }

    /// Of parts that have been checked.
    pub(super) fn of_parts(ray: Ray, span: Span, leaving: Leaving) -> Self {
        Self { ray, span, leaving }
    }

    /// The same ray, of which only `min <= t <= max` counts; what lies behind the origin never does.
    ///
    /// # Errors
    /// Ends that are no numbers, not in order, or both behind the origin.
    pub fn within(self, ends: [f64; 2]) -> Result<Self, InvalidRay> {
        Ok(Self { span: checked_span(ends)?, ..self })
    }

    /// The same ray, leaving the surface that its origin lies on but for rounding: it does not meet that again there, nor triangles of
    /// the same mesh in the same plane. A ball or another convex solid that it leaves outwards it does not meet at all.
    #[must_use]
    pub fn leaving(self, surface: SurfaceId) -> Self {
        Self { leaving: Leaving { surface: Some(surface), ..self.leaving }, ..self }
    }

    /// The same ray, leaving a whole entity: it meets that nowhere, nor meshes of the same triangles that stand in its place.
    #[must_use]
    pub fn leaving_entity(self, entity: EntityId) -> Self {
        Self { leaving: Leaving { entity: Some(entity), ..self.leaving }, ..self }
    }

    /// The point at `t`, metres.
    #[must_use]
    pub fn at(&self, t: f64) -> DVec3 {
        self.ray.at(t)
    }

    /// Its line.
    #[must_use]
    pub fn ray(&self) -> Ray {
        self.ray
    }

    /// What of it counts.
    #[must_use]
    pub fn span(&self) -> Span {
        self.span
    }

    /// The surface that it leaves.
    #[must_use]
    pub fn surface_left(&self) -> Option<SurfaceId> {
        self.leaving.surface
    }

    /// The entity that it leaves.
    #[must_use]
    pub fn entity_left(&self) -> Option<EntityId> {
        self.leaving.entity
    }
}

/// A line, if it is one. Inlined: it is asked of millions.
#[inline(always)]
pub(super) fn checked_line(origin: DVec3, direction: DVec3) -> Result<Ray, InvalidRay> {
    if !(origin.is_finite() && direction.is_finite()) {
        return Err(InvalidRay::NotFinite);
    }
    if direction == DVec3::ZERO {
        return Err(InvalidRay::NoDirection);
    }
    Ok(Ray::new(origin, direction))
}

/// What of a ray counts between two ends.
#[inline(always)]
pub(super) fn checked_span([min, max]: [f64; 2]) -> Result<Span, InvalidRay> {
    if !(min <= max && max >= 0.0) {
        return Err(InvalidRay::Ends(min, max));
    }
    Ok(Span { min: min.max(0.0), max })
}
