//! Light from a flat rectangle.

use super::shining::{Lamp, Shining};
use super::{Arrival, Emitter, LightVisitor, nothing_arrives};
use crate::geometry::{Geometry, Rectangle};
use crate::lane::Constant3;
use crate::part::Given;
use crate::{Field, InvalidPart, Lane, Part, Placement, Rgb, Triple, Value, Values};

/// A rectangle that shines along edge-u × edge-v.
#[derive(Debug, Clone, PartialEq)]
pub struct RectangleLight {
    surface: Rectangle,
    shining: Shining,
}

impl RectangleLight {
    /// A surface of one radiance, W/(m²·sr) per channel; [`with`](Part::with)`("power", …)` gives its power instead.
    ///
    /// # Errors
    /// A channel that is negative or not finite.
    pub fn new(surface: &Rectangle, radiance: Rgb) -> Result<Self, InvalidPart> {
        crate::part::make(&surface.values().with("radiance", Value::Color(radiance)))
    }

    /// Its surface.
    #[must_use]
    pub fn surface(&self) -> &Rectangle {
        &self.surface
    }
}

impl Part for RectangleLight {
    const NAME: &'static str = "rectangle-light";
    const DOC: &'static str = "A rectangle that shines along edge-u × edge-v.";
    const FIELDS: &'static [Field] = &[
        Rectangle::FIELDS[0],
        Rectangle::FIELDS[1],
        Rectangle::FIELDS[2],
        Shining::RADIANCE,
        Shining::POWER,
        Shining::TWO_SIDED,
        Shining::VISIBLE,
        Shining::SHADOW,
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        let surface = Rectangle::make(given)?;
        let shining = Shining::given(given, area(&surface), false)?;
        Ok(Self { surface, shining })
    }

    fn values(&self) -> Values {
        self.shining.add_to(self.surface.values())
    }
}

/// Square metres on each side.
fn area(surface: &Rectangle) -> f64 {
    let [u, v] = surface.edges();
    u.length() * v.length()
}

impl Emitter for RectangleLight {
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
