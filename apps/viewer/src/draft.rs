//! How does a picture become cheap while it moves? Light from surfaces comes by a few rays and not in closed form, reflections
//! that add little are left out, and what is found by chance has few samples.

use catoptra_core::Integrator;
use catoptra_tracer::{LampLight, View};

/// Rays to a lamp in a draft: the fewest that the tracer sends.
const LAMP_RAYS: u32 = 4;

/// Rays that could add less than this share of what they meet are left out of a draft: of white, a step of 13 levels in 255.
const CUTOFF: f32 = 0.05;

/// Directions a pixel of a draft where each sees the sky or does not.
const OCCLUSION_SAMPLES: u32 = 4;

/// How well a frame is traced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quality {
    /// Fast, for what moves.
    Draft,
    /// As the picture stays.
    Full,
}

/// Whether a view has a draft: a path a pixel cannot be less.
pub(crate) fn has_draft(view: &View) -> bool {
    !(view.integrator == Integrator::Path && view.samples <= 1)
}

/// The draft of a view.
pub(crate) fn draft(view: View) -> View {
    let samples = match view.integrator {
        Integrator::Occlusion => view.samples.min(OCCLUSION_SAMPLES),
        Integrator::Whitted | Integrator::Path => 1,
    };
    View {
        lamp_light: LampLight::Rays,
        lamp_rays: view.lamp_rays.min(LAMP_RAYS),
        weight_cutoff: view.weight_cutoff.max(CUTOFF),
        ..view.with_samples(samples)
    }
}
