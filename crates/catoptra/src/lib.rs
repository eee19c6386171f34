//! An exact ray tracer for the CPU, as one crate: scenes in code, text or model files, pictures of them, rays against meshes,
//! and light at points.
//!
//! ```
//! use catoptra::prelude::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut scene = Scene::new();
//! let clay = scene.add_material("clay", Matte::new(Rgb::new(0.8, 0.5, 0.3))?)?;
//! scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0)?, clay, None)?;
//! scene.add_light("lamp", PointLight::new(DVec3::splat(3.0), Rgb::grey(80.0))?, None)?;
//! scene.add_camera("eye", Camera::look_at(DVec3::Z * 4.0, DVec3::ZERO, DVec3::Y, 0.8)?, None)?;
//! let film = Render::new(&scene).size(64, 48).samples(4).run()?;
//! assert!(film.radiance(32, 24)[0] > 0.1);
//! # Ok(())
//! # }
//! ```
//!
//! | wanted | look at |
//! |---|---|
//! | a picture in one line, with progress and a way to stop | [`Render`], [`Control`] |
//! | a picture as a file | [`SaveFilm`] |
//! | pictures again and again while a scene changes | [`tracer::Snapshot`], [`tracer::render`], [`History`] |
//! | what rays meet: triangles, a mesh file, a scene | [`Caster`], [`files::model::read_mesh`] |
//! | the light that arrives at points | [`Caster::irradiance_at`], [`tracer::irradiance_at`] |
//! | scenes as text, models as scenes | [`files::load`], [`files::model`] |
//! | how far two pictures are apart | [`lab`]; [`Picture::try_from`](lab::Picture) a [`Film`] |
//! | colours that differ from place to place | [`texture`], [`Scene::add_texture`] |
//! | all fields of a shape, a material or a light | [`Part::with`], `catoptra_core::part` |
//!
//! The crates behind it stand here under their own names: [`core`] (scenes), [`tracer`] (rays, pictures), [`files`] (features
//! `files` and `text`) and [`lab`] (feature `lab`). Without default features scenes are made in code, and neither KDL nor a
//! decoder of pictures is built.
//!
//! **What is closed.** Shapes, materials, lights, textures, integrators and backends are lists within these crates: each kind has
//! code of its own in the tracer's inner loops, for all widths of vector registers. A new kind is one new file and a line in its
//! list there; it cannot be added from outside. Shapes that are not in the list go in as triangles ([`Caster::from_triangles`],
//! [`TriangleMesh`](core::TriangleMesh)). Enums that will grow are `#[non_exhaustive]`; structs of options, such as
//! [`View`](tracer::View), are filled in with `..` from their constructor.
//!
//! Conventions (metres, radians, linear light) stand at the head of [`core`].

pub mod prelude;
#[cfg(feature = "files")]
mod save;

pub use catoptra_core as core;
#[cfg(feature = "lab")]
pub use catoptra_lab as lab;
#[cfg(feature = "files")]
pub use catoptra_scene as files;
pub use catoptra_tracer as tracer;

pub use catoptra_core::{
    Camera, Cancelled, Control, Edit, EntityId, History, InvalidPart, MaterialId, Part, Placement, Rgb,
    Scene, SceneError, TextureId, geometry, glam, light, material, texture,
};
pub use catoptra_tracer::{
    Caster, CasterError, Coordinates, Film, InvalidRay, InvalidRays, NoPool, Pool, RayColumns, RayHits,
    Render, RenderError, WorldHit, WorldRay,
};
#[cfg(feature = "files")]
pub use save::{SaveFilm, SaveFilmError};
