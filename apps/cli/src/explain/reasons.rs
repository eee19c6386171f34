//! Why were rays not traced, and how was light from surfaces found? The words for each count.

use catoptra_tracer::{LampStats, Skipped};

/// A reason for which rays were not traced: its words, and how many rays.
pub(super) type Reason = (&'static str, fn(&Skipped) -> u64);

/// Why a camera ray was not traced.
pub(super) const NO_PRIMARY_RAY: &[Reason] =
    &[("no shape can be seen through their part of the picture", |skipped| skipped.nothing_seen)];

/// Reasons against shadow rays.
pub(super) const NO_SHADOW_RAY: &[Reason] = &[
    ("the surface faces away from the light", |skipped| skipped.facing_away),
    ("the point lies outside the light's cone", |skipped| skipped.out_of_cone),
    ("their whole part of the picture lies outside the cone", |skipped| skipped.unreached),
    ("the light throws no shadows", |skipped| skipped.shadow_off),
    ("the material shows no light of its own", |skipped| skipped.unlit_material),
    ("nothing stands between the tile's surfaces and the light", |skipped| skipped.nothing_between),
];

/// Reasons against reflection rays.
pub(super) const NO_REFLECTION_RAY: &[Reason] = &[
    ("nothing but darkness lies ahead", |skipped| skipped.nothing_ahead),
    ("the surface does not reflect", |skipped| skipped.not_reflective),
    ("enough reflections one after another", |skipped| skipped.depth_limit),
    ("too faint to change the picture", |skipped| skipped.weight_cutoff),
];

/// Reasons against occlusion rays.
pub(super) const NO_OCCLUSION_RAY: &[Reason] =
    &[("they would go below the surface, to where a smooth normal leads", |skipped| skipped.below_surface)];

/// How the light of a lamp at a point was found: its words, and at how many points.
pub(super) type LampClass = (&'static str, fn(&LampStats) -> u64);

pub(super) const LAMP_CLASSES: &[LampClass] = &[
    ("see all of it: closed form", |lamps| lamps.open),
    ("see it past one ball: closed form", |lamps| lamps.past_a_ball),
    ("see some of it past other shapes, or several: closed form", |lamps| lamps.partly),
    ("see none of it past what stands between: closed form", |lamps| lamps.dark),
    ("face away from it, or it from them", |lamps| lamps.facing_away),
    ("ask by rays", |lamps| lamps.sampled),
];
