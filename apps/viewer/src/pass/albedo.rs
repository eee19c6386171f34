//! Which colours do surfaces have of their own? Shown by the tracer itself, in a light that is the same everywhere.

use catoptra_core::Integrator;

use super::Pass;
use crate::lighting::Illumination;

pub(super) const PASS: Pass = Pass {
    name: "albedo",
    doc: "The colour of each surface and its textures, in the same light everywhere; mirrors and glass are dark.",
    illumination: Illumination::Even,
    integrator: Some(Integrator::Whitted),
    paint: None,
};
