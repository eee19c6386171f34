//! How do triangles become a scene, if nobody asks how they look?

use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::glam::DVec3;
use catoptra_core::material::Matte;
use catoptra_core::{Aabb, MeshSource, Rgb, Scene, TriangleMesh};

use super::CasterError;

/// A scene of one mesh.
pub(super) fn scene(mesh: Arc<TriangleMesh>) -> Result<Scene, CasterError> {
    let mut scene = Scene::new();
    let unseen = scene.add_material("unseen", Matte::new(Rgb::BLACK)?)?;
    scene.add_shape("triangles", Mesh::new(MeshSource { path: String::new(), mesh }), unseen, None)?;
    Ok(scene)
}

/// Corners as they are where `f32` holds them, else round the middle of all.
pub(super) fn mesh<C: Copy + Into<f64>>(
    positions: &[[C; 3]],
    triangles: &[[u32; 3]],
) -> Result<TriangleMesh, CasterError> {
    let place = |corner: &[C; 3]| DVec3::from(corner.map(Into::into));
    let fits = |corner: &[C; 3]| corner.iter().all(|&v| f64::from(v.into() as f32) == v.into());
    let middle = if positions.iter().all(fits) {
        DVec3::ZERO
    } else {
        let bounds = Aabb::of(positions.iter().map(place));
        bounds.min * 0.5 + bounds.max * 0.5
    };
    let corners = positions.iter().map(|corner| (place(corner) - middle).as_vec3().to_array()).collect();
    Ok(TriangleMesh::new(corners, triangles.to_vec(), None, None)?.with_offset(middle))
}
