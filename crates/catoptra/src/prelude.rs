//! What most programs name: `use catoptra::prelude::*;`.
//!
//! ```
//! use catoptra::prelude::*;
//!
//! let lamp = SpotLight::new(DVec3::Y * 3.0, DVec3::NEG_Y, Rgb::grey(60.0), [0.4, 0.7])?.with_falloff(2.0)?;
//! let floor = Checker::new(Rgb::WHITE, Rgb::grey(0.2), 2.0)?.with("reflectiveness", 0.1)?;
//! # let _ = (lamp, floor);
//! # Ok::<(), InvalidPart>(())
//! ```

pub use catoptra_core::geometry::*;
pub use catoptra_core::glam::{DVec2, DVec3};
pub use catoptra_core::light::*;
pub use catoptra_core::material::*;
pub use catoptra_core::texture::{
    BrickTexture, CheckerTexture, ImageTexture, Level, MarbleTexture, NoiseTexture, Paint, Texture,
    VertexColorTexture,
};
pub use catoptra_core::{
    Camera, Cancelled, Control, Edit, EntityId, History, ImageSource, Integrator, InvalidPart, MaterialId,
    MeshSource, Node, Part, Placement, Rgb, Scene, SceneError, TextureId,
};
pub use catoptra_tracer::{
    Caster, Film, Irradiance, Pool, ProbeOptions, RayColumns, Receiver, Render, Size, Snapshot, Tone, View,
    WorldHit, WorldRay, backends, render,
};

#[cfg(feature = "files")]
pub use crate::SaveFilm;
