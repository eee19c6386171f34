//! Do the bounds keep all that matters? Rays aimed at the very borders of what they let go, against the shapes' own exact
//! answers, and counts that show whether those borders were met at all.

mod beams;
mod darkness;
mod parts;
mod shafts;
mod stage;
mod visible;

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;

use super::{Candidates, Frustum, PointBounds};
use crate::snapshot::Row;
use crate::{Frame, Region, Snapshot, SurfaceId};

/// Whether a search among candidates would find a surface.
fn holds(candidates: &Candidates, snapshot: &Snapshot, surface: SurfaceId) -> bool {
    let columns = snapshot.columns();
    match columns.rows[surface.prim as usize] {
        Row::Plane(row) => candidates.planes.contains(&row),
        Row::General if columns.general_unbounded.contains(&surface.prim) => true,
        _ => {
            let face = |row: &u32| {
                let face = &columns.triangles[*row as usize];
                face.plane.prim == surface.prim && face.facet == surface.facet
            };
            candidates.tree || candidates.bounded.contains(&surface.prim) || candidates.faces.iter().any(face)
        }
    }
}

/// How far a point lies from the middle of bounds, in their half sizes: up to 1 within them.
fn depth_in(bounds: &PointBounds, point: DVec3) -> f64 {
    ((point - bounds.center) / bounds.half).abs().max_element()
}

/// A point as `f32` holds it.
fn narrowed(point: DVec3) -> DVec3 {
    DVec3::from(point.to_array().map(|x| f64::from(x as f32)))
}

/// The box round points as `f32` holds them.
fn narrow_box(points: impl IntoIterator<Item = DVec3>) -> Aabb {
    Aabb::of(points.into_iter().map(narrowed))
}

/// Of all shapes, what may be seen in a region.
fn seen_in(frame: &Frame<'_>, region: &Region) -> Candidates {
    let (mut all, mut seen) = (Candidates::default(), Candidates::default());
    let columns = frame.snapshot.columns();
    all.all(columns);
    seen.visible_through(&Frustum::new(frame, region), columns, &all, frame.outside_solids);
    seen
}
