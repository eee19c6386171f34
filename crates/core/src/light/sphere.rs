//! Light from a sphere.

use std::f64::consts::PI;

use super::shining::{Lamp, Shining};
use super::{Arrival, Emitter, LightVisitor, nothing_arrives};
use crate::geometry::{Geometry, Sphere};
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Field, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// A sphere that shines to its outside.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereLight {
    surface: Sphere,
    shining: Shining,
}

impl SphereLight {
    /// A surface of one radiance, W/(m²·sr) per channel; [`with`](Part::with)`("power", …)` gives its power instead.
    ///
    /// # Errors
    /// A channel that is negative or not finite.
    pub fn new(surface: &Sphere, radiance: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&surface.values().with("radiance", Value::Color(radiance)))
    }

    /// Its surface.
    #[must_use]
    pub fn surface(&self) -> &Sphere {
        &self.surface
    }
}

impl Part for SphereLight {
    const NAME: &'static str = "sphere-light";
    const DOC: &'static str = "A sphere that shines to its outside.";
    const FIELDS: &'static [Field] = &[
        Sphere::FIELDS[0],
        Sphere::FIELDS[1],
        Shining::RADIANCE,
        Shining::POWER,
        Shining::VISIBLE,
        Shining::SHADOW,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let surface = Sphere::make(given)?;
        let shining = Shining::given(given, area(&surface), true)?;
        Ok(Self { surface, shining })
    }

    fn values(&self) -> Values {
        self.shining.add_to(self.surface.values())
    }
}

/// Square metres on each side.
fn area(surface: &Sphere) -> f64 {
    4.0 * PI * surface.radius() * surface.radius()
}

impl Emitter for SphereLight {
    /// Nothing arrives from one direction alone.
    #[inline(always)]
    fn arriving<L: Lane>(&self, point: Triple<L>) -> Arrival<L> {
        nothing_arrives(point)
    }

    #[inline(always)]
    fn accept(&self, _: impl LightVisitor) {}

    fn color(&self) -> &Constant3 {
        self.shining.radiance()
    }

    fn placed(&self, placement: &Placement) -> Self {
        let surface = self.surface.placed(placement);
        // A power that cannot be spread over what is left of the surface stays at the radiance it had.
        let shining = self.shining.clone().with_area(area(&surface)).unwrap_or_else(|_| self.shining.clone());
        Self { surface, shining }
    }

    fn lamp(&self) -> Option<Lamp> {
        Some(self.shining.on(self.surface.clone()))
    }

    fn equivalent(&self, field: &str) -> Option<Value> {
        self.shining.equivalent(field, area(&self.surface))
    }

    fn shadow(&self) -> bool {
        self.shining.shadow
    }
}
