//! How does the scene look?

use super::Pass;
use crate::lighting::Illumination;

pub(super) const PASS: Pass = Pass {
    name: "picture",
    doc: "The scene in its own light.",
    illumination: Illumination::Scene,
    integrator: None,
    paint: None,
};
