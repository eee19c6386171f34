//! How do the texture coordinates of a mesh run, smoothly from triangle to triangle, so that its normal maps look as where they
//! were made?
//!
//! By the algorithm that tools agree on: Mikkelsen, "Simulation of wrinkled surfaces revisited", 2008.

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::DVec3;

use super::TriangleMesh;
use super::derived::Derived;

/// Tangents of the three corners of each triangle, with the side of the bitangent (1 or −1); made when first asked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Tangents(Derived<Vec<[[f32; 4]; 3]>>);

impl Tangents {
    /// Those of a triangle of the mesh, which has texture coordinates.
    pub(super) fn of(&self, mesh: &TriangleMesh, triangle: u32) -> [[f32; 4]; 3] {
        let made = || {
            let mut corners =
                Corners { mesh, tangents: vec![[[1.0, 0.0, 0.0, 1.0]; 3]; mesh.triangles().len()] };
            // Where it cannot tell them, those that there are stay.
            let _ = generate_tangents(&mut corners);
            corners.tangents
        };
        self.0.get_or_make(made)[triangle as usize]
    }
}

/// A mesh, as the algorithm reads it.
struct Corners<'a> {
    mesh: &'a TriangleMesh,
    tangents: Vec<[[f32; 4]; 3]>,
}

impl Corners<'_> {
    fn number(&self, triangle: usize, corner: usize) -> usize {
        self.mesh.triangles()[triangle][corner] as usize
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangles().len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, triangle: usize, corner: usize) -> [f32; 3] {
        self.mesh.positions()[self.number(triangle, corner)]
    }

    fn normal(&self, triangle: usize, corner: usize) -> [f32; 3] {
        let own = self
            .mesh
            .normals()
            .map(|normals| DVec3::from(normals[self.number(triangle, corner)].map(f64::from)));
        let flat = || {
            let [a, b, c] = self.mesh.corners(triangle as u32);
            (b - a).cross(c - a)
        };
        own.unwrap_or_else(flat).normalize_or_zero().as_vec3().to_array()
    }

    fn tex_coord(&self, triangle: usize, corner: usize) -> [f32; 2] {
        self.mesh.uvs().map_or([0.0; 2], |uvs| uvs[self.number(triangle, corner)])
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, triangle: usize, corner: usize) {
        if let Some(space) = space {
            self.tangents[triangle][corner] = space.tangent_encoded();
        }
    }
}
