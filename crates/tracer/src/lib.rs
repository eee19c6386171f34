//! How a picture is traced: an immutable [`Snapshot`] of a scene, acceleration trees over it, backends that answer
//! what a ray meets, integrators over any of them, and the [`Film`] that holds the result.
//!
//! ```
//! use catoptra_core::{Camera, Rgb, Scene, geometry::Sphere, light::AmbientLight, material::Matte};
//! use catoptra_core::glam::DVec3;
//! use catoptra_tracer::{Control, Film, Pool, Size, Snapshot, View, backend_named, render};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut scene = Scene::new();
//! let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.5))?)?;
//! scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0)?, clay, None)?;
//! scene.add_light("sky", AmbientLight::new(Rgb::WHITE)?, None)?;
//! let camera = Camera::look_at(DVec3::Z * 4.0, DVec3::ZERO, DVec3::Y, 0.8)?;
//!
//! let view = View::new(camera, Size::new(32, 24));
//! let mut film = Film::new(view.size);
//! let backend = backend_named("wide").ok_or("no such backend")?;
//! let pool = Pool::new(1)?;
//! render(backend, &Snapshot::extract(&scene, &pool), &view, &mut film, &pool, &Control::default())?;
//! assert_eq!(film.radiance(16, 12), [0.5; 3]);
//! # Ok(())
//! # }
//! ```
#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test may stop at the first surprise"))]

mod accel;
pub mod backend;
mod caster;
mod cull;
mod display;
mod edges;
mod film;
mod filter;
mod frame;
mod instructions;
mod integrator;
mod irradiance;
mod kernel;
mod lamps;
mod lanes;
mod numeric;
mod pattern;
mod pick;
mod picture;
mod pool;
pub mod query;
#[cfg(test)]
mod random;
mod rays;
mod receiver;
mod render;
mod sample;
mod sampler;
mod search;
mod shade;
mod snapshot;
mod stats;
mod stream;
mod target;
mod view;

pub use accel::{MeshTree, Preset};
pub use backend::{Backend, backend_named, backends};
pub use caster::{
    Caster, CasterError, Coordinates, InvalidRay, InvalidRays, RayColumns, RayHits, WorldHit, WorldRay,
};
pub use catoptra_core::{Cancelled, Control, Progress};
pub use display::{Display, Tone};
pub use film::{Film, NoRoom, StoredFilmError, Tile};
pub use filter::Filter;
pub use frame::Frame;
pub use instructions::Instructions;
pub use irradiance::irradiance_at;
pub use pattern::Pattern;
pub use pick::{Pick, pick};
pub use picture::{Render, RenderError};
pub use pool::{NoPool, Pool};
pub use receiver::{InvalidReceiver, Irradiance, ProbeOptions, Receiver};
pub use render::render;
pub use snapshot::{
    Changed, Extraction, Hit, Needs, PartDiff, Presence, Prim, ShapeDiff, Snapshot, SnapshotDiff, SurfaceId,
};
pub use stats::{EdgePixels, ExactKinds, LampStats, Rays, Skipped, Stats, Tests};
pub use target::{Reached, Scale, Target, render_until};
pub use view::{Edges, LampLight, Moments, Region, Size, Skip, View};
