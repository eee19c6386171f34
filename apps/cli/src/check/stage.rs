//! What do lints look at? A scene, its text, and what every camera of it sees.

use catoptra_core::material::Matte;
use catoptra_core::scene::Edit;
use catoptra_core::{Camera, EntityId, Ray, Rgb, Role, Scene};
use catoptra_scene::SceneFile;
use catoptra_tracer::{Backend, Caster, Pool, Size, Snapshot, SurfaceId, View, backends};
use miette::Result;

use crate::surfaces::Surfaces;

/// A scene as lints see it.
pub(super) struct Stage<'a> {
    pub(super) scene: &'a Scene,
    pub(super) file: &'a SceneFile,
    pub(super) caster: Caster,
    pub(super) pool: &'a Pool,
    pub(super) size: Size,
    pub(super) cameras: Vec<Camera>,
    /// What the rays through the middles of pixels meet, for all cameras.
    pub(super) seen: Vec<Sighting>,
}

/// A ray of the world, and what it meets first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sighting {
    pub(super) ray: Ray,
    pub(super) surface: SurfaceId,
    pub(super) t: f64,
}

impl<'a> Stage<'a> {
    pub(super) fn of(scene: &'a Scene, file: &'a SceneFile, size: Size, pool: &'a Pool) -> Result<Self> {
        let caster = Caster::of_snapshot(Snapshot::extract(scene, pool), scene);
        let cameras: Vec<Camera> = scene.world_cameras().into_iter().map(|camera| camera.part).collect();
        let backend: &dyn Backend = backends()[0];
        let mut seen = Vec::new();
        for camera in &cameras {
            let view = View::new(camera.clone(), size);
            let surfaces = Surfaces::seen(backend, caster.snapshot(), &view, pool)?;
            seen.extend(surfaces.sightings().map(|(ray, surface, t)| Sighting { ray, surface, t }));
        }
        Ok(Self { scene, file, caster, pool, size, cameras, seen })
    }

    pub(super) fn snapshot(&self) -> &Snapshot {
        self.caster.snapshot()
    }

    /// Which thing a shape of the snapshot is.
    pub(super) fn entity(&self, prim: u32) -> Option<EntityId> {
        self.snapshot().entities().get(prim as usize).copied()
    }

    /// Its name.
    pub(super) fn name(&self, id: EntityId) -> String {
        self.scene.name(id).unwrap_or_default()
    }

    /// The scene with no light but one; `None` where it cannot be.
    pub(super) fn lit_by(&self, light: EntityId) -> Option<Snapshot> {
        let mut alone = self.scene.clone();
        for other in self.scene.entities_of(Role::Light).filter(|other| *other != light).collect::<Vec<_>>() {
            alone.apply(Edit::Remove(other)).ok()?;
        }
        let shines = |material: &catoptra_core::Material| material.emission().is_some();
        for (id, ..) in self.scene.materials().filter(|(.., material)| shines(material)) {
            let dark = Matte::new(Rgb::BLACK).ok()?;
            alone.apply(Edit::Material(id, dark.into())).ok()?;
        }
        Some(Snapshot::extract(&alone, self.pool))
    }

    /// So many of what is seen, spread evenly over it.
    pub(super) fn some_seen(&self, most: usize) -> impl Iterator<Item = &Sighting> {
        self.seen.iter().step_by(self.seen.len().div_ceil(most).max(1))
    }
}
