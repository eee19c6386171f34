//! How is a picture asked for in one line?

use catoptra_core::{Camera, Integrator, Scene};

use crate::{
    Backend, Cancelled, Control, Film, NoPool, NoRoom, Pool, Size, Snapshot, View, backends, render,
};

/// A picture of a scene, by what the scene says and what is set here; [`run`](Self::run) traces it.
///
/// It is [`render`] with what most want: the scene's first camera, the default backend, the [shared pool](Pool::shared), 640 x 480
/// pixels. Whoever traces a scene more than once keeps a [`Snapshot`] and calls [`render`].
///
/// ```
/// use catoptra_core::{Camera, Rgb, Scene, geometry::Sphere, glam::DVec3, light::AmbientLight, material::Matte};
/// use catoptra_tracer::Render;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut scene = Scene::new();
/// let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.5))?)?;
/// scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0)?, clay, None)?;
/// scene.add_light("sky", AmbientLight::new(Rgb::WHITE)?, None)?;
/// scene.add_camera("eye", Camera::look_at(DVec3::Z * 4.0, DVec3::ZERO, DVec3::Y, 0.8)?, None)?;
/// let film = Render::new(&scene).size(32, 24).samples(4).run()?;
/// assert_eq!(film.radiance(16, 12), [0.5; 3]);
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
#[must_use = "a picture is traced by `run`"]
pub struct Render<'a> {
    scene: &'a Scene,
    size: Size,
    camera: Option<Camera>,
    samples: Option<u32>,
    integrator: Option<Integrator>,
    seed: u32,
    backend: Option<&'a dyn Backend>,
    pool: Option<&'a Pool>,
    control: Option<&'a Control>,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// Neither the scene nor the caller has a camera.
    #[error("the scene has no camera, and none is given")]
    NoCamera,
    /// The picture does not fit into memory.
    #[error(transparent)]
    NoRoom(#[from] NoRoom),
    /// The system gave no threads.
    #[error(transparent)]
    NoPool(#[from] NoPool),
    /// It was asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl<'a> Render<'a> {
    /// Of a scene, by its own settings.
    pub fn new(scene: &'a Scene) -> Self {
        Self {
            scene,
            size: Size::new(640, 480),
            camera: None,
            samples: None,
            integrator: None,
            seed: 0,
            backend: None,
            pool: None,
            control: None,
        }
    }

    /// So many pixels across and down.
    pub fn size(self, width: u32, height: u32) -> Self {
        Self { size: Size::new(width, height), ..self }
    }

    /// Seen from there, in the world, and not through the scene's first camera.
    pub fn camera(self, camera: Camera) -> Self {
        Self { camera: Some(camera), ..self }
    }

    /// So many samples a pixel, and not as many as the scene says; 0 counts as 1.
    pub fn samples(self, samples: u32) -> Self {
        Self { samples: Some(samples), ..self }
    }

    /// By another integrator than the scene says.
    pub fn integrator(self, integrator: Integrator) -> Self {
        Self { integrator: Some(integrator), ..self }
    }

    /// With other random choices.
    pub fn seed(self, seed: u32) -> Self {
        Self { seed, ..self }
    }

    /// By another [backend](backends) than the first of the list.
    pub fn backend(self, backend: &'a dyn Backend) -> Self {
        Self { backend: Some(backend), ..self }
    }

    /// On these threads.
    pub fn pool(self, pool: &'a Pool) -> Self {
        Self { pool: Some(pool), ..self }
    }

    /// Watched and perhaps stopped by it: first the building of trees, then the tracing.
    pub fn control(self, control: &'a Control) -> Self {
        Self { control: Some(control), ..self }
    }

    /// Builds the trees and traces the picture.
    ///
    /// # Errors
    /// No camera, a picture that does not fit into memory, a system that gives no threads, and [`Cancelled`].
    pub fn run(self) -> Result<Film, RenderError> {
        let unwatched = Control::default();
        let control = self.control.unwrap_or(&unwatched);
        let camera = match self.camera {
            Some(camera) => camera,
            None => {
                let main = self.scene.main_camera().and_then(|id| self.scene.world_camera(id));
                main.ok_or(RenderError::NoCamera)?
            }
        };
        let mut view = View { seed: self.seed, ..View::of(self.scene, camera, self.size) };
        view.samples = self.samples.unwrap_or(view.samples);
        view.integrator = self.integrator.unwrap_or(view.integrator);
        let mut film = Film::try_of_region(view.region(), Film::TILE)?;
        let pool = match self.pool {
            Some(pool) => pool,
            None => Pool::shared()?,
        };
        let preset = crate::Preset::default();
        let snapshot = Snapshot::extract_unless_cancelled(self.scene, preset, pool, control)?;
        render(self.backend.unwrap_or(backends()[0]), &snapshot, &view, &mut film, pool, control)?;
        Ok(film)
    }
}
