//! Scenes of any size that tests, benches and the lab make for themselves: so many lights, spheres, instances, triangles.

mod many;
mod mesh;

use catoptra_core::glam::DVec3;
use catoptra_core::light::SpotLight;
use catoptra_core::part::make;
use catoptra_core::{InvalidPart, Rgb, SceneError, Value, Values};

pub use many::{Reach, many_instances, many_lights, many_spheres};
pub use mesh::{ball_mesh, placed_mesh, placed_mesh_under_the_sun, wavy_ball};

/// A scene that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum NoScene {
    /// A part whose numbers are refused.
    #[error(transparent)]
    Part(#[from] InvalidPart),
    /// A part that the scene refuses.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// A spot light with full angles of its cones in radians, inner first.
///
/// # Errors
/// As of [`SpotLight`]'s fields.
pub fn spot(
    position: DVec3,
    direction: DVec3,
    intensity: Rgb,
    [inner, outer]: [f64; 2],
) -> Result<SpotLight, InvalidPart> {
    make(
        &Values::new()
            .with("position", Value::Vector(position))
            .with("direction", Value::Vector(direction))
            .with("intensity", Value::Color(intensity))
            .with("inner", Value::Number(inner))
            .with("outer", Value::Number(outer)),
    )
}
