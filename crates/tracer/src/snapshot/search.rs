//! What one ray meets, for certain: by the trees, and by trying everything.

use std::cmp::Ordering;

use catoptra_core::exact::{Dyadic, Root};
use catoptra_core::geometry::Mesh;
use catoptra_core::{Crossing, Geometry, Ray, Shape, Span};

use super::Snapshot;
use crate::accel::Tree;

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
        let way = Way { ray, span, leaving };
        let mut best = None;
        for &prim in &self.unbounded {
            best = self.closer(&way, best, self.cross(prim, ray, within(span, best), leaving));
        }
        self.tree.walk(ray, within(span, best), |item| {
            let hit = self.cross(self.bounded[item as usize], ray, within(span, best), leaving);
            best = self.closer(&way, best, hit);
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
        let way = Way { ray, span, leaving };
        (0..self.prims.len() as u32).fold(None, |best, prim| {
            let crossing =
                self.prims[prim as usize].shape.cross(ray, within(span, best), facet_left(prim, leaving));
            let hit = crossing.map(|crossing| Hit { place: Place { prim, facet: crossing.facet }, crossing });
            self.closer(&way, best, hit)
        })
    }

    /// The nearer of two hits of one ray; the lower shape where they tie.
    fn closer(&self, way: &Way<'_>, a: Option<Hit>, b: Option<Hit>) -> Option<Hit> {
        match (a, b) {
            (Some(a), Some(b)) => Some(if self.precedes(way, &b, &a) { b } else { a }),
            (a, b) => a.or(b),
        }
    }

    /// Whether a ray meets one hit before another: exactly, and of hits in one place that with the lower shape, then the
    /// lower facet.
    pub(crate) fn precedes(&self, way: &Way<'_>, a: &Hit, b: &Hit) -> bool {
        let order = a.crossing.order(&b.crossing, || [a, b].map(|hit| self.root(way, hit.place)));
        match order {
            Ordering::Equal => (a.place.prim, a.place.facet) < (b.place.prim, b.place.facet),
            order => order.is_lt(),
        }
    }

    fn root(&self, way: &Way<'_>, place: Place) -> Option<Root<Dyadic>> {
        let shape = &self.prims[place.prim as usize].shape;
        shape.root(place.facet, way.ray, way.span, facet_left(place.prim, way.leaving))
    }

    /// Where a ray crosses one shape, or the facet of it alone where it is made of facets.
    pub(crate) fn cross_part(
        &self,
        prim: u32,
        facet: Option<u32>,
        ray: &Ray,
        span: Span,
        leaving: Option<Place>,
    ) -> Option<Hit> {
        let Some(facet) = facet else {
            return self.cross(prim, ray, span, leaving);
        };
        let shape = &self.prims[prim as usize].shape;
        let crossing = shape.cross_part(facet, ray, span, facet_left(prim, leaving))?;
        Some(Hit { place: Place { prim, facet: crossing.facet }, crossing })
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
                cross_mesh(mesh, tree, &mesh.own_ray(ray), span, left)
            }
            (shape, _) => shape.cross(ray, span, left),
        }?;
        Some(Hit { place: Place { prim, facet: crossing.facet }, crossing })
    }
}

/// What is asked of a ray.
#[derive(Clone, Copy)]
pub(crate) struct Way<'a> {
    pub(crate) ray: &'a Ray,
    pub(crate) span: Span,
    pub(crate) leaving: Option<Place>,
}

/// The nearest crossing of a ray in a mesh's own space with its triangles; of crossings in one place, that of the lowest.
fn cross_mesh(mesh: &Mesh, tree: &Tree, own: &Ray, span: Span, left: Option<u32>) -> Option<Crossing> {
    let mut best: Option<Crossing> = None;
    tree.walk(own, span, |triangle| {
        let far = |best: Option<Crossing>| best.map_or(span.max, |b| b.latest().min(span.max));
        let within = Span { max: far(best), ..span };
        if let Some(next) = mesh.cross_piece(triangle, own, within, left) {
            let root = |crossing: &Crossing| mesh.root(crossing.facet, own, span, left);
            let precedes = |b: Crossing| match next.order(&b, || [root(&next), root(&b)]) {
                Ordering::Equal => next.facet < b.facet,
                order => order.is_lt(),
            };
            if best.is_none_or(precedes) {
                best = Some(next);
            }
        }
        far(best)
    });
    best
}

fn facet_left(prim: u32, leaving: Option<Place>) -> Option<u32> {
    leaving.filter(|place| place.prim == prim).map(|place| place.facet)
}

/// The stretch up to the latest place at which what has been found may lie.
fn within(span: Span, best: Option<Hit>) -> Span {
    Span { max: best.map_or(span.max, |hit| hit.crossing.latest().min(span.max)), ..span }
}
