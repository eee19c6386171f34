//! Picks the entity and the point under a pixel of the picture.

use catoptra_core::glam::DVec3;
use catoptra_core::{EntityId, Span};

use crate::{Snapshot, View};

/// What a ray through a point of the picture meets first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pick {
    /// Which shape, or which light that is one.
    pub entity: EntityId,
    /// Where, in the world.
    pub point: DVec3,
    /// Metres from the eye.
    pub distance: f64,
    /// Unit normal, on the viewer's side.
    pub normal: DVec3,
}

/// What the ray through (x, y) meets, in pixels from the top left corner of the view's picture.
///
/// ```
/// use catoptra_core::{Camera, Rgb, Scene, geometry::Sphere, glam::DVec3, material::Matte};
/// use catoptra_tracer::{Pool, Size, Snapshot, View, pick};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut scene = Scene::new();
/// let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.5))?)?;
/// let ball = scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0)?, clay, None)?;
/// let view = View::new(Camera::look_at(DVec3::Z * 4.0, DVec3::ZERO, DVec3::Y, 0.8)?, Size::new(64, 48));
/// let picked = pick(&Snapshot::extract(&scene, &Pool::new(1)?), &view, 32.0, 24.0).ok_or("nothing there")?;
/// assert_eq!((picked.entity, picked.distance), (ball, 3.0));
/// # Ok(())
/// # }
/// ```
#[must_use]
pub fn pick(snapshot: &Snapshot, view: &View, x: f64, y: f64) -> Option<Pick> {
    if view.size.pixels() == 0 {
        return None;
    }
    let ray = view.camera.ray(x, y, view.size.width, view.size.height);
    let hit = snapshot.nearest_in_frame(&snapshot.own_ray(&ray), Span::AHEAD, None)?;
    let normal = hit.crossing.normal;
    Some(Pick {
        entity: snapshot.entities()[hit.surface.prim as usize],
        point: ray.at(hit.crossing.t),
        distance: hit.crossing.t * ray.direction.length(),
        normal: if normal.dot(ray.direction) > 0.0 { -normal } else { normal },
    })
}
