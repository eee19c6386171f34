//! What one ray meets, in `f64`: by the trees, and by trying everything.

use catoptra_core::geometry::Mesh;
use catoptra_core::{Crossing, Ray, Shape, Span};

use super::Snapshot;

/// A place on a surface that a ray leaves from: that meeting is not found again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Which shape of the snapshot.
    pub prim: u32,
    /// Which flat piece of it; see [`Crossing::facet`].
    pub facet: u32,
}

/// What a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Where on which shape.
    pub place: Place,
    /// The crossing, relative to the snapshot's origin.
    pub crossing: Crossing,
}

impl Snapshot {
    /// What a ray meets first, found by the trees; ties go to the shape with the lower id.
    #[must_use]
    pub fn nearest(&self, ray: &Ray, span: Span, leaving: Option<Place>) -> Option<Hit> {
        let mut best = None;
        for &prim in &self.unbounded {
            best = closer(best, self.cross(prim, ray, within(span, best), leaving));
        }
        self.tree.walk(ray, within(span, best), |item| {
            best = closer(best, self.cross(self.bounded[item as usize], ray, within(span, best), leaving));
            within(span, best).max
        });
        best
    }

    /// Whether a ray meets anything on the stretch, found by the trees.
    #[must_use]
    pub fn occluded(&self, ray: &Ray, span: Span, leaving: Option<Place>) -> bool {
        if self.unbounded.iter().any(|&prim| self.cross(prim, ray, span, leaving).is_some()) {
            return true;
        }
        let mut found = false;
        self.tree.walk(ray, span, |item| {
            found = found || self.cross(self.bounded[item as usize], ray, span, leaving).is_some();
            if found { f64::NEG_INFINITY } else { span.max }
        });
        found
    }

    /// What a ray meets first, found by trying every shape and every triangle.
    #[must_use]
    pub fn nearest_of_all(&self, ray: &Ray, span: Span, leaving: Option<Place>) -> Option<Hit> {
        let crossings = (0..self.prims.len() as u32).map(|prim| {
            let crossing = self.prims[prim as usize].shape.cross(ray, span, facet_left(prim, leaving))?;
            Some(Hit { place: Place { prim, facet: crossing.facet }, crossing })
        });
        crossings.fold(None, closer)
    }

    /// Where a ray crosses one shape, or one facet of it: with a facet, a mesh is crossed in that triangle only.
    /// Other shapes answer with their nearest crossing, whichever facet it lies on.
    pub(crate) fn cross_part(
        &self,
        prim: u32,
        facet: Option<u32>,
        ray: &Ray,
        span: Span,
        leaving: Option<Place>,
    ) -> Option<Hit> {
        let (Some(facet), Some(mesh)) = (facet, self.mesh_at(prim)) else {
            return self.cross(prim, ray, span, leaving);
        };
        let place = Place { prim, facet };
        if leaving == Some(place) {
            return None;
        }
        mesh.cross_one(&mesh.own_ray(ray), span, facet).map(|crossing| Hit { place, crossing })
    }

    /// The mesh that a shape is, if it is one.
    pub(crate) fn mesh_at(&self, prim: u32) -> Option<&Mesh> {
        match &self.prims[prim as usize].shape {
            Shape::Mesh(mesh) => Some(mesh),
            _ => None,
        }
    }

    /// Where a ray crosses one shape; meshes by their tree.
    pub(crate) fn cross(&self, prim: u32, ray: &Ray, span: Span, leaving: Option<Place>) -> Option<Hit> {
        let row = &self.prims[prim as usize];
        let left = facet_left(prim, leaving);
        let crossing = match (&row.shape, row.mesh) {
            (Shape::Mesh(mesh), Some(tree)) => {
                let tree = &self.meshes[tree as usize].tree;
                let own = mesh.own_ray(ray);
                let mut best: Option<Crossing> = None;
                tree.walk(&own, span, |triangle| {
                    let far = best.map_or(span.max, |b| b.t);
                    if left != Some(triangle)
                        && let Some(c) = mesh.cross_one(&own, Span { max: far, ..span }, triangle)
                        && best.is_none_or(|b| (c.t, c.facet) < (b.t, b.facet))
                    {
                        best = Some(c);
                    }
                    best.map_or(span.max, |b| b.t)
                });
                best
            }
            (shape, _) => shape.cross(ray, span, left),
        }?;
        Some(Hit { place: Place { prim, facet: crossing.facet }, crossing })
    }
}

fn facet_left(prim: u32, leaving: Option<Place>) -> Option<u32> {
    leaving.filter(|place| place.prim == prim).map(|place| place.facet)
}

fn within(span: Span, best: Option<Hit>) -> Span {
    Span { max: best.map_or(span.max, |hit| hit.crossing.t), ..span }
}

/// The nearer of two hits; the lower shape where they tie.
fn closer(a: Option<Hit>, b: Option<Hit>) -> Option<Hit> {
    match (a, b) {
        (Some(a), Some(b)) => {
            let later = (b.crossing.t, b.place.prim) < (a.crossing.t, a.place.prim);
            Some(if later { b } else { a })
        }
        (a, b) => a.or(b),
    }
}
