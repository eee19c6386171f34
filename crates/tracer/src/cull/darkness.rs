//! Which reflections go into darkness, found out before a single point is refined: where rays may meet a surface and
//! which ways they come tells which ways they may be sent on.

use catoptra_core::glam::DVec3;

use super::beam::Beam;
use super::point_bounds::PointBounds;
use crate::snapshot::{Columns, Row};

/// Whether no ray of a beam that meets a shape in a place meets anything once it is mirrored there.
pub(super) fn goes_dark(columns: &Columns, beam: &Beam, place: &PointBounds, outside: bool) -> bool {
    let dark = |normal, half| !beam.sent_on(place, normal, half).may_meet_any(columns, outside);
    match columns.rows[place.prim as usize] {
        Row::Plane(row) => dark(columns.planes[row as usize].normal, DVec3::ZERO),
        Row::Flat(row) => dark(columns.flats[row as usize].plane.normal, DVec3::ZERO),
        Row::Cuboid(row) => {
            let faces = &columns.cuboids[row as usize].faces;
            faces.iter().all(|face| dark(face.normal, DVec3::ZERO))
        }
        Row::Sphere(row) => {
            let sphere = &columns.spheres[row as usize];
            dark((place.center - sphere.center) / sphere.radius, place.half / sphere.radius)
        }
        Row::Triangles(first, count) => {
            let faces = &columns.triangles[first as usize..(first + count) as usize];
            faces.iter().all(|face| dark(face.plane.normal, DVec3::ZERO))
        }
        Row::Instance(_) | Row::General => false,
    }
}
