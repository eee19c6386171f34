//! Which reflections go into darkness, found out before a single point is settled: where rays may meet a surface and
//! which ways they come tells which ways they may be sent on.

use catoptra_core::Rgb;
use catoptra_core::glam::DVec3;
use fearless_simd::Simd;

use super::Tracer;
use super::beam::Beam;
use super::plan::{Place, Shapes};
use super::search::FEW;
use crate::lanes::{M, U};
use crate::snapshot::{Columns, Row};

impl<S: Simd> Tracer<'_, S> {
    /// Finds the shapes that send on all rays of some beams into darkness, of those whose places are known.
    pub(super) fn plan_darkness(&mut self, beams: &[Beam], shapes: &Shapes) {
        self.dark.clear();
        let (snapshot, columns) = (self.frame.snapshot, self.frame.snapshot.columns());
        let plain = columns.general_unbounded.is_empty() && columns.bounded.len() <= FEW;
        if !self.frame.view.skip.beams || !plain || snapshot.background() != Rgb::BLACK {
            return;
        }
        for place in &shapes.places {
            let material = snapshot.prims()[place.prim as usize].material;
            if snapshot.material_rows()[material as usize].reflects && !self.dark.contains(&place.prim) {
                self.dark.push(place.prim);
            }
        }
        let (places, outside) = (&shapes.places, self.outside);
        self.dark.retain(|&prim| {
            let own = || places.iter().filter(|place| place.prim == prim);
            beams.iter().all(|beam| own().all(|place| goes_dark(columns, beam, place, outside)))
        });
    }

    /// The lanes whose reflected rays may meet anything; others are counted.
    #[inline(always)]
    pub(super) fn lead_on(&mut self, lanes: M<S>, prims: U<S>) -> M<S> {
        let mut on = lanes;
        for &prim in &*self.dark {
            on = on & !prims.is(prim);
        }
        self.stats.skipped.nothing_ahead += lanes.count() - on.count();
        on
    }
}

/// Whether no ray of a beam that meets a shape in a place meets anything once it is mirrored there.
fn goes_dark(columns: &Columns, beam: &Beam, place: &Place, outside: bool) -> bool {
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
