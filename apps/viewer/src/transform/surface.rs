//! Where do things stand when they are dragged over surfaces, and what is aimed at? What lies under the pointer, but for the
//! things themselves.

use catoptra_core::glam::DVec3;
use catoptra_core::scene::EntityId;
use catoptra_core::{Aabb, Span};

use crate::viewer::Viewer;

/// How far from a surface a light is put, as a share of the size of all: on it, it would light nothing of it.
const CLEARANCE: f64 = 0.03;

/// Surfaces of the things themselves that are looked through.
const MOST: usize = 64;

/// How far the things go from where they took up `bounds`, or stood at `pivot` if they have none, so that they touch the
/// surface under a pixel; `None` where there is none.
pub(super) fn placed(
    viewer: &Viewer,
    ids: &[EntityId],
    (bounds, pivot): (Aabb, DVec3),
    pixel: (f64, f64),
) -> Option<DVec3> {
    let (point, normal) = under(viewer, ids, pixel)?;
    if bounds.is_empty() {
        let off = CLEARANCE * viewer.everything().size().length();
        return Some(point + normal * off - pivot);
    }
    // How far the box reaches against the normal.
    let reach = (0.5 * bounds.size()).dot(normal.abs());
    Some(point + normal * reach - bounds.centre())
}

/// The point under a pixel that a light is aimed at: on a surface, or as far away as `distance`.
pub(crate) fn aimed_at(viewer: &Viewer, light: EntityId, pixel: (f64, f64), distance: f64) -> DVec3 {
    let ray = viewer.camera.ray(pixel.0, pixel.1, viewer.size.0.max(1), viewer.size.1.max(1));
    let way = ray.direction.normalize_or_zero() * distance;
    under(viewer, &[light], pixel).map_or(ray.origin + way, |(point, _)| point)
}

/// The first surface under a pixel that is not of these things, with its normal on the side that is seen.
fn under(viewer: &Viewer, ids: &[EntityId], (x, y): (f64, f64)) -> Option<(DVec3, DVec3)> {
    let (snapshot, scene) = (viewer.latest.get(), viewer.document.scene());
    let ray = viewer.camera.ray(x, y, viewer.size.0.max(1), viewer.size.1.max(1));
    let own = snapshot.own_ray(&ray);
    let mut span = Span::AHEAD;
    for _ in 0..MOST {
        let hit = snapshot.nearest_in_frame(&own, span, None)?;
        let entity = snapshot.entities()[hit.surface.prim as usize];
        if !ids.iter().any(|id| scene.lies_in(entity, *id)) {
            let normal = hit.crossing.normal;
            let side = if normal.dot(ray.direction) > 0.0 { -1.0 } else { 1.0 };
            return Some((ray.at(hit.crossing.t), normal * side));
        }
        span = Span { min: hit.crossing.t.next_up(), max: span.max };
    }
    None
}
