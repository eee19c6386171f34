//! Scenes of any size that tests, benches and the lab make for themselves: so many lights, spheres, instances, triangles.

mod icosphere;
mod many;
mod mesh;

use catoptra_core::{InvalidPart, SceneError};

pub use icosphere::{Triangles, icosphere};
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
