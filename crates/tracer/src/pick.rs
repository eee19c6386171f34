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
#[must_use]
pub fn pick(snapshot: &Snapshot, view: &View, x: f64, y: f64) -> Option<Pick> {
    if view.size.pixels() == 0 {
        return None;
    }
    let ray = view.camera.ray(x, y, view.size.width, view.size.height);
    let hit = snapshot.nearest(&snapshot.own_ray(&ray), Span::AHEAD, None)?;
    let normal = hit.crossing.normal;
    Some(Pick {
        entity: snapshot.entities()[hit.surface.prim as usize],
        point: ray.at(hit.crossing.t),
        distance: hit.crossing.t * ray.direction.length(),
        normal: if normal.dot(ray.direction) > 0.0 { -normal } else { normal },
    })
}
