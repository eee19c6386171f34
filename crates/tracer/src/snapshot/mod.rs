//! Snapshots: a scene frozen into columns for tracing, relative to an origin of its own.

mod columns;
mod diff;
mod every;
mod extract;
mod extraction;
mod held;
mod index;
mod lamp_tree;
mod lamps;
mod lighting;
mod matter;
mod needs;
mod origin;
mod rows;
mod search;

use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Constant3, EntityId, Light, Material, Member, Ray, Rgb, Shape};

pub(crate) use columns::{Affine, Ball, Columns, Instance};
pub use diff::{Changed, PartDiff, Presence, ShapeDiff, SnapshotDiff};
pub use extraction::Extraction;
pub(crate) use extraction::OwnShape;
pub(crate) use lamp_tree::LampTree;
pub(crate) use lamps::{FlatLamp, LampRow, Lamps};
pub(crate) use lighting::{LightRow, MaterialRow};
pub(crate) use matter::{Matter, is_a_sheet};
pub use needs::Needs;
pub(crate) use rows::{KernelVisitor, Row};
pub use search::{Hit, SurfaceId};
pub(crate) use search::{RaySegment, leaving_facet};

use crate::accel::{MeshTree, Preset, Tree};
use extraction::Parts;
use index::Index;

/// One shape of a snapshot; its number is its index in the order of entity ids.
#[derive(Debug, Clone)]
pub struct Prim {
    /// The shape, placed in the snapshot's frame.
    pub shape: Shape,
    /// Index of its material in the snapshot.
    pub material: u32,
    /// Index of its mesh tree in the snapshot, if it is a mesh.
    pub mesh: Option<u32>,
    /// The solid that it is a part of, and which; only the solid's surface is met.
    pub member: Option<Member>,
    /// The shape that stands for the solid of which it is a part; itself where there is none.
    pub body: u32,
}

impl Prim {
    /// A box round what of it can be met; `None` where that has no end.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        self.member.as_ref().map_or_else(|| self.shape.bounds(), Member::bounds)
    }
}

/// A scene frozen for tracing. Never changes; share it by `Arc`.
///
/// ```
/// use catoptra_core::{Rgb, Scene, geometry::Sphere, glam::DVec3, material::Matte};
/// use catoptra_tracer::{Pool, Snapshot};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let (mut scene, pool) = (Scene::new(), Pool::new(1)?);
/// let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.5))?)?;
/// let before = Snapshot::extract(&scene, &pool);
/// scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0)?, clay, None)?;
/// // What no edit touched is taken over, and what differs is told.
/// let (after, difference) = Snapshot::after(&scene, &before, &pool);
/// assert_eq!((before.prims().len(), after.prims().len(), difference.shapes.len()), (0, 1, 1));
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Snapshot {
    origin: DVec3,
    frame: DVec3,
    prims: Vec<Prim>,
    entities: Arc<[EntityId]>,
    /// When an edit last touched each shape: [`Placed::touched`](catoptra_core::Placed::touched).
    touched: Vec<u64>,
    /// Shared with earlier snapshots of the same shapes.
    index: Arc<Index>,
    /// How trees over meshes are built.
    preset: Preset,
    /// What the scene has besides shapes, in the world.
    parts: Arc<Parts>,
    materials: Vec<Material>,
    lights: Vec<Light>,
    ambient: Rgb,
    background: Rgb,
    /// Ambient light and background.
    constants: [Constant3; 2],
    material_rows: Vec<MaterialRow>,
    light_rows: Vec<LightRow>,
    lamps: Lamps,
    matter: Matter,
    has_cones: bool,
    has_mirrors: bool,
}

impl Snapshot {
    /// The scene's [revision](catoptra_core::Scene::revision) when it was frozen.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.parts.revision
    }

    /// Where in the world the columns of the SIMD kernels have their zero, so that `f32` is spent on detail and not on
    /// distance.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// All shapes, in the order of their entities' ids.
    #[must_use]
    #[inline]
    pub fn prims(&self) -> &[Prim] {
        &self.prims
    }

    /// Which entity each shape belongs to.
    #[must_use]
    pub fn entities(&self) -> &Arc<[EntityId]> {
        &self.entities
    }

    /// All materials, for positions relative to the snapshot's origin.
    #[must_use]
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// All lights that shine from somewhere, in the snapshot's frame.
    #[must_use]
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// Radiance that arrives everywhere from everywhere.
    #[must_use]
    pub fn ambient(&self) -> Rgb {
        self.ambient
    }

    /// Radiance seen where a ray meets nothing.
    #[must_use]
    pub fn background(&self) -> Rgb {
        self.background
    }

    /// The meshes, each once.
    #[must_use]
    pub fn meshes(&self) -> &[Arc<MeshTree>] {
        &self.index.meshes
    }

    /// Where in the world the coordinates have their zero in which shapes and rays are compared: the
    /// [origin](Self::origin), where moving every shape there rounds nothing, else the world's own.
    #[must_use]
    pub fn frame(&self) -> DVec3 {
        self.frame
    }

    /// The origin in the snapshot's frame.
    pub(crate) fn origin_in_frame(&self) -> DVec3 {
        self.origin - self.frame
    }

    /// A ray of the world in the snapshot's frame, rounded.
    #[must_use]
    #[inline]
    pub fn own_ray(&self, ray: &Ray) -> Ray {
        Ray::new(ray.origin - self.frame, ray.direction)
    }

    /// The shapes as the SIMD kernels read them.
    #[inline]
    pub(crate) fn columns(&self) -> &Columns {
        &self.index.columns
    }

    /// The ambient light as a formula reads it.
    #[inline]
    pub(crate) fn ambient_light(&self) -> &Constant3 {
        &self.constants[0]
    }

    /// The background as a formula reads it.
    #[inline]
    pub(crate) fn background_light(&self) -> &Constant3 {
        &self.constants[1]
    }

    /// The materials as the SIMD backend reads them.
    #[inline]
    pub(crate) fn material_rows(&self) -> &[MaterialRow] {
        &self.material_rows
    }

    /// The lights as the SIMD backend reads them.
    #[inline]
    pub(crate) fn light_rows(&self) -> &[LightRow] {
        &self.light_rows
    }

    /// The surfaces that light others.
    #[inline]
    pub(crate) fn lamps(&self) -> &Lamps {
        &self.lamps
    }

    /// What lanes do not know of surfaces.
    #[inline]
    pub(crate) fn matter(&self) -> &Matter {
        &self.matter
    }

    /// Whether there are lights that do not shine everywhere.
    pub(crate) fn has_cones(&self) -> bool {
        self.has_cones
    }

    /// Whether there are materials that reflect.
    pub(crate) fn has_mirrors(&self) -> bool {
        self.has_mirrors
    }

    /// The tree over all bounded shapes; its items are indices into [`Columns::bounded`].
    pub(crate) fn tree(&self) -> &Tree {
        &self.index.tree
    }
}
