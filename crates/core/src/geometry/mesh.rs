//! A triangle mesh standing somewhere.

use std::sync::Arc;

use glam::DVec3;

use super::crossings::Crossings;
use super::parametrization::{BARYCENTRIC, in_triangle};
use super::subdivision::MOST_LEVELS;
use super::triangle::{area, meet_together, meet_triangle, met_beside, unit_normal, weights};
use super::{FacetRoot, Geometry, Parametrization};
use crate::exact::{Located, Number, Vector, Verdict};
use crate::part::Given;
use crate::solid::Passage;
use crate::{
    Aabb, Crossing, Field, FieldKind, InvalidPart, MeshSource, Part, Placement, Ray, Rgb, Span, TriangleMesh,
    Value, Values,
};

/// A mesh from a file; its triangles are stored once, however many instances it has.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    source: MeshSource,
    /// How often its triangles are cut.
    subdivision: u32,
    triangles: Arc<TriangleMesh>,
    to_world: Placement,
    to_object: Placement,
}

impl Mesh {
    /// An instance where the file has it.
    #[must_use]
    pub fn new(source: MeshSource) -> Self {
        let to_world = Placement::offset(source.mesh.offset());
        let triangles = Arc::clone(&source.mesh);
        Self { source, subdivision: 0, triangles, to_world, to_object: to_world.inverse() }
    }

    /// With its triangles [cut](TriangleMesh::subdivided) that often.
    #[must_use]
    pub fn subdivided(self, levels: u32) -> Self {
        let triangles = self.source.mesh.subdivided(levels);
        let triangles = triangles.unwrap_or_else(|| Arc::clone(&self.source.mesh));
        Self { subdivision: levels, triangles, ..self }
    }

    /// The triangles and where they came from.
    #[must_use]
    pub fn source(&self) -> &MeshSource {
        &self.source
    }

    /// The triangles that rays meet, in the mesh's own space: those of the source, or what they were cut into.
    #[must_use]
    pub fn triangles(&self) -> &Arc<TriangleMesh> {
        &self.triangles
    }

    /// From the mesh's own space to where it has been placed.
    #[must_use]
    pub fn placement(&self) -> &Placement {
        &self.to_world
    }

    /// From where it has been placed to the mesh's own space.
    #[must_use]
    pub fn to_object(&self) -> &Placement {
        &self.to_object
    }
}

impl Part for Mesh {
    const NAME: &'static str = "mesh";
    const DOC: &'static str = "A triangle mesh read from a file.";
    const FIELDS: &'static [Field] = &[
        Field::required("file", FieldKind::Mesh, "", "Model file, relative to the scene's folder."),
        Field::required(
            "subdivision",
            FieldKind::Count,
            "",
            "How often each triangle is cut into four that bulge as the normals say, 0 to 5.",
        )
        .or(|| Value::Number(0.0)),
    ];

    fn make(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self::new(given.mesh("file")?).subdivided(given.count("subdivision", [0, MOST_LEVELS])?))
    }

    fn values(&self) -> Values {
        let subdivision = Value::Number(f64::from(self.subdivision));
        Values::new().with("file", Value::Mesh(self.source.clone())).with("subdivision", subdivision)
    }
}

impl Mesh {
    /// Whether a ray in the space of this mesh meets a triangle of it and one of another at one point for a reason that is seen
    /// at once; it meets both. Mostly that is an edge, a corner or a plane which both have.
    #[must_use]
    pub fn meets_together(&self, triangle: u32, (other, of_other): (&Self, u32), own: &Ray) -> bool {
        let corners = |mesh: &Self, of: u32| mesh.triangles.corners(of);
        self.to_object == other.to_object
            && meet_together(&corners(self, triangle), &corners(other, of_other), own)
    }

    /// The `t` at which a ray in the mesh's own space meets a triangle on `span`, if it does so before another that it is known to
    /// meet there; of two met at one point the lower comes first. As [`cross_piece`](Geometry::cross_piece) tells, without how the
    /// triangles look where they are met.
    #[must_use]
    pub fn met_before(
        &self,
        [triangle, held]: [u32; 2],
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Option<f64> {
        if !own.is_valid() || self.leaves(leaving, triangle) {
            return None;
        }
        let [corners, of_held] = [triangle, held].map(|triangle| self.triangles.corners(triangle));
        let (met, order) = met_beside(&corners, &of_held, own, span)?;
        order.then(triangle.cmp(&held)).is_lt().then_some(met.t)
    }

    /// Whether a ray that leaves a triangle leaves another with it, as they lie in one plane.
    fn leaves(&self, left: Option<u32>, triangle: u32) -> bool {
        left.is_some_and(|left| self.triangles.lies_in_plane(left, triangle))
    }

    /// How much each corner of a triangle counts at a point.
    fn weights_at(&self, point: DVec3, triangle: u32) -> [f64; 3] {
        let own = self.to_object.point(point);
        let of_corners = in_triangle(&self.triangles.corners(triangle), BARYCENTRIC, own).uv;
        [1.0 - of_corners.x - of_corners.y, of_corners.x, of_corners.y]
    }
}

impl Geometry for Mesh {
    fn pieces(&self) -> u32 {
        self.triangles.triangles().len() as u32
    }

    fn own_ray(&self, ray: &Ray) -> Ray {
        Ray::new(self.to_object.point(ray.origin), self.to_object.vector(ray.direction))
    }

    fn nearest_root<N: Number>(
        &self,
        triangle: u32,
        own: &Ray,
        span: Span,
        leaving: Option<u32>,
    ) -> Verdict<Option<FacetRoot<N>>> {
        if leaving == Some(triangle) {
            return Ok(None);
        }
        let met = meet_triangle(&self.triangles.corners(triangle), own, span, triangle);
        // Planes are asked about last, as most triangles are missed.
        if !matches!(met, Ok(None)) && self.leaves(leaving, triangle) { Ok(None) } else { met }
    }

    fn crossing(&self, own: &Ray, at: Located, triangle: u32) -> Option<Crossing> {
        let mesh = &self.triangles;
        let corners = mesh.corners(triangle);
        let normal = unit_normal(&corners)?;
        let weights = weights(&corners, own);
        let shading = mesh.normal_at(triangle, weights).and_then(DVec3::try_normalize).unwrap_or(normal);
        Some(Crossing {
            normal: self.to_world.direction(normal),
            shading_normal: self.to_world.direction(shading),
            uv: mesh.uv_at(triangle, weights),
            ..Crossing::flat(at, normal, triangle)
        })
    }

    fn bounds(&self) -> Option<Aabb> {
        let own = self.triangles.bounds();
        Some(if self.to_world == Placement::IDENTITY {
            own
        } else {
            Aabb::of(own.corners().map(|p| self.to_world.point(p)))
        })
    }

    fn placed(&self, placement: &Placement) -> Self {
        let to_world = self.to_world.then(placement);
        Self { to_world, to_object: to_world.inverse(), ..self.clone() }
    }

    fn parametrization(&self, point: DVec3, triangle: u32) -> Parametrization {
        let mesh = &self.triangles;
        let own = self.to_object.point(point);
        let found = in_triangle(&mesh.corners(triangle), mesh.corner_uvs(triangle), own);
        let [along_u, along_v] = [found.along_u, found.along_v].map(|v| self.to_world.vector(v));
        Parametrization { along_u, along_v, ..found }
    }

    fn color_at(&self, point: DVec3, triangle: u32) -> Option<Rgb> {
        let mesh = &self.triangles;
        mesh.colors()?;
        mesh.color_at(triangle, self.weights_at(point, triangle))
    }

    fn tangents(&self, point: DVec3, triangle: u32) -> Option<[DVec3; 2]> {
        let along = self.triangles.tangents_at(triangle, self.weights_at(point, triangle))?;
        Some(along.map(|v| self.to_world.vector(v)))
    }

    fn is_closed(&self) -> bool {
        self.triangles.open_edge().is_none()
    }

    fn is_solid(&self) -> bool {
        self.is_closed()
    }

    fn passage<N: Number>(&self, own: &Ray, leaving: Option<u32>) -> Verdict<Passage<N>> {
        let mesh = &self.triangles;
        let mut crossings = Crossings::new(own);
        mesh.along(own, |triangle| crossings.add(&mesh.corners(triangle), triangle))?;
        let passage = crossings.passage()?;
        match leaving.filter(|&left| left < self.pieces()) {
            Some(left) => {
                let side = area::<N>(&mesh.corners(left)).dot(&Vector::of(own.direction)).sign()?;
                passage.after_leaving(|facet| mesh.lies_in_plane(left, facet), side)
            }
            None => Ok(passage),
        }
    }

    fn as_mesh(&self) -> Option<&Mesh> {
        Some(self)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn a_ray_that_leaves_a_triangle_leaves_its_plane_and_nothing_else(
            base in prop::array::uniform3([-9_i16..10, -9..10, -9..10]),
            weights in [0.0..1.0_f64, 0.0..1.0], along in [-1.0..1.0_f64, -1.0..1.0],
            steepness in -16.0..0.0_f64, side in prop::sample::select(vec![-1.0, 1.0]),
        ) {
            // A quadrilateral of two triangles, in a plane that its corners lie in exactly, between two that stand beside it.
            let [at, u, v] = base.map(|c| DVec3::from(c.map(f64::from)));
            let normal = u.cross(v);
            prop_assume!(normal.length() > 1.0);
            let corners = [at, at + u, at + u + v, at + v];
            let beside = [9.0, -9.0].map(|far| corners.map(|p| p + normal * far));
            let positions = corners.into_iter().chain(beside.into_iter().flatten()).map(|p| p.as_vec3().to_array());
            let halves = |first: u32| [[first, first + 1, first + 2], [first, first + 2, first + 3]];
            let triangles = [0, 4, 8].into_iter().flat_map(halves).collect();
            let mesh = TriangleMesh::new(positions.collect(), triangles, None, None).unwrap();
            let mesh = Mesh::new(MeshSource { path: String::new(), mesh: mesh.into() });
            let [x, y] = weights;
            let start = at + u * x + v * y;
            let flat = (u * along[0] + v * along[1]) / 100.0;
            let ray = Ray::new(start, flat + normal * side * 10.0_f64.powf(steepness));
            for left in [0, 1] {
                let met = mesh.cross(&ray, Span::AHEAD, Some(left));
                prop_assert!(met.is_none_or(|met| met.facet > 1), "{:?}", met);
            }
            let upright = Ray::new(start, normal * side);
            let met = mesh.cross(&upright, Span::AHEAD, Some(0)).map(|met| met.facet / 2);
            prop_assert_eq!(met, Some(if side > 0.0 { 1 } else { 2 }));
        }
    }
}
